//! Guidance's variables at its public face.

pub(super) mod burn;
pub(super) mod celestial_bodies;
pub(super) mod choices;
pub(super) mod commands;
pub(super) mod ephemeris;
pub(super) mod limits;
pub(super) mod momentum;
pub(super) mod outputs;

use fmi_export::{Real, RealVector, Variables};
use physics::guidance::pointing::scan::DEFAULT_COMPATIBILITY;

use super::setup::GuidanceSetup;
use crate::common::downlink::DownlinkVariables;
use crate::common::variables::{GuidedVariables, SolarVariables, WorkLimit};
use burn::{AccelerometerVariables, BurnVariables, ThrustVariables};
use celestial_bodies::{
    EarthVariables, EstimateVariables, PlanetVariables, StartVariables, SubsolarVariables, SunVariables,
    TargetVariables,
};
use commands::{
    AimpointVariables, BodyRollVariables, BoresightVariables, ExternalRollVariables, LimbVariables,
    ModeVariables, PointingVariables, ScanCompatibilityVariables, ScanVariables,
};
use ephemeris::EphemerisVariables;
use limits::{
    AntennaVariables, EarthAcquisitionVariables, GimbalVariables, HotPoleVariables, KeepInVariables,
    LinkVariables, MonitorVariables, SafeHoldVariables, SunSearchVariables,
};
use momentum::{DumpVariables, MomentumVariables, PanelVariables, SpacecraftVariables, SunshadeVariables};
use outputs::{CommandVariables, ConstraintVariables, GeometryVariables};

/// Every variable of guidance, in the order of the XML.
#[derive(Variables)]
#[variables(setup = GuidanceSetup)]
pub struct GuidanceVariables {
    #[group]
    pub command: CommandVariables,
    #[group]
    pub mode: ModeVariables,
    #[group]
    pub start: StartVariables,
    #[group]
    pub target: TargetVariables,
    #[group]
    pub planet: PlanetVariables,
    #[group]
    pub ephemeris: EphemerisVariables,
    #[group]
    pub subsolar: SubsolarVariables,
    #[group]
    pub keep_in: KeepInVariables,
    #[group]
    pub safe_hold: SafeHoldVariables,
    #[group]
    pub hot_pole: HotPoleVariables,
    #[group]
    pub monitor: MonitorVariables,
    #[group]
    pub gimbal: GimbalVariables,
    #[group]
    pub antenna: AntennaVariables,
    #[group]
    pub link: LinkVariables,
    #[group]
    pub earth_acquisition: EarthAcquisitionVariables,
    #[group]
    pub sun_search: SunSearchVariables,
    #[group(setup = &setup.windows)]
    pub guided: GuidedVariables,
    #[group]
    pub downlink: DownlinkVariables,
    #[group]
    pub pointing: PointingVariables,
    #[group]
    pub boresight: BoresightVariables,
    #[group]
    pub aimpoint: AimpointVariables,
    #[group]
    pub second_aimpoint: AimpointVariables,
    #[group]
    pub body_roll: BodyRollVariables,
    #[group]
    pub external_roll: ExternalRollVariables,
    #[group]
    pub limb: LimbVariables,
    #[group]
    pub scan: ScanVariables,
    #[group(count = DEFAULT_COMPATIBILITY.len())]
    pub scan_compatibility: Vec<ScanCompatibilityVariables>,
    #[group]
    pub sun: SunVariables,
    #[group]
    pub earth: EarthVariables,
    #[group]
    pub estimate: EstimateVariables,
    #[group]
    pub accelerometer: AccelerometerVariables,
    #[group]
    pub burn: BurnVariables,
    #[group]
    pub thrust: ThrustVariables,
    #[group]
    pub spacecraft: SpacecraftVariables,
    #[group]
    pub sunshade: SunshadeVariables,
    #[group]
    pub solar: SolarVariables,
    #[group(count = setup.spacecraft.panels.len())]
    pub panel: Vec<PanelVariables>,
    #[group]
    pub momentum: MomentumVariables,
    #[group]
    pub dump: DumpVariables,
    #[group]
    pub geometry: GeometryVariables,
    #[group]
    pub constraint: ConstraintVariables,
    #[group]
    pub solver: WorkLimit,
    /// Position of the spacecraft about the target planet in EME2000; zero: not connected yet.
    #[input(unit = "m", display = "km", start = [0.0; 3])]
    pub position: RealVector<3>,
    /// Its velocity.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    pub velocity: RealVector<3>,
    /// Present epoch, seconds past J2000 TDB.
    #[output(unit = "s", display = "d", nominal = 1e8)]
    pub epoch: Real,
}
