//! How one panel stands: at an angle of its own or by the Sun, held or moving evenly.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use crate::numerics::scalar::Dual64;
use crate::spacecraft::Panel;

/// An angle that is held or changes evenly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ramp {
    /// At `since_s`, in rad.
    pub angle_rad: f64,
    /// In rad/s.
    pub rate_rad_s: f64,
    /// In s.
    pub since_s: f64,
}

impl Ramp {
    /// An angle that stays, in rad.
    pub fn held(angle_rad: f64) -> Self {
        Self { angle_rad, ..Self::default() }
    }

    /// The angle at `time_s`, in rad.
    pub fn at_rad(&self, time_s: f64) -> f64 {
        if self.rate_rad_s == 0.0 {
            return self.angle_rad;
        }
        self.angle_rad + self.rate_rad_s * (time_s - self.since_s)
    }
}

/// How one panel stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PanelSetting {
    /// Left out.
    Disabled,
    /// Cell normal at an angle from the Sun.
    SunOffset {
        /// That angle.
        offset: Ramp,
        /// +1 or -1: the sense of the tilt about the axis.
        tilt_sign: f64,
    },
    /// At this angle about its axis.
    Angle(Ramp),
}

impl PanelSetting {
    /// Angle about the panel's axis at `time_s`, in rad, with the Sun at `sun_body` (unit vector); `None` when left out.
    pub fn angle_rad(&self, panel: &Panel, sun_body: &Vector3<f64>, time_s: f64) -> Option<f64> {
        match *self {
            Self::Disabled => None,
            Self::Angle(angle) => Some(angle.at_rad(time_s)),
            Self::SunOffset { offset, tilt_sign } => {
                Some(panel.angle_for_sun_offset(sun_body, offset.at_rad(time_s), tilt_sign))
            }
        }
    }

    /// Rate of that angle, in rad/s, the Sun moving in the body frame by `sun_rate_body_1_s`; 0 when left out.
    pub fn rate_rad_s(
        &self,
        panel: &Panel,
        sun_body: &Vector3<f64>,
        sun_rate_body_1_s: &Vector3<f64>,
        time_s: f64,
    ) -> f64 {
        match *self {
            Self::Disabled => 0.0,
            Self::Angle(angle) => angle.rate_rad_s,
            Self::SunOffset { offset, tilt_sign } => {
                let sun = sun_body.zip_map(sun_rate_body_1_s, Dual64::new);
                let offset = Dual64::new(offset.at_rad(time_s), offset.rate_rad_s);
                panel.angle_for_sun_offset(&sun, offset, tilt_sign).eps
            }
        }
    }

    /// The way to `to_rad` from `from_rad`, in rad: of an angle that the Sun gives, which is known but for whole turns, the
    /// shorter one.
    pub(crate) fn way_rad(&self, from_rad: f64, to_rad: f64) -> f64 {
        let way_rad = to_rad - from_rad;
        match self {
            Self::SunOffset { .. } => way_rad - TAU * (way_rad / TAU).round(),
            Self::Disabled | Self::Angle(_) => way_rad,
        }
    }

    /// Whether the Sun gives the angle.
    pub(crate) fn is_by_sun(&self) -> bool {
        matches!(self, Self::SunOffset { .. })
    }
}
