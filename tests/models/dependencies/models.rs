//! The models' states and the searches.

use client::short_or_long;
use fmi_export::Model;
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};

use super::super::named_model::Tables;
use super::super::spacecraft::{ALL, RADIATING};
use super::bench::Bench;
use super::draw::Draw::{Between, Flag, Rotation, Vector, Whole};
use super::draw::{DrawRule, Kept, draw, redraw};

/// Factor of the number of states in a long search.
const LONG: usize = 200;

/// Forces and torques are fitted so closely that nothing is left of what lies ahead.
const CLOSE: &[DrawRule] = &[
    ("solver.disturbanceStep", Between(5.0, 5.0), 1.0),
    ("solver.disturbanceTolerance", Between(1e-10, 1e-10), 1.0),
    ("solver.dynamicsStep", Between(1e-3, 1e-3), 1.0),
];

const PLANT: &[DrawRule] = &[
    ("guided.attitude", Rotation, 1.0),
    ("guided.align.target", Whole(1, 3), 1.0),
    ("guided.constrain.target", Whole(4, 7), 1.0),
    ("attitude.source", Whole(1, 4), 1.0),
    // The theory of the planets costs most.
    ("ephemeris.source", Whole(2, 3), 1.0),
    ("momentum.strategy", Whole(1, 2), 1.0),
    ("guided.downlinkEvery", Whole(1, 2), 1.0),
    ("guided.downlinkStart", Between(0.0, 4000.0), 1.0),
    ("guided.slewRate", Between(1e-3, 1e-3), 0.5),
    ("keepIn.elevation", Between(0.05, 1.5), 1.0),
    ("planetLight.nodes", Whole(3, 5), 1.0),
    ("shadowing.enabled", Flag(0.0), 0.5),
    ("sun.position", Vector(6e10, 6e10), 0.9),
    ("earth.position", Vector(1.5e11, 1.5e11), 1.0),
    ("orbit.position", Vector(3e6, 8e6), 0.9),
    ("orbit.velocity", Vector(2500.0, 2500.0), 0.95),
    ("orbit.trueAnomaly", Between(-3.0, 3.0), 1.0),
    ("command.q", Rotation, 0.85),
    ("command.error", Rotation, 0.7),
    ("command.rate", Vector(1e-3, 1e-3), 0.7),
    ("start.q", Rotation, 0.7),
    ("start.rate", Vector(1e-3, 1e-2), 0.8),
    ("start.momentum", Vector(0.01, 6.0), 0.5),
    ("torque.applied", Vector(1e-5, 1e-5), 0.5),
    ("force.applied", Vector(1e-5, 1e-5), 0.5),
    ("dump.target", Vector(0.0, 1.0), 1.0),
    ("dump.threshold[*]", Between(1.6, 4.0), 1.0),
    ("dump.request", Flag(0.2), 1.0),
    ("maneuver.request", Flag(0.2), 0.5),
    ("maneuver.deltaV", Vector(1.0, 10.0), 1.0),
    ("panel[*].angle", Between(-3.0, 3.0), 1.0),
    ("panel[*].control", Whole(1, 5), 0.7),
    ("panel[*].sunOffsetCommand", Between(-1.2, 1.2), 1.0),
    ("wheel[*].torqueCommand", Between(-0.1, 0.1), 1.0),
    ("wheel[*].startMomentum", Between(-0.5, 0.5), 0.7),
    ("wheel[*].failed", Flag(0.1), 1.0),
    ("wheel[*].locked", Flag(0.0), 1.0),
    ("thruster[*].onTime", Between(0.1, 0.5), 0.2),
    ("thrust.command", Flag(0.5), 1.0),
    ("thrust.stop", Between(10.0, 1e4), 0.8),
    ("starTracker.noise", Vector(1e-5, 1e-4), 0.5),
    ("starTracker.failed", Flag(0.3), 1.0),
    ("gyro.noise", Between(1e-6, 1e-4), 0.5),
    ("gyro.bias", Vector(1e-5, 1e-3), 0.5),
    ("gyro.failed", Flag(0.3), 1.0),
    ("sunSensor[*].failed", Flag(0.2), 1.0),
    ("control.rate", Between(10.0, 50.0), 0.3),
];
const PLANT_KEPT: Kept = &["orbit.center"];

const DISTURBANCE: &[DrawRule] = &[
    ("sun.positionBody", Vector(5.8e10, 5.8e10), 0.95),
    ("planet.positionBody", Vector(2.5e6, 7e6), 1.0),
    ("planet.pole", Vector(1.0, 1.0), 1.0),
    ("spacecraft.centerOfMass", Vector(0.1, 0.3), 1.0),
    ("planetLight.belts", Whole(8, 8), 1.0),
    ("planetLight.nodes", Whole(3, 6), 1.0),
    ("panel[*].angle", Between(-3.0, 3.0), 1.0),
];

const SPIN: &[DrawRule] = &[
    ("start.q", Rotation, 1.0),
    ("start.nutation", Between(0.0, 0.05), 0.5),
    ("burn.count", Whole(2, 12), 1.0),
    ("burn.thruster", Whole(1, 10), 1.0),
    ("burn.angle", Between(0.01, 0.01), 0.5),
    ("burn.pulseWidth", Between(0.16, 0.4), 1.0),
    ("burn.start", Between(0.0, 60.0), 1.0),
    ("pulse.resolution", Between(0.032, 0.032), 0.5),
    ("thruster[*].onDelay", Between(0.1, 0.1), 0.5),
    ("thruster[*].onTime", Between(0.2, 0.2), 0.3),
    ("thruster[*].fire", Flag(0.2), 1.0),
    ("thruster[*].riseTime", Between(0.02, 0.05), 0.3),
    ("productsOfInertia", Vector(1.0, 8.0), 0.5),
    ("sun.direction", Vector(1.0, 1.0), 1.0),
    ("earth.direction", Vector(2.0, 2.0), 1.0),
    ("star.direction", Vector(1.0, 1.0), 1.0),
    ("burn.targetDirection", Vector(1.0, 1.0), 1.0),
    ("spin.initialRate", Between(0.4, 0.7), 1.0),
    ("torque.applied", Vector(1e-3, 1e-2), 0.5),
    ("limit.sunAngle", Between(0.2, 2.5), 1.0),
    ("limit.earthAngle", Between(0.2, 2.5), 1.0),
    ("limit.spinRate", Between(0.5, 0.6), 1.0),
];

const GUIDANCE: &[DrawRule] = &[
    ("guided.attitude", Rotation, 1.0),
    ("guided.align.target", Whole(1, 3), 1.0),
    ("guided.constrain.target", Whole(4, 7), 1.0),
    ("ephemeris.source", Whole(2, 3), 1.0),
    ("momentum.strategy", Whole(1, 2), 1.0),
    ("guided.downlinkEvery", Whole(1, 2), 1.0),
    ("mode.request", Whole(0, 0), 0.6),
    ("estimate.valid", Flag(0.9), 1.0),
    ("monitor.enabled", Flag(0.3), 1.0),
    ("position", Vector(3e6, 8e6), 0.95),
    ("velocity", Vector(2500.0, 2500.0), 0.95),
    ("sun.position", Vector(6e10, 6e10), 0.95),
    ("sun.velocity", Vector(4e4, 4e4), 0.9),
    ("sun.sensed", Vector(1.0, 1.0), 1.0),
    ("earth.position", Vector(1.5e11, 1.5e11), 1.0),
    ("earth.velocity", Vector(3e4, 3e4), 0.9),
    ("estimate.q", Rotation, 1.0),
    ("start.q", Rotation, 0.7),
    ("boresight.vector", Vector(1.0, 1.0), 0.9),
    ("boresight.azimuth", Between(-3.0, 3.0), 0.5),
    ("boresight.elevation", Between(-1.0, 1.0), 0.5),
    ("boresight.angle", Between(-0.8, 0.8), 0.5),
    ("aimpoint.vector", Vector(1.0, 1.0), 0.9),
    ("aimpoint.position", Vector(1e7, 1e11), 0.9),
    ("aimpoint.latitude", Between(-1.0, 1.0), 0.5),
    ("aimpoint.longitude", Between(-3.0, 3.0), 0.5),
    ("secondAimpoint.vector", Vector(1.0, 1.0), 0.9),
    ("secondAimpoint.position", Vector(1e7, 1e11), 0.9),
    ("bodyRoll.vector", Vector(1.0, 1.0), 0.9),
    ("externalRoll.vector", Vector(1.0, 1.0), 0.9),
    ("limb.height", Between(0.0, 1e5), 0.5),
    ("limb.heightRate", Between(0.0, 1e3), 0.5),
    ("scan.rate", Vector(1e-3, 1e-2), 0.7),
    ("scan.speed", Vector(100.0, 1000.0), 0.5),
    ("scan.duration", Vector(10.0, 30.0), 0.7),
    ("scan.segments[*]", Whole(1, 3), 0.7),
    ("momentum.body", Vector(0.0, 6.0), 0.7),
    ("accelerometer.deltaV", Vector(0.0, 0.1), 0.7),
    ("burn.deltaV", Vector(1.0, 10.0), 0.7),
];

/// A search: drawn states, each looked at where it begins and after a while.
struct Search<M: Model> {
    bench: Bench<M>,
    kept: Kept,
    rows: &'static [DrawRule],
    /// Longest time to the communication point, in s.
    longest_s: f64,
    prepare: fn(&Bench<M>, &mut Tables),
}

impl<M: Model> Search<M> {
    fn new(text: &str, rows: &'static [DrawRule]) -> Self {
        Self { bench: Bench::new(text, 11), kept: &[], rows, longest_s: 30.0, prepare: |_, _| {} }
    }

    fn report_missing(mut self, states: usize) {
        let mut drawn = 0;
        while self.bench.looks[1] < states {
            drawn += 1;
            assert!(
                drawn < 20 * (states + 1),
                "only {:?} of {drawn} states can be simulated",
                self.bench.looks
            );
            self.look(drawn);
        }
        let [in_steps, at_start] = self.bench.seen();
        println!(
            "{:?} states of {drawn}; seen in steps {in_steps}, at the start {at_start}",
            self.bench.looks
        );
        assert!(in_steps > 0 && at_start > 0);
        let undeclared = self.bench.undeclared();
        assert!(undeclared.is_empty(), "{undeclared}");
    }

    fn look(&mut self, drawn: usize) -> Option<()> {
        let mut values = draw(&mut self.bench, self.kept, self.rows);
        (self.prepare)(&self.bench, &mut values);
        let bench = &mut self.bench;
        let start_s = f64::from(u8::from(drawn % 2 == 1)) * bench.random.between(0.0, 9.0);
        bench.look_at_start(&values, start_s)?;
        let mut random = bench.random.clone();
        redraw(bench, &mut random, CLOSE, &mut values);
        let mut flight = bench.initialize(&values, start_s)?;
        // Often to where samples are due.
        let length_s = match drawn % 3 {
            0 => random.between(0.1, self.longest_s),
            1 => 3.0 - start_s.fract(),
            _ => random.between(0.1, 1.0),
        };
        bench.step(&mut flight, length_s)?;
        // Inputs as they may be after a while.
        if drawn.is_multiple_of(4) {
            let inputs: Vec<usize> =
                (0..bench.variables.len()).filter(|at| bench.variables[*at].input).collect();
            let mut other = values.clone();
            redraw(bench, &mut random, self.rows, &mut other);
            for at in inputs {
                let value = bench.read(&other, at);
                bench.write(&mut flight.values, at, value);
            }
        }
        bench.random = random;
        bench.look_at_step(&flight)
    }
}

/// Downlinks of a strategy end before the next begins; no rotor out of balance, which makes for short segments. Flight between
/// planets has planets, and none in the centre that it is on its way to; a Sun line has a Sun at the start, and another centre.
fn prepare_plant(bench: &Bench<MomentumPlant>, values: &mut Tables) {
    bench.put(values, "guided.downlinkEnd", 12_000.0);
    let at = |name: &str| bench.variables.iter().position(|it| it.name == name).unwrap();
    let [dynamics, encounter, center] = ["orbit.dynamics", "encounter.body", "orbit.center"].map(at);
    if bench.read(values, dynamics) == 3.0 {
        bench.put(values, "ephemeris.source", 1.0);
        if bench.read(values, at("ephemeris.source")) != 1.0 {
            bench.write(values, dynamics, 2.0);
        }
        if bench.read(values, encounter) == bench.read(values, center) {
            bench.write(values, encounter, 0.0);
        }
    }
    if bench.read(values, center) == 2.0 || bench.read(values, at("ephemeris.source")) == 3.0 {
        bench.put(values, "orbit.frame", 3.0);
    }
    if !bench.variables.iter().any(|it| it.name == "wheel[3].capacity") {
        let at = bench.variables.iter().position(|it| it.name == "attitude.source").unwrap();
        if bench.read(values, at) == 3.0 {
            bench.write(values, at, 4.0);
        }
    }
}

fn plant(text: &str) -> Search<MomentumPlant> {
    let search = Search::new(text, PLANT);
    Search { kept: PLANT_KEPT, prepare: prepare_plant, ..search }
}

const FULL: &str = include_str!("../../../fmu-src/resources/messenger-full.toml");
/// Flight by torque after commands, as in the shipped system but for the theory of the planets, which costs most.
fn controlled() -> String {
    let fixed = [
        ("attitude.source", "controlled"),
        ("command.source", "inputs"),
        ("orbit.source", "elements"),
        ("ephemeris.source", "kepler"),
    ];
    let entries = fixed.map(|(name, item)| format!("\"{name}\" = \"{item}\"\n")).concat();
    format!("{FULL}\n[fixed]\n{entries}")
}

const ONBOARD: &str = include_str!("still_ephemeris.toml");

fn guidance() -> Search<Guidance> {
    let mut search = Search::new(Guidance::DEFAULT_SETUP, GUIDANCE);
    search.bench = search.bench.with_schedule("ephemeris.toml", ONBOARD);
    search
}

/// One test a search; `cargo xtask test --long` searches many times as many states.
macro_rules! searches {
    ($($name:ident, $states:literal: $search:expr;)*) => { $(
        #[test]
        fn $name() {
            $search.report_missing($states * short_or_long(1, LONG));
        }
    )* };
}

searches! {
    momentum_plant, 3: plant(MomentumPlant::DEFAULT_SETUP);
    momentum_plant_per_plate, 2: plant(RADIATING);
    momentum_plant_with_everything, 3: plant(ALL);
    momentum_plant_with_thrusters, 1: plant(FULL);
    momentum_plant_controlled, 1: plant(&controlled());
    disturbance_torque, 4:
        Search::<DisturbanceTorque>::new(DisturbanceTorque::DEFAULT_SETUP, DISTURBANCE);
    disturbance_torque_per_plate, 4:
        Search::<DisturbanceTorque>::new(RADIATING, DISTURBANCE);
    disturbance_torque_with_everything, 4:
        Search::<DisturbanceTorque>::new(ALL, DISTURBANCE);
    spin_plant, 10: Search::<SpinPlant>::new(SpinPlant::DEFAULT_SETUP, SPIN);
    guidance_shipped, 10: guidance();
}
