//! SpinPlant through FMI's functions does what its physics does, on any grid, and refuses what cannot be flown.

use std::collections::HashMap;
use std::time::Instant;

use fmi_export::abi::{InProcess, Message, StatePointer};
use fmi_export::{Entry, Library, Model, Status};
use model_description::{Causality, Description, VariableKind, validate};
use models::SpinPlant;
use physics::spin::burn::BurnRequest;
use physics::spin::forecast::Timing;
use physics::spin::geometry::{L1Flight, L1Phases};
use physics::spin::plant::{Commands, Directions, MassSource, Plant, Sampling, Start};
use physics::spin::spinner;
use physics::spin::train::Shape;

static LIBRARY: Library = Library { entries: &[Entry::of::<SpinPlant>()] };

const PERIOD_S: f64 = 12.0;

fn description() -> Description {
    LIBRARY.find("SpinPlant").unwrap().describe(None, None).unwrap()
}

struct Spinner {
    fmu: InProcess,
    names: HashMap<String, u32>,
    real_outputs: Vec<u32>,
    time_s: f64,
}

impl Spinner {
    fn new() -> Self {
        let variables = description().variables;
        let real_outputs = variables
            .iter()
            .filter(|v| v.causality == Causality::Output && matches!(v.kind, VariableKind::Real { .. }))
            .map(|v| v.value_reference)
            .collect();
        let names = variables.into_iter().map(|v| (v.name, v.value_reference)).collect();
        Self { fmu: InProcess::of(&LIBRARY, "SpinPlant").unwrap(), names, real_outputs, time_s: 0.0 }
    }

    fn at(&self, name: &str) -> u32 {
        *self.names.get(name).unwrap_or_else(|| panic!("no variable {name}"))
    }

    fn set(mut self, name: &str, value: f64) -> Self {
        self.put(name, value);
        self
    }

    fn put(&mut self, name: &str, value: f64) {
        let at = self.at(name);
        assert_eq!(self.fmu.set_real(&[at], &[value]), Status::Ok, "{name} = {value}");
    }

    fn set_integer(mut self, name: &str, value: i32) -> Self {
        let at = self.at(name);
        assert_eq!(self.fmu.set_integer(&[at], &[value]), Status::Ok, "{name} = {value}");
        self
    }

    fn set_text(mut self, name: &str, value: &str) -> Self {
        let at = self.at(name);
        assert_eq!(self.fmu.set_string(&[at], &[value.as_bytes()]), Status::Ok);
        self
    }

    fn fire(&mut self, thruster: u32, on: bool) {
        let at = self.at(&format!("thruster[{thruster}].fire"));
        assert_eq!(self.fmu.set_boolean(&[at], &[i32::from(on)]), Status::Ok);
    }

    fn start(mut self) -> Self {
        assert_eq!(self.fmu.start(0.0, None), Status::Ok, "{:?}", self.fmu.take_messages());
        self
    }

    fn refusal(mut self) -> String {
        assert_ne!(self.fmu.start(0.0, None), Status::Ok);
        self.fmu.take_messages().into_iter().map(|Message { text, .. }| text).collect()
    }

    fn to(&mut self, end_s: f64) {
        let length_s = end_s - self.time_s;
        assert_eq!(self.fmu.do_step(self.time_s, length_s), Status::Ok, "{:?}", self.fmu.take_messages());
        self.time_s = end_s;
    }

    fn real(&mut self, name: &str) -> f64 {
        let (at, mut value) = (self.at(name), [0.0]);
        assert_eq!(self.fmu.get_real(&[at], &mut value), Status::Ok);
        value[0]
    }

    fn integer(&mut self, name: &str) -> i32 {
        let (at, mut value) = (self.at(name), [0]);
        assert_eq!(self.fmu.get_integer(&[at], &mut value), Status::Ok);
        value[0]
    }

    fn boolean(&mut self, name: &str) -> bool {
        let (at, mut value) = (self.at(name), [0]);
        assert_eq!(self.fmu.get_boolean(&[at], &mut value), Status::Ok);
        value[0] != 0
    }

    /// Every Real output.
    fn outputs(&mut self) -> Vec<f64> {
        let mut values = vec![0.0; self.real_outputs.len()];
        assert_eq!(self.fmu.get_real(&self.real_outputs, &mut values), Status::Ok);
        values
    }
}

fn assert_names(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing from: {text}");
    }
}

#[test]
fn the_description_is_valid_and_names_the_contract() {
    let description = description();
    assert_eq!(validate(&description), vec![]);
    let names: Vec<&str> = description.variables.iter().map(|v| v.name.as_str()).collect();
    for name in [
        "inertia[3]",
        "spin.initialRate",
        "initial.q[4]",
        "initial.nutation",
        "initial.nutationPhase",
        "burn.start",
        "burn.thruster",
        "burn.oppositeThruster",
        "burn.pulseWidth",
        "burn.turnsPerPulse",
        "burn.count",
        "burn.targetDirection[3]",
        "burn.timing",
        "burn.plan",
        "damper.timeConstant",
        "thruster[10].onDelay",
        "thruster[10].onTime",
        "thruster[10].fire",
        "torque.external[3]",
        "sun.direction[3]",
        "earth.direction[3]",
        "star.direction[3]",
        "attitude.q[4]",
        "attitude.rate[3]",
        "nutation.angle",
        "nutation.predicted",
        "spin.rate",
        "spin.period",
        "spin.periodVariation",
        "momentum.inertial[3]",
        "spinAxis.inertial[3]",
        "spinAxis.displacement",
        "sun.angle",
        "earth.angle",
        "burn.pulsesFired",
        "burn.active",
        "inertia.ratio",
        "propellant.used",
        "force.thruster[3]",
        "deltaV[3]",
        "starTracker.declination",
    ] {
        assert!(names.contains(&name), "{name}");
    }
}

#[test]
fn the_default_flight_is_the_papers_manoeuvre() {
    let mut spinner = Spinner::new().start();
    let mut most: f64 = 0.0;
    for i in 1..=140 {
        spinner.to(10.0 * f64::from(i));
        most = most.max(spinner.real("nutation.angle"));
    }
    assert_eq!(spinner.integer("burn.pulsesFired"), 114);
    assert!(spinner.boolean("burn.done") && !spinner.boolean("burn.active"));
    assert!((spinner.real("momentum.displacement").to_degrees() - 2.0).abs() < 0.02);
    let envelope = spinner.real("nutation.envelope");
    assert!(most < envelope && most > 0.9 * envelope, "{most} {envelope}");
    assert!((spinner.real("nutation.predicted") / spinner.real("nutation.angle") - 1.0).abs() < 0.1);
    assert!((spinner.real("thruster[8].arm") - 0.40).abs() < 1e-12);
}

#[test]
fn any_communication_grid_gives_the_same_bits() {
    let whole = {
        let mut spinner = Spinner::new().start();
        spinner.to(1400.0);
        spinner.outputs()
    };
    for step_s in [0.032, 0.7, 12.0, 280.0] {
        let mut spinner = Spinner::new().start();
        let steps = (1400.0_f64 / step_s).round() as u32;
        for i in 1..steps {
            spinner.to(f64::from(i) * step_s);
        }
        spinner.to(1400.0);
        assert_eq!(spinner.outputs(), whole, "{step_s}");
    }
    // 1 ms over part of the flight.
    let mut spinner = Spinner::new().start();
    for i in 1..=60_000 {
        spinner.to(f64::from(i) * 0.001);
    }
    spinner.to(1400.0);
    assert_eq!(spinner.outputs(), whole);
}

#[test]
fn a_state_saved_in_the_middle_of_a_pulse_continues_to_the_bit() {
    let configured = || {
        Spinner::new()
            .set("burn.pulseWidth", 1.0)
            .set("inertia[1]", 230.0)
            .set_integer("burn.count", 20)
            .set_integer("burn.timing", 3)
    };
    let mut spinner = configured().start();
    let edge_s = spinner.real("burn.nextEdge");
    spinner.to(edge_s + 2.0 * PERIOD_S + 0.4);
    assert!(spinner.boolean("burn.active") && spinner.boolean("thruster[8].active"));
    let (status, bytes) = spinner.fmu.state_bytes();
    assert_eq!(status, Status::Ok);
    let mut state = StatePointer::null();
    assert_eq!(spinner.fmu.get_state(&mut state), Status::Ok);
    let saved_s = spinner.time_s;
    let fly_on = |spinner: &mut Spinner| {
        (1..=50)
            .map(|i| {
                spinner.to(saved_s + 3.7 * f64::from(i));
                spinner.outputs()
            })
            .collect::<Vec<_>>()
    };
    let expected = fly_on(&mut spinner);
    assert_eq!(spinner.fmu.set_state(&state), Status::Ok);
    spinner.time_s = saved_s;
    assert_eq!(fly_on(&mut spinner), expected);
    // And in another instance.
    let mut other = configured().start();
    let (status, state) = other.fmu.deserialize(&bytes);
    assert_eq!(status, Status::Ok);
    assert_eq!(other.fmu.set_state(&state), Status::Ok);
    other.time_s = saved_s;
    assert_eq!(fly_on(&mut other), expected);
}

#[test]
fn held_thrusters_and_pulses_within_steps_have_the_same_edges() {
    let fly = |drive: &dyn Fn(&mut Spinner)| {
        let mut spinner = Spinner::new().set_integer("burn.plan", 4).start();
        drive(&mut spinner);
        spinner.to(40.0);
        [
            "momentum.inertial[1]",
            "momentum.inertial[2]",
            "nutation.angle",
            "propellant.used",
            "deltaV[1]",
            "deltaV[2]",
        ]
        .map(|name| spinner.real(name))
    };
    let held = fly(&|spinner| {
        spinner.to(9.6);
        spinner.fire(8, true);
        for i in 1..=10 {
            spinner.to(9.6 + 0.32 * f64::from(i) / 10.0);
        }
        spinner.fire(8, false);
    });
    // 9.59 and 0.33 s are rounded to 32 ms: 300 and 10 of them.
    let pulsed = fly(&|spinner| {
        spinner.put("thruster[8].onDelay", 9.59);
        spinner.put("thruster[8].onTime", 0.33);
        spinner.to(12.0);
        spinner.put("thruster[8].onTime", 0.0);
    });
    for (a, b) in held.iter().zip(pulsed) {
        assert!((a - b).abs() < 1e-12 * a.abs().max(1.0), "{held:?} {pulsed:?}");
    }
    assert!(held[2] > 1e-4);
}

#[test]
fn a_pulse_beyond_its_step_is_cut_with_a_warning() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).start();
    spinner.put("thruster[1].onTime", 3.2);
    spinner.fmu.take_messages();
    spinner.to(1.0);
    let messages = spinner.fmu.take_messages();
    assert!(messages.iter().any(|m| m.text.contains("IA") && m.text.contains("cut")), "{messages:?}");
    spinner.put("thruster[1].onTime", 0.0);
    spinner.to(2.0);
    let used = spinner.real("propellant.used");
    assert!((used - 4.448 / (220.0 * 9.80665)).abs() < 1e-12);
}

#[test]
fn an_outside_torque_with_a_slope_is_integrated() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).set("damper.timeConstant", 0.0).start();
    let before = spinner.real("spin.rate");
    spinner.put("torque.external[3]", 0.5);
    let reference = spinner.at("torque.external[3]");
    assert_eq!(spinner.fmu.set_input_derivatives(&[reference], &[1], &[0.2]), Status::Ok);
    spinner.to(10.0);
    let after = spinner.real("spin.rate");
    assert!((after - before - (5.0 + 10.0) / 353.82).abs() < 1e-12);
}

#[test]
fn output_derivatives_are_the_slopes_of_the_outputs() {
    let mut spinner = Spinner::new()
        .set_integer("burn.plan", 4)
        .set("initial.nutation", 0.05)
        .set("inertia[1]", 225.0)
        .set("damper.timeConstant", 300.0)
        .start();
    spinner.fire(2, true);
    spinner.put("torque.external[1]", 0.3);
    spinner.to(7.0);
    let mut state = StatePointer::null();
    assert_eq!(spinner.fmu.get_state(&mut state), Status::Ok);
    let names = [
        "attitude.q[1]",
        "attitude.q[4]",
        "attitude.rate[1]",
        "attitude.rate[3]",
        "momentum.inertial[2]",
        "momentum.body[1]",
        "momentum.displacement",
        "spinAxis.inertial[1]",
        "spinAxis.displacement",
        "spin.rate",
        "nutation.angle",
        "nutation.phase",
        "sun.angle",
        "earth.angle",
        "starTracker.declinationTrue",
        "deltaV[2]",
        "energy",
        "propellant.used",
        "propellant.left",
        "mass",
    ];
    let references: Vec<u32> = names.iter().map(|name| spinner.at(name)).collect();
    let mut slopes = vec![0.0; names.len()];
    let orders = vec![1; names.len()];
    assert_eq!(spinner.fmu.get_output_derivatives(&references, &orders, &mut slopes), Status::Ok);
    let mut sample = |time_s: f64| {
        assert_eq!(spinner.fmu.set_state(&state), Status::Ok);
        spinner.time_s = 7.0;
        spinner.to(time_s);
        names.map(|name| spinner.real(name))
    };
    let h = 0.01;
    let [y1, y2, y3, y4] = [1.0, 2.0, 3.0, 4.0].map(|k| sample(7.0 + k * h));
    assert_eq!(spinner.fmu.set_state(&state), Status::Ok);
    let y0 = names.map(|name| spinner.real(name));
    for (i, name) in names.iter().enumerate() {
        // One-sided differences of the fourth order.
        let slope = (-25.0 * y0[i] + 48.0 * y1[i] - 36.0 * y2[i] + 16.0 * y3[i] - 3.0 * y4[i]) / (12.0 * h);
        assert!((slope - slopes[i]).abs() < 2e-7 * slope.abs().max(1.0), "{name}: {} {slope}", slopes[i]);
    }
}

#[test]
fn on_the_l1_orbit_the_earth_leaves_the_antenna_by_the_lines_rate() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).set_integer("geometry.source", 2);
    for axis in 1..=3 {
        spinner.put(&format!("geometry.amplitude[{axis}]"), 0.0);
    }
    // The spin axis on the Sun at longitude 0 from the Earth: along -X.
    for (i, q) in [0.0, -0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt()].into_iter().enumerate() {
        spinner.put(&format!("initial.q[{}]", i + 1), q);
    }
    let mut spinner = spinner.start();
    assert!(spinner.real("sun.angle") < 1e-7 && spinner.real("earth.angle") < 1e-7);
    spinner.to(3.0 * 86_400.0);
    assert!((spinner.real("earth.angle").to_degrees() - 3.0 * 0.9829).abs() < 1e-6);
    assert!(!spinner.boolean("limit.earthAngleViolated"));
    spinner.to(4.0 * 86_400.0);
    assert!(spinner.boolean("limit.earthAngleViolated") && spinner.boolean("limit.anyViolated"));
}

#[test]
fn what_cannot_be_flown_is_refused_by_name() {
    assert_names(
        &Spinner::new().set_integer("burn.thruster", 11).refusal(),
        &["burn.thruster", "11", "1 to 10"],
    );
    assert_names(
        &Spinner::new().set("burn.pulseWidth", 6.1).refusal(),
        &["burn.pulseWidth", "6.1", "half a turn"],
    );
    assert_names(&Spinner::new().set("inertia[1]", -1.0).refusal(), &["inertia[1]", "-1", "positive"]);
    assert_names(&Spinner::new().set("inertia[3]", 700.0).refusal(), &["inertia[3]", "triangle"]);
    assert_names(
        &Spinner::new().set("burn.turnsPerPulse", 0.5).set_integer("burn.oppositeThruster", 0).refusal(),
        &["0.5 turns", "opposite"],
    );
    assert_names(
        &Spinner::new().set("burn.angle", 0.0349).set("burn.maxDuration", 600.0).refusal(),
        &["does not fit its limits", "duration", "burn.maxDuration"],
    );
    assert_names(
        &Spinner::new().set("burn.angle", 0.0349).set("burn.maxNutation", 1e-5).refusal(),
        &["does not fit its limits", "nutation", "burn.maxNutation"],
    );
    assert_names(
        &Spinner::new().set_text("burn.group", "rocket").refusal(),
        &["burn.group", "rocket", "spin up"],
    );
    // A negative width and a NaN are refused where they are set, and the instance lives.
    let mut spinner = Spinner::new();
    let at = spinner.at("burn.pulseWidth");
    assert_eq!(spinner.fmu.set_real(&[at], &[-0.5]), Status::Discard);
    assert_eq!(spinner.fmu.set_real(&[at], &[f64::NAN]), Status::Discard);
    spinner.start().to(1.0);
}

#[test]
fn states_torn_at_random_are_refused_or_flown_on_without_panic_or_hang() {
    let spinner = SpinPlant::parse_setup("default", SpinPlant::DEFAULT_SETUP).unwrap();
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize
    };
    let began = Instant::now();
    let (mut refused, mut flown) = (0, 0);
    for (triaxial, at_s) in [(false, 50.0), (true, 50.0), (true, 10.22)] {
        let start = flight(&spinner, triaxial);
        let (commands, directions) = (Commands::none(), directions());
        let mut plant = Plant::start(&spinner, &start, directions, commands, 0.0).unwrap();
        plant.advance(&spinner, at_s).unwrap();
        let bytes = postcard::to_allocvec(&plant).unwrap();
        for _ in 0..1500 {
            let mut torn = bytes.clone();
            for _ in 0..1 + random() % 3 {
                let at = random() % torn.len();
                torn[at] = random() as u8;
            }
            let Ok(mut other) = postcard::from_bytes::<Plant>(&torn) else { continue };
            if SpinPlant::check_state(&spinner, &other).is_err() {
                refused += 1;
                continue;
            }
            flown += 1;
            let now_s = other.time_s();
            let _ = other.advance(&spinner, now_s + 30.0);
            let _ = (other.outputs(&spinner), other.rates(&spinner), other.predictions());
        }
    }
    assert!(refused > 50 && flown > 500, "{refused} {flown}");
    assert!(began.elapsed().as_secs() < 60);
}

fn directions() -> Directions {
    Directions {
        sun_inertial: nalgebra::Vector3::new(0.6, 0.0, 0.8),
        earth_inertial: -nalgebra::Vector3::z(),
        star_inertial: nalgebra::Vector3::x(),
    }
}

fn flight(spinner: &spinner::Spinner, triaxial: bool) -> Start {
    Start {
        inertia_kg_m2: [if triaxial { 230.0 } else { 238.58 }, 238.58, 353.82],
        mass_source: MassSource::Fixed,
        propellant_kg: 97.5,
        spin_rate_rad_s: std::f64::consts::PI / 6.0,
        attitude: [0.0, 0.0, 0.0, 1.0],
        nutation_rad: 1e-3,
        nutation_phase_rad: 0.0,
        damper_time_constant_s: 34_200.0,
        burn: Some(BurnRequest {
            shape: Shape::Uniform,
            timing: Timing::TruePhase,
            start_s: 0.0,
            thruster: 8,
            opposite_thruster: 10,
            group: String::new(),
            pulse_width_s: 2.0,
            turns_per_pulse: 1.0,
            count: 10,
            angle_rad: 0.0,
            resolution_s: 0.032,
            target_inertial: nalgebra::Vector3::x(),
            spin_rate_error: 0.0,
            ratio_uncertainty: 0.0,
            max_nutation_rad: 0.0,
            max_duration_s: 0.0,
        }),
        l1: triaxial.then(|| L1Flight { orbit: spinner.l1_orbit, phases: L1Phases::default() }),
        sampling: Sampling::Clock,
        nominal_rate_rad_s: std::f64::consts::PI / 6.0,
        seed: 3,
    }
}
