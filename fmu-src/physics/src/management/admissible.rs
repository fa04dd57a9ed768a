//! Where the Sun may stand during a downlink: inside the keep-in zone, with the Earth in the plane of the antennas and inside
//! the quadrant of one of them.
//!
//! The Earth's azimuth is A - delta or A + delta, cos delta = cos theta / cos E (eq 20), which needs
//! |E| <= min(theta, 180 deg - theta). An antenna that covers the azimuths m - 45 deg to m + 45 deg allows the azimuths
//! A of the Sun within 45 deg of m + delta or m - delta. The angle theta changes while a downlink lasts, one way over hours: what
//! holds at its least and at its greatest holds throughout.
//!
//! In science that unloads no antenna looks at the Earth: the keep-in zone alone counts.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use crate::attitude::SunAngles;
use crate::guidance::SunPlace;
use crate::math;

/// Limits of the Sun's place about -Y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeepInLimits {
    /// Greatest magnitude of the azimuth, 0 to pi/2.
    pub azimuth_rad: f64,
    /// Greatest magnitude of the elevation, 0 to pi/2.
    pub elevation_rad: f64,
}

/// One side of the Sun for the Earth, and one antenna; or anywhere in the zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Whether the Earth's azimuth is A + delta.
    pub earth_ahead: bool,
    /// Middle of the antenna's quadrant, in rad; `None`: no antenna.
    middle_rad: Option<f64>,
    /// Least and greatest angle between Sun and Earth while the downlink lasts, in rad.
    separations_rad: [f64; 2],
    limits: KeepInLimits,
}

impl Branch {
    /// All four, that of the default attitude (eq 18) first.
    pub fn all(limits: KeepInLimits, separation_rad: f64) -> [Self; 4] {
        const SUNSHADE_RAD: f64 = -FRAC_PI_4;
        const BACK_RAD: f64 = 3.0 * FRAC_PI_4;
        let separations_rad = [separation_rad; 2];
        let branch = |earth_ahead, middle_rad| Self {
            earth_ahead,
            middle_rad: Some(middle_rad),
            separations_rad,
            limits,
        };
        let (behind, ahead) = (branch(false, SUNSHADE_RAD), branch(true, BACK_RAD));
        let (first, second) = if separation_rad < FRAC_PI_2 { (behind, ahead) } else { (ahead, behind) };
        [first, second, branch(true, SUNSHADE_RAD), branch(false, BACK_RAD)]
    }

    /// The zone, whatever becomes of the Earth.
    pub fn zone(limits: KeepInLimits) -> Self {
        Self { earth_ahead: false, middle_rad: None, separations_rad: [FRAC_PI_2; 2], limits }
    }

    /// The same where the angle between Sun and Earth goes from the least to the greatest of these while the downlink lasts.
    #[must_use]
    pub fn lasting(self, separations_rad: [f64; 2]) -> Self {
        Self { separations_rad, ..self }
    }

    /// Greatest magnitude of the elevation, in rad.
    pub fn elevation_rad(&self) -> f64 {
        if self.middle_rad.is_none() {
            return self.limits.elevation_rad;
        }
        let [least_rad, greatest_rad] = self.separations_rad;
        self.limits.elevation_rad.min(least_rad).min(PI - greatest_rad)
    }

    /// Least and greatest azimuth at an elevation; `None` where no azimuth will do.
    pub fn azimuths_rad(&self, elevation_rad: f64) -> Option<[f64; 2]> {
        let most_rad = self.limits.azimuth_rad.min(FRAC_PI_2);
        let Some(middle_rad) = self.middle_rad else { return Some([-most_rad, most_rad]) };
        let middles_rad = self.separations_rad.map(|separation_rad| {
            let cosine = (math::cos(separation_rad) / math::cos(elevation_rad)).clamp(-1.0, 1.0);
            let delta_rad = if self.earth_ahead { math::acos(cosine) } else { -math::acos(cosine) };
            (middle_rad - delta_rad + PI).rem_euclid(TAU) - PI
        });
        let low_rad = middles_rad.into_iter().fold(-most_rad, |low_rad, it| low_rad.max(it - FRAC_PI_4));
        let high_rad = middles_rad.into_iter().fold(most_rad, |high_rad, it| high_rad.min(it + FRAC_PI_4));
        // What stands at a bound is inside, whatever rounding says.
        let is_point = high_rad < low_rad && high_rad > low_rad - ROUNDING_RAD;
        if high_rad >= low_rad || is_point { Some([low_rad.min(high_rad), high_rad]) } else { None }
    }

    /// The place with these angles if it is admissible.
    pub fn place(&self, angles: SunAngles) -> Option<SunPlace> {
        let nearest = self.nearest(angles)?;
        let off_rad = (nearest.angles.azimuth_rad - angles.azimuth_rad)
            .abs()
            .max((nearest.angles.elevation_rad - angles.elevation_rad).abs());
        (off_rad <= ROUNDING_RAD).then_some(nearest)
    }

    /// The admissible place nearest to these angles, elevation first.
    pub fn nearest(&self, angles: SunAngles) -> Option<SunPlace> {
        let most_rad = self.elevation_rad();
        let elevation_rad = angles.elevation_rad.clamp(-most_rad, most_rad);
        let [low_rad, high_rad] = self.azimuths_rad(elevation_rad)?;
        let azimuth_rad = angles.azimuth_rad.clamp(low_rad, high_rad);
        Some(SunPlace { angles: SunAngles { azimuth_rad, elevation_rad }, earth_ahead: self.earth_ahead })
    }
}

/// Angles closer than this are one, in rad.
const ROUNDING_RAD: f64 = 1e-12;

#[cfg(test)]
mod tests;
