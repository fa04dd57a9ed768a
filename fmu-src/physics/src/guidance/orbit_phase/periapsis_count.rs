//! The orbit phase from where the spacecraft is: windows of science and downlink after the periapses of its present orbit.

use serde::{Deserialize, Serialize};

use super::guided::{Guided, GuidedAttitude, OrbitPhaseLaw};
use super::predicted_orbit::ellipse_of;
use super::schedule::Schedule;
use crate::environment::orbit::TwoBodyOrbit;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;

/// The periapsis from which downlinks are counted; that of the orbit on which counting began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeriapsisCount {
    first_epoch_s: Option<f64>,
}

impl PeriapsisCount {
    /// The attitude of the orbit phase. Periapsis and period of `law` are replaced by those of the orbit that position and
    /// velocity give; between disturbed orbits the count continues. Where a slew begins the spacecraft stood on that orbit, and
    /// Sun and Earth moved evenly since.
    pub fn attitude(&mut self, law: &OrbitPhaseLaw<'_>, ephemeris: &EphemerisAtTime) -> GuidedAttitude {
        let (orbit, schedule) = self.counted(&law.guided.schedule, ephemeris);
        let epoch_s = ephemeris.epoch_s;
        let guided = Guided { schedule, ..law.guided };
        OrbitPhaseLaw { guided, ..*law }.at(epoch_s, |at_s| match orbit {
            Some(orbit) if at_s != epoch_s => ephemeris.moved_to(at_s, &orbit.state_at(at_s)),
            _ => *ephemeris,
        })
    }

    /// The windows after the periapses that were counted, in s past J2000 TDB.
    pub fn windows(&mut self, windows: &Schedule, ephemeris: &EphemerisAtTime) -> Schedule {
        self.counted(windows, ephemeris).1
    }

    /// The present orbit, if it is one whose periapses count, and its windows.
    fn counted(
        &mut self,
        windows: &Schedule,
        ephemeris: &EphemerisAtTime,
    ) -> (Option<TwoBodyOrbit>, Schedule) {
        let orbit = ellipse_of(ephemeris).filter(|_| !windows.once);
        let schedule = orbit.map_or(windows.in_orbit(f64::INFINITY), |orbit| self.schedule(windows, &orbit));
        (orbit, schedule)
    }

    fn schedule(&mut self, windows: &Schedule, orbit: &TwoBodyOrbit) -> Schedule {
        let (nearest_s, period_s) = (orbit.periapsis_epoch_s(0), orbit.period_s());
        let first_s = *self.first_epoch_s.get_or_insert(nearest_s);
        let every = f64::from(windows.every.max(1));
        let since = ((nearest_s - first_s) / period_s).round().rem_euclid(every);
        Schedule { periapsis_s: nearest_s - since * period_s, ..windows.in_orbit(period_s) }
    }
}
