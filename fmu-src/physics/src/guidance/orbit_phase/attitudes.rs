//! The two attitudes of paper 000: science (pitched about X toward the planet) and default downlink (eq 18); of paper 001,
//! science off-pointed to unload momentum, the camera turned back to nadir.

use nalgebra::{ComplexField, Vector3};

use crate::attitude::{MovingFrame, MovingUnit, SunAngles, angle_between_rad, direction_from_angles};
use crate::environment::CartesianState;
use crate::guidance::downlink::sun_place::{SunPlace, both_solutions};
use crate::guidance::geometry::moving::{Moving, direction, fixed, moving};
use crate::guidance::pointing::boresight::{MdisRange, mdis_direction};
use crate::guidance::pointing::law::PointingVectors;
use crate::numerics::scalar::Scalar;

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
        /// Where the Sun stands in the body frame during the present science, and during the slew out of it.
        sun: SunAngles,
        /// Range of the camera that keeps nadir.
        camera: MdisRange,
    },
}

impl ScienceRule {
    /// Whether the Sun's place is chosen by the momentum.
    pub fn unloads(&self) -> bool {
        matches!(self, Self::Unloading { .. })
    }

    /// The same with the Sun there, where it has a place of its own.
    #[must_use]
    pub fn with_sun(self, sun: SunAngles) -> Self {
        match self {
            Self::Unloading { camera, .. } => Self::Unloading { sun, camera },
            Self::Scaled { .. } | Self::Nadir | Self::PlanetOrbit => self,
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
}

/// Margins of a law that has one form only.
const NO_MARGINS: [f64; 2] = [f64::INFINITY; 2];

/// Science attitude: -Y toward the Sun, +Z on the planet's side of it, then pitched about X until the Sun stands
/// at the elevation of `rule`, within +-`elevation_limit_rad`.
pub fn science(lines: &LinesOfSight, rule: ScienceRule, elevation_limit_rad: f64) -> AttitudeCommand {
    let gain = match rule {
        ScienceRule::Scaled { gain } => gain,
        ScienceRule::Nadir => 1.0,
        ScienceRule::PlanetOrbit => return planet_orbit(lines),
        ScienceRule::Unloading { sun, camera } => return unloading(lines, sun, &camera),
    };
    let Some((side, angle_rad, angle_rate_rad_s)) =
        lines.planet.as_ref().and_then(|planet| lines.sun.perpendicular_part(planet))
    else {
        return sun_pointing(lines);
    };
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
    AttitudeCommand { frame: base.pitched(-elevation_rad, -rate_rad_s), margins }
}

/// Science attitude of paper 001's off-pointing: the Sun at `sun`, turned about the Sun line until nadir lies in the scan plane YZ
/// of the camera, on the side of +Z; where the camera's range does not reach it, until its nearest bound comes nearest to nadir.
///
/// With the Sun's direction s in the body, rho = hypot(s_y, s_z) and beta = atan2(-s_z, -s_y), the camera at the angle phi is off
/// the Sun by theta, cos theta = rho sin(phi - beta): theta between Sun and nadir gives phi.
pub fn unloading(lines: &LinesOfSight, sun: SunAngles, camera: &MdisRange) -> AttitudeCommand {
    let Some(planet) = &lines.planet else { return sun_pointing(lines) };
    let [to_sun, to_planet] = [&lines.sun, planet].map(|to| moving(to.direction, to.rate_1_s));
    let sun_body = direction_from_angles(sun);
    let (rho, beta_rad) = (libm::hypot(sun_body.y, sun_body.z), (-sun_body.z).atan2(-sun_body.y));
    let cosine = to_sun.dot(&to_planet);
    let quarter = core::f64::consts::FRAC_PI_2;
    let [least_rad, greatest_rad] =
        [camera.minimum_rad, camera.maximum_rad].map(|it| (it - beta_rad).clamp(-quarter, quarter));
    let margins = [rho * greatest_rad.sin() - cosine.re, cosine.re - rho * least_rad.sin()];
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
        body_roll: mdis_direction(off_beta + beta_rad),
        external_roll: to_planet,
    };
    vectors
        .pointing()
        .map_or_else(|| sun_pointing(lines), |pointing| AttitudeCommand { frame: pointing.frame(), margins })
}

/// Paper 004's attitude; without a planet that moves about the Sun, [`sun_pointing`].
fn planet_orbit(lines: &LinesOfSight) -> AttitudeCommand {
    let frame = lines.sun_from_planet.as_ref().and_then(|sun| {
        let toward = MovingUnit::of(sun.position_m, sun.velocity_m_s)?;
        // The normal stands still as long as the Sun alone moves the planet.
        let north = MovingUnit::of(sun.position_m.cross(&sun.velocity_m_s), Vector3::zeros())?;
        Some(MovingFrame::from_yz(&opposite(&toward), &opposite(&north)))
    });
    frame.map_or_else(|| sun_pointing(lines), |frame| AttitudeCommand { frame, margins: NO_MARGINS })
}

/// Default downlink attitude (eq 18): -Y toward the Sun, the Earth in the -X,-Y quadrant of the XY plane while it
/// is less than 90 deg from the Sun, in the +X,+Y quadrant otherwise.
pub fn downlink(lines: &LinesOfSight) -> AttitudeCommand {
    let cosine = lines.sun.direction.dot(&lines.earth.direction);
    let (sun, earth) = (&lines.sun, &lines.earth);
    let (normal, normal_rate) = if cosine > 0.0 {
        (
            earth.direction.cross(&sun.direction),
            earth.rate_1_s.cross(&sun.direction) + earth.direction.cross(&sun.rate_1_s),
        )
    } else {
        (
            sun.direction.cross(&earth.direction),
            sun.rate_1_s.cross(&earth.direction) + sun.direction.cross(&earth.rate_1_s),
        )
    };
    if normal.norm() < 1e-9 {
        return sun_pointing(lines);
    }
    match MovingUnit::of(normal, normal_rate) {
        Some(z) => AttitudeCommand {
            frame: MovingFrame::from_yz(&opposite(sun), &z),
            margins: [cosine, f64::INFINITY],
        },
        None => sun_pointing(lines),
    }
}

/// Downlink attitude with the Sun off -Y (eqs 19 to 22): the Sun at `place`, the Earth in the XY plane on that side of it.
pub fn downlink_toward(lines: &LinesOfSight, place: &SunPlace) -> AttitudeCommand {
    let [to_sun, to_earth] = [&lines.sun, &lines.earth].map(|to| moving(to.direction, to.rate_1_s));
    let Some(solutions) = both_solutions(&to_sun, &to_earth, place.angles) else {
        return sun_pointing(lines);
    };
    let [behind, ahead] = solutions.azimuths;
    let vectors = PointingVectors {
        boresight_body: solutions.sun_body,
        aimpoint: to_sun,
        body_roll: direction(if place.earth_ahead { ahead } else { behind }, Moving::constant(0.0)),
        external_roll: to_earth,
    };
    let Some(pointing) = vectors.pointing() else { return sun_pointing(lines) };
    // Beyond it no attitude has the Sun there and the Earth in the plane.
    let sine = angle_between_rad(&lines.sun.direction, &lines.earth.direction).sin();
    let margin = sine - place.angles.elevation_rad.sin().abs();
    AttitudeCommand { frame: pointing.frame(), margins: [margin, f64::INFINITY] }
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
    AttitudeCommand { frame: MovingFrame::from_yz(&y, &z), margins: NO_MARGINS }
}

fn opposite(unit: &MovingUnit) -> MovingUnit {
    MovingUnit { direction: -unit.direction, rate_1_s: -unit.rate_1_s }
}

#[cfg(test)]
mod tests {
    //! What the paper demands of each attitude: where the Sun, the planet and the Earth stand in the body frame.
    use super::*;
    use crate::guidance::pointing::boresight::mdis_boresight;
    use approx::assert_relative_eq;

    const LIMIT_RAD: f64 = 13.0 * std::f64::consts::PI / 180.0;

    fn unit(x: f64, y: f64, z: f64) -> MovingUnit {
        MovingUnit::of(Vector3::new(x, y, z), Vector3::new(0.1 * y, -0.2 * z, 0.3 * x)).unwrap()
    }

    fn many() -> impl Iterator<Item = LinesOfSight> {
        (0..200).map(|i| {
            let t = f64::from(i) * 0.37;
            LinesOfSight {
                sun: unit(t.cos(), t.sin(), 0.4 * (2.0 * t).sin()),
                planet: Some(unit((3.0 * t).sin(), 0.7, (1.7 * t).cos())),
                earth: unit((0.9 * t).cos(), (1.3 * t).sin(), 0.2),
                sun_from_planet: Some(CartesianState {
                    position_m: Vector3::new(t.cos(), t.sin(), 0.1 * t.sin()) * 5e10,
                    velocity_m_s: Vector3::new(-t.sin(), t.cos(), 0.1 * t.cos()) * 4e4,
                }),
            }
        })
    }

    fn in_body(requested: &AttitudeCommand, unit: &MovingUnit) -> Vector3<f64> {
        requested.frame.inertial_from_body.inverse() * unit.direction
    }

    #[test]
    fn a_downlink_off_the_sun_has_sun_and_earth_where_they_are_requested() {
        let mut checked = 0;
        for (i, lines) in many().enumerate() {
            let k = i as f64;
            let angles =
                SunAngles { azimuth_rad: 0.26 * (0.7 * k).sin(), elevation_rad: 0.22 * (1.3 * k).cos() };
            let theta_rad = angle_between_rad(&lines.sun.direction, &lines.earth.direction);
            if angles.elevation_rad.abs() > theta_rad.min(std::f64::consts::PI - theta_rad) - 1e-3 {
                continue;
            }
            checked += 1;
            for earth_ahead in [false, true] {
                let frame = downlink_toward(&lines, &SunPlace { angles, earth_ahead }).frame;
                let body = |direction: &Vector3<f64>| frame.inertial_from_body.inverse() * direction;
                let sun = SunAngles::of(&body(&lines.sun.direction));
                let earth = body(&lines.earth.direction);
                assert_relative_eq!(sun.azimuth_rad, angles.azimuth_rad, epsilon = 1e-12);
                assert_relative_eq!(sun.elevation_rad, angles.elevation_rad, epsilon = 1e-12);
                assert_relative_eq!(earth.z, 0.0, epsilon = 1e-12);
                // Ahead of the Sun's azimuth about -Z, by less than half a turn.
                let ahead = (SunAngles::of(&earth).azimuth_rad - sun.azimuth_rad).sin();
                assert!(theta_rad > 3.0 || (ahead > 0.0) == earth_ahead, "{ahead} {earth_ahead}");
            }
        }
        assert!(checked > 100, "{checked}");
    }

    #[test]
    fn nadir_rule_points_z_at_the_planet_inside_the_zone() {
        let mut free = 0;
        for lines in many() {
            let requested = science(&lines, ScienceRule::Nadir, LIMIT_RAD);
            let sun = SunAngles::of(&in_body(&requested, &lines.sun));
            let planet = in_body(&requested, lines.planet.as_ref().unwrap());
            assert_relative_eq!(sun.azimuth_rad, 0.0, epsilon = 1e-12);
            assert!(sun.elevation_rad.abs() <= LIMIT_RAD + 1e-12);
            assert!(planet.z > 0.0, "the instruments are on the planet's side");
            assert_relative_eq!(planet.x, 0.0, epsilon = 1e-12);
            if requested.margins.iter().all(|margin| *margin >= 0.0) {
                free += 1;
                assert_relative_eq!(planet.z, 1.0, epsilon = 1e-12);
            }
        }
        assert!(free > 10);
    }

    #[test]
    fn scaled_rule_shows_the_sun_at_a_quarter_of_the_angle() {
        for lines in many() {
            let requested = science(&lines, ScienceRule::Scaled { gain: 0.25 }, LIMIT_RAD);
            let angle_rad = lines.sun.direction.angle(&lines.planet.unwrap().direction);
            let expected = (0.25 * (angle_rad - std::f64::consts::FRAC_PI_2)).clamp(-LIMIT_RAD, LIMIT_RAD);
            let sun = SunAngles::of(&in_body(&requested, &lines.sun));
            assert_relative_eq!(sun.elevation_rad, expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn unloading_has_the_sun_in_its_place_and_the_camera_as_near_to_nadir_as_it_comes() {
        let camera = MdisRange::default();
        let (mut kept, mut at_bound) = (0, 0);
        for (i, lines) in many().enumerate() {
            let k = i as f64;
            let sun =
                SunAngles { azimuth_rad: 0.26 * (0.7 * k).sin(), elevation_rad: 0.22 * (1.3 * k).cos() };
            let requested = science(&lines, ScienceRule::Unloading { sun, camera }, 0.0);
            let found = SunAngles::of(&in_body(&requested, &lines.sun));
            assert_relative_eq!(found.azimuth_rad, sun.azimuth_rad, epsilon = 1e-12);
            assert_relative_eq!(found.elevation_rad, sun.elevation_rad, epsilon = 1e-12);
            let planet = in_body(&requested, lines.planet.as_ref().unwrap());
            let angle = camera.toward(&planet);
            let off_rad = angle_between_rad(&mdis_boresight(angle.angle_rad), &planet);
            assert_eq!(angle.in_range, requested.margins.iter().all(|margin| *margin > 0.0));
            if angle.in_range {
                kept += 1;
                assert_relative_eq!(planet.x, 0.0, epsilon = 1e-12);
                assert!(off_rad < 1e-12 && planet.z > 0.0, "{off_rad:e}");
                continue;
            }
            at_bound += 1;
            // No turn about the Sun line and no angle of the camera comes nearer.
            let axis = nalgebra::Unit::new_normalize(in_body(&requested, &lines.sun));
            for turn in -90..90 {
                let turned = nalgebra::Rotation3::from_axis_angle(&axis, 0.035 * f64::from(turn)) * planet;
                for degree in -50..=40 {
                    let look = mdis_boresight(f64::from(degree).to_radians());
                    assert!(angle_between_rad(&look, &turned) > off_rad - 1e-9, "{i}: {off_rad}");
                }
            }
        }
        assert!(kept > 50 && at_bound > 20, "{kept} {at_bound}");
    }

    #[test]
    fn paper_004_shows_the_sun_on_minus_y_and_north_on_minus_z() {
        for lines in many() {
            let sun = lines.sun_from_planet.unwrap();
            let to_body = science(&lines, ScienceRule::PlanetOrbit, 0.0).frame.inertial_from_body.inverse();
            assert_relative_eq!(to_body * sun.position_m.normalize(), -Vector3::y(), epsilon = 1e-12);
            // Seen from the planet the Sun moves toward north x Sun, which is -Z x -Y = -X.
            let velocity = to_body * sun.velocity_m_s.normalize();
            assert!(velocity.x < -0.99 && velocity.z.abs() < 1e-12, "{velocity}");
        }
    }

    #[test]
    fn downlink_puts_the_earth_in_an_antenna_quadrant() {
        for lines in many() {
            let requested = downlink(&lines);
            assert_relative_eq!(in_body(&requested, &lines.sun), -Vector3::y(), epsilon = 1e-12);
            let earth = in_body(&requested, &lines.earth);
            assert_relative_eq!(earth.z, 0.0, epsilon = 1e-12);
            let behind = lines.sun.direction.dot(&lines.earth.direction) <= 0.0;
            if behind {
                assert!(earth.x > 0.0 && earth.y >= 0.0);
            } else {
                assert!(earth.x < 0.0 && earth.y < 0.0);
            }
        }
    }

    #[test]
    fn every_law_gives_a_proper_rotation_even_when_degenerate() {
        let mut all: Vec<AttitudeCommand> = Vec::new();
        for lines in many() {
            all.push(science(&lines, ScienceRule::Nadir, LIMIT_RAD));
            all.push(downlink(&lines));
            let blind = LinesOfSight {
                planet: Some(lines.sun),
                earth: lines.sun,
                sun_from_planet: Some(CartesianState::default()),
                ..lines
            };
            all.push(science(&blind, ScienceRule::Nadir, LIMIT_RAD));
            all.push(science(&blind, ScienceRule::PlanetOrbit, LIMIT_RAD));
            let sun = SunAngles { azimuth_rad: 0.2, elevation_rad: -0.1 };
            let unloading = ScienceRule::Unloading { sun, camera: MdisRange::default() };
            all.push(science(&blind, unloading, LIMIT_RAD));
            all.push(science(&LinesOfSight { planet: None, ..lines }, unloading, LIMIT_RAD));
            all.push(downlink(&blind));
        }
        let pole = MovingUnit { direction: Vector3::z(), rate_1_s: Vector3::zeros() };
        all.push(sun_pointing(&LinesOfSight { sun: pole, planet: None, earth: pole, sun_from_planet: None }));
        for requested in all {
            let matrix = requested.frame.inertial_from_body.matrix();
            assert_relative_eq!(matrix.determinant(), 1.0, epsilon = 1e-12);
            assert_relative_eq!(matrix * matrix.transpose(), nalgebra::Matrix3::identity(), epsilon = 1e-12);
        }
    }
}
