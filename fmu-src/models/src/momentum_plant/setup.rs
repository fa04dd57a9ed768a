//! The model and its immutable setup: the spacecraft and what is computed from it once.

use std::sync::Arc;

use fmi_export::{Context, Failure, Model, SetupError};
use physics::environment::ephemeris::EphemerisCache;
use physics::environment::onboard::OnboardEphemeris;
use physics::environment::orbit::OrbitMethod;
use physics::guidance::geometry::lighting::SubsolarMethod;
use physics::guidance::pointing::boresight::Gimbal;
use physics::guidance::pointing::scan::ScanCompatibility;
use physics::guidance::scenario::GuidanceHardware;
use physics::guidance::timeline::{Timeline, TimelineLaw};
use physics::plant::{ControlDefaults, PanelStep, PreparedSpacecraft};
use physics::spacecraft::{Spacecraft, SunKeepIn, SunshadeModel};
use serde::{Serialize, Serializer};

use crate::common::center::{CenterBodies, CenterBody, center_of};
use crate::common::effects::check_start;
use crate::common::guided::GuidedDefaults;
use crate::common::optics::SettableMaterials;
use crate::common::spacecraft::{
    PreparedAntennas, PreparedShapes, ReportedFace, reported_faces, wheel_array,
};
use crate::common::value_reader::ValueReader;

/// The momentum plant.
pub struct MomentumPlant;

/// Context of every call of the model.
pub(super) type Plan<'a> = Context<'a, MomentumPlant>;

/// Reader of the model's variables in one call.
pub(super) type Read<'a> = ValueReader<'a, MomentumPlant>;

/// The spacecraft of an instance.
#[derive(Clone, Debug)]
pub struct PlantSetup {
    /// As read from the file.
    pub spacecraft: Spacecraft,
    /// The centre of its orbit by its file, by which the defaults of the parameters go.
    pub center: CenterBody,
    /// Bodies with what the file gives of one.
    pub bodies: CenterBodies,
    /// Start values of guided flight.
    pub guided: GuidedDefaults,
    /// The antennas, and the default downlink with them.
    pub antennas: PreparedAntennas,
    /// Prepared for sunlight.
    shapes: PreparedShapes,
    /// Materials whose numbers are parameters.
    pub optics: SettableMaterials,
    /// The faces reported one by one, with the panel each belongs to; empty unless the file asks for that.
    pub reported_faces: Vec<ReportedFace>,
    /// Limits of turns and dumps that the wheels allow.
    pub control: ControlDefaults,
    /// Positions of Sun and planets over time, if there is a file of them; they do not enter the GUID.
    pub ephemeris: Option<Arc<OnboardEphemeris>>,
    /// Commands over time, if there is a file of them; it does not enter the GUID.
    pub timeline: Option<Arc<Timeline>>,
    /// Digest of both files: a state continues by others, what was computed ahead does not.
    pub schedules: u64,
    /// Its panels, one by one; empty where there is none.
    pub panel_steps: Vec<Arc<[PanelStep]>>,
    /// How disturbed orbits are integrated.
    orbit_method: OrbitMethod,
    /// Planets' segments, kept over a reset.
    pub ephemeris_cache: EphemerisCache,
}

/// The file enters the GUID; all else follows from it, or is a schedule.
impl Serialize for PlantSetup {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.spacecraft.serialize(serializer)
    }
}

impl PlantSetup {
    /// From TOML text.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, SetupError> {
        let spacecraft = Spacecraft::from_toml(file, text).map_err(|error| SetupError(error.to_string()))?;
        check_start(file, &spacecraft, MomentumPlant::NAME)?;
        let bodies = CenterBodies::new(file, &spacecraft)?;
        let center = bodies.body(center_of(&spacecraft));
        Ok(Self {
            optics: SettableMaterials::new(&spacecraft, center.data.body, MomentumPlant::NAME),
            center,
            bodies,
            guided: GuidedDefaults::new(&spacecraft, &center),
            control: ControlDefaults::new(&spacecraft, &wheel_array(&spacecraft)),
            reported_faces: reported_faces(file, &spacecraft)?,
            antennas: PreparedAntennas::new(&spacecraft),
            shapes: PreparedShapes::new(&spacecraft),
            ephemeris: None,
            timeline: None,
            schedules: 0,
            panel_steps: Vec::new(),
            orbit_method: OrbitMethod::default(),
            ephemeris_cache: EphemerisCache::default(),
            spacecraft,
        })
    }

    /// Reads the commands of a timeline.
    pub fn set_timeline(&mut self, file: &str, text: &str) -> Result<(), SetupError> {
        let timeline = Timeline::of_plant(file, text, &self.spacecraft);
        let timeline = timeline.map_err(|error| SetupError(error.to_string()))?;
        let panels = self.spacecraft.panels.iter().enumerate();
        self.panel_steps =
            panels.map(|(k, panel)| PanelStep::of_timeline(&timeline.panels, k, panel)).collect();
        self.timeline = Some(Arc::new(timeline));
        Ok(())
    }

    /// The keep-in zone; without one in the file every direction is allowed.
    pub fn keep_in(&self) -> SunKeepIn {
        use core::f64::consts::{FRAC_PI_2, PI};
        let everywhere =
            SunKeepIn { azimuth_rad: PI, elevation_rad: FRAC_PI_2, distance_m: SunKeepIn::FARTHEST_M };
        self.spacecraft.sun_keep_in.unwrap_or(everywhere)
    }

    /// The spacecraft, with its shade modelled as requested.
    pub fn prepared_spacecraft(&self, model: SunshadeModel) -> Result<PreparedSpacecraft<'_>, Failure> {
        Ok(PreparedSpacecraft {
            panels: &self.spacecraft.panels,
            solar: self.shapes.solar(model, &self.spacecraft.name)?,
            orbit_method: &self.orbit_method,
            default_downlink: &self.antennas.default_downlink,
            timeline: self.timeline.as_deref().map(|timeline| TimelineLaw {
                timeline,
                hardware: GuidanceHardware {
                    instruments: &self.spacecraft.instruments,
                    gimbal: Gimbal::from_instruments(&self.spacecraft.instruments),
                    antennas: &self.antennas.all,
                    default_downlink: &self.antennas.default_downlink,
                    subsolar: SubsolarMethod::default(),
                    scans: ScanCompatibility::default(),
                },
            }),
        })
    }
}
