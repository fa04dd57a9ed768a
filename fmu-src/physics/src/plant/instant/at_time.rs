//! One instant of a flight: where everything is, how the body stands, how much of the Sun it sees.

use nalgebra::{Rotation3, Vector3};

use super::geometry::Geometry;
use crate::attitude::MovingFrame;
use crate::guidance::{Activity, AttitudeCommand, GuidedAttitude, Window};
use crate::momentum::EventValues;
use crate::numerics::scalar::Dual64;
use crate::plant::settings::panel_setting::SunAt;

/// Everything about one time but what acts on the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Time of the flight, in s.
    pub time_s: f64,
    /// Sun, planet and Earth as the spacecraft sees them.
    pub geometry: Geometry,
    /// Body frame and rate, window and margins of the attitude law.
    pub law: GuidedAttitude,
    /// From EME2000 to the body frame.
    pub to_body: Rotation3<f64>,
    /// Unit vector to the Sun, body frame.
    pub sun_body: Vector3<f64>,
    /// Distance from the Sun's centre, in m.
    pub sun_distance_m: f64,
    /// From the spacecraft to the planet's centre, body frame, in m.
    pub planet_body_m: Option<Vector3<f64>>,
    /// Visible part of the Sun's disc, 0 to 1.
    pub lit_fraction: f64,
    /// Outer and inner gap of the shadow, in rad, and the margins of the attitude law; see [`EventValues`].
    pub events: EventValues,
}

impl Instant {
    /// Spacecraft with a known attitude and no position: no Sun, no planet, no field.
    pub fn without_position(frame: MovingFrame, time_s: f64) -> Self {
        Self {
            time_s,
            geometry: Geometry::default(),
            law: without_windows(frame),
            to_body: frame.inertial_from_body.inverse(),
            sun_body: Vector3::zeros(),
            sun_distance_m: 0.0,
            planet_body_m: None,
            lit_fraction: 0.0,
            events: EventValues::repeat(f64::INFINITY),
        }
    }

    /// The Sun from the spacecraft.
    pub fn sun(&self) -> SunAt {
        SunAt { time_s: self.time_s, direction_body: self.sun_body, distance_m: self.sun_distance_m }
    }

    /// The same with the rate of everything, time's being 1.
    pub fn moving_sun(&self) -> SunAt<Dual64> {
        let to_sun = &self.geometry.to_sun;
        let unit = to_sun.position_m.try_normalize(0.0);
        let approach_m_s = unit.map_or(0.0, |unit| unit.dot(&to_sun.velocity_m_s));
        let moving = unit.map_or(Vector3::zeros(), |unit| {
            (to_sun.velocity_m_s - unit * approach_m_s) / self.sun_distance_m
        });
        let rate_body_1_s = self.to_body * moving - self.law.frame.rate_body_rad_s.cross(&self.sun_body);
        SunAt {
            time_s: Dual64::new(self.time_s, 1.0),
            direction_body: self.sun_body.zip_map(&rate_body_1_s, Dual64::new),
            distance_m: Dual64::new(self.sun_distance_m, approach_m_s),
        }
    }

    /// Whether the window is a downlink.
    pub fn is_in_downlink(&self) -> bool {
        self.law.window.activity == Activity::Downlink
    }

    /// From the spacecraft to the Sun, body frame, in m.
    pub fn sun_position_body_m(&self) -> Vector3<f64> {
        self.sun_body * self.sun_distance_m
    }

    /// Unit vector to the Earth, body frame; zero where its place is not known.
    pub fn earth_body(&self) -> Vector3<f64> {
        let to_earth_m = self.geometry.to_earth.position_m;
        to_earth_m.try_normalize(0.0).map_or(Vector3::zeros(), |unit| self.to_body * unit)
    }
}

/// Attitude by a law without windows, slews and scans.
pub(super) fn without_windows(frame: MovingFrame) -> GuidedAttitude {
    let window = Window { activity: Activity::Science, since_s: f64::NEG_INFINITY, until_s: f64::INFINITY };
    GuidedAttitude::held(AttitudeCommand::new(frame, [f64::INFINITY; 2]), window)
}
