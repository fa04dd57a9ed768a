//! Momentum management: targets that a plant reaches by what guidance commands, limits, and requests for dumps.

use fmi_export::Model;
use models::{Guidance, MomentumPlant};
use nalgebra::Vector3;

use super::super::named_model::{NamedInstance, NamedModel};
use super::{GuidanceInstance, PLACED, with};

const HOUR_S: f64 = 3600.0;
const SPAN_S: f64 = 8.0 * HOUR_S;
const MOMENTUM: [f64; 3] = [0.4, -0.1, -0.3];
const TARGET: Vector3<f64> = Vector3::new(0.1, 5.0, -0.05);

/// A spacecraft, a Sun and an Earth that stand still.
fn still(separation_deg: f64) -> Vec<(&'static str, f64)> {
    let earth_rad = separation_deg.to_radians() + 2.0;
    vec![
        ("ephemeris.source", 3.0),
        ("sun.position[1]", -4.0e10),
        ("sun.position[2]", 2.0e10),
        ("sun.position[3]", 1.0e10),
        ("earth.position[1]", 1.5e11 * earth_rad.cos()),
        ("earth.position[2]", 1.5e11 * earth_rad.sin()),
        ("earth.position[3]", 3e10),
        ("spacecraft.centerOfMass[3]", 0.02),
        ("start.q[1]", 0.6),
        ("start.q[4]", 0.8),
    ]
}

const QUIET: &[(&str, f64)] = &[
    ("position[1]", 1e7),
    ("pointing.scenario", 6.0),
    ("momentum.strategy", 2.0),
    ("momentum.body[1]", MOMENTUM[0]),
    ("momentum.body[2]", MOMENTUM[1]),
    ("momentum.body[3]", MOMENTUM[2]),
    ("estimate.q[1]", 0.6),
    ("estimate.q[4]", 0.8),
    ("panel[1].nominalSunOffset", 0.3),
    ("panel[2].nominalSunOffset", 0.3),
    ("hotPole.enabled", 0.0),
    ("monitor.enabled", 0.0),
];

/// A plant in the same place that follows commands and takes its panels' offsets from guidance.
const FOLLOWS: &[(&str, f64)] = &[
    ("attitude.source", 2.0),
    ("orbit.source", 3.0),
    ("orbit.position[1]", 1e7),
    ("gravityGradient.enabled", 0.0),
    ("start.momentum[1]", MOMENTUM[0]),
    ("start.momentum[2]", MOMENTUM[1]),
    ("start.momentum[3]", MOMENTUM[2]),
    ("command.q[1]", 0.6),
    ("command.q[4]", 0.8),
    ("panel[1].control", 3.0),
    ("panel[2].control", 3.0),
];

fn follow(plant: &mut NamedInstance<'_, MomentumPlant>, guidance: &GuidanceInstance<'_>) {
    plant.set_elements("command.q", &guidance.quaternion("command.q"));
    for k in 1..=2 {
        let offset_rad = guidance.real(&format!("panel[{k}].sunOffset"));
        plant.set(&format!("panel[{k}].sunOffsetCommand"), offset_rad);
    }
}

#[test]
fn a_plant_that_follows_reaches_an_attainable_target() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    let mut hit = 0;
    for separation_deg in [20.0, 60.0, 75.0, 100.0, 160.0] {
        for convention in [1.0, 2.0] {
            for axes in [1.0, 2.0, 3.0] {
                let place = with(&[&still(separation_deg), &[("momentum.convention", convention)]]);
                let requested = [
                    ("momentum.targetAxes", axes),
                    ("momentum.target[1]", TARGET.x),
                    ("momentum.target[2]", TARGET.y),
                    ("momentum.target[3]", TARGET.z),
                ];
                let mut guidance = guidances.initialize(0.0, &with(&[&place, QUIET, &requested])).unwrap();
                let mut plant = plants.initialize(0.0, &with(&[&place, FOLLOWS])).unwrap();
                let before = plant.vector("momentum.body");
                assert!((before - Vector3::from(MOMENTUM)).amax() < 1e-12, "{before:?}");
                guidance.step_to(1.0).unwrap();
                let clamped = guidance.boolean("momentum.targetClamped");
                follow(&mut plant, &guidance);
                // What is held while the downlink lasts, whatever the momentum does.
                guidance.set_elements("momentum.body", &Vector3::new(-1.0, 1.0, 1.0));
                let held = guidance.quaternion("command.q");
                guidance.step_to(600.0).unwrap();
                assert_eq!(guidance.quaternion("command.q"), held);
                plant.step_to(SPAN_S).unwrap();
                let seen = (plant.real("sun.azimuth"), plant.real("sun.elevation"));
                let reported = (guidance.real("sun.azimuth"), guidance.real("sun.elevation"));
                assert!((seen.0 - reported.0).abs() < 1e-12 && (seen.1 - reported.1).abs() < 1e-12);
                let earth_rad = plant.real("earth.azimuth");
                assert!(plant.real("earth.elevation").abs() < 1e-12);
                assert!((guidance.real("antenna.azimuth") - earth_rad).abs() < 1e-9);
                assert!(plant.real("keepIn.margin") > -1e-9);
                if clamped {
                    continue;
                }
                hit += 1;
                let off = plant.vector("momentum.body") - TARGET;
                let wrong = match axes as i32 {
                    1 => off.x.abs(),
                    2 => off.z.abs(),
                    _ => off.xz().amax(),
                };
                assert!(wrong < 1e-9, "{separation_deg} {convention} {axes}: {off:?}");
            }
        }
    }
    assert!(hit >= 20, "{hit}");
}

#[test]
fn a_window_of_the_orbit_phase_aims_at_its_own_end() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    let windows = [
        ("pointing.scenario", 10.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", 3.0),
        ("guided.downlinkEnd", 3.0 + SPAN_S),
    ];
    let mut guidance = guidances.initialize(0.0, &with(&[&still(60.0), QUIET, &windows])).unwrap();
    let mut plant = plants.initialize(0.0, &with(&[&still(60.0), FOLLOWS])).unwrap();
    guidance.step_to(3.0).unwrap();
    assert!(guidance.real("sun.azimuth").abs() < 1e-12);
    // The momentum at the window's begin counts.
    plant.step_to(3.0).unwrap();
    guidance.set_elements("momentum.body", &plant.vector("momentum.body"));
    guidance.step_to(4.0).unwrap();
    assert!(!guidance.boolean("momentum.targetClamped"));
    follow(&mut plant, &guidance);
    plant.step_to(3.0 + SPAN_S).unwrap();
    let end = plant.vector("momentum.body");
    assert!(end.xz().amax() < 1e-9, "{end:?}");
}

#[test]
fn a_target_out_of_reach_is_flagged_while_the_downlink_lasts() {
    let named = NamedModel::<Guidance>::shipped();
    let far = [("momentum.target[1]", 30.0)];
    let mut flight = named.initialize(0.0, &with(&[&still(60.0), QUIET, &far])).unwrap();
    assert!(flight.boolean("momentum.targetClamped"));
    flight.step_to(1.0).unwrap();
    let sun_rad = [flight.real("sun.azimuth"), flight.real("sun.elevation")].map(f64::abs);
    assert!(sun_rad[1] > 0.1, "{sun_rad:?}");
    flight.set("pointing.scenario", 3.0);
    flight.step_to(2.0).unwrap();
    assert!(!flight.boolean("momentum.targetClamped"));
    // In Safe Hold the Sun stands on -Y.
    flight.set("pointing.scenario", 6.0);
    flight.set("mode.request", 2.0);
    flight.step_to(3.0).unwrap();
    assert!(!flight.boolean("momentum.targetClamped"));
    assert!(flight.real("sun.elevation").abs() < 1e-12 && flight.real("sun.azimuth").abs() < 1e-12);
}

#[test]
fn an_antenna_of_its_own_leaves_the_momentum_alone() {
    let named = NamedModel::<Guidance>::shipped();
    let own = [("boresight.option", 4.0), ("boresight.azimuth", -0.6)];
    let q = [1.0, 2.0].map(|strategy| {
        let sets = with(&[&still(60.0), QUIET, &own, &[("momentum.strategy", strategy)]]);
        named.initialize(0.0, &sets).unwrap().quaternion("command.q")
    });
    assert_eq!(q[0], q[1]);
}

#[test]
fn a_component_beyond_its_threshold_asks_once() {
    let named = NamedModel::<Guidance>::shipped();
    let limits = [("dump.threshold[1]", 4.0), ("dump.threshold[2]", 5.0), ("dump.threshold[3]", 6.0)];
    let mut flight = named.initialize(0.0, &with(&[PLACED, &limits])).unwrap();
    let mut end_s = 0.0;
    let mut sample = |flight: &mut GuidanceInstance<'_>, momentum: [f64; 3]| {
        flight.set_elements("momentum.body", &momentum);
        end_s += 1.0;
        flight.step_to(end_s).unwrap();
        (flight.boolean("dump.request"), flight.vector("dump.target"))
    };
    let nothing = (false, Vector3::zeros());
    assert_eq!(sample(&mut flight, [0.0; 3]), nothing);
    assert_eq!(sample(&mut flight, [3.9, -4.9, 5.9]), nothing);
    let left = Vector3::new(-3.6, -4.9, 1.0);
    assert_eq!(sample(&mut flight, [4.1, -4.9, 1.0]), (true, left));
    assert_eq!(sample(&mut flight, [4.2, -4.9, 1.0]), (false, left));
    assert_eq!(sample(&mut flight, [4.2, -5.1, 1.0]), (true, Vector3::new(-3.6, 4.5, 1.0)));
    assert!(!sample(&mut flight, [3.0, 3.0, 3.0]).0);
    assert_eq!(sample(&mut flight, [-4.5, 3.0, 3.0]), (true, Vector3::new(3.6, 3.0, 3.0)));
    let zero = [("dump.reinitTo", 2.0), ("momentum.target[1]", 0.5), ("momentum.body[1]", 4.5)];
    let flight = named.initialize(0.0, &with(&[PLACED, &limits, &zero])).unwrap();
    assert!(flight.boolean("dump.request"));
    assert_eq!(flight.vector("dump.target"), Vector3::new(0.5, 0.0, 0.0));
}

/// A request lasts from its sample to the next one, however a master steps: what it cannot see is warned of.
#[test]
fn a_request_that_no_communication_point_sees_is_warned_of() {
    let timeline = "[[event]]\nat = 9.5\ndump = true\n";
    for (step_s, warned) in [(1.0, 0), (5.5, 0), (2.0, 1), (3.0, 1), (60.0, 1)] {
        let named = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
        let mut flight = named.initialize(0.0, &with(&[PLACED])).unwrap();
        let mut seen = 0;
        while flight.time_s() < 60.0 {
            flight.step_to(flight.time_s() + step_s).unwrap();
            seen += usize::from(flight.boolean("dump.request"));
        }
        let warnings = named.warnings();
        let about: Vec<_> =
            warnings.iter().filter(|it| it.contains("dump.request was true from 10 to 11 s")).collect();
        assert_eq!((seen + about.len(), about.len()), (1, warned), "{step_s}: {warnings:?}");
    }
}

#[test]
fn a_dump_of_the_timeline_is_requested_at_the_sample_that_it_comes_to() {
    let timeline = "[[event]]\nat = 9.5\ndump = true\n[[event]]\nat = 12.25\ndump = [0.5, -1, 0.25]\n\
                    maneuver = { deltaV = [1, 0, 0] }\n[[event]]\nat = 15\ndump = true\n\
                    [[event]]\nat = 16\ncenterOfMass = [0, 0, 0]\n";
    let named = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
    let left = Vector3::new(0.5, -1.0, 0.25);
    // What came before the start is past; at the start it is due.
    for (start_s, expected) in [
        (0.0, &[(10.0, Vector3::zeros()), (13.0, left), (15.0, Vector3::zeros())][..]),
        (15.0, &[(15.0, Vector3::zeros())]),
    ] {
        for step_s in [0.5, 1.0] {
            let mut flight = named.initialize(start_s, &with(&[PLACED])).unwrap();
            let mut requested = Vec::new();
            let mut sampled_s = f64::NEG_INFINITY;
            for _ in 0..40 {
                let before_s = flight.time_s();
                flight = flight.restored();
                flight.step_to(before_s + step_s).unwrap();
                // The sample of the step's begin, or none in the second half of a second.
                let sample_s = start_s + (before_s - start_s).floor();
                if flight.boolean("dump.request") && sample_s > sampled_s {
                    requested.push((sample_s, flight.vector("dump.target")));
                    sampled_s = sample_s;
                }
            }
            assert_eq!(requested, expected, "{start_s} {step_s}");
        }
    }
}

#[test]
fn a_request_makes_a_plant_dump_to_its_target() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    let limits = [("dump.threshold[1]", 0.3)];
    let mut guidance = guidances.initialize(0.0, &with(&[&still(60.0), QUIET, &limits])).unwrap();
    let mut plant = plants.initialize(0.0, &with(&[&still(60.0), FOLLOWS])).unwrap();
    guidance.step_to(1.0).unwrap();
    plant.set("dump.request", f64::from(u8::from(guidance.boolean("dump.request"))));
    plant.set_elements("dump.target", &guidance.vector("dump.target"));
    plant.step_to(1e-3).unwrap();
    assert_eq!(plant.integer("dump.count"), 1);
    let after = plant.vector("momentum.body");
    assert!((after - Vector3::new(-0.27, MOMENTUM[1], MOMENTUM[2])).amax() < 1e-6, "{after:?}");
}

#[test]
fn zero_inputs_and_bad_ones() {
    let named = NamedModel::<Guidance>::shipped();
    let zero: Vec<_> = named.inputs().into_iter().map(|name| (name, 0.0)).collect();
    for strategy in [2.0, 3.0] {
        let chosen = [("momentum.strategy", strategy)];
        let mut flight = named.initialize(0.0, &with(&[&zero, &chosen])).unwrap();
        flight.step_to(60.0).unwrap();
        assert_eq!(flight.not_finite(), None);
        let mut flight =
            named.initialize(0.0, &with(&[PLACED, &[("pointing.scenario", 6.0)], &chosen])).unwrap();
        flight.step_to(60.0).unwrap();
        assert_eq!(flight.not_finite(), None);
    }
    let refused = |sets: &[(&str, f64)]| named.refusal(sets);
    for strategy in [2.0, 3.0] {
        let never = [("momentum.strategy", strategy), ("guided.downlinkEnd", 7200.0)];
        let found = refused(&never);
        assert!(found.contains("momentum.strategy") && found.contains("guided.downlinkEnd"), "{found}");
    }
    // A file that describes the shade as plates alone.
    let (head, tail) = <Guidance as Model>::DEFAULT_SETUP.split_once("[sunshade.cylinder]").unwrap();
    let rest = tail.split_once("\n[").unwrap().1;
    let plates = NamedModel::<Guidance>::with("plates.toml", &format!("{head}[{rest}"));
    let found = plates.refusal(&[("sunshade.shape", 2.0)]);
    assert!(found.contains("sunshade.shape"), "{found}");
}

#[test]
fn targets_count_on_the_scale_of_sunlight() {
    let (guidances, plants) = (NamedModel::<Guidance>::shipped(), NamedModel::<MomentumPlant>::shipped());
    let requested = [
        ("momentum.target[1]", TARGET.x),
        ("momentum.target[2]", TARGET.y),
        ("momentum.target[3]", TARGET.z),
    ];
    let missed = |of_guidance: f64, of_plant: f64| {
        let place = still(60.0);
        let scaled = |scale: f64| [("solar.scale", scale)];
        let mut guidance =
            guidances.initialize(0.0, &with(&[&place, QUIET, &requested, &scaled(of_guidance)])).unwrap();
        let mut plant = plants.initialize(0.0, &with(&[&place, FOLLOWS, &scaled(of_plant)])).unwrap();
        guidance.step_to(1.0).unwrap();
        assert!(!guidance.boolean("momentum.targetClamped"));
        follow(&mut plant, &guidance);
        plant.step_to(SPAN_S).unwrap();
        (plant.vector("momentum.body") - TARGET).xz().amax()
    };
    assert!(missed(1.2, 1.2) < 1e-9 && missed(1.0, 1.2) > 1e-3);
}

/// Optics that are set stand in targets, from the start on or from where they are set, as in an edited file, and a plant of the same
/// optics reaches the target.
#[test]
fn targets_go_by_the_optics_that_are_set() {
    let shipped = include_str!("../../../fmu-src/resources/messenger.toml");
    let aged = shipped
        .replace("specular = 0.52\ndiffuse = 0.07", "specular = 0.2\ndiffuse = 0.4")
        .replace("specular = 0.15\ndiffuse = 0.35", "specular = 0.4\ndiffuse = 0.1");
    let optics = [
        ("optics.solarCells.specular", 0.2),
        ("optics.solarCells.diffuse", 0.4),
        ("optics.shadeCloth.specular", 0.4),
        ("optics.shadeCloth.diffuse", 0.1),
    ];
    let (named, edited) =
        (NamedModel::<Guidance>::shipped(), NamedModel::<Guidance>::with("messenger.toml", &aged));
    for method in [1.0, 2.0] {
        let method = [("momentum.targeting", method)];
        let commanded = |named: &NamedModel<Guidance>, more: &[(&str, f64)], tuned: &[(&str, f64)]| {
            let mut guidance = named.initialize(0.0, &with(&[&still(60.0), QUIET, &method, more])).unwrap();
            tuned.iter().for_each(|(name, value)| guidance.set(name, *value));
            guidance.step_to(1.0).unwrap();
            nalgebra::Vector4::from(guidance.quaternion("command.q"))
        };
        let expected = commanded(&edited, &[], &[]);
        assert!((commanded(&named, &[], &[]) - expected).amax() > 1e-3);
        for found in [commanded(&named, &optics, &[]), commanded(&named, &[], &optics)] {
            assert!((found - expected).amax() < 1e-12, "{found} {expected}");
        }
    }
    let plants = NamedModel::<MomentumPlant>::shipped();
    let mut hit = 0;
    for separation_deg in [20.0, 60.0, 75.0, 100.0, 160.0] {
        let place = with(&[&still(separation_deg), &optics]);
        let requested = [("momentum.target[1]", TARGET.x), ("momentum.target[3]", TARGET.z)];
        let mut guidance = named.initialize(0.0, &with(&[&place, QUIET, &requested])).unwrap();
        let mut plant = plants.initialize(0.0, &with(&[&place, FOLLOWS])).unwrap();
        guidance.step_to(1.0).unwrap();
        follow(&mut plant, &guidance);
        plant.step_to(SPAN_S).unwrap();
        if !guidance.boolean("momentum.targetClamped") {
            hit += 1;
            let off = (plant.vector("momentum.body") - TARGET).xz().amax();
            assert!(off < 1e-9, "{separation_deg} {off:e}");
        }
    }
    assert!(hit > 0);
}
