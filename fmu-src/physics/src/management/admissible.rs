//! Admissible directions of the Sun during a downlink: inside the keep-in zone, with the Earth in the plane of the antennas and inside
//! the range of one of them.
//!
//! The Earth's azimuth is A - delta or A + delta, cos delta = cos theta / cos E (eq 20), which needs
//! |E| <= min(theta, 180 deg - theta). An antenna that covers the azimuths m - h to m + h allows the azimuths
//! A of the Sun within h of m + delta or m - delta. The angle theta changes while a downlink lasts, one way over hours: what
//! holds at its least and at its greatest holds throughout.
//!
//! In science that unloads no antenna looks at the Earth: the keep-in zone alone counts.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::attitude::SunAngles;
use crate::guidance::DownlinkSunDirection;
use crate::guidance::downlink::sun_direction::is_ahead;
use crate::guidance::pointing::antenna::Antennas;
use crate::math;
use crate::spacecraft::{FanAzimuths, MOST_ANTENNAS};

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
pub(super) struct Branch {
    /// Whether the Earth's azimuth is A + delta.
    pub earth_ahead: bool,
    /// The antenna's azimuths; `None`: no antenna.
    fan: Option<FanAzimuths>,
    /// Least and greatest angle between Sun and Earth while the downlink lasts, in rad.
    separations_rad: [f64; 2],
    limits: KeepInLimits,
}

impl Branch {
    /// Both sides of the Sun for each fan: that of the default attitude (eq 18) first, then each fan on the side of the Sun where
    /// its own azimuths are, then on the other.
    pub(super) fn all(limits: KeepInLimits, antennas: &Antennas, separation_rad: f64) -> Branches {
        let separations_rad = [separation_rad; 2];
        let branch = |earth_ahead, fan| Self { earth_ahead, fan: Some(fan), separations_rad, limits };
        // The azimuth of the Earth is negative behind the Sun and positive ahead.
        let own_side = |fan: &FanAzimuths| (fan.middle_rad + PI).rem_euclid(TAU) - PI > 0.0;
        let fans = || antennas.fans().map(|(_, fan)| fan);
        let (own, other) =
            (fans().map(|it| branch(own_side(&it), it)), fans().map(|it| branch(!own_side(&it), it)));
        let mut all = [None; 2 * MOST_ANTENNAS];
        all.iter_mut().zip(own.chain(other)).for_each(|(place, branch)| *place = Some(branch));
        let azimuths_rad = [-separation_rad, separation_rad];
        let ahead = is_ahead(antennas, azimuths_rad, math::cos(separation_rad));
        let nearest = antennas.nearest_fan(azimuths_rad[usize::from(ahead)]).antenna;
        let default = nearest.and_then(|row| antennas.get(row)?.fan());
        let is_default = |branch: &Self| branch.earth_ahead == ahead && branch.fan == default;
        let found = all.iter().flatten().position(is_default);
        if let Some(moved) = found.and_then(|index| all.get_mut(..=index)) {
            moved.rotate_right(1);
        }
        all
    }

    /// The zone, whatever becomes of the Earth.
    pub(super) fn zone(limits: KeepInLimits) -> Self {
        Self { earth_ahead: false, fan: None, separations_rad: [FRAC_PI_2; 2], limits }
    }

    /// The same where the angle between Sun and Earth goes from the least to the greatest of these while the downlink lasts.
    #[must_use]
    pub(super) fn lasting(self, separations_rad: [f64; 2]) -> Self {
        Self { separations_rad, ..self }
    }

    /// Greatest magnitude of the elevation, in rad.
    pub(super) fn elevation_rad(&self) -> f64 {
        if self.fan.is_none() {
            return self.limits.elevation_rad;
        }
        let [least_rad, greatest_rad] = self.separations_rad;
        self.limits.elevation_rad.min(least_rad).min(PI - greatest_rad)
    }

    /// Least and greatest azimuth at an elevation; `None` where no azimuth will do.
    pub(super) fn azimuths_rad(&self, elevation_rad: f64) -> Option<[f64; 2]> {
        let most_rad = self.limits.azimuth_rad.min(FRAC_PI_2);
        let Some(fan) = self.fan.filter(|fan| fan.half_rad < PI) else { return Some([-most_rad, most_rad]) };
        let middles_rad = self.separations_rad.map(|separation_rad| {
            let cosine = (math::cos(separation_rad) / math::cos(elevation_rad)).clamp(-1.0, 1.0);
            let delta_rad = if self.earth_ahead { math::acos(cosine) } else { -math::acos(cosine) };
            (fan.middle_rad - delta_rad + PI).rem_euclid(TAU) - PI
        });
        let low_rad = middles_rad.into_iter().fold(-most_rad, |low_rad, it| low_rad.max(it - fan.half_rad));
        let high_rad = middles_rad.into_iter().fold(most_rad, |high_rad, it| high_rad.min(it + fan.half_rad));
        // What stands at a bound is inside, whatever the rounding.
        let is_point = high_rad < low_rad && high_rad > low_rad - ROUNDING_RAD;
        if high_rad >= low_rad || is_point { Some([low_rad.min(high_rad), high_rad]) } else { None }
    }

    /// The place with these angles if it is admissible.
    pub(super) fn place(&self, angles: SunAngles) -> Option<DownlinkSunDirection> {
        let nearest = self.nearest(angles)?;
        let off_rad = (nearest.angles.azimuth_rad - angles.azimuth_rad)
            .abs()
            .max((nearest.angles.elevation_rad - angles.elevation_rad).abs());
        (off_rad <= ROUNDING_RAD).then_some(nearest)
    }

    /// The admissible place nearest to these angles, elevation first.
    pub(super) fn nearest(&self, angles: SunAngles) -> Option<DownlinkSunDirection> {
        let most_rad = self.elevation_rad();
        let elevation_rad = angles.elevation_rad.clamp(-most_rad, most_rad);
        let [low_rad, high_rad] = self.azimuths_rad(elevation_rad)?;
        let azimuth_rad = angles.azimuth_rad.clamp(low_rad, high_rad);
        Some(DownlinkSunDirection {
            angles: SunAngles { azimuth_rad, elevation_rad },
            earth_ahead: self.earth_ahead,
        })
    }
}

/// Branches in the order in which they are tried.
pub(super) type Branches = [Option<Branch>; 2 * MOST_ANTENNAS];

/// Angles closer than this are one, in rad.
const ROUNDING_RAD: f64 = 1e-12;

#[cfg(test)]
mod tests;
