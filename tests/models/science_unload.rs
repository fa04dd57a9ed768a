//! Science off-pointed to unload momentum (`guided.scienceUnload`): where Sun and nadir stand, what becomes of the momentum, and that
//! both models choose alike.

use models::{DisturbanceTorque, Guidance, MomentumPlant};
use nalgebra::{UnitQuaternion, Vector3};

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const HOUR_S: f64 = 3600.0;
const DAY_S: f64 = 24.0 * HOUR_S;

type Plant<'m> = NamedInstance<'m, MomentumPlant>;
type Sets = Vec<(&'static str, f64)>;

const UNLOAD: &[(&str, f64)] = &[("guided.scienceUnload", 1.0), ("momentum.strategy", 2.0)];

/// Light on the shade alone, the centre of mass off its middle; nothing dumps.
const SPACECRAFT: &[(&str, f64)] = &[
    ("panel[1].enabled", 0.0),
    ("panel[2].enabled", 0.0),
    ("spacecraft.centerOfMass[1]", 0.004),
    ("spacecraft.centerOfMass[3]", 0.03),
    ("dump.threshold[1]", 1e6),
    ("dump.threshold[2]", 1e6),
    ("dump.threshold[3]", 1e6),
];

fn with(lists: &[&[(&'static str, f64)]]) -> Sets {
    lists.concat()
}

fn sun_place(flight: &NamedInstance<'_, impl fmi_export::Model>) -> [f64; 2] {
    ["sun.azimuth", "sun.elevation"].map(|name| flight.real(name))
}

/// The Earth stands in the antennas' plane.
fn in_downlink(flight: &Plant<'_>) -> bool {
    flight.real("earth.elevation").abs() < 1e-9
}

fn off(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

#[test]
fn a_spacecraft_that_stands_still_ends_science_at_its_target() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let target = Vector3::new(0.1, 5.0, -0.05);
    // Nadir beyond the camera's range, and within it.
    for position in ["orbit.position[1]", "orbit.position[2]"] {
        for convention in [1.0, 2.0] {
            for axes in [1.0, 2.0, 3.0] {
                let sets = [
                    ("orbit.source", 3.0),
                    (position, 1e7),
                    ("orbit.velocity[3]", 1e3),
                    ("ephemeris.source", 3.0),
                    ("sun.position[1]", -4.0e10),
                    ("sun.position[2]", 2.0e10),
                    ("sun.position[3]", 1.0e10),
                    ("earth.position[1]", 1.5e11),
                    ("earth.position[3]", 3e10),
                    ("gravityGradient.enabled", 0.0),
                    ("eclipse.method", 4.0),
                    ("guided.downlinkReference", 2.0),
                    ("guided.downlinkStart", 8.0 * HOUR_S),
                    ("guided.downlinkEnd", 16.0 * HOUR_S),
                    ("start.momentum[1]", 0.4),
                    ("start.momentum[2]", -0.1),
                    ("start.momentum[3]", -0.3),
                    ("spacecraft.centerOfMass[3]", 0.02),
                    ("momentum.convention", convention),
                    ("momentum.targetAxes", axes),
                    ("momentum.target[1]", target.x),
                    ("momentum.target[2]", target.y),
                    ("momentum.target[3]", target.z),
                ];
                let mut flight = named.initialize(0.0, &with(&[&sets, UNLOAD])).unwrap();
                let place = sun_place(&flight);
                assert!(place.iter().any(|it| it.abs() > 0.01) && !flight.boolean("momentum.targetClamped"));
                flight.step_to(8.0 * HOUR_S - 1e-6).unwrap();
                assert!(off(sun_place(&flight), place) < 1e-12);
                let wrong = flight.vector("momentum.body") - target;
                let wrong = match axes as i32 {
                    1 => wrong.x.abs(),
                    2 => wrong.z.abs(),
                    _ => wrong.xz().amax(),
                };
                assert!(wrong < 1e-9, "{position} {convention} {axes}: {wrong:e}");
                assert!(flight.real("keepIn.margin") > -1e-9);
            }
        }
    }
}

#[test]
fn a_body_that_turns_under_its_momentum_ends_science_at_its_target() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = [
        ("gravityGradient.enabled", 0.0),
        ("eclipse.method", 4.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", 6.0 * HOUR_S),
        ("guided.downlinkEnd", 14.0 * HOUR_S),
        ("start.momentum[1]", 0.05),
        ("start.momentum[3]", -0.04),
    ];
    let [unloaded, left] = [1.0, 0.0].map(|unload| {
        let choice = [("guided.scienceUnload", unload), ("momentum.strategy", 2.0)];
        let mut flight = named.initialize(0.0, &with(&[SPACECRAFT, &sets, &choice])).unwrap();
        assert!(!flight.boolean("momentum.targetClamped"));
        flight.simulate_to(6.0 * HOUR_S - 1e-3, 600.0).unwrap();
        flight.vector("momentum.body").xz().norm()
    });
    println!("left at the end: {unloaded:e}, without unloading {left:e}");
    // What the quadrature leaves of some tenths of a N m s that light adds and takes.
    assert!(unloaded < 1e-4 && left > 0.02, "{unloaded:e} {left:e}");
}

/// Least and greatest of X and Z over ten days, and the flight.
fn ten_days<'m>(named: &'m NamedModel<MomentumPlant>, sets: &[(&'static str, f64)]) -> (f64, Plant<'m>) {
    let mut flight = named.initialize(0.0, sets).unwrap();
    let mut largest = 0.0_f64;
    while flight.time_s() < 10.0 * DAY_S {
        let end_s = flight.time_s() + HOUR_S;
        flight.step_to(end_s).unwrap();
        largest = largest.max(flight.vector("momentum.body").xz().amax());
    }
    (largest, flight)
}

#[test]
fn ten_days_keep_a_smaller_momentum() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for convention in [1.0, 2.0] {
        for strategy in [2.0, 3.0] {
            let [with_it, without] = [1.0, 0.0].map(|unload| {
                let choice = [
                    ("guided.scienceUnload", unload),
                    ("momentum.strategy", strategy),
                    ("momentum.convention", convention),
                ];
                ten_days(&named, &with(&[SPACECRAFT, &choice])).0
            });
            println!("{convention} {strategy}: {with_it} with, {without} without");
            assert!(with_it < without, "{convention} {strategy}: {with_it} {without}");
        }
    }
}

#[test]
fn the_torque_is_what_a_memoryless_model_finds_with_the_sun_there() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let text = <MomentumPlant as fmi_export::Model>::DEFAULT_SETUP;
    let memoryless = NamedModel::<DisturbanceTorque>::with("messenger.toml", text);
    let mut flight = named.initialize(0.0, &with(&[&SPACECRAFT[2..], UNLOAD])).unwrap();
    let (mut science, mut places) = (0, Vec::new());
    while flight.time_s() < 4.0 * DAY_S {
        let end_s = flight.time_s() + 1000.0;
        flight.step_to(end_s).unwrap();
        if in_downlink(&flight) || flight.real("sun.litFraction") < 1.0 {
            continue;
        }
        science += 1;
        let [azimuth_rad, elevation_rad] = sun_place(&flight);
        if !places.iter().any(|place| off(*place, [azimuth_rad, elevation_rad]) < 1e-12) {
            places.push([azimuth_rad, elevation_rad]);
        }
        let (sin_a, cos_a) = azimuth_rad.sin_cos();
        let (sin_e, cos_e) = elevation_rad.sin_cos();
        let sun = Vector3::new(cos_e * sin_a, -cos_e * cos_a, -sin_e) * flight.real("sun.distance");
        let mut sets = with(&[&SPACECRAFT[2..4]]);
        sets.extend([
            ("sun.positionBody[1]", sun.x),
            ("sun.positionBody[2]", sun.y),
            ("sun.positionBody[3]", sun.z),
            ("panel[1].angle", flight.real("panel[1].angleActual")),
            ("panel[2].angle", flight.real("panel[2].angleActual")),
        ]);
        let alone = memoryless.initialize(0.0, &sets).unwrap().vector("torque.solar");
        let found = flight.vector("torque.solar");
        assert!((found - alone).norm() < 1e-12 * alone.norm(), "{end_s}: {found} {alone}");
    }
    // One place for each part of science.
    assert!(science > 100 && (4..=6).contains(&places.len()), "{science} {places:?}");
}

/// Inputs by which Guidance knows the plant's position.
fn places(plant: &Plant<'_>) -> Vec<(String, f64)> {
    let vectors = ["position", "velocity", "momentum.body"].into_iter().flat_map(|name| {
        let value = plant.vector(name);
        (0..3).map(move |i| (format!("{name}[{}]", i + 1), value[i]))
    });
    let q = (1..=4).map(|i| (format!("estimate.q[{i}]"), plant.real(&format!("attitude.q[{i}]"))));
    vectors.chain(q).collect()
}

const SAMPLED: &[(&str, f64)] =
    &[("pointing.scenario", 10.0), ("hotPole.enabled", 0.0), ("monitor.enabled", 0.0)];

#[test]
fn guidance_turns_the_camera_to_nadir_and_simulates_the_plants_attitude() {
    let (plants, guidances) = (NamedModel::<MomentumPlant>::shipped(), NamedModel::<Guidance>::shipped());
    let reported =
        with(&[&SPACECRAFT[..4], UNLOAD, &[("momentum.convention", 2.0), ("solar.fixedPressure", 1.0)]]);
    let start =
        [("start.momentum[1]", 0.3), ("start.momentum[3]", 0.2), ("guided.downlinkStart", 23.0 * HOUR_S)];
    let more = [("guided.downlinkEnd", 23.5 * HOUR_S)];
    let mut plant = plants.initialize(0.0, &with(&[&reported, &start, &more])).unwrap();
    let at_start = places(&plant);
    let mut sets = with(&[&reported, SAMPLED, &start[2..], &more]);
    sets.extend(at_start.iter().map(|(name, value)| (&**name, *value)));
    let mut guidance = guidances.initialize(0.0, &sets).unwrap();
    let place = sun_place(&plant);
    assert!(place[0].abs() > 0.01 && place[1].abs() > 0.01, "{place:?}");
    let (mut kept, mut at_bound) = (0, 0);
    while plant.time_s() < 22.0 * HOUR_S {
        places(&plant).iter().for_each(|(name, value)| guidance.set(name, *value));
        let time_s = plant.time_s();
        guidance.step_to(time_s + 1e-10).unwrap();
        let (simulated, commanded) = (plant.to_inertial("attitude.q"), guidance.to_inertial("command.q"));
        let turn_rad = simulated.angle_to(&commanded);
        assert!(turn_rad < 1e-12, "{turn_rad:e} at {time_s} s");
        assert!(off(sun_place(&plant), place) < 1e-12);
        let angle_rad = guidance.real("gimbal.angle");
        let camera = commanded * Vector3::new(0.0, -angle_rad.sin(), angle_rad.cos());
        let nadir = -plant.vector("position").normalize();
        if guidance.boolean("gimbal.inRange") {
            kept += 1;
            assert!((camera - nadir).norm() < 1e-12, "{} at {time_s} s", (camera - nadir).norm());
        } else {
            at_bound += 1;
            let degrees = angle_rad.to_degrees();
            assert!((degrees - 40.0).abs() < 1e-9 || (degrees + 50.0).abs() < 1e-9, "{degrees}");
            // The other bound, and a turn about the Sun line either way, are farther off.
            let sun = plant.vector("sun.positionInertial") - plant.vector("position");
            for turn_rad in [-0.01, 0.01] {
                let turn = UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(sun), turn_rad);
                assert!((turn * camera).dot(&nadir) < camera.dot(&nadir));
            }
        }
        assert_eq!(guidance.boolean("target.reachable"), guidance.boolean("gimbal.inRange"));
        plant.step_to(time_s + 120.0).unwrap();
        guidance.step_to(time_s + 120.0).unwrap();
    }
    println!("in range {kept}, at a bound {at_bound}");
    assert!(kept > 100 && at_bound > 0, "{kept} {at_bound}");
}

#[test]
fn a_sample_in_science_chooses_what_a_plant_chooses() {
    let (plants, guidances) = (NamedModel::<MomentumPlant>::shipped(), NamedModel::<Guidance>::shipped());
    for strategy in [2.0, 3.0] {
        for convention in [1.0, 2.0] {
            let choice = [
                ("momentum.convention", convention),
                ("momentum.strategy", strategy),
                ("guided.scienceUnload", 1.0),
                ("solar.fixedPressure", 1.0),
                ("dump.threshold[1]", 4.0),
                ("dump.threshold[2]", 4.0),
                ("dump.threshold[3]", 4.0),
                // One an orbit: a guidance that begins late counts from its own nearest periapsis.
                ("guided.downlinkEvery", 1.0),
                ("guided.downlinkEnd", 5.1 * HOUR_S),
            ];
            let reported = with(&[&SPACECRAFT[..4], &choice]);
            let alone = [("gravityGradient.enabled", 0.0), ("eclipse.method", 4.0)];
            let mut plant = plants.initialize(0.0, &with(&[&reported, &alone])).unwrap();
            let (mut worst_rad, mut largest_rad) = (0.0_f64, 0.0_f64);
            for cycle in 0..8 {
                plant.step_to(5.1 * HOUR_S + f64::from(cycle) * 12.0 * HOUR_S - 60.0).unwrap();
                // Windows follow the orbit, whose period is 12 h within seconds.
                while in_downlink(&plant) {
                    plant.step_to(plant.time_s() + 1.0).unwrap();
                }
                let epoch = [("start.epoch", plant.real("start.epoch") + plant.time_s())];
                let mut sets = with(&[&reported, SAMPLED, &epoch]);
                let seen = places(&plant);
                sets.extend(seen.iter().map(|(name, value)| (&**name, *value)));
                let guidance = guidances.initialize(0.0, &sets).unwrap();
                let clamped = "momentum.targetClamped";
                assert_eq!(
                    guidance.boolean(clamped),
                    plant.boolean(clamped),
                    "{strategy} {convention} {cycle}"
                );
                worst_rad = worst_rad.max(off(sun_place(&guidance), sun_place(&plant)));
                largest_rad = sun_place(&plant).map(f64::abs).into_iter().fold(largest_rad, f64::max);
            }
            println!("{strategy} {convention}: {worst_rad:e} of {largest_rad}");
            assert!(worst_rad < 1e-11 && largest_rad > 0.01, "{strategy} {convention}: {worst_rad:e}");
        }
    }
}

#[test]
fn the_sun_stays_in_its_zone_through_science_downlinks_and_slews() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let slews = [("guided.slewRate", 2e-3), ("guided.downlinkEvery", 1.0)];
    // Out of reach: the Sun stands at the bounds of the zone.
    let target = [("momentum.target[1]", 30.0), ("momentum.target[3]", -20.0)];
    let mut flight = named.initialize(0.0, &with(&[SPACECRAFT, UNLOAD, &slews, &target])).unwrap();
    let (mut least_rad, mut clamped) = (f64::INFINITY, 0);
    while flight.time_s() < 3.0 * DAY_S {
        let end_s = flight.time_s() + 20.0;
        flight.step_to(end_s).unwrap();
        least_rad = least_rad.min(flight.real("keepIn.margin"));
        clamped += i32::from(flight.boolean("momentum.targetClamped"));
    }
    println!("{least_rad:e}");
    assert!(least_rad > -1e-9 && clamped > 0, "{least_rad:e} {clamped}");
}

/// On an orbit that is integrated the next downlink waits for a periapsis that is still to be met.
#[test]
fn a_disturbed_orbit_has_places_of_its_science_too() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let [closed, disturbed] = [1.0, 2.0].map(|dynamics| {
        let sets = with(&[SPACECRAFT, UNLOAD, &[("orbit.dynamics", dynamics)]]);
        let mut flight = named.initialize(0.0, &sets).unwrap();
        [1.0, 14.0, 38.0, 62.0].map(|hour| {
            flight.step_to(hour * HOUR_S).unwrap();
            (sun_place(&flight), flight.boolean("momentum.targetClamped"))
        })
    });
    for (a, b) in closed.into_iter().zip(disturbed).skip(1) {
        assert!(a.0[1].abs() > 0.01 && off(a.0, b.0) < 1e-4 && a.1 == b.1, "{a:?} {b:?}");
    }
}

#[test]
fn the_cut_and_a_restored_state_change_no_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for more in [
        [("orbit.dynamics", 2.0), ("momentum.strategy", 2.0)],
        [("momentum.convention", 2.0), ("momentum.strategy", 3.0)],
    ] {
        let sets = with(&[
            &SPACECRAFT[..4],
            &[("guided.scienceUnload", 1.0), ("guided.slewRate", 3e-3), ("dump.threshold[1]", 0.2)],
            &more,
        ]);
        let ends_s = (1..=48).map(|hour| HOUR_S * f64::from(hour));
        assert_cuts_change_nothing(|| named.initialize(0.0, &sets).unwrap(), ends_s, &[600.0, 97.3], |_| {});
    }
}

#[test]
fn a_controller_turns_to_the_place_that_is_chosen_and_holds_it() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let controlled = [("attitude.source", 3.0), ("command.source", 2.0)];
    let place = |unload: f64| {
        let choice = [("guided.scienceUnload", unload), ("momentum.strategy", 2.0)];
        let mut flight = named.initialize(0.0, &with(&[SPACECRAFT, &controlled, &choice])).unwrap();
        [1800.0, 2700.0, 3600.0].map(|end_s| {
            flight.simulate_to(end_s, 60.0).unwrap();
            sun_place(&flight)
        })
    };
    let [first, second, third] = place(1.0);
    assert!(
        first[0].abs() > 0.01 && off(first, second) < 1e-3 && off(first, third) < 1e-3,
        "{first:?} {third:?}"
    );
    // The science rule has the Sun on the meridian, at an elevation that goes with the angle between Sun and nadir.
    let [first, _, third] = place(0.0);
    assert!(first[0].abs() < 1e-3 && off(first, third) > 0.01, "{first:?} {third:?}");
}

#[test]
fn science_that_unloads_without_a_strategy_is_refused() {
    let alone = [("guided.scienceUnload", 1.0)];
    let plant = NamedModel::<MomentumPlant>::shipped().refusal(&alone);
    for text in [plant, NamedModel::<Guidance>::shipped().refusal(&alone)] {
        assert!(
            text.starts_with("guided.scienceUnload: found true with momentum.strategy dumpsOnly"),
            "{text}"
        );
    }
}
