//! Changes of an encounter by the controls of windows.
//!
//! Equation: d(B.T, B.R, arrival) = integral of L_v(t) da(t) dt over the window, L_v the partials by velocity, a = F / m the acceleration
//! by sunlight, da that by offset, windmill, place of the Sun or the share of the alternate attitude.
//! Method: cells of the linear model between the rows of the flight, with rows at all edges.
//! Error: of rows an hour apart 1e-5 of the window's (tested); to the first order in the control.

use nalgebra::Matrix3;

use super::sensitivity::Sensitivity;
use crate::momentum::{
    cell::{At, cell},
    simulated::{FlightRow, SAME_S, SimulatedFlight},
    target::Moves,
    torque::SunlitSpacecraft,
    windows::Window,
};

/// Returns the partials of every window; `flight`, whose sensitivities they are, has the geometry and the mass.
pub fn lead_by_windows(
    sensitivity: &Sensitivity,
    sunlit: &SunlitSpacecraft,
    flight: &SimulatedFlight,
    windows: &[Window],
) -> Vec<Moves> {
    let epoch_s = sensitivity.encounter.epoch_s;
    let edges_s: Vec<f64> = windows.iter().flat_map(Window::edges_s).chain([epoch_s]).collect();
    let with_edges = flight.with_rows_at(&edges_s);
    let rows = &with_edges.rows;
    let by_impulse = |row: &FlightRow| {
        let motion = row.motion.as_ref();
        motion.map_or_else(Matrix3::zeros, |it| sensitivity.by_velocity(row.time_s) / it.mass_kg)
    };
    let of = |window: &Window| {
        let from = rows.partition_point(|row| row.time_s < window.start_s - SAME_S);
        let to = rows.partition_point(|row| row.time_s <= window.stop_s.min(epoch_s) + SAME_S);
        let mut sum = Moves::default();
        for pair in rows.get(from..to).unwrap_or_default().windows(2) {
            let share = window.alternate_at(0.5 * (pair[0].time_s + pair[1].time_s));
            let pair = [&pair[0], &pair[1]];
            let [from, to] = pair.map(|row| At::new(sunlit, row, window, by_impulse(row)));
            sum += cell(0, window, pair, [&from, &to], share).moves;
        }
        sum
    };
    windows.iter().map(of).collect()
}

#[cfg(test)]
mod tests;
