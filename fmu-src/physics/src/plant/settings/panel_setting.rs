//! How one panel stands: at an angle of its own or by the Sun, held, moving evenly, in steps or by the light on its cells.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::attitude::angle_between_rad;
use crate::guidance::timeline::{TimelinePanels, begun, simulation_time_s};
use crate::math::{self, wrapped_rad};
use crate::numerics::scalar::{Dual64, Scalar, sin_cos};
use crate::spacecraft::{Panel, offset_for_suns};

/// The Sun from the spacecraft at a time, which may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunAt<T: Scalar = f64> {
    /// When, in s.
    pub time_s: T,
    /// Unit vector to it, body frame.
    pub direction_body: Vector3<T>,
    /// Distance from its centre, in m.
    pub distance_m: T,
}

/// An angle that is held or changes evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    since_s: f64,
    angle_rad: f64,
    rate_rad_s: f64,
    /// Cosine and sine at `since_s`.
    cos_sin: [f64; 2],
}

impl Ramp {
    /// An angle that stays, in rad.
    pub fn held(angle_rad: f64) -> Self {
        Self::since(0.0, angle_rad, 0.0)
    }

    /// An angle in rad that changes at a rate in rad/s from a time in s on.
    pub fn since(since_s: f64, angle_rad: f64, rate_rad_s: f64) -> Self {
        let (sin, cos) = math::sin_cos(angle_rad);
        Self { since_s, angle_rad, rate_rad_s, cos_sin: [cos, sin] }
    }

    /// The angle at `time_s`, in rad.
    pub fn at_rad<T: Scalar>(&self, time_s: T) -> T {
        if self.rate_rad_s == 0.0 {
            return T::constant(self.angle_rad);
        }
        (time_s - self.since_s) * self.rate_rad_s + self.angle_rad
    }
}

/// Turn of a panel about its axis off the angle that the Sun gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// +1 or -1: the sense of the tilt about the axis.
    pub sign: f64,
    /// Angle added to that of the law, in rad.
    pub bias_rad: f64,
}

impl From<f64> for Tilt {
    fn from(sign: f64) -> Self {
        Self { sign, bias_rad: 0.0 }
    }
}

/// One step of a timeline of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelStep {
    /// From when on, in s of the timeline's clock.
    pub at_s: f64,
    /// Angle between cell normal and Sun, in rad, with the windmill angle on the panel's side.
    pub offset_rad: f64,
}

impl PanelStep {
    /// The steps of panel `index`.
    pub fn of_timeline(timeline: &[TimelinePanels], index: usize, panel: &Panel) -> Arc<[Self]> {
        let offset_rad = |row: &TimelinePanels| {
            let offset_rad = row.sun_offsets_rad.get(index).copied().unwrap_or_default();
            offset_rad + row.windmill_rad * panel.windmill_side
        };
        timeline.iter().map(|row| Self { at_s: row.at_s, offset_rad: offset_rad(row) }).collect()
    }
}

/// How one panel stands.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelSetting {
    /// Left out.
    Disabled,
    /// Cell normal at an angle from the Sun.
    SunOffset {
        /// Angle from the Sun.
        offset: Ramp,
        /// Sense of the tilt about the axis, and what is added.
        tilt: Tilt,
    },
    /// At this angle about its axis.
    Angle(Ramp),
    /// Cell normal at angles from the Sun that follow one another at once.
    Timeline {
        /// Angles from the Sun in the order of their times; each holds from its time on.
        steps: Arc<[PanelStep]>,
        /// The timeline's clock minus the time of the simulation, in s.
        clock_minus_time_s: f64,
        /// The angle before the first, in rad.
        before_rad: f64,
        /// Sense of the tilt about the axis, and what is added.
        tilt: Tilt,
    },
    /// Cell normal at the angle from the Sun that gives the cells this light; toward the Sun where it cannot.
    Distance {
        /// Light on the cells, in suns.
        suns: f64,
        /// Sense of the tilt about the axis, and what is added.
        tilt: Tilt,
    },
}

impl PanelSetting {
    /// With an angle in rad added about the axis, whatever the law.
    #[must_use]
    pub fn biased(mut self, added_rad: f64) -> Self {
        match &mut self {
            Self::Angle(ramp) if added_rad != 0.0 => {
                *ramp = Ramp::since(ramp.since_s, ramp.angle_rad + added_rad, ramp.rate_rad_s);
            }
            Self::SunOffset { tilt, .. } | Self::Timeline { tilt, .. } | Self::Distance { tilt, .. } => {
                tilt.bias_rad = added_rad;
            }
            Self::Disabled | Self::Angle(_) => {}
        }
        self
    }

    /// Angle about the panel's axis, in rad, with the Sun there; `None` when left out.
    pub fn angle_rad<T: Scalar>(&self, panel: &Panel, sun: &SunAt<T>) -> Option<T> {
        Some(match self.commanded(sun)? {
            Commanded::Angle(angle_rad) => angle_rad,
            Commanded::SunOffset { offset_rad, tilt, .. } => {
                let angle_rad = panel.angle_for_sun_offset(&sun.direction_body, offset_rad, tilt.sign);
                if tilt.bias_rad == 0.0 { angle_rad } else { angle_rad + tilt.bias_rad }
            }
        })
    }

    /// Angle from the Sun at which the cell normal is to stand, and at which this one stands, body frame, in rad, 0 to pi; of a
    /// panel that is turned by an angle of its own, or left out, both are that at which it stands.
    pub fn sun_offsets_rad(&self, normal_body: &Vector3<f64>, sun: &SunAt) -> [f64; 2] {
        let actual_rad = angle_between_rad(normal_body, &sun.direction_body);
        match self.commanded(sun) {
            Some(Commanded::SunOffset { offset_rad, .. }) => [wrapped_rad(offset_rad).abs(), actual_rad],
            Some(Commanded::Angle(_)) | None => [actual_rad; 2],
        }
    }

    /// Cosine of the angle from the Sun at which the cell normal is to stand, less that at which it stands; 0 of a panel that is
    /// turned by an angle of its own, or left out.
    pub fn light_out_of_reach(&self, panel: &Panel, sun: &SunAt) -> f64 {
        let Some(Commanded::SunOffset { offset_rad, cos_sin, .. }) = self.commanded(sun) else { return 0.0 };
        let Some(normal_body) = self.normal_body(panel, sun) else { return 0.0 };
        cos_sin.map_or_else(|| math::cos(offset_rad), |[cos, _]| cos) - normal_body.dot(&sun.direction_body)
    }

    /// Unit normal of the cell side, body frame, with the Sun there; `None` when left out.
    pub fn normal_body<T: Scalar>(&self, panel: &Panel, sun: &SunAt<T>) -> Option<Vector3<T>> {
        Some(match self.commanded(sun)? {
            Commanded::Angle(angle_rad) => panel.normal_body(angle_rad),
            Commanded::SunOffset { tilt, .. } if tilt.bias_rad != 0.0 => {
                panel.normal_body(self.angle_rad(panel, sun)?)
            }
            Commanded::SunOffset { offset_rad, cos_sin, tilt } => {
                let sun_offset = cos_sin.map(|it| it.map(T::constant)).unwrap_or_else(|| {
                    let (sin, cos) = sin_cos(offset_rad);
                    [cos, sin]
                });
                panel.normal_for_sun_offset(&sun.direction_body, sun_offset, tilt.sign)
            }
        })
    }

    /// Commanded angle with the Sun there; `None` when left out.
    fn commanded<T: Scalar>(&self, sun: &SunAt<T>) -> Option<Commanded<T>> {
        let (offset_rad, cos_sin, tilt) = match self {
            Self::Disabled => return None,
            Self::Angle(angle) => return Some(Commanded::Angle(angle.at_rad(sun.time_s))),
            Self::SunOffset { offset, tilt } => {
                let held = (offset.rate_rad_s == 0.0).then_some(offset.cos_sin);
                (offset.at_rad(sun.time_s), held, tilt)
            }
            Self::Timeline { steps, clock_minus_time_s, before_rad, tilt } => {
                let begun = begun(steps, *clock_minus_time_s, sun.time_s.value(), |step| step.at_s);
                let step = begun.checked_sub(1).and_then(|last| steps.get(last));
                (T::constant(step.map_or(*before_rad, |step| step.offset_rad)), None, tilt)
            }
            Self::Distance { suns, tilt } => (offset_for_suns(*suns, sun.distance_m), None, tilt),
        };
        Some(Commanded::SunOffset { offset_rad, cos_sin, tilt: *tilt })
    }

    /// Returns the angle about the axis and its rate, in rad and rad/s, for a moving Sun; 0 for a disabled panel.
    pub fn turn_rad(&self, panel: &Panel, sun: &SunAt<Dual64>) -> [f64; 2] {
        self.angle_rad(panel, sun).map_or([0.0; 2], |angle| [angle.re, angle.eps])
    }

    /// The first time after `time_s` at which it jumps, in s; infinite where it does not.
    pub fn until_s(&self, time_s: f64) -> f64 {
        let Self::Timeline { steps, clock_minus_time_s, .. } = self else { return f64::INFINITY };
        let next = steps.get(begun(steps, *clock_minus_time_s, time_s, |step| step.at_s));
        next.map_or(f64::INFINITY, |next| simulation_time_s(next.at_s, *clock_minus_time_s))
    }

    /// Whether the Sun gives the angle.
    pub fn is_by_sun(&self) -> bool {
        !matches!(self, Self::Disabled | Self::Angle(_))
    }
}

/// Angle that a setting commands at one time.
enum Commanded<T> {
    /// About the panel's axis, in rad.
    Angle(T),
    /// From the Sun.
    SunOffset {
        /// In rad.
        offset_rad: T,
        /// Cosine and sine of an offset that stays.
        cos_sin: Option<[f64; 2]>,
        /// Sense of the tilt about the axis, and what is added.
        tilt: Tilt,
    },
}

/// Angle of panel `index` about its axis, in rad, with the Sun there; 0 of one that is left out.
pub(crate) fn panel_angle_rad(settings: &[PanelSetting], panels: &[Panel], index: usize, sun: &SunAt) -> f64 {
    let set = settings.get(index).zip(panels.get(index));
    set.and_then(|(setting, panel)| setting.angle_rad(panel, sun)).unwrap_or(0.0)
}

#[cfg(test)]
#[path = "panel_setting_tests.rs"]
mod tests;
