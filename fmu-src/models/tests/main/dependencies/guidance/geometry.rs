//! Inputs that are missing, and geometry that leaves something open.

use nalgebra::Vector3;

use super::super::super::named_model::Tables;
use super::super::random::RandomNumbers;
use super::subject::{Guide, Subject};

/// Inputs as masters send them before the first exchange.
pub fn unset(bench: &Guide, random: &mut RandomNumbers, values: &mut Tables) {
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
pub fn align(bench: &Guide, random: &mut RandomNumbers, values: &mut Tables) {
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
pub fn sun_on_aim(bench: &Guide, seen: &Tables, values: &mut Tables) {
    let vector = |name: &str| Vector3::from([1, 2, 3].map(|i| bench.real(values, &format!("{name}[{i}]"))));
    let [x, y, z, w] = [1, 2, 3, 4].map(|i| bench.real(seen, &format!("command.q[{i}]")));
    let to_inertial = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    let sun = vector("position") + to_inertial * Vector3::z() * 6e10;
    bench.put_vector(values, "sun.position", sun.as_slice());
}

/// Aims +Z without constraints at what does not depend on the Sun.
pub fn aimed_alone(bench: &Guide, random: &mut RandomNumbers, subject: Subject, values: &mut Tables) {
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
