//! SpinPlant: every option, thrusters on and off, samples and pulses at the communication point.

use fmi_export::Model;
use models::SpinPlant;

use super::super::named_model::Tables;
use super::bench::Bench;
use super::random::RandomNumbers;

type Spin = Bench<SpinPlant>;

const OPTIONS: &[(&str, i32, i32)] = &[
    ("burn.plan", 1, 4),
    ("burn.timing", 1, 3),
    ("burn.taperOrder", 1, 3),
    ("massProperties.source", 1, 2),
    ("geometry.source", 1, 2),
    ("starTracker.sampling", 1, 2),
    ("seed", 1, 9),
];

/// Limits with values that nothing exceeds.
const LIMITS: &[(&str, f64)] = &[
    ("limit.sunAngle", core::f64::consts::PI),
    ("limit.earthAngle", core::f64::consts::PI),
    ("limit.spinRateTolerance", 100.0),
    ("limit.periodVariation", 100.0),
];

fn draw(bench: &Spin, random: &mut RandomNumbers) -> Tables {
    let mut values = bench.defaults();
    for (name, low, high) in OPTIONS {
        bench.put(&mut values, name, random.whole(*low, *high));
    }
    let mut q = [0; 4].map(|_| random.between(-1.0, 1.0));
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.iter_mut().for_each(|x| *x /= norm);
    bench.put_vector(&mut values, "start.q", &q);
    bench.put(&mut values, "burn.count", random.whole(2, 12));
    bench.put(&mut values, "burn.thruster", random.whole(1, 10));
    bench.put(&mut values, "burn.angle", if random.next() < 0.5 { 0.0 } else { 0.01 });
    bench.put(&mut values, "burn.turnsPerPulse", random.whole(1, 3) / 2.0);
    bench.put(&mut values, "pulse.resolution", if random.next() < 0.5 { 0.0 } else { 0.032 });
    bench.put(&mut values, "burn.pulseWidth", 0.032 * random.whole(5, 12));
    bench.put(&mut values, "start.nutation", if random.next() < 0.5 { 0.0 } else { 0.05 });
    bench.put(&mut values, "massProperties.source", random.whole(1, 2));
    if random.next() < 0.3 {
        bench.put_text(&mut values, "burn.group", "upper radial I");
    }
    for k in 1..=10 {
        bench.put(
            &mut values,
            &format!("thruster[{k}].onDelay"),
            if random.next() < 0.5 { 0.0 } else { 0.1 },
        );
        bench.put(&mut values, &format!("thruster[{k}].onTime"), if random.next() < 0.7 { 0.0 } else { 0.2 });
        bench.put(&mut values, &format!("thruster[{k}].fire"), f64::from(u8::from(random.next() < 0.2)));
    }
    let has_ramps = random.next() < 0.5;
    let has_products = random.next() < 0.5;
    bench.put_vector(&mut values, "productsOfInertia", &[f64::from(u8::from(has_products)), 0.0, 0.0]);
    for k in 1..=10 {
        let times = if has_ramps { [0.1, 0.05, 0.04] } else { [0.0; 3] };
        for (name, time_s) in ["minOnTime", "riseTime", "tailOffTime"].iter().zip(times) {
            bench.put(&mut values, &format!("thruster[{k}].{name}"), time_s);
        }
        bench.put(&mut values, &format!("thruster[{k}].scatter"), if has_ramps { 0.02 } else { 0.0 });
    }
    redraw(bench, random, &mut values);
    values
}

/// Other numbers with the same options.
fn redraw(bench: &Spin, random: &mut RandomNumbers, values: &mut Tables) {
    for (name, size) in [("sun.direction", 1.0), ("earth.direction", 2.0), ("burn.targetDirection", 1.0)] {
        bench.put_vector(values, name, &random.direction().map(|x| size * x));
    }
    // About the tracker's field: across the momentum, or nearly.
    let q = [1, 2, 3, 4].map(|i| bench.real(values, &format!("start.q[{i}]")));
    let axis = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(q[3], q[0], q[1], q[2]))
        * nalgebra::Vector3::z();
    let across = axis.cross(&nalgebra::Vector3::from(random.direction())).normalize();
    let star = across + axis * random.between(-0.3, 0.3);
    bench.put_vector(values, "star.direction", star.as_slice());
    bench.put(values, "start.nutationPhase", random.between(0.0, 6.0));
    bench.put_vector(values, "inertia", &[220.0, 240.0 + 10.0 * random.next(), 360.0]);
    if bench.real(values, "productsOfInertia[1]") != 0.0 {
        let products = [0; 3].map(|_| random.between(-8.0, 8.0));
        bench.put_vector(values, "productsOfInertia", &products);
    }
    if bench.real(values, "thruster[1].riseTime") != 0.0 {
        // Alike for all: those of a group fire together. The shortest time is about that of the pulses from outside.
        let times = [random.between(0.17, 0.23), random.between(0.02, 0.05), random.between(0.02, 0.05)];
        for k in 1..=10 {
            for (name, time_s) in ["minOnTime", "riseTime", "tailOffTime"].iter().zip(times) {
                bench.put(values, &format!("thruster[{k}].{name}"), time_s);
            }
        }
    }
    bench.put(values, "spin.initialRate", random.between(0.4, 0.7));
    bench.put(values, "propellant.loaded", random.between(30.0, 150.0));
    for name in ["geometry.longitude", "geometry.inPlanePhase", "geometry.outOfPlanePhase"] {
        bench.put(values, name, random.between(0.0, 6.0));
    }
    bench.put(values, "burn.start", random.between(0.0, 60.0));
    if bench.real(values, "pulse.resolution") == 0.0 {
        bench.put(values, "burn.pulseWidth", random.between(0.2, 0.4));
    }
    bench.put(values, "burn.spinRateError", random.between(-0.1, 0.1));
    bench.put(values, "burn.ratioError", random.between(-0.1, 0.1));
    bench.put(values, "limit.sunAngle", random.between(0.2, 2.5));
    bench.put(values, "limit.earthAngle", random.between(0.2, 2.5));
    bench.put(values, "limit.spinRate", random.between(0.5, 0.6));
    bench.put(values, "limit.spinRateTolerance", random.between(0.01, 0.2));
    bench.put(values, "limit.periodVariation", 10.0_f64.powf(random.between(-4.0, 0.0)));
}

#[test]
fn spin_plant() {
    let texts = ["", "upper radial I", "axial couple I-IV", "IIIR"];
    let mut bench = Spin::new(SpinPlant::DEFAULT_SETUP)
        .with_carriers(&[("burn.plannedCount", "burn.plannedDuration")])
        .with_texts(&texts)
        .with_values(&[
            ("burn.turnsPerPulse", &[0.5, 1.0, 1.5, 2.0]),
            ("pulse.resolution", &[0.0, 0.016, 0.032, 0.08]),
            ("burn.oppositeThruster", &[0.0, 3.0, 8.0, 10.0]),
        ]);
    let mut random = RandomNumbers(3);
    let mut flown = 0;
    for round in 0..1000_usize {
        let start_s = [0.0, 5e4][round % 2];
        let values = draw(&bench, &mut random);
        let mut other = values.clone();
        redraw(&bench, &mut random, &mut other);
        for edge in bench.edges_at_start(&values, &[other.clone()], start_s) {
            bench.look_at_start_edge(&edge, start_s);
        }
        let Some(mut flight) = bench.initialize(&values, start_s) else { continue };
        flown += 1;
        bench.look_at_start(&values, start_s);
        bench.look_at_step(&flight);
        let length_s = [900.0, 0.05, random.between(0.5, 40.0)][round % 3];
        // A long push along the axis, without torque, over several samples of the star.
        let pushing = [[1, 4], [7, 9]][round % 2];
        if round % 3 == 0 {
            for k in 1..=10 {
                let fires = f64::from(u8::from(pushing.contains(&k)));
                bench.put(&mut flight.values, &format!("thruster[{k}].onTime"), 0.0);
                bench.put(&mut flight.values, &format!("thruster[{k}].fire"), fires);
            }
            flight.changed = true;
        }
        if bench.step(&mut flight, length_s).is_none() {
            continue;
        }
        for k in (1..=10).filter(|k| round % 3 == 0 && !pushing.contains(k)) {
            let length_s = if random.next() < 0.5 { 0.0 } else { 0.2 };
            bench.put(&mut flight.values, &format!("thruster[{k}].onTime"), length_s);
        }
        bench.look_at_step(&flight);
        // From where no limit is violated to where one is.
        let mut free = flight.clone();
        for (name, most) in LIMITS {
            bench.put(&mut free.values, name, *most);
        }
        let violated = LIMITS.iter().map(|(name, _)| {
            let mut values = free.values.clone();
            bench.put(&mut values, name, 0.0);
            values
        });
        for edge in bench.edges_at_step(&free, &violated.collect::<Vec<_>>()) {
            bench.look_at_step_edge(&edge);
        }
        for edge in bench.edges_at_step(&flight, &[other]) {
            bench.look_at_step_edge(&edge);
        }
        if round > 150 && bench.is_done() {
            break;
        }
    }
    assert!(flown > 50, "{flown} flown");
    bench.judge();
}
