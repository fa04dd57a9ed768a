//! Inputs of a sample of guidance: settings by parameters, commands and their timeline entries, positions and measurements.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::body_positions::BodyPositions;
use super::transitions::{ModeSettings, Sensed};
use crate::guidance::burn::delta_v::BurnSettings;
use crate::guidance::constraints::constrained::Constraints;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::downlink::sun_direction::{LinkLimits, SunRequest};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::orbit_phase::guided::Guided;
use crate::guidance::pointing::command::PointingCommand;
use crate::guidance::scenario::GuidanceHardware;

/// Settings of guidance by parameters.
#[derive(Clone, Copy, Debug)]
pub struct GuidanceSettings<'a> {
    /// Instruments, gimbal, scans.
    pub hardware: GuidanceHardware<'a>,
    /// Modes and their constraints.
    pub modes: ModeSettings,
    /// The keep-in zone of Operational, in force or not.
    pub keep_in: KeepIn,
    /// The radio link.
    pub link: LinkLimits,
    /// The law of the orbit phase; its periapsis and period are computed.
    pub orbit_phase: Guided,
    /// The burn of the scenario burn.
    pub burn: BurnSettings,
}

/// Inputs of one sample.
#[derive(Clone, Copy, Debug)]
pub struct SampleInputs {
    /// Pointing command.
    pub command: PointingCommand,
    /// Requested direction of the Sun in downlinks; a strategy replaces it.
    pub requested_sun: SunRequest,
    /// Whether the timeline gives the Sun's direction, so that no strategy does.
    pub sun_is_placed: bool,
    /// Whether an input commands the scenario.
    pub is_commanded: bool,
    /// The timeline's entries that say scan, limb and mode, where they and no input do: each begins with its entry.
    pub entries: TimedEntries,
    /// Positions of spacecraft and bodies.
    pub positions: BodyPositions,
    /// Mode request, estimate and Sun sensors at the sample's time.
    pub sensed: Sensed,
    /// Sum of the accelerometers' increments along the body axes, in m/s.
    pub delta_v_body_m_s: Vector3<f64>,
}

/// Begin times on the timeline's clock, in s, of the entries in force; `None` without a timeline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TimedEntries {
    /// The scan.
    pub scan: Option<f64>,
    /// The scenario: the entry that names one.
    pub scenario: Option<f64>,
    /// The mode that is requested.
    pub mode: Option<f64>,
    /// Whether the burn is one of an entry that is no longer in force; its attitude is held.
    pub burn_is_over: bool,
}

/// Context of a sample that points.
pub(super) struct SampleContext<'a> {
    /// Settings with the zone of the mode.
    pub settings: &'a GuidanceSettings<'a>,
    /// Constraints of the mode.
    pub constraints: Constraints,
    /// Positions that the mode uses.
    pub ephemeris: &'a EphemerisAtTime,
    /// Requested direction of the Sun in downlinks, inside the zone.
    pub requested_sun: SunRequest,
    /// Whether the timeline gives the Sun's direction.
    pub sun_is_placed: bool,
    /// Time of the sample, in s.
    pub time_s: f64,
}
