//! Downlink: a phased-array antenna at the Earth, the Sun where the momentum wants it (paper 000, eqs 14 to 22).
//!
//! The antennas lie in the XY plane; one on the sunshade covers the azimuths -90 to 0 deg, one on the back 90 to 180 deg.
//! With the Sun at azimuth A and elevation E and the Earth in the XY plane, theta from the Sun, the Earth's azimuth is
//! A + delta or A - delta, cos theta = cos E cos delta, which needs |E| <= min(theta, 180 deg - theta): E is cut there
//! (the paper names the first bound alone). Of both azimuths:
//!
//! - the one inside a quadrant is taken; of two, A - delta for theta below 90 deg and A + delta beyond, which at A = E = 0
//!   is the default attitude (eq 18);
//! - where none is inside, the one nearest to a quadrant gives the antenna. The antenna looks along the quadrant's bound,
//!   and the Sun comes as near to the asked place as the Earth there allows.

use nalgebra::ComplexField;

use super::keep_in::direction;
use super::law::{Pointing, PointingVectors};
use super::moving::{Moving, MovingVector, PARALLEL_RAD, fixed, unit, value};
use super::surroundings::Surroundings;
use crate::attitude::{SunAngles, angle_between_rad, direction_from_angles};
use crate::numerics::scalar::Scalar;

/// An azimuth this little outside a quadrant counts as inside, in rad.
const BOUND_RAD: f64 = 1e-12;

/// A phased-array antenna.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Antenna {
    /// None points at the Earth.
    #[default]
    None,
    /// On the sunshade: azimuth -90 to 0 deg.
    Sunshade,
    /// On the back: azimuth 90 to 180 deg.
    Back,
}

/// What a downlink attitude is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DownlinkRequest {
    /// Azimuth of the antenna's boresight, with -Y rolled toward the Sun; `None`: as the Sun's place needs it.
    pub antenna_azimuth_rad: Option<f64>,
    /// Where the Sun is to stand in the body frame; zero is on -Y. Read where no azimuth is given.
    pub sun_body: SunAngles,
}

/// A downlink attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Downlink {
    /// The antenna at the Earth, the Sun toward its place.
    pub vectors: PointingVectors,
    /// The antenna that looks at the Earth.
    pub antenna: Antenna,
    /// Where it looks, in its quadrant.
    pub antenna_azimuth_rad: f64,
    /// Whether elevation or antenna stands at a bound, off what was asked.
    pub clamped: bool,
}

/// Where the Earth can stand in the XY plane for one place of the Sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthAzimuths {
    /// A - delta and A + delta, in rad, in no particular turn.
    pub azimuths: [Moving; 2],
    /// Direction of the Sun in the body frame, its elevation cut where it had to be.
    pub sun_body: MovingVector,
    /// Whether it was cut.
    pub clamped: bool,
    /// Cosine of the angle between Sun and Earth.
    pub cosine: f64,
}

impl Antenna {
    /// Both antennas.
    pub const ALL: [Self; 2] = [Self::Sunshade, Self::Back];

    /// Middle of the quadrant; `None` for no antenna.
    fn middle_rad(self) -> Option<f64> {
        use core::f64::consts::FRAC_PI_4;
        match self {
            Self::None => None,
            Self::Sunshade => Some(-FRAC_PI_4),
            Self::Back => Some(3.0 * FRAC_PI_4),
        }
    }

    /// The azimuth of the quadrant nearest to `azimuth_rad`, and how far outside that one is, both in rad.
    fn nearest(self, azimuth_rad: f64) -> Option<(f64, f64)> {
        use core::f64::consts::{FRAC_PI_4, PI, TAU};
        let middle_rad = self.middle_rad()?;
        let off_rad = (azimuth_rad - middle_rad + PI).rem_euclid(TAU) - PI;
        let outside_rad = off_rad.abs() - FRAC_PI_4;
        Some((middle_rad + off_rad.clamp(-FRAC_PI_4, FRAC_PI_4), outside_rad.max(0.0)))
    }
}

/// The antenna nearest to an azimuth, its own nearest azimuth, and the distance of both in rad.
fn nearest_antenna(azimuth_rad: f64) -> (Antenna, f64, f64) {
    let of = |antenna: Antenna| antenna.nearest(azimuth_rad).map(|(at, outside)| (antenna, at, outside));
    let none = (Antenna::None, azimuth_rad, f64::INFINITY);
    Antenna::ALL.into_iter().filter_map(of).fold(none, |best, next| if next.2 < best.2 { next } else { best })
}

/// The attitude that points an antenna at the Earth; `None` where Sun or Earth has no direction.
pub fn downlink(
    to_sun: &MovingVector,
    to_earth: &MovingVector,
    request: &DownlinkRequest,
) -> Option<Downlink> {
    let solutions = both_solutions(to_sun, to_earth, request.sun_body)?;
    let (azimuth, sun_body, cut) = match request.antenna_azimuth_rad {
        Some(azimuth_rad) => {
            let minus_y = fixed(direction_from_angles(SunAngles::default()));
            (Moving::constant(azimuth_rad), minus_y, false)
        }
        None => (solutions.preferred(), solutions.sun_body, solutions.clamped),
    };
    let (antenna, antenna_azimuth_rad, outside_rad) = nearest_antenna(azimuth.re);
    let at_bound = outside_rad > BOUND_RAD;
    let boresight_azimuth = if at_bound { Moving::constant(antenna_azimuth_rad) } else { azimuth };
    Some(Downlink {
        vectors: PointingVectors {
            boresight_body: direction(boresight_azimuth, Moving::constant(0.0)),
            aimpoint: *to_earth,
            body_roll: sun_body,
            external_roll: *to_sun,
        },
        antenna,
        antenna_azimuth_rad,
        clamped: cut || at_bound,
    })
}

/// Both azimuths of the Earth in the XY plane with the Sun at `sun_body` (eq 20); `None` where one has no direction.
pub fn both_solutions(
    to_sun: &MovingVector,
    to_earth: &MovingVector,
    sun_body: SunAngles,
) -> Option<EarthAzimuths> {
    let (sun, earth) = (unit(to_sun)?, unit(to_earth)?);
    let cosine = sun.dot(&earth);
    let normal = sun.cross(&earth);
    let squared = normal.dot(&normal);
    // Sun and Earth in line: the plane of both is the law's fallback, theta stays.
    let sine = if squared.re > PARALLEL_RAD * PARALLEL_RAD { squared.sqrt() } else { Moving::constant(0.0) };
    let azimuth = Moving::constant(sun_body.azimuth_rad);
    let sine_elevation = sun_body.elevation_rad.sin();
    let above = sine_elevation.abs() >= sine.re;
    let (elevation, delta) = if above {
        // At the bound the great circle from the Sun meets the XY plane at a right angle, or on the far side.
        let bound = Moving::polar_angle(sine, cosine.abs()) * sine_elevation.signum();
        (bound, Moving::constant(if cosine.re < 0.0 { core::f64::consts::PI } else { 0.0 }))
    } else {
        let root = ((sine - sine_elevation) * (sine + sine_elevation)).sqrt();
        (Moving::constant(sun_body.elevation_rad), Moving::polar_angle(root, cosine))
    };
    Some(EarthAzimuths {
        azimuths: [azimuth - delta, azimuth + delta],
        sun_body: direction(azimuth, elevation),
        clamped: sine_elevation.abs() > sine.re,
        cosine: cosine.re,
    })
}

impl EarthAzimuths {
    /// The one inside a quadrant, or nearest to one; where both are inside, that on the default attitude's side.
    fn preferred(&self) -> Moving {
        let [minus, plus] = self.azimuths;
        let outside_rad = |azimuth: Moving| {
            let (_, _, outside_rad) = nearest_antenna(azimuth.re);
            if outside_rad <= BOUND_RAD { 0.0 } else { outside_rad }
        };
        let (default, other) = if self.cosine > 0.0 { (minus, plus) } else { (plus, minus) };
        if outside_rad(other) < outside_rad(default) { other } else { default }
    }
}

/// What a link needs; the widths are assumptions where the papers differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkLimits {
    /// Least angle between Sun and Earth seen from the spacecraft, in rad.
    pub sun_separation_rad: f64,
    /// How far the antennas' coverage extends above and below the XY plane and past the ends of their quadrants, in rad
    /// (paper 001: 2 deg, half of a fan of 15 by 4 deg).
    pub coverage_rad: f64,
}

/// Geometry of the link to the Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Angle between Sun and Earth seen from the spacecraft, in rad.
    pub sun_separation_rad: f64,
    /// Whether the Earth is in the antenna's coverage, far enough from the Sun and not behind the planet.
    pub available: bool,
}

/// The link in an attitude; `None` where Sun or Earth has no direction.
pub fn link(
    surroundings: &Surroundings,
    pointing: &Pointing,
    antenna: Antenna,
    limits: &LinkLimits,
) -> Option<Link> {
    let earth = unit(&surroundings.to_earth())?;
    let sun = unit(&surroundings.to_sun())?;
    let sun_separation_rad = angle_between_rad(&value(&sun), &value(&earth));
    let earth_body = SunAngles::of(&value(&pointing.to_body(&earth)));
    let coverage_rad = limits.coverage_rad + BOUND_RAD;
    let covered = earth_body.elevation_rad.abs() <= coverage_rad
        && antenna.nearest(earth_body.azimuth_rad).is_some_and(|(_, outside)| outside <= coverage_rad);
    let available = covered
        && sun_separation_rad > limits.sun_separation_rad
        && !behind_planet(surroundings, &earth);
    Some(Link { sun_separation_rad, available })
}

/// Whether the line to the Earth meets the sphere of the planet's greatest radius on its way.
fn behind_planet(surroundings: &Surroundings, earth: &MovingVector) -> bool {
    let to_planet_m = value(&surroundings.to_planet());
    let earth = value(earth);
    let nearest_m = to_planet_m.dot(&earth);
    nearest_m > 0.0
        && nearest_m < value(&surroundings.to_earth()).norm()
        && to_planet_m.cross(&earth).norm() < surroundings.planet.radii_m.max()
}

#[cfg(test)]
mod tests {
    //! Where Sun and Earth stand in the body frame of each attitude.
    use std::f64::consts::{FRAC_PI_2, PI};

    use nalgebra::Vector3;

    use super::super::moving::moving;
    use super::super::surroundings::TargetPlanet;
    use super::super::test_geometry::{Motion, Random, difference_rad_s};
    use super::*;
    use crate::bodies::Body;

    /// Azimuth in -90..0 or 90..180 deg, typed anew, -180 counting as 180.
    fn in_quadrant(antenna: Antenna, azimuth_rad: f64) -> bool {
        let sine = azimuth_rad.sin();
        let cosine = azimuth_rad.cos();
        match antenna {
            Antenna::Sunshade => sine <= 1e-12 && cosine >= -1e-12,
            Antenna::Back => sine >= -1e-12 && cosine <= 1e-12,
            Antenna::None => false,
        }
    }

    /// Sun and Earth at an angle of each other, down to almost in line, in a random orientation.
    fn random_lines(random: &mut Random) -> [MovingVector; 2] {
        let small = 10_f64.powf(random.within(-8.0, 0.0));
        let any = random.within(0.0, PI);
        let theta_rad = random.one_of(&[any, any, any, small, PI - small]);
        let sun = random.direction();
        let across = sun.cross(&random.direction()).normalize();
        let earth = sun * theta_rad.cos() + across * theta_rad.sin();
        [moving(sun * 5e10, random.direction() * 5e4), moving(earth * 1e11, random.direction() * 3e4)]
    }

    #[test]
    fn sun_at_its_angles_and_earth_in_the_plane() {
        let mut random = Random(21);
        let mut seen = [0; 4];
        let (mut sun_worst_rad, mut earth_worst_rad) = (0.0_f64, 0.0_f64);
        for _ in 0..100_000 {
            let [to_sun, to_earth] = random_lines(&mut random);
            let mut limit_rad = |most_rad: f64| random.within(-most_rad, most_rad);
            let sun_body = SunAngles { azimuth_rad: limit_rad(0.4), elevation_rad: limit_rad(0.4) };
            let request = DownlinkRequest { antenna_azimuth_rad: None, sun_body };
            let found = downlink(&to_sun, &to_earth, &request).unwrap();
            let pointing = found.vectors.pointing().unwrap();
            let body = |v: &MovingVector| value(&pointing.to_body(&unit(v).unwrap()));
            let (sun, earth) = (body(&to_sun), body(&to_earth));
            let theta_rad = angle_between_rad(&value(&to_sun), &value(&to_earth));
            let most_rad = theta_rad.min(PI - theta_rad);

            earth_worst_rad = earth_worst_rad.max(earth.z.abs());
            let earth_azimuth_rad = SunAngles::of(&earth).azimuth_rad;
            assert!(in_quadrant(found.antenna, earth_azimuth_rad), "{found:?} {earth_azimuth_rad}");
            assert!((found.antenna_azimuth_rad - earth_azimuth_rad).sin().abs() < 1e-12);
            let cut_rad = sun_body.elevation_rad.clamp(-most_rad, most_rad);
            let asked = direction_from_angles(SunAngles { elevation_rad: cut_rad, ..sun_body });
            let off_rad = angle_between_rad(&sun, &asked);
            if found.clamped && cut_rad == sun_body.elevation_rad || off_rad > 1e-9 {
                // None in a quadrant: the Earth at a bound, and neither azimuth that keeps the Sun inside.
                assert!(found.clamped);
                assert!((2.0 * earth_azimuth_rad).sin().abs() < 1e-12);
                let delta_rad = (theta_rad.cos() / cut_rad.cos()).clamp(-1.0, 1.0).acos();
                for azimuth_rad in [sun_body.azimuth_rad - delta_rad, sun_body.azimuth_rad + delta_rad] {
                    assert!(!Antenna::ALL.into_iter().any(|antenna| {
                        in_quadrant(antenna, azimuth_rad) && (2.0 * azimuth_rad).sin().abs() > 1e-7
                    }));
                }
                seen[3] += 1;
            } else {
                sun_worst_rad = sun_worst_rad.max(off_rad);
                seen[if found.clamped { 2 } else { usize::from(found.antenna == Antenna::Back) }] += 1;
            }
        }
        assert!(sun_worst_rad < 1e-12 && earth_worst_rad < 1e-12, "{sun_worst_rad:e} {earth_worst_rad:e}");
        assert!(seen.iter().all(|count| *count > 2000), "{seen:?}");
    }

    #[test]
    fn the_default_puts_the_sun_on_minus_y_and_the_earth_by_its_distance() {
        let mut random = Random(22);
        for _ in 0..10_000 {
            let [to_sun, to_earth] = random_lines(&mut random);
            let found = downlink(&to_sun, &to_earth, &DownlinkRequest::default()).unwrap();
            let theta_rad = angle_between_rad(&value(&to_sun), &value(&to_earth));
            let (antenna, azimuth_rad) =
                if theta_rad < FRAC_PI_2 { (Antenna::Sunshade, -theta_rad) } else { (Antenna::Back, theta_rad) };
            assert_eq!(found.antenna, antenna);
            assert!((found.antenna_azimuth_rad - azimuth_rad).abs() < 1e-12 && !found.clamped);
            let sun = value(&found.vectors.pointing().unwrap().to_body(&unit(&to_sun).unwrap()));
            assert!((sun + Vector3::y()).norm() < 1e-12, "{sun} {theta_rad}");
        }
    }

    /// Earth azimuths in deg by hand for Sun azimuth and distance: none, one or two in a quadrant.
    #[test]
    fn one_two_or_no_azimuth_lies_in_a_quadrant() {
        for (sun_deg, theta_deg, expected_deg, antenna, clamped) in [
            (0.0, 30.0, -30.0, Antenna::Sunshade, false),
            (0.0, 150.0, 150.0, Antenna::Back, false),
            (10.0, 5.0, 0.0, Antenna::Sunshade, true),
            (10.0, 85.0, -75.0, Antenna::Sunshade, false),
            (10.0, 95.0, 105.0, Antenna::Back, false),
            (-10.0, 5.0, -15.0, Antenna::Sunshade, false),
            (-10.0, 85.0, -90.0, Antenna::Sunshade, true),
            (-10.0, 95.0, 90.0, Antenna::Back, true),
            (-10.0, 175.0, 165.0, Antenna::Back, false),
            (10.0, 178.0, 180.0, Antenna::Back, true),
            (10.0, 165.0, 175.0, Antenna::Back, false),
        ] {
            let theta_rad = f64::to_radians(theta_deg);
            let earth = fixed(Vector3::new(theta_rad.cos(), theta_rad.sin(), 0.0));
            let sun_body = SunAngles { azimuth_rad: f64::to_radians(sun_deg), elevation_rad: 0.0 };
            let request = DownlinkRequest { antenna_azimuth_rad: None, sun_body };
            let found = downlink(&fixed(Vector3::x()), &earth, &request).unwrap();
            let off_deg = found.antenna_azimuth_rad.to_degrees() - expected_deg;
            assert!(off_deg.abs() < 1e-10, "{sun_deg} {theta_deg}: {found:?}");
            assert_eq!((found.antenna, found.clamped), (antenna, clamped), "{sun_deg} {theta_deg}");
        }
    }

    #[test]
    fn an_asked_azimuth_looks_at_the_earth_or_its_nearest_bound_does() {
        let mut random = Random(23);
        for _ in 0..10_000 {
            let [to_sun, to_earth] = random_lines(&mut random);
            let azimuth_rad = random.within(-PI, PI);
            let request =
                DownlinkRequest { antenna_azimuth_rad: Some(azimuth_rad), ..DownlinkRequest::default() };
            let found = downlink(&to_sun, &to_earth, &request).unwrap();
            let degrees = azimuth_rad.to_degrees();
            let (antenna, expected_deg) = match degrees {
                d if (-90.0..=0.0).contains(&d) => (Antenna::Sunshade, d),
                d if d >= 90.0 => (Antenna::Back, d),
                d if d < -135.0 => (Antenna::Back, 180.0),
                d if d < -90.0 => (Antenna::Sunshade, -90.0),
                d if d <= 45.0 => (Antenna::Sunshade, 0.0),
                _ => (Antenna::Back, 90.0),
            };
            assert_eq!((found.antenna, found.clamped), (antenna, degrees != expected_deg && (degrees - expected_deg).abs() > 1e-9));
            assert!((found.antenna_azimuth_rad.to_degrees() - expected_deg).abs() < 1e-10);
            let pointing = found.vectors.pointing().unwrap();
            let earth = value(&pointing.to_body(&unit(&to_earth).unwrap()));
            let at = SunAngles { azimuth_rad: found.antenna_azimuth_rad, elevation_rad: 0.0 };
            assert!((earth - direction_from_angles(at)).norm() < 1e-12);
            // -Y and the Sun on one side of the boresight, in one plane with it.
            let sun = value(&pointing.to_body(&unit(&to_sun).unwrap()));
            assert!(pointing.degenerate || sun.z.abs() < 1e-12);
        }
    }

    #[test]
    fn the_rate_is_the_difference_of_the_attitude() {
        let mut random = Random(24);
        let mut compared = 0;
        for _ in 0..3000 {
            let motions = [Motion::random(&mut random), Motion::random(&mut random)];
            let mut limit_rad = |most_rad: f64| random.within(-most_rad, most_rad);
            let sun_body = SunAngles { azimuth_rad: limit_rad(0.4), elevation_rad: limit_rad(0.4) };
            let request = DownlinkRequest { antenna_azimuth_rad: None, sun_body };
            let at = |time_s: f64| {
                let [to_sun, to_earth] = motions.map(|motion| motion.at(time_s));
                let found = downlink(&to_sun, &to_earth, &request)?;
                Some((found.vectors.pointing()?, found.antenna, found.clamped))
            };
            let (pointing, antenna, clamped) = at(0.0).unwrap();
            let found = pointing.frame().rate_body_rad_s;
            let step_s = (3e-4 / found.norm()).min(1.0);
            let same = |t: f64| at(t).filter(|x| (x.1, x.2) == (antenna, clamped)).map(|x| x.0);
            let Some(expected) = difference_rad_s(same, step_s) else { continue };
            let error = (found - expected).norm() / expected.norm().max(1e-5);
            assert!(error < 1e-7, "{error:e} {request:?} {pointing:?}");
            compared += 1;
        }
        assert!(compared > 2900, "{compared}");
    }

    #[test]
    fn in_line_the_attitude_is_finite_and_nothing_without_direction() {
        let sun = moving(Vector3::x(), Vector3::y() * 1e-4);
        for earth in [sun, -sun, fixed(Vector3::x()), fixed(-Vector3::x())] {
            for elevation_rad in [0.0, 0.2, -0.2] {
                let sun_body = SunAngles { azimuth_rad: 0.1, elevation_rad };
                let request = DownlinkRequest { antenna_azimuth_rad: None, sun_body };
                let found = downlink(&sun, &earth, &request).unwrap();
                let pointing = found.vectors.pointing().unwrap();
                assert!(pointing.degenerate && pointing.frame().rate_body_rad_s.iter().all(|x| x.is_finite()));
            }
        }
        assert!(downlink(&MovingVector::zeros(), &sun, &DownlinkRequest::default()).is_none());
        assert!(downlink(&sun, &MovingVector::zeros(), &DownlinkRequest::default()).is_none());
    }

    #[test]
    fn the_link_needs_antenna_distance_from_the_sun_and_a_free_line() {
        let planet = TargetPlanet::of(Body::Mercury.data());
        let radius_m = planet.radii_m.x;
        let degrees = f64::to_radians;
        let limits = LinkLimits { sun_separation_rad: degrees(3.0), coverage_rad: degrees(2.0) };
        let around = |position: Vector3<f64>, theta_deg: f64| Surroundings {
            epoch_s: 0.0,
            planet,
            position: fixed(position * radius_m),
            velocity: fixed(Vector3::x()),
            sun: fixed(position * radius_m + Vector3::new(degrees(theta_deg).cos(), degrees(theta_deg).sin(), 0.0) * 5e10),
            earth: fixed(position * radius_m + Vector3::x() * 1e11),
            bodies: [None; Body::ALL.len()],
        };
        let free = Vector3::new(2.0, 0.0, 0.0);
        for (position, theta_deg, off_deg, antenna, expected) in [
            (free, 40.0, 0.0, Antenna::Sunshade, true),
            (free, 40.0, 0.0, Antenna::Back, false),
            (free, 40.0, 0.0, Antenna::None, false),
            (free, 140.0, 0.0, Antenna::Back, true),
            (free, 2.9, 0.0, Antenna::Sunshade, false),
            (free, 3.1, 0.0, Antenna::Sunshade, true),
            (free, 40.0, 1.9, Antenna::Sunshade, true),
            (free, 40.0, 2.1, Antenna::Sunshade, false),
            (-free, 40.0, 0.0, Antenna::Sunshade, false),
            (Vector3::new(-2.0, 0.99, 0.0), 40.0, 0.0, Antenna::Sunshade, false),
            (Vector3::new(-2.0, 1.01, 0.0), 40.0, 0.0, Antenna::Sunshade, true),
        ] {
            let around = around(position, theta_deg);
            let pointing = downlink(&around.to_sun(), &around.to_earth(), &DownlinkRequest::default())
                .unwrap()
                .vectors
                .pointing()
                .unwrap();
            // Off by a turn about -Y and by one about X together: about the Sun's and the Earth's normal's middle.
            let earth = value(&pointing.to_body(&unit(&around.to_earth()).unwrap()));
            let axis = fixed(earth.cross(&Vector3::z()).normalize());
            let pointing = pointing.turned(&axis, Moving::constant(degrees(off_deg)));
            let found = link(&around, &pointing, antenna, &limits).unwrap();
            assert_eq!(found.available, expected, "{position} {theta_deg} {off_deg} {antenna:?}");
            assert!((found.sun_separation_rad - degrees(theta_deg)).abs() < 1e-12);
        }
    }
}
