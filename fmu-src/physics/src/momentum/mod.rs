//! Integrals of the loads: system momentum, delta-v, thruster dumps.
//!
//! A flight is cut into *segments* on which everything is smooth: a segment ends at the next multiple of the
//! grid step, at an event (the attitude law changes form, an edge of the shadow), or where a thruster dump falls. Inside a segment the totals are a
//! polynomial in time, so any communication point merely evaluates it, and how a master cuts its steps cannot
//! change a bit.

mod by_source;
mod dump;
mod excess;
mod integrator;
mod segment;
mod torque_model;
mod totals;
mod wheels;

pub use by_source::{SourceMomenta, SourceTorques, torques_body_n_m};
pub use dump::{DumpEvent, DumpPolicy, DumpSpacing, Dumps, Reinitialise, TooManyDumps};
pub use integrator::{MomentumIntegrator, PreparedSegment};
pub use segment::Settings;
pub use torque_model::{EventValues, TorqueModel, TorqueSample, WorkKind, after_event_s};
pub use totals::{Convention, Totals};
pub use wheels::{WheelArray, WheelCapacity, wheels_body_n_m_s};
