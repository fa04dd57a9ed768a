//! Sunlight on a body that spins: what it adds up to, however fast.

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::Vector3;

use super::super::named_model::NamedModel;
use super::{FREE, Start, initialize};

/// A vane off the axis, with a kink in its load whenever the Sun crosses its plane.
const VANE: &str = r#"
name = "Vane"
[mass_properties]
mass_kg = 100.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[40.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 50.0]]
[optics.cloth]
specular = 0.3
diffuse = 0.2
[optics.black]
specular = 0.0
diffuse = 0.0
[[plates]]
name = "front"
area_m2 = 1.0
center_m = [2.0, 0.3, 0.5]
normal = [0.28, 0.96, 0.0]
optics = "cloth"
[[plates]]
name = "back"
area_m2 = 1.0
center_m = [2.0, 0.3, 0.5]
normal = [-0.28, -0.96, 0.0]
optics = "black"
"#;

/// Momentum and delta-v that sunlight gives within 20 s, and how far these are from those of a grid of a hundredth.
fn off_the_fine_answer(named: &NamedModel<MomentumPlant>, rate_rad_s: Vector3<f64>, light: Start<'_>) -> f64 {
    let rate = [1, 2, 3].map(|i| format!("start.rate[{i}]"));
    let rate = [0, 1, 2].map(|i| (rate[i].as_str(), rate_rad_s[i]));
    let added = |step_s: f64| {
        let step: Start<'_> = &[("solver.dynamicsStep", step_s), ("gravityGradient.enabled", 0.0)];
        let undumped: Start<'_> =
            &[("dump.threshold[1]", 1e6), ("dump.threshold[2]", 1e6), ("dump.threshold[3]", 1e6)];
        let mut flight = initialize(named, &[FREE, &rate, step, undumped, light]);
        let before = flight.vector("momentum.inertial");
        flight.simulate_to(20.0, 1.0).unwrap();
        [flight.vector("momentum.inertial") - before, flight.vector("deltaV")]
    };
    let (coarse, fine) = (added(1.0), added(1e-3));
    let off = coarse.iter().zip(&fine).map(|(a, b)| (a - b).norm() / b.norm());
    off.fold(0.0, f64::max)
}

#[test]
fn a_vane_in_sunlight_gains_the_same_momentum_at_any_spin() {
    let named = NamedModel::<MomentumPlant>::with("vane.toml", VANE);
    let rates_rpm = [0.0, 1.0, 7.0, 33.0, 0.3, 3.0, 20.0, 60.0];
    for rpm in &rates_rpm[..short_or_long(4, 8)] {
        let spin_rad_s = rpm * core::f64::consts::TAU / 60.0;
        for (body, rate_rad_s) in
            [("spins", Vector3::z() * spin_rad_s), ("tumbles", Vector3::new(0.6, 0.3, 0.742) * spin_rad_s)]
        {
            let off = off_the_fine_answer(&named, rate_rad_s, &[]);
            println!("{rpm} rpm, {body}: {off:.1e}");
            assert!(off < 1e-4, "{rpm} rpm, {body}: {off:e}");
        }
    }
}
