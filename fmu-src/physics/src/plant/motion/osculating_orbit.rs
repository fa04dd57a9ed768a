//! Osculating orbit: the Keplerian orbit that has the present position and velocity, and the Sun's elevation over its plane.

use nalgebra::{Matrix3, Vector3};

use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::environment::orbit::{Elements, period_s};
use crate::math;
use crate::plant::settings::configuration::{Configuration, Motion};

/// Orbit that osculates at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OsculatingOrbit {
    /// In the frame of the orbit's elements; angles without a meaning are 0.
    pub elements: Elements,
    /// Period, in s; 0 on a hyperbola, as in CSPICE's `oscltx`.
    pub period_s: f64,
    /// Height of periapsis over the body's radius, in m.
    pub periapsis_height_m: f64,
    /// Height of apoapsis, in m; 0 on a hyperbola.
    pub apoapsis_height_m: f64,
    /// Elevation of the Sun, seen from the spacecraft, over the orbit's plane, positive on the side of the angular momentum, in rad.
    pub sun_elevation_rad: f64,
}

impl OsculatingOrbit {
    /// Orbit through `state` from `body`, EME2000, the Sun being `to_sun_m` from the spacecraft; `None` on a line through the body, without
    /// gravity, and where a number would not be finite.
    pub(crate) fn new(
        configuration: &Configuration,
        body: Body,
        state: &CartesianState,
        to_sun_m: &Vector3<f64>,
    ) -> Option<Self> {
        let [gm_m3_s2, radius_m] = match configuration.motion {
            Motion::NBody { gravity, .. } => [gravity.model.gm_m3_s2(body), gravity.model.radius_m(body)],
            Motion::TwoBody | Motion::Disturbed { .. } | Motion::Held { .. } => {
                [configuration.orbit.mu_m3_s2(), configuration.center_radius_m]
            }
        };
        let to_frame: Matrix3<f64> = configuration.eme2000_from_orbit_frame.transpose();
        let (elements, gap) = Elements::osculating(&state.along(&to_frame), gm_m3_s2).ok()?;
        let axis_m = elements.semi_major_axis_m;
        let is_closed = axis_m > 0.0;
        let momentum = state.position_m.cross(&state.velocity_m_s);
        let orbit = Self {
            elements,
            period_s: if is_closed { period_s(gm_m3_s2, axis_m) } else { 0.0 },
            periapsis_height_m: axis_m.abs() * gap - radius_m,
            apoapsis_height_m: if is_closed {
                axis_m * (1.0 + elements.eccentricity) - radius_m
            } else {
                0.0
            },
            sun_elevation_rad: math::atan2(momentum.dot(to_sun_m), momentum.cross(to_sun_m).norm()),
        };
        let Self { period_s, periapsis_height_m, apoapsis_height_m, sun_elevation_rad, .. } = orbit;
        let shape = [elements.semi_major_axis_m, elements.eccentricity, elements.true_anomaly_rad];
        let angles = [elements.inclination_rad, elements.ascending_node_rad, elements.periapsis_argument_rad];
        let others = [period_s, periapsis_height_m, apoapsis_height_m, sun_elevation_rad];
        let is_finite = shape.into_iter().chain(angles).chain(others).all(f64::is_finite);
        is_finite.then_some(orbit)
    }
}
