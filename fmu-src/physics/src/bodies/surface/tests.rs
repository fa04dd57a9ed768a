//! The planet radiates what it absorbs, and impossible planets are refused by name.

use approx::assert_relative_eq;

use super::*;

fn mercury(day_temperature: DayTemperature) -> PlanetSurface {
    PlanetSurface { day_temperature, ..MERCURY }
}

/// Power through the day hemisphere by rings of equal zenith angle, per pi R2.
fn day_power_w_m2(surface: &PlanetSurface, flux_w_m2: f64) -> f64 {
    let exitance = surface.exitance(flux_w_m2);
    let n = 20_000;
    let ring = |i: i32| exitance.infrared_w_m2((f64::from(i) + 0.5) / f64::from(n)) * 2.0 / f64::from(n);
    (0..n).map(ring).sum()
}

#[test]
fn the_day_side_radiates_what_the_disc_absorbs() {
    let flux_w_m2 = 9000.0;
    let absorbed = 0.88 * flux_w_m2;
    let uniform = mercury(DayTemperature::Uniform);
    assert_relative_eq!(day_power_w_m2(&uniform, flux_w_m2), absorbed, max_relative = 1e-12);
    // The cosine profile adds the night's heat, which comes from inside, half of it on average.
    let cosine = mercury(DayTemperature::Cosine);
    let expected = absorbed + cosine.night_exitance_w_m2();
    assert_relative_eq!(day_power_w_m2(&cosine, flux_w_m2), expected, max_relative = 1e-12);
}

#[test]
fn temperatures_are_mercurys() {
    let flux_w_m2 = 1365.0 / (0.387_f64 * 0.387);
    // Eq 32: the temperature whose black body gives off the exitance at cos z.
    let day_temperature_k = |day_temperature, cos_zenith: f64| {
        let surface = mercury(day_temperature);
        let exitance = surface.exitance(flux_w_m2);
        let infrared_w_m2 = exitance.day_constant_w_m2 + exitance.day_cosine_w_m2 * cos_zenith;
        (infrared_w_m2 / (surface.emissivity * STEFAN_BOLTZMANN_W_M2_K4)).powf(0.25)
    };
    let uniform = day_temperature_k(DayTemperature::Uniform, 0.5);
    assert!((500.0..560.0).contains(&uniform), "{uniform}");
    let subsolar = day_temperature_k(DayTemperature::Cosine, 1.0);
    assert_relative_eq!(subsolar / uniform, 2_f64.powf(0.25), max_relative = 1e-12);
    let edge = day_temperature_k(DayTemperature::Cosine, 0.0);
    assert_relative_eq!(edge, 100.0, max_relative = 1e-12);
}

#[test]
fn impossible_surfaces_are_refused_by_name() {
    let good = mercury(DayTemperature::Uniform);
    assert_eq!(good.validate(), Ok(()));
    let name = |surface: PlanetSurface| {
        let refusal = surface.validate().unwrap_err();
        refusal.found.split('`').nth(1).unwrap().to_owned()
    };
    assert_eq!(name(PlanetSurface { radius_m: 0.0, ..good }), "radius");
    assert_eq!(name(PlanetSurface { emissivity: f64::NAN, ..good }), "emissivity");
    assert_eq!(name(PlanetSurface { emissivity: 0.0, ..good }), "emissivity");
    assert_eq!(name(PlanetSurface { night_temperature_k: -1.0, ..good }), "nightTemperature");
    let sum = PlanetSurface { diffuse_reflectivity: 0.2, ..good };
    assert_eq!(name(sum), "absorptivity + diffuseReflectivity");
}
