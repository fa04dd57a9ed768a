//! MomentumPlant: three spacecraft, every option drawn at random, and what drawing would hardly meet.

use fmi_export::Model;
use models::MomentumPlant;

use super::super::named_model::Tables;
use super::bench::Bench;
use super::plant_dynamics;
use super::random::RandomNumbers;
use super::spacecraft::{ALL, RADIATING};

type Plant = Bench<MomentumPlant>;

/// Options drawn at random, with their items in this version.
const OPTIONS: &[(&str, i32, i32)] = &[
    ("attitude.source", 1, 2),
    ("command.source", 1, 2),
    ("command.kind", 0, 3),
    ("guided.scienceRule", 1, 3),
    ("guided.downlinkEvery", 0, 2),
    ("guided.downlinkReference", 1, 2),
    ("orbit.source", 1, 3),
    ("momentum.strategy", 1, 2),
    ("momentum.targetAxes", 1, 3),
    ("momentum.targeting", 1, 2),
    ("orbit.dynamics", 1, 2),
    ("orbit.sunTide", 0, 1),
    ("orbit.radiationFeedback", 0, 1),
    ("orbit.frame", 1, 4),
    ("ephemeris.source", 1, 3),
    ("solar.fixedPressure", 0, 1),
    ("eclipse.method", 1, 4),
    ("planet.dayTemperature", 1, 2),
    ("planetLight.enabled", 0, 1),
    ("planetLight.nodes", 3, 5),
    ("thermal.enabled", 0, 1),
    ("thermal.storage", 0, 1),
    ("shadowing.enabled", 0, 1),
    ("shadowing.sunDisc", 0, 1),
    ("gravityGradient.enabled", 0, 1),
    ("momentum.convention", 1, 2),
    ("dump.reinitTo", 1, 2),
    ("control.allocation", 1, 2),
    ("control.frictionCompensation", 0, 1),
];

/// What a drawing is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Subject {
    Anything,
    /// The guided attitude, near its windows.
    Guided,
    /// The same with orbit, Sun and Earth given, so that all inputs act on it.
    GuidedByInputs,
    Commanded,
    /// An orbit about the planet so wide that it is one about the Sun too.
    Wide,
    /// The planet before the Sun.
    Eclipse,
    /// Body and wheels under the controller; without wheels in all directions as free.
    Controlled,
    Free,
}

use Subject::{Anything, Commanded, Controlled, Eclipse, Free, Guided, GuidedByInputs, Wide};

const SUBJECTS: [Subject; 9] =
    [Anything, Guided, Controlled, GuidedByInputs, Commanded, Controlled, Wide, Eclipse, Free];

/// Whether body and wheels move by torque.
fn is_flown(bench: &Plant, values: &Tables) -> bool {
    bench.real(values, "attitude.source") > 2.5
}

/// Flags and dumps change at limits, which few states are near; through what a known reaches them.
const CARRIERS: &[(&str, &str)] = &[
    ("sunshade.polynomialValid", "sun.direction"),
    ("sun.litFraction", "heliocentric.position"),
    ("momentum.", "attitude.q"),
    // Flag and error tell of the same choice.
    ("momentum.targetClamped", "control.error"),
    // Where the Sun is to stand moves all that is seen from the body.
    ("sun.", "attitude.q"),
    ("earth.", "attitude.q"),
    ("planet.positionBody", "attitude.q"),
    ("keepIn.margin", "attitude.q"),
    ("dump.", "attitude.q"),
    ("dump.", "momentum.inertial"),
    // What is commanded for good at the start turns the body under all light.
    ("torque.", "attitude.q"),
    // A dump begins where the momentum exceeds a threshold.
    ("torque.thruster", "momentum.inertial"),
    ("torque.thruster", "dump.impulse"),
    ("torque.total", "torque.thruster"),
    ("force.", "attitude.q"),
    ("panel[", "attitude.q"),
    ("plate[", "attitude.q"),
    // Stored heat is read from the same stretch of light.
    ("plate[", "torque.thermal"),
    ("estimate.valid", "estimate.q"),
    ("wheel", "attitude.q"),
    ("wheel", "wheel.momentum"),
    ("wheel", "wheel.torque"),
    ("control.", "attitude.q"),
    ("control.s", "wheel.torque"),
    // The controller has nothing but the estimate.
    ("control.", "estimate.q"),
    ("wheel", "estimate.q"),
    // Of components that are dumped together the torque's direction follows the target.
    ("control.saturated", "dump.impulse"),
    ("sun.sensedValid", "sun.sensed"),
    // What is left of noise by the gain may hardly move one of its elements.
    ("estimate.q", "estimate.q"),
    ("sun.velocityInertial", "sun.positionInertial"),
    ("earth.velocityInertial", "earth.positionInertial"),
];

/// Cells of light and intervals of motion so short, and fitted so closely, that they leave nothing to see.
const FINE_S: f64 = 1e-3;
const FINE: f64 = 1e-10;
/// As short as flights can have them.
const SHORT_S: f64 = 5.0;

/// Inputs as masters send them before the first exchange.
fn unset(bench: &Plant, random: &mut RandomNumbers, subject: Subject, values: &mut Tables) {
    let inputs = ["command.q", "command.error", "orbit.position", "orbit.velocity", "sun.position"];
    let sun = if subject == Wide { 0.4 } else { 0.1 };
    if is_flown(bench, values) && random.next() < 0.4 {
        let place = inputs[2 + random.whole(0, 2) as usize];
        bench.put_vector(values, place, &[0.0; 3]);
        return;
    }
    for (name, share) in inputs.into_iter().zip([0.15, 0.3, 0.1, 0.1, sun]) {
        if random.next() < share {
            let zeros = [0.0; 4];
            bench.put_vector(values, name, &zeros[..if name.starts_with("command") { 4 } else { 3 }]);
        }
    }
}

fn draw(bench: &Plant, random: &mut RandomNumbers, subject: Subject, shapes: bool) -> Tables {
    let mut values = bench.defaults();
    for (name, low, high) in OPTIONS.iter().filter(|it| it.0 != "shadowing.enabled" || bench.outlined) {
        bench.put(&mut values, name, random.whole(*low, *high));
    }
    // The theory of the planets costs most.
    bench.put(&mut values, "ephemeris.source", if random.next() < 0.02 { 1.0 } else { random.whole(2, 3) });
    if random.next() < 0.03 {
        // Forecasts cost as much, and nothing is forecast at the start.
        bench.put(&mut values, "momentum.strategy", 3.0);
    }
    if bench.real(&values, "momentum.strategy") > 1.5 && bench.real(&values, "guided.downlinkEvery") == 0.0 {
        bench.put(&mut values, "guided.downlinkEvery", 1.0);
    }
    bench.put(&mut values, "start.epoch", random.between(0.0, 3e7));
    if shapes {
        bench.put(&mut values, "sunshade.shape", random.whole(1, 2));
    }
    bench.put(&mut values, "solver.disturbanceStep", FINE_S);
    bench.put(&mut values, "solver.dynamicsStep", FINE_S);
    bench.put(&mut values, "solver.disturbanceTolerance", FINE);
    bench.put(&mut values, "guided.slewRate", if random.next() < 0.3 { 0.0 } else { 1e-3 });
    let options: &[(&str, f64)] = match subject {
        Anything => &[],
        Guided => &[("attitude.source", 1.0), ("orbit.source", 1.0), ("guided.downlinkEvery", 1.0)],
        GuidedByInputs => &[
            ("attitude.source", 1.0),
            ("orbit.source", 2.0),
            ("ephemeris.source", 3.0),
            ("guided.downlinkEvery", 1.0),
        ],
        Commanded => &[("attitude.source", 2.0), ("command.source", 1.0), ("ephemeris.source", 3.0)],
        Controlled if bench.has("wheel[3].locked") => {
            &[("attitude.source", 3.0), ("momentum.convention", 1.0)]
        }
        Controlled | Free => &[("attitude.source", 4.0), ("momentum.convention", 1.0)],
        Wide => &[("guided.scienceRule", 3.0)],
        Eclipse => &[("eclipse.method", 1.0)],
    };
    for (name, value) in options {
        bench.put(&mut values, name, *value);
    }
    if (subject == Guided || subject == GuidedByInputs) && random.next() < 0.4 {
        bench.put(&mut values, "guided.scienceRule", 2.0);
    }
    if subject == Wide {
        bench.put(&mut values, "orbit.center", random.whole(1, 2));
        if random.next() < 0.4 {
            bench.put(&mut values, "attitude.source", 4.0);
            bench.put(&mut values, "momentum.convention", 1.0);
        }
    }
    if (subject == Controlled || subject == Free) && random.next() < 0.4 {
        bench.put(&mut values, "orbit.source", 2.0);
        bench.put(&mut values, "ephemeris.source", 3.0);
    }
    if subject == Commanded && random.next() < 0.75 {
        bench.put(&mut values, "command.kind", random.whole(1, 2));
    }
    if subject == Eclipse && random.next() < 0.05 {
        bench.put(&mut values, "orbit.source", 2.0);
        bench.put(&mut values, "ephemeris.source", 1.0);
    }
    for k in 1..9 {
        if bench.has(&format!("panel[{k}].control")) {
            bench.put(&mut values, &format!("panel[{k}].control"), random.whole(1, 3));
            bench.put(&mut values, &format!("panel[{k}].tilt"), random.whole(1, 2));
            bench.put(&mut values, &format!("panel[{k}].enabled"), f64::from(u8::from(random.next() < 0.9)));
        }
    }
    if is_flown(bench, &values) {
        plant_dynamics::unbalance(bench, random, &mut values);
    }
    redraw(bench, random, subject, &mut values);
    values
}

/// Other numbers with the same options.
fn redraw(bench: &Plant, random: &mut RandomNumbers, subject: Subject, values: &mut Tables) {
    let wide = subject == Wide;
    let sun = random.direction();
    bench.put_vector(values, "sun.position", &sun.map(|x| 6e10 * x));
    bench.put_vector(values, "earth.position", &random.direction().map(|x| 1.5e11 * x));
    let radius_m = random.between(3e6, 8e6);
    let (radius_m, speed_m_s) = if wide { (1e4 * radius_m, 5e4) } else { (radius_m, 2500.0) };
    bench.put_vector(values, "orbit.position", &random.direction().map(|x| radius_m * x));
    bench.put_vector(values, "orbit.velocity", &random.direction().map(|x| speed_m_s * x));
    if subject == GuidedByInputs {
        // Not long after periapsis, where a slew begins.
        let place =
            nalgebra::Vector3::from([1, 2, 3].map(|i| bench.real(values, &format!("orbit.position[{i}]"))));
        let up = place.normalize();
        let along = up.cross(&nalgebra::Vector3::from(random.direction())).normalize();
        let climb_rad = random.between(0.05, 0.4);
        let circular_m_s = (2.2e13 / place.norm()).sqrt();
        let velocity =
            (along * climb_rad.cos() + up * climb_rad.sin()) * (circular_m_s * random.between(1.05, 1.3));
        bench.put_vector(values, "orbit.velocity", velocity.as_slice());
    }
    if wide {
        bench.put(values, "orbit.semiMajorAxis", random.between(4e10, 8e10));
    }
    bench.put(values, "orbit.trueAnomaly", random.between(-3.0, 3.0));
    bench.put(values, "orbit.eccentricity", random.between(0.1, 0.6));
    bench.put(values, "ephemeris.trueAnomaly", random.between(0.0, 6.0));
    for name in ["command.q", "command.error", "start.q"] {
        let mut q = [0; 4].map(|_| random.between(-0.6, 0.6));
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        q.iter_mut().for_each(|x| *x /= norm);
        bench.put_vector(values, name, &q);
    }
    let torque_n_m = if random.next() < 0.5 { 1e-5 } else { 0.0 };
    bench.put_vector(values, "torque.applied", &random.direction().map(|x| torque_n_m * x));
    bench.put_vector(values, "command.rate", &random.direction().map(|x| 1e-3 * x));
    let momentum_n_m_s = random.between(2.0, 6.0);
    bench.put_vector(values, "start.momentum", &random.direction().map(|x| momentum_n_m_s * x));
    bench.put_vector(values, "spacecraft.centerOfMass", &random.direction().map(|x| 0.2 * x));
    let size = bench.real(values, "spacecraft.inertia[1,1]") / 100.0;
    for (row, column, value) in [(1, 2, 2.0), (1, 3, -3.0), (2, 3, 1.0)] {
        bench.put(values, &format!("spacecraft.inertia[{row},{column}]"), value * size);
        bench.put(values, &format!("spacecraft.inertia[{column},{row}]"), value * size);
    }
    bench.put_vector(values, "dump.target", &random.direction());
    for i in 1..4 {
        bench.put(values, &format!("dump.threshold[{i}]"), random.between(1.6, 4.0));
    }
    // Half of the flights begin with a dump, to which the next may be too close.
    let spacing_s = if random.next() < 0.5 { 1e5 } else { 10.0_f64.powf(random.between(-3.0, 3.0)) };
    bench.put(values, "dump.requiredSpacing", spacing_s);
    // Windows about the start, so that some edges lie close to it.
    bench.put(values, "guided.downlinkStart", random.between(0.0, 4000.0));
    bench.put(values, "guided.downlinkEnd", random.between(4000.0, 30_000.0));
    let most_rad = if random.next() < 0.5 { 0.3 } else { 1.5 };
    bench.put(values, "keepIn.elevation", random.between(0.05, most_rad));
    if (subject == Guided || subject == GuidedByInputs) && random.next() < 0.75 {
        // Often within a slew.
        bench.put(values, "orbit.trueAnomaly", random.between(0.3, 2.0));
        bench.put(values, "guided.downlinkStart", random.between(0.0, 1000.0));
    }
    if bench.real(values, "guided.downlinkReference") == 2.0 {
        // A downlink that begins at the start; else one under way there.
        bench.put(values, "guided.downlinkStart", if random.next() < 0.8 { 0.0 } else { 100.0 });
        let sizes = if random.next() < 0.6 { 0.1 } else { 1.0 };
        bench.put_vector(values, "momentum.target", &random.direction().map(|x| sizes * x));
        if random.next() < 0.6 {
            bench.put_vector(values, "start.momentum", &random.direction().map(|x| sizes * x));
            bench.put(values, "keepIn.elevation", 0.23);
        }
    }
    for k in 1..9 {
        if bench.has(&format!("panel[{k}].control")) {
            bench.put(values, &format!("panel[{k}].sunOffset"), random.between(0.1, 1.2));
            bench.put(values, &format!("panel[{k}].angle"), random.between(-3.0, 3.0));
            bench.put(values, &format!("panel[{k}].sunOffsetCommand"), random.between(0.1, 1.2));
        }
        if bench.has(&format!("wheel[{k}].capacity")) {
            bench.put(values, &format!("wheel[{k}].capacity"), random.between(0.1, 3.0));
        }
    }
    keep_science(bench, values);
    let is_flown = is_flown(bench, values);
    plant_dynamics::redraw(bench, random, is_flown, values);
}

/// Takes cells of light for flights instead of those for starts.
fn as_flown(bench: &Plant, values: &mut Tables) {
    let usual = bench.defaults();
    bench.copy(values, &usual, |name| name == "solver.disturbanceTolerance");
    bench.put(values, "solver.disturbanceStep", SHORT_S);
}

/// Ends downlinks that serve a strategy before the next begins.
fn keep_science(bench: &Plant, values: &mut Tables) {
    if bench.real(values, "momentum.strategy") < 1.5 || bench.real(values, "guided.downlinkReference") == 2.0
    {
        return;
    }
    let vector =
        |name: &str| nalgebra::Vector3::from([1, 2, 3].map(|i| bench.real(values, &format!("{name}[{i}]"))));
    let gm_m3_s2 = 2.2e13;
    let semi_major_axis_m = if bench.real(values, "orbit.source") < 1.5 {
        bench.real(values, "orbit.semiMajorAxis")
    } else {
        let radius_m = vector("orbit.position").norm();
        1.0 / (2.0 / radius_m - vector("orbit.velocity").norm_squared() / gm_m3_s2)
    };
    let period_s = std::f64::consts::TAU * (semi_major_axis_m.powi(3) / gm_m3_s2).sqrt();
    let [start_s, end_s] =
        ["guided.downlinkStart", "guided.downlinkEnd"].map(|name| bench.real(values, name));
    if end_s - start_s > 0.8 * period_s {
        bench.put(values, "guided.downlinkEnd", start_s + 0.8 * period_s);
    }
}

/// Puts Sun or spacecraft so that the planet hides part of the Sun at the start.
fn eclipse(bench: &Plant, random: &mut RandomNumbers, values: &mut Tables) -> Option<()> {
    let seen = bench.initialize(values, 0.0)?.values;
    let vector =
        |name: &str| nalgebra::Vector3::from([1, 2, 3].map(|i| bench.real(&seen, &format!("{name}[{i}]"))));
    let position = vector("position");
    let sun = position - vector("heliocentric.position");
    let radius_m = bench.real(values, "planet.radius");
    let aside = sun.cross(&nalgebra::Vector3::from(random.direction())).normalize();
    // The Sun's radius is 7e8 m.
    let edge =
        |height_m: f64, distance_m: f64, share: f64| (radius_m / height_m).asin() + share * 7e8 / distance_m;
    let share = random.between(-0.95, 0.95);
    if bench.real(values, "orbit.source") == 2.0 {
        let angle = edge(5e6, sun.norm(), share);
        let place = (aside * angle.sin() - sun.normalize() * angle.cos()) * 5e6;
        bench.put_vector(values, "orbit.position", place.as_slice());
    } else {
        bench.put(values, "ephemeris.source", 3.0);
        let angle = edge(position.norm(), 6e10, share);
        let aside = position.cross(&nalgebra::Vector3::from(random.direction())).normalize();
        let sun = (aside * angle.sin() - position.normalize() * angle.cos()) * 6e10;
        bench.put_vector(values, "sun.position", sun.as_slice());
    }
    Some(())
}

/// The same with other thresholds of dumps and capacities of wheels.
fn limits(bench: &Plant, values: &Tables, size_n_m_s: f64) -> Tables {
    let mut other = values.clone();
    bench.put_vector(&mut other, "dump.threshold", &[size_n_m_s; 3]);
    for k in 1..9 {
        if bench.has(&format!("wheel[{k}].capacity")) {
            bench.put(&mut other, &format!("wheel[{k}].capacity"), size_n_m_s);
        }
    }
    other
}

/// Starts and flights from drawn configurations, and from where a flag is about to change.
fn measure(text: &str, rounds: usize, shapes: bool) {
    let mut bench = Plant::new(text).with_carriers(CARRIERS);
    if text != MomentumPlant::DEFAULT_SETUP {
        bench = bench.with_shown(&Plant::new(MomentumPlant::DEFAULT_SETUP));
    }
    let mut random = RandomNumbers(11);
    let mut flown = 0;
    look_at_beginnings(&mut bench, shapes);
    look_at_choices(&mut bench, shapes);
    for round in 0..rounds {
        let subject = SUBJECTS[round % SUBJECTS.len()];
        let mut values = draw(&bench, &mut random, subject, shapes);
        unset(&bench, &mut random, subject, &mut values);
        let mut others: Vec<Tables> = (0..6)
            .map(|_| {
                let mut other = values.clone();
                redraw(&bench, &mut random, subject, &mut other);
                other
            })
            .collect();
        if subject == Eclipse && eclipse(&bench, &mut random, &mut values).is_none() {
            continue;
        }
        let is_flown = is_flown(&bench, &values);
        // The number of a sample counts from zero.
        let start_s = match random.next() {
            share if share < if is_flown { 0.2 } else { 0.5 } => 0.0,
            // Not long before the next sample of guidance.
            _ if is_flown => random.whole(0, 8) + random.between(0.9, 1.0),
            _ => random.between(0.0, 9.0),
        };
        others.extend([1e-3, 100.0].map(|size_n_m_s| limits(&bench, &values, size_n_m_s)));
        let theory = bench.real(&values, "ephemeris.source") == 1.0;
        for edge in bench.edges_at_start(&values, if theory { &[] } else { &others }, start_s) {
            bench.look_at_start_edge(&edge, start_s);
        }
        if bench.initialize(&values, start_s).is_none() {
            continue;
        }
        flown += 1;
        if theory {
            look_at_places(&mut bench, &values, start_s);
            continue;
        }
        bench.look_at_start(&values, start_s);
        let mut coarse = values.clone();
        as_flown(&bench, &mut coarse);
        bench.put(&mut coarse, "solver.disturbanceStep", 600.0);
        bench.put(&mut coarse, "solver.dynamicsStep", if round % 2 == 0 { 5.0 } else { 600.0 });
        // Some come to the ground within that.
        if bench.initialize(&coarse, start_s).is_some() {
            let through_it = |name: &str| name.starts_with("solver.") || name.starts_with("start.rate");
            bench.look_at_start_by(&coarse, start_s, through_it);
        }

        as_flown(&bench, &mut values);
        let Some(mut flight) = bench.initialize(&values, start_s) else { continue };
        let step_s = if is_flown {
            plant_dynamics::step_s(&bench, &mut random, start_s, &values)
        } else {
            random.between(1.0, 300.0)
        };
        let goes_on = !is_flown || random.next() < 0.8;
        if goes_on && bench.step(&mut flight, step_s).is_none() {
            continue;
        }
        if random.next() < 0.25 {
            // A request that waits at the communication point.
            bench.put(&mut flight.values, "dump.request", 1.0);
        }
        if random.next() < 0.3 {
            // Places that were waited for, and other failures.
            let other = &others[0];
            bench.copy(&mut flight.values, other, |name| {
                let places = ["orbit.position", "orbit.velocity", "sun.position"];
                places.iter().any(|place| name.starts_with(place)) || name.ends_with(".failed")
            });
        }
        if random.next() < 0.33 {
            // A command that waits there.
            bench.put(&mut flight.values, "command.kind", random.whole(0, 3));
        }
        if !bench.goes_on(&flight) {
            continue;
        }
        bench.look_at_step(&flight);
        others.extend([1e-3, 100.0].map(|size_n_m_s| limits(&bench, &flight.values, size_n_m_s)));
        for edge in bench.edges_at_step(&flight, &others) {
            if bench.goes_on(&edge) {
                bench.look_at_step_edge(&edge);
            }
        }
        if round > 128 && round % 8 == 0 && bench.is_done() {
            break;
        }
    }
    assert!(flown > 20, "{flown} flown");
    bench.judge();
}

/// What moves places; the theory of the planets costs most and takes nothing else.
fn look_at_places(bench: &mut Plant, values: &Tables, start_s: f64) {
    let beginnings = ["start.epoch", "ephemeris.", "orbit.", "sun.", "planet."];
    bench.look_at_start_by(values, start_s, |name| beginnings.iter().any(|it| name.starts_with(it)));
}

/// What drawing hardly meets: the theory of the planets, and a flight that waits for its orbit.
fn look_at_beginnings(bench: &mut Plant, shapes: bool) {
    let random = &mut RandomNumbers(13);
    for round in 0..8 {
        let mut values = draw(bench, random, Commanded, shapes);
        as_flown(bench, &mut values);
        bench.put(&mut values, "orbit.source", (1 + round % 2) as f64);
        bench.put(&mut values, "ephemeris.source", 1.0);
        if bench.initialize(&values, 0.0).is_some() {
            look_at_places(bench, &values, 0.0);
        }
        for (name, value) in [("orbit.source", 2.0), ("orbit.center", 1.0), ("ephemeris.source", 2.0)] {
            bench.put(&mut values, name, value);
        }
        bench.put_vector(&mut values, ["orbit.position", "orbit.velocity"][round % 2], &[0.0; 3]);
        let Some(mut flight) = bench.initialize(&values, 0.0) else { continue };
        if bench.step(&mut flight, 1.0).is_some() && bench.goes_on(&flight) {
            bench.look_at_step(&flight);
        }
    }
}

/// What drawing hardly meets: the Sun's place chosen where a flight begins, and where another orbit begins with a downlink.
fn look_at_choices(bench: &mut Plant, shapes: bool) {
    let random = &mut RandomNumbers(12);
    for round in 0..48 {
        let mut values = draw(bench, random, GuidedByInputs, shapes);
        let is_small = round % 4 > 0;
        for (name, value) in [
            ("attitude.source", 1.0),
            ("orbit.center", 1.0),
            ("orbit.source", 2.0),
            ("ephemeris.source", 3.0),
            ("guided.downlinkReference", 1.0),
            ("guided.slewRate", 0.0),
            ("momentum.strategy", 2.0),
            ("momentum.targetAxes", 3.0),
            ("keepIn.elevation", 0.23),
            ("eclipse.method", 4.0),
            ("dump.requiredSpacing", 1e-3),
        ] {
            bench.put(&mut values, name, value);
        }
        for k in (1..9).filter(|k| bench.has(&format!("panel[{k}].control"))) {
            bench.put(&mut values, &format!("panel[{k}].control"), f64::from(1 + round % 3));
            bench.put(&mut values, &format!("panel[{k}].enabled"), 1.0);
        }
        let size = if is_small { 0.02 } else { 1.0 };
        bench.put_vector(&mut values, "start.momentum", &random.direction().map(|x| size * x));
        bench.put_vector(&mut values, "dump.target", &random.direction().map(|x| size * x));
        let mut at_start = values.clone();
        bench.put(&mut at_start, "guided.downlinkReference", 2.0);
        bench.put(&mut at_start, "guided.downlinkStart", 0.0);
        if round % 4 == 3 && bench.has("wheel[3].locked") {
            bench.put(&mut at_start, "attitude.source", 3.0);
            bench.put(&mut at_start, "command.source", 2.0);
            bench.put(&mut at_start, "momentum.convention", 1.0);
            // As little momentum, by the body's rate and the wheels.
            bench.put_vector(&mut at_start, "start.momentum", &[0.0; 3]);
            bench.put_vector(&mut at_start, "start.rate", &random.direction().map(|x| 3e-5 * x));
            for k in (1..9).filter(|k| bench.has(&format!("wheel[{k}].startMomentum"))) {
                bench.put(&mut at_start, &format!("wheel[{k}].startMomentum"), 0.01);
                bench.put(&mut at_start, &format!("wheel[{k}].staticImbalance"), 0.0);
            }
        }
        if bench.initialize(&at_start, 0.0).is_some() {
            bench.look_at_start(&at_start, 0.0);
        }
        let mut other = values.clone();
        redraw(bench, random, GuidedByInputs, &mut other);
        let since_s =
            |it: &Tables| Some(bench.real(&bench.initialize(it, 0.0)?.values, "orbit.timeSincePeriapsis"));
        let (Some(mut earlier_s), Some(mut later_s)) = (since_s(&values), since_s(&other)) else { continue };
        if later_s < earlier_s {
            (earlier_s, later_s) = (later_s, earlier_s);
            let orbit = values.clone();
            bench.copy(&mut values, &other, |name| name.starts_with("orbit."));
            bench.copy(&mut other, &orbit, |name| name.starts_with("orbit."));
        }
        if later_s - earlier_s < 10.0 {
            continue;
        }
        bench.put(&mut values, "guided.downlinkStart", 0.5 * (earlier_s + later_s));
        bench.put(&mut values, "guided.downlinkEnd", later_s + 9000.0);
        keep_science(bench, &mut values);
        as_flown(bench, &mut values);
        let Some(mut flight) = bench.initialize(&values, 0.0) else { continue };
        if bench.step(&mut flight, 1.0).is_none() {
            continue;
        }
        bench.copy(&mut flight.values, &other, |name| name.starts_with("orbit."));
        bench.put(&mut flight.values, "dump.request", f64::from(round / 2 % 2));
        flight.changed = true;
        if bench.goes_on(&flight) {
            bench.look_at_step(&flight);
        }
    }
}

#[test]
fn momentum_plant_shipped() {
    measure(MomentumPlant::DEFAULT_SETUP, 480, true);
}

#[test]
fn momentum_plant_per_plate() {
    measure(RADIATING, 400, false);
}

#[test]
fn momentum_plant_with_everything() {
    measure(ALL, 400, true);
}
