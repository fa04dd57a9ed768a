//! Tests of the spinner against closed forms, invariants and independent methods.

mod defaults;
mod flights;
mod late;
mod motion;
mod observation;
mod products;
mod refusals;
mod rocket;
mod split;
mod steering;
mod tank;
mod theory;
mod valves;
mod work;

use nalgebra::{Matrix3, Vector3};

use crate::attitude::{Inertia, Quaternion, RigidBodyState, angle_between_rad};

use super::{
    burn_request::BurnRequest,
    damper::Damper,
    forecast::Timing,
    motion::Motion,
    nutation::Spin,
    plant::{Commands, Directions, MassSource, Plant, PulseCommand, Sampling, Start},
    series::{Anchor, BodyTorque},
    spinner::Spinner,
    train::{Pulses, Shape, Train, TrainError},
};

const ACE: &str = include_str!("../../../../resources/ace.toml");

fn ace() -> Spinner {
    Spinner::parse("ace.toml", ACE).unwrap()
}

/// Rotational kinetic energy, w.h / 2.
fn energy_j(state: &RigidBodyState, inertia: &Inertia) -> f64 {
    0.5 * state.rate_rad_s(inertia).dot(&state.momentum_body)
}

/// Continues segment by segment until the present one holds `time_s`.
fn reach(motion: &mut Motion, time_s: f64) {
    while motion.segment_end_s() < time_s {
        motion.next_segment();
    }
}

/// A flight at 0 s without commands.
fn launch(spinner: &Spinner, start: &Start) -> Plant {
    Plant::start(spinner, start, directions(), Commands::default(), 0.0).unwrap()
}

/// Thrusters, numbered from 1, that fire over whole steps.
fn firing(thrusters: &[u32]) -> Commands {
    Commands { fire: thrusters.iter().map(|k| 1 << (k - 1)).sum(), ..Commands::default() }
}

/// A pulse of thrusters numbered from 1.
fn pulses(thrusters: &[usize], delay_s: f64, on_s: f64) -> Commands {
    let mut commands = Commands { any_pulse: true, ..Commands::default() };
    for k in thrusters {
        commands.pulses[k - 1] = PulseCommand { delay_s, on_s };
    }
    commands
}

/// The paper's spinner without a damper.
fn undamped(ratio: f64) -> Start {
    Start { damper_time_constant_s: 0.0, ..paper_start(ratio) }
}

/// The paper's spinner with a burn.
fn burning(burn: BurnRequest) -> Start {
    Start { burn: Some(burn), ..paper_start(1.483) }
}

/// The inertia tensor of moments and products 12, 13, 23.
fn tensor([a, b, c]: [f64; 3], [p, q, r]: [f64; 3]) -> Matrix3<f64> {
    Matrix3::new(a, p, q, p, b, r, q, r, c)
}

/// An attitude along no axis.
fn tilted() -> Quaternion {
    Quaternion([0.1, -0.3, 0.2, 0.9]).normalized()
}

/// The motion at 0 s of a body of this tensor, which `inertia` says too.
fn started(
    inertia: &Inertia,
    body: &Matrix3<f64>,
    damper_s: f64,
    rate: Vector3<f64>,
    torque: Vector3<f64>,
) -> Motion {
    let momentum_inertial = tilted().inertial_from_body(&(body * rate));
    let anchor = Anchor { time_s: 0.0, attitude: tilted(), momentum_inertial };
    let damper = Damper::new(damper_s, inertia);
    Motion::new(*inertia, damper, BodyTorque::constant(torque), anchor, f64::INFINITY)
}

/// J w' = T - w x J w and the attitude's matrix by classical Runge-Kutta, extrapolated once.
fn runge_kutta(
    body: &Matrix3<f64>,
    rate: Vector3<f64>,
    torque: impl Fn(f64) -> Vector3<f64>,
    end_s: f64,
    steps: usize,
) -> (Vector3<f64>, Matrix3<f64>) {
    let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| tilted().inertial_from_body(&axis));
    let inverse = body.try_inverse().unwrap();
    let slope = |t: f64, w: &Vector3<f64>, m: &Matrix3<f64>| {
        (inverse * (torque(t) - w.cross(&(body * w))), m * w.cross_matrix())
    };
    let run = |steps: usize| {
        let dt = end_s / steps as f64;
        let (mut w, mut m) = (rate, Matrix3::from_columns(&columns));
        for i in 0..steps {
            let t = i as f64 * dt;
            let k1 = slope(t, &w, &m);
            let k2 = slope(t + 0.5 * dt, &(w + k1.0 * (0.5 * dt)), &(m + k1.1 * (0.5 * dt)));
            let k3 = slope(t + 0.5 * dt, &(w + k2.0 * (0.5 * dt)), &(m + k2.1 * (0.5 * dt)));
            let k4 = slope(t + dt, &(w + k3.0 * dt), &(m + k3.1 * dt));
            w += (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) * (dt / 6.0);
            m += (k1.1 + (k2.1 + k3.1) * 2.0 + k4.1) * (dt / 6.0);
        }
        (w, m)
    };
    let (coarse, fine) = (run(steps), run(2 * steps));
    (fine.0 + (fine.0 - coarse.0) / 15.0, fine.1 + (fine.1 - coarse.1) / 15.0)
}

fn assert_same_attitude(attitude: Quaternion, matrix: &Matrix3<f64>, tolerance_rad: f64) {
    for (i, axis) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().enumerate() {
        let off_rad = angle_between_rad(&attitude.inertial_from_body(axis), &matrix.column(i).into());
        assert!(off_rad < tolerance_rad, "axis {i}: {off_rad} rad");
    }
}

fn directions() -> Directions {
    let beta = 10.0_f64.to_radians();
    Directions {
        sun_inertial: Vector3::new(beta.sin(), 0.0, beta.cos()),
        earth_inertial: Vector3::new(0.0, 0.02, -1.0).normalize(),
        star_inertial: Vector3::new(0.3, 1.0, 0.02).normalize(),
    }
}

/// One uniform train of the paper's minimum pulses with thruster IIIR, opposite IVR.
fn request() -> BurnRequest {
    BurnRequest {
        shape: Shape::Uniform,
        timing: Timing::Clock,
        start_s: 0.0,
        thruster: 8,
        opposite_thruster: 10,
        group: String::new(),
        pulse_width_s: 0.032,
        turns_per_pulse: 1.0,
        count: 114,
        angle_rad: 0.0,
        resolution_s: 0.032,
        target_inertial: Vector3::new(0.8, 0.6, 0.0),
        spin_rate_error: 0.0,
        ratio_error: 0.0,
        ratio_uncertainty: 0.0,
        max_nutation_rad: 0.0,
        max_duration_s: 0.0,
    }
}

/// The paper's spinner at 5 rpm.
fn paper_spin(ratio: f64) -> Spin {
    Spin { rate_rad_s: std::f64::consts::PI / 6.0, ratio, inertia_kg_m2: 353.82 }
}

/// A train in steps of ACE's shortest pulse.
fn train(shape: Shape, count: u32, unit_width_s: f64, turns: f64, spin: &Spin) -> Result<Train, TrainError> {
    let pulses = Pulses { shape, unit_width_s, turns_per_pulse: turns, resolution_s: 0.032 };
    Train::new(&pulses, count, spin)
}

fn paper_start(ratio: f64) -> Start {
    let spin = 353.82;
    Start {
        inertia_kg_m2: [spin / ratio, spin / ratio, spin],
        products_kg_m2: [0.0; 3],
        mass_source: MassSource::Fixed,
        propellant_kg: 97.5,
        execution: Default::default(),
        spin_rate_rad_s: std::f64::consts::PI / 6.0,
        attitude: [0.0, 0.0, 0.0, 1.0],
        nutation_rad: 0.0,
        nutation_phase_rad: 0.0,
        damper_time_constant_s: 34_200.0,
        burn: None,
        l1: None,
        sampling: Sampling::Spins,
        nominal_rate_rad_s: std::f64::consts::PI / 6.0,
        seed: 1,
        work_limit: 10_000_000,
    }
}

/// Eq 8: nutation after `count` equal kicks `kick_rad`, `phase_rad` of nutation apart.
fn uniform_train_rad(kick_rad: f64, phase_rad: f64, count: u32) -> f64 {
    let half = (0.5 * phase_rad).sin();
    if half.abs() < 1e-12 {
        return kick_rad * f64::from(count);
    }
    kick_rad * ((0.5 * f64::from(count) * phase_rad).sin() / half).abs()
}

/// Bound on the final nutation of a train whose ends rise and fall by the binomial weights of `order`, whatever its
/// length: q |2 cos(phi/2)|^m / |sin(phi/2)|, with q the one-unit kick.
fn tapered_bound_rad(unit_kick_rad: f64, phase_rad: f64, order: u32) -> f64 {
    let (sine, cosine) = (0.5 * phase_rad).sin_cos();
    unit_kick_rad * (2.0 * cosine).abs().powi(order as i32) / sine.abs()
}
