//! Burns through the functions a master calls: what the thrusters are reported, cuts, saved states, refusals, the timeline.

use models::Guidance;
use nalgebra::Vector3;

use super::super::named_model::{NamedModel, assert_same};
use super::{FREE, GuidanceInstance, PLACED, with};

const BURN: &[(&str, f64)] = &[
    ("pointing.scenario", 9.0),
    ("burn.deltaV[1]", 3.0),
    ("burn.deltaV[2]", -1.0),
    ("burn.deltaV[3]", 2.0),
    ("burn.start", 4.0),
    ("burn.acceleration", 0.1),
];

const ACCELERATION_M_S2: f64 = 0.1234;

/// The thrust's direction as it is.
fn thrust_body() -> Vector3<f64> {
    Vector3::new(0.01, -0.02, 1.0).normalize()
}

/// Inputs after a master's exchange at a second: the spacecraft follows the command, thrust has acted for `on_s` so far.
fn exchange(flight: &mut GuidanceInstance<'_>, on_s: f64) {
    let q = flight.quaternion("command.q");
    flight.set_elements("estimate.q", &q);
    flight.set_elements("accelerometer.deltaV", &(thrust_body() * (ACCELERATION_M_S2 * on_s)));
}

/// For how long of the second that begins at `time_s` thrusters obey what they are reported at its beginning.
fn on_s(flight: &GuidanceInstance<'_>, time_s: f64) -> f64 {
    let until_s = if flight.boolean("thrust.command") { flight.real("thrust.stop") } else { time_s };
    (until_s - time_s).clamp(0.0, 1.0)
}

/// Simulates it second by second, each in `cuts` steps, saved and restored before each second where `saves`; calls `each` with
/// the flight after each second.
fn simulate<'a>(
    named: &'a NamedModel<Guidance>,
    sets: &[(&str, f64)],
    cuts: u32,
    saves: bool,
    mut each: impl FnMut(u32, &GuidanceInstance<'a>),
) -> f64 {
    let mut flight = named.initialize(0.0, sets).unwrap();
    let mut thrust_s = 0.0;
    for second in 0..80 {
        let time_s = f64::from(second);
        if saves {
            flight = flight.restored();
        }
        let on_s = on_s(&flight, time_s);
        exchange(&mut flight, thrust_s);
        for cut in 1..=cuts {
            flight.step_to(time_s + f64::from(cut) / f64::from(cuts)).unwrap();
        }
        thrust_s += on_s;
        each(second, &flight);
    }
    thrust_s
}

#[test]
fn thrusters_are_reported_from_the_scenario_to_the_exact_end() {
    let named = NamedModel::<Guidance>::shipped();
    let delta_v = Vector3::new(3.0, -1.0, 2.0);
    let mut ended_at = None;
    let thrust_s = simulate(&named, &with(&[PLACED, FREE, BURN]), 1, false, |second, flight| {
        let (request, command) = (flight.integer("thrust.request"), flight.boolean("thrust.command"));
        let stop_s = flight.real("thrust.stop");
        if second < 4 {
            assert_eq!((request, command, stop_s), (2, false, -1.0), "{second}");
        } else if command {
            assert!(request == 2 && stop_s > f64::from(second), "{second}: {stop_s}");
        } else {
            assert_eq!((request, stop_s), (0, -1.0));
            ended_at.get_or_insert(second);
            assert!((flight.vector("burn.velocity") - delta_v).norm() < 0.02);
            assert!(flight.vector("burn.velocityError").norm() < 0.02);
            assert!((flight.vector("burn.thrustEstimate") - thrust_body()).norm() < 1e-5);
        }
        assert!(!flight.boolean("burn.timedOut"));
    });
    // Commanded at 4 s, there at 5 s, and as long as the magnitude takes.
    let needed_s = delta_v.norm() / ACCELERATION_M_S2;
    assert!((thrust_s - needed_s).abs() < 1e-9, "{thrust_s} s, needed {needed_s} s");
    assert_eq!(ended_at, Some((5.0 + needed_s).ceil() as u32));
}

#[test]
fn cuts_and_saved_states_change_no_bit_of_a_burn() {
    let named = NamedModel::<Guidance>::shipped();
    let sets = with(&[PLACED, FREE, BURN]);
    let turn = [("burn.profile[1,1]", 3.0), ("burn.profile[2,1]", 1.0), ("burn.profile[2,2]", -2.0)];
    let rest = [("burn.profile[3,1]", 1.0), ("burn.profile[3,3]", 1.0)];
    for sets in [sets.clone(), with(&[&sets, &turn, &rest])] {
        let mut whole = Vec::new();
        simulate(&named, &sets, 1, false, |_, flight| whole.push(flight.restored()));
        for (cuts, saves) in [(10, false), (3, false), (1, true), (7, true)] {
            simulate(&named, &sets, cuts, saves, |second, flight| {
                assert_same(&whole[second as usize], flight);
            });
        }
    }
}

#[test]
fn a_profile_that_ends_elsewhere_is_refused_and_no_direction_holds_the_attitude() {
    let named = NamedModel::<Guidance>::shipped();
    let sets = with(&[PLACED, BURN, &[("burn.profile[1,1]", 3.0)]]);
    let refused = named.refusal(&sets);
    assert!(refused.contains("burn.profile") && refused.contains("burn.deltaV"), "{refused}");
    let none = [("burn.deltaV[1]", 0.0), ("burn.deltaV[2]", 0.0), ("burn.deltaV[3]", 0.0)];
    let mut flight = named.initialize(0.0, &with(&[PLACED, BURN, &none])).unwrap();
    flight.step_to(10.0).unwrap();
    assert_eq!(flight.integer("command.kind"), 0);
    assert!(flight.boolean("geometry.degenerate") && !flight.boolean("thrust.command"));
}

#[test]
fn a_timelines_entry_that_names_no_scenario_does_not_burn_again() {
    let timeline = "[[command]]\nat = 2.0\nscenario = \"burn\"\n[[command]]\nat = 30.0\nkeepIn = { enabled = false }\n\
                    [[command]]\nat = 70.0\nscenario = \"burn\"\n";
    let named = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
    let burn: Vec<_> = BURN.iter().copied().filter(|(name, _)| *name != "pointing.scenario").collect();
    let mut reported = Vec::new();
    simulate(&named, &with(&[PLACED, FREE, &burn]), 1, false, |_, flight| {
        reported.push(flight.boolean("thrust.command"))
    });
    let edges: Vec<_> = (1..reported.len()).filter(|at| reported[*at] != reported[at - 1]).collect();
    assert_eq!((edges.len(), edges[0], edges[2]), (3, 4, 70), "{edges:?}");
}

#[test]
fn a_burn_that_is_refused_or_ends_before_it_began_says_so() {
    // Toward the Sun the thrust along +Z would turn the shade away.
    let zone = [("hotPole.enabled", 0.0), ("monitor.enabled", 0.0), ("keepIn.enabled", 1.0)];
    let toward_sun = [
        ("burn.deltaV[1]", 3.0),
        ("burn.deltaV[2]", -4.0),
        ("burn.deltaV[3]", 0.0),
        ("burn.start", 4.0),
        ("burn.timeout", 20.0),
        ("pointing.scenario", 9.0),
    ];
    let named = NamedModel::<Guidance>::shipped();
    let mut refused = named.initialize(0.0, &with(&[PLACED, &zone, &toward_sun])).unwrap();
    for second in 0..40 {
        refused.step_to(f64::from(second + 1)).unwrap();
        assert_eq!(refused.boolean("burn.timedOut"), second >= 4, "{second}");
        assert!(!refused.boolean("thrust.command"));
        assert_eq!(refused.integer("thrust.request") != 0, second < 24, "{second}");
    }
    let reported = |named: &NamedModel<Guidance>, part: &str| {
        named.warnings().iter().filter(|it| it.starts_with("burn.timedOut") && it.contains(part)).count()
    };
    assert_eq!([reported(&named, "does not begin"), reported(&named, "before it began")], [1, 1]);

    let named = NamedModel::<Guidance>::shipped();
    let mut ended = named.initialize(0.0, &with(&[PLACED, FREE, BURN, &[("burn.start", 100.0)]])).unwrap();
    ended.step_to(10.0).unwrap();
    assert!(!ended.boolean("burn.timedOut") && named.warnings().is_empty());
    ended.set("pointing.scenario", 3.0);
    ended.step_to(20.0).unwrap();
    assert!(ended.boolean("burn.timedOut") && ended.integer("thrust.request") == 0);
    assert_eq!(reported(&named, "before it began"), 1);
}

/// By timelines alone.
fn planned() -> Vec<(&'static str, f64)> {
    BURN.iter().copied().filter(|(name, _)| *name != "pointing.scenario").collect()
}

#[test]
fn burns_of_a_timeline_have_their_own_velocity_set_and_start() {
    let timeline = "[[command]]\nat = 2\nscenario = \"burn\"\n\
                    burn = { deltaV = [0, 2, 0], thrusters = \"mono4\", start = \"5 s\" }\n\
                    [[command]]\nat = 30\nscenario = \"burn\"\n\
                    burn = { deltaV = [1, 0, 0], thrusters = \"lva\" }\n\
                    [[command]]\nat = 50\nscenario = \"burn\"\n";
    let named = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
    let mut began = Vec::new();
    let mut was_on = false;
    simulate(&named, &with(&[PLACED, FREE, &planned()]), 1, false, |second, flight| {
        let (request, is_on) = (flight.integer("thrust.request"), flight.boolean("thrust.command"));
        if is_on && !was_on {
            began.push((second, request));
        }
        was_on = is_on;
        let done = flight.vector("burn.velocity");
        match second {
            29 => assert!((done - Vector3::new(0.0, 2.0, 0.0)).norm() < 0.02, "{done}"),
            49 => assert!((done - Vector3::new(1.0, 0.0, 0.0)).norm() < 0.02, "{done}"),
            _ => {}
        }
        assert!(!matches!(second, 29 | 49) || flight.vector("burn.velocityError").norm() < 0.02, "{second}");
    });
    // After its command and 5 s; a second after its command, when the attitude is there; as the parameters set.
    assert_eq!(began, [(7, 3), (31, 1), (50, 2)]);
    assert!(named.warnings().is_empty(), "{:?}", named.warnings());
}

#[test]
fn a_burn_is_cut_off_with_a_warning_where_its_command_ends() {
    let burn = "[[command]]\nat = 2\nscenario = \"burn\"\n";
    let table = "burn = { deltaV = [30, 0, 0], thrusters = \"c22\" }\n";
    let next = [
        "until = 20\n",
        "[[command]]\nat = 20\nkeepIn = { enabled = false }\n",
        "[[command]]\nat = 20\nscenario = \"nadir\"\n",
        "[[command]]\nat = 20\nscenario = \"burn\"\nburn = { deltaV = [0, 0, 1], thrusters = \"lva\" }\n",
    ];
    for end in next {
        let timeline = format!("{burn}{table}{end}");
        let named = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", &timeline);
        let mut last = None;
        simulate(&named, &with(&[PLACED, FREE, &planned()]), 1, false, |second, flight| {
            if flight.boolean("thrust.command") && flight.integer("thrust.request") == 2 {
                last = Some(second);
            }
        });
        assert_eq!(last, Some(19), "{end}");
        let warned = named.warnings().iter().filter(|it| it.starts_with("burn: cut off at 20 s")).count();
        assert_eq!(warned, 1, "{end}: {:?}", named.warnings());
    }
}

#[test]
fn a_burn_without_start_waits_until_the_attitude_is_reached() {
    let timeline =
        "[[command]]\nat = 2\nscenario = \"burn\"\nburn = { deltaV = [1, 0, 0], thrusters = \"c22\" }\n";
    let named = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
    let mut flight = named.initialize(0.0, &with(&[PLACED, FREE, &planned()])).unwrap();
    let held = flight.quaternion("command.q");
    for second in 0..60 {
        // The spacecraft turns at 25 s.
        let q = if second < 25 { held } else { flight.quaternion("command.q") };
        flight.set_elements("estimate.q", &q);
        flight.step_to(f64::from(second + 1)).unwrap();
        assert_eq!(flight.boolean("thrust.command"), second >= 25, "{second}");
        assert!(!flight.boolean("burn.timedOut"));
    }
}
