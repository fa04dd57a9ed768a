//! Choices among the variants of a type of physics, which declares them: what their items are called and mean to a master.

use physics::bodies::surface;
use physics::environment::eclipse::ShadowModel;
use physics::spacecraft::{Spacecraft, SunshadeModel};

/// An enumeration whose items are the variants of an enum of physics: `item = value => Variant`, each with its description.
macro_rules! enumeration_of {
    ($(#[doc = $about:literal])+ $name:ident($type:ty) {
        $($(#[doc = $meaning:literal])+ $item:ident = $value:literal => $variant:ident,)+
    }) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name(pub $type);

        impl ::fmi_export::Enumeration for $name {
            const TYPE: ::fmi_export::variables::EnumerationType = ::fmi_export::variables::EnumerationType {
                name: stringify!($name),
                description: concat!($($about),+).trim_ascii(),
                items: &[$(::fmi_export::variables::Item {
                    name: stringify!($item),
                    value: $value,
                    description: concat!($($meaning),+).trim_ascii(),
                }),+],
            };

            fn from_value(value: i32) -> Option<Self> {
                match value {
                    $($value => Some(Self(<$type>::$variant)),)+
                    _ => None,
                }
            }

            fn value(self) -> i32 {
                match self.0 {
                    $(<$type>::$variant => $value,)+
                }
            }
        }
    };
}
pub(crate) use enumeration_of;

enumeration_of! {
    /// How the day side's temperature is distributed.
    DayTemperature(surface::DayTemperature) {
        /// One temperature for the whole day side (paper 004, eq 32).
        uniform = 1 => Uniform,
        /// Local balance: the fourth power of temperature goes with the cosine of the Sun's zenith angle.
        cosine = 2 => Cosine,
        /// The night's temperature everywhere, as under an atmosphere.
        isothermal = 3 => Isothermal,
    }
}

enumeration_of! {
    /// How the planet's shadow dims the Sun.
    EclipseMethod(ShadowModel) {
        /// By the visible fraction of the Sun's disc: umbra, penumbra, annular.
        discs = 1 => DiscOverlap,
        /// Paper 004: no light as soon as the discs touch.
        cone = 2 => AllOrNothingCone,
        /// No light in the cylinder of the planet's radius behind it.
        cylinder = 3 => AllOrNothingCylinder,
        /// The planet casts no shadow; so in paper 000.
        off = 4 => Off,
    }
}

enumeration_of! {
    /// Shape of the sunshade.
    SunshadeShape(SunshadeModel) {
        /// Flat plates.
        plates = 1 => Plates,
        /// Section of a cylinder.
        cylinder = 2 => Cylinder,
    }
}

impl SunshadeShape {
    /// What a spacecraft file asks for; plates without a shade.
    pub fn of(spacecraft: &Spacecraft) -> Self {
        Self(spacecraft.sunshade.as_ref().map_or(SunshadeModel::Plates, |shade| shade.model))
    }
}
