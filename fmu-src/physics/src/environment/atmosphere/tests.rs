//! Against the seventeen published cases, and the exponential by hand.
use nrlmsise00::{Input, MagneticActivity, Model, Switches};

use super::nrlmsise::air_of;
use super::portable::Portable;
use super::*;
use crate::environment::dates;
use crate::environment::geodetic::Geodetic;

/// A published case: its number; day, seconds, height in km, latitude, longitude, local time in h, mean flux, flux, Ap; whether by the
/// history of Ap, 100 throughout; He, O, N2, O2, Ar in 1/cm3, mass in g/cm3, H, N, anomalous O in 1/cm3; temperature in K.
type PublishedCase = (i32, [f64; 9], bool, [f64; 9], f64);

/// The test cases that the model's authors distribute with it.
#[rustfmt::skip]
const PUBLISHED: [PublishedCase; 17] = [
    (0, [172.0, 29000.0, 400.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [6.665177e+05, 1.138806e+08, 1.998211e+07, 4.022764e+05, 3.557465e+03, 4.074714e-15, 3.475312e+04, 4.095913e+06, 2.667273e+04], 1.241416e+03),
    (1, [81.0, 29000.0, 400.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [3.407293e+06, 1.586333e+08, 1.391117e+07, 3.262560e+05, 1.559618e+03, 5.001846e-15, 4.854208e+04, 4.380967e+06, 6.956682e+03], 1.161710e+03),
    (2, [172.0, 75000.0, 1000.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [1.123767e+05, 6.934130e+04, 4.247105e+01, 1.322750e-01, 2.618848e-05, 2.756772e-18, 2.016750e+04, 5.741256e+03, 2.374394e+04], 1.239891e+03),
    (3, [172.0, 29000.0, 100.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [5.411554e+07, 1.918893e+11, 6.115826e+12, 1.225201e+12, 6.023212e+10, 3.584426e-10, 1.059880e+07, 2.615737e+05, 2.819879e-42], 2.068878e+02),
    (4, [172.0, 29000.0, 400.0, 0.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [1.851122e+06, 1.476555e+08, 1.579356e+07, 2.633795e+05, 1.588781e+03, 4.809630e-15, 5.816167e+04, 5.478984e+06, 1.264446e+03], 1.208135e+03),
    (5, [172.0, 29000.0, 400.0, 60.0, 0.0, 16.0, 150.0, 150.0, 4.0], false, [8.673095e+05, 1.278862e+08, 1.822577e+07, 2.922214e+05, 2.402962e+03, 4.355866e-15, 3.686389e+04, 3.897276e+06, 2.667273e+04], 1.212712e+03),
    (6, [172.0, 29000.0, 400.0, 60.0, -70.0, 4.0, 150.0, 150.0, 4.0], false, [5.776251e+05, 6.979139e+07, 1.236814e+07, 2.492868e+05, 1.405739e+03, 2.470651e-15, 5.291986e+04, 1.069814e+06, 2.667273e+04], 1.112999e+03),
    (7, [172.0, 29000.0, 400.0, 60.0, -70.0, 16.0, 70.0, 150.0, 4.0], false, [3.740304e+05, 4.782720e+07, 5.240380e+06, 1.759875e+05, 5.501649e+02, 1.571889e-15, 8.896776e+04, 1.979741e+06, 9.121815e+03], 1.024848e+03),
    (8, [172.0, 29000.0, 400.0, 60.0, -70.0, 16.0, 150.0, 180.0, 4.0], false, [6.748339e+05, 1.245315e+08, 2.369010e+07, 4.911583e+05, 4.578781e+03, 4.564420e-15, 3.244595e+04, 5.370833e+06, 2.667273e+04], 1.293374e+03),
    (9, [172.0, 29000.0, 400.0, 60.0, -70.0, 16.0, 150.0, 150.0, 40.0], false, [5.528601e+05, 1.198041e+08, 3.495798e+07, 9.339618e+05, 1.096255e+04, 4.974543e-15, 2.686428e+04, 4.889974e+06, 2.805445e+04], 1.347389e+03),
    (10, [172.0, 29000.0, 0.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [1.375488e+14, 0.000000e+00, 2.049687e+19, 5.498695e+18, 2.451733e+17, 1.261066e-03, 0.000000e+00, 0.000000e+00, 0.000000e+00], 2.814648e+02),
    (11, [172.0, 29000.0, 10.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [4.427443e+13, 0.000000e+00, 6.597567e+18, 1.769929e+18, 7.891680e+16, 4.059139e-04, 0.000000e+00, 0.000000e+00, 0.000000e+00], 2.274180e+02),
    (12, [172.0, 29000.0, 30.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [2.127829e+12, 0.000000e+00, 3.170791e+17, 8.506280e+16, 3.792741e+15, 1.950822e-05, 0.000000e+00, 0.000000e+00, 0.000000e+00], 2.374389e+02),
    (13, [172.0, 29000.0, 50.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [1.412184e+11, 0.000000e+00, 2.104370e+16, 5.645392e+15, 2.517142e+14, 1.294709e-06, 0.000000e+00, 0.000000e+00, 0.000000e+00], 2.795551e+02),
    (14, [172.0, 29000.0, 70.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], false, [1.254884e+10, 0.000000e+00, 1.874533e+15, 4.923051e+14, 2.239685e+13, 1.147668e-07, 0.000000e+00, 0.000000e+00, 0.000000e+00], 2.190732e+02),
    (15, [172.0, 29000.0, 400.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], true, [5.196477e+05, 1.274494e+08, 4.850450e+07, 1.720838e+06, 2.354487e+04, 5.881940e-15, 2.500078e+04, 6.279210e+06, 2.667273e+04], 1.408608e+03),
    (16, [172.0, 29000.0, 100.0, 60.0, -70.0, 16.0, 150.0, 150.0, 4.0], true, [4.260860e+07, 1.241342e+11, 4.929562e+12, 1.048407e+12, 4.993465e+10, 2.914304e-10, 8.831229e+06, 2.252516e+05, 2.415246e-42], 1.934071e+02),
];

/// Molar masses by which the model sums, in g/mol; the place of the mass itself has none.
const MOLAR_MASSES: [f64; 9] = [4.0, 16.0, 28.0, 32.0, 40.0, 0.0, 1.0, 14.0, 16.0];

fn input<T: nrlmsise00::Scalar>(values: &[f64; 9], is_history: bool) -> Input<T> {
    let [
        day,
        seconds_of_day,
        altitude_km,
        latitude_deg,
        longitude_deg,
        local_solar_time_h,
        average,
        f107,
        ap,
    ] = values.map(T::lift);
    let _ = day;
    let magnetic = match is_history {
        true => MagneticActivity::History { ap: [T::lift(100.0); 7] },
        false => MagneticActivity::Daily { ap },
    };
    Input {
        day_of_year: values[0] as i32,
        seconds_of_day,
        altitude_km,
        latitude_deg,
        longitude_deg,
        local_solar_time_h,
        f107_average: average,
        f107,
        magnetic,
    }
}

#[test]
fn every_published_case_is_the_librarys() {
    let model = Model::with_switches(Switches::reference());
    for (case, values, is_history, published, temperature_k) in PUBLISHED {
        let found = model.gtd7::<f64>(&input(&values, is_history));
        for (found, published) in found.densities().into_iter().zip(published) {
            assert!((found - published).abs() <= 6e-7 * published, "case {case}: {found} {published}");
        }
        assert!((found.temperature / temperature_k - 1.0).abs() < 6e-7, "case {case}");
    }
}

#[test]
fn density_and_molar_mass_are_those_of_the_published_mixture() {
    for (case, values, is_history, published, temperature_k) in PUBLISHED {
        let found = air_of(&input::<Portable>(&values, is_history));
        let grams: f64 = published.iter().zip(MOLAR_MASSES).map(|(number, mass)| number * mass).sum();
        let number: f64 =
            published.iter().zip(MOLAR_MASSES).filter(|(_, mass)| *mass > 0.0).map(|(it, _)| it).sum();
        // The model's nucleon has 1.66e-24 g.
        assert!((found.density_kg_m3 / (grams * 1.66e-21) - 1.0).abs() < 1e-6, "case {case}: {found:?}");
        assert!(
            (found.molar_mass_kg_mol / (1e-3 * grams / number) - 1.0).abs() < 1e-6,
            "case {case}: {found:?}"
        );
        assert!((found.temperature_k / temperature_k - 1.0).abs() < 6e-7, "case {case}: {found:?}");
    }
}

const WEATHER: SpaceWeather = SpaceWeather { f107: 150.0, f107_average: 150.0, ap: 4.0 };

fn at(height_m: f64) -> Geodetic {
    Geodetic { latitude_rad: 60f64.to_radians(), longitude_rad: -70f64.to_radians(), height_m }
}

#[test]
fn the_first_case_is_met_at_its_place_and_time() {
    // The 172nd day, 29000 s; local time follows from both: 3.39 h, where the published case has 16 h.
    let epoch_s = dates::epoch_s("2023-06-21T08:03:20 UTC").unwrap();
    let found = AtmosphereModel::Nrlmsise00.air_at(epoch_s, &at(400e3), &WEATHER).unwrap();
    let mut values = PUBLISHED[0].1;
    values[5] = 29_000.0 / 3600.0 - 70.0 / 15.0;
    let expected = Model::new().gtd7d::<f64>(&input(&values, false)).total_mass;
    assert!((found.density_kg_m3 / expected - 1.0).abs() < 1e-9, "{found:?} {expected}");
}

#[test]
fn exponential_air_falls_to_one_eth_over_its_height() {
    let air = crate::bodies::air::EARTH;
    let model = AtmosphereModel::Exponential(air);
    let density = |height_m: f64| model.air_at(0.0, &at(height_m), &WEATHER).unwrap().density_kg_m3;
    assert!((density(400e3) - 3.725e-12).abs() < 1e-24);
    assert!((density(458_515.0) * core::f64::consts::E - 3.725e-12).abs() < 1e-24);
    assert_eq!(density(CEILING_M + 1.0), 0.0);
    let refused = model.air_at(0.0, &at(99e3), &WEATHER).unwrap_err().to_string();
    assert!(refused.contains("99000 m") && refused.contains("100 km"), "{refused}");
}

#[test]
fn density_jumps_at_a_break_and_not_beside_it() {
    // Over a tenth of a millimetre density falls by 2e-9 where it does not jump.
    let jump = |height_m: f64| {
        let over_places = [-70.0_f64, -30.0, 0.0, 40.0, 80.0].map(|latitude_deg| {
            let density = |at_m: f64| {
                let place = Geodetic { latitude_rad: latitude_deg.to_radians(), ..at(at_m) };
                AtmosphereModel::Nrlmsise00.air_at(7e8, &place, &WEATHER).unwrap().density_kg_m3
            };
            (density(height_m + 5e-5) / density(height_m - 5e-5) - 1.0).abs()
        });
        over_places.into_iter().fold(0.0, f64::max)
    };
    for height_m in [300e3, 450e3] {
        assert!(AtmosphereModel::Nrlmsise00.breaks_m().contains(&height_m));
        let [across, beside] = [jump(height_m), jump(height_m + 5e3)];
        assert!(across > 1e-6 && beside < 1e-8, "{height_m}: {across:e} {beside:e}");
    }
    assert_eq!(AtmosphereModel::Nrlmsise00.air_at(7e8, &at(CEILING_M + 1.0), &WEATHER), Ok(Air::default()));
}
