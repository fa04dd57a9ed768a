//! Target of an onboard ephemeris: a body or the spacecraft.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::bodies::Body;

/// What is placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase")]
pub enum OnboardTarget {
    /// The Sun.
    Sun,
    /// Mercury.
    Mercury,
    /// Venus.
    Venus,
    /// The Earth.
    Earth,
    /// Mars.
    Mars,
    /// Jupiter.
    Jupiter,
    /// The body that the spacecraft's file describes.
    Custom,
    /// The spacecraft.
    Spacecraft,
    /// The Moon.
    Moon,
}

impl OnboardTarget {
    /// Targets that are bodies, in their order.
    const BODIES: [Self; Body::COUNT] =
        [Self::Sun, Self::Mercury, Self::Venus, Self::Earth, Self::Mars, Self::Jupiter, Self::Custom];
    /// As they are written in the file.
    const NAMES: [&str; Body::COUNT + 2] =
        ["sun", "mercury", "venus", "earth", "mars", "jupiter", "custom", "spacecraft", "moon"];

    /// The body; `None` for the spacecraft and for the Moon, about which there are no orbits.
    pub fn body(self) -> Option<Body> {
        let all = Body::ALL.into_iter().chain([Body::Custom]);
        all.into_iter().find(|body| Self::from(*body) == self)
    }
}

impl From<Body> for OnboardTarget {
    fn from(body: Body) -> Self {
        Self::BODIES[body as usize]
    }
}

/// As it is written in the file.
impl fmt::Display for OnboardTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAMES[*self as usize])
    }
}
