//! A spinner's file may leave out what has a sensible value, and that value is what the field's formulas give.

use crate::constants::ASTRONOMICAL_UNIT_M;
use crate::spin::spinner::Spinner;

const LEAST: &str = r#"
name = "Least"
[mass_properties]
spin_inertia_kg_m2 = [90.0, 100.0]
inertia_ratio = [1.3, 1.3]
propellant_kg = [0.0, 20.0]
dry_mass_kg = 200.0
[thrusters]
resolution_s = 0.05
specific_impulse_s = 215.0
[[thruster]]
name = "R"
force_n = 1.0
position_m = [0.5, 0.0, 0.4]
direction = [-1.0, 0.0, 0.0]
[limits]
sun_angle_deg = 30.0
earth_angle_deg = 5.0
spin_rate_rpm = 10.0
spin_rate_tolerance_rpm = 0.5
period_variation_s = 0.01
"#;

#[test]
fn what_has_a_sensible_value_may_be_left_out() {
    let spinner = Spinner::parse("least.toml", LEAST).unwrap();
    assert_eq!(spinner.damper_time_constant_s, 0.0);
    assert_eq!(spinner.mass_properties.initial_propellant_kg, 20.0);
    assert_eq!(spinner.mass_properties.moments_kg_m2(20.0), [100.0 / 1.3, 100.0 / 1.3, 100.0]);
    assert_eq!((spinner.star_tracker.noise_deg, spinner.sun_sensor.noise_deg), (0.0, 0.0));
    assert_eq!((spinner.star_tracker.azimuth_deg, spinner.sun_sensor.azimuth_deg), (90.0, 0.0));
    // One key of a table is enough, and it counts.
    let own =
        format!("{LEAST}[sun_sensor]\nazimuth_deg = 30.0\n[l1_orbit]\namplitude_m = [1.0e8, 2.0e8, 0.0]\n");
    let own = Spinner::parse("own.toml", &own).unwrap();
    assert_eq!((own.sun_sensor.azimuth_deg, own.sun_sensor.sectors), (30.0, spinner.sun_sensor.sectors));
    assert_eq!(own.l1_orbit.amplitude_m, [1.0e8, 2.0e8, 0.0]);
    assert_eq!(own.l1_orbit.earth_l1_distance_m, spinner.l1_orbit.earth_l1_distance_m);
    // What is there is checked as before.
    let wrong = format!("{LEAST}[star_tracker]\npickets = 7\nnoise = 1\n");
    let text = Spinner::parse("wrong.toml", &wrong).unwrap_err().to_string();
    assert!(text.contains("star_tracker.pickets") && text.contains("noise_deg"), "{text}");
}

/// Euler's quintic for the collinear point, and the linear theory about it.
#[test]
fn the_orbit_left_out_is_the_point_of_euler_and_lagrange() {
    let orbit = Spinner::parse("least.toml", LEAST).unwrap().l1_orbit;
    // Mass of Earth and Moon as a share of the whole (IAU 2009: the Sun's is 328 900.56 times theirs).
    let mu = 1.0 / 328_901.56;
    let g = orbit.earth_l1_distance_m / ASTRONOMICAL_UNIT_M;
    let quintic = |g: f64| {
        g.powi(5) - (3.0 - mu) * g.powi(4) + (3.0 - 2.0 * mu) * g.powi(3) - mu * g * g + 2.0 * mu * g - mu
    };
    assert!(quintic(g - 2e-7) < 0.0 && quintic(g + 2e-7) > 0.0, "{g}");
    let c2 = (mu + (1.0 - mu) * (g / (1.0 - g)).powi(3)) / g.powi(3);
    let in_plane = (0.5 * (2.0 - c2 + (9.0 * c2 * c2 - 8.0 * c2).sqrt())).sqrt();
    assert!((orbit.in_plane_frequency - in_plane).abs() < 2e-4, "{in_plane}");
    assert!((orbit.out_of_plane_frequency - c2.sqrt()).abs() < 2e-4, "{}", c2.sqrt());
    assert!((orbit.line_rate_deg_day * 365.256_363 - 360.0).abs() < 1e-9 && orbit.amplitude_m == [0.0; 3]);
    assert!((orbit.obliquity_deg - 23.439_291_1).abs() < 1e-7);
}
