//! The model and its immutable setup: the spacecraft that is pointed.

use std::sync::Arc;

use fmi_export::{Context, Model, SetupError};
use physics::environment::ephemeris::EphemerisCache;
use physics::environment::onboard::OnboardEphemeris;
use physics::guidance::pointing::boresight::Gimbal;
use physics::guidance::timeline::Timeline;
use physics::plant::ControlDefaults;
use physics::spacecraft::{HotPoleZone, Spacecraft, SunKeepIn};
use serde::{Serialize, Serializer};

use crate::common::center::{CenterBodies, CenterBody, target_of};
use crate::common::guided::GuidedDefaults;
use crate::common::optics::SettableMaterials;
use crate::common::spacecraft::{PreparedAntennas, PreparedShapes, wheel_array};
use crate::common::value_reader::ValueReader;

/// Guidance.
pub struct Guidance;

/// Context of every call of the model.
pub(super) type Plan<'a> = Context<'a, Guidance>;

/// Reader of the model's variables in one call.
pub(super) type Read<'a> = ValueReader<'a, Guidance>;

/// The spacecraft of an instance.
#[derive(Clone, Debug)]
pub struct GuidanceSetup {
    /// As read from the file.
    pub spacecraft: Spacecraft,
    /// The planet that is observed by the file, and the defaults of the parameters go by.
    pub target: CenterBody,
    /// Bodies with what the file gives of one.
    pub bodies: CenterBodies,
    /// Start values of guided flight.
    pub guided: GuidedDefaults,
    /// The antennas, and the default downlink with them.
    pub antennas: PreparedAntennas,
    /// Prepared for sunlight.
    pub shapes: PreparedShapes,
    /// Materials whose numbers are parameters.
    pub optics: SettableMaterials,
    /// Planets' segments, kept over a reset.
    pub ephemeris_cache: EphemerisCache,
    /// Positions over time, if there is a file of them; they do not enter the GUID.
    pub ephemeris: Option<Arc<OnboardEphemeris>>,
    /// Commands over time, if there is a file of them; it does not enter the GUID.
    pub timeline: Option<Timeline>,
}

/// The file enters the GUID; all else follows from it, or is a schedule.
impl Serialize for GuidanceSetup {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.spacecraft.serialize(serializer)
    }
}

impl GuidanceSetup {
    /// From TOML text.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SetupError> {
        let spacecraft = Spacecraft::from_toml(file, text).map_err(|error| SetupError(error.to_string()))?;
        let bodies = CenterBodies::new(file, &spacecraft)?;
        let target = bodies.body(target_of(&spacecraft, Guidance::NAME));
        Ok(Self {
            target,
            bodies,
            guided: GuidedDefaults::new(&spacecraft, &target),
            antennas: PreparedAntennas::new(&spacecraft),
            shapes: PreparedShapes::new(&spacecraft),
            optics: SettableMaterials::in_sunlight(&spacecraft),
            spacecraft,
            ephemeris_cache: EphemerisCache::default(),
            ephemeris: None,
            timeline: None,
        })
    }

    /// How far beyond a boundary the controller may take an ordinary scan, in rad.
    pub fn monitor_margin_rad(&self) -> f64 {
        ControlDefaults::new(&self.spacecraft, &wheel_array(&self.spacecraft)).monitor_margin_rad
    }

    /// Takes the commands of a timeline.
    pub fn set_timeline(&mut self, file: &str, text: &str) -> Result<(), SetupError> {
        let timeline = Timeline::from_toml(file, text, &self.spacecraft);
        self.timeline = Some(timeline.map_err(|error| SetupError(error.to_string()))?);
        Ok(())
    }

    /// The keep-in zone; without one in the file the half of the sky on the axis's side.
    pub fn keep_in(&self) -> SunKeepIn {
        use core::f64::consts::FRAC_PI_2;
        let half =
            SunKeepIn { azimuth_rad: FRAC_PI_2, elevation_rad: FRAC_PI_2, distance_m: SunKeepIn::FARTHEST_M };
        self.spacecraft.sun_keep_in.map_or(half, |zone| zone.within(&half))
    }

    /// The hot pole of the file; without one in it no place.
    pub fn hot_pole(&self) -> HotPoleZone {
        self.spacecraft.hot_pole.unwrap_or(HotPoleZone { altitude_m: 0.0, angle_rad: 0.0, cone_rad: 0.0 })
    }

    /// Least and greatest angle of the gimbal by the file, in rad.
    pub fn gimbal_range_rad(&self) -> [f64; 2] {
        Gimbal::from_instruments(&self.spacecraft.instruments)
            .map_or([0.0; 2], |gimbal| [gimbal.minimum_rad, gimbal.maximum_rad])
    }

    /// Half the width of the first antenna's beam across the XY plane, in rad; 0 without antennas.
    pub fn beam_rad(&self) -> f64 {
        self.spacecraft.antennas.first().map_or(0.0, |named| named.antenna.half_across_rad())
    }

    /// The greatest number of an instrument.
    pub fn last_instrument(&self) -> i32 {
        i32::try_from(self.spacecraft.instruments.len()).unwrap_or(i32::MAX)
    }
}
