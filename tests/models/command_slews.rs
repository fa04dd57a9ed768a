//! Slews into the commands of a timeline: the body turns from where it stands, at the rate that is set, to the command's own attitude.

use models::{Guidance, MomentumPlant};
use nalgebra::UnitQuaternion;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const RATE_RAD_S: f64 = 2e-3;

/// Two inertial attitudes, the second before the slew into the first is over, nadir for a time, and downlink.
const COMMANDS: &str = "[[command]]\nat = 600\nattitude = [0.6, 0, 0, 0.8]\n\
    [[command]]\nat = 700.3\nname = \"survey\"\nattitude = [0, -0.8, 0.6, 0]\n\
    [[command]]\nat = 5000\nuntil = 9000\nscenario = \"nadir\"\n\
    [[command]]\nat = 20_000\nscenario = \"downlink\"\n";

fn plant() -> NamedModel<MomentumPlant> {
    NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", COMMANDS)
}

const UNBOUND: [(&str, f64); 2] = [("guided.downlinkEvery", 0.0), ("keepIn.enabled", 0.0)];
const SLEWING: [(&str, f64); 1] = [("guided.slewRate", RATE_RAD_S)];

fn turned_rad(from: &UnitQuaternion<f64>, to: &UnitQuaternion<f64>) -> f64 {
    from.angle_to(to)
}

#[test]
fn the_body_turns_into_each_command_from_where_it_stands() {
    let named = plant();
    let mut slewing = named.initialize(0.0, &[SLEWING.as_slice(), &UNBOUND].concat()).unwrap();
    let mut jumping = named.initialize(0.0, &UNBOUND).unwrap();
    let mut stands = |time_s: f64| {
        [&mut slewing, &mut jumping].map(|flight: &mut NamedInstance<'_, MomentumPlant>| {
            flight.step_to(time_s).unwrap();
            (flight.to_inertial("attitude.q"), flight.vector("attitude.rate"))
        })
    };
    let mut jumps = 0;
    for (begin_s, is_inertial) in [(600.0, true), (700.3, true), (5000.0, false), (9000.0, false)] {
        let [before, jumped_from] = stands(begin_s - 1e-6);
        let [at, target] = stands(begin_s);
        assert!(turned_rad(&before.0, &at.0) < 1e-8, "{begin_s}");
        jumps += i32::from(turned_rad(&jumped_from.0, &target.0) > 0.05);
        let whole_rad = turned_rad(&at.0, &target.0);
        assert!(whole_rad > 0.05, "{begin_s}: {whole_rad}");
        // Toward a fixed attitude the turn goes at the rate, about one axis.
        let [on_the_way, target] = stands(begin_s + 20.0);
        let left_rad = turned_rad(&on_the_way.0, &target.0);
        if is_inertial {
            assert!((whole_rad - left_rad - 20.0 * RATE_RAD_S).abs() < 1e-12, "{begin_s}");
            assert!((on_the_way.1.norm() - RATE_RAD_S).abs() < 1e-15, "{begin_s}");
        } else {
            assert!(left_rad < whole_rad && on_the_way.1.norm() < 1.6 * RATE_RAD_S, "{begin_s}");
        }
    }
    assert_eq!(jumps, 4);
    let [slewed, target] = stands(12_000.0);
    assert_eq!(slewed, target);
}

#[test]
fn steps_of_any_length_slew_to_the_same_bits() {
    let named = plant();
    let disturbed = [("orbit.dynamics", 2.0), ("dump.threshold[2]", 0.01), ("guided.slewRate", RATE_RAD_S)];
    let managed =
        [("momentum.strategy", 3.0), ("guided.slewRate", RATE_RAD_S), ("guided.downlinkEvery", 1.0)];
    for sets in [&disturbed[..], &managed] {
        let initialize = || named.initialize(0.0, sets).unwrap();
        let ends_s = [650.0, 1000.5, 7000.0, 20_500.0, 50_000.0];
        assert_cuts_change_nothing(initialize, ends_s, &[97.0, 600.0, 1000.0], |_| {});
    }
    let controlled = [&SLEWING[..], &[("attitude.source", 3.0), ("command.source", 2.0)]].concat();
    let initialize = || named.initialize(0.0, &controlled).unwrap();
    assert_cuts_change_nothing(initialize, [650.0, 720.5], &[0.7, 13.0], |_| {});
}

#[test]
fn both_models_tell_when_a_command_ends() {
    let guidances = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", COMMANDS);
    let named = plant();
    let mut flight = named.initialize(0.0, &SLEWING).unwrap();
    let mut guidance = guidances.initialize(0.0, &[("position[1]", 5e6), ("velocity[2]", 2e3)]).unwrap();
    for (time_s, until_s) in [
        (0.0, 600.0),
        (600.0, 700.3),
        (700.3, 5000.0),
        (6000.0, 9000.0),
        (9000.0, 20_000.0),
        (20_000.0, -1.0),
    ] {
        flight.step_to(time_s).unwrap();
        guidance.step_to(time_s).unwrap();
        let found = [flight.real("timeline.until"), guidance.real("timeline.until")];
        assert_eq!(found, [until_s; 2], "at {time_s} s");
    }
    let plain = NamedModel::<MomentumPlant>::shipped();
    assert_eq!(plain.initialize(0.0, &[]).unwrap().real("timeline.until"), -1.0);
}
