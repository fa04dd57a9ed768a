//! The orbit phase from where the spacecraft is: windows of science and downlink after the periapses of its present orbit.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::attitudes::LinesOfSight;
use super::guided::{Guided, GuidedAttitude};
use super::moving::{MovingVector, rate, value};
use super::schedule::{Schedule, Window};
use super::surroundings::Surroundings;
use crate::attitude::MovingUnit;
use crate::environment::CartesianState;
use crate::environment::orbit::TwoBodyOrbit;

/// The periapsis from which downlinks are counted; that of the orbit on which counting began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeriapsisCount {
    first_epoch_s: Option<f64>,
}

impl PeriapsisCount {
    /// Whether its number can come from a flight.
    pub fn is_sound(&self) -> bool {
        self.first_epoch_s.is_none_or(f64::is_finite)
    }

    /// The attitude of the orbit phase. Periapsis and period of `law` are replaced by those of the orbit that position and
    /// velocity give; between disturbed orbits the count goes on. Where a slew begins the spacecraft stood on that orbit, and
    /// Sun and Earth moved evenly since.
    pub fn attitude(&mut self, law: &Guided, surroundings: &Surroundings) -> GuidedAttitude {
        let (orbit, schedule) = self.counted(&law.schedule, surroundings);
        let (epoch_s, now) = (surroundings.epoch_s, lines_of_sight(surroundings));
        Guided { schedule, ..*law }.at(epoch_s, |at_s| match orbit {
            Some(orbit) if at_s != epoch_s => {
                lines_of_sight(&surroundings.moved_to(at_s, &orbit.state_at(at_s)))
            }
            _ => now,
        })
    }

    /// What is being done, and until when, in s past J2000 TDB.
    pub fn window(&mut self, windows: &Schedule, surroundings: &Surroundings) -> Window {
        let (_, schedule) = self.counted(windows, surroundings);
        schedule.window(surroundings.epoch_s)
    }

    /// The present orbit, if it is one whose periapses count, and its windows.
    fn counted(
        &mut self,
        windows: &Schedule,
        surroundings: &Surroundings,
    ) -> (Option<TwoBodyOrbit>, Schedule) {
        let epoch_s = surroundings.epoch_s;
        let state = CartesianState {
            position_m: value(&surroundings.position),
            velocity_m_s: value(&surroundings.velocity),
        };
        let orbit = TwoBodyOrbit::from_state(&state, surroundings.planet.gm_m3_s2, epoch_s).ok();
        let orbit = orbit.filter(|orbit| orbit.period_s().is_finite());
        let orbit = orbit.filter(|_| !windows.once);
        let schedule = orbit
            .map_or(Schedule { period_s: f64::INFINITY, ..*windows }, |orbit| self.schedule(windows, &orbit));
        (orbit, schedule)
    }

    fn schedule(&mut self, windows: &Schedule, orbit: &TwoBodyOrbit) -> Schedule {
        let (nearest_s, period_s) = (orbit.periapsis_epoch_s(0), orbit.period_s());
        let first_s = *self.first_epoch_s.get_or_insert(nearest_s);
        let every = f64::from(windows.every.max(1));
        let since = ((nearest_s - first_s) / period_s).round().rem_euclid(every);
        Schedule { periapsis_s: nearest_s - since * period_s, period_s, ..*windows }
    }
}

/// Directions from the spacecraft with their rates; a body at zero distance counts as lying toward +X.
fn lines_of_sight(surroundings: &Surroundings) -> LinesOfSight {
    let unit = |vector: &MovingVector| {
        MovingUnit::of(value(vector), rate(vector))
            .unwrap_or(MovingUnit { direction: Vector3::x(), rate_1_s: Vector3::zeros() })
    };
    LinesOfSight {
        sun: unit(&surroundings.to_sun()),
        planet: Some(unit(&surroundings.to_planet())),
        earth: unit(&surroundings.to_earth()),
        sun_from_planet: Some(CartesianState {
            position_m: value(&surroundings.sun),
            velocity_m_s: rate(&surroundings.sun),
        }),
    }
}
