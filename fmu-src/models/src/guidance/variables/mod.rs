//! Guidance's variables at its public face.

pub(super) mod burn;
pub(super) mod celestial_bodies;
pub(super) mod choices;
pub(super) mod commands;
pub(super) mod ephemeris;
pub(super) mod limits;
pub(super) mod momentum;
pub(super) mod outputs;

use fmi_export::{Boolean, Choice, Real, RealVector, Variables};
use physics::guidance::geometry::lighting;
use physics::guidance::modes::transitions;
use physics::guidance::pointing::scan::DEFAULT_COMPATIBILITY;

use super::setup::GuidanceSetup as Setup;
use crate::common::choices::SunshadeShape;
use crate::common::downlink::DownlinkVariables;
use crate::common::guided::GuidedVariables;
use crate::common::optics::OpticsVariables;
use crate::common::variables::{SolarVariables, WorkLimit};
use burn::{BurnVariables, ThrustVariables};
use celestial_bodies::{
    EarthVariables, EstimateVariables, PlanetVariables, StartVariables, SunVariables, TargetVariables,
};
use choices::{PointingScenario, SubsolarMethod};
use commands::{
    AimpointVariables, BodyRollVariables, BoresightVariables, ExternalRollVariables, LimbVariables,
    ModeVariables, ScanCompatibilityVariables, ScanVariables,
};
use ephemeris::EphemerisVariables;
use limits::{
    AntennaVariables, GimbalVariables, HotPoleVariables, KeepInVariables, LinkVariables, MonitorVariables,
    SafeHoldVariables, SunSearchVariables,
};
use momentum::{DumpVariables, MomentumVariables, PanelVariables};
use outputs::{CommandVariables, ConstraintVariables};

/// Every variable of guidance, in the order of the XML.
#[derive(Variables)]
pub struct GuidanceVariables {
    pub command: CommandVariables,
    pub mode: ModeVariables,
    pub start: StartVariables,
    pub target: TargetVariables,
    pub planet: PlanetVariables,
    pub ephemeris: EphemerisVariables,
    /// Which point of the ellipsoid it is.
    #[parameter(name = "subsolar.method", start = SubsolarMethod(lighting::SubsolarMethod::Normal))]
    pub subsolar_method: Choice<SubsolarMethod>,
    pub keep_in: KeepInVariables,
    #[group(name = "safeHold.keepIn")]
    pub safe_hold: SafeHoldVariables,
    pub hot_pole: HotPoleVariables,
    pub monitor: MonitorVariables,
    pub gimbal: GimbalVariables,
    pub antenna: AntennaVariables,
    pub link: LinkVariables,
    /// Rate about the boresight keepIn.axis (assumed; paper 001: slow).
    #[parameter(name = "earthAcquisition.rate", tunable, unit = "rad/s", display = "deg/s", min = -1.0, max = 1.0, start = transitions::EARTH_ACQUISITION_RATE_RAD_S)]
    pub earth_acquisition_rate: Real,
    pub sun_search: SunSearchVariables,
    #[group(setup = &setup.guided)]
    pub guided: GuidedVariables,
    pub downlink: DownlinkVariables,
    /// What is pointed at what. This and every input of a command is read once a second; one that is not 0 overrides the
    /// timeline's.
    #[input(name = "pointing.scenario", start = PointingScenario(None))]
    pub pointing_scenario: Choice<PointingScenario>,
    /// When the timeline's command ends, or where none is in force the next one begins; -1 where none does.
    #[output(name = "timeline.until", discrete, unit = "s", display = "d")]
    pub timeline_until: Real,
    pub boresight: BoresightVariables,
    pub aimpoint: AimpointVariables,
    pub second_aimpoint: AimpointVariables,
    pub body_roll: BodyRollVariables,
    pub external_roll: ExternalRollVariables,
    pub limb: LimbVariables,
    pub scan: ScanVariables,
    #[group(count = DEFAULT_COMPATIBILITY.len())]
    pub scan_compatibility: Vec<ScanCompatibilityVariables>,
    pub sun: SunVariables,
    pub earth: EarthVariables,
    pub estimate: EstimateVariables,
    /// Sum of their increments along the body axes since some start. Read together with estimate.q.
    #[input(name = "accelerometer.deltaV", unit = "m/s", display = "mm/s", min = -1e9, max = 1e9, start = [0.0; 3])]
    pub accelerometer_delta_v: RealVector<3>,
    pub burn: BurnVariables,
    pub thrust: ThrustVariables,
    /// Centre of mass in the body frame, with every panel at angle 0; panels that have a mass move it by the file's masses.
    #[parameter(name = "spacecraft.centerOfMass", tunable, unit = "m", display = "cm", min = -1e4, max = 1e4, start = setup.spacecraft.mass_properties.center_of_mass_body_m.into())]
    pub spacecraft_center_of_mass: RealVector<3>,
    /// Which model of the shade takes the light; without a shade it does not count.
    #[parameter(name = "sunshade.shape", start = SunshadeShape::for_spacecraft(&setup.spacecraft))]
    pub sunshade_shape: Choice<SunshadeShape>,
    #[group(setup = &setup.optics)]
    pub optics: OpticsVariables,
    pub solar: SolarVariables,
    #[group(count = setup.spacecraft.panels.len())]
    pub panel: Vec<PanelVariables>,
    pub momentum: MomentumVariables,
    pub dump: DumpVariables,
    /// Whether a roll vector lies along its primary vector, so that a fallback stands in for it, or there is no command at
    /// all for lack of a direction.
    #[output(name = "geometry.degenerate")]
    pub geometry_degenerate: Boolean,
    pub constraint: ConstraintVariables,
    pub solver: WorkLimit,
    /// Position of the spacecraft about the target planet in EME2000; zero: not connected yet.
    #[input(unit = "m", display = "km", start = [0.0; 3])]
    #[annotation(interpolation = "position", rate = "velocity[i]")]
    pub position: RealVector<3>,
    /// Its velocity.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    pub velocity: RealVector<3>,
    /// Present epoch, seconds past J2000 TDB.
    #[output(unit = "s", display = "d", nominal = 1e8)]
    #[annotation(role = "epoch")]
    pub epoch: Real,
}
