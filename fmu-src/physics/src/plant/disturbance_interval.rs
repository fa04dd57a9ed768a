//! Disturbances of an attitude that is not known ahead: force and torque over one interval of their grid, linear in time.
//!
//! Equation: T(t) = a + b (t - start) through the loads at the two nodes of Gauss-Legendre quadrature, the body taken to turn
//! on at its present rate.
//! Method: evaluated once an interval; it ends at the grid's next edge or sooner where light changes abruptly.
//! Order: the impulse over an interval has an error of h^5 as long as the body does turn on like that. A change of rate
//! within the interval of at most `a` leaves an attitude that is off by a h^2 / 2 at its end.
//! Error measure: none at run time; see the test against an interval of a tenth.
//! Reference: Davis and Rabinowitz, Methods of Numerical Integration, 2.7.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::momentum::Effort;
use crate::momentum::TorqueModel;
use crate::numerics::chebyshev::GREATEST_IN_STATE;
use crate::radiation::{Effect, ForceTorque, Loads};

use super::error::PlantError;
use super::evaluation::{Evaluation, ExternalLoad, Plant};

/// Nodes of Gauss-Legendre quadrature of order 4 on [0, 1].
const NODES: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];
/// Force and torque of every effect of the surroundings; what is applied is known at any time and kept apart.
const ROWS: usize = 2 * Effect::DISTURBANCES.len();

/// A vector that changes linearly: at the start, and per second.
pub type Linear = [Vector3<f64>; 2];

/// What acts on the body and where the Sun stands, over one interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DisturbanceInterval {
    start_s: f64,
    end_s: f64,
    /// Force and torque of effect after effect, body frame.
    loads: [Linear; ROWS],
    /// Unit vector to the Sun, EME2000.
    to_sun: Linear,
    /// Visible part of the Sun's disc, at the start and per second.
    lit_fraction: [f64; 2],
}

impl DisturbanceInterval {
    /// Before the first interval.
    pub fn before() -> Self {
        let nothing = [Vector3::zeros(); 2];
        Self {
            start_s: f64::NEG_INFINITY,
            end_s: f64::NEG_INFINITY,
            loads: [nothing; ROWS],
            to_sun: nothing,
            lit_fraction: [0.0; 2],
        }
    }

    /// The interval of `plant` that begins at `start_s` and lasts to `limit_s` at most.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn build<L: Fn(f64) -> ExternalLoad>(
        plant: &mut Plant<'_, L>,
        start_s: f64,
        limit_s: f64,
    ) -> Result<Self, PlantError> {
        plant.spend(Effort::Segment, start_s)?;
        let known_s = plant.prepare(start_s, limit_s)?;
        let end_s = plant.smooth_until(start_s, known_s);
        let span_s = end_s - start_s;
        let [first, second] = NODES.map(|node| plant.evaluate(start_s + node * span_s));
        first.check(start_s)?;
        let line = |of: &dyn Fn(&Evaluation) -> Vector3<f64>| -> Linear {
            let (a, b) = (of(&first), of(&second));
            let slope = (b - a) / (NODES[1] - NODES[0]);
            [a - slope * NODES[0], slope / span_s]
        };
        let mut loads = [[Vector3::zeros(); 2]; ROWS];
        for effect in Effect::DISTURBANCES {
            let at = 2 * effect as usize;
            loads[at] = line(&|it| it.loads[effect].force_body_n);
            loads[at + 1] = line(&|it| it.loads[effect].torque_body_n_m);
        }
        // The Sun is seen from the start on, however long the interval is.
        let begin = plant.instant(start_s);
        let (now, then) = (&begin, &second.instant);
        let elapsed_s = NODES[1] * span_s;
        let [to_sun, to_sun_then] = [now, then].map(|it| it.geometry.to_sun.position_m.normalize());
        let to_sun = [to_sun, (to_sun_then - to_sun) / elapsed_s];
        let lit_fraction = [now.lit_fraction, (then.lit_fraction - now.lit_fraction) / elapsed_s];
        Ok(Self { start_s, end_s, loads, to_sun, lit_fraction })
    }

    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        let sound = |x: &f64| x.abs() <= GREATEST_IN_STATE;
        let lines = self.loads.iter().chain([&self.to_sun]).flatten();
        let is_before = self.start_s == f64::NEG_INFINITY && self.end_s == f64::NEG_INFINITY;
        (is_before || [self.start_s, self.end_s].iter().all(sound))
            && self.start_s <= self.end_s
            && lines.flat_map(|vector| vector.iter()).chain(&self.lit_fraction).all(sound)
    }

    /// Up to when it holds, in s.
    pub fn end_s(&self) -> f64 {
        self.end_s
    }

    /// Forgets what is beyond `time_s`.
    pub fn cut(&mut self, time_s: f64) {
        self.end_s = self.end_s.min(time_s);
    }

    /// Force and torque by effect at `time_s`.
    pub fn loads_at(&self, time_s: f64) -> Loads {
        let elapsed_s = time_s - self.start_s;
        let mut loads = Loads::zero();
        for effect in Effect::DISTURBANCES {
            let at = 2 * effect as usize;
            let [force_body_n, torque_body_n_m] =
                [self.loads[at], self.loads[at + 1]].map(|[start, slope]| start + slope * elapsed_s);
            loads[effect] = ForceTorque { force_body_n, torque_body_n_m };
        }
        loads
    }

    /// Torque of an effect of the surroundings at `time_s` and its slope, in N m and N m/s.
    pub fn torque_at(&self, effect: Effect, time_s: f64) -> Linear {
        match self.loads.get(2 * effect as usize + 1) {
            Some([start, slope]) => [start + slope * (time_s - self.start_s), *slope],
            None => [Vector3::zeros(); 2],
        }
    }

    /// Sum over the effects at `time_s`: force in N and its slope in N/s, torque in N m and its slope in N m/s.
    pub fn total_at(&self, time_s: f64) -> [Linear; 2] {
        let elapsed_s = time_s - self.start_s;
        let mut total = [[Vector3::zeros(); 2]; 2];
        for (row, [start, slope]) in self.loads.iter().enumerate() {
            let [sum, sum_slope] = &mut total[row % 2];
            *sum += start + slope * elapsed_s;
            *sum_slope += slope;
        }
        total
    }

    /// Unit vector to the Sun, EME2000, and the visible part of its disc at `time_s`.
    pub fn sun_at(&self, time_s: f64) -> (Vector3<f64>, f64) {
        let elapsed_s = time_s - self.start_s;
        let to_sun = (self.to_sun[0] + self.to_sun[1] * elapsed_s).normalize();
        (to_sun, (self.lit_fraction[0] + self.lit_fraction[1] * elapsed_s).clamp(0.0, 1.0))
    }
}
