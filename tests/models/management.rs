//! Momentum management by sunlight: targets that are hit, limits, strategies, and what must not change them.

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::Vector3;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const HOUR_S: f64 = 3600.0;

type Plant<'m> = NamedInstance<'m, MomentumPlant>;
type Sets = Vec<(&'static str, f64)>;

/// A spacecraft that stands still beside a Sun and an Earth that do: one downlink of eight hours after an hour.
fn still(separation_deg: f64) -> Sets {
    let earth_rad = separation_deg.to_radians();
    vec![
        ("orbit.source", 3.0),
        ("orbit.position[1]", 1e7),
        ("orbit.velocity[2]", 1e3),
        ("ephemeris.source", 3.0),
        ("sun.position[1]", -4.0e10),
        ("sun.position[2]", 2.0e10),
        ("sun.position[3]", 1.0e10),
        ("earth.position[1]", 1.5e11 * (earth_rad + 2.0).cos()),
        ("earth.position[2]", 1.5e11 * (earth_rad + 2.0).sin()),
        ("earth.position[3]", 3e10),
        ("gravityGradient.enabled", 0.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", HOUR_S),
        ("guided.downlinkEnd", 9.0 * HOUR_S),
        ("momentum.strategy", 2.0),
        ("start.momentum[1]", 0.4),
        ("start.momentum[2]", -0.1),
        ("start.momentum[3]", -0.3),
        ("spacecraft.centerOfMass[3]", 0.02),
    ]
}

fn with(sets: &Sets, more: &[(&'static str, f64)]) -> Sets {
    let mut all: Sets =
        sets.iter().filter(|(name, _)| !more.iter().any(|(n, _)| n == name)).copied().collect();
    all.extend(more);
    all
}

#[test]
fn an_attainable_target_is_hit_to_a_nanonewton_metre_second() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let target = Vector3::new(0.1, 5.0, -0.05);
    let mut hit = 0;
    for separation_deg in [20.0, 75.0, 100.0, 160.0] {
        for convention in [1.0, 2.0] {
            for axes in [1.0, 2.0, 3.0] {
                for start_s in [0.0, 1e6] {
                    let sets = with(
                        &still(separation_deg),
                        &[
                            ("momentum.convention", convention),
                            ("momentum.targetAxes", axes),
                            ("momentum.target[1]", target.x),
                            ("momentum.target[2]", target.y),
                            ("momentum.target[3]", target.z),
                        ],
                    );
                    let mut flight = named.initialize(start_s, &sets).unwrap();
                    flight.step_to(start_s + 1.5 * HOUR_S).unwrap();
                    let clamped = flight.boolean("momentum.targetClamped");
                    let (azimuth_rad, elevation_rad) =
                        (flight.real("sun.azimuth"), flight.real("sun.elevation"));
                    let earth = (flight.real("earth.azimuth").to_degrees(), flight.real("earth.elevation"));
                    assert!(earth.1.abs() < 1e-12, "{earth:?}");
                    flight.step_to(start_s + 8.0 * HOUR_S).unwrap();
                    assert_eq!(flight.real("sun.azimuth"), azimuth_rad);
                    flight.step_to(start_s + 9.0 * HOUR_S - 1e-6).unwrap();
                    let end = flight.vector("momentum.body");
                    if clamped {
                        continue;
                    }
                    hit += 1;
                    let off = end - target;
                    let wrong = match axes as i32 {
                        1 => off.x.abs(),
                        2 => off.z.abs(),
                        _ => off.xz().amax(),
                    };
                    assert!(wrong < 1e-9, "{separation_deg} {convention} {axes}: {off:?}");
                    assert!(axes != 1.0 || azimuth_rad.abs() < 1e-12);
                    assert!(axes != 2.0 || elevation_rad.abs() < 1e-12);
                    let covered = (-90.0..=1e-9).contains(&earth.0) || earth.0 >= 90.0;
                    assert!(covered && flight.real("keepIn.margin") > -1e-9, "{earth:?}");
                }
            }
        }
    }
    assert!(hit >= 36, "{hit}");
}

#[test]
fn a_downlink_at_the_start_takes_the_momentum_of_the_start() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = with(&still(60.0), &[("guided.downlinkStart", 0.0), ("guided.downlinkEnd", 8.0 * HOUR_S)]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    assert!((flight.vector("momentum.body") - Vector3::new(0.4, -0.1, -0.3)).amax() < 1e-12);
    assert!(flight.real("sun.elevation").abs() > 0.01);
    flight.step_to(8.0 * HOUR_S - 1e-6).unwrap();
    assert!(flight.vector("momentum.body").xz().amax() < 1e-9, "{:?}", flight.vector("momentum.body"));
}

#[test]
fn a_target_out_of_reach_is_flagged_while_the_downlink_lasts() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &with(&still(60.0), &[("momentum.target[1]", 30.0)])).unwrap();
    assert!(!flight.boolean("momentum.targetClamped"));
    flight.step_to(2.0 * HOUR_S).unwrap();
    assert!(flight.boolean("momentum.targetClamped"));
    let limit_rad = flight.real("keepIn.margin");
    assert!(limit_rad.abs() < 1e-6, "{limit_rad}");
    flight.step_to(9.5 * HOUR_S).unwrap();
    assert!(!flight.boolean("momentum.targetClamped"));
}

#[test]
fn the_linear_formula_falls_short_of_the_exact_one() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let end = |targeting: f64| {
        let sets = [
            ("momentum.targeting", targeting),
            ("momentum.convention", 2.0),
            ("panel[1].enabled", 0.0),
            ("panel[2].enabled", 0.0),
        ];
        let mut flight = named.initialize(0.0, &with(&still(60.0), &sets)).unwrap();
        flight.step_to(HOUR_S - 1e-3).unwrap();
        let start = flight.vector("momentum.body").xz().norm();
        flight.step_to(9.0 * HOUR_S - 1e-6).unwrap();
        flight.vector("momentum.body").xz().norm() / start
    };
    let (exact, linear) = (end(1.0), end(2.0));
    println!("left by the linear formula: {:.2} %", 100.0 * linear);
    assert!(exact < 1e-8 && (1e-3..0.08).contains(&linear), "{exact} {linear}");
}

/// Ninety days in the paper's convention.
fn mission(strategy: f64) -> Sets {
    vec![
        ("momentum.strategy", strategy),
        ("momentum.convention", 2.0),
        ("solar.fixedPressure", 1.0),
        ("sunshade.shape", 2.0),
        ("panel[1].enabled", 0.0),
        ("panel[2].enabled", 0.0),
        ("gravityGradient.enabled", 0.0),
        ("spacecraft.centerOfMass[3]", 0.05),
        ("dump.threshold[1]", 4.0),
        ("dump.threshold[2]", 4.0),
        ("dump.threshold[3]", 4.0),
        ("dump.reinitFraction", 1.0),
    ]
}

#[test]
fn targets_save_dumps_and_looking_ahead_saves_more() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let dumps = [1.0, 2.0, 3.0].map(|strategy| {
        let mut flight = named.initialize(0.0, &mission(strategy)).unwrap();
        flight.simulate_to(short_or_long(60.0, 90.0) * 86_400.0, 3600.0).unwrap();
        flight.integer("dump.count")
    });
    println!("dumps only, reactive, predictive: {dumps:?}");
    assert!(dumps[0] > dumps[1] && dumps[1] >= dumps[2], "{dumps:?}");
}

/// A part of 1 that fills the unit interval evenly over `mission`, by the `of`-th irrational.
fn part(mission: u32, of: usize) -> f64 {
    const IRRATIONALS: [f64; 12] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0];
    ((f64::from(mission) + 0.5) * IRRATIONALS[of].sqrt()).fract()
}

/// A mission of its own place in space of what the strategies meet.
fn random_mission(number: u32, convention: f64) -> Sets {
    let between = |of: usize, low: f64, high: f64| low + (high - low) * part(number, of);
    let flag = |of: usize| f64::from(u8::from(part(number, of) < 0.5));
    let threshold = between(0, 2.0, 8.0);
    let start_s = between(1, 1.0, 5.0) * HOUR_S;
    vec![
        ("momentum.convention", convention),
        ("start.epoch", 292_248_000.0 + between(2, 0.0, 120.0) * 86_400.0),
        ("spacecraft.centerOfMass[1]", between(3, -0.03, 0.03)),
        ("spacecraft.centerOfMass[3]", between(4, -0.06, 0.06)),
        ("dump.threshold[1]", threshold),
        ("dump.threshold[2]", threshold),
        ("dump.threshold[3]", threshold),
        ("dump.reinitFraction", if flag(5) > 0.0 { 1.0 } else { between(6, 0.0, 1.0) }),
        ("guided.downlinkStart", start_s),
        ("guided.downlinkEnd", start_s + between(7, 4.0, 9.0) * HOUR_S),
        ("solar.fixedPressure", flag(8)),
        ("gravityGradient.enabled", flag(9)),
        ("sunshade.shape", 1.0 + flag(10)),
        ("panel[1].enabled", flag(11)),
        ("panel[2].enabled", flag(11)),
    ]
}

/// Dumps of sixty days, and the shortest time between two, in s.
fn dumps_of(named: &NamedModel<MomentumPlant>, mission: &Sets, strategy: f64) -> (i32, f64) {
    let mut flight = named.initialize(0.0, &with(mission, &[("momentum.strategy", strategy)])).unwrap();
    let (mut count, mut last_s, mut shortest_s) = (0, f64::NEG_INFINITY, f64::INFINITY);
    for hour in 1..=60 * 24 {
        flight.step_to(f64::from(hour) * HOUR_S).unwrap();
        let (now, at_s) = (flight.integer("dump.count"), flight.real("dump.lastTime"));
        if now > count {
            // Of several within the step the time between them is less than it.
            shortest_s = shortest_s.min(if now > count + 1 { 0.0 } else { at_s - last_s });
            (count, last_s) = (now, at_s);
        }
    }
    (count, shortest_s)
}

#[test]
fn predictive_targets_cost_no_dumps_in_any_mission() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let (mut saved, mut worse) = (0, Vec::new());
    let missions: u32 = short_or_long(1, 30);
    for number in 0..missions {
        let mission = random_mission(number, 2.0);
        let [reactive, predictive] = [2.0, 3.0].map(|strategy| dumps_of(&named, &mission, strategy));
        println!("{number}: reactive {reactive:?}, predictive {predictive:?}");
        saved += reactive.0 - predictive.0;
        if predictive.0 > reactive.0 || predictive.1 < 0.1 * 86_400.0 {
            worse.push((number, reactive, predictive));
        }
    }
    assert!(worse.is_empty() && saved > short_or_long(0, missions.cast_signed()), "{saved} {worse:?}");
}

#[test]
fn the_communication_step_changes_no_dump() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for strategy in [1.0, 2.0, 3.0] {
        let steps_s = short_or_long(&[60.0, 600.0][..], &[10.0, 60.0, 600.0]);
        let simulated = steps_s.iter().map(|&step_s| {
            let mut flight = named.initialize(0.0, &mission(strategy)).unwrap();
            flight.simulate_to(short_or_long(15.0, 90.0) * 86_400.0, step_s).unwrap();
            (flight.integer("dump.count"), flight.real("dump.lastTime"))
        });
        let simulated: Vec<_> = simulated.collect();
        assert!(simulated.iter().all(|it| *it == simulated[0]), "{strategy}: {simulated:?}");
    }
}

#[test]
fn looking_ahead_under_a_turning_body_costs_no_dumps() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let dumps = [2.0, 3.0].map(|strategy| {
        let mut flight =
            named.initialize(0.0, &with(&mission(strategy), &[("momentum.convention", 1.0)])).unwrap();
        flight.simulate_to(short_or_long(60.0, 90.0) * 86_400.0, 3600.0).unwrap();
        flight.integer("dump.count")
    });
    println!("physical momentum: reactive, predictive: {dumps:?}");
    assert!(dumps[1] <= dumps[0], "{dumps:?}");
}

#[test]
fn cutting_and_saving_change_no_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for strategy in [2.0, 3.0] {
        for more in [
            &[("guided.slewRate", 1e-3)][..],
            &[("momentum.convention", 1.0), ("gravityGradient.enabled", 1.0)],
            &[("orbit.dynamics", 2.0)],
            &[("momentum.convention", 1.0), ("attitude.source", 3.0), ("command.source", 2.0)],
        ] {
            let sets = with(&mission(strategy), more);
            let is_simulated = more.iter().any(|(name, _)| *name == "attitude.source");
            let (from_s, until_s) =
                if is_simulated { (6000.0, 8000.0) } else { (80_000.0, short_or_long(110_000.0, 220_000.0)) };
            let step_s = if is_simulated { 333.3 } else { 7777.7 };
            assert_cuts_change_nothing(
                || named.initialize(0.0, &sets).unwrap(),
                [from_s, until_s],
                &[step_s],
                |_| {},
            );
        }
    }
}

#[test]
fn a_controlled_flight_turns_to_the_chosen_place() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = with(
        &still(60.0),
        &[
            ("attitude.source", 3.0),
            ("command.source", 2.0),
            ("control.rate", 10.0),
            ("start.momentum[1]", 0.0),
            ("start.momentum[2]", 0.0),
            ("start.momentum[3]", 0.0),
            ("wheel[1].startMomentum", 0.5),
            ("guided.downlinkStart", 100.0),
            ("guided.downlinkEnd", 8.0 * HOUR_S + 100.0),
            ("momentum.strategy", 2.0),
        ],
    );
    let mut flight = named.initialize(0.0, &sets).unwrap();
    flight.step_to(99.0).unwrap();
    let before = flight.vector("momentum.body");
    flight.step_to(2000.0).unwrap();
    let (azimuth_rad, elevation_rad) = (flight.real("sun.azimuth"), flight.real("sun.elevation"));
    assert!(azimuth_rad.abs().max(elevation_rad.abs()) > 0.02, "{azimuth_rad} {elevation_rad} {before:?}");
    flight.step_to(8.0 * HOUR_S + 100.0).unwrap();
    let end = flight.vector("momentum.body");
    // The slew, and what a controller is off, are all that is missing.
    assert!(
        flight.boolean("momentum.targetClamped") || end.xz().norm() < 0.03 * before.xz().norm(),
        "{before:?} {end:?}"
    );
}

#[test]
fn a_commanded_offset_turns_the_panels_as_a_parameter_does() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut by_parameter = named.initialize(0.0, &[("panel[1].sunOffset", 0.7)]).unwrap();
    let commanded = [("panel[1].control", 3.0), ("panel[1].sunOffsetCommand", 0.7)];
    let mut by_input = named.initialize(0.0, &commanded).unwrap();
    for flight in [&mut by_parameter, &mut by_input] {
        flight.step_to(5000.0).unwrap();
    }
    assert_eq!(by_parameter.output_bits(), by_input.output_bits());
    by_input.set("panel[1].sunOffsetCommand", 0.3);
    by_input.step_to(5001.0).unwrap();
    assert_ne!(by_parameter.real("panel[1].angleActual"), by_input.real("panel[1].angleActual"));
}

#[test]
fn a_held_place_is_the_inputs_own() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &still(60.0)).unwrap();
    flight.step_to(500.0).unwrap();
    assert_eq!(flight.vector("position"), Vector3::new(1e7, 0.0, 0.0));
    assert_eq!(flight.vector("velocity"), Vector3::new(0.0, 1e3, 0.0));
    flight.set("orbit.position[3]", 2e6);
    flight.step_to(501.0).unwrap();
    assert_eq!(flight.vector("position"), Vector3::new(1e7, 0.0, 2e6));
    // Without a velocity it stands still; without a position it is not known.
    let mut resting = named.initialize(0.0, &with(&still(60.0), &[("orbit.velocity[2]", 0.0)])).unwrap();
    resting.step_to(10.0 * HOUR_S).unwrap();
    assert_eq!(resting.vector("position"), Vector3::new(1e7, 0.0, 0.0));
    let waiting = named.initialize(0.0, &with(&still(60.0), &[("orbit.position[1]", 0.0)])).unwrap();
    assert_eq!(waiting.vector("sun.direction"), Vector3::zeros());
}

/// The sum of all sources less a change of the momentum, body frame, relative to the greatest source.
fn unexplained(flight: &Plant<'_>, change: &Vector3<f64>) -> f64 {
    let names = ["solar", "albedo", "infrared", "thermal", "gravityGradient", "applied"];
    let parts = names.map(|name| flight.vector(&format!("momentum.{name}")));
    let greatest = parts.iter().map(|part| part.amax()).fold(0.0, f64::max);
    assert!(greatest > 1e-6, "{parts:?}");
    (parts.iter().sum::<Vector3<f64>>() - change).amax() / greatest
}

const EFFECTS: [(&str, f64); 5] = [
    ("planetLight.enabled", 1.0),
    ("thermal.enabled", 1.0),
    ("gravityGradient.enabled", 1.0),
    ("torque.applied[1]", 2e-6),
    ("torque.applied[3]", -1e-6),
];

#[test]
fn sources_add_up_to_the_momentum_since_the_last_dump() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // Lower thresholds make for dumps in fewer days.
    let (days, threshold) = short_or_long((15, 2.5), (60, 4.0));
    for convention in [1.0, 2.0] {
        let sets = with(
            &mission(1.0),
            &[
                ("momentum.convention", convention),
                ("gravityGradient.enabled", 1.0),
                ("dump.threshold[1]", threshold),
                ("dump.threshold[2]", threshold),
                ("dump.threshold[3]", threshold),
            ],
        );
        let mut flight = named.initialize(0.0, &[&sets[..], &EFFECTS[..2], &EFFECTS[3..]].concat()).unwrap();
        let (mut since, mut dumps, mut checked) = (Vector3::zeros(), 0, 0);
        for day in 1..=days {
            flight.step_to(86_400.0 * f64::from(day)).unwrap();
            let count = flight.integer("dump.count");
            let (body, inertial) = (flight.vector("momentum.body"), flight.vector("momentum.inertial"));
            let now = if convention == 1.0 { inertial } else { body };
            if count == dumps {
                let turn = flight.to_inertial("attitude.q");
                let change = now - since;
                let change = if convention == 1.0 { turn.inverse() * change } else { change };
                let off = unexplained(&flight, &change);
                assert!(off < 1e-12 * f64::from(day).max(10.0), "day {day}: {off:e}");
                checked += 1;
            } else {
                // The dump's own end is not an output: from here on count what follows.
                dumps = count;
                let names = ["solar", "albedo", "infrared", "thermal", "gravityGradient", "applied"];
                let sum: Vector3<f64> =
                    names.iter().map(|name| flight.vector(&format!("momentum.{name}"))).sum();
                let turn = flight.to_inertial("attitude.q");
                since = now - if convention == 1.0 { turn * sum } else { sum };
            }
        }
        assert!(dumps > 2 && checked > days / 3, "{dumps} {checked}");
    }
}

#[test]
fn sources_add_up_in_controlled_flight() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets =
        [&[("attitude.source", 3.0), ("command.source", 2.0), ("wheel[1].startMomentum", 1.0)][..], &EFFECTS]
            .concat();
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let start = flight.vector("momentum.inertial");
    for end_s in [0.7, 100.0, 7300.0] {
        flight.step_to(end_s).unwrap();
        let change =
            flight.to_inertial("attitude.q").inverse() * (flight.vector("momentum.inertial") - start);
        let off = unexplained(&flight, &change);
        // The start is a momentum of 1 N m s, of which the change is a small difference.
        assert!(off * change.norm() < 1e-12, "{end_s}: {off:e}");
    }
}
