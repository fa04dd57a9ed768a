//! Temperatures that take time: each face stores heat, so that it stays warm into an eclipse.
//!
//! Every surface is one or two heat balances C dT/dt = absorbed - exchanged - given to space and bus, independent of the other surfaces.
//! They are stiff (thin layers follow their light in seconds) and are integrated by the extrapolated linearly implicit
//! Euler method (Deuflhard 1985), which damps what is fast. A step depends on its arguments only, so the temperatures
//! are all the state there is.

use nalgebra::{Matrix2, Vector2};

use super::balance::{FaceEnvironment, exchange_w_m2};
use crate::math;
use crate::spacecraft::Conduction;

/// Allowed error of one step relative to the temperature.
const TOLERANCE: f64 = 1e-9;

/// Columns of the extrapolation table: the order reached.
const MOST_COLUMNS: usize = 8;

/// How much larger than allowed the difference before may have been: two columns alone can agree by chance where they do not
/// converge yet.
const BEFORE: f64 = 30.0;

/// A step is halved at most this often.
const MOST_HALVINGS: u32 = 40;

/// Steps after which the rest is taken as one: no temperature of a spacecraft needs a tenth of them.
const MOST_STEPS: u32 = 10_000;

/// One surface that stores heat in each of its faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatStore {
    /// Surroundings of front and rear; those of the rear of a one-sided surface are not used.
    pub faces: [FaceEnvironment; 2],
    /// Heat flow between the faces.
    pub conduction: Option<Conduction>,
    /// Heat capacity of each face in J/m2/K, above 0.
    pub heat_capacity_j_m2_k: f64,
}

impl HeatStore {
    /// Temperatures `duration_s` later. `heat_w_m2` is what each face takes in at the start and at the end; in between
    /// it runs along a straight line. A one-sided surface has no heat and 0 K behind.
    ///
    /// The error stays near 1e-9 of the temperature. Without light a face cools for ever but never below 0 K.
    pub fn advance(&self, temperatures_k: [f64; 2], heat_w_m2: [[f64; 2]; 2], duration_s: f64) -> [f64; 2] {
        let [from, to] = heat_w_m2.map(Vector2::from);
        let mut temperatures_k = Vector2::from(temperatures_k);
        if !(duration_s > 0.0 && duration_s.is_finite()) {
            return temperatures_k.into();
        }
        if (temperatures_k + from + to).iter().any(|x| !x.is_finite()) {
            return [f64::NAN; 2];
        }
        let heat_at = |time_s: f64| from + (to - from) * (time_s / duration_s);
        let shortest_s = duration_s * math::powi(0.5_f64, MOST_HALVINGS as i32);
        let (mut time_s, mut step_s) = (0.0, duration_s);
        let mut steps = 0;
        while time_s < duration_s {
            steps += 1;
            if steps > MOST_STEPS {
                return self.substeps(&temperatures_k, time_s, duration_s, 1, &heat_at).into();
            }
            let last = time_s + step_s >= duration_s;
            let end_s = if last { duration_s } else { time_s + step_s };
            match self.extrapolate(&temperatures_k, time_s, end_s, &heat_at) {
                Some(next) => {
                    temperatures_k = next;
                    time_s = end_s;
                    step_s *= 2.0;
                }
                None if step_s > shortest_s => step_s = 0.5 * (end_s - time_s),
                // Beyond any physical stiffness: take the plain first-order step and continue.
                None => {
                    temperatures_k = self.substeps(&temperatures_k, time_s, end_s, 1, &heat_at);
                    time_s = end_s;
                }
            }
        }
        temperatures_k.into()
    }

    /// One step, with more and more substeps until two columns agree; `None` if they do not.
    fn extrapolate(
        &self,
        start_k: &Vector2<f64>,
        from_s: f64,
        to_s: f64,
        heat_at: &impl Fn(f64) -> Vector2<f64>,
    ) -> Option<Vector2<f64>> {
        let mut row = [Vector2::zeros(); MOST_COLUMNS];
        let mut before_k = f64::INFINITY;
        for k in 0..MOST_COLUMNS {
            let mut diagonal = self.substeps(start_k, from_s, to_s, k + 1, heat_at);
            // Aitken-Neville: row[j] holds column j of the row before.
            for (j, before) in row.iter_mut().enumerate().take(k) {
                let ratio = (k + 1) as f64 / (k - j) as f64;
                let next = diagonal + (diagonal - *before) / (ratio - 1.0);
                *before = diagonal;
                diagonal = next;
            }
            row[k] = diagonal;
            if k >= 3 {
                let error = (diagonal - row[k - 1]).amax();
                let allowed_k = TOLERANCE * diagonal.amax();
                if error <= allowed_k && before_k <= BEFORE * allowed_k && diagonal.min() >= 0.0 {
                    return Some(diagonal);
                }
                before_k = error;
            }
        }
        None
    }

    /// Linearly implicit Euler steps of equal length.
    fn substeps(
        &self,
        start_k: &Vector2<f64>,
        from_s: f64,
        to_s: f64,
        count: usize,
        heat_at: &impl Fn(f64) -> Vector2<f64>,
    ) -> Vector2<f64> {
        let step_s = (to_s - from_s) / count as f64;
        let (_, slopes) = self.outflow(start_k);
        let matrix = Matrix2::identity() + slopes * (step_s / self.heat_capacity_j_m2_k);
        let Some(inverse) = matrix.try_inverse() else { return *start_k };
        let mut temperatures_k = *start_k;
        for i in 0..count {
            let heat = heat_at(from_s + step_s * (i + 1) as f64);
            let (outflow, _) = self.outflow(&temperatures_k);
            temperatures_k += inverse * (heat - outflow) * (step_s / self.heat_capacity_j_m2_k);
        }
        temperatures_k.map(|t| t.max(0.0))
    }

    /// Heat flow out of each face in W/m2, and its slopes by the temperatures.
    fn outflow(&self, temperatures_k: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        let (front, front_slope) = self.faces[0].outflow_w_m2(temperatures_k.x);
        let (rear, rear_slope) = self.faces[1].outflow_w_m2(temperatures_k.y);
        let exchange = |link: &Conduction| exchange_w_m2(link, (*temperatures_k).into());
        let (flow, [b1, b2]) = self.conduction.as_ref().map_or((0.0, [0.0; 2]), exchange);
        (Vector2::new(front + flow, rear - flow), Matrix2::new(front_slope + b1, -b2, -b1, rear_slope + b2))
    }
}

#[cfg(test)]
mod tests;
