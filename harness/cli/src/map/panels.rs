//! Panels that turn with the Sun, as MomentumPlant turns them: angles and how they change.

use nalgebra::Vector3;
use physics::{numerics::scalar::Dual64, spacecraft::Panel};

/// A panel and what turns it.
pub struct Turned {
    pub panel: Panel,
    pub rule: Rule,
}

/// What sets a panel's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// It keeps an angle between cells and Sun, tilted by a sign about its axis.
    SunOffset { offset_rad: f64, tilt_sign: f64 },
    /// It stands.
    Angle(f64),
}

impl Turned {
    /// With the Sun in this direction.
    pub fn angle_rad(&self, sun: &Vector3<f64>) -> f64 {
        match self.rule {
            Rule::SunOffset { offset_rad, tilt_sign } => {
                self.panel.angle_for_sun_offset(sun, offset_rad, tilt_sign)
            }
            Rule::Angle(angle_rad) => angle_rad,
        }
    }

    /// How the angle changes with a change of the Sun's direction.
    pub fn angle_rate(&self, sun: &Vector3<f64>, change: &Vector3<f64>) -> f64 {
        match self.rule {
            Rule::SunOffset { offset_rad, tilt_sign } => {
                let moving = sun.zip_map(change, Dual64::new);
                self.panel.angle_for_sun_offset(&moving, offset_rad, tilt_sign).eps
            }
            Rule::Angle(_) => 0.0,
        }
    }

    /// How the angle changes with the offset: cos(tilt) = cos(offset) / s, s being the length of the Sun's direction in the
    /// panel's plane of rotation; 0 where the offset cannot be kept.
    pub fn angle_per_offset(&self, sun: &Vector3<f64>) -> f64 {
        let Rule::SunOffset { offset_rad, tilt_sign } = self.rule else { return 0.0 };
        let in_plane = sun.cross(&self.panel.axis_body).norm();
        let cos_tilt = offset_rad.cos() / in_plane;
        if cos_tilt.abs() < 1.0 {
            tilt_sign * offset_rad.sin() / (in_plane * (1.0 - cos_tilt * cos_tilt).sqrt())
        } else {
            0.0
        }
    }
}
