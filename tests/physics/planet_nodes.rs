//! How exact few quadrature nodes are: the worst over random places, attitudes, panel angles and suns.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use physics::bodies::surface::MERCURY;
use physics::loads::Effect;
use physics::radiation::disturbance::{
    DisturbanceModel, Geometry, Options, PlanetLightMethod, Recoil, Workspace,
};
use physics::spacecraft::{MESSENGER_THERMAL_TOML, Spacecraft};

/// Knuth's generator.
struct RandomNumbers(u64);

impl RandomNumbers {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> Vector3<f64> {
        let (z, azimuth) = (2.0 * self.unit() - 1.0, TAU * self.unit());
        let rho = (1.0 - z * z).sqrt();
        Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z)
    }
}

/// Worst error of albedo and infrared together on the cells of paper 004, as a share of their force, with 5 and with 6
/// nodes, from `lowest` radii up; the sum is what a user sees.
fn worst(lowest: f64) -> [f64; 2] {
    let spacecraft = Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML).unwrap();
    let model = |nodes| {
        let planet_light = PlanetLightMethod::Rings(nodes);
        let options = Options { planet: Some(MERCURY), planet_light, ..Options::default() };
        DisturbanceModel::new(&spacecraft, &options).unwrap()
    };
    let (few, fine) = ([model(5), model(6)], model(48));
    let mut workspace = Workspace::default();
    let mut random = RandomNumbers(1);
    let mut worst = [0.0_f64; 2];
    for _ in 0..20_000 {
        let height = random.unit();
        let planet_m = random.direction() * (MERCURY.radius_m * (lowest + 7.0 * height * height));
        let sun_m = random.direction() * 5.8e10;
        let angles_rad = [random.unit() * TAU, random.unit() * TAU];
        let geometry =
            Geometry::at(1365.0, &sun_m, Some(&planet_m), 1.0, &angles_rad, Vector3::zeros()).unwrap();
        let mut force_n = |model: &DisturbanceModel| {
            let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
            found[Effect::Albedo].force_body_n + found[Effect::Infrared].force_body_n
        };
        let exact_n = force_n(&fine);
        for (worst, model) in worst.iter_mut().zip(&few) {
            *worst = worst.max((force_n(model) - exact_n).norm() / exact_n.norm());
        }
    }
    println!("worst of 20,000 from {lowest} radii up: {worst:?}");
    worst
}

#[test]
fn five_and_six_nodes_are_as_exact_as_stated() {
    // Paper 004's orbit comes down to 1.08 radii, 206 km above Mercury.
    let [five, six] = worst(1.08);
    assert!((4e-5..6e-5).contains(&five), "5 nodes: {five:e}");
    assert!((1e-5..1.5e-5).contains(&six), "6 nodes: {six:e}");
    let [five, six] = worst(1.02);
    assert!((1e-4..2e-4).contains(&five), "5 nodes, low: {five:e}");
    assert!((1e-5..2e-5).contains(&six), "6 nodes, low: {six:e}");
}
