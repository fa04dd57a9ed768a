//! Cost of a miss: the manoeuvre behind an encounter that leads back to where the nominal flight is at a later date.
//!
//! Equation: a miss shifts the place at the epoch of osculation by dr, at which B is off by it and the arrival is not; by the transition
//! matrix from there the state at the manoeuvre is off by (dr', dv'), and the manoeuvre is -dv' - R_v^-1 R_r dr', R the matrix from there
//! to the date.
//! Method: transition matrices along the nominal path, propagated by n bodies through the encounter; light behind it is left out, which
//! changes partials by 1e-5.
//! Error: of the second order in the miss, by its share of B.
//! Reference: paper 003 gives no definition of its penalty; this one is that of a trajectory that must be met again.

use nalgebra::{Matrix3, Matrix3x2, Matrix6x2, Vector3};

use super::{encounter::PredictedPath, flight::ForceModel, sensitivity::Sensitivity};

/// Manoeuvre by miss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MissCost {
    /// By B.T and B.R, EME2000, in m/s a m.
    pub by_miss_1_s: Matrix3x2<f64>,
}

impl MissCost {
    /// With the manoeuvre at one time of the flight, behind the encounter, and the date at another, behind that.
    ///
    /// # Errors
    /// Times in another order, a nominal path that cannot be propagated.
    pub fn new(
        sensitivity: &Sensitivity,
        force_model: &ForceModel,
        [manoeuvre_s, date_s]: [f64; 2],
    ) -> Result<Self, String> {
        let encounter = &sensitivity.encounter;
        if !(encounter.time_s < manoeuvre_s && manoeuvre_s < date_s) {
            return Err(format!(
                "the manoeuvre behind the encounter at {} s: found it at {manoeuvre_s} s for {date_s} s, allowed: one after the \
                 other",
                encounter.time_s
            ));
        }
        let by_place = encounter.at_epoch_partials.fixed_columns::<3>(0).into_owned();
        let place_by_miss =
            by_place.try_inverse().ok_or("the encounter: its partials by the place have no inverse")?;
        let mut shift = Matrix6x2::zeros();
        shift.fixed_view_mut::<3, 2>(0, 0).copy_from(&place_by_miss.fixed_columns::<2>(0));
        let nominal = PredictedPath { light_m_s2: Vector3::zeros(), ..encounter.predicted_path(force_model) };
        let (to_manoeuvre, state) = nominal.over(manoeuvre_s)?;
        let (to_date, _) = PredictedPath { start_s: manoeuvre_s, state, ..nominal }.over(date_s)?;
        let off = to_manoeuvre * shift;
        let block = |column: usize| to_date.fixed_view::<3, 3>(0, column).into_owned();
        let back: Matrix3<f64> = block(3)
            .try_inverse()
            .ok_or("the date: no velocity at the manoeuvre leads to every place there")?;
        let [place, velocity] = [0, 3].map(|row| off.fixed_rows::<3>(row).into_owned());
        Ok(Self { by_miss_1_s: -velocity - back * block(0) * place })
    }
}

#[cfg(test)]
mod tests;
