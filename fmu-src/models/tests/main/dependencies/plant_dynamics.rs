//! What controlled and free flight of MomentumPlant is drawn with: wheels, sensors, controller, command.

use models::MomentumPlant;

use super::super::named_model::Tables;
use super::bench::Bench;
use super::random::RandomNumbers;

type Plant = Bench<MomentumPlant>;

/// Puts some rotors out of balance; what is drawn anew with the same options has the same ones, so that no state between two
/// has a fast rotor out of balance.
pub fn unbalance(bench: &Plant, random: &mut RandomNumbers, values: &mut Tables) {
    for k in 1..9 {
        let name = format!("wheel[{k}].staticImbalance");
        if bench.has(&name) {
            bench.put(values, &name, if random.next() < 0.2 { 1e-3 } else { 0.0 });
        }
    }
}

/// Numbers and flags of wheels, sensors and control; `is_flown` tells whether body and wheels move by them.
pub fn redraw(bench: &Plant, random: &mut RandomNumbers, is_flown: bool, values: &mut Tables) {
    control(bench, random, values);
    sensors(bench, random, values);
    wheels(bench, random, is_flown, values);
    bench.put(values, "dump.torque", 10.0_f64.powf(random.between(-3.0, -1.0)));
    if !is_flown {
        return;
    }
    bench.put_vector(values, "start.momentum", &[0.0; 3]);
    let rate_rad_s = random.between(1e-3, 1e-2);
    bench.put_vector(values, "start.rate", &random.direction().map(|x| rate_rad_s * x));
    if random.next() < 0.4 {
        // A flight with guidance starts as guided then.
        bench.put_vector(values, "start.q", &[0.0, 0.0, 0.0, 1.0]);
    }
    match (10.0 * random.next()) as i32 {
        0 => at_rest(bench, values),
        1 => aligned(bench, values),
        2 => turning_as_commanded(bench, values),
        _ => {}
    }
}

/// Time of a step after which a sample is due, often one of guidance too.
pub fn step_s(bench: &Plant, random: &mut RandomNumbers, start_s: f64, values: &Tables) -> f64 {
    let rate_hz = bench.real(values, "control.rate");
    match (10.0 * random.next()) as i32 {
        0 => random.between(0.1, 1.0),
        1..=5 => start_s.floor() + 1.0 - start_s,
        _ => ((start_s * rate_hz).floor() + random.whole(1, 6)) / rate_hz - start_s,
    }
}

/// One of them or zero, which stands for none.
fn or_zero(random: &mut RandomNumbers, share: f64, low: f64, high: f64) -> f64 {
    let drawn = low * (high / low).powf(random.next());
    if random.next() < share { drawn } else { 0.0 }
}

fn flag(random: &mut RandomNumbers, share: f64) -> f64 {
    f64::from(u8::from(random.next() < share))
}

fn control(bench: &Plant, random: &mut RandomNumbers, values: &mut Tables) {
    bench.put(values, "control.rate", if random.next() < 0.5 { 50.0 } else { 10.0 });
    bench.put(values, "control.bandwidth", random.between(0.02, 0.2));
    bench.put(values, "control.damping", random.between(0.5, 1.2));
    for (name, share, low, high) in [
        ("control.integral", 0.7, 0.05, 0.5),
        ("control.slewRate", 0.8, 1e-3, 1e-1),
        ("control.slewAcceleration", 0.8, 1e-6, 1e-2),
        ("control.balanceTime", 0.7, 1.0, 1e3),
    ] {
        let value = or_zero(random, share, low, high);
        bench.put(values, name, value);
    }
}

fn sensors(bench: &Plant, random: &mut RandomNumbers, values: &mut Tables) {
    let noise_rad = or_zero(random, 0.6, 1e-6, 1e-2);
    bench.put_vector(values, "starTracker.noise", &[1.0, 1.5, 2.0].map(|x| noise_rad * x));
    bench.put(values, "starTracker.period", random.between(0.1, 1.0));
    bench.put(values, "starTracker.outage", or_zero(random, 0.5, 0.1, 1e3));
    bench.put(values, "starTracker.failed", flag(random, 0.3));
    bench.put(values, "gyro.noise", or_zero(random, 0.5, 1e-6, 1e-3));
    bench.put(values, "gyro.drift", or_zero(random, 0.5, 1e-6, 1e-2));
    let bias_rad_s = or_zero(random, 0.5, 1e-5, 5e-2);
    bench.put_vector(values, "gyro.bias", &random.direction().map(|x| bias_rad_s * x));
    bench.put(values, "gyro.failed", flag(random, 0.3));
    bench.put(values, "noise.seed", random.whole(0, 1000));
    for k in 1..9 {
        if bench.has(&format!("sunSensor[{k}].failed")) {
            let name = |what: &str| format!("sunSensor[{k}].{what}");
            bench.put_vector(values, &name("axis"), &random.direction());
            bench.put(values, &name("fieldOfView"), random.between(0.2, 2.0));
            bench.put(values, &name("noise"), or_zero(random, 0.7, 1e-5, 1e-2));
            bench.put(values, &name("failed"), flag(random, 0.2));
        }
    }
}

fn wheels(bench: &Plant, random: &mut RandomNumbers, is_flown: bool, values: &mut Tables) {
    let count = (1..9).filter(|k| bench.has(&format!("wheel[{k}].locked"))).count();
    let skew = random.next() < 0.7;
    for k in 1..=count {
        let name = |what: &str| format!("wheel[{k}].{what}");
        if skew {
            bench.put_vector(values, &name("axis"), &random.direction());
        }
        bench.put(values, &name("inertia"), random.between(0.005, 0.05));
        bench.put(values, &name("maxTorque"), random.between(0.005, 0.1));
        bench.put(values, &name("coulombFriction"), or_zero(random, 0.5, 1e-5, 1e-3));
        bench.put(values, &name("viscousFriction"), or_zero(random, 0.5, 1e-6, 1e-4));
        bench.put(values, &name("torqueCommand"), random.between(-0.1, 0.1));
        bench.put(values, &name("failed"), flag(random, 0.15));
        let is_locked =
            is_flown && random.next() < 0.1 && (count > 3 || bench.real(values, "attitude.source") == 4.0);
        bench.put(values, &name("locked"), f64::from(u8::from(is_locked)));
        let capacity_n_m_s = bench.real(values, &name("capacity"));
        let share = match (10.0 * random.next()) as i32 {
            _ if is_locked || !is_flown => 0.0,
            0..=2 => 1.0,
            3 => 0.0,
            _ => random.between(-1.0, 1.0),
        };
        bench.put(values, &name("startMomentum"), share * capacity_n_m_s);
        if bench.real(values, &name("staticImbalance")) > 0.0 {
            // Slow, as a fast rotor out of balance makes for many short segments.
            bench.put(values, &name("startMomentum"), if is_locked { 0.0 } else { 0.002 * capacity_n_m_s });
            bench.put(values, &name("maxTorque"), 1e-4);
            bench.put(values, &name("staticImbalance"), random.between(1e-4, 1e-3));
        }
        bench.put_vector(values, &name("position"), &random.direction());
    }
}

/// Without momentum, which a dump to zero leaves as it is.
fn at_rest(bench: &Plant, values: &mut Tables) {
    bench.put_vector(values, "start.rate", &[0.0; 3]);
    bench.put_vector(values, "dump.target", &[0.0; 3]);
    for k in 1..9 {
        if bench.has(&format!("wheel[{k}].startMomentum")) {
            bench.put(values, &format!("wheel[{k}].startMomentum"), 0.0);
        }
    }
}

/// Where the command wants it.
fn aligned(bench: &Plant, values: &mut Tables) {
    bench.put(values, "command.source", 1.0);
    bench.put(values, "command.kind", 1.0);
    bench.put_vector(values, "command.q", &[0.1, 0.2, -0.3, 0.9]);
    bench.put_vector(values, "start.q", &[0.1, 0.2, -0.3, 0.9]);
    bench.put_vector(values, "start.rate", &[0.0; 3]);
    bench.put_vector(values, "command.rate", &[0.0; 3]);
}

/// At the rate that is commanded alone.
fn turning_as_commanded(bench: &Plant, values: &mut Tables) {
    bench.put(values, "command.source", 1.0);
    bench.put(values, "command.kind", 3.0);
    let rate_rad_s = [1e-3, -2e-3, 5e-4];
    bench.put_vector(values, "start.rate", &rate_rad_s);
    bench.put_vector(values, "command.rate", &rate_rad_s);
}
