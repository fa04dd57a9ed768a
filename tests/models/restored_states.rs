//! A restored flight goes on to the same bits as the flight that was never saved, in every mode of it, with nothing set and with
//! any input or tunable set at once.

use fmi_export::Model;
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};

use super::cruise;
use super::guidance::{CUT, PLACED};
use super::named_model::{NamedInstance, NamedModel};
use super::plant_light::{BUSY, EFFECTS, SHADOWED};
use super::spacecraft::RADIATING;

const FULL: &str = include_str!("../../fmu-src/resources/messenger-full.toml");
const CUBESAT: &str = include_str!("../../fmu-src/resources/examples/cubesat-12u.toml");
const FLEXIBLE: &str = include_str!("../../fmu-src/resources/examples/flexible-craft.toml");
const SOURCES: [f64; 4] = [1.0, 2.0, 3.0, 4.0];
const CONTROLLED: (&str, f64) = ("attitude.source", 3.0);
const FREE: [(&str, f64); 2] = [("attitude.source", 4.0), ("start.q[4]", 1.0)];

/// Surroundings that inputs give.
const GIVEN: [(&str, f64); 18] = [
    ("planetLight.enabled", 0.0),
    ("ephemeris.source", 3.0),
    ("sun.position[1]", 1.2e11),
    ("sun.position[2]", -9e10),
    ("sun.position[3]", 3e10),
    ("earth.position[1]", 1e3),
    ("orbit.source", 2.0),
    ("orbit.position[1]", 5.1e6),
    ("orbit.position[2]", -4.4e6),
    ("orbit.velocity[3]", 7.7e3),
    ("atmosphere.method", 3.0),
    ("atmosphere.givenDensity", 1e-12),
    ("atmosphere.givenTemperature", 900.0),
    ("magneticField.method", 3.0),
    ("magneticField.given[1]", 2e-5),
    ("magneticField.given[3]", -1e-5),
    ("dipole.residual[2]", 0.1),
    ("wheel[1].startMomentum", 1e-3),
];

/// A time of the flight, and what is set there.
type Set<'a> = (f64, &'a [(&'a str, f64)]);

/// A mode of flight: how it begins, what is set on the way to where it is saved, and whether it is the one that is meant there.
struct Mode<'a, M: Model> {
    named: NamedModel<M>,
    sets: Vec<(&'a str, f64)>,
    on_the_way: &'a [Set<'a>],
    saved_s: f64,
    onward_s: f64,
    is_meant: fn(&NamedInstance<'_, M>) -> bool,
}

impl<M: Model> Mode<'_, M> {
    fn saved(&self) -> NamedInstance<'_, M> {
        let mut flight = self.named.initialize(0.0, &self.sets).unwrap();
        for (at_s, sets) in self.on_the_way {
            if *at_s > flight.time_s() {
                flight.step_to(*at_s).unwrap();
            }
            sets.iter().for_each(|(name, value)| flight.set(name, *value));
        }
        flight.step_to(self.saved_s).unwrap();
        assert!((self.is_meant)(&flight));
        flight
    }

    /// Changes of an input or tunable that take a restored flight elsewhere than the flight that was never saved.
    fn goes_elsewhere(&self) -> Vec<String> {
        let saved = self.saved();
        let changes = self.named.changes(&saved);
        let (count, mut refused) = (changes.len(), 0);
        let mut elsewhere = Vec::new();
        for change in core::iter::once(None).chain(changes.into_iter().map(Some)) {
            let [mut straight, mut restored] = [saved.copied(), saved.restored()];
            let outcomes = [&mut straight, &mut restored].map(|flight| {
                change.into_iter().for_each(|(name, value)| flight.set(name, value));
                let mut ends_s = (1..3).map(|k| self.saved_s + f64::from(k) * self.onward_s);
                ends_s.try_for_each(|end_s| flight.step_to(end_s)).map_err(|error| error.to_string())
            });
            let [a, b] = outcomes;
            refused += usize::from(a.is_err());
            let off = straight.output_bits().into_iter().zip(restored.output_bits()).find(|(a, b)| a != b);
            if a != b {
                elsewhere.push(format!("{change:?}: {a:?} {b:?}"));
            } else if let Some(((name, x), (_, y))) = off {
                elsewhere.push(format!("{change:?}: {name} {} {}", f64::from_bits(x), f64::from_bits(y)));
            }
        }
        assert!(count > 30 && 20 * refused < count, "{refused} of {count} refused");
        elsewhere
    }

    fn goes_on(&self) {
        let elsewhere = self.goes_elsewhere();
        assert!(elsewhere.is_empty(), "{}", elsewhere.join("\n"));
    }
}

fn full(sets: &[&[(&'static str, f64)]]) -> (NamedModel<MomentumPlant>, Vec<(&'static str, f64)>) {
    (NamedModel::with("messenger-full.toml", FULL), [&[CONTROLLED][..], &sets.concat()].concat())
}

#[test]
fn in_a_burn() {
    let (named, sets) = full(&[&[("thrust.request", 2.0), ("thrust.command", 1.0)]]);
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.real("propellant.used") > 0.0;
    Mode { named, sets, on_the_way: &[], saved_s: 1.3, onward_s: 0.5, is_meant }.goes_on();
}

#[test]
fn in_the_tail_off_of_a_burn() {
    let (named, sets) = full(&[&[("thrust.request", 1.0), ("thrust.command", 1.0)]]);
    let on_the_way: &[Set<'_>] = &[(1.0, &[("thrust.command", 0.0)])];
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.real("thruster[1].thrust") > 0.0;
    Mode { named, sets, on_the_way, saved_s: 1.1, onward_s: 0.5, is_meant }.goes_on();
}

#[test]
fn in_a_dump_by_thrusters() {
    let (named, sets) = full(&[&[("wheel[1].startMomentum", 2.0), ("dump.request", 1.0)]]);
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.boolean("dump.active");
    Mode { named, sets, on_the_way: &[], saved_s: 1.3, onward_s: 0.5, is_meant }.goes_on();
}

#[test]
fn in_a_pulse() {
    let named = NamedModel::<MomentumPlant>::with("messenger-full.toml", FULL);
    let sets = [&FREE[..], &[("thruster[1].onDelay", 0.5), ("thruster[1].onTime", 0.5)]].concat();
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.real("thruster[1].thrust") > 0.0;
    Mode { named, sets, on_the_way: &[], saved_s: 1.0, onward_s: 0.3, is_meant }.goes_on();
}

#[test]
fn in_air_and_field() {
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.real("atmosphere.density") > 0.0;
    let plain = [("planetLight.enabled", 0.0)];
    for (sets, saved_s, onward_s) in [
        (plain.to_vec(), 130.0, 60.0),
        ([&plain[..], &FREE].concat(), 130.25, 2.0),
        ([&plain[..], &[CONTROLLED]].concat(), 30.25, 2.0),
        (
            [&plain[..], &[("atmosphere.method", 3.0), ("atmosphere.givenDensity", 1e-12)]].concat(),
            130.0,
            60.0,
        ),
    ] {
        let named = NamedModel::with("cubesat-12u.toml", CUBESAT);
        Mode { named, sets, on_the_way: &[], saved_s, onward_s, is_meant }.goes_on();
    }
}

#[test]
fn in_light_heat_and_dumps_at_once() {
    let named = NamedModel::with("radiating.toml", RADIATING);
    let sets = [EFFECTS, SHADOWED, BUSY].concat();
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.integer("dump.count") > 0;
    Mode { named, sets, on_the_way: &[], saved_s: 5_130.0, onward_s: 130.0, is_meant }.goes_on();
}

/// Light, heat, shadows and a disturbed orbit in every source of the attitude.
#[test]
fn in_light_and_heat_of_every_attitude() {
    let third = "[[wheels]]\naxis = [0.0, 0.0, 1.0]\ncapacity_n_m_s = 4.0\n";
    for source in SOURCES {
        let named = NamedModel::with("radiating.toml", &format!("{RADIATING}{third}"));
        let sets = [EFFECTS, SHADOWED, &[("attitude.source", source), ("start.q[4]", 1.0), BUSY[0]]].concat();
        let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.vector("torque.thermal").norm() > 0.0;
        let (saved_s, onward_s) = if source < 3.0 { (310.0, 60.0) } else { (3.3, 0.9) };
        Mode { named, sets, on_the_way: &[], saved_s, onward_s, is_meant }.goes_on();
    }
}

/// Place, Sun, Earth, air and field by inputs, in every source of the attitude.
#[test]
fn under_given_surroundings_of_every_attitude() {
    for source in SOURCES {
        let named = NamedModel::with("cubesat-12u.toml", CUBESAT);
        let sets = [&GIVEN[..], &[("attitude.source", source), ("start.q[4]", 1.0)]].concat();
        let is_meant = |it: &NamedInstance<'_, MomentumPlant>| {
            let acting = ["torque.solar", "torque.aerodynamic", "torque.magnetic"];
            acting.iter().all(|name| it.vector(name).norm() > 0.0)
        };
        let (saved_s, onward_s) = if source < 3.0 { (310.0, 60.0) } else { (3.3, 0.9) };
        Mode { named, sets, on_the_way: &[], saved_s, onward_s, is_meant }.goes_on();
    }
}

#[test]
fn under_panels_that_turn() {
    let massive = FULL.replace("[[panels]]\n", "[[panels]]\nmass_kg = 20.0\n");
    let named = NamedModel::with("massive.toml", &massive);
    let sets = [&FREE[..], &[("start.rate[1]", 4e-3)]].concat();
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.real("panel[1].angleActual") != 0.0;
    Mode { named, sets, on_the_way: &[], saved_s: 3.25, onward_s: 0.5, is_meant }.goes_on();
}

#[test]
fn under_a_timeline() {
    let timeline = "[[command]]\nat = 0\nscenario = \"downlink\"\nsun = { azimuth = \"3 deg\", elevation = \"-2 deg\" }\n\
                    [[panels]]\nat = 3000\nsunOffset = \"40 deg\"\nwindmill = \"3 deg\"\n\
                    [[event]]\nat = 3300\ndump = [0.1, 0.2, -0.3]\n[[event]]\nat = 3500\nmaneuver = { deltaV = [0.5, -1, 0.2] }\n\
                    [[event]]\nat = 4000\ndump = [0.2, 0.0, 0.1]\n";
    let named = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", timeline);
    let sets = vec![("panel[1].control", 4.0), ("panel[2].control", 4.0)];
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.integer("dump.count") == 2;
    Mode { named, sets, on_the_way: &[], saved_s: 3_650.0, onward_s: 400.0, is_meant }.goes_on();
}

#[test]
fn between_predictions() {
    let sets =
        [&cruise::sets(&cruise::start(2e5, 0.0), true)[..], &[("prediction.refresh", 3_600.0)]].concat();
    let is_meant = |it: &NamedInstance<'_, MomentumPlant>| it.boolean("prediction.valid");
    let named = NamedModel::<MomentumPlant>::shipped();
    Mode { named, sets, on_the_way: &[], saved_s: 4_000.0, onward_s: 2_000.0, is_meant }.goes_on();
}

#[test]
fn with_modes_slosh_and_rotors() {
    let named = NamedModel::<MomentumPlant>::with("flexible-craft.toml", FLEXIBLE);
    let sets = vec![CONTROLLED, ("command.source", 2.0)];
    Mode { named, sets, on_the_way: &[], saved_s: 1.27, onward_s: 0.3, is_meant: |_| true }.goes_on();
}

#[test]
fn following_commands() {
    let on_the_way: &[Set<'_>] = &[(100.0, &[("command.rate[1]", 1e-4), ("maneuver.deltaV[1]", 0.3)])];
    for source in [2.0, 3.0] {
        let named = NamedModel::<MomentumPlant>::shipped();
        let sets = vec![("attitude.source", source), ("command.q[1]", 0.6), ("command.q[4]", 0.8)];
        Mode { named, sets, on_the_way, saved_s: 103.7, onward_s: 5.0, is_meant: |_| true }.goes_on();
    }
}

#[test]
fn in_guidance() {
    for case in CUT {
        let named = NamedModel::<Guidance>::shipped();
        let sets = [PLACED, case].concat();
        Mode { named, sets, on_the_way: &[], saved_s: 20.5, onward_s: 3.3, is_meant: |_| true }.goes_on();
    }
}

/// Events of a timeline that the state has never seen come at their times, those before the state do not.
#[test]
fn in_guidance_by_another_timeline() {
    let with = |events: &[f64]| {
        let event = |at_s: &f64| format!("[[event]]\nat = {at_s:?}\ndump = [0.1, 0.0, 0.2]\n");
        let timeline: String = events.iter().map(event).collect();
        NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", &timeline)
    };
    let (old, other) = (with(&[3.0, 5.0, 7.0]), with(&[4.0, 9.0, 12.0]));
    let mut saved = old.initialize(0.0, PLACED).unwrap();
    saved.step_to(10.5).unwrap();
    let mut restored = saved.restored_by(&other);
    let requested = [11.5, 12.5, 13.5].map(|at_s| {
        restored.step_to(at_s).unwrap();
        restored.boolean("dump.request")
    });
    assert_eq!(requested, [false, true, false]);
}

/// A spinner integrated by cells: under a torque with a pulse on, in given geometry.
pub(crate) const SPINNER_BY_CELLS: [(&str, f64); 6] = [
    ("burn.timing", 3.0),
    ("inertia[1]", 230.0),
    ("geometry.source", 2.0),
    ("starTracker.sampling", 2.0),
    ("burn.pulseWidth", 2.0),
    ("burn.count", 10.0),
];

#[test]
fn of_a_spinner_and_in_given_geometry() {
    for (sets, saved_s) in [
        (vec![("burn.timing", 2.0)], 50.1),
        (vec![("burn.plan", 4.0), ("thruster[1].fire", 1.0)], 50.1),
        (SPINNER_BY_CELLS.to_vec(), 50.0),
        (SPINNER_BY_CELLS.to_vec(), 10.22),
    ] {
        let named = NamedModel::<SpinPlant>::shipped();
        Mode { named, sets, on_the_way: &[], saved_s, onward_s: 2.3, is_meant: |_| true }.goes_on();
    }
    let named = NamedModel::<DisturbanceTorque>::shipped();
    let sets = vec![("sun.positionBody[2]", -6e10), ("planet.positionBody[3]", 4e6)];
    Mode { named, sets, on_the_way: &[], saved_s: 10.0, onward_s: 5.0, is_meant: |_| true }.goes_on();
    let named = NamedModel::<DisturbanceTorque>::with("radiating.toml", RADIATING);
    let sets = [EFFECTS, &[("sun.positionBody[2]", -6e10), ("planet.positionBody[3]", 4e6)]].concat();
    Mode { named, sets, on_the_way: &[], saved_s: 10.0, onward_s: 5.0, is_meant: |_| true }.goes_on();
}
