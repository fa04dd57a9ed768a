//! Cell of a linear model: momentum gained between two rows of a flight, and what the encounter moves by, by unit of each control.
//!
//! Both are the mean of the rows' values times the time between (trapezoid).

use nalgebra::{Matrix3, Matrix3x4, Vector3};
use physics::constants::DAY_S;

use super::{
    controls::{ALL, CONTROLS, Control},
    linear_torque::LinearTorque,
    simulated::{FlightRow, SAME_S},
    target::Moves,
    torque::SunlitSpacecraft,
    windows::{Window, WindowKind},
};

/// From one row to the next.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cell {
    /// The window that it is in.
    pub window: usize,
    /// Gained at the present controls without the correction.
    pub gain: Vector3<f64>,
    /// Momentum gained by unit of each control.
    pub by_control: [Vector3<f64>; CONTROLS],
    /// Momentum gained by the centre of mass and the scale of sunlight.
    pub by_error: Matrix3x4<f64>,
    /// Change of the target by the cell.
    pub moves: Moves,
    /// Momentum after the mission's dump in the cell, if there is one.
    pub reset: Option<Vector3<f64>>,
}

/// Force and torque and what they change by, at a row in a window.
pub(crate) struct At {
    load: LinearTorque,
    scale: f64,
    other: Vector3<f64>,
    /// Partials of the encounter by force times time.
    by_impulse: Matrix3<f64>,
}

/// Mean over a share in the alternate attitude.
struct Mean {
    torque: Vector3<f64>,
    by_control: [Vector3<f64>; CONTROLS],
    by_error: Matrix3x4<f64>,
    moves: Moves,
}

impl At {
    /// At the window's present controls; `by_impulse` is what the encounter moves by, by force times time.
    pub(crate) fn new(
        sunlit: &SunlitSpacecraft,
        row: &FlightRow,
        window: &Window,
        by_impulse: Matrix3<f64>,
    ) -> Self {
        let load = window.linearised(sunlit, row);
        Self { load, scale: sunlit.light.scale, other: row.other_torque_n_m, by_impulse }
    }

    fn mean(&self, share: f64) -> Mean {
        let (solar, by_control) = self.load.mean(share);
        let (force, force_by_control) = self.load.mean_force_n(share);
        let by_center = self.load.mean_by_center(share);
        let by_scale = if self.scale > 0.0 { solar / self.scale } else { Vector3::zeros() };
        let by_error = Matrix3x4::from_columns(&[
            by_center.column(0).into_owned(),
            by_center.column(1).into_owned(),
            by_center.column(2).into_owned(),
            by_scale,
        ]);
        let moves = Moves {
            at: self.by_impulse * force,
            by_control: force_by_control.map(|force| self.by_impulse * force),
        };
        Mean { torque: solar + self.other, by_control, by_error, moves }
    }
}

/// Instants of a programme in a window, at least.
const INSTANTS: usize = 8;
/// Windows count as no longer than this where instants are chosen, in s.
const LONGEST_WINDOW_S: f64 = 3.0 * DAY_S;
/// Instants within a window of less than a day are no closer, in s: what goes on between them is looked at all the same.
const CLOSEST_S: f64 = 8.0 * 3600.0;

/// Last rows of a programme's steps; edges of windows and resets are among them.
pub(crate) fn instants(cells: &[Cell], windows: &[Window], rows: &[FlightRow]) -> Vec<usize> {
    let mut instants = Vec::new();
    let mut since_s = rows.first().map_or(0.0, |row| row.time_s);
    for (index, cell) in cells.iter().enumerate() {
        let end_s = rows[index + 1].time_s;
        let next = cells.get(index + 1);
        let ends_window = next.is_none_or(|next| next.window != cell.window);
        let meets_reset = cell.reset.is_some() || next.is_some_and(|next| next.reset.is_some());
        let length_s = windows[cell.window].length_s();
        let mut long_s = length_s.min(LONGEST_WINDOW_S) / INSTANTS as f64;
        if length_s < DAY_S {
            long_s = long_s.max(CLOSEST_S);
        }
        if ends_window || meets_reset || end_s - since_s >= long_s - SAME_S {
            instants.push(index + 1);
            since_s = end_s;
        }
    }
    instants
}

/// From one row to the next, with the share in the alternate attitude and that by unit of its control.
pub(crate) fn cell(
    window: usize,
    of: &Window,
    rows: [&FlightRow; 2],
    at: [&At; 2],
    (share, share_by_control): (f64, f64),
) -> Cell {
    let half_s = 0.5 * (rows[1].time_s - rows[0].time_s);
    let [from, to] = at.map(|at| at.mean(share));
    let sums = |from: &[Vector3<f64>; CONTROLS], to: &[Vector3<f64>; CONTROLS]| {
        let mut sums: [Vector3<f64>; CONTROLS] = core::array::from_fn(|k| (from[k] + to[k]) * half_s);
        sums[Control::Alternate as usize] *= share_by_control;
        ALL.into_iter().filter(|it| !of.moves(*it)).for_each(|it| sums[it as usize] = Vector3::zeros());
        sums
    };
    let gain = match of.kind {
        WindowKind::Frozen => rows[1].momentum_n_m_s - rows[0].momentum_n_m_s,
        _ => (from.torque + to.torque) * half_s,
    };
    Cell {
        window,
        gain,
        by_control: sums(&from.by_control, &to.by_control),
        by_error: (from.by_error + to.by_error) * half_s,
        moves: Moves {
            at: (from.moves.at + to.moves.at) * half_s,
            by_control: sums(&from.moves.by_control, &to.moves.by_control),
        },
        reset: (rows[1].dumps != rows[0].dumps).then_some(rows[1].momentum_n_m_s),
    }
}
