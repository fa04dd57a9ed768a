//! Panels that turn with the Sun, as MomentumPlant turns them: angles and how they change.

use nalgebra::Vector3;
use physics::{numerics::scalar::Dual64, spacecraft::Panel};

/// A panel and what turns it.
pub struct TurnedPanels {
    /// Panel of the spacecraft's file.
    pub panel: Panel,
    /// Rule that turns it.
    pub rule: Rule,
}

/// Rule that sets a panel's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Constant angle between cells and Sun, tilted by a sign about its axis.
    SunOffset {
        /// The angle, in rad.
        offset_rad: f64,
        /// The sign: 1 or -1.
        tilt_sign: f64,
    },
    /// Fixed angle, in rad.
    Angle(f64),
}

impl TurnedPanels {
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
    pub(super) fn angle_rate(&self, sun: &Vector3<f64>, change: &Vector3<f64>) -> f64 {
        match self.rule {
            Rule::SunOffset { offset_rad, tilt_sign } => {
                let moving = sun.zip_map(change, Dual64::new);
                self.panel.angle_for_sun_offset(&moving, offset_rad.into(), tilt_sign).eps
            }
            Rule::Angle(_) => 0.0,
        }
    }

    /// How the angle changes with the offset o: cos(tilt) = cos(o) / sqrt(1 - a^2), a being the Sun's part along the axis, so
    /// d tilt / d o = sin(o) / sqrt(sin(o)^2 - a^2), 1 with the axis across the Sun; 0 where the offset cannot be kept.
    pub(super) fn angle_per_offset(&self, sun: &Vector3<f64>) -> f64 {
        /// The axis is across the Sun.
        const ACROSS: f64 = 1e-12;
        let Rule::SunOffset { offset_rad, tilt_sign } = self.rule else { return 0.0 };
        let (across, along) = (offset_rad.sin().abs(), sun.dot(&self.panel.axis_body).abs());
        if along < ACROSS {
            tilt_sign
        } else if across > along {
            tilt_sign * across / (across * across - along * along).sqrt()
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    //! The rate against differences of the angle itself, and where there is none.
    use super::*;
    use physics::spacecraft::{MESSENGER_TOML, Spacecraft};

    fn turned(offset_rad: f64, tilt_sign: f64) -> TurnedPanels {
        let panel = Spacecraft::from_toml("", MESSENGER_TOML).unwrap().panels.swap_remove(0);
        TurnedPanels { panel, rule: Rule::SunOffset { offset_rad, tilt_sign } }
    }

    #[test]
    fn the_angle_follows_the_offset_from_none_on() {
        const H: f64 = 1e-5;
        let axis = turned(0.0, 1.0).panel.axis_body;
        for (along, offset_rad) in [
            (0.0, 0.0),
            (0.0, 1e-9),
            (0.0, 1.1),
            (0.0, 2.5),
            (0.3, 0.31),
            (0.3, 1.1),
            (-0.6, 2.0),
            (0.3, 0.2),
        ] {
            let sun = (-Vector3::y() * f64::sqrt(1.0 - along * along) + axis * along).normalize();
            for sign in [1.0, -1.0] {
                let at = |offset_rad: f64| turned(offset_rad, sign).angle_rad(&sun);
                let slope = (at(offset_rad + 2.0 * H) - at(offset_rad)) / (2.0 * H);
                let reported = turned(offset_rad + H, sign).angle_per_offset(&sun);
                assert!(
                    (reported - slope).abs() < 1e-4 * slope.abs() + 1e-9,
                    "{along} {offset_rad}: {reported} {slope}"
                );
            }
        }
        assert_eq!(turned(0.0, -1.0).angle_per_offset(&-Vector3::y()), -1.0);
        assert_eq!(turned(0.0, 1.0).angle_per_offset(&axis), 0.0, "every angle gives 90 deg");
    }
}
