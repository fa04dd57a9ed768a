//! Guidance: every scenario, option, scan, mode and constraint drawn at random, and geometry that leaves something open.

mod geometry;
mod numbers;
mod options;
mod subject;

use fmi_export::Model;
use models::Guidance;

use self::geometry::{aimed_alone, align, sun_on_aim, unset};
use self::numbers::redraw;
use self::options::draw;
use self::subject::{Guide, Subject, subjects};
use super::bench::Simulation;
use super::random::RandomNumbers;

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
    // The rate is that of what is commanded, by a scan or without.
    ("command.rate", "command.q"),
    ("command.rate", "scan.active"),
    // Every output that is judged with an attitude depends on the mode and on whether there is one.
    ("", "mode.active"),
    ("", "command.kind"),
    ("", "earth.sunSeparation"),
    ("", "constraint.hotPole"),
];

/// Ephemerides of a Sun and an Earth that stand still.
const FLOWN: &str = include_str!("../still_ephemeris.toml");

/// More than is needed until everything was seen.
const ROUNDS: usize = 1_500;

/// Changes what a flight in a mode meets next.
fn disturb(bench: &Guide, random: &mut RandomNumbers, flight: &mut Simulation<Guidance>) {
    bench.put(&mut flight.values, "mode.request", random.whole(0, 3));
    bench.put(&mut flight.values, "sun.sensedValid", random.whole(0, 1));
    bench.put(&mut flight.values, "estimate.valid", random.whole(0, 1));
}

fn measure(mut bench: Guide) {
    bench = bench.with_carriers(CARRIERS).with_schedule("ephemeris.toml", FLOWN);
    let mut random = RandomNumbers(17);
    let subjects = subjects();
    let mut flown = 0;
    look_at_scans(&mut bench, &mut RandomNumbers(18));
    look_at_late_burn(&mut bench, &mut RandomNumbers(19));
    look_at_dumps(&mut bench, &mut RandomNumbers(20));
    look_at_safe_hold(&mut bench, &mut RandomNumbers(21));
    for round in 0..ROUNDS {
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
        } else if subject != Subject::Predictive {
            // Forecasts cost most.
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
    assert!(flown > 20, "{flown} flown");
    bench.judge();
}

/// What drawing hardly meets: scans with aims that only another compatibility allows.
fn look_at_scans(bench: &mut Guide, random: &mut RandomNumbers) {
    let aims = [1.0, 4.0, 8.0, 10.0, 11.0];
    for (frame, aim) in (1..=5).flat_map(|frame| aims.map(|aim| (frame, aim))) {
        let mut values = draw(bench, random, Subject::Scan(frame));
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
}

/// What drawing hardly meets: a downlink within reach of sunlight that begins with a dump, or almost.
fn look_at_dumps(bench: &mut Guide, random: &mut RandomNumbers) {
    for round in 0..12 {
        let mut values = draw(bench, random, Subject::Momentum);
        for (name, value) in [
            ("keepIn.enabled", 0.0),
            ("hotPole.enabled", 0.0),
            ("mode.request", 0.0),
            ("estimate.valid", 1.0),
            ("pointing.scenario", 6.0),
            ("momentum.targeting", 1.0),
        ] {
            bench.put(&mut values, name, value);
        }
        bench.put_vector(&mut values, "momentum.target", &random.direction().map(|x| 0.02 * x));
        bench.put_vector(&mut values, "dump.threshold", &[0.03; 3]);
        let mut momentum_n_m_s = random.direction().map(|x| 0.02 * x);
        momentum_n_m_s[2 * (round % 2)] = 0.03 * random.between(0.99, 1.01);
        bench.put_vector(&mut values, "momentum.body", &momentum_n_m_s);
        if bench.initialize(&values, 0.0).is_some() {
            bench.look_at_start_by(&values, 0.0, |name| {
                name.starts_with("momentum.") || name.starts_with("dump.")
            });
        }
    }
}

/// What drawing hardly meets: a Sun at the edge of Safe Hold's own zone.
fn look_at_safe_hold(bench: &mut Guide, random: &mut RandomNumbers) {
    for _ in 0..24 {
        let values = draw(bench, random, Subject::Monitor);
        let mut other = values.clone();
        bench.put(&mut other, "safeHold.keepIn.elevation", 1.5);
        for edge in bench.edges_at_start(&values, &[other], 0.0) {
            bench.look_at_start_by(&edge, 0.0, |name| name.starts_with("safeHold."));
        }
    }
}

/// What drawing hardly meets: a burn that begins at once, and whose time is up before its magnitude or after.
fn look_at_late_burn(bench: &mut Guide, random: &mut RandomNumbers) {
    for acceleration_m_s2 in [0.01, 2.0] {
        let mut values = draw(bench, random, Subject::Burn);
        for (name, value) in [
            ("keepIn.enabled", 0.0),
            ("hotPole.enabled", 0.0),
            ("monitor.enabled", 0.0),
            ("mode.request", 0.0),
            ("burn.acceleration", acceleration_m_s2),
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
    }
}

#[test]
fn guidance_shipped() {
    measure(Guide::new(Guidance::DEFAULT_SETUP));
}

/// Instruments that look elsewhere.
#[test]
fn guidance_with_other_instruments() {
    let instruments = "\n[[instruments]]\nname = \"aside\"\nboresight = [0.6, 0.0, 0.8]\n\
                       [[instruments]]\nname = \"down\"\nboresight = [0.0, 0.6, 0.8]\n\
                       [[instruments]]\nname = \"sunward\"\nboresight = [0.0, -1.0, 0.0]\n";
    let bench = Guide::new(&format!("{}{instruments}", super::spacecraft::ALL));
    measure(bench.with_shown(&Guide::new(Guidance::DEFAULT_SETUP)));
}
