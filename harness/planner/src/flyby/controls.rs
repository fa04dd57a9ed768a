//! What the controls of windows change at an encounter.
//!
//! Equation: d(B.T, B.R, arrival) = integral of L_v(t) da(t) dt over the window, L_v the partials by velocity, a = F / m the acceleration
//! by sunlight, da that by offset, windmill, place of the Sun or the share of the alternate attitude.
//! Method: trapezoid between the rows of the flight, with rows at all edges.
//! Error: of rows an hour apart 1e-5 of the window's (tested); to the first order in the control.

use nalgebra::Vector3;

use super::sensitivity::Sensitivity;
use crate::momentum::{
    simulated::{FlightRow, SAME_S, SimulatedFlight},
    torque::{CONTROLS, Control, SunlitSpacecraft},
    windows::Window,
};

/// What one window changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimByWindow {
    /// B.T (m), B.R (m) and arrival (s) by every control, by rad or share; nothing where its bounds leave no choice.
    pub by_control: [Vector3<f64>; CONTROLS],
    /// What its sunlight as it stands does to them.
    pub by_light: Vector3<f64>,
}

/// Rates of it at a time, by s.
type Rates = (Vector3<f64>, [Vector3<f64>; CONTROLS]);

/// For every window of a flight that sensitivities are of; `flight` has the geometry and the mass.
pub fn aim_by_windows(
    sensitivity: &Sensitivity,
    sunlit: &SunlitSpacecraft,
    flight: &SimulatedFlight,
    windows: &[Window],
) -> Vec<AimByWindow> {
    let edges = |window: &Window| {
        let inside = window.free_of_contact.iter().flatten().copied();
        inside.chain([window.start_s, window.stop_s]).collect::<Vec<f64>>()
    };
    let epoch_s = sensitivity.encounter.epoch_s;
    let edges: Vec<f64> = windows.iter().flat_map(edges).chain([epoch_s]).collect();
    let with_edges = flight.with_rows_at(&edges);
    let rows = &with_edges.rows;
    let of = |window: &Window| {
        let middle_s = |pair: &[FlightRow]| 0.5 * (pair[0].time_s + pair[1].time_s);
        let from = rows.partition_point(|row| row.time_s < window.start_s - SAME_S);
        let to = rows.partition_point(|row| row.time_s <= window.stop_s.min(epoch_s) + SAME_S);
        let mut sum = AimByWindow { by_control: [Vector3::zeros(); CONTROLS], by_light: Vector3::zeros() };
        for pair in rows.get(from..to).unwrap_or_default().windows(2) {
            let share = window.alternate_at(middle_s(pair));
            let half_s = 0.5 * (pair[1].time_s - pair[0].time_s);
            for row in pair {
                let (by_light, by_control) = rates(sensitivity, sunlit, row, window, share);
                sum.by_light += by_light * half_s;
                sum.by_control.iter_mut().zip(by_control).for_each(|(sum, rate)| *sum += rate * half_s);
            }
        }
        sum
    };
    windows.iter().map(of).collect()
}

/// At a row, with this share of the alternate attitude and that by unit of the window's.
fn rates(
    sensitivity: &Sensitivity,
    sunlit: &SunlitSpacecraft,
    row: &FlightRow,
    window: &Window,
    (share, share_by_control): (f64, f64),
) -> Rates {
    let Some(motion) = &row.motion else { return (Vector3::zeros(), [Vector3::zeros(); CONTROLS]) };
    let by_force = sensitivity.by_velocity(row.time_s) / motion.mass_kg;
    let (force_n, mut by_control) = window.linearised(sunlit, row).mean_force_n(share);
    by_control[Control::Alternate as usize] *= share_by_control;
    for (by, [low, high]) in by_control.iter_mut().zip(window.bounds) {
        *by = if low < high { by_force * *by } else { Vector3::zeros() };
    }
    (by_force * force_n, by_control)
}
