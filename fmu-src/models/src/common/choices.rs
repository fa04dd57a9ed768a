//! Choices that several models have; those that physics makes have its items.

use fmi_export::Enumeration;
use fmi_export::variables::{DeclaredItem, Item};
use physics::aerodynamics;
use physics::bodies::{Body, surface};
use physics::enumeration::{Enumerated, Item as EnumeratedItem};
use physics::environment::eclipse::ShadowModel;
use physics::guidance::constraints::keep_in;
use physics::guidance::modes::guidance_command;
use physics::momentum::Convention;
use physics::spacecraft::{CustomBody, Panel, Spacecraft, SunshadeModel, TargetItem, ThrusterSet};

/// An enumeration of what a `Name(type)` holds: the first, the items, from a number, to a number. Its doc comment is its description.
macro_rules! choice {
    ($(#[doc = $about:literal])+ $name:ident($held:ty): $first:expr, $items:expr, $from:expr, $value:expr) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name(pub $held);

        impl ::fmi_export::Enumeration for $name {
            const FIRST: Self = Self($first);

            const TYPE: ::fmi_export::variables::EnumerationType = ::fmi_export::variables::EnumerationType {
                name: stringify!($name),
                description: concat!($($about),+).trim_ascii(),
                items: $items,
            };

            fn from_value(value: i32) -> Option<Self> {
                $from(value).map(Self)
            }

            fn value(self) -> i32 {
                $value(self.0)
            }
        }
    };
}
pub(crate) use choice;

/// Enumerations that are those of physics: `Name(type);` each, or `Name(type) of ITEMS;` for some of its items, described by its
/// doc comment.
macro_rules! choices {
    ($($(#[doc = $about:literal])+ $name:ident($type:ty) $(of $some:ident)?;)+) => {$(
        $crate::common::choices::choice! {
            $(#[doc = $about])+
            $name($type): <$type as ::physics::enumeration::Enumerated>::ITEMS[0].variant,
            &$crate::common::choices::items::<_, { $crate::common::choices::choices!(@items $type $(, $some)?).len() }>(
                $crate::common::choices::choices!(@items $type $(, $some)?), None
            ),
            ::physics::enumeration::Enumerated::from_value, ::physics::enumeration::Enumerated::value
        }
    )+};
    (@items $type:ty) => { <$type as ::physics::enumeration::Enumerated>::ITEMS };
    (@items $type:ty, $some:ident) => { $some };
}
pub(crate) use choices;

/// The same for inputs, where 0 is none of the items, what masters send before the first exchange: `Name(type) or "what none
/// means";`.
macro_rules! optional_choices {
    ($($(#[doc = $about:literal])+ $name:ident($type:ty) $(of $some:ident)? or $none:literal;)+) => {$(
        $crate::common::choices::choice! {
            $(#[doc = $about])+
            $name(Option<$type>): None,
            &$crate::common::choices::items::<
                _, { $crate::common::choices::choices!(@items $type $(, $some)?).len() + 1 },
            >($crate::common::choices::choices!(@items $type $(, $some)?), Some($none)),
            |value| match value {
                0 => Some(None),
                _ => ::physics::enumeration::Enumerated::from_value(value).map(Some),
            },
            |it: Option<$type>| it.map_or(0, ::physics::enumeration::Enumerated::value)
        }
    )+};
}
pub(crate) use optional_choices;

/// A row of a table of the spacecraft's file, from 0, or none: `Name(row) or "what none means"`; the setup adds the rows' items.
macro_rules! row_choice {
    ($(#[doc = $about:literal])+ $name:ident($row:ident) or $none:literal) => {
        $crate::common::choices::choice! {
            $(#[doc = $about])+
            $name(Option<$row>): None,
            &[::fmi_export::variables::Item { name: "none", value: 0, description: $none }],
            |value: i32| Some(u16::try_from(value).ok()?.checked_sub(1).map($row)),
            |it: Option<$row>| it.map_or(0, |$row(index)| i32::from(index) + 1)
        }
    };
}
pub(crate) use row_choice;

/// Items by their numbers, after the item `none` if that has a meaning.
pub(crate) const fn items<E: Enumerated, const N: usize>(
    given: &[EnumeratedItem<E>],
    none: Option<&'static str>,
) -> [Item; N] {
    let (before, description) = match none {
        Some(meaning) => (1, meaning),
        None => (0, ""),
    };
    let mut items = [Item { name: "none", value: 0, description }; N];
    let mut at = 0;
    while at < given.len() {
        let item = &given[at];
        let (mut rank, mut other) = (before, 0);
        while other < given.len() {
            rank += (given[other].value < item.value) as usize;
            other += 1;
        }
        items[rank] = Item { name: item.name, value: item.value, description: item.meaning };
        at += 1;
    }
    items
}

choices! {
    /// How the day side's temperature is distributed.
    DayTemperature(surface::DayTemperature);
    /// How the planet's shadow dims the Sun.
    EclipseMethod(ShadowModel);
    /// Shape of the sunshade.
    SunshadeShape(SunshadeModel);
    /// Where a Sun outside the keep-in zone is put.
    KeepInMethod(keep_in::KeepInMethod);
    /// Force of air on a surface.
    AerodynamicLaw(aerodynamics::AerodynamicLaw);
    /// Temperature at which molecules leave a surface by the law of Sentman.
    Reemission(aerodynamics::Reemission);
}

/// Rotation model of a planet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum PlanetOrientation {
    /// Constant rotation rate about a fixed pole.
    Uniform = 1,
    /// The Earth by the IAU: precession of 2006, nutation to 1 arcsec, Earth rotation angle.
    Iau = 2,
}

impl PlanetOrientation {
    /// Default of a body.
    pub fn for_body(body: Body) -> Self {
        if body == Body::Earth { Self::Iau } else { Self::Uniform }
    }
}

impl SunshadeShape {
    /// The shape that a spacecraft file requests; plates without a shade.
    pub fn for_spacecraft(spacecraft: &Spacecraft) -> Self {
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
    pub fn for_panel(panel: &Panel) -> Self {
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

choices! {
    /// Meaning of system momentum in the body frame.
    MomentumConvention(Convention);
    /// What a command gives.
    CommandKind(guidance_command::CommandKind);
}

/// Attitude during science.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum ScienceRule {
    /// Sun elevation is a fraction of (Sun-nadir angle - 90 deg), within the keep-in zone.
    Scaled = 1,
    /// Z points to nadir as far as the keep-in zone allows.
    Nadir = 2,
    /// Fixed to the Sun line: -Y from the planet to the Sun, -Z to the north of the planet's orbit, as in paper 004; no
    /// keep-in zone.
    FixedToSunLine = 3,
    /// Local vertical, local horizontal: +Z to nadir, -Y along the orbit normal (position x velocity).
    Lvlh = 4,
    /// Yaw steering: +Z to nadir, p x Z toward the Sun, p the axis of the panels; -Y toward the Sun without panels.
    YawSteering = 5,
    /// -Y to the Sun, +Z toward ecliptic north.
    SunPointing = 6,
    /// The attitude guided.attitude.
    Inertial = 7,
    /// The axis guided.align.axis exactly at its target, guided.constrain.axis as near as possible to its own.
    Aligned = 8,
}

choices! {
    /// Direction that a body axis is turned to.
    PointingTarget(TargetItem);
}

/// The built-in bodies; the one that a spacecraft's file describes follows them.
pub(crate) const KNOWN_BODIES: &[EnumeratedItem<Body>] = match Body::ITEMS.split_last() {
    Some((_custom, known)) => known,
    None => &[],
};

/// The built-in bodies but for the Sun, which is the first of them.
pub(crate) const KNOWN_PLANETS: &[EnumeratedItem<Body>] = match KNOWN_BODIES.split_first() {
    Some((_sun, planets)) => planets,
    None => &[],
};

choices! {
    /// Central body. 5 is kept free for the Moon, which cannot be one yet.
    OrbitCenter(Body) of KNOWN_BODIES;
}

/// The item of the body that a spacecraft's file describes.
pub(crate) fn custom_body(spacecraft: &Spacecraft) -> Vec<DeclaredItem> {
    let item = |body: &CustomBody| DeclaredItem {
        name: Body::Custom.name().to_owned(),
        value: Enumerated::value(Body::Custom),
        description: format!("{}, the file's own body.", body.name),
    };
    spacecraft.body.iter().map(item).collect()
}

row_choice! {
    /// Thrusters for a delta-v.
    ThrustRequest(ThrusterSet) or "None."
}

impl ThrustRequest {
    /// The items of the spacecraft's sets.
    pub fn sets(spacecraft: &Spacecraft) -> Vec<DeclaredItem> {
        let item = |(index, name): (u16, &String)| {
            let set = ThrusterSet(index);
            let thrusters: Vec<&str> = spacecraft.thrusters_of(set).map(|it| it.name.as_str()).collect();
            DeclaredItem {
                name: name.clone(),
                value: Self(Some(set)).value(),
                description: match thrusters.is_empty() {
                    true => "No thruster of this file.".to_owned(),
                    false => format!("Thrusters {}.", thrusters.join(", ")),
                },
            }
        };
        (0..).zip(&spacecraft.thruster_sets).map(item).collect()
    }

    /// The first set; none without one.
    pub fn first(spacecraft: &Spacecraft) -> Self {
        Self((!spacecraft.thruster_sets.is_empty()).then_some(ThrusterSet(0)))
    }
}

/// What guided flight does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum GuidedPhase {
    /// Science and downlink in turn, by the windows.
    Orbit = 1,
    /// Downlink throughout.
    Cruise = 2,
}

/// From where downlinks are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DownlinkReference {
    /// From periapsis, a window after every guided.downlinkEvery of them.
    Periapsis = 1,
    /// From the start: one window.
    Start = 2,
}
