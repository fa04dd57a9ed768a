//! The three-axis spacecraft put together: orbit, attitude, light and gravity gradient in one flight.
//!
//! [`Configuration`] says what flies where; [`Plant`] evaluates it and is the [`crate::momentum::TorqueModel`] that the
//! momentum integrator asks. What it has to remember between two evaluations is a [`PropagatorState`]: an integrated orbit,
//! and a [`RadiationSegment`] of slowly changing light and heat.
//!
//! **Torque over a span ahead, without side effects.** Nothing but the [`PropagatorState`] is state: ephemeris and
//! [`RadiationSolver`] are caches. Who plans clones the state, makes a [`Plant`] on the clone and advances that
//! ([`crate::momentum::TorqueModel::prepare`], then [`Plant::evaluate`]), under the same or another [`Configuration`]; the
//! flight itself does not change by a bit.
//!
//! **Attitude that is known only up to now.** A controlled attitude is a [`Command`] that holds the attitude and rate of the
//! latest sample and goes on at that rate. Light, heat and orbit are computed ahead on that assumption; the next sample
//! replaces the command and [`PropagatorState::cut`] drops what was computed beyond it, while heat stored up to then stays.
//! How far ahead is computed is `RadiationSettings::grid_s`: about the time between two samples wastes nothing.

mod attitude_dynamics;
mod configuration;
mod control_defaults;
mod disturbance_interval;
mod dynamics_settings;
mod error;
mod evaluation;
mod flight;
mod geometry;
mod ideal_flight;
mod instant;
mod kinematics;
mod light_and_heat;
mod outlook;
mod panel_motion;
mod panel_setting;
mod propagator_state;
mod pulsed_dump;
mod radiation_node;
mod radiation_segment;
mod radiation_solver;
mod reaction_control;
mod reaction_control_settings;
mod settings;
mod stored_heat;
mod sun_choice;
mod sunlit;
mod thruster_load;
mod trajectory;
mod wheel_control;
mod work;

pub use attitude_dynamics::AttitudeDynamics;
pub use configuration::{
    AttitudeSource, Command, Configuration, DynamicAttitude, EphemerisSource, Motion, SunLight,
    orbit_from_elements,
};
pub use control_defaults::ControlDefaults;
pub use dynamics_settings::{Control, DynamicsInputs, DynamicsSettings, ThrusterControl, Tracked};
pub use error::PlantError;
pub use evaluation::{Evaluation, ExternalLoad, Plant, PreparedSpacecraft};
pub use flight::Flight;
pub use geometry::Geometry;
pub use ideal_flight::{DumpSideEffect, IdealFlight};
pub use instant::{Instant, Regime};
pub use outlook::{ForecastMomentum, Outlook, StartMomentum, SunPlanner};
pub use panel_motion::PanelMotion;
pub use panel_setting::{PanelSetting, Ramp};
pub use propagator_state::PropagatorState;
pub use radiation_segment::RadiationSegment;
pub use radiation_solver::RadiationSolver;
pub use reaction_control::ReactionControl;
pub use reaction_control_settings::{ReactionControlSettings, ThrustCommand};
pub use settings::RadiationSettings;
pub use sun_choice::SunChoice;
pub use sunlit::SunlitCraft;
pub use thruster_load::{ThrusterLoad, ThrusterTotals};
pub use trajectory::Trajectory;
pub use wheel_control::{WheelControl, WheelControlSettings};
pub use work::{Cost, Work, WorkExceeded};
