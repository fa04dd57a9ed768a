//! What goes in comes out, warm faces warm their backs, and limits known by heart are met.

use approx::assert_relative_eq;
use proptest::prelude::*;

use super::*;
use crate::numerics::scalar::Dual64;
use crate::spacecraft::Honeycomb;

const SIGMA: f64 = STEFAN_BOLTZMANN_W_M2_K4;

fn link(conductance_w_m2_k: f64, radiative_exchange: f64) -> Conduction {
    Conduction { conductance_w_m2_k, radiative_exchange }
}

/// In space without a temperature, insulated from the bus: as in the paper.
fn in_the_cold(emission: Emission) -> FaceEnvironment {
    FaceEnvironment { emission, background_k: 0.0, bus: BusLink::NONE }
}

fn emissions() -> impl Strategy<Value = Emission> {
    (0.02..1.0_f64, -1e-4..3e-4_f64).prop_map(|(emissivity, slope)| Emission {
        // Falling emissivities stay high enough to have one answer.
        emissivity: if slope < 0.0 { emissivity.max(0.5) } else { emissivity },
        slope_per_k: slope,
        reference_temperature_k: 300.0,
    })
}

#[test]
fn a_face_at_room_temperature_radiates_its_textbook_power() {
    let (black, slope) = exitance_w_m2(&Emission::constant(1.0), 300.0);
    assert_relative_eq!(black, 459.3, max_relative = 1e-4);
    assert_relative_eq!(slope, 4.0 * black / 300.0, max_relative = 1e-14);
    // The Sun at 1 AU on a black insulated plate: 394 K.
    let plate = face_temperature_k(&in_the_cold(Emission::constant(1.0)), 1361.0);
    assert_relative_eq!(plate, 393.6, max_relative = 1e-3);
}

#[test]
fn strong_conduction_makes_faces_equal_and_weak_leaves_them_alone() {
    let emission = [Emission::constant(0.75), Emission::constant(0.7)];
    let heat = [7000.0, 100.0];
    let [front, rear] = conducting_temperatures_k(&emission.map(in_the_cold), &link(1e9, 0.0), heat);
    let together = (7100.0 / (1.45 * SIGMA)).powf(0.25);
    assert_relative_eq!(front, together, max_relative = 1e-7);
    assert_relative_eq!(rear, together, max_relative = 1e-7);
    let [front, rear] = conducting_temperatures_k(&emission.map(in_the_cold), &link(1e-12, 0.0), heat);
    assert_relative_eq!(front, (7000.0 / (0.75 * SIGMA)).powf(0.25), max_relative = 1e-9);
    assert_relative_eq!(rear, (100.0 / (0.7 * SIGMA)).powf(0.25), max_relative = 1e-9);
}

/// Radiation between the faces alone is linear in the fourth powers: solved by hand.
#[test]
fn radiative_exchange_alone_has_a_closed_form() {
    let (e1, e2, h) = (0.8, 0.6, 0.11);
    let emission = [Emission::constant(e1), Emission::constant(e2)];
    let [front, rear] = conducting_temperatures_k(&emission.map(in_the_cold), &link(0.0, h), [5000.0, 0.0]);
    // (e1 + h) x1 - h x2 = 5000 / sigma, (e2 + h) x2 = h x1
    let x1 = 5000.0 / SIGMA / (e1 + h - h * h / (e2 + h));
    assert_relative_eq!(front.powi(4), x1, max_relative = 1e-11);
    assert_relative_eq!(rear.powi(4), h * x1 / (e2 + h), max_relative = 1e-11);
}

#[test]
fn no_heat_is_absolute_zero() {
    let emission = [Emission::constant(0.8); 2];
    assert_eq!(
        conducting_temperatures_k(&emission.map(in_the_cold), &link(18.0, 0.11), [0.0, 0.0]),
        [0.0, 0.0]
    );
    assert_eq!(face_temperature_k(&in_the_cold(emission[0]), 0.0), 0.0);
}

#[test]
fn a_honeycomb_has_the_papers_conduction() {
    let aluminium = Honeycomb {
        conductivity_w_m_k: 120.0,
        thickness_m: 0.02,
        wall_area_ratio: 0.01,
        packing_factor: 0.9,
        internal_emissivity: 0.2,
    };
    let conduction = aluminium.conduction();
    assert_relative_eq!(conduction.conductance_w_m2_k, 54.0, max_relative = 1e-14);
    assert_relative_eq!(conduction.radiative_exchange, 0.11, max_relative = 1e-14);
}

proptest! {
    #[test]
    fn energy_balances_close(
        front in emissions(), rear in emissions(), q in 0.0..200.0_f64, h in 1e-6..1.0_f64,
        heats in prop::array::uniform2(0.0..15000.0_f64),
    ) {
        let emission = [front, rear];
        let link = link(q, h);
        let temperatures_k = conducting_temperatures_k(&emission.map(in_the_cold), &link, heats);
        let (flow, _) = exchange_w_m2(&link, temperatures_k);
        let radiated = [0, 1].map(|i| exitance_w_m2(&emission[i], temperatures_k[i]).0);
        let total = heats[0] + heats[1];
        prop_assert!((heats[0] - flow - radiated[0]).abs() <= 1e-9 * total);
        prop_assert!((heats[1] + flow - radiated[1]).abs() <= 1e-9 * total);
        let alone = face_temperature_k(&in_the_cold(front), heats[0]);
        prop_assert!((exitance_w_m2(&front, alone).0 - heats[0]).abs() <= 1e-9 * heats[0]);
    }

    #[test]
    fn derivatives_are_slopes(
        front in emissions(), rear in emissions(), q in 0.0..200.0_f64, h in 1e-3..1.0_f64,
        heats in prop::array::uniform2(10.0..15000.0_f64),
    ) {
        let emission = [front, rear];
        let link = link(q, h);
        // The emissivities change too, each in its own direction.
        const BY_HEAT: [f64; 2] = [3e-6, -2e-6];
        let faces = emission.map(in_the_cold);
        let at = |x: f64| {
            let mut faces = faces;
            faces.iter_mut().zip(BY_HEAT).for_each(|(face, by_heat)| face.emission.emissivity += by_heat * x);
            conducting_temperatures_k(&faces, &link, [heats[0] + x, heats[1] - 0.3 * x])
        };
        let seeded = [Dual64::new(heats[0], 1.0), Dual64::new(heats[1], -0.3)];
        let mut changing = faces.map(|face| face.map(Dual64::from_re));
        changing.iter_mut().zip(BY_HEAT).for_each(|(face, by_heat)| face.emission.emissivity.eps = by_heat);
        let exact = conducting_temperatures_k(&changing, &link, seeded);
        let step = 1e-4 * heats[0].min(heats[1]);
        // The slope is discontinuous where an emissivity reaches 1.
        let slopes = |x: f64| [0, 1].map(|i| emission[i].at(at(x)[i]).1);
        prop_assume!(slopes(step) == slopes(-step));
        for i in 0..2 {
            let slope = (at(step)[i] - at(-step)[i]) / (2.0 * step);
            let scale = exact[0].eps.abs() + exact[1].eps.abs();
            prop_assert!((slope - exact[i].eps).abs() < 1e-6 * scale, "{slope} {}", exact[i].eps);
            prop_assert!((exact[i].re - at(0.0)[i]).abs() <= 1e-12 * exact[i].re);
        }
    }
}

/// Sunlight on a plate that conducts heat to the bus, with T and everything else chosen: what conductance closes the balance
/// is arithmetic.
#[test]
fn a_plate_on_a_bus_has_the_temperature_its_balance_was_made_for() {
    let (emissivity, expected_k, bus_k, background_k, heat) = (0.8, 310.0_f64, 280.0, 60.0_f64, 900.0);
    let radiated = emissivity * SIGMA * (expected_k.powi(4) - background_k.powi(4));
    let conductance_w_m2_k = (heat - radiated) / (expected_k - bus_k);
    assert!(conductance_w_m2_k > 10.0);
    let face = FaceEnvironment {
        emission: Emission::constant(emissivity),
        background_k,
        bus: BusLink { conductance_w_m2_k, temperature_k: bus_k },
    };
    assert_relative_eq!(face_temperature_k(&face, heat), expected_k, max_relative = 1e-13);
    // In the dark the bus keeps it warm: between the two it is where both flows are equal.
    let dark_k = face_temperature_k(&face, 0.0);
    let from_bus = conductance_w_m2_k * (bus_k - dark_k);
    let to_space = emissivity * SIGMA * (dark_k.powi(4) - background_k.powi(4));
    assert!(dark_k > 250.0 && dark_k < bus_k);
    assert_relative_eq!(from_bus, to_space, max_relative = 1e-11);
}

#[test]
fn without_light_a_face_has_the_temperature_of_space_or_between_it_and_the_bus() {
    let face = |conductance_w_m2_k, temperature_k| FaceEnvironment {
        emission: Emission::constant(0.8),
        background_k: 2.725,
        bus: BusLink { conductance_w_m2_k, temperature_k },
    };
    let (alone, held) = (face(0.0, 290.0), face(1e9, 290.0));
    assert_eq!(face_temperature_k(&alone, 0.0), 2.725);
    assert_relative_eq!(face_temperature_k(&held, 0.0), 290.0, max_relative = 1e-6);
    assert_eq!(conducting_temperatures_k(&[alone; 2], &link(18.0, 0.11), [0.0; 2]), [2.725; 2]);
    let [front, rear] = conducting_temperatures_k(&[held, alone], &link(1e6, 0.0), [0.0; 2]);
    assert_relative_eq!(front, 290.0, max_relative = 1e-5);
    assert_relative_eq!(rear, 290.0, max_relative = 1e-3);
    // A bus as cold as space takes no part in what is absolutely cold.
    let cold = FaceEnvironment { background_k: 0.0, ..face(5.0, 0.0) };
    assert_eq!(face_temperature_k(&cold, 0.0), 0.0);
    assert_eq!(conducting_temperatures_k(&[cold; 2], &link(18.0, 0.11), [0.0; 2]), [0.0; 2]);
}

proptest! {
    /// What comes in goes out: to space, to the bus, through the structure; and derivatives are slopes.
    #[test]
    fn energy_balances_close_with_space_and_bus(
        emissions in [emissions(), emissions()], q in 0.0..200.0_f64, h in 1e-6..1.0_f64,
        heats in prop::array::uniform2(0.0..15000.0_f64), background_k in 0.0..200.0_f64,
        conductances in prop::array::uniform2(1e-3..500.0_f64), buses_k in prop::array::uniform2(50.0..500.0_f64),
    ) {
        let faces = [0, 1].map(|i| FaceEnvironment {
            emission: emissions[i],
            background_k,
            bus: BusLink { conductance_w_m2_k: conductances[i], temperature_k: buses_k[i] },
        });
        let link = link(q, h);
        let found_k = conducting_temperatures_k(&faces, &link, heats);
        let (flow, _) = exchange_w_m2(&link, found_k);
        for (i, through) in [flow, -flow].into_iter().enumerate() {
            let radiated = exitance_w_m2(&emissions[i], found_k[i]).0
                - emissions[i].at(found_k[i]).0 * SIGMA * background_k.powi(4);
            let to_bus = conductances[i] * (found_k[i] - buses_k[i]);
            let scale = heats[0] + heats[1] + conductances[i] * buses_k[i] + radiated.abs() + flow.abs();
            prop_assert!((heats[i] - through - radiated - to_bus).abs() <= 1e-9 * scale, "{found_k:?}");
        }
        let constant = faces.map(|face| face.map(Dual64::from_re));
        let seeded = conducting_temperatures_k(&constant, &link, [Dual64::new(heats[0], 1.0), Dual64::new(heats[1], -0.3)]);
        let step = 1e-2;
        let at = |x: f64| conducting_temperatures_k(&faces, &link, [heats[0] + step + x, heats[1] + step - 0.3 * x]);
        let here = conducting_temperatures_k(
            &constant,
            &link,
            [Dual64::new(heats[0] + step, 1.0), Dual64::new(heats[1] + step, -0.3)],
        );
        prop_assert!(seeded.iter().all(|it| it.eps.is_finite()));
        for i in 0..2 {
            let slope = (at(step)[i] - at(-step)[i]) / (2.0 * step);
            let scale = here[0].eps.abs() + here[1].eps.abs();
            prop_assert!((slope - here[i].eps).abs() < 1e-5 * scale, "{slope} {}", here[i].eps);
        }
    }
}
