//! Choices that several models offer, each with what it is in physics.

use fmi_export::Enumeration;
use physics::bodies::surface;
use physics::environment::eclipse::ShadowModel;
use physics::spacecraft::{Spacecraft, SunshadeModel};

/// How the day side's temperature is distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DayTemperature {
    /// One temperature for the whole day side (paper 004, eq 32).
    Uniform = 1,
    /// Local balance: the fourth power of temperature goes with the cosine of the Sun's zenith angle.
    Cosine = 2,
    /// The night's temperature everywhere, as under an atmosphere.
    Isothermal = 3,
}

impl From<DayTemperature> for surface::DayTemperature {
    fn from(choice: DayTemperature) -> Self {
        match choice {
            DayTemperature::Uniform => Self::Uniform,
            DayTemperature::Cosine => Self::Cosine,
            DayTemperature::Isothermal => Self::Isothermal,
        }
    }
}

/// How the planet's shadow dims the Sun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum EclipseMethod {
    /// By the visible fraction of the Sun's disc: umbra, penumbra, annular.
    Discs = 1,
    /// Paper 004: no light as soon as the discs touch.
    Cone = 2,
    /// No light in the cylinder of the planet's radius behind it.
    Cylinder = 3,
    /// The planet casts no shadow; so in paper 000.
    Off = 4,
}

impl From<EclipseMethod> for ShadowModel {
    fn from(choice: EclipseMethod) -> Self {
        match choice {
            EclipseMethod::Discs => Self::DiscOverlap,
            EclipseMethod::Cone => Self::AllOrNothingCone,
            EclipseMethod::Cylinder => Self::AllOrNothingCylinder,
            EclipseMethod::Off => Self::Off,
        }
    }
}

/// Shape of the sunshade.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum SunshadeShape {
    /// Flat plates.
    Plates = 1,
    /// Section of a cylinder.
    Cylinder = 2,
}

impl From<SunshadeShape> for SunshadeModel {
    fn from(choice: SunshadeShape) -> Self {
        match choice {
            SunshadeShape::Plates => Self::Plates,
            SunshadeShape::Cylinder => Self::Cylinder,
        }
    }
}

impl SunshadeShape {
    /// What a spacecraft file asks for.
    pub fn of(spacecraft: &Spacecraft) -> Self {
        match spacecraft.sunshade.as_ref().map(|shade| shade.model) {
            Some(SunshadeModel::Cylinder) => Self::Cylinder,
            Some(SunshadeModel::Plates) | None => Self::Plates,
        }
    }
}
