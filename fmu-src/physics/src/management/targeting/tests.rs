//! The equation at the place found, a search over all places where the target is out of reach, and the linear formula's error.

use std::sync::LazyLock;

use approx::assert_relative_eq;
use nalgebra::Rotation3;

use super::*;
use crate::guidance::pointing::antenna::tests::quadrants;
use crate::radiation::{Beam, SolarModel, TorquePolynomial};
use crate::spacecraft::{MESSENGER_TOML, Panel, Spacecraft};

const PRESSURE_PA: f64 = 5.0145e-5;
const SPAN_S: f64 = 28_800.0;

fn targeting() -> Targeting<'static> {
    static QUADRANTS: LazyLock<Antennas> = LazyLock::new(quadrants);
    Targeting {
        axes: TargetAxes::Xz,
        method: TargetingMethod::Exact,
        limits: KeepInLimits {
            azimuth_rad: 15.0 * crate::constants::DEG_RAD,
            elevation_rad: 13.0 * crate::constants::DEG_RAD,
        },
        antennas: &QUADRANTS,
    }
}

struct TestSpacecraft {
    spacecraft: Spacecraft,
    solar: SolarModel,
    center_of_mass_m: Vector3<f64>,
}

impl TestSpacecraft {
    fn new(center_of_mass_m: Vector3<f64>, shade_turn_rad: f64) -> Self {
        let mut spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        if let Some(shade) = &mut spacecraft.sunshade {
            let turn = Rotation3::from_euler_angles(0.3 * shade_turn_rad, shade_turn_rad, 0.0);
            shade.dcm_body_from_shade = *turn.matrix();
        }
        let solar = SolarModel::new(&spacecraft, None).unwrap();
        Self { spacecraft, solar, center_of_mass_m }
    }

    fn torque(&self, sun_body: &Vector3<f64>) -> Vector3<f64> {
        let beam = Beam { source_body: *sun_body, pressure_pa: PRESSURE_PA };
        let normal_body = |_: usize, panel: &Panel| {
            Some(panel.normal_for_sun_offset(sun_body, [1.1_f64.cos(), 1.1_f64.sin()], 1.0))
        };
        self.solar.load(&beam, normal_body, &self.center_of_mass_m).torque_body_n_m
    }

    fn linear(&self) -> LinearTorque {
        let shade = self.spacecraft.sunshade.as_ref().unwrap();
        let polynomial =
            TorquePolynomial::of_sunshade(shade, shade.model, &[], &self.center_of_mass_m).unwrap();
        LinearTorque::new(&polynomial, shade.dcm_body_from_shade)
    }
}

fn earth(separation_deg: f64) -> Vector3<f64> {
    let angle_rad = separation_deg.to_radians();
    Vector3::new(0.2 * angle_rad.sin(), angle_rad.cos(), -(0.96_f64).sqrt() * angle_rad.sin())
}

/// The body frame of a place typed anew: rows of the body axes from Sun and Earth.
fn body_from_inertial(
    to_sun: &Vector3<f64>,
    to_earth: &Vector3<f64>,
    place: &DownlinkSunDirection,
) -> Rotation3<f64> {
    let separation_rad = to_sun.angle(to_earth);
    let SunAngles { azimuth_rad, elevation_rad } = place.angles;
    let delta_rad = (separation_rad.cos() / elevation_rad.cos()).acos();
    let earth_rad = if place.earth_ahead { azimuth_rad + delta_rad } else { azimuth_rad - delta_rad };
    let sun_body = direction_from_angles(place.angles);
    let earth_body = Vector3::new(earth_rad.sin(), -earth_rad.cos(), 0.0);
    let triad = |a: &Vector3<f64>, b: &Vector3<f64>| {
        let normal = a.cross(b).normalize();
        nalgebra::Matrix3::from_columns(&[*a, normal, a.cross(&normal)])
    };
    Rotation3::from_matrix_unchecked(triad(&sun_body, &earth_body) * triad(to_sun, to_earth).transpose())
}

fn aims() -> Vec<(f64, StartMomentum)> {
    let separations = [25.0, 60.0, 85.0, 95.0, 130.0, 160.0];
    let momenta = [Vector3::new(0.3, 0.1, -0.2), Vector3::new(-0.8, 0.3, 0.4), Vector3::zeros()];
    let both = |momentum| [StartMomentum::Inertial(momentum), StartMomentum::Body(momentum)];
    separations
        .into_iter()
        .flat_map(|degrees| momenta.into_iter().flat_map(both).map(move |it| (degrees, it)))
        .collect()
}

#[test]
fn an_attainable_target_is_hit_to_rounding() {
    let mut reached = [0; 3];
    for turn_rad in [0.0, 0.05] {
        let test_spacecraft = TestSpacecraft::new(Vector3::new(0.01, -0.01, 0.02), turn_rad);
        let torque = |sun: &Vector3<f64>| test_spacecraft.torque(sun);
        for (degrees, momentum) in aims() {
            let (to_sun, to_earth) = (Vector3::y(), earth(degrees));
            let linear = Some(test_spacecraft.linear());
            let state = DownlinkState {
                to_sun,
                to_earth,
                separations_rad: [angle_between_rad(&to_sun, &to_earth); 2],
                momentum,
                span_s: SPAN_S,
                torque_body_n_m: &torque,
                pressure_pa: PRESSURE_PA,
                linear,
                science: None,
            };
            for (axes, count) in [(TargetAxes::X, 0), (TargetAxes::Z, 1), (TargetAxes::Xz, 2)] {
                let targeting = Targeting { axes, ..targeting() };
                let target = Vector3::new(-0.05, 7.0, 0.1);
                let Some(SelectedSunDirection { place, clamped }) = targeting.sun_direction(&state, &target)
                else {
                    panic!("{degrees} {momentum:?}")
                };
                if clamped {
                    continue;
                }
                reached[count] += 1;
                let body = body_from_inertial(&to_sun, &to_earth, &place);
                let start = match momentum {
                    StartMomentum::Inertial(momentum) => body * momentum,
                    StartMomentum::Body(momentum) => momentum,
                };
                let end = start + test_spacecraft.torque(&(body * to_sun)) * SPAN_S;
                for (component, requested) in [(0, axes.requested()[0]), (2, axes.requested()[1])] {
                    if requested {
                        assert_relative_eq!(end[component], target[component], epsilon = 1e-11);
                    }
                }
                assert!(place.angles.azimuth_rad.abs() <= targeting.limits.azimuth_rad);
                assert!(place.angles.elevation_rad.abs() <= targeting.limits.elevation_rad);
                let earth_rad = SunAngles::from_direction(&(body * to_earth)).azimuth_rad.to_degrees();
                assert!(
                    (-90.0 - 1e-9..=1e-9).contains(&earth_rad) || earth_rad >= 90.0 - 1e-9,
                    "{earth_rad}"
                );
            }
        }
    }
    assert!(reached.iter().all(|count| *count > 20), "{reached:?}");
}

#[test]
fn no_admissible_place_comes_nearer_to_a_target_out_of_reach() {
    let test_spacecraft = TestSpacecraft::new(Vector3::new(0.0, 0.0, 0.05), 0.0);
    let torque = |sun: &Vector3<f64>| test_spacecraft.torque(sun);
    let mut clamped = 0;
    for (degrees, momentum) in aims() {
        let (to_sun, to_earth) = (Vector3::y(), earth(degrees));
        let state = DownlinkState {
            to_sun,
            to_earth,
            separations_rad: [angle_between_rad(&to_sun, &to_earth); 2],
            momentum,
            span_s: SPAN_S,
            torque_body_n_m: &torque,
            pressure_pa: PRESSURE_PA,
            linear: None,
            science: None,
        };
        for target in
            [Vector3::new(5.0, 0.0, 3.0), Vector3::new(-4.0, 0.0, 0.1), Vector3::new(0.0, 0.0, -6.0)]
        {
            let found = targeting().sun_direction(&state, &target).unwrap();
            clamped += i32::from(found.clamped);
            let best = state.left(&found.place, &target).xz().norm();
            for branch in targeting().branches(state.separation_rad()).unwrap().iter().flatten() {
                for i in -40..=40 {
                    for j in -40..=40 {
                        let angles = SunAngles {
                            azimuth_rad: targeting().limits.azimuth_rad * f64::from(i) / 40.0,
                            elevation_rad: targeting().limits.elevation_rad * f64::from(j) / 40.0,
                        };
                        let Some(place) = branch.place(angles) else { continue };
                        let other = state.left(&place, &target).xz().norm();
                        assert!(other > best - 1e-6, "{degrees} {momentum:?} {target:?}: {other} {best}");
                    }
                }
            }
        }
    }
    assert!(clamped > 90, "{clamped}");
}

#[test]
fn the_linear_formula_falls_short_by_a_few_per_cent() {
    let test_spacecraft = TestSpacecraft::new(Vector3::new(0.0, 0.0, 0.0), 0.0);
    let shade = |sun: &Vector3<f64>| {
        let beam = Beam { source_body: *sun, pressure_pa: PRESSURE_PA };
        test_spacecraft.solar.load(&beam, |_, _| None, &test_spacecraft.center_of_mass_m).torque_body_n_m
    };
    let (to_sun, to_earth) = (Vector3::y(), earth(60.0));
    let linear = Some(test_spacecraft.linear());
    let momentum = StartMomentum::Body(Vector3::zeros());
    let state = DownlinkState {
        to_sun,
        to_earth,
        separations_rad: [angle_between_rad(&to_sun, &to_earth); 2],
        momentum,
        span_s: SPAN_S,
        torque_body_n_m: &shade,
        pressure_pa: PRESSURE_PA,
        linear,
        science: None,
    };
    let by = |method, target: &Vector3<f64>| {
        let targeting = Targeting { method, ..targeting() };
        targeting.sun_direction(&state, target).unwrap()
    };
    let mut worst = 0.0_f64;
    for share in [-0.9, -0.4, 0.3, 0.9] {
        let target = Vector3::new(0.6 * share, 0.0, -0.3 * share);
        let (exact, linear) = (by(TargetingMethod::Exact, &target), by(TargetingMethod::Linear, &target));
        assert!(state.left(&exact.place, &target).xz().norm() < 1e-11);
        worst = worst.max(state.left(&linear.place, &target).xz().norm() / target.xz().norm());
    }
    // The notes say up to 8 % inside the zone.
    assert!((0.002..0.08).contains(&worst), "{worst}");
}

#[test]
fn without_a_plane_of_sun_and_earth_there_is_no_place() {
    let none = |_: &Vector3<f64>| Vector3::zeros();
    for to_earth in [Vector3::y(), -Vector3::y()] {
        let momentum = StartMomentum::Body(Vector3::x());
        let state = DownlinkState {
            to_sun: Vector3::y(),
            to_earth,
            separations_rad: [angle_between_rad(&Vector3::y(), &to_earth); 2],
            momentum,
            span_s: SPAN_S,
            torque_body_n_m: &none,
            pressure_pa: PRESSURE_PA,
            linear: None,
            science: None,
        };
        assert_eq!(targeting().sun_direction(&state, &Vector3::zeros()), None);
    }
}
