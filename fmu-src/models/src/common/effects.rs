//! Effects other than sunlight: switches and laws that several models have, and warnings of parts of a file without effect.

use fmi_export::{Boolean, Choice, Failure, Integer, Real, RealVector, SetupError, Values, Variables};
use nalgebra::Vector3;
use physics::aerodynamics::{self, AerodynamicOptions};
use physics::bodies::Body;
use physics::loads::{Active, Switch};
use physics::numerics::scalar::Scalar;
use physics::plant::{Laws, TUNABLE_COUNT};
use physics::spacecraft::{Spacecraft, StartValue, SunshadeModel};

use super::center::CenterBody;
use super::choices::{AerodynamicLaw, Reemission, SunshadeShape};
use super::start_values::entry_of;

/// Number of surfaces that a message names at most.
const MOST_NAMES: usize = 6;

/// Light of the planet.
#[derive(Variables)]
pub struct PlanetLightVariables {
    /// Whether sunlight reflected by the planet and its infrared light act and heat; paper 000 leaves them out.
    #[parameter(start = false)]
    pub enabled: Boolean,
    /// Quadrature nodes over the planet's disc, on rings: 6 for 1e-4 of the force, 16 for 1e-5.
    #[parameter(min = 1, max = 64, start = 6)]
    pub nodes: Integer,
}

/// Heat the spacecraft radiates.
#[derive(Variables)]
pub struct RecoilVariables {
    /// Whether the recoil of radiated heat acts; paper 000 leaves it out.
    #[parameter(start = false)]
    pub enabled: Boolean,
}

/// Shadows of the spacecraft's surfaces on one another.
#[derive(Variables)]
pub struct ShadowingVariables {
    /// Whether surfaces given as polygons shadow one another from the Sun; refused where no surface is. Planet light is never
    /// shadowed.
    #[parameter(start = false)]
    pub enabled: Boolean,
    /// Whether the Sun's disc softens those shadows: lit areas are means over seven directions to it, which takes as much
    /// longer. Otherwise the Sun is a point.
    #[parameter(start = false)]
    pub sun_disc: Boolean,
}

/// Gravity-gradient torque.
#[derive(Variables)]
pub struct GravityGradientVariables {
    /// Whether the planet's gravity gradient acts; paper 000 leaves it out.
    #[parameter(start = true)]
    pub enabled: Boolean,
    /// Whether the flattening of the planet's gravity, planet.j2, acts on the gradient too.
    #[parameter(start = false)]
    pub flattening: Boolean,
}

/// Air on the spacecraft's surfaces.
#[derive(Variables)]
#[variables(setup = CenterBody)]
pub struct AerodynamicVariables {
    /// Whether air acts on the surfaces; by default about the Earth alone.
    #[parameter(start = setup.data.body == Body::Earth)]
    pub enabled: Boolean,
    /// How it acts on a surface, by the materials' drag_coefficient or accommodation.
    #[parameter(start = AerodynamicLaw(aerodynamics::AerodynamicLaw::DragCoefficient))]
    pub law: Choice<AerodynamicLaw>,
    /// Temperature at which molecules leave a surface with law sentman.
    #[parameter(start = Reemission(aerodynamics::Reemission::Effusive))]
    pub reemission: Choice<Reemission>,
    /// Whether surfaces given as polygons shadow one another from the wind; others neither shadow nor are shadowed.
    #[parameter(start = false)]
    pub shadowing: Boolean,
}

/// Effects in closed form.
#[derive(Variables)]
#[variables(setup = CenterBody)]
pub struct LawVariables {
    pub gravity_gradient: GravityGradientVariables,
    pub aerodynamics: AerodynamicVariables,
    /// Whether the planet's magnetic field acts on dipole.residual; by default about the Earth alone.
    #[parameter(name = "magnetics.enabled", start = setup.data.body == Body::Earth)]
    pub magnetics_enabled: Boolean,
    /// Dipole that stays in the spacecraft, body frame.
    #[parameter(name = "dipole.residual", tunable, unit = "A.m2", min = -1e9, max = 1e9, start = [0.0; 3])]
    pub dipole_residual: RealVector<3>,
}

/// Number of switches whose default depends on the planet.
pub(crate) const PLANET_SWITCHES: usize = 2;

impl LawVariables {
    /// Switches that are on by default about the Earth only, with their names.
    pub(crate) fn planet_switches(&self) -> [(&'static str, Boolean); PLANET_SWITCHES] {
        [("aerodynamics.enabled", self.aerodynamics.enabled), ("magnetics.enabled", self.magnetics_enabled)]
    }

    /// Tunable parameters, in the order of [`Laws::tunable_mut`].
    pub fn tunable(&self) -> [Real; TUNABLE_COUNT] {
        core::array::from_fn(|i| self.dipole_residual.element(i))
    }

    /// Parameters of the laws about a planet with this gravitational parameter, J2 and its reference radius, each read by `read`.
    pub fn read<T: Scalar>(
        &self,
        values: &Values,
        [gravitational_parameter, j2, j2_radius]: [Real; 3],
        read: impl Fn(Real) -> T,
    ) -> Laws<T> {
        let flattened = values.boolean(self.gravity_gradient.flattening);
        Laws {
            gm_m3_s2: read(gravitational_parameter),
            flattening: Some([j2, j2_radius].map(&read)).filter(|_| flattened),
            dipole_body_a_m2: Vector3::from_fn(|i, _| read(self.dipole_residual.element(i))),
        }
    }

    /// Active effects; `is_on` reads each switch.
    pub fn active(&self, [planet_light, recoil]: [Boolean; 2], is_on: impl Fn(Boolean) -> bool) -> Active {
        Active::by(|switch| {
            is_on(match switch {
                Switch::PlanetLight => planet_light,
                Switch::Recoil => recoil,
                Switch::GravityGradient => self.gravity_gradient.enabled,
                Switch::Aerodynamics => self.aerodynamics.enabled,
                Switch::Magnetics => self.magnetics_enabled,
            })
        })
    }
}

impl AerodynamicVariables {
    /// How surfaces are prepared for air.
    ///
    /// # Errors
    /// Shadows requested where no surface has an outline.
    pub fn options(
        &self,
        values: &Values,
        spacecraft: &Spacecraft,
        shape: SunshadeModel,
    ) -> Result<AerodynamicOptions, Failure> {
        let shadowing = values.boolean(self.shadowing);
        if shadowing {
            without_outline(spacecraft, shape)
                .map_err(|refusal| Failure::new(format!("aerodynamics.shadowing: {refusal}")))?;
        }
        Ok(AerodynamicOptions {
            law: values.choice(self.law).0,
            reemission: values.choice(self.reemission).0,
            shadowing,
            sunshade_model: spacecraft.sunshade.as_ref().map(|_| shape),
        })
    }
}

impl ShadowingVariables {
    /// Returns a warning of surfaces that have no outline, among others that do.
    ///
    /// # Errors
    /// Shadows requested where no surface has an outline.
    pub fn check(
        &self,
        values: &Values,
        spacecraft: &Spacecraft,
        shape: SunshadeModel,
    ) -> Result<Option<String>, Failure> {
        if !values.boolean(self.enabled) {
            return Ok(None);
        }
        let missing = without_outline(spacecraft, shape)
            .map_err(|refusal| Failure::new(format!("shadowing.enabled: {refusal}")))?;
        Ok((!missing.is_empty()).then(|| {
            let plural = if missing.len() == 1 { "has" } else { "have" };
            format!(
                "shadowing.enabled: {} {plural} no outline (polygon_m), cast no shadow and are never shadowed",
                listed(&missing)
            )
        }))
    }
}

/// Refuses a file whose `[start]` asks for shadows where no surface has an outline.
pub(crate) fn check_start(file: &str, spacecraft: &Spacecraft, model: &str) -> Result<(), SetupError> {
    let entry = entry_of(&spacecraft.start, model, "shadowing.enabled");
    let Some(entry) = entry.filter(|entry| entry.value == StartValue::Boolean(true)) else { return Ok(()) };
    without_outline(spacecraft, SunshadeShape::for_spacecraft(spacecraft).0)
        .map(drop)
        .map_err(|refusal| SetupError(format!("{file}:{}: {}: {refusal}", entry.line, entry.key)))
}

/// Returns a warning where a file's `[planet_map]` is without effect.
pub(crate) fn unused_map(spacecraft: &Spacecraft) -> Option<String> {
    spacecraft.planet_map.as_ref().map(|_| {
        format!(
            "[planet_map] in the spacecraft.toml of {} is without effect: DisturbanceTorque alone takes it, with \
             planetLight.enabled = true and planetLight.method = map",
            spacecraft.name
        )
    })
}

/// Names of the surfaces without an outline.
///
/// # Errors
/// No surface has one: the refusal of shadows.
fn without_outline(spacecraft: &Spacecraft, shape: SunshadeModel) -> Result<Vec<String>, String> {
    let (given, missing) = spacecraft.outlines(shape);
    if given > 0 {
        return Ok(missing);
    }
    Err(format!(
        "found true, allowed: false, as no surface of {} has an outline that could cast a shadow; polygon_m gives one \
         to {}",
        spacecraft.name,
        listed(&missing)
    ))
}

/// The first of these surfaces, and how many more there are.
fn listed(names: &[String]) -> String {
    let mut listed: Vec<String> = names.iter().take(MOST_NAMES).map(|name| format!("`{name}`")).collect();
    if let Some(more) = names.len().checked_sub(MOST_NAMES).filter(|more| *more > 0) {
        listed.push(format!("{more} more"));
    }
    listed.join(", ")
}
