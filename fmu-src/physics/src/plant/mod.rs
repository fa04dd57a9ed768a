//! The three-axis spacecraft put together: orbit, attitude, light and gravity gradient in one flight.
//!
//! [`Configuration`] describes spacecraft and orbit; [`Plant`] evaluates it and is the [`crate::momentum::TorqueModel`] that the
//! momentum integrator asks. What it has to remember between two evaluations is a [`PropagatorState`]: an integrated orbit,
//! and a [`RadiationSegment`] of slowly changing light and heat.
//!
//! **Torque over a span ahead, without side effects.** Nothing but the [`PropagatorState`] is state: ephemeris and
//! [`RadiationSolver`] are caches. Who plans clones the state, makes a [`Plant`] on the clone and advances that
//! ([`crate::momentum::TorqueModel::prepare`], then [`Plant::evaluate`]), under the same or another [`Configuration`]; the
//! flight itself does not change by a bit.
//!
//! **Attitude that is known only up to now.** A controlled attitude is a [`Command`] that holds the attitude and rate of the
//! latest sample and continues at that rate. Light, heat and orbit are computed ahead on that assumption; the next sample
//! replaces the command and [`PropagatorState::cut`] drops what was computed beyond it, while heat stored up to then stays.
//! How far ahead is computed is `RadiationSettings::grid_s`: about the time between two samples wastes nothing.

mod control;
mod disturbances;
mod events;
mod flight;
mod instant;
mod motion;
mod settings;
mod sources;
mod state;
mod thrusters;

pub use disturbances::evaluation::{Evaluation, External};
pub use disturbances::plant::{Plant, PlantSettings};
pub use disturbances::simulation_context::SimulationContext;
pub use disturbances::simulation_models::SimulationModels;
pub use flight::configured::{DownlinkForecast, StartMomentum, StepContext, SunPlanner, SunSelectionStart};
pub use flight::fork::{ForecastMomentum, forecast};
pub use flight::report::{ControlReport, EncounterReport, FlightSummary, ReachedState, Report, WheelReport};
pub use flight::{Flight, Occultation, Undo, survey};
pub use instant::air_and_field_segment::AirAndField;
pub use instant::at_time::Instant;
pub use instant::geometry::{Geometry, sun_and_earth};
pub use motion::approaches::ClosestApproach;
pub use motion::osculating_orbit::OsculatingOrbit;
pub use motion::panel_motion::PanelMotion;
pub use motion::trajectory::Trajectory;
pub use settings::air_and_field_settings::{
    AirAndFieldSettings, AirSettings, AirSource, FieldSource, PlanetFigure,
};
pub use settings::attitude_source::{AttitudeSource, Command, Turning};
pub use settings::configuration::{
    Configuration, Encounter, EphemerisSource, LightSource, Motion, PredictionSettings, RadiationSettings,
    SunLight,
};
pub use settings::control_defaults::{
    ControlDefaults, DUMP_TORQUE_N_M, LEAST_DUMP_THRESHOLD_N_M_S, NEVER_DUMPED_N_M_S,
    SLEW_ACCELERATION_RAD_S2, SLEW_RATE_RAD_S,
};
pub use settings::digest::Digest;
pub use settings::dynamics_settings::{
    Control, DynamicsInputs, DynamicsSettings, StartMotion, StartPointing, ThrusterControl, Tracked,
    WheelControlSettings,
};
pub use settings::error::{ManeuverError, PlantError};
pub use settings::laws::{Laws, TUNABLE_COUNT};
pub use settings::mode_settings::{IdealSettings, ModeSettings};
pub use settings::panel_setting::{PanelSetting, PanelStep, Ramp, SunAt, Tilt};
pub use settings::prepared_spacecraft::PreparedSpacecraft;
pub use settings::reaction_control_settings::{Purpose, ReactionControlSettings, ThrustCommand};
pub use settings::thruster_events::{Maneuver, ThrusterEvent, ThrusterEventSettings};
pub use settings::work::{Work, WorkExceeded};
pub use sources::air::AerodynamicSolver;
pub use sources::by_source::{BySource, Parameters, PositionError, Positions, Surfaces, Workspaces};
pub use sources::sunlight::REFLECTED_LIGHT;
pub use sources::sunlight::radiation_segment::RadiationSegment;
pub use sources::sunlight::radiation_solver::RadiationSolver;
pub use sources::sunlight::sunlit::SunlitConfiguration;
pub use sources::thrusters::THRUSTERS;
pub use sources::{SourceStates, Sources};
pub use state::flight_state::{EncounterPrediction, PredictedArrival};
pub use state::ideal_state::Maneuvers;
pub use state::propagator_state::{PropagatorState, SunDirectionSelection};
pub use thrusters::allocation::{ThrusterAllocator, UnservedDumps};
pub use thrusters::reaction_control::Thrusters;
pub use thrusters::thruster_load::{ThrusterLoad, ThrusterTotals};
