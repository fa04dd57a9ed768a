//! The phased-array antennas: one on the sunshade for azimuths of -90 to 0 deg, one on the back for 90 to 180 deg.

use core::f64::consts::{FRAC_PI_4, PI, TAU};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::SunAngles;
use crate::enumeration::enumeration;

/// An azimuth this little outside a quadrant counts as inside, in rad.
pub const BOUND_RAD: f64 = 1e-12;

enumeration! {
    /// A phased-array antenna.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Antenna {
        /// None: no downlink.
        #[default]
        0 => None,
        /// Beside the sunshade, azimuth -90 to 0 deg.
        1 => Sunshade,
        /// At the back, azimuth 90 to 180 deg.
        2 => Back,
    }
}

/// Where an antenna looks in the XY plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntennaAzimuth {
    /// The antenna.
    pub antenna: Antenna,
    /// Azimuth in its quadrant, in rad.
    pub azimuth_rad: f64,
    /// How far off the azimuth that was requested lies, in rad.
    pub outside_rad: f64,
}

/// What an antenna's beam is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beam {
    /// The Earth, wherever constraints leave it.
    AtTheEarth(AntennaAzimuth),
    /// A commanded azimuth.
    Commanded(AntennaAzimuth),
}

impl Antenna {
    /// Both antennas.
    pub const ALL: [Self; 2] = [Self::Sunshade, Self::Back];

    /// Middle of the quadrant; `None` for no antenna.
    fn middle_rad(self) -> Option<f64> {
        match self {
            Self::None => None,
            Self::Sunshade => Some(-FRAC_PI_4),
            Self::Back => Some(3.0 * FRAC_PI_4),
        }
    }

    /// The azimuth of its quadrant nearest to `azimuth_rad`; `None` for no antenna.
    pub fn nearest(self, azimuth_rad: f64) -> Option<AntennaAzimuth> {
        let middle_rad = self.middle_rad()?;
        let off_rad = (azimuth_rad - middle_rad + PI).rem_euclid(TAU) - PI;
        Some(AntennaAzimuth {
            antenna: self,
            azimuth_rad: middle_rad + off_rad.clamp(-FRAC_PI_4, FRAC_PI_4),
            outside_rad: (off_rad.abs() - FRAC_PI_4).max(0.0),
        })
    }
}

impl AntennaAzimuth {
    /// Of the antenna nearest to an azimuth; midway between two bounds that of the sunshade.
    pub fn of(azimuth_rad: f64) -> Self {
        let none = Self { antenna: Antenna::None, azimuth_rad, outside_rad: f64::INFINITY };
        let nearer = |best: Self, next: Self| if next.outside_rad < best.outside_rad { next } else { best };
        Antenna::ALL.into_iter().filter_map(|antenna| antenna.nearest(azimuth_rad)).fold(none, nearer)
    }

    /// Of the antenna nearest to a body-frame direction.
    pub fn toward(direction_body: &Vector3<f64>) -> Self {
        Self::of(SunAngles::of(direction_body).azimuth_rad)
    }

    /// How far a body-frame azimuth is from it, in rad.
    pub fn off_rad(&self, azimuth_rad: f64) -> f64 {
        ((azimuth_rad - self.azimuth_rad + PI).rem_euclid(TAU) - PI).abs()
    }

    /// Whether it is the azimuth that was requested.
    pub fn is_in_range(&self) -> bool {
        self.outside_rad <= BOUND_RAD
    }
}
