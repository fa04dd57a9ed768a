//! Guidance: every scenario, option, scan, mode and constraint drawn at random, and geometry that leaves something open.

use fmi_export::Model;
use models::Guidance;
use nalgebra::Vector3;

use super::super::named_model::Tables;
use super::bench::{Bench, Simulation};
use super::random::RandomNumbers;

type Guide = Bench<Guidance>;

/// Options drawn at random, with their items in this version.
const OPTIONS: &[(&str, i32, i32)] = &[
    ("boresight.option", 0, 4),
    ("aimpoint.body", 0, 7),
    ("secondAimpoint.body", 0, 7),
    ("bodyRoll.option", 0, 2),
    ("externalRoll.option", 0, 5),
    ("limb.reference", 0, 2),
    ("scan.reference", 0, 2),
    ("scan.segments[1]", 0, 2),
    ("scan.segments[2]", 0, 2),
    ("scan.segments[3]", 0, 2),
    ("scan.reverse[1]", 0, 1),
    ("scan.reverse[2]", 0, 1),
    ("scan.reverse[3]", 0, 1),
    ("subsolar.method", 1, 2),
    ("keepIn.method", 1, 2),
    ("guided.scienceRule", 1, 3),
    ("guided.downlinkEvery", 0, 2),
    ("boresight.instrument", 0, 3),
];

/// Flags change at limits, which few states are near; through what a known reaches them.
const CARRIERS: &[(&str, &str)] = &[
    ("constraint.", "command.q"),
    ("constraint.clamped", "mdis.angle"),
    ("target.reachable", "command.q"),
    ("geometry.degenerate", "command.q"),
    ("sun.", "command.q"),
    ("mdis.inRange", "mdis.angle"),
    ("antenna.", "command.q"),
    ("antenna.select", "antenna.azimuth"),
    ("link.available", "command.q"),
    ("link.available", "antenna.azimuth"),
    // The monitor judges by the Sun and the hot pole's region.
    ("mode.active", "earth.sunSeparation"),
    ("mode.active", "constraint.hotPole"),
    // A burn begins where the thrust is on its aim, and ends by what was measured.
    ("thrust.", "command.q"),
    ("burn.timedOut", "thrust.request"),
    ("momentum.targetClamped", "sun.azimuth"),
    ("momentum.targetClamped", "sun.elevation"),
    ("dump.request", "dump.target[1]"),
    // Every output that is judged with an attitude depends on the mode and on whether there is one.
    ("", "mode.active"),
    ("", "command.kind"),
    ("", "earth.sunSeparation"),
    ("", "constraint.hotPole"),
];

/// Ephemerides of a Sun and an Earth that stand still.
const FLOWN: &str = include_str!("still_ephemeris.toml");

/// More than is needed until everything was seen.
const ROUNDS: usize = 1_500;

/// What a drawing is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Subject {
    /// A scenario by its item.
    Scenario(i32),
    /// An aimpoint by its item, without constraints.
    Aimpoint(i32),
    /// A camera at a second aimpoint.
    SecondAimpoint(i32),
    /// A scan by its item.
    Scan(i32),
    /// Modes and sensors.
    Modes,
    /// The monitor, which trips at once.
    Monitor,
    /// Flown ephemerides, judged by the Sun sensors at once.
    Ephemeris,
    /// The four vectors by their options, without constraints.
    Generic,
    /// A direction that is missing, by what it is.
    Lost(i32),
    /// Science and downlink, near their windows.
    OrbitPhase,
    /// The hot pole: low above the subsolar point.
    HotPole,
    /// An antenna at an Earth that is near the Sun or at the planet's limb.
    Link,
    /// A burn, waiting or under way.
    Burn,
    /// A downlink that begins with momentum: of the scenario, or of the orbit phase.
    Momentum,
    /// The same with science after it within reach of a forecast.
    Predictive,
}

impl Subject {
    /// Whether it is a downlink that begins with momentum.
    fn is_momentum(self) -> bool {
        matches!(self, Self::Momentum | Self::Predictive)
    }
}

fn subjects() -> Vec<Subject> {
    let scenarios = (0..=8).map(Subject::Scenario);
    let aims = (1..=15).flat_map(|item| [Subject::Aimpoint(item), Subject::SecondAimpoint(item)]);
    let scans = (1..=5).map(Subject::Scan);
    let others = [
        Subject::Modes,
        Subject::Ephemeris,
        Subject::OrbitPhase,
        Subject::HotPole,
        Subject::Monitor,
        Subject::Link,
        Subject::Burn,
        Subject::Momentum,
        Subject::Predictive,
        Subject::Momentum,
        Subject::Predictive,
        Subject::Generic,
        Subject::Monitor,
        Subject::Generic,
        Subject::OrbitPhase,
        Subject::Scan(5),
    ];
    let lost = (0..8).map(Subject::Lost);
    scenarios.chain(aims).chain(scans).chain(others).chain(others).chain(lost).collect()
}

fn unit_quaternion(random: &mut RandomNumbers) -> [f64; 4] {
    let q = [0; 4].map(|_| random.between(-0.6, 0.6));
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / norm)
}

fn draw(bench: &Guide, random: &mut RandomNumbers, subject: Subject) -> Tables {
    let mut values = bench.defaults();
    for (name, low, high) in OPTIONS {
        let item = random.whole(*low, *high);
        // Item 5 of bodies is kept.
        bench.put(&mut values, name, if name.ends_with("body") && item == 5.0 { 6.0 } else { item });
    }
    let item = |bench: &Guide, values: &mut Tables, name: &str, item: i32| {
        bench.put(values, name, f64::from(item));
    };
    let chance = |random: &mut RandomNumbers, share: f64| f64::from(u8::from(random.next() < share));
    bench.put(&mut values, "pointing.scenario", random.whole(1, 8));
    bench.put(&mut values, "aimpoint.option", random.whole(0, 14));
    bench.put(&mut values, "secondAimpoint.option", random.whole(0, 14));
    bench.put(&mut values, "keepIn.enabled", chance(random, 0.6));
    bench.put(&mut values, "hotPole.enabled", chance(random, 0.6));
    bench.put(&mut values, "monitor.enabled", chance(random, 0.7));
    // The theory of the planets costs most.
    let source = if random.next() < 0.95 { 3.0 } else { random.whole(1, 2) };
    bench.put(&mut values, "ephemeris.source", source);
    bench.put(&mut values, "target.planet", if random.next() < 0.9 { 1.0 } else { random.whole(3, 4) });
    bench.put(&mut values, "start.epoch", random.between(0.0, 3e7));
    bench.put(&mut values, "estimate.valid", 1.0);
    match subject {
        Subject::Scenario(scenario) => item(bench, &mut values, "pointing.scenario", scenario),
        Subject::Aimpoint(option) => {
            item(bench, &mut values, "pointing.scenario", 2);
            item(bench, &mut values, "aimpoint.option", option);
            bench.put(&mut values, "hotPole.enabled", 0.0);
        }
        Subject::SecondAimpoint(option) => {
            item(bench, &mut values, "pointing.scenario", 5);
            item(bench, &mut values, "aimpoint.option", random.whole(1, 14) as i32);
            item(bench, &mut values, "secondAimpoint.option", option);
        }
        Subject::Scan(frame) => {
            item(bench, &mut values, "scan.frame", frame);
            bench.put(&mut values, "pointing.scenario", if random.next() < 0.5 { 5.0 } else { 2.0 });
            let aims = [6.0, 7.0, 9.0, 13.0, 12.0, 5.0];
            let aim = aims[(random.next() * 6.0) as usize % 6];
            bench.put(&mut values, "aimpoint.option", aim);
        }
        Subject::Modes => {
            bench.put(&mut values, "pointing.scenario", random.whole(2, 3));
            bench.put(&mut values, "mode.request", random.whole(0, 3));
            bench.put(&mut values, "estimate.valid", chance(random, 0.6));
            bench.put(&mut values, "sun.sensedValid", chance(random, 0.6));
        }
        Subject::Monitor => {
            bench.put(&mut values, "pointing.scenario", random.whole(2, 3));
            bench.put(&mut values, "monitor.enabled", 1.0);
            bench.put(&mut values, "mode.request", random.whole(0, 2));
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.8));
            bench.put(&mut values, "ephemeris.source", if random.next() < 0.8 { 3.0 } else { 2.0 });
        }
        Subject::Ephemeris => {
            bench.put(&mut values, "pointing.scenario", random.whole(2, 3));
            bench.put(&mut values, "ephemeris.source", 4.0);
            bench.put(&mut values, "target.planet", 1.0);
            bench.put(&mut values, "mode.request", random.whole(0, 1));
            bench.put(&mut values, "sun.sensedValid", 1.0);
            bench.put(&mut values, "monitor.enabled", 0.0);
            bench.put(&mut values, "aimpoint.option", random.whole(1, 3));
        }
        Subject::Generic => {
            bench.put(&mut values, "pointing.scenario", 1.0);
            bench.put(&mut values, "boresight.option", random.whole(1, 4));
            bench.put(&mut values, "bodyRoll.option", random.whole(1, 2));
            bench.put(&mut values, "externalRoll.option", random.whole(1, 5));
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.2));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.2));
            bench.put(&mut values, "scan.frame", random.whole(0, 2));
        }
        Subject::Lost(what) => {
            let (scenario, boresight, aim) = match what {
                0 => (1, 1, 10),
                1 => (2, 4, 1),
                2 => (1, 4, 1),
                3 => (2, 4, 8),
                4 => (8, 4, 1),
                5 => (5, 4, 5),
                6 => (1, 4, 5),
                _ => (2, 4, 15),
            };
            item(bench, &mut values, "pointing.scenario", scenario);
            item(bench, &mut values, "boresight.option", boresight);
            item(bench, &mut values, "aimpoint.option", aim);
            bench.put(&mut values, "limb.reference", 1.0);
            bench.put(&mut values, "mode.request", 1.0);
            bench.put(&mut values, "scan.frame", random.whole(0, 2));
            // A spacecraft that is promoted from Earth Acquisition has an error quaternion to lose.
            bench.put(&mut values, "sun.sensedValid", 1.0);
        }
        Subject::OrbitPhase => {
            item(bench, &mut values, "pointing.scenario", 10);
            bench.put(&mut values, "guided.downlinkEvery", random.whole(1, 2));
            bench.put(&mut values, "guided.slewRate", if random.next() < 0.3 { 0.0 } else { 1e-3 });
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.3));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.3));
        }
        Subject::HotPole => {
            bench.put(&mut values, "hotPole.enabled", 1.0);
            bench.put(&mut values, "pointing.scenario", random.whole(1, 3));
        }
        Subject::Link => item(bench, &mut values, "pointing.scenario", 6),
        Subject::Burn => {
            item(bench, &mut values, "pointing.scenario", 9);
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.3));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.3));
            bench.put(&mut values, "monitor.enabled", chance(random, 0.3));
            bench.put(&mut values, "burn.thrusters", random.whole(0, 3));
        }
        Subject::Momentum | Subject::Predictive => {
            let scenario = if random.next() < 0.7 { 6 } else { 10 };
            item(bench, &mut values, "pointing.scenario", scenario);
            bench.put(&mut values, "boresight.option", random.whole(0, 3));
            let is_predictive = subject == Subject::Predictive;
            bench.put(&mut values, "momentum.strategy", if is_predictive { 3.0 } else { 2.0 });
            bench.put(&mut values, "momentum.horizon", random.whole(1, 2));
            bench.put(&mut values, "momentum.targetAxes", random.whole(1, 3));
            bench.put(&mut values, "momentum.targeting", random.whole(1, 2));
            bench.put(&mut values, "momentum.convention", random.whole(1, 2));
            bench.put(&mut values, "solar.fixedPressure", chance(random, 0.3));
            bench.put(&mut values, "dump.reinitTo", random.whole(1, 2));
            let every = if is_predictive { random.whole(1, 2) } else { 1.0 };
            bench.put(&mut values, "guided.downlinkEvery", every);
            let is_slewing = is_predictive && random.next() < 0.3;
            bench.put(&mut values, "guided.slewRate", if is_slewing { 1e-3 } else { 0.0 });
            bench.put(&mut values, "monitor.enabled", 0.0);
            bench.put(&mut values, "keepIn.enabled", chance(random, 0.3));
            bench.put(&mut values, "hotPole.enabled", chance(random, 0.3));
            for panel in (1..).take_while(|k| bench.has(&format!("panel[{k}].tilt"))) {
                bench.put(&mut values, &format!("panel[{panel}].tilt"), random.whole(1, 2));
                bench.put(&mut values, &format!("panel[{panel}].enabled"), chance(random, 0.8));
            }
        }
    }
    redraw(bench, random, subject, &mut values);
    values
}

/// Other numbers with the same options.
fn redraw(bench: &Guide, random: &mut RandomNumbers, subject: Subject, values: &mut Tables) {
    for name in ["boresight.vector", "aimpoint.vector", "secondAimpoint.vector", "bodyRoll.vector"] {
        bench.put_vector(values, name, &random.direction());
    }
    for name in ["externalRoll.vector", "sun.sensed"] {
        bench.put_vector(values, name, &random.direction());
    }
    let far = |random: &mut RandomNumbers, size_m: f64| random.direction().map(|x| size_m * x);
    for name in ["aimpoint.position", "secondAimpoint.position"] {
        let size_m = if random.next() < 0.5 { 2e6 } else { 3e10 };
        bench.put_vector(values, name, &far(random, size_m));
    }
    for name in [
        "boresight.azimuth",
        "boresight.angle",
        "aimpoint.rightAscension",
        "aimpoint.longitude",
        "aimpoint.azimuth",
        "secondAimpoint.rightAscension",
        "secondAimpoint.longitude",
        "secondAimpoint.azimuth",
        "bodyRoll.azimuth",
        "externalRoll.rightAscension",
        "limb.azimuth",
    ] {
        bench.put(values, name, random.between(-3.0, 3.0));
    }
    for name in [
        "boresight.elevation",
        "aimpoint.declination",
        "aimpoint.latitude",
        "aimpoint.elevation",
        "secondAimpoint.declination",
        "secondAimpoint.latitude",
        "secondAimpoint.elevation",
        "bodyRoll.elevation",
        "externalRoll.declination",
    ] {
        bench.put(values, name, random.between(-1.4, 1.4));
    }
    for name in ["aimpoint.height", "secondAimpoint.height", "limb.height"] {
        bench.put(values, name, random.between(-1e5, 1e5));
    }
    bench.put(values, "limb.heightRate", random.between(-1e3, 1e3));
    bench.put_vector(values, "scan.rate", &random.direction().map(|x| 0.02 * x));
    bench.put_vector(values, "scan.speed", &far(random, 3e4));
    for axis in 1..=3 {
        bench.put(values, &format!("scan.duration[{axis}]"), random.between(1.0, 4.0));
        bench.put(values, &format!("scan.pause[{axis}]"), random.between(0.0, 2.0));
    }
    redraw_burn(bench, random, values);
    let distance_m = random.between(4e10, 8e10);
    let sun = far(random, distance_m);
    bench.put_vector(values, "sun.position", &sun);
    bench.put_vector(values, "sun.velocity", &far(random, 4e4));
    bench.put_vector(values, "earth.position", &far(random, 1.5e11));
    bench.put_vector(values, "earth.velocity", &far(random, 6e4));
    let radius_m = random.between(2.5e6, 9e6);
    let place = Vector3::from(random.direction());
    let along = place.cross(&Vector3::from(random.direction())).normalize();
    // Not far from periapsis or apoapsis of an orbit.
    let climb_rad = random.between(-0.6, 0.6);
    let speed_m_s = (2.2e13 / radius_m).sqrt() * random.between(0.9, 1.3);
    let velocity = (along * climb_rad.cos() + place * climb_rad.sin()) * speed_m_s;
    bench.put_vector(values, "position", (place * radius_m).as_slice());
    bench.put_vector(values, "velocity", velocity.as_slice());
    bench.put_vector(values, "planet.radii", &[2.44e6, 2.42e6, 2.40e6]);
    bench.put_vector(values, "estimate.q", &unit_quaternion(random));
    bench.put_vector(values, "start.q", &unit_quaternion(random));
    bench.put(values, "ephemeris.trueAnomaly", random.between(0.0, 6.0));
    bench.put(values, "keepIn.azimuth", random.between(0.05, 0.6));
    bench.put(values, "keepIn.elevation", random.between(0.05, 0.6));
    bench.put_vector(values, "keepIn.axis", &random.direction());
    bench.put(values, "keepIn.distance", if random.next() < 0.3 { random.between(4e10, 9e10) } else { 1e12 });
    bench.put(values, "safeHold.keepIn.azimuth", random.between(0.05, 0.6));
    bench.put(values, "safeHold.keepIn.elevation", random.between(0.05, 0.6));
    bench.put(
        values,
        "monitor.persistence",
        if random.next() < 0.5 { 0.0 } else { random.between(0.0, 6.0) },
    );
    bench.put(values, "monitor.margin", random.between(0.0, 1.5));
    bench.put(
        values,
        "ephemeris.persistence",
        if random.next() < 0.8 { 0.0 } else { random.between(0.0, 6.0) },
    );
    bench.put(values, "ephemeris.tolerance", random.between(0.0, 3.0));
    bench.put(values, "mdis.minimum", random.between(-1.5, -0.2));
    bench.put(values, "mdis.maximum", random.between(0.2, 1.5));
    bench.put(values, "sunSearch.duration", random.between(1.0, 4.0));
    bench.put(values, "hotPole.altitude", random.between(1e5, 9e6));
    bench.put(values, "hotPole.angle", random.between(0.2, 3.0));
    bench.put(values, "hotPole.cone", random.between(0.5, 3.0));
    // The window begins or ends about now.
    let start_s = random.between(0.0, 3000.0);
    bench.put(values, "guided.downlinkStart", start_s);
    bench.put(values, "guided.downlinkEnd", start_s + random.between(0.0, 3000.0));
    bench.put(values, "guided.scienceGain", random.between(0.1, 1.0));
    if subject == Subject::Link {
        bench.put(values, "ephemeris.source", 3.0);
        let sun = Vector3::from(sun);
        let aside = Vector3::from(random.direction());
        // Behind the planet's limb, near the Sun, or anywhere.
        let place_of_earth = random.whole(0, 2) as i32;
        let earth = match place_of_earth {
            0 => {
                let across = place.cross(&aside).normalize() * (2.44e6 / radius_m * random.between(0.9, 1.1));
                (across - place).normalize() * 1.5e11
            }
            1 => (sun.normalize() + aside * random.between(0.01, 0.1)).normalize() * 1.5e11,
            _ => aside * 1.5e11,
        };
        bench.put_vector(values, "earth.position", earth.as_slice());
        // A commanded beam seldom lies on an Earth near the Sun.
        let beam = if place_of_earth == 1 { 3.0 } else { random.whole(3, 4) };
        bench.put(values, "boresight.option", beam);
        bench.put(values, "link.sunExclusion", random.between(0.0, 0.1));
        bench.put(values, "link.beam", random.between(0.0, 0.5));
    }
    if matches!(subject, Subject::Scan(_) | Subject::SecondAimpoint(_)) && random.next() < 0.6 {
        // A camera that follows wherever it is.
        bench.put(values, "mdis.minimum", -3.1);
        bench.put(values, "mdis.maximum", 3.1);
    }
    if subject == Subject::Scan(5) && random.next() < 0.4 {
        bench.put(values, "ephemeris.source", 3.0);
        bench.put(values, "aimpoint.option", 12.0);
        bench.put(values, "scan.reference", random.whole(1, 2));
        bench.put_vector(values, "sun.position", (place * 6e10).as_slice());
    }
    if subject == Subject::Modes && random.next() < 0.5 {
        bench.put(values, "estimate.valid", 0.0);
        bench.put(values, "sun.sensedValid", random.whole(0, 1));
        bench.put_vector(values, "sun.sensed", &[0.0; 3]);
    }
    if subject == Subject::OrbitPhase {
        // Not long after periapsis, where a slew begins.
        let climb_rad = random.between(0.05, 0.5);
        let speed_m_s = (2.2e13 / radius_m).sqrt() * random.between(1.0, 1.3);
        let velocity = (along * climb_rad.cos() + place * climb_rad.sin()) * speed_m_s;
        bench.put_vector(values, "velocity", velocity.as_slice());
        bench.put(values, "guided.downlinkStart", random.between(0.0, 900.0));
        bench.put(values, "guided.downlinkEnd", random.between(900.0, 9000.0));
    }
    redraw_momentum(bench, random, values);
    if subject.is_momentum() {
        bench.put(values, "ephemeris.source", 3.0);
        bench.put(values, "guided.downlinkStart", random.between(0.0, 900.0));
        bench.put(values, "guided.downlinkEnd", random.between(9000.0, 36_000.0));
        if subject == Subject::Predictive {
            // Shorter than an orbit, and thresholds beyond what the next science brings.
            bench.put(values, "guided.downlinkEnd", random.between(2000.0, 4000.0));
            let size = if random.next() < 0.7 { 10.0 } else { 1.0 };
            bench.put_vector(values, "dump.threshold", &[0; 3].map(|_| size * random.between(0.1, 0.5)));
        }
        if random.next() < 0.5 {
            // Not connected: the attitude held turns the momentum.
            bench.put_vector(values, "estimate.q", &[0.0, 0.0, 0.0, 1.0]);
        }
    }
    if let Subject::Lost(what) = subject {
        bench.put(values, "ephemeris.source", 3.0);
        let place = place * radius_m;
        match what {
            0 => bench.put_vector(values, "boresight.vector", &[0.0; 3]),
            1 | 2 => bench.put_vector(values, "aimpoint.vector", &[0.0; 3]),
            3 | 4 => bench.put_vector(values, "velocity", &[0.0; 3]),
            5 | 6 => bench.put_vector(values, "aimpoint.position", place.as_slice()),
            _ => bench.put(values, "aimpoint.body", 0.0),
        }
    }
    if subject == Subject::Monitor {
        bench.put(values, "monitor.persistence", 0.0);
        bench.put(values, "monitor.margin", random.between(0.0, 2.0));
        bench.put(values, "keepIn.distance", if random.next() < 0.3 { 6e10 } else { 1e12 });
        match random.whole(0, 4) as i32 {
            0 => bench.put_vector(values, "estimate.q", &[0.0, 0.0, 0.0, 1.0]),
            1 => bench.put_vector(values, "estimate.q", &[0.0; 4]),
            2 => bench.put_vector(values, "earth.position", &[0.0; 3]),
            3 => bench.put_vector(values, "position", &[0.0; 3]),
            _ => {}
        }
    }
    if subject == Subject::HotPole {
        bench.put(values, "ephemeris.source", 3.0);
        let above = (place + Vector3::from(random.direction()) * 0.5).normalize() * 6e10;
        bench.put_vector(values, "sun.position", above.as_slice());
        let height_m = if random.next() < 0.3 { 1e9 } else { radius_m - 2.42e6 + random.between(-2e4, 2e4) };
        bench.put(values, "hotPole.altitude", height_m.max(0.0));
    }
}

/// A burn of some seconds, straight or turning.
fn redraw_burn(bench: &Guide, random: &mut RandomNumbers, values: &mut Tables) {
    let delta_v = if random.next() < 0.2 { [0.0; 3] } else { random.direction() };
    let is_straight = delta_v == [0.0; 3] || random.next() < 0.5;
    for i in 1..=3 {
        let along = delta_v[i - 1];
        bench.put(values, &format!("burn.deltaV[{i}]"), if is_straight { along } else { 0.0 });
        for (j, share) in (1..=3).zip([1.0, 0.2, 0.1]) {
            let bent = if j == 1 { along } else { random.between(-share, share) };
            bench.put(values, &format!("burn.profile[{i},{j}]"), if is_straight { 0.0 } else { bent });
        }
    }
    let direction = if random.next() < 0.3 { [0.0; 3] } else { random.direction() };
    bench.put_vector(values, "burn.thrustDirection", &direction);
    bench.put(values, "burn.acceleration", if random.next() < 0.3 { 0.0 } else { random.between(0.01, 0.5) });
    bench.put(values, "burn.start", random.between(-3.0, 2.0));
    bench.put(values, "burn.timeout", random.between(1.0, 9.0));
    bench.put(values, "burn.gain", random.between(0.1, 1.0));
    bench.put_vector(values, "accelerometer.deltaV", &random.direction().map(|x| 0.2 * x));
}

/// Momentum of which some is beyond a threshold, and what acts on it.
fn redraw_momentum(bench: &Guide, random: &mut RandomNumbers, values: &mut Tables) {
    bench.put_vector(values, "momentum.body", &random.direction().map(|x| 0.4 * x));
    bench.put_vector(values, "momentum.target", &random.direction().map(|x| 0.4 * x));
    bench.put_vector(values, "dump.threshold", &[0; 3].map(|_| random.between(0.1, 0.5)));
    bench.put(values, "dump.reinitFraction", random.between(0.0, 1.0));
    bench.put_vector(values, "spacecraft.centerOfMass", &random.direction().map(|x| 0.03 * x));
    bench.put(values, "solar.flux", random.between(1_000.0, 2_000.0));
    bench.put(values, "solar.pressure", random.between(3e-5, 6e-5));
    for panel in (1..).take_while(|k| bench.has(&format!("panel[{k}].tilt"))) {
        bench.put(values, &format!("panel[{panel}].nominalSunOffset"), random.between(0.1, 1.4));
    }
}

/// Inputs as masters send them before the first exchange.
fn unset(bench: &Guide, random: &mut RandomNumbers, values: &mut Tables) {
    let inputs = [
        ("position", 3, 0.06),
        ("velocity", 3, 0.06),
        ("sun.position", 3, 0.06),
        ("earth.position", 3, 0.06),
        ("estimate.q", 4, 0.1),
        ("sun.sensed", 3, 0.3),
        ("boresight.vector", 3, 0.1),
        ("aimpoint.vector", 3, 0.1),
        ("secondAimpoint.vector", 3, 0.1),
        ("bodyRoll.vector", 3, 0.1),
        ("externalRoll.vector", 3, 0.1),
        ("scan.rate", 3, 0.1),
        ("scan.duration", 3, 0.3),
        ("momentum.body", 3, 0.1),
    ];
    for (name, length, share) in inputs {
        if random.next() < share {
            bench.put_vector(values, name, &[0.0; 4][..length]);
        }
    }
    if random.next() < 0.1 {
        bench.put_vector(values, "estimate.q", &[0.0, 0.0, 0.0, 1.0]);
    }
}

/// Places things in line, so that a fallback stands in for what has no direction.
fn align(bench: &Guide, random: &mut RandomNumbers, values: &mut Tables) {
    let vector = |values: &Tables, name: &str| {
        Vector3::from([1, 2, 3].map(|i| bench.real(values, &format!("{name}[{i}]"))))
    };
    let place = vector(values, "position");
    match random.whole(0, 11) as i32 {
        10 => bench.put_vector(values, "aimpoint.position", place.as_slice()),
        11 => {
            // Against a camera at the end of its range.
            bench.put(values, "boresight.angle", random.between(1.5, 2.0));
            let most = bench.real(values, "mdis.maximum");
            bench.put_vector(values, "bodyRoll.vector", &[0.0, -most.sin(), most.cos()]);
        }
        0 => bench.put_vector(values, "sun.position", (place * 1e4).as_slice()),
        1 => bench.put_vector(values, "velocity", (place * 1e-4).as_slice()),
        2 => bench.put_vector(values, "earth.position", (place * -2e4).as_slice()),
        3 => {
            let sun = vector(values, "sun.position") - place;
            bench.put_vector(values, "earth.position", (place + sun * 2.0).as_slice());
        }
        4 => {
            let sun = vector(values, "sun.position") - place;
            bench.put_vector(values, "aimpoint.vector", sun.as_slice());
            bench.put_vector(values, "externalRoll.vector", sun.as_slice());
        }
        5 => {
            let roll = vector(values, "boresight.vector");
            bench.put_vector(values, "bodyRoll.vector", (-roll).as_slice());
        }
        6 => {
            for name in ["azimuth", "elevation"] {
                let roll = bench.real(values, &format!("boresight.{name}"));
                bench.put(values, &format!("bodyRoll.{name}"), roll);
            }
            let vector = bench.real(values, "boresight.azimuth");
            let up = bench.real(values, "boresight.elevation");
            let along = [up.cos() * vector.sin(), -up.cos() * vector.cos(), -up.sin()];
            bench.put_vector(values, "bodyRoll.vector", &along);
        }
        7 => {
            let angle = bench.real(values, "boresight.angle");
            bench.put_vector(values, "bodyRoll.vector", &[0.0, -angle.sin(), angle.cos()]);
        }
        8 => {
            for (roll, aim) in [("rightAscension", "rightAscension"), ("declination", "declination")] {
                let angle = bench.real(values, &format!("aimpoint.{aim}"));
                bench.put(values, &format!("externalRoll.{roll}"), angle);
            }
        }
        _ => {
            // The aimpoint at the Sun by its angles.
            let sun = (vector(values, "sun.position") - place).normalize();
            bench.put(values, "aimpoint.rightAscension", sun.y.atan2(sun.x));
            bench.put(values, "aimpoint.declination", sun.z.asin());
        }
    }
}

/// Puts the Sun where +Z is aimed in `seen`, so that the aim has no external roll reference.
fn sun_on_aim(bench: &Guide, seen: &Tables, values: &mut Tables) {
    let vector = |name: &str| Vector3::from([1, 2, 3].map(|i| bench.real(values, &format!("{name}[{i}]"))));
    let [x, y, z, w] = [1, 2, 3, 4].map(|i| bench.real(seen, &format!("command.q[{i}]")));
    let to_inertial = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    let sun = vector("position") + to_inertial * Vector3::z() * 6e10;
    bench.put_vector(values, "sun.position", sun.as_slice());
}

/// Aims +Z without constraints at what does not depend on the Sun.
fn aimed_alone(bench: &Guide, random: &mut RandomNumbers, subject: Subject, values: &mut Tables) {
    let aims = [1.0, 2.0, 3.0, 5.0, 6.0, 7.0, 8.0];
    let aim = aims[(random.next() * 7.0) as usize % 7];
    let scenario = if random.next() < 0.3 { 8.0 } else { 2.0 };
    for (name, value) in [
        ("keepIn.enabled", 0.0),
        ("hotPole.enabled", 0.0),
        ("monitor.enabled", 0.0),
        ("boresight.instrument", 0.0),
        ("ephemeris.source", 3.0),
        ("limb.reference", 1.0),
        ("pointing.scenario", scenario),
        ("aimpoint.option", aim),
    ] {
        bench.put(values, name, value);
    }
    if !matches!(subject, Subject::Scan(_)) && random.next() < 0.3 {
        bench.put(values, "scan.frame", random.whole(2, 4));
    }
}

/// Changes what a flight in a mode meets next.
fn disturb(bench: &Guide, random: &mut RandomNumbers, flight: &mut Simulation<Guidance>) {
    bench.put(&mut flight.values, "mode.request", random.whole(0, 3));
    bench.put(&mut flight.values, "sun.sensedValid", random.whole(0, 1));
    bench.put(&mut flight.values, "estimate.valid", random.whole(0, 1));
}

fn measure(text: &str, rounds: usize) {
    let mut bench = Guide::new(text).with_carriers(CARRIERS).with_schedule("ephemeris.toml", FLOWN);
    let mut random = RandomNumbers(17);
    let subjects = subjects();
    let mut flown = 0;
    for round in 0..rounds {
        let subject = subjects[round % subjects.len()];
        let mut values = draw(&bench, &mut random, subject);
        let turn = round / subjects.len();
        if turn % 3 == 1 {
            unset(&bench, &mut random, &mut values);
        }
        let alone = turn % 3 == 2 && random.next() < 0.4;
        if alone {
            aimed_alone(&bench, &mut random, subject, &mut values);
            if let Some(flight) = bench.initialize(&values, 0.0) {
                sun_on_aim(&bench, &flight.values, &mut values);
            }
        } else if turn % 3 == 2 {
            align(&bench, &mut random, &mut values);
        }
        let mut others = Vec::new();
        if subject == Subject::Monitor {
            // From where the monitor trips to where it does not.
            for margin_rad in [0.0, 3.1] {
                let mut other = values.clone();
                bench.put(&mut other, "monitor.margin", margin_rad);
                others.push(other);
            }
            // Safe Hold's own zone from nothing to everything.
            for limit_rad in [0.0, 1.5] {
                let mut other = values.clone();
                bench.put(&mut other, "safeHold.keepIn.elevation", limit_rad);
                others.push(other);
            }
        } else if subject == Subject::Ephemeris {
            // From where the Sun sensors contradict to where they do not.
            for (name, value) in
                [("ephemeris.tolerance", 0.0), ("ephemeris.tolerance", 3.1), ("ephemeris.persistence", 9.0)]
            {
                let mut other = values.clone();
                bench.put(&mut other, name, value);
                others.push(other);
            }
        } else {
            others.push(values.clone());
            redraw(&bench, &mut random, subject, &mut others[0]);
        }
        if bench.initialize(&values, 0.0).is_none() {
            continue;
        }
        flown += 1;
        if turn % 3 == 2 {
            // Where nothing gives the roll, the rounding of a scan's turn by nothing does.
            bench.look_at_start_by(&values, 0.0, |name| !name.starts_with("scan."));
        } else {
            bench.look_at_start(&values, 0.0);
            for edge in bench.edges_at_start(&values, &others, 0.0) {
                bench.look_at_start_edge(&edge, 0.0);
            }
        }
        let mut begun = values.clone();
        if subject.is_momentum() {
            bench.put(&mut begun, "pointing.scenario", 3.0);
            bench.put_vector(&mut begun, "momentum.body", &[0.0; 3]);
        }
        let Some(mut flight) = bench.initialize(&begun, 0.0) else { continue };
        if let Subject::Lost(_) = subject {
            bench.put(&mut flight.values, "mode.request", 3.0);
        }
        if bench.step(&mut flight, random.whole(1, 7)).is_none() {
            continue;
        }
        if let Subject::Lost(_) = subject {
            bench.put(&mut flight.values, "mode.request", 1.0);
        }
        if subject == Subject::Burn {
            // The increment of an interval under way.
            bench.put_vector(
                &mut flight.values,
                "accelerometer.deltaV",
                &random.direction().map(|x| 0.2 * x),
            );
            flight.changed = true;
        }
        if subject.is_momentum() {
            // The downlink begins here.
            bench.copy(&mut flight.values, &values, |name| {
                name == "pointing.scenario" || name.starts_with("momentum.body")
            });
            flight.changed = true;
        }
        if subject == Subject::Modes {
            disturb(&bench, &mut random, &mut flight);
        }
        let mut onward = flight.clone();
        if alone && bench.step(&mut onward, 1e-6).is_some() {
            sun_on_aim(&bench, &onward.values, &mut flight.values);
            flight.changed = true;
        }
        bench.look_at_step(&flight);
        for edge in bench.edges_at_step(&flight, &others) {
            bench.look_at_step_edge(&edge);
        }
        if round > 2 * subjects.len() && round % 8 == 0 && bench.is_done() {
            println!("done after {round}");
            break;
        }
    }
    // Rare: scans with aims that only another compatibility allows.
    let aims = [1.0, 4.0, 8.0, 10.0, 11.0];
    for (frame, aim) in [3, 4, 5].into_iter().flat_map(|frame| aims.map(|aim| (frame, aim))) {
        let mut values = draw(&bench, &mut random, Subject::Scan(frame));
        for (name, value) in [
            ("keepIn.enabled", 0.0),
            ("hotPole.enabled", 0.0),
            ("monitor.enabled", 0.0),
            ("mode.request", 0.0),
            ("estimate.valid", 1.0),
            ("pointing.scenario", 2.0),
            ("aimpoint.option", aim),
            ("ephemeris.source", 3.0),
            // The Sun may stand at the zenith, where no azimuth counts from it.
            ("scan.reference", 1.0),
        ] {
            bench.put(&mut values, name, value);
        }
        bench.put_vector(&mut values, "scan.rate", &[1e-3, 2e-3, -1e-3]);
        bench.put_vector(&mut values, "scan.duration", &[20.0, 30.0, 40.0]);
        bench.look_at_start(&values, 0.0);
    }
    // Rare: a burn that begins at once, and whose time is up before its magnitude.
    let mut values = draw(&bench, &mut random, Subject::Burn);
    for (name, value) in [
        ("keepIn.enabled", 0.0),
        ("hotPole.enabled", 0.0),
        ("monitor.enabled", 0.0),
        ("mode.request", 0.0),
        ("burn.acceleration", 0.01),
        ("burn.start", -1.0),
        ("burn.timeout", 5.0),
    ] {
        bench.put(&mut values, name, value);
    }
    bench.put_vector(&mut values, "burn.deltaV", &[0.6, -0.8, 0.3]);
    for i in 1..=3 {
        for j in 1..=3 {
            bench.put(&mut values, &format!("burn.profile[{i},{j}]"), 0.0);
        }
    }
    bench.look_at_start(&values, 0.0);
    assert!(flown > 20, "{flown} flown");
    bench.judge();
}

#[test]
fn guidance_shipped() {
    measure(Guidance::DEFAULT_SETUP, ROUNDS);
}

/// Instruments that look elsewhere.
#[test]
fn guidance_with_other_instruments() {
    let instruments = "\n[[instruments]]\nname = \"aside\"\nboresight = [0.6, 0.0, 0.8]\n\
                       [[instruments]]\nname = \"down\"\nboresight = [0.0, 0.6, 0.8]\n\
                       [[instruments]]\nname = \"sunward\"\nboresight = [0.0, -1.0, 0.0]\n";
    measure(&format!("{}{instruments}", super::spacecraft::ALL), ROUNDS);
}
