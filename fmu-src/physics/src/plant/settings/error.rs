//! Why a flight of the plant ends.

use thiserror::Error;

use super::work::WorkExceeded;
use crate::environment::atmosphere::AtmosphereError;
use crate::environment::magnetic_field::MagneticFieldError;
use crate::environment::orbit::{OrbitError, OrbitIntegrationError};
use crate::momentum::TooManyDumps;
use crate::refusal::Refusal;

/// Why a flight ends.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlantError {
    /// The orbit.
    #[error(transparent)]
    Orbit(#[from] OrbitIntegrationError),
    /// A place where no spacecraft can be.
    #[error(
        "at {time_s} s the spacecraft at {position_m:?} m about the orbit's centre is inside the planet or the Sun, or the \
         planet inside the Sun, or its position is no number"
    )]
    WithoutPosition {
        /// When, in s.
        time_s: f64,
        /// Position about the orbit's centre, EME2000, in m.
        position_m: [f64; 3],
    },
    /// Light and heat have no meaning where the spacecraft is.
    #[error(
        "at {time_s} s, the spacecraft being at {position_m:?} m about the orbit's centre, light has no meaning: {source}"
    )]
    Light {
        /// When, in s.
        time_s: f64,
        /// Position about the orbit's centre, EME2000, in m.
        position_m: [f64; 3],
        /// Why.
        source: Refusal,
    },
    /// The model of the air does not reach where the spacecraft is.
    #[error("the air at {time_s} s: {source}")]
    Air {
        /// When, in s.
        time_s: f64,
        /// Why.
        source: AtmosphereError,
    },
    /// The model of the magnetic field does not reach where or when the spacecraft is.
    #[error("the magnetic field at {time_s} s: {source}")]
    Field {
        /// When, in s.
        time_s: f64,
        /// Why.
        source: MagneticFieldError,
    },
    /// Restored bytes of another spacecraft.
    #[error("the state holds {found} temperatures, allowed: {allowed}, one for each face")]
    Temperatures {
        /// How many there are.
        found: usize,
        /// How many there should be.
        allowed: usize,
    },
    /// Restored bytes that are no flight's.
    #[error("the state holds a temperature of {found_k} K, allowed: 0 to 1e5 K")]
    Temperature {
        /// Temperature that was found, in K.
        found_k: f64,
    },
    /// Dumps without end.
    #[error(transparent)]
    Dumps(#[from] TooManyDumps),
    /// More work than a step may take.
    #[error(transparent)]
    Work(#[from] WorkExceeded),
    /// A maneuver that cannot be executed.
    #[error("the maneuver at {time_s:?} s: {why}")]
    Maneuver {
        /// When, in s.
        time_s: f64,
        /// Why.
        why: ManeuverError,
    },
    /// A scheduled event of a flight by torque that is no dump.
    #[error(
        "the [[event]] on line {line} of the timeline has {found}, allowed with attitude.source controlled (3) and free (4): a dump alone; burns are \
         thrust.request and thrust.command there"
    )]
    ScheduledEvent {
        /// Its line in the file, from 1.
        line: usize,
        /// Attitude law that the command has.
        found: &'static str,
    },
    /// An event that came again where it has just come.
    #[error("at {time_s:?} s there was already an event of this kind: {kind}")]
    RepeatedEvent {
        /// When, in s.
        time_s: f64,
        /// Name of the kind.
        kind: &'static str,
    },
    /// Restored bytes of another kind of simulation.
    #[error("the state holds another kind of flight: it belongs to another attitude.source")]
    OtherMode,
    /// An orbit that goes no further: restored bytes that belong to another kind of motion.
    #[error(
        "the orbit ends at {end_s:?} s and does not go on from {start_s:?} s: the state belongs to another orbit.dynamics"
    )]
    Stuck {
        /// Time from which the flight should continue, in s.
        start_s: f64,
        /// Time at which the computed motion ends, in s.
        end_s: f64,
    },
}

/// Why a maneuver cannot be executed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ManeuverError {
    /// In a flight by torque.
    #[error(
        "found in controlled or free flight, allowed: attitude.source guided (1) and commanded (2); there burns are \
         thrust.request and thrust.command"
    )]
    ByTorque,
    /// No number.
    #[error("found a delta-v of {found_m_s:?} m/s, allowed: finite numbers")]
    NotFinite {
        /// Velocity change that was found, EME2000, in m/s.
        found_m_s: [f64; 3],
    },
    /// Thrusters whose forces cancel, or none.
    #[error("the thrusters of maneuver.thrusters have a total force of {found_n:?} N, allowed: more than 0")]
    WithoutThrust {
        /// Magnitude of their sum, in N.
        found_n: f64,
    },
    /// Too little propellant.
    #[error(
        "it takes {needed_kg:?} kg from tank {tank}, allowed: up to the {left_kg:?} kg that it can still feed"
    )]
    Propellant {
        /// The tank's name.
        tank: String,
        /// Propellant that the maneuver needs, in kg.
        needed_kg: f64,
        /// Mass that the tank can still feed, in kg.
        left_kg: f64,
    },
    /// A velocity without an orbit.
    #[error("no orbit begins with the velocity after it: {0}")]
    Orbit(#[from] OrbitError),
}
