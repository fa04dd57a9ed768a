//! The cell normal makes the requested angle with the Sun, on the requested side, wherever that is possible.

use approx::assert_relative_eq;
use proptest::prelude::*;

use super::*;
use crate::numerics::scalar::Dual64;
use crate::spacecraft::Optics;

fn panel() -> Panel {
    Panel {
        name: "right".to_owned(),
        area_m2: 2.5,
        center_body_m: Vector3::new(2.28, 0.0, 0.0),
        axis_body: Vector3::x(),
        zero_normal_body: -Vector3::y(),
        faces: FaceProperties::insulated(Optics::from_reflectivities(0.52, 0.07), None),
        polygon: None,
        control: PanelControl::SunOffset,
        sun_offset_rad: 65_f64.to_radians(),
        tilt_sign: 1.0,
        windmill_side: 1.0,
        angle_rad: 0.0,
        mass: None,
    }
}

#[test]
fn zero_angle_looks_along_minus_y_and_a_quarter_turn_along_minus_z() {
    assert_relative_eq!(panel().normal_body(0.0), -Vector3::y(), epsilon = 1e-15);
    assert_relative_eq!(panel().normal_body(core::f64::consts::FRAC_PI_2), -Vector3::z(), epsilon = 1e-15);
}

#[test]
fn with_the_sun_ahead_the_angle_is_the_offset_itself() {
    let sun: Vector3<f64> = -Vector3::y();
    for (offset, sign) in [(1.1, 1.0), (1.1, -1.0), (0.0, 1.0), (2.5, -1.0), (-0.7, 1.0), (-2.5, -1.0)] {
        assert_relative_eq!(panel().angle_for_sun_offset(&sun, offset, sign), offset * sign, epsilon = 1e-15);
    }
}

#[test]
fn with_the_sun_on_the_axis_the_answer_is_finite() {
    assert_eq!(panel().angle_for_sun_offset(&Vector3::<f64>::x(), 1.0, 1.0), 0.0);
    let sun = Vector3::x().map(Dual64::constant);
    assert_eq!(panel().angle_for_sun_offset(&sun, Dual64::constant(1.0), 1.0).eps, 0.0);
}

#[test]
fn the_angle_is_smooth_through_offset_zero() {
    // The Sun across the axis but for the rounding of a rotation.
    for along in [0.0, 1e-16, -3e-16] {
        let sun = Vector3::new(along, -0.8, 0.6);
        let facing = panel().angle_for_sun_offset(&sun, 0.0, 1.0);
        for sign in [1.0, -1.0] {
            for offset in [0.0, 1e-300, -1e-12, 1e-9, -1e-6, 0.02, -0.02, core::f64::consts::PI, -3.0] {
                let angle = panel().angle_for_sun_offset(&sun, offset, sign);
                assert!((angle - facing - sign * offset).abs() < 2e-15, "{along} {sign} {offset}: {angle}");
                let moving =
                    panel().angle_for_sun_offset(&sun.map(Dual64::constant), Dual64::new(offset, 1.0), sign);
                assert!((moving.eps - sign).abs() < 1e-14, "{along} {sign} {offset}: {}", moving.eps);
            }
        }
    }
}

#[test]
fn the_rate_of_the_angle_is_that_of_its_differences() {
    const H: f64 = 1e-6;
    let sun_at = |turn: f64| Vector3::new(turn.sin() * 0.4, -turn.cos(), 0.3).normalize();
    let sun_rate = (sun_at(0.7 + 1e-5) - sun_at(0.7 - 1e-5)) / 2e-5;
    for offset in [-2.9, -1.1, -0.4, 0.4, 1.1, 2.9, 0.1, -0.1] {
        let at = |step: f64| panel().angle_for_sun_offset(&sun_at(0.7 + step), offset + 0.8 * step, -1.0);
        let difference = (at(H) - at(-H)) / (2.0 * H);
        let moving = sun_at(0.7).zip_map(&sun_rate, Dual64::new);
        let rate = panel().angle_for_sun_offset(&moving, Dual64::new(offset, 0.8), -1.0).eps;
        assert!((rate - difference).abs() < 1e-7 * difference.abs() + 1e-8, "{offset}: {rate} {difference}");
    }
}

#[test]
fn the_light_on_the_cells_is_what_the_offset_was_chosen_for() {
    let sun = Vector3::new(0.1, -0.8, 0.5).normalize();
    for (suns, distance_au) in [(3.0, 0.31), (3.0, 0.5), (1.0, 0.7), (0.2, 0.99), (9.0, 0.3)] {
        let distance_m = distance_au * ASTRONOMICAL_UNIT_M;
        let offset = offset_for_suns(suns, distance_m);
        let angle = panel().angle_for_sun_offset(&sun, offset, -1.0);
        // By the inverse square of the distance and the cosine.
        let found = panel().normal_body(angle).dot(&sun) / (distance_au * distance_au);
        assert!((found - suns).abs() < 1e-12 * suns, "{suns} {distance_au}: {found}");
        assert!((light_suns(&panel().normal_body(angle), &sun, distance_m) - suns).abs() < 1e-12 * suns);
        let step_m = 1e3;
        let [before, after] = [-step_m, step_m].map(|step_m| offset_for_suns(suns, distance_m + step_m));
        let rate = offset_for_suns(suns, Dual64::new(distance_m, 1.0)).eps;
        assert!((rate - (after - before) / (2.0 * step_m)).abs() < 1e-6 * rate.abs(), "{suns} {distance_au}");
    }
    // Beyond 1 / sqrt(3) AU not even full sunlight is three suns.
    assert_eq!(offset_for_suns(3.0, Dual64::new(0.6 * ASTRONOMICAL_UNIT_M, 1.0)), Dual64::new(0.0, 0.0));
    // Cells that look away are dark.
    assert_eq!(
        light_suns(&panel().normal_body(core::f64::consts::PI), &-Vector3::y(), ASTRONOMICAL_UNIT_M),
        0.0
    );
}

proptest! {
    #[test]
    fn the_offset_is_met_or_else_is_as_near_as_it_gets(
        azimuth in -3.1..3.1_f64, z in -0.999..0.999_f64, offset in -3.1..3.1_f64, positive: bool,
    ) {
        let rho = (1.0 - z * z).sqrt();
        let sun = Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z);
        let sign = if positive { 1.0 } else { -1.0 };
        let panel = panel();
        let angle = panel.angle_for_sun_offset(&sun, offset, sign);
        let normal = panel.normal_body(angle);
        let by_sines = panel.normal_for_sun_offset(&sun, [offset.cos(), offset.sin()], sign);
        prop_assert!((by_sines - normal).norm() < 1e-14);
        let met = normal.dot(&sun).clamp(-1.0, 1.0).acos();
        // Independent of the formula: scan all angles for the least miss.
        let least = (0..7200)
            .map(|i| panel.normal_body(f64::from(i) * core::f64::consts::TAU / 7200.0))
            .map(|n| (n.dot(&sun).clamp(-1.0, 1.0).acos() - offset.abs()).abs())
            .fold(f64::INFINITY, f64::min);
        prop_assert!((met - offset.abs()).abs() <= least + 1e-7, "miss {} against {least}", met - offset.abs());
        // The requested side: the normal is the Sun-facing one turned by `sign` and the offset's sign about the axis.
        prop_assert!(sign * offset.signum() * panel.axis_body.cross(&sun).dot(&normal) >= -1e-12);
    }
}
