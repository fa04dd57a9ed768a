//! What a window's controls do is what flights with other controls differ by.

use std::{cell::Cell, rc::Rc};

use nalgebra::{Rotation3, Unit, Vector3};

use super::*;
use crate::flyby::test_flight::{DAY_S, Intercept, LONG_S, Leg, force_model, packed};
use crate::momentum::{
    controls::{CONTROLS, Control, Controls},
    simulated::FlightRow,
    test_spacecraft::sunlit,
    torque::Attitude,
    windows::WindowKind,
};

const DEG: f64 = core::f64::consts::PI / 180.0;
const STEPS: [f64; CONTROLS] = [0.2 * DEG, 0.2 * DEG, 0.2 * DEG, 0.2 * DEG, 0.05, 0.2 * DEG, 0.2 * DEG];

fn window(start_s: f64, controls: Controls) -> Window {
    let stop_s = start_s + 3.0 * DAY_S;
    Window {
        start_s,
        stop_s,
        kind: WindowKind::Free,
        command: None,
        free_of_contact: vec![[start_s, stop_s]],
        bounds: [[-1.0, 1.0], [-0.1, 0.1], [-0.2, 0.2], [-0.2, 0.2], [0.0, 0.5], [-0.2, 0.2], [-0.2, 0.2]],
        places: Vec::new(),
        offsets_rad: [0.0, 1.0],
        baseline_rad: 0.0,
        sides: vec![1.0, -1.0],
        controls,
    }
}

/// A leg on which light acts in the window alone, with the controls that are put.
fn leg(window: &Window) -> (Leg, Rc<Cell<Option<Controls>>>) {
    let put = Rc::new(Cell::new(Some(window.controls)));
    let (sunlit, span_s, controls) = (sunlit([0.0; 3]), [window.start_s, window.stop_s], Rc::clone(&put));
    let law = move |at_s: f64, row: &FlightRow| match controls.get() {
        Some(controls) if (span_s[0]..=span_s[1]).contains(&at_s) => {
            let of = |controls: &Controls| {
                sunlit.linearised(row, Attitude::Downlink, controls).mean_force_n(0.0).0
            };
            let share = controls.get(Control::Alternate);
            let half_turn =
                Rotation3::from_axis_angle(&Unit::new_normalize(row.to_sun_m), core::f64::consts::PI);
            of(&controls) * (1.0 - share) + half_turn * of(&controls.alternate()) * share
        }
        _ => Vector3::zeros(),
    };
    (Leg::new(Box::new(law), true), put)
}

#[test]
fn controls_of_a_window_move_the_encounter_as_flights_show() {
    let controls = Controls([35.0 * DEG, 1.0 * DEG, 2.0 * DEG, -DEG, 0.3, 2.0 * DEG, -DEG]);
    let window = window(102.0 * DAY_S, controls);
    let (mut leg, put) = leg(&window);
    let start = leg.start();
    let about = leg.intercept(start, 0.0, LONG_S);
    let flight = leg.recorded(start, about.z);
    let sensitivity = Sensitivity::new(&flight, &force_model(), &sunlit([0.0; 3])).unwrap();
    let found = lead_by_windows(&sensitivity, &sunlit([0.0; 3]), &flight, std::slice::from_ref(&window));
    let row = flight.rows.iter().find(|row| row.time_s == window.start_s).unwrap();
    let state = packed(&row.motion.unwrap().from_sun);
    let mut intercept = |controls: Option<Controls>| -> Intercept {
        put.set(controls);
        let behind = leg.propagated(state, [window.start_s, window.stop_s]);
        leg.intercept(behind, window.stop_s, about.z)
    };
    for (index, step) in STEPS.into_iter().enumerate() {
        let of = |sign: f64| {
            Some(Controls(core::array::from_fn(|it| {
                controls.0[it] + if it == index { sign * step } else { 0.0 }
            })))
        };
        let expected = (intercept(of(1.0)) - intercept(of(-1.0))) / (2.0 * step);
        let partials = found[0].by_control[index];
        let [off, size] = [partials - expected, expected].map(|it| it.xy().norm());
        // Windmilling turns the panels against each other: both parts, each half of the offset's, cancel to a hundredth. Flights follow
        // VSOP87's Mercury, the model one that its own list of bodies pulls: a few millionths of each part.
        let parts = 0.5 * found[0].by_control[Control::Offset as usize].xy().norm();
        let cancelled = if index == Control::Windmill as usize { 5e-6 * parts } else { 0.0 };
        assert!(off < (1e-4 * size).max(cancelled), "{index}: {off} of {size} m");
        assert!((partials.z - expected.z).abs() < 1e-4 * expected.z.abs() + 1e-3, "{index}");
    }
    let by_light = intercept(Some(controls)) - intercept(None);
    let off_m = (found[0].at - by_light).xy().norm();
    assert!(off_m < 1e-3 * by_light.xy().norm() && by_light.xy().norm() > 1e4, "{off_m} {by_light}");
}
