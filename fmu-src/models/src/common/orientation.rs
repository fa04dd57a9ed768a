//! Rotation model of a planet from its parameters.

use fmi_export::{Choice, Failure, Real, Variables};
use physics::bodies::{Body, BodyData};
use physics::environment::orientation::Orientation;

use super::center::CenterBody;
use super::choices::PlanetOrientation;
use super::numbers::Number;

/// Pole and rotation of a planet.
#[derive(Variables)]
#[variables(setup = CenterBody)]
pub struct RotationVariables {
    /// Right ascension of the planet's north pole in EME2000 (IAU 2015).
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.data.pole_right_ascension_rad)]
    pub pole_right_ascension: Real,
    /// Declination of the planet's north pole in EME2000 (IAU 2015).
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.data.pole_declination_rad)]
    pub pole_declination: Real,
    /// Prime meridian at J2000 (IAU 2015).
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.data.prime_meridian_rad)]
    pub prime_meridian: Real,
    /// Rotation rate.
    #[parameter(unit = "rad/s", display = "deg/s", min = -1.0, max = 1.0, start = setup.data.rotation_rate_rad_s)]
    pub rotation_rate: Real,
    /// Rotation model: iau, the Earth's default and the Earth's alone, uses neither pole nor prime meridian nor rotation rate given
    /// here; other planets rotate uniformly.
    #[parameter(start = PlanetOrientation::for_body(setup.data.body))]
    pub orientation: Choice<PlanetOrientation>,
}

impl RotationVariables {
    /// The parameters that are numbers of a body.
    pub(crate) fn numbers(&self) -> [Number<BodyData>; 4] {
        [
            (self.pole_right_ascension, |it| &mut it.pole_right_ascension_rad),
            (self.pole_declination, |it| &mut it.pole_declination_rad),
            (self.prime_meridian, |it| &mut it.prime_meridian_rad),
            (self.rotation_rate, |it| &mut it.rotation_rate_rad_s),
        ]
    }
}

impl PlanetOrientation {
    /// Rotation of the body with these parameters and this UT1 - UTC in s.
    ///
    /// # Errors
    /// The Earth's orientation requested of another body.
    pub fn about(self, planet: &BodyData, ut1_minus_utc_s: f64) -> Result<Orientation, Failure> {
        match self {
            Self::Uniform => Ok(Orientation::uniform(planet)),
            Self::Iau if planet.body == Body::Earth => Ok(Orientation::Iau { ut1_minus_utc_s }),
            Self::Iau => Err(Failure::new(format!(
                "planet.orientation: found iau with {}, allowed: uniform (1); iau is the Earth's alone",
                planet.name
            ))),
        }
    }
}
