//! Two events of different kinds at one time, all pairs that a flight can have: however a master cuts the flight there, and
//! whether it saves and restores, the outputs are the same to the bit; at one time events come in the order of the plant's loop.

use std::collections::BTreeMap;

use client::short_or_long;
use models::MomentumPlant;
use physics::constants::ASTRONOMICAL_UNIT_M;

use super::named_model::{NamedInstance, NamedModel, assert_same};
use super::spacecraft::{couples, thruster};

type Plant<'a> = NamedInstance<'a, MomentumPlant>;

const GUIDED: f64 = 1.0;
const COMMANDED: f64 = 2.0;
const CONTROLLED: f64 = 3.0;
const FREE: f64 = 4.0;
const IDEAL: &[f64] = &[GUIDED, COMMANDED];
const BY_TORQUE: &[f64] = &[CONTROLLED, FREE];
const ALL: &[f64] = &[GUIDED, COMMANDED, CONTROLLED, FREE];

/// Two tanks in the centre of mass, a panel with a mass and its hinge there, three wheels.
const CRAFT: &str = r#"
name = "coincident"
[mass_properties]
mass_kg = 500.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[200.0, 0.0, 0.0], [0.0, 300.0, 0.0], [0.0, 0.0, 400.0]]
[optics.black]
specular = 0.0
diffuse = 0.0
[[plates]]
area_m2 = 1.0
center_m = [0.1, 0.0, 0.2]
normal = [0.0, -1.0, 0.0]
optics = "black"
[[panels]]
name = "wing"
mass_kg = 5.0
area_m2 = 1.0
center_m = [2.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
zero_normal = [0.0, -1.0, 0.0]
optics = "black"
control = "sun_offset"
[[wheels]]
axis = [1.0, 0.0, 0.0]
capacity_n_m_s = 200.0
[[wheels]]
axis = [0.0, 1.0, 0.0]
capacity_n_m_s = 200.0
[[wheels]]
axis = [0.0, 0.0, 1.0]
capacity_n_m_s = 200.0
[[antennas]]
name = "dish"
azimuth_deg = [-180, 180]
beam_deg = [3, 3]
[[tanks]]
name = "main"
position_m = [0.0, 0.0, 0.0]
propellant_kg = 50.0
[[tanks]]
name = "small"
position_m = [0.0, 0.0, 0.0]
propellant_kg = 1.0
"#;

/// Thrust of each engine through the centre of mass, in N.
const THRUST_N: f64 = 5.0;
const EXHAUST_M_S: f64 = 220.0 * 9.80665;
/// Engines through the centre of mass, from 1 on: none gives a torque, so that dumps are a constant torque without couples.
const EMPTYING: usize = 1;
const CLOSING: usize = 2;
const RISING: usize = 3;
const TAILING: usize = 4;
const PULSED: usize = 5;
const ENGINES: usize = 7;
/// A pulse, in s.
const PULSE_S: f64 = 0.5;
/// Times at which engines are opened, commands end, and dumps, burns and torques are requested, in s.
const BEGUN_S: [f64; 3] = [1.0, 1.5, 2.0];

/// Arrangement of a flight: its spacecraft, settings, schedule and inputs.
struct Arrangement {
    source: f64,
    /// Keys of each engine.
    engines: [String; ENGINES],
    has_couples: bool,
    sets: BTreeMap<&'static str, f64>,
    timeline: String,
    /// Keys of the schedule's event, which stands at one time.
    event: (f64, String),
    /// Inputs by the time of the communication point at which they are set.
    inputs: Vec<(f64, String, f64)>,
    /// Span in s of a step that no flight cuts, for its inputs are a pulse.
    pulse: Option<[f64; 2]>,
    /// The event's time where it is a communication point in every flight, in s.
    point_s: Option<f64>,
}

impl Arrangement {
    fn new(source: f64) -> Self {
        let is_ideal = IDEAL.contains(&source);
        let mut arrangement = Self {
            source,
            engines: Default::default(),
            has_couples: false,
            sets: BTreeMap::new(),
            timeline: String::new(),
            event: (0.0, String::new()),
            inputs: Vec::new(),
            pulse: None,
            point_s: None,
        };
        // Hardly any light: directions are selected, and momentum is the integral of what is applied.
        for (name, value) in [
            ("attitude.source", source),
            ("solar.flux", 1e-9),
            ("gravityGradient.enabled", 0.0),
            ("dump.threshold[1]", 1e9),
            ("dump.threshold[3]", 1e9),
            ("maneuver.dump", 0.0),
        ] {
            arrangement.put(name, value);
        }
        if source == GUIDED {
            arrangement.put("guided.scienceRule", 7.0);
        }
        if !is_ideal {
            arrangement.put("start.q[4]", 1.0);
        }
        arrangement
    }

    /// Sets a start value that no other event of the flight needs otherwise.
    fn put(&mut self, name: &'static str, value: f64) {
        let before = self.sets.insert(name, value);
        assert!(before.is_none_or(|it| it == value), "{name}: {before:?} and {value}");
    }

    /// The same where nothing else sets it.
    fn put_unless_set(&mut self, name: &'static str, value: f64) {
        self.sets.entry(name).or_insert(value);
    }

    fn input(&mut self, at_s: f64, name: &str, value: f64) {
        self.inputs.push((at_s, name.to_owned(), value));
    }

    /// Inputs at the event's time, which is a communication point.
    fn request(&mut self, at_s: f64, sets: &[(&str, f64)]) {
        self.point_s = Some(at_s);
        sets.iter().for_each(|(name, value)| self.input(at_s, name, *value));
    }

    fn event(&mut self, at_s: f64, what: &str) {
        self.event = (at_s, format!("{}{what}\n", self.event.1));
    }

    /// Opens an engine until its shortest time is over.
    fn open(&mut self, engine: usize, keys: String) {
        self.engines[engine - 1] = keys;
        let name = format!("thruster[{engine}].onTime");
        self.input(BEGUN_S[0], &name, BEGUN_S[1] - BEGUN_S[0]);
        self.input(BEGUN_S[1], &name, 0.0);
    }

    /// Gives the flight a momentum about X and requests a dump of it.
    fn dump_from(&mut self, momentum_n_m_s: f64) {
        self.put("wheel[1].startMomentum", momentum_n_m_s);
        self.input(BEGUN_S[2], "dump.request", 1.0);
        self.input(BEGUN_S[2] + 1.0, "dump.request", 0.0);
    }

    fn model(&self) -> NamedModel<MomentumPlant> {
        let engine = |(keys, at): (&String, usize)| {
            let tank = if at + 1 == EMPTYING { "small" } else { "main" };
            let more =
                format!("tank = \"{tank}\"\nattitude_control = false\nset = \"set{}\"\n{keys}", at + 1);
            thruster([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], THRUST_N, &more)
        };
        let engines: String = self.engines.iter().zip(0..).map(engine).collect();
        let couples = if self.has_couples { couples("tank = \"main\"") } else { String::new() };
        let named = NamedModel::with("coincident.toml", &format!("{CRAFT}{engines}{couples}"));
        let mut timeline = self.timeline.clone();
        if !self.event.1.is_empty() {
            timeline += &format!("[[event]]\nat = {:?}\n{}", self.event.0, self.event.1);
        }
        if timeline.is_empty() { named } else { named.with_schedule("timeline.toml", &timeline) }
    }

    fn begin<'a>(&self, named: &'a NamedModel<MomentumPlant>) -> Plant<'a> {
        let sets: Vec<(&str, f64)> = self.sets.iter().map(|(name, value)| (*name, *value)).collect();
        named.initialize(0.0, &sets).unwrap()
    }

    /// One step with the inputs that belong to it.
    fn step(&self, flight: &mut Plant<'_>, end_s: f64) {
        let start_s = flight.time_s();
        for (at_s, name, value) in &self.inputs {
            if *at_s == start_s {
                flight.set(name, *value);
            }
        }
        flight.step_to(end_s).unwrap_or_else(|error| panic!("{start_s} to {end_s}: {error}"));
    }
}

/// Something that happens in a flight at a time of choice.
struct Kind {
    name: &'static str,
    sources: &'static [f64],
    arrange: fn(&mut Arrangement, f64),
    /// Whether a flight shortly before and one shortly after that time show it.
    shows: fn(&Plant<'_>, &Plant<'_>, f64) -> bool,
}

fn differs(name: &str, before: &Plant<'_>, after: &Plant<'_>) -> bool {
    before.real(name) != after.real(name)
}

/// In flight by torque a threshold is found by a sample, the next one where the end of a dump is late by rounding.
fn dumped(_: &Plant<'_>, after: &Plant<'_>, at_s: f64) -> bool {
    let is_ideal = after.integer("attitude.source") < 3;
    let late_s = if is_ideal { 1e-12 * at_s } else { 1.01 / SAMPLES_HZ };
    (after.real("dump.lastTime") - at_s).abs() <= late_s
}

fn maneuvered(_: &Plant<'_>, after: &Plant<'_>, at_s: f64) -> bool {
    after.real("maneuver.lastTime") == at_s
}

fn thrust_differs(engine: usize, before: &Plant<'_>, after: &Plant<'_>) -> bool {
    differs(&format!("thruster[{engine}].thrust"), before, after)
}

/// Torque about Y by which the momentum comes to its threshold, in N m.
const CROSSING_N_M: f64 = 1.0 / 4096.0;

/// Momentum that a dump by a constant torque takes, in N m s.
const DUMPED_N_M_S: f64 = 1.0 / 256.0;

const KINDS: &[Kind] = &[
    Kind {
        name: "an edge of the grid",
        sources: ALL,
        arrange: |it, at_s| {
            if IDEAL.contains(&it.source) {
                it.put("solver.step", at_s / 4.0);
                it.put("solver.disturbanceStep", at_s / 4.0);
            } else {
                it.put("solver.dynamicsStep", at_s / 8.0);
            }
        },
        shows: |_, _, _| true,
    },
    Kind {
        name: "a step of a panel",
        sources: ALL,
        arrange: |it, at_s| {
            it.put("panel[1].control", 4.0);
            it.timeline += &format!("[[panels]]\nat = {at_s:?}\nsunOffset = \"40 deg\"\n");
        },
        shows: |before, after, _| differs("panel[1].angleActual", before, after),
    },
    Kind {
        name: "the end of an attitude that was held",
        sources: &[GUIDED],
        arrange: |it, at_s| {
            it.timeline += &format!("[[command]]\nat = {at_s:?}\nscenario = \"downlink\"\n");
        },
        shows: |before, after, _| differs("attitude.q[1]", before, after),
    },
    Kind {
        name: "a centre of mass of the schedule",
        sources: IDEAL,
        arrange: |it, at_s| it.event(at_s, "centerOfMass = [0.01, 0.0, -0.02]"),
        shows: |before, after, _| differs("centerOfMass[1]", before, after),
    },
    Kind {
        name: "a maneuver of the schedule",
        sources: IDEAL,
        arrange: |it, at_s| it.event(at_s, "maneuver = { deltaV = [0.1, 0.2, -0.3] }"),
        shows: maneuvered,
    },
    Kind {
        name: "a dump of the schedule",
        sources: ALL,
        arrange: |it, at_s| it.event(at_s, "dump = [0.001, 0.0, 0.002]"),
        shows: dumped,
    },
    Kind {
        name: "a choice of the Sun's direction",
        sources: &[GUIDED],
        arrange: |it, at_s| {
            it.put("momentum.strategy", 2.0);
            it.put("guided.downlinkReference", 2.0);
            it.put("guided.downlinkStart", at_s);
            it.put("guided.downlinkEnd", at_s + 40_000.0);
            it.put("guided.downlinkEvery", 1.0);
        },
        shows: |before, after, _| {
            !before.boolean("downlink.active")
                && after.boolean("downlink.active")
                && differs("sun.azimuth", before, after)
        },
    },
    Kind {
        name: "a momentum at its threshold",
        sources: ALL,
        arrange: |it, at_s| {
            if IDEAL.contains(&it.source) {
                it.put("torque.applied[2]", CROSSING_N_M);
                it.put("dump.threshold[2]", CROSSING_N_M * at_s);
            } else {
                // Beyond it halfway from the sample before.
                it.put("control.rate", SAMPLES_HZ);
                it.input(BEGUN_S[2], "torque.applied[2]", CROSSING_N_M);
                it.put("dump.threshold[2]", CROSSING_N_M * (at_s - BEGUN_S[2] - 0.5 / SAMPLES_HZ));
            }
        },
        shows: dumped,
    },
    Kind {
        name: "a sample",
        sources: BY_TORQUE,
        arrange: |it, _| it.put("control.rate", SAMPLES_HZ),
        shows: |_, _, _| true,
    },
    Kind {
        name: "a prediction",
        sources: ALL,
        arrange: |it, at_s| {
            for (name, value) in [
                ("orbit.center", 2.0),
                ("orbit.frame", 4.0),
                ("orbit.dynamics", 3.0),
                ("orbit.semiMajorAxis", 0.4 * ASTRONOMICAL_UNIT_M),
                ("orbit.eccentricity", 0.0),
                // The Sun stands off the panel's hinge.
                ("orbit.trueAnomaly", 1.0),
                ("encounter.body", 1.0),
                ("prediction.refresh", at_s / 2.0),
                ("prediction.horizon", at_s),
            ] {
                it.put(name, value);
            }
        },
        shows: |before, after, at_s| {
            before.real("prediction.since") < at_s && after.real("prediction.since") == at_s
        },
    },
    Kind {
        name: "a valve that closes",
        sources: BY_TORQUE,
        arrange: |it, at_s| it.open(CLOSING, format!("min_on_time_s = {:?}", at_s - BEGUN_S[0])),
        shows: |before, after, _| thrust_differs(CLOSING, before, after),
    },
    Kind {
        name: "the end of a ramp",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            it.open(RISING, format!("min_on_time_s = 30.0\nrise_time_s = {:?}", at_s - BEGUN_S[0]));
        },
        shows: |before, after, _| {
            let thrust = format!("thruster[{RISING}].thrust");
            before.real(&thrust) < THRUST_N && after.real(&thrust) == THRUST_N
        },
    },
    Kind {
        name: "the end of a tail-off",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            it.open(TAILING, format!("min_on_time_s = 0.5\ntail_off_time_s = {:?}", at_s - BEGUN_S[1]));
        },
        shows: |before, after, _| {
            let thrust = format!("thruster[{TAILING}].thrust");
            before.real(&thrust) > 0.0 && after.real(&thrust) == 0.0
        },
    },
    Kind {
        name: "a tank that runs empty",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            it.put("tank[2].propellant", THRUST_N / EXHAUST_M_S * (at_s - BEGUN_S[0]));
            it.open(EMPTYING, "min_on_time_s = 60.0".to_owned());
        },
        shows: |before, after, _| before.boolean("tank[2].feeds") && !after.boolean("tank[2].feeds"),
    },
    Kind {
        name: "the stop of a delta-v",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            it.input(BEGUN_S[2], "thrust.request", ENGINES as f64);
            it.input(BEGUN_S[2], "thrust.command", 1.0);
            it.input(BEGUN_S[2], "thrust.stop", at_s);
        },
        shows: |before, after, _| thrust_differs(ENGINES, before, after),
    },
    Kind {
        name: "the end of a dump's torque",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            it.put("dump.torque", DUMPED_N_M_S / (at_s - BEGUN_S[2]));
            it.dump_from(DUMPED_N_M_S);
        },
        shows: |before, after, at_s| {
            before.boolean("dump.active") && (!after.boolean("dump.active") || dumped(before, after, at_s))
        },
    },
    Kind {
        name: "pulses of a dump",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            it.has_couples = true;
            it.put_unless_set("control.rate", SAMPLES_HZ);
            it.put("dump.pulsePeriod", (at_s - BEGUN_S[2]) / 4.0);
            it.dump_from(150.0);
        },
        shows: |before, after, _| before.boolean("dump.active") && after.boolean("dump.active"),
    },
    Kind {
        name: "a dump on request",
        sources: ALL,
        arrange: |it, at_s| it.request(at_s, &[("dump.target[2]", 1e-3), ("dump.request", 1.0)]),
        shows: dumped,
    },
    Kind {
        name: "a maneuver on request",
        sources: IDEAL,
        arrange: |it, at_s| it.request(at_s, &[("maneuver.deltaV[1]", 0.3), ("maneuver.request", 1.0)]),
        shows: maneuvered,
    },
    Kind {
        name: "a pulse on request",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            let on_time = format!("thruster[{PULSED}].onTime");
            it.request(at_s, &[(&on_time, PULSE_S)]);
            it.input(at_s + 1.0, &on_time, 0.0);
            it.pulse = Some([at_s, at_s + 1.0]);
        },
        shows: |before, after, _| {
            let pulses = format!("thruster[{PULSED}].pulses");
            before.integer(&pulses) < after.integer(&pulses)
        },
    },
    Kind {
        name: "a delta-v on request",
        sources: BY_TORQUE,
        arrange: |it, at_s| {
            let request = (ENGINES - 1) as f64;
            it.request(
                at_s,
                &[("thrust.request", request), ("thrust.command", 1.0), ("thrust.stop", at_s + 3.0)],
            );
        },
        shows: |before, after, _| thrust_differs(ENGINES - 1, before, after),
    },
];

/// Samples a second where a sample belongs to the events, and where none falls on them.
const SAMPLES_HZ: f64 = 50.0;
const NO_SAMPLES_HZ: f64 = 47.33;

/// Pairs that no flight has, with the reason.
const APART: &[[&str; 3]] = &[
    ["a sample", "a momentum at its threshold", "a sample finds the momentum beyond its threshold"],
    ["a momentum at its threshold", "pulses of a dump", "no threshold is watched while a dump lasts"],
    ["a momentum at its threshold", "a delta-v on request", "no threshold is watched during a delta-v"],
    ["the end of a dump's torque", "pulses of a dump", "a spacecraft dumps by thrusters or by a torque"],
    // In commanded flight: the momentum of the panel alone is resolved to a share of itself, which rounding does not allow.
    [
        "a step of a panel",
        "a prediction",
        "a body at rest about the Sun whose panel follows it exhausts the work",
    ],
    ["a choice of the Sun's direction", "a prediction", "about the Sun a downlink lasts throughout"],
    ["pulses of a dump", "a pulse on request", "during a dump thrusters take no pulses from outside"],
];

/// Pairs that are not arranged in guided flight: the momentum in the body's axes comes to its threshold at another time.
const NOT_GUIDED: &[[&str; 2]] = &[
    ["the end of an attitude that was held", "a momentum at its threshold"],
    ["a momentum at its threshold", "a prediction"],
];

/// Communication points of one flight beside those of its inputs.
fn points_s(at_s: f64, apart_s: f64) -> [Vec<f64>; 5] {
    [
        vec![],
        vec![at_s],
        vec![at_s - apart_s],
        vec![at_s + apart_s],
        vec![at_s - apart_s, at_s, at_s + apart_s],
    ]
}

/// Flies a pair in each way; what does not agree or does not happen.
fn fly(pair: [&Kind; 2], source: f64, at_s: f64) {
    let mut it = Arrangement::new(source);
    pair.iter().for_each(|kind| (kind.arrange)(&mut it, at_s));
    it.put_unless_set("dump.threshold[2]", 1e9);
    // A panel that follows the Sun has a momentum of its own.
    it.put_unless_set("panel[1].control", 2.0);
    let is_ideal = IDEAL.contains(&source);
    if !is_ideal {
        it.put_unless_set("control.rate", NO_SAMPLES_HZ);
        it.put_unless_set("solver.dynamicsStep", 0.7);
    }
    let named = it.model();
    let (apart_s, ends_s) =
        if is_ideal { (0.5, [1.4 * at_s, 1.7 * at_s]) } else { (0.25, [2.0 * at_s, 2.0 * at_s + 3.0]) };
    let (mut shown, mut is_shown): (Option<Plant<'_>>, bool) = (None, false);
    let mut flown: Vec<Plant<'_>> = Vec::new();
    for (number, mut cuts_s) in points_s(at_s, apart_s).into_iter().enumerate() {
        cuts_s.extend(it.inputs.iter().map(|(at_s, ..)| *at_s).filter(|at_s| *at_s > 0.0));
        cuts_s.extend(it.point_s);
        cuts_s.push(ends_s[0]);
        if let Some([begin_s, end_s]) = it.pulse {
            cuts_s.retain(|cut_s| *cut_s <= begin_s || *cut_s >= end_s);
        }
        cuts_s.sort_by(f64::total_cmp);
        cuts_s.dedup();
        let mut flight = it.begin(&named);
        for cut_s in cuts_s {
            it.step(&mut flight, cut_s);
            if number == 4 {
                flight = flight.restored();
                if cut_s == at_s - apart_s {
                    shown = Some(flight.copied());
                }
                if !is_shown && cut_s >= at_s + apart_s {
                    is_shown = true;
                    for kind in pair {
                        assert!(
                            (kind.shows)(shown.as_ref().unwrap(), &flight, at_s),
                            "{} is not there",
                            kind.name
                        );
                    }
                }
            }
        }
        flown.push(flight);
    }
    assert!(is_shown);
    let (whole, cut) = flown.split_first_mut().unwrap();
    cut.iter().for_each(|flight| assert_same(whole, flight));
    it.step(whole, ends_s[1]);
    for flight in cut {
        it.step(flight, ends_s[1]);
        assert_same(whole, flight);
    }
}

fn all_pairs(source: f64, at_s: f64) {
    let kinds: Vec<&Kind> = KINDS.iter().filter(|kind| kind.sources.contains(&source)).collect();
    let mut failures = Vec::new();
    let mut count = 0;
    for (place, first) in kinds.iter().enumerate() {
        for second in &kinds[place + 1..] {
            let is_apart = |[a, b, _]: &&[&str; 3]| {
                [*a, *b] == [first.name, second.name] || [*b, *a] == [first.name, second.name]
            };
            let is_not_guided = source == GUIDED && NOT_GUIDED.contains(&[first.name, second.name]);
            if is_not_guided || APART.iter().any(|it| is_apart(&it)) {
                continue;
            }
            count += 1;
            let flown = std::panic::catch_unwind(|| fly([first, second], source, at_s));
            if let Err(panic) = flown {
                let text = panic.downcast_ref::<String>().cloned().unwrap_or_default();
                failures.push(format!("{} and {}: {text}", first.name, second.name));
            }
        }
    }
    assert!(failures.is_empty(), "{} of {count}\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn in_guided_flight() {
    all_pairs(GUIDED, 5000.0);
}

#[test]
fn in_commanded_flight() {
    all_pairs(COMMANDED, 5000.0);
}

#[test]
fn in_controlled_flight() {
    all_pairs(CONTROLLED, 10.0);
    if short_or_long(false, true) {
        all_pairs(CONTROLLED, 10.1);
    }
}

#[test]
fn in_free_flight() {
    all_pairs(FREE, 10.0);
    if short_or_long(false, true) {
        all_pairs(FREE, 10.1);
    }
}
