//! Numbers drawn for options that stay.

use nalgebra::Vector3;

use super::super::super::named_model::Tables;
use super::super::random::RandomNumbers;
use super::subject::{Guide, Subject};

fn unit_quaternion(random: &mut RandomNumbers) -> [f64; 4] {
    let q = [0; 4].map(|_| random.between(-0.6, 0.6));
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / norm)
}

/// Other numbers with the same options.
pub fn redraw(bench: &Guide, random: &mut RandomNumbers, subject: Subject, values: &mut Tables) {
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
