//! Momentum as a function of what is fitted, from eight flights.
//!
//! Where the attitude is followed ideally, torque is a + s (b + B c) + C c with the factor s of sunlight, the centre of mass c and
//! functions of time a, b, B, C: the lever of every force is linear in c, direct sunlight in s. Momentum, its integral, is then linear
//! in each of the four while the others are held. It follows without error from flights at two values of s, each with four places of
//! the centre of mass. Only an orbit that light disturbs departs from that; a flight with the result shows by how much.

use nalgebra::{Matrix3x4, Vector3};

use super::{
    flights::{Flights, History},
    parameters::Parameters,
};
use crate::Failure;

/// Steps from the centre, far above a flight's tolerance: of the centre of mass, in m, and of the factor, as a part of it.
const CENTER_STEP_M: f64 = 0.02;
const SCALE_STEP: f64 = 0.05;
/// Flights that an expansion takes.
pub(super) const FLIGHTS: u64 = 8;

/// Values at one row, for one value of the factor: at the centre, and per metre of each component of the centre of mass.
#[derive(Clone, Copy, Debug)]
struct Affine {
    momentum_n_m_s: Vector3<f64>,
    by_center: nalgebra::Matrix3<f64>,
}

/// Momentum about a centre.
pub(super) struct Expansion {
    center: Parameters,
    scale_step: f64,
    /// By row: with the factor below and above the centre's.
    rows: Vec<[Affine; 2]>,
    /// Dumps of the flights.
    pub dumps: Vec<i32>,
}

impl Expansion {
    /// By flights about `center`; `simulated` is called after each.
    ///
    /// # Errors
    /// What ends a flight; dumps that depend on what is fitted.
    pub(super) fn about(
        flights: &dyn Flights,
        center: &Parameters,
        times_s: &[f64],
        simulated: &mut dyn FnMut(),
    ) -> Result<Self, Failure> {
        let scale_step = SCALE_STEP * center.solar_scale.abs().max(SCALE_STEP);
        let mut dumps: Option<Vec<i32>> = None;
        let mut simulate = |parameters: &Parameters| -> Result<Vec<Vector3<f64>>, Failure> {
            let History { momentum_inertial_n_m_s, dumps: seen } = flights.simulate(parameters, times_s)?;
            simulated();
            if dumps.get_or_insert_with(|| seen.clone()) != &seen {
                return Err(
                    "dumps fall at times that depend on what is fitted, allowed: scheduled ones".into()
                );
            }
            Ok(momentum_inertial_n_m_s)
        };
        let mut of_scale = |solar_scale: f64| -> Result<Vec<Affine>, Failure> {
            let at = Parameters { solar_scale, ..*center };
            let mut moved = Vec::with_capacity(3);
            let middle = simulate(&at)?;
            for axis in 0..3 {
                let step_m = Vector3::ith(axis, CENTER_STEP_M);
                let center_of_mass_body_m = at.center_of_mass_body_m + step_m;
                moved.push(simulate(&Parameters { center_of_mass_body_m, ..at })?);
            }
            let row = |(row, momentum_n_m_s): (usize, Vector3<f64>)| {
                let by = |axis: usize| (moved[axis][row] - momentum_n_m_s) / CENTER_STEP_M;
                let by_center = nalgebra::Matrix3::from_columns(&[by(0), by(1), by(2)]);
                Affine { momentum_n_m_s, by_center }
            };
            Ok(middle.into_iter().enumerate().map(row).collect())
        };
        let below = of_scale(center.solar_scale - scale_step)?;
        let above = of_scale(center.solar_scale + scale_step)?;
        let rows = below.into_iter().zip(above).map(|(below, above)| [below, above]).collect();
        Ok(Self { center: *center, scale_step, rows, dumps: dumps.unwrap_or_default() })
    }

    /// Momentum of each row, EME2000, in N m s, and its derivatives by the parameters in their order.
    pub(super) fn at(&self, parameters: &Parameters) -> impl Iterator<Item = (Vector3<f64>, Matrix3x4<f64>)> {
        let off_m = parameters.center_of_mass_body_m - self.center.center_of_mass_body_m;
        let off_scale = (parameters.solar_scale - self.center.solar_scale) / self.scale_step;
        let weights = [0.5 * (1.0 - off_scale), 0.5 * (1.0 + off_scale)];
        self.rows.iter().map(move |rows| {
            let values = rows.map(|row| row.momentum_n_m_s + row.by_center * off_m);
            let momentum = values[0] * weights[0] + values[1] * weights[1];
            let by_center = rows[0].by_center * weights[0] + rows[1].by_center * weights[1];
            let by_scale = (values[1] - values[0]) / (2.0 * self.scale_step);
            let [x, y, z] = [0, 1, 2].map(|axis| by_center.column(axis).into_owned());
            (momentum, Matrix3x4::from_columns(&[x, y, z, by_scale]))
        })
    }
}
