//! The three-axis spacecraft put together: orbit, attitude, light and gravity gradient in one flight.
//!
//! [`Configuration`] says what flies where; [`Plant`] evaluates it and is the [`crate::momentum::TorqueModel`] that momentum
//! accumulates over. What it has to remember between two evaluations is a [`PropagatorState`]: an integrated orbit, and a
//! [`RadiationSegment`] of slowly changing light and heat.

mod configuration;
mod evaluation;
mod geometry;
mod kinematics;
mod propagator;
mod radiation;
mod radiation_segment;
mod stored_heat;
mod trajectory;
mod work;

pub use configuration::{
    AttitudeSource, Command, Configuration, EphemerisSource, Motion, PanelSetting, SunLight,
    orbit_from_elements,
};
pub use evaluation::{Evaluation, ExternalLoad, Plant, PreparedSpacecraft};
pub use geometry::Geometry;
pub use kinematics::{Instant, Regime};
pub use propagator::{PlantError, PropagatorState};
pub use radiation::{RadiationSettings, RadiationSolver};
pub use radiation_segment::RadiationSegment;
pub use trajectory::Trajectory;
pub use work::{Cost, Work, WorkExceeded};
