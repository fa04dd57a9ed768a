//! Start, target, Sun and Earth of a turn as directions in EME2000, and the two ways between them.

use core::{
    f64::consts::{FRAC_PI_2, PI},
    ops::Neg,
};

use nalgebra::Vector3;
use physics::{
    attitude::{Quaternion, angle_between_rad},
    bodies::Body,
    environment::{dates, ephemeris::Ephemeris, frames},
    spin::{geometry::L1Orbit, spinner::Spinner},
};

use super::{PlanError, TurnRequest, options::RightAscensionDeclination, started};

/// Greatest turn that is planned. A burn is steered by the part of its target's direction across the momentum, which goes to
/// 0 as the turn nears half a circle.
pub const MAX_ANGLE_DEG: f64 = 175.0;

/// Samples of a great circle.
const SAMPLES: u32 = 200;
/// A Sun this close to the axis or its opposite has no azimuth about it, in rad.
const ALONG_RAD: f64 = 1e-6;

/// A turn that comes no closer to the Sun goes round it, in rad.
const NO_CLOSER_RAD: f64 = 1e-9;

/// Start and end of a turn, unit vectors in EME2000.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnGeometry {
    /// Spin axis at the start.
    pub axis_inertial: Vector3<f64>,
    /// Direction that it is to end at.
    pub target_inertial: Vector3<f64>,
    /// Toward the Sun.
    pub sun_inertial: Vector3<f64>,
    /// Toward the Earth, where it is known.
    pub earth_inertial: Option<Vector3<f64>>,
    /// Source of the directions of Sun and Earth, in words.
    pub origin: String,
}

/// A way from the start to the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Its length, in rad.
    pub length_rad: f64,
    /// Least and greatest angle to the Sun on it, in rad.
    pub sun_angle_rad: (f64, f64),
    /// Way about the axis at its beginning and end, right-handed from the Sun, in rad.
    pub heading_rad: (f64, f64),
}

impl TurnGeometry {
    /// From the flags and the spacecraft's file.
    ///
    /// # Errors
    /// Flags that leave a direction open, or that contradict each other.
    pub fn new(request: &TurnRequest, spinner: &Spinner) -> Result<Self, PlanError> {
        let refuse = |flag, what: &str| PlanError::Direction { flag, what: what.to_owned() };
        let date = request.date.map(|epoch_s| seen_from_l1(&spinner.l1_orbit, epoch_s));
        let given_sun = request.sun.map(inertial).or(date.map(|(sun, _)| sun));
        let earth_inertial = request.earth.map(inertial).or(date.map(|(_, earth)| earth));
        let given_axis = request.from.map(inertial).or_else(|| started::axis_inertial(spinner));
        let origin = match (request.date, request.sun, request.earth) {
            (Some(epoch_s), sun, earth) => {
                let of_date = match (sun, earth) {
                    (None, None) => "Sun and Earth",
                    (Some(_), None) => "Earth",
                    (None, Some(_)) => "Sun",
                    (Some(_), Some(_)) => "neither Sun nor Earth",
                };
                format!("{of_date} from the Sun-Earth L1 point at {}", dates::utc(epoch_s))
            }
            (None, None, None) => "Sun by --sun-angle".to_owned(),
            (None, ..) => "Sun and Earth as given".to_owned(),
        };
        if given_axis.is_none()
            && (given_sun.is_some() || request.target.is_some() || earth_inertial.is_some())
        {
            return Err(refuse(
                "--from",
                "where the spin axis stands is not given; allowed: right ascension and declination in deg, or start.q in \
                 the [start] of the spacecraft's file",
            ));
        }
        let axis_inertial = given_axis.unwrap_or_else(Vector3::z);
        if let Some(target) = request.target {
            let sun_inertial = given_sun.ok_or_else(|| {
                refuse("--target", "the Sun is not given; allowed: --date or --sun beside it")
            })?;
            let target_inertial = inertial(target);
            let apart_deg = angle_between_rad(&axis_inertial, &target_inertial).to_degrees();
            if !(apart_deg > 0.0 && apart_deg <= MAX_ANGLE_DEG) {
                let allowed = format!("above 0 to {} deg", MAX_ANGLE_DEG);
                let what =
                    format!("found {apart_deg:.4} deg from the spin axis at the start, allowed: {allowed}");
                return Err(refuse("--target", &what));
            }
            return Ok(Self { axis_inertial, target_inertial, sun_inertial, earth_inertial, origin });
        }
        let direction_rad = request.direction_deg.to_radians();
        let sun_inertial = match given_sun {
            Some(sun) => sun,
            // The turn goes toward +X where the axis is +Z.
            None => {
                let across = tangent(&axis_inertial, &Vector3::x()).unwrap_or_else(Vector3::y);
                turned(
                    &axis_inertial,
                    &about(&axis_inertial, &across, -direction_rad),
                    request.sun_angle_deg.to_radians(),
                )
            }
        };
        let toward_sun = tangent(&axis_inertial, &sun_inertial).ok_or_else(|| {
            refuse(
                "--direction",
                "the Sun stands on the spin axis, from where there is no way toward it; allowed: --target",
            )
        })?;
        let toward = about(&axis_inertial, &toward_sun, direction_rad);
        let target_inertial = turned(&axis_inertial, &toward, request.angle_deg.to_radians());
        Ok(Self { axis_inertial, target_inertial, sun_inertial, earth_inertial, origin })
    }

    /// From start to target, in rad.
    pub fn angle_rad(&self) -> f64 {
        angle_between_rad(&self.axis_inertial, &self.target_inertial)
    }

    /// From the spin axis at the start to the Sun, in rad.
    pub fn sun_angle_rad(&self) -> f64 {
        angle_between_rad(&self.axis_inertial, &self.sun_inertial)
    }

    /// Direction on the great circle to the target, `angle_rad` from the start.
    pub fn on_great_circle(&self, angle_rad: f64) -> Vector3<f64> {
        let toward = tangent(&self.axis_inertial, &self.target_inertial).unwrap_or_else(Vector3::x);
        turned(&self.axis_inertial, &toward, angle_rad)
    }

    /// A burn goes no farther than its target, and steers best with the target well away: as far beyond the end of the turn
    /// as the turn's beginning is from its opposite.
    pub fn burn_target_inertial(&self) -> Vector3<f64> {
        self.on_great_circle(FRAC_PI_2 + 0.5 * self.angle_rad())
    }

    /// Attitude whose body vector `spin_axis_body` is the spin axis at the start.
    pub fn attitude(&self, spin_axis_body: &Vector3<f64>) -> Quaternion {
        let across = spin_axis_body.cross(&self.axis_inertial);
        let angle_rad = angle_between_rad(spin_axis_body, &self.axis_inertial);
        let any = Vector3::x() - spin_axis_body * spin_axis_body.x;
        let axis = across.try_normalize(1e-12).unwrap_or_else(|| any.normalize());
        Quaternion::turn(&axis, angle_rad)
    }

    /// The great circle: the shortest way, by delays that change from pulse to pulse.
    pub fn great_circle(&self) -> Way {
        let length_rad = self.angle_rad();
        let mut seen = (f64::INFINITY, 0.0_f64);
        for k in 0..=SAMPLES {
            let at = self.on_great_circle(length_rad * f64::from(k) / f64::from(SAMPLES));
            let sun_rad = angle_between_rad(&at, &self.sun_inertial);
            seen = (seen.0.min(sun_rad), seen.1.max(sun_rad));
        }
        let end = self.heading_rad(&self.target_inertial, &-self.axis_inertial);
        let heading_rad = (self.heading_rad(&self.axis_inertial, &self.target_inertial), end);
        Way { length_rad, sun_angle_rad: seen, heading_rad }
    }

    /// The rhumb line about the Sun: one way from the Sun all along, by one delay after each Sun crossing. `None` where
    /// the Sun is on the axis.
    pub fn rhumb_line(&self) -> Option<Way> {
        let course = self.rhumb_course()?;
        let (start_rad, end_rad) = course.sun_angle_rad;
        let closer_rad = start_rad - end_rad;
        let scale =
            if closer_rad.abs() > NO_CLOSER_RAD { closer_rad / course.stretch } else { start_rad.sin() };
        // Azimuth about the Sun falls where that about an axis which looks at it grows.
        let heading_rad = (-course.azimuth_rad).atan2(course.stretch);
        Some(Way {
            length_rad: libm::hypot(course.azimuth_rad * scale, closer_rad),
            sun_angle_rad: (start_rad.min(end_rad), start_rad.max(end_rad)),
            heading_rad: (heading_rad, heading_rad),
        })
    }

    /// Direction on the rhumb line, `share` of the way (0 to 1) on Mercator's map.
    pub fn on_rhumb_line(&self, share: f64) -> Option<Vector3<f64>> {
        let course = self.rhumb_course()?;
        let sun_angle_rad =
            2.0 * (mercator(course.sun_angle_rad.0) + share * course.stretch).neg().exp().atan();
        let across = about(&self.sun_inertial, &course.first, share * course.azimuth_rad);
        Some(turned(&self.sun_inertial, &across, sun_angle_rad))
    }

    fn rhumb_course(&self) -> Option<RhumbCourse> {
        let first = tangent(&self.sun_inertial, &self.axis_inertial)?;
        let last = tangent(&self.sun_inertial, &self.target_inertial)?;
        let end_rad = angle_between_rad(&self.target_inertial, &self.sun_inertial);
        let sun_angle_rad = (self.sun_angle_rad(), end_rad);
        Some(RhumbCourse {
            azimuth_rad: self.sun_inertial.dot(&first.cross(&last)).atan2(first.dot(&last)),
            stretch: mercator(end_rad) - mercator(sun_angle_rad.0),
            sun_angle_rad,
            first,
        })
    }

    /// Way from `at` to `to` about the axis `at`, right-handed from the Sun; NaN where there is none.
    fn heading_rad(&self, at: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
        match (tangent(at, &self.sun_inertial), tangent(at, to)) {
            (Some(sun), Some(to)) => at.dot(&sun.cross(&to)).atan2(sun.dot(&to)),
            _ => f64::NAN,
        }
    }
}

/// A rhumb line on Mercator's map about the Sun, where it is straight.
struct RhumbCourse {
    /// Position at the start, about the Sun.
    first: Vector3<f64>,
    /// From start to end about the Sun, in rad.
    azimuth_rad: f64,
    /// From start to end toward the Sun, on the map.
    stretch: f64,
    /// At start and end, in rad.
    sun_angle_rad: (f64, f64),
}

/// Distance on Mercator's map, growing toward the Sun, of an angle from it.
fn mercator(sun_angle_rad: f64) -> f64 {
    -(0.5 * sun_angle_rad).tan().ln()
}

/// Right ascension from 0 to below 360 and declination of a direction, in deg.
pub fn right_ascension_declination(direction: &Vector3<f64>) -> RightAscensionDeclination {
    let right_ascension_deg = direction.y.atan2(direction.x).to_degrees().rem_euclid(360.0);
    let declination_deg = direction.z.atan2(libm::hypot(direction.x, direction.y)).to_degrees();
    // A small negative angle rounds to 360.
    let right_ascension_deg = if right_ascension_deg < 360.0 { right_ascension_deg } else { 0.0 };
    RightAscensionDeclination { right_ascension_deg, declination_deg }
}

fn inertial(given: RightAscensionDeclination) -> Vector3<f64> {
    frames::direction(given.right_ascension_deg.to_radians(), given.declination_deg.to_radians())
}

/// Sun and Earth from the Sun-Earth L1 point of that date: the Lissajous motion about it has no date in the file.
fn seen_from_l1(orbit: &L1Orbit, epoch_s: f64) -> (Vector3<f64>, Vector3<f64>) {
    let earth_m = Ephemeris::default().state(Body::Earth, epoch_s).position_m;
    let from_sun = earth_m.normalize();
    // L1 stands on the line between them.
    let toward_earth = if earth_m.norm() > orbit.earth_l1_distance_m { from_sun } else { -from_sun };
    (-from_sun, toward_earth)
}

/// Unit vector across `pole` toward `direction`.
fn tangent(pole: &Vector3<f64>, direction: &Vector3<f64>) -> Option<Vector3<f64>> {
    let across = direction - pole * pole.dot(direction);
    let angle_rad = angle_between_rad(pole, direction);
    (angle_rad > ALONG_RAD && angle_rad < PI - ALONG_RAD).then(|| across.normalize())
}

/// `across` turned about `pole`.
fn about(pole: &Vector3<f64>, across: &Vector3<f64>, angle_rad: f64) -> Vector3<f64> {
    let (sine, cosine) = angle_rad.sin_cos();
    across * cosine + pole.cross(across) * sine
}

/// `pole` turned toward `across`.
fn turned(pole: &Vector3<f64>, across: &Vector3<f64>, angle_rad: f64) -> Vector3<f64> {
    let (sine, cosine) = angle_rad.sin_cos();
    pole * cosine + across * sine
}
