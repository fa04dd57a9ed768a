//! Two chains of safe modes in the loop: inertial reference and Sun are lost and come back; the keep-in zone is violated.

use super::guided_loop::{Flight, GUIDANCE, Loop, PLANT, Sample};
use crate::StudyError;
use crate::settings::{Settings, flag, number, real, vector_setting};
use crate::vector::angle_rad;

/// 2009-04-06 00:00 TDB in seconds past J2000, the start of the default flight.
const EPOCH_S: f64 = 292_248_000.0;
/// Assumed: before apoapsis, far from eclipse and hot pole.
const TRUE_ANOMALY_DEG: f64 = 160.0;
/// Sun sensors of the spacecraft.
const SUN_SENSORS: usize = 6;

/// The gyros keep the estimate valid for so long without the star tracker, in s: assumed, short.
pub const OUTAGE_S: f64 = 60.0;
/// The star tracker fails, in s.
pub const TRACKER_FAILS_S: f64 = 300.0;
/// Every Sun sensor fails, in s.
pub const SUN_LOST_S: f64 = 2000.0;
/// They work again, in s: a third of a turn into the search's second round.
pub const SUN_BACK_S: f64 = 4400.0;
/// The star tracker works again, in s.
pub const TRACKER_BACK_S: f64 = 6000.0;
/// Safe Hold is requested, in s.
pub const SAFE_HOLD_S: f64 = 6300.0;
/// Operational is requested, in s.
pub const OPERATIONAL_S: f64 = 7800.0;
const LOST_END_S: f64 = 9300.0;

/// The keep-in zone is put in force, in s.
pub const ZONE_ON_S: f64 = 300.0;
/// Operational is requested after that, in s.
pub const PARDONED_S: f64 = 2400.0;
const VIOLATED_END_S: f64 = 4000.0;

/// The boresight of Earth Acquisition and centre of the keep-in zone by default, body frame.
pub const BORESIGHT: [f64; 3] = [0.0, -1.0, 0.0];

/// Angle between the boresight and the Sun, in deg.
pub fn sun_angle_deg(sample: &Sample) -> f64 {
    angle_rad(&BORESIGHT, &sample.sun_body_m()).to_degrees()
}

/// A chain of modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chain {
    /// The star tracker fails, then the Sun sensors.
    AttitudeLost,
    /// The keep-in zone is put in force while the Sun is outside.
    ZoneViolated,
}

impl Chain {
    /// For messages and tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::AttitudeLost => "attitude lost",
            Self::ZoneViolated => "zone violated",
        }
    }

    /// What is set when: time in s, unit, values.
    fn events(self) -> Vec<(f64, usize, Settings)> {
        let tracker =
            |failed| vec![flag("starTracker.failed", failed), flag("starTracker.spareFailed", failed)];
        let sensors = |failed| {
            (1..=SUN_SENSORS).map(|k| flag(&format!("sunSensor[{k}].failed"), failed)).collect::<Settings>()
        };
        let request = |mode| vec![number("mode.request", mode)];
        match self {
            Self::AttitudeLost => vec![
                (0.0, GUIDANCE, plus_z_at_the_sun()),
                (TRACKER_FAILS_S, PLANT, tracker(true)),
                (SUN_LOST_S, PLANT, sensors(true)),
                (SUN_BACK_S, PLANT, sensors(false)),
                (TRACKER_BACK_S, PLANT, tracker(false)),
                (SAFE_HOLD_S, GUIDANCE, request(2)),
                (OPERATIONAL_S, GUIDANCE, request(1)),
            ],
            Self::ZoneViolated => vec![
                (0.0, GUIDANCE, plus_z_at_the_sun()),
                (ZONE_ON_S, GUIDANCE, vec![flag("keepIn.enabled", true)]),
                (PARDONED_S, GUIDANCE, request(1)),
            ],
        }
    }

    /// Flies it.
    pub fn fly(self, both: &Loop, step_s: Option<f64>) -> Result<Vec<Sample>, StudyError> {
        let events = self.events();
        let inputs = |sample: &Sample| -> Vec<(usize, Settings)> {
            let due = events.iter().filter(|(at_s, ..)| (at_s - sample.time_s).abs() < 0.25);
            due.map(|(_, unit, settings)| (*unit, settings.clone())).collect()
        };
        let stop_s = match self {
            Self::AttitudeLost => LOST_END_S,
            Self::ZoneViolated => VIOLATED_END_S,
        };
        both.fly(
            &Flight {
                label: self.label(),
                epoch_s: EPOCH_S,
                true_anomaly_deg: TRUE_ANOMALY_DEG,
                stop_s,
                plant: vec![real("starTracker.outage", OUTAGE_S)],
                // The Sun is where the keep-in zone would not let it be.
                guidance: vec![flag("keepIn.enabled", false)],
                inputs: &inputs,
            },
            step_s,
        )
    }
}

/// The scenario generic: +Z at the Sun, rolled toward the Earth.
fn plus_z_at_the_sun() -> Settings {
    let mut settings = vec![
        number("pointing.scenario", 1),
        number("boresight.option", 1),
        number("aimpoint.option", 10),
        number("bodyRoll.option", 1),
        number("externalRoll.option", 4),
    ];
    settings.extend(vector_setting("boresight.vector", &[0.0, 0.0, 1.0]));
    settings.extend(vector_setting("bodyRoll.vector", &[1.0, 0.0, 0.0]));
    settings
}
