//! What the torques add up to: system momentum, delta-v, thruster dumps.
//!
//! A flight is cut into *segments* on which everything is smooth: a segment ends at the next multiple of the
//! grid step, at an event (the attitude law changes form, an edge of the shadow), or where a thruster dump falls. Inside a segment the totals are a
//! polynomial in time, so any communication point merely evaluates it, and how a master cuts its steps cannot
//! change a bit.

mod dump;
mod integrator;
mod segment;
mod wheels;

pub use dump::{DumpPolicy, Reinitialise};
pub use integrator::{Convention, DumpEvent, Dumps, MomentumIntegrator, Settings, TooManyDumps};
pub use segment::{Effort, EventValues, Sample, TorqueModel, Totals, after_event_s};
pub use wheels::WheelArray;
