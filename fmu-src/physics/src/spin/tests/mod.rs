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

use nalgebra::Vector3;

use crate::attitude::{Inertia, RigidBodyState};

use super::{
    burn::BurnRequest,
    forecast::Timing,
    motion::Motion,
    nutation::Spin,
    plant::{Directions, MassSource, Sampling, Start},
    spinner::Spinner,
    train::Shape,
};

const ACE: &str = include_str!("../../../../resources/ace.toml");

fn ace() -> Spinner {
    Spinner::parse("ace.toml", ACE).unwrap()
}

/// Rotational kinetic energy, w.h / 2.
fn energy_j(state: &RigidBodyState, inertia: &Inertia) -> f64 {
    0.5 * state.rate_rad_s(inertia).dot(&state.momentum_body)
}

/// Goes on segment by segment until the present one holds `time_s`.
fn reach(motion: &mut Motion, time_s: f64) {
    while motion.segment_end_s() < time_s {
        motion.next_segment();
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
