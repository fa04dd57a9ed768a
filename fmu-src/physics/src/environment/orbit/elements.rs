//! Keplerian elements to state and back (paper 004 eqs 9-21, with all quadrants).

use core::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::bodies::{Body, BodyData};
use crate::constants::ASTRONOMICAL_UNIT_M;
use crate::environment::CartesianState;
use crate::math;

/// Below this eccentricity an orbit counts as circular, below this sine of inclination as equatorial.
const DEGENERATE: f64 = 1e-13;

/// Osculating Keplerian elements in some inertial frame; ellipse (`a > 0`, `0 <= e < 1`) or hyperbola (`a < 0`, `e > 1`).
///
/// Angles from [`Elements::from_state`] lie in `[0, 2 pi)`, the inclination in `[0, pi]`, a hyperbola's true anomaly
/// in `(-pi, pi)`. Where an angle has no meaning it is defined so: *equatorial* orbits (inclination 0 or pi within
/// 1e-13) have their ascending node on +x (node 0); *circular* orbits (eccentricity below 1e-13) have their periapsis at the
/// ascending node (argument 0). The state is the same to 1e-13 of its length either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Elements {
    /// Semi-major axis, m; negative for a hyperbola.
    pub semi_major_axis_m: f64,
    /// Eccentricity.
    pub eccentricity: f64,
    /// Inclination, rad.
    pub inclination_rad: f64,
    /// Right ascension (longitude) of the ascending node, rad.
    pub ascending_node_rad: f64,
    /// Argument of periapsis, rad.
    pub periapsis_argument_rad: f64,
    /// True anomaly, rad.
    pub true_anomaly_rad: f64,
}

/// Elements or a state that are no orbit this module can propagate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum OrbitError {
    /// A number outside its range.
    #[error("{what} is {found}, allowed is {allowed}")]
    OutOfRange {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// Number that was found.
        found: f64,
        /// Range that is allowed.
        allowed: &'static str,
    },
    /// Position and velocity are parallel, or one is zero: a fall along a line has no orbital plane.
    #[error(
        "position ({distance_m} m from the centre) and velocity ({speed_m_s} m/s) are parallel or zero: \
         no orbital plane, give the state some angular momentum"
    )]
    Rectilinear {
        /// Distance from the centre, m.
        distance_m: f64,
        /// Speed, m/s.
        speed_m_s: f64,
    },
    /// The eccentricity or the energy is that of a parabola, whose semi-major axis is infinite.
    #[error(
        "the eccentricity is {eccentricity}: a parabola has no semi-major axis, allowed is below or above 1"
    )]
    Parabolic {
        /// Eccentricity.
        eccentricity: f64,
    },
}

/// Semi-major axis of an ellipse of this period, m (Kepler's third law). The same to the last digit on every machine.
pub fn semi_major_axis_m(mu_m3_s2: f64, period_s: f64) -> f64 {
    let mean_motion_rad_s = TAU / period_s;
    math::cbrt(mu_m3_s2 / (mean_motion_rad_s * mean_motion_rad_s))
}

/// Period of an ellipse of this semi-major axis, s (Kepler's third law); infinite for a hyperbola's.
pub fn period_s(mu_m3_s2: f64, semi_major_axis_m: f64) -> f64 {
    if semi_major_axis_m < 0.0 {
        return f64::INFINITY;
    }
    TAU * (semi_major_axis_m / mu_m3_s2).sqrt() * semi_major_axis_m
}

impl Elements {
    /// A circle of `radius_m` whose node lies on the first axis.
    pub fn circle(radius_m: f64, inclination_rad: f64) -> Self {
        Self { semi_major_axis_m: radius_m, inclination_rad, ..Self::default() }
    }

    /// An orbit to begin with: about the Sun a circle of 1 AU, about a planet one of three radii over the poles.
    pub fn simple_about(center: &BodyData) -> Self {
        match center.body {
            Body::Sun => Self::circle(ASTRONOMICAL_UNIT_M, 0.0),
            _ => Self::circle(3.0 * center.radius_m, FRAC_PI_2),
        }
    }

    /// The mean ellipse of a planet about the Sun at J2000, in the ecliptic, at perihelion.
    pub fn mean_orbit_of(planet: &BodyData) -> Self {
        Self {
            semi_major_axis_m: planet.orbit_semi_major_axis_m,
            eccentricity: planet.orbit_eccentricity,
            inclination_rad: planet.orbit_inclination_rad,
            ascending_node_rad: planet.orbit_node_rad,
            periapsis_argument_rad: planet.orbit_perihelion_longitude_rad - planet.orbit_node_rad,
            true_anomaly_rad: 0.0,
        }
    }

    /// Checks that these elements are an ellipse or a hyperbola with the true anomaly on its branch.
    ///
    /// # Errors
    /// The first element that cannot be, with what is allowed.
    pub fn check(&self) -> Result<(), OrbitError> {
        let (a, e) = (self.semi_major_axis_m, self.eccentricity);
        check("eccentricity", e, e.is_finite() && e >= 0.0, "0 or more")?;
        if e == 1.0 {
            return Err(OrbitError::Parabolic { eccentricity: e });
        }
        if e < 1.0 {
            check("semi-major axis in m", a, a.is_finite() && a > 0.0, "above 0 for an ellipse (e < 1)")?;
        } else {
            check("semi-major axis in m", a, a.is_finite() && a < 0.0, "below 0 for a hyperbola (e > 1)")?;
        }
        for (what, found) in [
            ("inclination in rad", self.inclination_rad),
            ("ascending node in rad", self.ascending_node_rad),
            ("argument of periapsis in rad", self.periapsis_argument_rad),
            ("true anomaly in rad", self.true_anomaly_rad),
        ] {
            check(what, found, found.is_finite(), "a finite number")?;
        }
        let on_branch = 1.0 + e * math::cos(self.true_anomaly_rad) > 0.0;
        check("true anomaly in rad", self.true_anomaly_rad, on_branch, "between the hyperbola's asymptotes")
    }

    /// Position and velocity (paper 004 eqs 9-11) about a centre of gravitational parameter `mu_m3_s2`, in the frame
    /// of the elements.
    ///
    /// # Errors
    /// See [`Elements::check`]; `mu_m3_s2` must be positive.
    pub fn state(&self, mu_m3_s2: f64) -> Result<CartesianState, OrbitError> {
        self.check()?;
        check_mu(mu_m3_s2)?;
        let (sin_anomaly, cos_anomaly) = math::sin_cos(self.true_anomaly_rad);
        let e = self.eccentricity;
        let parameter_m = self.semi_latus_rectum_m();
        // 1 + e cos nu, exact to rounding far from periapsis of a near parabola.
        let cos_half = math::cos(0.5 * self.true_anomaly_rad);
        let distance_m = parameter_m / ((1.0 - e) + 2.0 * e * cos_half * cos_half);
        let speed_m_s = (mu_m3_s2 / parameter_m).sqrt();
        let [to_periapsis, to_latus] = self.in_plane_axes();
        Ok(CartesianState {
            position_m: (to_periapsis * cos_anomaly + to_latus * sin_anomaly) * distance_m,
            velocity_m_s: (to_latus * (e + cos_anomaly) - to_periapsis * sin_anomaly) * speed_m_s,
        })
    }

    /// Elements of a state (paper 004 eqs 13-21, angles by atan2) about a centre of gravitational parameter `mu_m3_s2`.
    ///
    /// # Errors
    /// [`OrbitError::Rectilinear`], [`OrbitError::Parabolic`], or a number that is not finite.
    pub fn from_state(state: &CartesianState, mu_m3_s2: f64) -> Result<Self, OrbitError> {
        let (elements, _) = Self::osculating(state, mu_m3_s2)?;
        if (state.position_m.norm() / elements.semi_major_axis_m).abs() < 1e-14 {
            return Err(OrbitError::Parabolic { eccentricity: elements.eccentricity });
        }
        Ok(elements)
    }

    /// The same with |1 - e|, which near 1 is known to more digits than the eccentricity tells. A parabola counts as the hyperbola
    /// nearest to it, less apart than the state is rounded.
    ///
    /// # Errors
    /// [`OrbitError::Rectilinear`], or a number that is not finite.
    pub(crate) fn osculating(state: &CartesianState, mu_m3_s2: f64) -> Result<(Self, f64), OrbitError> {
        /// Ratio of distance to semi-major axis, under which an orbit is a parabola to rounding.
        const LEAST: f64 = 1e-17;
        check_mu(mu_m3_s2)?;
        let (position, velocity) = (state.position_m, state.velocity_m_s);
        for (what, vector) in [("position in m", position), ("velocity in m/s", velocity)] {
            vector.iter().try_for_each(|x| check(what, *x, x.is_finite(), "finite numbers"))?;
        }
        let (distance_m, speed_m_s) = (position.norm(), velocity.norm());
        let momentum = position.cross(&velocity);
        let momentum_norm = momentum.norm();
        if momentum_norm <= 1e-14 * distance_m * speed_m_s {
            return Err(OrbitError::Rectilinear { distance_m, speed_m_s });
        }
        let to_spacecraft = position / distance_m;
        let eccentricity_vector = velocity.cross(&momentum) / mu_m3_s2 - to_spacecraft;
        let mut eccentricity = eccentricity_vector.norm();
        // From the energy, as 1 - e below: no cancellation for nearly circular and nearly parabolic orbits.
        let mut inverse_axis = 2.0 / distance_m - speed_m_s * speed_m_s / mu_m3_s2;
        if inverse_axis.abs() * distance_m < LEAST {
            inverse_axis = -LEAST / distance_m;
        }
        let periapsis_m = momentum_norm / mu_m3_s2 * momentum_norm / (1.0 + eccentricity);
        let gap = periapsis_m * inverse_axis;
        if gap.abs() < 1e-3 {
            eccentricity = 1.0 - gap;
        }
        if eccentricity == 1.0 {
            eccentricity = if gap > 0.0 { eccentricity.next_down() } else { eccentricity.next_up() };
        }
        let normal = momentum / momentum_norm;
        let to_node = node(&normal);
        let to_periapsis = if eccentricity < DEGENERATE { to_node } else { eccentricity_vector.normalize() };
        let to_latus = normal.cross(&to_periapsis);
        let anomaly_rad = math::atan2(to_spacecraft.dot(&to_latus), to_spacecraft.dot(&to_periapsis));
        let elements = Self {
            semi_major_axis_m: 1.0 / inverse_axis,
            eccentricity,
            true_anomaly_rad: if eccentricity < 1.0 { positive(anomaly_rad) } else { anomaly_rad },
            ..Self::default()
        };
        Ok((elements.with_axes(&normal, &to_periapsis), gap.abs()))
    }

    /// The same in another plane, of this `normal`, and with periapsis in this direction; both unit vectors.
    pub(super) fn with_axes(self, normal: &Vector3<f64>, to_periapsis: &Vector3<f64>) -> Self {
        let to_node = node(normal);
        let across_node = normal.cross(&to_node);
        let argument_rad = math::atan2(to_periapsis.dot(&across_node), to_periapsis.dot(&to_node));
        Self {
            inclination_rad: math::atan2(math::hypot(normal.x, normal.y), normal.z),
            ascending_node_rad: positive(math::atan2(to_node.y, to_node.x)),
            periapsis_argument_rad: positive(argument_rad),
            ..self
        }
    }

    /// Semi-latus rectum p = a (1 - e^2), m.
    pub fn semi_latus_rectum_m(&self) -> f64 {
        self.semi_major_axis_m * (1.0 - self.eccentricity) * (1.0 + self.eccentricity)
    }

    /// Angle from the ascending node to the spacecraft, along the motion, rad in `[0, 2 pi)`.
    pub fn argument_of_latitude_rad(&self) -> f64 {
        let sum_rad = self.periapsis_argument_rad + self.true_anomaly_rad;
        positive(if sum_rad >= TAU { sum_rad - TAU } else { sum_rad })
    }

    /// Distance of periapsis from the centre, m.
    pub fn periapsis_distance_m(&self) -> f64 {
        self.semi_major_axis_m * (1.0 - self.eccentricity)
    }

    /// Unit vectors in the orbital plane: toward periapsis, and a quarter turn ahead of it.
    pub(super) fn in_plane_axes(&self) -> [Vector3<f64>; 2] {
        let (sin_node, cos_node) = math::sin_cos(self.ascending_node_rad);
        let (sin_inc, cos_inc) = math::sin_cos(self.inclination_rad);
        let (sin_arg, cos_arg) = math::sin_cos(self.periapsis_argument_rad);
        let to_node = Vector3::new(cos_node, sin_node, 0.0);
        let across_node = Vector3::new(-sin_node * cos_inc, cos_node * cos_inc, sin_inc);
        [to_node * cos_arg + across_node * sin_arg, across_node * cos_arg - to_node * sin_arg]
    }
}

/// Unit vector to the ascending node of a plane of this normal; +x of an equatorial one.
fn node(normal: &Vector3<f64>) -> Vector3<f64> {
    let sin_inclination = math::hypot(normal.x, normal.y);
    if sin_inclination < DEGENERATE {
        return Vector3::x();
    }
    Vector3::new(-normal.y, normal.x, 0.0) / sin_inclination
}

/// Refuses a gravitational parameter that is none.
///
/// # Errors
/// [`OrbitError::OutOfRange`].
pub fn check_mu(mu_m3_s2: f64) -> Result<(), OrbitError> {
    let is_allowed = mu_m3_s2.is_finite() && mu_m3_s2 > 0.0;
    check("gravitational parameter in m3/s2", mu_m3_s2, is_allowed, "a finite number above 0")
}

/// Refuses a number that is not allowed.
///
/// # Errors
/// [`OrbitError::OutOfRange`].
pub fn check(
    what: &'static str,
    found: f64,
    is_allowed: bool,
    allowed: &'static str,
) -> Result<(), OrbitError> {
    if is_allowed { Ok(()) } else { Err(OrbitError::OutOfRange { what, found, allowed }) }
}

/// The same angle in `[0, 2 pi)`.
fn positive(angle_rad: f64) -> f64 {
    let angle = if angle_rad < 0.0 { angle_rad + TAU } else { angle_rad };
    if angle >= TAU { 0.0 } else { angle }
}

#[cfg(test)]
mod tests;
