//! The two attitudes of paper 000: science (pitched about X toward the planet) and default downlink (eq 18); of paper 001,
//! science off-pointed to unload momentum, the camera turned back to nadir; and two axes at targets of their own.

use nalgebra::{ComplexField, Vector3};

use crate::attitude::{MovingFrame, MovingUnit, SunAngles, angle_between_rad, direction_from_angles};
use crate::environment::CartesianState;
use crate::guidance::constraints::keep_in::{KeepIn, within_zone};
use crate::guidance::downlink::default_downlink::{DefaultDownlink, EarthBoresight};
use crate::guidance::downlink::sun_direction::{self, DownlinkRequest, DownlinkSunDirection, both_solutions};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{Moving, direction, fixed, moving, state, value};
use crate::guidance::pointing::aligned::aligned_vectors;
use crate::guidance::pointing::antenna::Antennas;
use crate::guidance::pointing::boresight::Gimbal;
use crate::guidance::pointing::law::PointingVectors;
use crate::math;
use crate::numerics::scalar::Scalar;
use crate::spacecraft::AlignedAxes;

/// Directions from the spacecraft, in EME2000, with their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinesOfSight {
    /// To the Sun.
    pub sun: MovingUnit,
    /// To the planet it orbits, if it orbits one.
    pub planet: Option<MovingUnit>,
    /// To the Earth.
    pub earth: MovingUnit,
    /// From the centre of that planet to the Sun, position and velocity.
    pub sun_from_planet: Option<CartesianState>,
}

impl LinesOfSight {
    /// Directions to bodies with these positions and velocities from the spacecraft; a body at zero distance counts as lying toward +X.
    pub fn to([sun, earth]: [&CartesianState; 2], planet: Option<&CartesianState>) -> Self {
        let unit = |to: &CartesianState| {
            MovingUnit::from_vector(to.position_m, to.velocity_m_s)
                .unwrap_or(MovingUnit { direction: Vector3::x(), rate_1_s: Vector3::zeros() })
        };
        Self { sun: unit(sun), planet: planet.map(unit), earth: unit(earth), sun_from_planet: None }
    }
}

/// Surroundings of the spacecraft at a time, as attitude laws read them.
pub trait Sight {
    /// Directions to Sun, planet and Earth.
    fn lines(&self) -> LinesOfSight;

    /// Positions and motions about the orbit's centre; `None` where directions alone are known.
    fn ephemeris(&self) -> Option<EphemerisAtTime>;
}

impl Sight for EphemerisAtTime {
    fn lines(&self) -> LinesOfSight {
        let [to_sun, to_earth, to_planet] =
            [self.to_sun(), self.to_earth(), self.to_planet()].map(|it| state(&it));
        LinesOfSight {
            sun_from_planet: Some(state(&self.sun)),
            ..LinesOfSight::to([&to_sun, &to_earth], Some(&to_planet))
        }
    }

    fn ephemeris(&self) -> Option<EphemerisAtTime> {
        Some(*self)
    }
}

/// How far science observations pitch the spacecraft, as Sun elevation over (Sun-nadir angle - 90 deg).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScienceRule {
    /// E = clip(gain (angle - 90 deg)): the project science rule; 0.25 is fitted to paper 000's Table 2.
    Scaled {
        /// Sun elevation per angle.
        gain: f64,
    },
    /// +Z to nadir as far as the keep-in zone allows (gain 1).
    Nadir,
    /// Paper 004's attitude (its eq 4): -Y from the planet's centre to the Sun, -Z to the north of the planet's orbit. It
    /// knows no keep-in zone; from the spacecraft the Sun stands off -Y by its parallax.
    PlanetOrbit,
    /// Off-pointed to unload momentum ([`unloading`]).
    Unloading {
        /// Direction of the Sun in the body frame during the present science, and during the slew out of it.
        sun: SunAngles,
        /// The camera's gimbal that keeps nadir.
        gimbal: Gimbal,
    },
    /// Two axes at targets of their own ([`aligned_vectors`]).
    Aligned {
        /// The axes and their targets.
        axes: AlignedAxes,
        /// Zone that keeps the Sun, as in a command of a timeline.
        zone: Option<KeepIn>,
    },
}

impl ScienceRule {
    /// Whether momentum management selects the Sun's direction.
    pub fn unloads(&self) -> bool {
        matches!(self, Self::Unloading { .. })
    }

    /// Whether it reads motions about the orbit's centre as well as directions.
    pub fn reads_motion(&self) -> bool {
        matches!(self, Self::Aligned { .. })
    }

    /// Rule with the Sun in this direction, where it has a direction of its own.
    #[must_use]
    pub fn with_sun(self, sun: SunAngles) -> Self {
        match self {
            Self::Unloading { gimbal, .. } => Self::Unloading { sun, gimbal },
            Self::Scaled { .. } | Self::Nadir | Self::PlanetOrbit | Self::Aligned { .. } => self,
        }
    }

    /// The same with the Sun inside this zone, at any distance from it, where it keeps a zone of its own.
    #[must_use]
    pub fn within(self, keep_in: Option<KeepIn>) -> Self {
        match self {
            Self::Aligned { axes, .. } => {
                let zone = keep_in.map(|zone| KeepIn { distance_m: f64::INFINITY, ..zone });
                Self::Aligned { axes, zone }
            }
            Self::Scaled { .. } | Self::Nadir | Self::PlanetOrbit | Self::Unloading { .. } => self,
        }
    }
}

/// A commanded attitude, and where its law changes form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeCommand {
    /// Body frame and rate.
    pub frame: MovingFrame,
    /// Functions of the geometry alone at whose roots the law takes another form; infinite where there is none. Between two
    /// roots the attitude is smooth.
    pub margins: [f64; 2],
    /// Whether Sun, Earth and antennas do not allow the place of the Sun that was requested, or the keep-in zone not the attitude.
    pub clamped: bool,
    /// Whether a substitute stands in for a target on one line with the other.
    pub degenerate: bool,
    /// When the next motion of a scan begins or ends, in s; infinite without one.
    pub corner_s: f64,
}

impl AttitudeCommand {
    /// Returns the attitude of a law without scans that is kept.
    pub fn new(frame: MovingFrame, margins: [f64; 2]) -> Self {
        Self { frame, margins, clamped: false, degenerate: false, corner_s: f64::INFINITY }
    }
}

/// Margins of a law that has one form only.
const NO_MARGINS: [f64; 2] = [f64::INFINITY; 2];

/// Science attitude: -Y toward the Sun, +Z on the planet's side of it, then pitched about X until the Sun stands
/// at the elevation of `rule`, within +-`elevation_limit_rad`; by other rules as they say. `None`, as of every law here, where a vector
/// that it reads has no direction of its own.
pub fn science(
    lines: &LinesOfSight,
    ephemeris: impl FnOnce() -> Option<EphemerisAtTime>,
    rule: ScienceRule,
    elevation_limit_rad: f64,
) -> Option<AttitudeCommand> {
    let gain = match rule {
        ScienceRule::Scaled { gain } => gain,
        ScienceRule::Nadir => 1.0,
        ScienceRule::PlanetOrbit => return planet_orbit(lines),
        ScienceRule::Unloading { sun, gimbal } => return unloading(lines, sun, &gimbal),
        ScienceRule::Aligned { axes, zone } => return aligned(&axes, zone, &ephemeris()?),
    };
    let (side, angle_rad, angle_rate_rad_s) = lines.sun.perpendicular_part(lines.planet.as_ref()?)?;
    let elevation_rad = gain * (angle_rad - core::f64::consts::FRAC_PI_2);
    let base = MovingFrame::from_yz(&opposite(&lines.sun), &side);
    let margins = [elevation_limit_rad - elevation_rad, elevation_limit_rad + elevation_rad];
    let (elevation_rad, rate_rad_s) = if margins[0] < 0.0 {
        (elevation_limit_rad, 0.0)
    } else if margins[1] < 0.0 {
        (-elevation_limit_rad, 0.0)
    } else {
        (elevation_rad, gain * angle_rate_rad_s)
    };
    // A positive pitch lifts the Sun toward +Z, which is negative elevation.
    Some(AttitudeCommand::new(base.pitched(-elevation_rad, -rate_rad_s), margins))
}

/// Science attitude of paper 001's off-pointing: the Sun at `sun`, turned about the Sun line until nadir lies in the plane that the
/// camera's gimbal sweeps, on the side of its boresight; where the gimbal's range does not reach it, until its nearest bound comes
/// nearest to nadir.
///
/// With the components z and q of the Sun's direction along the boresights at 0 and +90 deg, rho = hypot(q, z) and
/// beta = atan2(-z, q), the camera at the angle phi is off the Sun by theta, cos theta = rho sin(phi - beta): theta between Sun and
/// nadir gives phi.
pub fn unloading(lines: &LinesOfSight, sun: SunAngles, gimbal: &Gimbal) -> Option<AttitudeCommand> {
    let planet = lines.planet.as_ref()?;
    let [to_sun, to_planet] = [&lines.sun, planet].map(|to| moving(to.direction, to.rate_1_s));
    let sun_body = direction_from_angles(sun);
    let (zero, quarter) = (sun_body.dot(&gimbal.zero_body), sun_body.dot(&gimbal.quarter_body));
    let (rho, beta_rad) = (math::hypot(quarter, zero), math::atan2(-zero, quarter));
    let cosine = to_sun.dot(&to_planet);
    let right = core::f64::consts::FRAC_PI_2;
    let [least_rad, greatest_rad] =
        [gimbal.minimum_rad, gimbal.maximum_rad].map(|it| (it - beta_rad).clamp(-right, right));
    let margins = [rho * math::sin(greatest_rad) - cosine.re, cosine.re - rho * math::sin(least_rad)];
    let off_beta = if margins[0] <= 0.0 {
        Moving::constant(greatest_rad)
    } else if margins[1] <= 0.0 {
        Moving::constant(least_rad)
    } else {
        Moving::polar_angle(cosine, ((-cosine + rho) * (cosine + rho)).sqrt())
    };
    let vectors = PointingVectors {
        boresight_body: fixed(sun_body),
        aimpoint: to_sun,
        body_roll: gimbal.boresight(off_beta + beta_rad),
        external_roll: to_planet,
    };
    Some(AttitudeCommand::new(vectors.pointing()?.frame(), margins))
}

/// Attitude of two axes at their targets, the Sun inside the zone; `None` where the target of the first has no direction.
fn aligned(axes: &AlignedAxes, zone: Option<KeepIn>, ephemeris: &EphemerisAtTime) -> Option<AttitudeCommand> {
    let to_sun = ephemeris.to_sun();
    let zone = zone.filter(|zone| value(&to_sun).norm() <= zone.distance_m);
    let kept = within_zone(&aligned_vectors(axes, ephemeris)?, zone.as_ref(), &to_sun, false)?;
    Some(AttitudeCommand {
        clamped: kept.is_moved,
        degenerate: kept.pointing.degenerate,
        ..AttitudeCommand::new(kept.pointing.frame(), [kept.margin, f64::INFINITY])
    })
}

/// Paper 004's attitude; `None` without a planet that moves about the Sun.
fn planet_orbit(lines: &LinesOfSight) -> Option<AttitudeCommand> {
    let sun = lines.sun_from_planet.as_ref()?;
    let toward = MovingUnit::from_vector(sun.position_m, sun.velocity_m_s)?;
    // The normal stands still as long as the Sun alone moves the planet.
    let north = MovingUnit::from_vector(sun.position_m.cross(&sun.velocity_m_s), Vector3::zeros())?;
    let frame = MovingFrame::from_yz(&opposite(&toward), &opposite(&north));
    Some(AttitudeCommand::new(frame, NO_MARGINS))
}

/// Default downlink attitude (eq 18): -Y toward the Sun, the Earth where `law` has it; MESSENGER's in the -X,-Y quadrant of the XY
/// plane while it is less than 90 deg from the Sun, in the +X,+Y quadrant otherwise.
pub fn downlink(lines: &LinesOfSight, law: &DefaultDownlink) -> Option<AttitudeCommand> {
    let cosine = lines.sun.direction.dot(&lines.earth.direction);
    let (sun, earth) = (&lines.sun, &lines.earth);
    let margins = [law.margin(cosine), f64::INFINITY];
    let (from, to) = match law.boresight(cosine) {
        EarthBoresight::Behind => (earth, sun),
        EarthBoresight::Ahead => (sun, earth),
        EarthBoresight::Fixed(boresight_body) => {
            let [external_roll, aimpoint] = [sun, earth].map(|to| moving(to.direction, to.rate_1_s));
            let (boresight_body, body_roll) = (fixed(boresight_body), fixed(-Vector3::y()));
            let vectors = PointingVectors { boresight_body, aimpoint, body_roll, external_roll };
            return Some(AttitudeCommand::new(vectors.pointing()?.frame(), margins));
        }
    };
    let normal = from.direction.cross(&to.direction);
    let normal_rate = from.rate_1_s.cross(&to.direction) + from.direction.cross(&to.rate_1_s);
    if normal.norm() < 1e-9 {
        return None;
    }
    let z = MovingUnit::from_vector(normal, normal_rate)?;
    Some(AttitudeCommand::new(MovingFrame::from_yz(&opposite(sun), &z), margins))
}

/// Downlink attitude with the Sun off -Y (eqs 19 to 22): the Sun at `place`, the Earth in the XY plane on that side of it.
pub fn downlink_toward(lines: &LinesOfSight, place: &DownlinkSunDirection) -> Option<AttitudeCommand> {
    let [to_sun, to_earth] = [&lines.sun, &lines.earth].map(|to| moving(to.direction, to.rate_1_s));
    let solutions = both_solutions(&to_sun, &to_earth, place.angles)?;
    let [behind, ahead] = solutions.azimuths;
    let vectors = PointingVectors {
        boresight_body: solutions.sun_body,
        aimpoint: to_sun,
        body_roll: direction(if place.earth_ahead { ahead } else { behind }, Moving::constant(0.0)),
        external_roll: to_earth,
    };
    let pointing = vectors.pointing()?;
    // Beyond it no attitude has the Sun there and the Earth in the plane.
    let sine = math::sin(angle_between_rad(&lines.sun.direction, &lines.earth.direction));
    let margin = sine - math::sin(place.angles.elevation_rad).abs();
    let command = AttitudeCommand::new(pointing.frame(), [margin, f64::INFINITY]);
    Some(AttitudeCommand { clamped: margin < 0.0, ..command })
}

/// Downlink attitude with the Sun at a place that is requested, as near as Sun, Earth and antennas allow.
pub fn downlink_with(lines: &LinesOfSight, sun: SunAngles, antennas: &Antennas) -> Option<AttitudeCommand> {
    let [to_sun, to_earth] = [&lines.sun, &lines.earth].map(|to| moving(to.direction, to.rate_1_s));
    let request = DownlinkRequest { sun_body: sun, ..DownlinkRequest::default() };
    let found = sun_direction::downlink(&to_sun, &to_earth, antennas, &request)?;
    let command = AttitudeCommand::new(found.vectors.pointing()?.frame(), found.margins);
    Some(AttitudeCommand { clamped: found.clamped, ..command })
}

/// Fallback with nothing but the Sun: -Y toward it, +Z toward the north of EME2000 as far as possible (toward the
/// equinox where the Sun stands at the pole).
pub fn sun_pointing(lines: &LinesOfSight) -> AttitudeCommand {
    let y = opposite(&lines.sun);
    let toward = |direction| {
        let fixed = MovingUnit { direction, rate_1_s: Vector3::zeros() };
        lines.sun.perpendicular_part(&fixed)
    };
    let side = toward(Vector3::z()).or_else(|| toward(Vector3::x()));
    let z = side.map_or(lines.sun, |(side, _, _)| side);
    AttitudeCommand::new(MovingFrame::from_yz(&y, &z), NO_MARGINS)
}

fn opposite(unit: &MovingUnit) -> MovingUnit {
    MovingUnit { direction: -unit.direction, rate_1_s: -unit.rate_1_s }
}

#[cfg(test)]
mod tests;
