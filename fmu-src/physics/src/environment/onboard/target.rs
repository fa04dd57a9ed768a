//! What a flown ephemeris places: a body or the spacecraft.

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
    /// The spacecraft.
    Spacecraft,
}

impl OnboardTarget {
    /// The body; `None` for the spacecraft.
    pub fn body(self) -> Option<Body> {
        Some(match self {
            Self::Sun => Body::Sun,
            Self::Mercury => Body::Mercury,
            Self::Venus => Body::Venus,
            Self::Earth => Body::Earth,
            Self::Mars => Body::Mars,
            Self::Jupiter => Body::Jupiter,
            Self::Spacecraft => return None,
        })
    }
}

impl From<Body> for OnboardTarget {
    fn from(body: Body) -> Self {
        match body {
            Body::Sun => Self::Sun,
            Body::Mercury => Self::Mercury,
            Body::Venus => Self::Venus,
            Body::Earth => Self::Earth,
            Body::Mars => Self::Mars,
            Body::Jupiter => Self::Jupiter,
        }
    }
}

/// As it is written in the file.
impl fmt::Display for OnboardTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sun => "sun",
            Self::Mercury => "mercury",
            Self::Venus => "venus",
            Self::Earth => "earth",
            Self::Mars => "mars",
            Self::Jupiter => "jupiter",
            Self::Spacecraft => "spacecraft",
        })
    }
}
