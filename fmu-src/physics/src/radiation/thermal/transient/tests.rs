//! Cooling has a closed form, energy is kept, and cutting a step changes nothing beyond the tolerance.

use approx::assert_relative_eq;
use proptest::prelude::*;

use super::*;
use crate::constants::STEFAN_BOLTZMANN_W_M2_K4;
use crate::radiation::thermal::balance::{conducting_temperatures_k, exitance_w_m2};
use crate::spacecraft::{BusLink, Emission};

fn in_the_cold(emissivity: f64) -> FaceEnvironment {
    FaceEnvironment { emission: Emission::constant(emissivity), background_k: 0.0, bus: BusLink::NONE }
}

fn panel() -> HeatStore {
    HeatStore {
        faces: [in_the_cold(0.75), in_the_cold(0.7)],
        conduction: Some(Conduction { conductance_w_m2_k: 18.0, radiative_exchange: 0.11 }),
        heat_capacity_j_m2_k: 3500.0,
    }
}

fn blanket(heat_capacity_j_m2_k: f64) -> HeatStore {
    HeatStore { faces: [in_the_cold(0.7), in_the_cold(0.0)], conduction: None, heat_capacity_j_m2_k }
}

/// dT/dt = -eps sigma T^4 / C gives 1/T^3 = 1/T0^3 + 3 eps sigma t / C.
#[test]
fn a_face_in_the_dark_cools_by_the_closed_form() {
    for (capacity, seconds) in [(3500.0, 10.0), (3500.0, 3600.0), (40.0, 3600.0), (1.0, 86_400.0)] {
        let [found, behind] = blanket(capacity).advance([450.0, 0.0], [[0.0; 2]; 2], seconds);
        let cubed = 450_f64.powi(-3) + 3.0 * 0.7 * STEFAN_BOLTZMANN_W_M2_K4 * seconds / capacity;
        assert_relative_eq!(found, cubed.powf(-1.0 / 3.0), max_relative = 1e-8);
        assert_eq!(behind, 0.0);
    }
}

#[test]
fn after_long_the_temperatures_are_those_of_balance() {
    let (panel, heat) = (panel(), [9000.0, 400.0]);
    let found = panel.advance([200.0, 350.0], [heat, heat], 1e6);
    let link = panel.conduction.unwrap();
    let balanced = conducting_temperatures_k(&panel.faces, &link, heat);
    assert_relative_eq!(found[0], balanced[0], max_relative = 1e-8);
    assert_relative_eq!(found[1], balanced[1], max_relative = 1e-8);
}

/// Energy stored = energy in - energy out, the latter summed by Simpson's rule over many short steps.
#[test]
fn stored_heat_is_what_came_in_less_what_went_out() {
    let (panel, seconds, steps) = (panel(), 600.0, 600);
    let heat = |t: f64| [9000.0 - 12.0 * t, 300.0 + t];
    let outflow = |t: [f64; 2]| {
        exitance_w_m2(&panel.faces[0].emission, t[0]).0 + exitance_w_m2(&panel.faces[1].emission, t[1]).0
    };
    let start = [330.0, 300.0];
    let (mut temperatures, mut stored, step) = (start, 0.0, seconds / f64::from(steps));
    for i in 0..steps {
        let at = step * f64::from(i);
        let middle = panel.advance(temperatures, [heat(at), heat(at + step / 2.0)], step / 2.0);
        let end = panel.advance(middle, [heat(at + step / 2.0), heat(at + step)], step / 2.0);
        let inflow: f64 = heat(at + step / 2.0).iter().sum();
        let out = (outflow(temperatures) + 4.0 * outflow(middle) + outflow(end)) / 6.0;
        stored += (inflow - out) * step;
        temperatures = end;
    }
    let expected = start[0] + start[1] + stored / panel.heat_capacity_j_m2_k;
    assert_relative_eq!(temperatures[0] + temperatures[1], expected, max_relative = 1e-8);
    let at_once = panel.advance(start, [heat(0.0), heat(seconds)], seconds);
    assert_relative_eq!(at_once[0], temperatures[0], max_relative = 1e-8);
    assert_relative_eq!(at_once[1], temperatures[1], max_relative = 1e-8);
}

/// dT/dt = -(g/C) (T - T_bus) where next to nothing is radiated: an exponential; and in the dark of space without a bus a face
/// comes to its temperature and no lower.
#[test]
fn bus_and_space_draw_temperatures_to_their_own() {
    let (conductance_w_m2_k, bus_k, capacity, seconds) = (5.0, 280.0, 3500.0, 900.0);
    let mut plate = blanket(capacity);
    plate.faces[0].emission = Emission::constant(1e-12);
    plate.faces[0].bus = BusLink { conductance_w_m2_k, temperature_k: bus_k };
    let [found, _] = plate.advance([150.0, 0.0], [[0.0; 2]; 2], seconds);
    let expected = bus_k + (150.0 - bus_k) * (-conductance_w_m2_k * seconds / capacity).exp();
    assert_relative_eq!(found, expected, max_relative = 1e-9);
    let mut plate = blanket(1.0);
    plate.faces[0].background_k = 90.0;
    for from_k in [40.0, 450.0] {
        let [found, _] = plate.advance([from_k, 0.0], [[0.0; 2]; 2], 1e8);
        assert_relative_eq!(found, 90.0, max_relative = 1e-7);
    }
    // With light, bus and space after long: the balance.
    let mut whole = panel();
    for (face, bus_k) in whole.faces.iter_mut().zip([300.0, 250.0]) {
        face.background_k = 60.0;
        face.bus = BusLink { conductance_w_m2_k: 12.0, temperature_k: bus_k };
    }
    let found = whole.advance([200.0, 350.0], [[2000.0, 100.0]; 2], 1e6);
    let balanced = conducting_temperatures_k(&whole.faces, &whole.conduction.unwrap(), [2000.0, 100.0]);
    assert_relative_eq!(found[0], balanced[0], max_relative = 1e-8);
    assert_relative_eq!(found[1], balanced[1], max_relative = 1e-8);
}

/// Two columns that agree by chance once were taken for converged ones here, 1.4e-7 of the temperature apart.
#[test]
fn columns_that_agree_by_chance_are_not_taken() {
    let store = HeatStore { heat_capacity_j_m2_k: 298.16, ..panel() };
    let (from, to, seconds) = ([11_426.0, 4_075.0], [2_505.0, 8_322.0], 3_565.9);
    let heat = |t: f64| [0, 1].map(|i| from[i] + (to[i] - from[i]) * t / seconds);
    let whole = store.advance([0.0, 433.5], [from, to], seconds);
    let mut found = [0.0, 433.5];
    for k in 0..400 {
        let [start, end] = [k, k + 1].map(|k| f64::from(k) * seconds / 400.0);
        found = store.advance(found, [heat(start), heat(end)], end - start);
    }
    assert_relative_eq!(whole[0], found[0], max_relative = 1e-8);
    assert_relative_eq!(whole[1], found[1], max_relative = 1e-8);
}

#[test]
fn a_step_of_no_length_changes_nothing() {
    for seconds in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(panel().advance([300.0, 200.0], [[1.0; 2]; 2], seconds), [300.0, 200.0]);
    }
}

#[test]
fn impossible_temperatures_and_heat_end_soon() {
    for wrong in [f64::NAN, f64::INFINITY] {
        assert!(panel().advance([wrong, 300.0], [[1.0; 2]; 2], 600.0)[0].is_nan());
        assert!(panel().advance([300.0; 2], [[1.0; 2], [wrong, 0.0]], 600.0)[0].is_nan());
    }
    for hot_k in [1e9, 1e60, 1e300] {
        // What is still a number cools, or is given up, but never for ever.
        let found = panel().advance([hot_k, 300.0], [[1.0; 2]; 2], 600.0);
        assert!(found[0].is_nan() || found[0] <= hot_k, "{found:?}");
    }
}

proptest! {
    #[test]
    fn cutting_a_step_changes_nothing(
        start in prop::array::uniform2(0.0..700.0_f64), heat in prop::array::uniform4(0.0..12_000.0_f64),
        capacity in 1.0..2e4_f64, seconds in 0.1..5000.0_f64, cut in 0.05..0.95_f64,
    ) {
        let store = HeatStore { heat_capacity_j_m2_k: capacity, ..panel() };
        let (from, to) = ([heat[0], heat[1]], [heat[2], heat[3]]);
        let middle = [0, 1].map(|i| from[i] + (to[i] - from[i]) * cut);
        let whole = store.advance(start, [from, to], seconds);
        let half = store.advance(start, [from, middle], seconds * cut);
        let cut = store.advance(half, [middle, to], seconds * (1.0 - cut));
        for i in 0..2 {
            prop_assert!((whole[i] - cut[i]).abs() <= 1e-7 * whole[i].max(cut[i]), "{whole:?} {cut:?}");
        }
    }
}
