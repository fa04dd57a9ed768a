//! Planet light, recoil, stored heat and self-shadowing inside the momentum plant: cut and restored to the bit through
//! eclipses, equal to the memoryless model at every communication point, cooling by the closed form in the dark.

use models::{DisturbanceTorque, MomentumPlant};
use nalgebra::Vector3;
use physics::constants::STEFAN_BOLTZMANN_W_M2_K4;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing, assert_same};
use super::spacecraft::RADIATING;

const DAY_S: f64 = 86_400.0;
/// Faces of the spacecraft: shade front and rear, radiator, plate far away, inner panel front and rear, outer panel.
const FACES: usize = 7;
const RADIATOR: usize = 3;

pub(crate) const EFFECTS: &[(&str, f64)] =
    &[("planetLight.enabled", 1.0), ("thermal.enabled", 1.0), ("shadowing.enabled", 1.0)];

/// Orbits that pass through the planet's shadow.
pub(crate) const SHADOWED: &[(&str, f64)] =
    &[("ephemeris.source", 2.0), ("ephemeris.trueAnomaly", 1.7), ("orbit.frame", 1.0)];

/// Everything else that divides a flight into pieces.
pub(crate) const BUSY: &[(&str, f64)] = &[
    ("orbit.dynamics", 2.0),
    ("guided.slewRate", 3e-3),
    ("guided.downlinkEvery", 1.0),
    ("dump.threshold[1]", 0.02),
    ("dump.threshold[2]", 0.02),
    ("dump.threshold[3]", 0.02),
];

pub(crate) fn radiating<M: fmi_export::Model>() -> NamedModel<M> {
    NamedModel::with("radiating.toml", RADIATING)
}

#[test]
fn neither_cuts_nor_saving_change_a_bit() {
    let named = radiating::<MomentumPlant>();
    let (mut shaded, mut dumps, mut felt) = (0, 0, [0; 3]);
    let initialize = || named.initialize(0.0, &[EFFECTS, SHADOWED, BUSY].concat()).unwrap();
    let ends_s = (1..=48).map(|half_hour| 1800.0 * f64::from(half_hour));
    assert_cuts_change_nothing(initialize, ends_s, &[130.0, 60.0, 97.3], |flight| {
        shaded += i32::from(flight.real("sun.litFraction") == 0.0);
        dumps = flight.integer("dump.count");
        for (count, name) in felt.iter_mut().zip(["torque.albedo", "torque.infrared", "torque.thermal"]) {
            *count += i32::from(flight.vector(name).norm() > 1e-8);
        }
        // A panel that turns cuts segments, in all alike.
        flight.set("panel[1].angle", (flight.time_s() / 5400.0).floor() * 0.04);
    });
    assert!(shaded > 0 && dumps > 3 && felt.iter().all(|&count| count > 20), "{shaded} {dumps} {felt:?}");
}

/// The memoryless model at the plant's own Sun, planet and panels.
pub(crate) fn memoryless<'a>(
    named: &'a NamedModel<DisturbanceTorque>,
    plant: &NamedInstance<'_, MomentumPlant>,
    sets: &[(&str, f64)],
) -> NamedInstance<'a, DisturbanceTorque> {
    let to_body = plant.to_inertial("attitude.q").inverse();
    let position_m = plant.vector("position");
    let mut all: Vec<(String, f64)> = sets.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let mut put = |name: &str, vector: Vector3<f64>| {
        all.extend((0..3).map(|i| (format!("{name}[{}]", i + 1), vector[i])));
    };
    put("sun.positionBody", to_body * -plant.vector("heliocentric.position"));
    put("planet.positionBody", to_body * -position_m);
    all.extend(
        (1..=2).map(|k| (format!("panel[{k}].angle"), plant.real(&format!("panel[{k}].angleActual")))),
    );
    let all: Vec<(&str, f64)> = all.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    named.initialize(0.0, &[EFFECTS, &all].concat()).unwrap()
}

#[test]
fn in_balance_every_source_is_that_of_the_memoryless_model() {
    let plants = radiating::<MomentumPlant>();
    let models = radiating::<DisturbanceTorque>();
    let sets = [EFFECTS, SHADOWED, &[("thermal.storage", 0.0), ("solar.flux", 1365.0)]].concat();
    let mut plant = plants.initialize(0.0, &sets).unwrap();
    let (mut shaded, mut worst) = (0, 0.0_f64);
    while plant.time_s() < DAY_S / 2.0 {
        plant.step_to(plant.time_s() + 61.7).unwrap();
        let lit = plant.real("sun.litFraction");
        shaded += i32::from(lit == 0.0);
        let model = memoryless(&models, &plant, &[("solar.flux", 1365.0)]);
        let scale_n = 1e-6 + model.vector("force.total").norm();
        for source in ["solar", "albedo", "infrared", "thermal"] {
            for (what, arm_m) in [("force", 1.0), ("torque", 1.0)] {
                let name = format!("{what}.{source}");
                let apart = (plant.vector(&name) - model.vector(&name)).norm() / (scale_n * arm_m);
                worst = worst.max(apart);
                // The tolerance is for the last term of a cell; kinks within its shortest cells come on top.
                assert!(apart < 2e-4, "{name} at {} s: {apart:e}", plant.time_s());
            }
        }
    }
    assert!(shaded > 5 && worst > 1e-9, "{shaded} {worst:e}");
}

#[test]
fn momentum_does_not_depend_on_how_light_is_resolved() {
    let named = radiating::<MomentumPlant>();
    let simulated = |step_s: f64, tolerance: f64| {
        let solver = [("solver.disturbanceStep", step_s), ("solver.disturbanceTolerance", tolerance)];
        let mut plant = named.initialize(0.0, &[EFFECTS, SHADOWED, &solver].concat()).unwrap();
        plant.step_to(DAY_S).unwrap();
        plant.vector("momentum.inertial")
    };
    let fine = simulated(60.0, 1e-9);
    for (step_s, tolerance, allowed) in [(600.0, 1e-5, 2e-5), (3600.0, 1e-5, 2e-5), (300.0, 1e-7, 2e-6)] {
        let apart = (simulated(step_s, tolerance) - fine).norm() / fine.norm();
        assert!(apart < allowed, "{step_s} {tolerance} {apart:e}");
    }
}

#[test]
fn in_the_dark_a_radiator_cools_by_the_closed_form() {
    let named = radiating::<MomentumPlant>();
    let mut plant = named.initialize(0.0, &[&[("thermal.enabled", 1.0)], SHADOWED].concat()).unwrap();
    let kelvin =
        |plant: &NamedInstance<'_, MomentumPlant>| plant.real(&format!("plate[{RADIATOR}].temperature"));
    plant.step_to(3.0 * 3600.0).unwrap();
    assert_eq!(plant.real("sun.litFraction"), 1.0);
    while plant.real("sun.litFraction") > 0.0 {
        plant.step_to(plant.time_s() + 30.0).unwrap();
    }
    let (from_s, from_k) = (plant.time_s(), kelvin(&plant));
    assert!(from_k > 250.0, "{from_k}");
    let mut compared = 0;
    loop {
        plant.step_to(plant.time_s() + 30.0).unwrap();
        if plant.real("sun.litFraction") > 0.0 {
            break;
        }
        // dT/dt = -eps sigma T^4 / C gives 1/T^3 = 1/T0^3 + 3 eps sigma t / C.
        let cooled = 3.0 * 0.8 * STEFAN_BOLTZMANN_W_M2_K4 * (plant.time_s() - from_s) / 4000.0;
        let expected_k = (from_k.powi(-3) + cooled).powf(-1.0 / 3.0);
        let found_k = kelvin(&plant);
        assert!((found_k / expected_k - 1.0).abs() < 2e-5, "{found_k} {expected_k}");
        compared += 1;
    }
    assert!(compared > 20 && kelvin(&plant) < from_k - 40.0, "{compared} {}", kelvin(&plant));
}

#[test]
fn what_ends_a_cell_changes_stored_heat_by_no_more_than_the_tolerance() {
    let named = radiating::<MomentumPlant>();
    let sets = [EFFECTS, SHADOWED].concat();
    let mut still = named.initialize(0.0, &sets).unwrap();
    let mut disturbed = named.initialize(0.0, &sets).unwrap();
    let mut steps = 0;
    while still.time_s() < DAY_S / 2.0 {
        let end_s = still.time_s() + 77.0;
        steps += 1;
        // Not used with this ephemeris; it moves nothing but ends every current cell.
        disturbed.set("sun.position[1]", f64::from(steps));
        still.step_to(end_s).unwrap();
        disturbed.step_to(end_s).unwrap();
        for face in 1..=FACES {
            let name = format!("plate[{face}].temperature");
            let (a, b) = (still.real(&name), disturbed.real(&name));
            assert!((a - b).abs() < 3e-5 * a.max(100.0), "{name} at {end_s} s: {a} {b}");
        }
    }
    let (a, b) = (still.vector("momentum.inertial"), disturbed.vector("momentum.inertial"));
    assert!((a - b).norm() < 2e-5 * a.norm(), "{a} {b}");
}

#[test]
fn a_torque_from_outside_leaves_light_and_heat_alone() {
    let named = radiating::<MomentumPlant>();
    let sets = [EFFECTS, SHADOWED].concat();
    let mut still = named.initialize(0.0, &sets).unwrap();
    let mut pushed = named.initialize(0.0, &sets).unwrap();
    let mut relay = named.initialize(0.0, &sets).unwrap();
    for step in 1..=600 {
        for flight in [&mut pushed, &mut relay] {
            flight.set("torque.applied[2]", 1e-7 * f64::from(step));
        }
        // Whether a cell continues must not depend on what is not saved.
        relay = relay.restored();
        for flight in [&mut still, &mut pushed, &mut relay] {
            flight.step_to(f64::from(step) * 50.0).unwrap();
        }
        assert_same(&pushed, &relay);
        for name in ["force.thermal", "torque.infrared", "plate[3].force"] {
            assert_eq!(still.vector(name), pushed.vector(name), "{name}");
        }
    }
}

#[test]
fn faces_add_up_to_the_total_and_a_panel_left_out_has_none() {
    let named = radiating::<MomentumPlant>();
    for panel_on in [1.0, 0.0] {
        let sets = [EFFECTS, SHADOWED, &[("panel[1].enabled", panel_on)]].concat();
        let mut plant = named.initialize(0.0, &sets).unwrap();
        for _ in 0..100 {
            plant.step_to(plant.time_s() + 211.0).unwrap();
            let forces: Vec<Vector3<f64>> =
                (1..=FACES).map(|k| plant.vector(&format!("plate[{k}].force"))).collect();
            let total = plant.vector("force.total");
            let sum: Vector3<f64> = forces.iter().sum();
            assert!((sum - total).norm() < 2e-4 * (1e-6 + total.norm()), "{sum} {total}");
            let inner = forces[4].norm() + forces[5].norm();
            assert_eq!(inner > 0.0, panel_on > 0.0);
            assert!(forces[6].norm() > 0.0 || plant.real("sun.litFraction") < 1.0);
        }
    }
}

#[test]
fn effects_that_are_off_are_zero_and_change_nothing() {
    let named = radiating::<MomentumPlant>();
    let mut bare = named.initialize(0.0, &[("planetLight.enabled", 0.0)]).unwrap();
    let mut odd = named
        .initialize(
            0.0,
            &[("solver.disturbanceStep", 7.0), ("thermal.storage", 0.0), ("planet.emissivity", 0.1)],
        )
        .unwrap();
    for _ in 0..50 {
        bare.step_to(bare.time_s() + 600.0).unwrap();
        odd.step_to(odd.time_s() + 600.0).unwrap();
        for name in ["torque.albedo", "force.infrared", "force.thermal"] {
            assert_eq!(bare.vector(name), Vector3::zeros());
        }
        assert_eq!(bare.vector("momentum.inertial"), odd.vector("momentum.inertial"));
    }
}

#[test]
fn impossible_settings_are_refused_by_name() {
    let named = radiating::<MomentumPlant>();
    let sets =
        [("planetLight.enabled", 1.0), ("planet.absorptivity", 0.9), ("planet.diffuseReflectivity", 0.2)];
    let failure = named.refusal(&sets);
    assert!(failure.contains("planet.*") && failure.contains("1.1"), "{failure}");
}

#[test]
fn a_flight_that_ends_in_the_planet_says_where() {
    let named = radiating::<MomentumPlant>();
    let place = |position_m: f64, velocity_m_s: f64| {
        let state =
            [("orbit.source", 2.0), ("orbit.position[1]", position_m), ("orbit.velocity[2]", velocity_m_s)];
        named.initialize(0.0, &[EFFECTS, &state].concat())
    };
    let text = place(1e6, 3000.0).err().unwrap().to_string();
    assert!(
        text.contains("1000000") && text.contains("more than its radius") && text.contains("orbit.*"),
        "{text}"
    );
    // Falls from 10,000 km: it is simulated while it is above the surface, and no cell ahead ends it early.
    let mut falling = place(1e7, 100.0).unwrap();
    let failure = loop {
        match falling.step_to(falling.time_s() + 5.0) {
            Ok(()) => assert!(falling.vector("position").norm() > 2.4394e6),
            Err(failure) => break failure.to_string(),
        }
    };
    assert!(
        falling.vector("position").norm() < 2.4394e6 + 5.0 * 2_000.0,
        "{}",
        falling.vector("position").norm()
    );
    assert!(failure.contains("inside the planet") || failure.contains("more than its radius"), "{failure}");
}

#[test]
fn the_scale_of_sunlight_is_one_of_its_force_and_not_of_its_heat() {
    let named = radiating::<MomentumPlant>();
    for effects in [EFFECTS, &[]] {
        let undumped =
            ["dump.threshold[1]", "dump.threshold[2]", "dump.threshold[3]"].map(|name| (name, 1e6));
        let sets = [effects, SHADOWED, &undumped, &[("attitude.source", 2.0)]].concat();
        let mut plain = named.initialize(0.0, &sets).unwrap();
        let mut scaled = named.initialize(0.0, &[&sets, [("solar.scale", 2.0)].as_slice()].concat()).unwrap();
        let mut shaded = 0;
        for k in 1..=60 {
            let at_s = 301.0 * f64::from(k);
            if k == 40 {
                // Twice from here on by a change on the way.
                plain.set("solar.scale", 3.0);
                scaled.set("solar.scale", 6.0);
            }
            plain.step_to(at_s).unwrap();
            scaled.step_to(at_s).unwrap();
            // Which intervals are halved goes by the momentum's size.
            let integrated = plain.real("solver.disturbanceTolerance");
            for (name, allowed) in
                [("torque.solar", 1e-12), ("force.solar", 1e-12), ("momentum.solar", integrated)]
            {
                let [once, twice] = [plain.vector(name), scaled.vector(name)];
                assert!(
                    (twice - once * 2.0).norm() <= allowed * twice.norm(),
                    "{name} at {at_s} s: {twice} {once}"
                );
            }
            for source in ["albedo", "infrared", "thermal", "gravityGradient"] {
                let name = format!("torque.{source}");
                assert_eq!(plain.vector(&name), scaled.vector(&name), "{name} at {at_s} s");
            }
            for face in 1..=FACES {
                let name = format!("plate[{face}].temperature");
                assert_eq!(plain.real(&name), scaled.real(&name), "{name} at {at_s} s");
            }
            let total = scaled.vector("force.total") - plain.vector("force.total");
            assert!((total - plain.vector("force.solar")).norm() <= 1e-12 * total.norm());
            let of_faces = |flight: &NamedInstance<'_, MomentumPlant>| -> Vector3<f64> {
                (1..=FACES).map(|face| flight.vector(&format!("plate[{face}].force"))).sum()
            };
            let more = of_faces(&scaled) - of_faces(&plain);
            assert!((more - total).norm() < 2e-4 * (1e-6 + total.norm()), "{more} {total}");
            shaded += i32::from(plain.real("sun.litFraction") < 1.0);
        }
        assert!(plain.vector("torque.solar").norm() > 1e-7 && shaded < 60);
    }
}
