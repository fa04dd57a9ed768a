//! One instant of a flight: where everything is, how the body stands, how much of the Sun it sees.

use nalgebra::{Rotation3, Vector3};

use super::geometry::Geometry;
use crate::attitude::MovingFrame;
use crate::guidance::{Activity, DownlinkStatus, GuidedAttitude, Window};
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
    /// Body frame and rate.
    pub frame: MovingFrame,
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
    /// Forms of the attitude law and of the shadow.
    pub regime: Regime,
    /// Outer and inner gap of the shadow, in rad, and the margins of the attitude law; see [`EventValues`].
    pub events: EventValues,
    /// Whether a downlink lasts, the turn to it done, and whether the Sun's place in it is not the one requested.
    pub downlink: DownlinkStatus,
    /// Whether a substitute stands in for a target of the attitude law on one line with the other.
    pub is_degenerate: bool,
    /// Up to when window and slew last, in s of the flight.
    pub attitude_until_s: f64,
}

impl Instant {
    /// Spacecraft with a known attitude and no position: no Sun, no planet, no field.
    pub fn without_position(frame: MovingFrame, time_s: f64) -> Self {
        Self {
            time_s,
            geometry: Geometry::default(),
            frame,
            to_body: frame.inertial_from_body.inverse(),
            sun_body: Vector3::zeros(),
            sun_distance_m: 0.0,
            planet_body_m: None,
            lit_fraction: 0.0,
            regime: Regime::by_law(&without_windows(frame)),
            events: EventValues::repeat(f64::INFINITY),
            downlink: DownlinkStatus::default(),
            is_degenerate: false,
            attitude_until_s: f64::INFINITY,
        }
    }

    /// The Sun from the spacecraft.
    pub fn sun(&self) -> SunAt {
        SunAt { time_s: self.time_s, direction_body: self.sun_body, distance_m: self.sun_distance_m }
    }

    /// The same with the rate of everything, time's being 1.
    pub fn moving_sun(&self) -> SunAt<Dual64> {
        let to_sun = &self.geometry.to_sun;
        let approach_m_s =
            to_sun.position_m.try_normalize(0.0).map_or(0.0, |unit| unit.dot(&to_sun.velocity_m_s));
        SunAt {
            time_s: Dual64::new(self.time_s, 1.0),
            direction_body: self.sun_body.zip_map(&self.sun_rate_body_1_s(), Dual64::new),
            distance_m: Dual64::new(self.sun_distance_m, approach_m_s),
        }
    }

    /// How the unit vector to the Sun moves in the body frame, in 1/s.
    fn sun_rate_body_1_s(&self) -> Vector3<f64> {
        let to_sun = &self.geometry.to_sun;
        let moving = to_sun.position_m.try_normalize(0.0).map_or(Vector3::zeros(), |unit| {
            (to_sun.velocity_m_s - unit * unit.dot(&to_sun.velocity_m_s)) / self.sun_distance_m
        });
        self.to_body * moving - self.frame.rate_body_rad_s.cross(&self.sun_body)
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

/// Forms of the attitude law and of the shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// Since when the window of science or downlink lasts, in s past J2000 TDB; minus infinity where there is none.
    pub window_since_s: f64,
    /// Whether the window is a downlink.
    pub downlink: bool,
    /// The timeline's command, from 1, whose window it is; 0 of none.
    pub row: usize,
    /// Whether the body turns from one attitude to the other.
    pub slewing: bool,
    /// When the next motion of a scan begins or ends, in s past J2000 TDB; infinite without one.
    pub corner_s: f64,
    /// Whether the planet hides a part of the Sun.
    pub in_shadow: bool,
}

impl Regime {
    /// Form of the law that gives this attitude, in sunlight.
    pub(super) fn by_law(law: &GuidedAttitude) -> Self {
        let GuidedAttitude { window, row, slewing, corner_s, .. } = *law;
        let downlink = window.activity == Activity::Downlink;
        Self { window_since_s: window.since_s, downlink, row, slewing, corner_s, in_shadow: false }
    }
}

/// Attitude by a law without windows, slews and scans.
pub(super) fn without_windows(frame: MovingFrame) -> GuidedAttitude {
    GuidedAttitude {
        frame,
        window: Window { activity: Activity::Science, since_s: f64::NEG_INFINITY, until_s: f64::INFINITY },
        row: 0,
        slewing: false,
        margins: [f64::INFINITY; 2],
        clamped: false,
        degenerate: false,
        corner_s: f64::INFINITY,
        until_s: f64::INFINITY,
    }
}
