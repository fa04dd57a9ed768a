//! Two chains of safe modes in the loop: inertial reference and Sun are lost and come back; the keep-in zone is violated.

use super::guided_loop::{Loop, LoopCase, LoopSample};
use crate::StudyError;
use crate::attitude::{Vector, angle_rad};
use crate::settings::{Settings, of, set};

/// 2009-04-06 00:00 TDB in seconds past J2000, the start of the default flight.
const EPOCH_S: f64 = 292_248_000.0;
/// Assumed: before apoapsis, far from eclipse and hot pole.
const TRUE_ANOMALY_DEG: f64 = 160.0;
/// Sun sensors of the spacecraft.
const SUN_SENSORS: usize = 6;

/// The gyros keep the estimate valid for so long without the star tracker, in s: assumed, short.
pub(super) const OUTAGE_S: f64 = 60.0;
/// The star tracker fails, in s.
pub(super) const TRACKER_FAILS_S: f64 = 300.0;
/// Every Sun sensor fails, in s.
pub(super) const SUN_LOST_S: f64 = 2000.0;
/// They work again, in s: a third of a turn into the search's second round.
pub(super) const SUN_BACK_S: f64 = 4400.0;
/// The star tracker works again, in s.
pub(super) const TRACKER_BACK_S: f64 = 6000.0;
/// Safe Hold is requested, in s.
pub(super) const SAFE_HOLD_S: f64 = 6300.0;
/// Operational is requested, in s.
pub(super) const OPERATIONAL_S: f64 = 7800.0;
const LOST_END_S: f64 = 9300.0;

/// The keep-in zone is put in force, in s.
pub(super) const ZONE_ON_S: f64 = 300.0;
/// Operational is requested after that, in s.
pub(super) const PARDONED_S: f64 = 2400.0;
const VIOLATED_END_S: f64 = 4000.0;

/// The boresight of Earth Acquisition and centre of the keep-in zone by default, body frame.
pub(super) const BORESIGHT: Vector = Vector::new(0.0, -1.0, 0.0);

/// Angle between the boresight and the Sun, in deg.
pub(super) fn sun_angle_deg(sample: &LoopSample) -> f64 {
    angle_rad(&BORESIGHT, &sample.sun_body_m()).to_degrees()
}

/// A chain of modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chain {
    /// The star tracker fails, then the Sun sensors.
    AttitudeLost,
    /// The keep-in zone is put in force while the Sun is outside.
    ZoneViolated,
}

impl Chain {
    /// For messages and tables.
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::AttitudeLost => "attitude lost",
            Self::ZoneViolated => "zone violated",
        }
    }

    /// What is set when, in s.
    fn events(self) -> Vec<(f64, Settings)> {
        let tracker = |failed: bool| {
            ["failed", "spareFailed"].map(|it| set(&format!("plant.starTracker.{it}"), failed)).concat()
        };
        let sensors = |failed: bool| -> Settings {
            (1..=SUN_SENSORS).flat_map(|k| set(&format!("plant.sunSensor[{k}].failed"), failed)).collect()
        };
        let request = |mode: &str| set("guidance.mode.request", mode);
        match self {
            Self::AttitudeLost => vec![
                (0.0, plus_z_at_the_sun()),
                (TRACKER_FAILS_S, tracker(true)),
                (SUN_LOST_S, sensors(true)),
                (SUN_BACK_S, sensors(false)),
                (TRACKER_BACK_S, tracker(false)),
                (SAFE_HOLD_S, request("safeHold")),
                (OPERATIONAL_S, request("operational")),
            ],
            Self::ZoneViolated => vec![
                (0.0, plus_z_at_the_sun()),
                (ZONE_ON_S, set("guidance.keepIn.enabled", true)),
                (PARDONED_S, request("operational")),
            ],
        }
    }

    /// Simulates it.
    pub(super) fn simulated(self, both: &Loop, step_s: Option<f64>) -> Result<Vec<LoopSample>, StudyError> {
        let events = self.events();
        let inputs = |sample: &LoopSample| {
            let due = events.iter().filter(|(at_s, _)| (at_s - sample.time_s).abs() < 0.25);
            due.flat_map(|(_, settings)| settings.clone()).collect()
        };
        let stop_s = match self {
            Self::AttitudeLost => LOST_END_S,
            Self::ZoneViolated => VIOLATED_END_S,
        };
        both.simulated(
            &LoopCase {
                label: self.label(),
                epoch_s: EPOCH_S,
                true_anomaly_deg: TRUE_ANOMALY_DEG,
                stop_s,
                // The Sun is where the keep-in zone would not let it be.
                settings: [set("plant.starTracker.outage", OUTAGE_S), set("guidance.keepIn.enabled", false)]
                    .concat(),
                inputs: &inputs,
            },
            step_s,
        )
    }
}

/// The scenario generic: +Z at the Sun, rolled toward the Earth.
fn plus_z_at_the_sun() -> Settings {
    let settings = [
        set("pointing.scenario", "generic"),
        set("boresight.option", "vector"),
        set("aimpoint.option", "sun"),
        set("bodyRoll.option", "vector"),
        set("externalRoll.option", "earth"),
        set("boresight.vector", Vector::z()),
        set("bodyRoll.vector", Vector::x()),
    ];
    of("guidance", settings.concat())
}
