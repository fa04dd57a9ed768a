//! How long one evaluation of the solar force and torque takes, by number of plates.
//!
//! Prints lines `bench <name> <value> <unit>`; each value is the median of several runs.

use std::hint::black_box;
use std::time::Instant;

use nalgebra::Vector3;
use physics::math;
use physics::numerics::scalar::{Dual64, Scalar, constant_vector};
use physics::radiation::{Beam, SolarModel, TorquePolynomial};
use physics::spacecraft::{MESSENGER_TOML, Plate, Spacecraft, SunshadeModel};
use physics::toml::FileError;

const RUNS: usize = 9;
const WORK_FACES: usize = 4_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let messenger = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML)?;
    for (name, model) in
        [("8_plates_2_panels", SunshadeModel::Plates), ("cylinder_2_panels", SunshadeModel::Cylinder)]
    {
        let model = SolarModel::new(&messenger, Some(model))?;
        report(&format!("solar_{name}"), 10, |i| total::<f64>(&model, i));
        report(&format!("solar_{name}_dual"), 10, |i| total::<Dual64>(&model, i));
    }
    report("solar_panel_angles_2", 2, |i| {
        let sun = sun(i);
        messenger.panels.iter().map(|p| p.angle_for_sun_offset(&sun, p.sun_offset_rad, p.tilt_sign)).sum()
    });
    if let Some(shade) = &messenger.sunshade {
        let polynomial = TorquePolynomial::of_sunshade(shade, SunshadeModel::Plates, &[], &Vector3::zeros())?;
        report("solar_polynomial", 1, |i| {
            polynomial.torque_n_m(&Beam { source_body: sun(i), pressure_pa: 5e-5 }).x
        });
    }
    for plates in [10, 65, 100, 1000, 10_000] {
        let model = SolarModel::new(&hedgehog(plates)?, None)?;
        report(&format!("solar_{plates}_plates"), plates, |i| total::<f64>(&model, i));
    }
    Ok(())
}

/// A different direction for every evaluation, all near -Y so that the Sun lights what it does in flight.
fn sun(i: usize) -> Vector3<f64> {
    let wiggle = (i % 64) as f64 / 640.0;
    Vector3::new(wiggle, -1.0, 0.1 - wiggle)
}

fn total<T: Scalar>(model: &SolarModel, i: usize) -> f64 {
    let beam = Beam { source_body: constant_vector::<T>(&sun(i)), pressure_pa: T::constant(5e-5) };
    let result = model.load(&beam, |_, panel| Some(panel.normal_body(T::constant(1.1))), &Vector3::zeros());
    result.torque_body_n_m.x.value() + result.force_body_n.y.value()
}

/// MESSENGER's front plate in many directions, half of them lit.
fn hedgehog(plates: usize) -> Result<Spacecraft, FileError> {
    let mut spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML)?;
    let pattern = spacecraft.sunshade.take().and_then(|shade| shade.plates.into_iter().next());
    spacecraft.panels.clear();
    spacecraft.plates = pattern
        .into_iter()
        .flat_map(|plate| {
            (0..plates).map(move |i| {
                // Golden-angle spiral over the sphere.
                let z = 1.0 - (2 * i + 1) as f64 / plates as f64;
                let azimuth = i as f64 * 2.399963229728653;
                let rho = (1.0 - z * z).sqrt();
                let normal = Vector3::new(rho * math::cos(azimuth), rho * math::sin(azimuth), z);
                Plate { normal, center_m: normal, ..plate.clone() }
            })
        })
        .collect();
    Ok(spacecraft)
}

fn report(name: &str, faces: usize, mut evaluate: impl FnMut(usize) -> f64) {
    let repeats = WORK_FACES / faces;
    let mut runs: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            let sum: f64 = (0..repeats).map(|i| evaluate(black_box(i))).sum();
            black_box(sum);
            start.elapsed().as_secs_f64() * 1e9 / repeats as f64
        })
        .collect();
    runs.sort_by(f64::total_cmp);
    let median_ns = runs[RUNS / 2];
    println!("bench {name} {median_ns:.1} ns");
    println!("bench {name}_rate {:.3e} 1/s", 1e9 / median_ns);
}
