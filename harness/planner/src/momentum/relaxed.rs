//! Relaxed programmes, for bounds from below: what one of them cannot keep, no plan on the baseline keeps.
//!
//! The torque of a window departs from the linear model by no more than at the ends, middles and combinations of its controls' ranges; that
//! is a free control of the programme. Nothing is left as a guard. Where a window alternates, its share alone is known and not when it
//! turns, so it is judged where it ends.

use nalgebra::Vector3;

use super::{
    controls::{ALL, ALTERNATE_PLACE, Control, Controls},
    program::{Begin, Program},
    simulated::{FlightRow, SimulatedFlight},
    torque::SunlitSpacecraft,
    windows::{Window, WindowKind},
};

/// Place of a step of a programme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    /// Its window.
    pub window: usize,
    /// Whether it begins the window.
    pub begins: bool,
    /// Whether it ends the window.
    pub ends: bool,
    /// In s.
    pub duration_s: f64,
}

/// By how much each component of the torque of every window departs from the linear model at most, in N m.
pub(super) fn departures_n_m(
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    windows: &[Window],
) -> Vec<Vector3<f64>> {
    let of_window = |window: &Window| {
        let rows: Vec<&FlightRow> = simulated.within([window.start_s, window.stop_s]).collect();
        if window.kind == WindowKind::Frozen || rows.is_empty() {
            return Vector3::zeros();
        }
        let [first, middle, last] = [0, rows.len() / 2, rows.len() - 1].map(|at| rows[at]);
        let of_row = |row: &FlightRow| departure_n_m(sunlit, row, window);
        of_row(first).sup(&of_row(middle)).sup(&of_row(last))
    };
    windows.iter().map(of_window).collect()
}

fn departure_n_m(sunlit: &SunlitSpacecraft, row: &FlightRow, window: &Window) -> Vector3<f64> {
    let linear = window.linearised(sunlit, row);
    let (present_n_m, by_control) = linear.mean(window.controls.get(Control::Alternate));
    let mut all = vec![Controls::default()];
    for control in ALL {
        let [low, high] = window.bounds[control as usize];
        let is_of_alternate = control == Control::Alternate || ALTERNATE_PLACE.contains(&control);
        let values = match (window.moves(control), is_of_alternate) {
            (false, _) => vec![low],
            (true, true) => vec![low, high],
            (true, false) => vec![low, 0.5 * (low + high), high],
        };
        let with = |controls: &Controls| -> Vec<Controls> {
            values.iter().map(|value| controls.with(control, *value)).collect()
        };
        all = all.iter().flat_map(with).collect();
    }
    all.iter().fold(Vector3::zeros(), |most, controls| {
        let torque_n_m = |controls: &Controls| sunlit.torque_n_m(row, window.attitude(), controls);
        let normal_n_m = torque_n_m(controls);
        let other_n_m = if window.is_apart() { torque_n_m(&controls.alternate()) } else { normal_n_m };
        let mean_n_m = linear.mixed_n_m(normal_n_m, other_n_m, controls.get(Control::Alternate));
        let by_model = ALL.iter().fold(present_n_m, |sum, control| {
            sum + by_control[*control as usize] * (controls.get(*control) - window.controls.get(*control))
        });
        most.sup(&(mean_n_m - by_model).abs())
    })
}

/// Lets windows depart from the model, and judges those that alternate where they end; others than the judged are allowed `unjudged` more.
pub(super) fn relax(
    program: &mut Program,
    placed: &[Placed],
    windows: &[Window],
    departures_n_m: &[Vector3<f64>],
    unjudged_n_m_s: f64,
) {
    let first = program.bounds.len();
    program.bounds.extend(departures_n_m.iter().flat_map(|most| most.iter().map(|most| [-most, *most])));
    let mut is_interrupted = false;
    for (step, placed) in program.steps.iter_mut().zip(placed) {
        let alternates = windows[placed.window].moves(Control::Alternate);
        if placed.begins {
            is_interrupted = false;
        } else if alternates && step.begin != Begin::Follows {
            // What is left of its alternation is not known.
            (is_interrupted, step.begin) = (true, Begin::Free);
        }
        if is_interrupted {
            step.drift = Vector3::zeros();
            step.terms.clear();
        } else if !departures_n_m.is_empty() {
            let axes = 0..3;
            step.terms.extend(
                axes.map(|axis| (first + 3 * placed.window + axis, Vector3::ith(axis, placed.duration_s))),
            );
        }
        if alternates && !placed.ends {
            step.limit += unjudged_n_m_s;
        }
    }
}
