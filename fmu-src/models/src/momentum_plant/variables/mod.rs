//! The plant's variables at its public face.

pub(super) mod air_and_field;
pub(super) mod body;
mod celestial_bodies;
pub(super) mod choices;
mod control;
mod effects;
mod flexibility;
pub(super) mod motion;
mod osculating;
mod propulsion;

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Variables};

use air_and_field::{AtmosphereVariables, GeodeticVariables, MagneticFieldVariables, SpaceWeatherVariables};
use body::{
    ArticulationVariables, KeepInVariables, PanelVariables, SpacecraftVariables, SunshadeVariables,
    WheelVariables,
};
use celestial_bodies::{EarthVariables, PlanetVariables, SunVariables};
use choices::EphemerisSource;
use control::{ControlVariables, EstimateVariables, GyroVariables, StarTrackerVariables, SunSensorVariables};
use effects::{DumpVariables, ForceVariables, MomentumVariables, SolverVariables, TorqueVariables};
use flexibility::{FlexibleModeVariables, SloshVariables};
use motion::{
    AttitudeVariables, CommandVariables, EncounterVariables, OrbitVariables, PredictionVariables,
    StartVariables, TimelineVariables,
};
use osculating::OsculatingVariables;
use propulsion::{
    AccelerometerVariables, ManeuverVariables, TankVariables, ThrustVariables, ThrusterVariables,
};

use super::setup::PlantSetup as Setup;
use crate::common::downlink::DownlinkVariables;
use crate::common::effects::{LawVariables, PlanetLightVariables, RecoilVariables, ShadowingVariables};
use crate::common::ellipse::EllipseVariables;
use crate::common::guided::GuidedVariables;
use crate::common::loads::PlateVariables;
use crate::common::optics::OpticsVariables;
use crate::common::variables::{EclipseVariables, SolarVariables};

/// Every variable of the plant, in the order of the XML.
#[derive(Variables)]
pub struct PlantVariables {
    pub attitude: AttitudeVariables,
    pub command: CommandVariables,
    #[group(setup = &setup.guided)]
    pub guided: GuidedVariables,
    /// Whether both targets of the attitude lie on one line within 1e-9 rad, so that a substitute stands in for the second one: the
    /// north of EME2000, along that its equinox. Of a downlink, a turn and the rules scaled to fixedToSunLine false.
    #[output(name = "guided.degenerate")]
    pub guided_degenerate: Boolean,
    pub downlink: DownlinkVariables,
    pub timeline: TimelineVariables,
    pub start: StartVariables,
    pub orbit: OrbitVariables,
    pub osculating: OsculatingVariables,
    pub encounter: EncounterVariables,
    pub prediction: PredictionVariables,
    pub planet: PlanetVariables,
    /// Where the positions of Sun and Earth come from.
    #[parameter(name = "ephemeris.source", start = EphemerisSource::Vsop87)]
    pub ephemeris_source: Choice<EphemerisSource>,
    #[group(setup = &setup.center)]
    pub ephemeris: EllipseVariables,
    pub solar: SolarVariables,
    pub eclipse: EclipseVariables,
    pub planet_light: PlanetLightVariables,
    pub thermal: RecoilVariables,
    /// Whether surfaces whose file gives a heat capacity store heat, and stay warm into an eclipse; otherwise every surface
    /// is in balance with its light.
    #[parameter(name = "thermal.storage", start = true)]
    pub thermal_storage: Boolean,
    pub shadowing: ShadowingVariables,
    #[group(name = "", setup = &setup.center)]
    pub laws: LawVariables,
    pub atmosphere: AtmosphereVariables,
    pub space_weather: SpaceWeatherVariables,
    pub magnetic_field: MagneticFieldVariables,
    pub geodetic: GeodeticVariables,
    pub spacecraft: SpacecraftVariables,
    #[group(setup = &setup.optics)]
    pub optics: OpticsVariables,
    pub sunshade: SunshadeVariables,
    #[group(count = setup.spacecraft.panels.len())]
    pub panel: Vec<PanelVariables>,
    pub articulation: ArticulationVariables,
    #[group(count = setup.spacecraft.wheels.len())]
    pub wheel: Vec<WheelVariables>,
    #[group(count = setup.spacecraft.flexible_modes.len())]
    pub flexible_mode: Vec<FlexibleModeVariables>,
    #[group(count = setup.spacecraft.sloshes.len())]
    pub slosh: Vec<SloshVariables>,
    pub control: ControlVariables,
    pub estimate: EstimateVariables,
    pub star_tracker: StarTrackerVariables,
    pub gyro: GyroVariables,
    #[group(count = setup.spacecraft.sun_sensors.len())]
    pub sun_sensor: Vec<SunSensorVariables>,
    pub accelerometer: AccelerometerVariables,
    #[group(count = setup.spacecraft.thrusters.len())]
    pub thruster: Vec<ThrusterVariables>,
    #[group(count = setup.spacecraft.tanks.len())]
    pub tank: Vec<TankVariables>,
    /// Propellant used since the start.
    #[output(name = "propellant.used", unit = "kg", nominal = 1.0)]
    pub propellant_used: Real,
    pub thrust: ThrustVariables,
    pub maneuver: ManeuverVariables,
    /// Seed of all random numbers; each is a function of this and of the number of its sample.
    #[parameter(name = "noise.seed", min = 0, max = i32::MAX, start = 1)]
    pub noise_seed: Integer,
    pub keep_in: KeepInVariables,
    pub momentum: MomentumVariables,
    pub dump: DumpVariables,
    pub torque: TorqueVariables,
    pub force: ForceVariables,
    pub sun: SunVariables,
    pub earth: EarthVariables,
    /// Position about the Sun in EME2000.
    #[output(name = "heliocentric.position", unit = "m", display = "AU", nominal = 1e11)]
    pub heliocentric_position: RealVector<3>,
    pub solver: SolverVariables,
    /// Present epoch, seconds past J2000 TDB.
    #[output(unit = "s", display = "d", nominal = 1e8)]
    #[annotation(role = "epoch")]
    pub epoch: Real,
    /// Acceleration by the forces listed here, without gravity, in EME2000.
    #[output(unit = "m/s2", display = "nm/s2", nominal = 1e-7)]
    pub acceleration: RealVector<3>,
    /// Velocity change since the start by the forces listed here, without gravity, in EME2000.
    #[output(unit = "m/s", display = "mm/s", nominal = 1e-3)]
    pub delta_v: RealVector<3>,
    /// Position about the orbit's centre, in EME2000.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    #[annotation(interpolation = "position", rate = "velocity[i]")]
    pub position: RealVector<3>,
    /// Velocity about the orbit's centre, in EME2000.
    #[output(unit = "m/s", display = "km/s", nominal = 1e3)]
    pub velocity: RealVector<3>,
    /// Spacecraft mass.
    #[output(unit = "kg", nominal = 1e3)]
    pub mass: Real,
    /// Centre of mass in the body frame.
    #[output(unit = "m", display = "cm")]
    pub center_of_mass: RealVector<3>,
    #[group(count = setup.reported_faces.len(), setup = &setup.reported_faces)]
    pub plate: Vec<PlateVariables>,
}
