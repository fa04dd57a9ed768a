//! Choices among the variants of a type of physics, which declares them: what their items are called and mean to a master.

use fmi_export::Enumeration;
use physics::bodies::{Body, surface};
use physics::environment::eclipse::ShadowModel;
use physics::guidance::modes::guidance_command;
use physics::momentum::Convention;
use physics::spacecraft::{Panel, Spacecraft, SunshadeModel, ThrusterSet};

/// An enumeration whose items are the variants of an enum of physics: `item = value => Variant`, each with its description.
macro_rules! enumeration_of {
    ($(#[doc = $about:literal])+ $name:ident($type:ty) {
        $($(#[doc = $meaning:literal])+ $item:ident = $value:literal => $variant:ident,)+
    }) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name(pub $type);

        impl ::fmi_export::Enumeration for $name {
            const FIRST: Self = Self([$(<$type>::$variant),+][0]);

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

/// The same for an input, where 0 is none of the variants: what masters send before the first exchange.
macro_rules! optional_enumeration_of {
    ($(#[doc = $about:literal])+ $name:ident($type:ty) {
        $(#[doc = $none:literal])+ none = 0,
        $($(#[doc = $meaning:literal])+ $item:ident = $value:literal => $variant:ident,)+
    }) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name(pub Option<$type>);

        impl ::fmi_export::Enumeration for $name {
            const FIRST: Self = Self(None);

            const TYPE: ::fmi_export::variables::EnumerationType = ::fmi_export::variables::EnumerationType {
                name: stringify!($name),
                description: concat!($($about),+).trim_ascii(),
                items: &[
                    ::fmi_export::variables::Item {
                        name: "none",
                        value: 0,
                        description: concat!($($none),+).trim_ascii(),
                    },
                    $(::fmi_export::variables::Item {
                        name: stringify!($item),
                        value: $value,
                        description: concat!($($meaning),+).trim_ascii(),
                    }),+
                ],
            };

            fn from_value(value: i32) -> Option<Self> {
                match value {
                    0 => Some(Self(None)),
                    $($value => Some(Self(Some(<$type>::$variant))),)+
                    _ => None,
                }
            }

            fn value(self) -> i32 {
                match self.0 {
                    None => 0,
                    $(Some(<$type>::$variant) => $value,)+
                }
            }
        }
    };
}
pub(crate) use optional_enumeration_of;

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

/// Sense in which a panel tilts off the Sun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum PanelTilt {
    /// Right-handed about the panel's axis.
    Positive = 1,
    /// Left-handed about the panel's axis.
    Negative = 2,
}

impl PanelTilt {
    /// The sense in which a spacecraft file tilts a panel.
    pub fn of(panel: &Panel) -> Self {
        if panel.tilt_sign < 0.0 { Self::Negative } else { Self::Positive }
    }

    /// +1 or -1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Negative => -1.0,
            Self::Positive => 1.0,
        }
    }
}

enumeration_of! {
    /// Meaning of system momentum in the body frame.
    MomentumConvention(Convention) {
        /// Physical: the inertial total shown in body components.
        inertial = 1 => Inertial,
        /// Paper 000: each body component of torque integrated on its own.
        bodyIntegral = 2 => BodyIntegral,
    }
}

enumeration_of! {
    /// What a command gives.
    CommandKind(guidance_command::CommandKind) {
        /// No command yet: the attitude is held.
        none = 0 => None,
        /// Attitude command.q and rate command.rate.
        attitude = 1 => Attitude,
        /// The attitude held turns at once, when this item is chosen, by the conjugate of command.error; then with
        /// command.rate.
        errorQuaternion = 2 => ErrorQuaternion,
        /// The attitude held turns on with command.rate.
        rateOnly = 3 => RateOnly,
    }
}

/// Pitch during science.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum ScienceRule {
    /// Sun elevation is a fraction of (Sun-nadir angle - 90 deg), within the keep-in zone.
    Scaled = 1,
    /// Z points to nadir as far as the keep-in zone allows.
    Nadir = 2,
    /// Fixed to the Sun line: -Y from the planet to the Sun, -Z to the north of the planet's orbit, as in paper 004; no
    /// keep-in zone.
    FixedToSunLine = 3,
}

enumeration_of! {
    /// Central body. 5 is kept free for the Moon, which cannot be one yet.
    OrbitCenter(Body) {
        /// Mercury.
        mercury = 1 => Mercury,
        /// The Sun.
        sun = 2 => Sun,
        /// Venus.
        venus = 3 => Venus,
        /// The Earth.
        earth = 4 => Earth,
        /// Mars.
        mars = 6 => Mars,
        /// Jupiter.
        jupiter = 7 => Jupiter,
    }
}

optional_enumeration_of! {
    /// Thrusters for a delta-v.
    ThrustRequest(ThrusterSet) {
        /// None.
        none = 0,
        /// The large velocity adjust thruster.
        lva = 1 => Lva,
        /// The 22 N thrusters.
        c22 = 2 => C22,
        /// The 4.4 N thrusters.
        mono4 = 3 => Mono4,
    }
}

/// From where downlinks are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DownlinkReference {
    /// From periapsis, a window after every guided.downlinkEvery of them.
    Periapsis = 1,
    /// From the start: one window.
    Start = 2,
}
