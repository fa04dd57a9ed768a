//! One simulation: `MomentumPlant` runs the orbit in the paper's attitude, `DisturbanceTorque` gives the force of light and heat.

use loader::Fmu;

use crate::attitude::{Attitude, Vector, angle_rad};
use crate::case::{self, RowReader, recorded};
use crate::settings::{Settings, set};
use crate::{Options, StudyError};

/// Mercury's sidereal revolution by the paper's semi-major axis, in s.
pub(super) const MERCURY_YEAR_S: f64 = 7_600_714.0;

/// Revolution of the spacecraft by Table 3, in s.
pub(super) const ORBIT_S: f64 = 43_446.6;

/// How the planet moves during a simulation, and how its shadow falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Planet {
    /// It stands still and casts a cylindrical shadow: the paper's analytical model.
    Still,
    /// It goes round the Sun, and no light comes as soon as the discs touch: the paper's numerical model.
    Moving,
}

/// What is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ThermalCase {
    /// Mercury's true anomaly at the start, in deg.
    pub true_anomaly_deg: f64,
    /// The planet.
    pub planet: Planet,
    /// Length, in s.
    pub duration_s: f64,
    /// Communication step, in s.
    pub step_s: f64,
    /// Belts of the planet's cells, as the paper sums; without them rings.
    pub belts: Option<i32>,
}

impl ThermalCase {
    /// How `MomentumPlant` runs along the orbit.
    fn trajectory(&self) -> case::Case {
        let label = format!("Mercury at {} deg", self.true_anomaly_deg);
        case::Case::new(label, self.duration_s, self.step_s)
            .set("guided.scienceRule", "fixedToSunLine")
            .set("guided.downlinkEvery", 0)
            .set("ephemeris.source", "kepler")
            .set("ephemeris.trueAnomaly", self.true_anomaly_deg.to_radians())
            .set("orbit.frame", "planetOrbit")
            .set("orbit.semiMajorAxis", 10_175_000.0)
            .set("eclipse.method", "off")
    }

    /// How `DisturbanceTorque` follows so many points of it.
    fn disturbance(&self, points: usize) -> case::Case {
        let eclipse = if self.planet == Planet::Still { "cylinder" } else { "cone" };
        let label = format!("Mercury at {} deg", self.true_anomaly_deg);
        let case = case::Case::new(label, points as f64 * self.step_s, self.step_s);
        let case = case.set("eclipse.method", eclipse);
        let Some(belts) = self.belts else { return case };
        case.set("planetLight.method", "cells").set("planetLight.belts", belts)
    }
}

/// Accelerations at one time, in m/s2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AccelerationSample {
    /// Time from the start, in s.
    pub time_s: f64,
    /// Mercury's true anomaly, in deg, counted on beyond 360.
    pub true_anomaly_deg: f64,
    /// Whether the Sun shines.
    pub lit: bool,
    /// Solar, albedo, infrared, thermal: magnitudes.
    pub effects: [f64; 4],
    /// Magnitude of the vector sum.
    pub total: f64,
    /// Magnitude of the vector sum without solar.
    pub without_solar: f64,
}

/// Names of the effects in [`AccelerationSample::effects`].
pub(super) const EFFECTS: [&str; 4] = ["solar", "albedo", "infrared", "thermal"];

/// Both FMUs.
pub(super) struct Fmus {
    plant: Fmu,
    disturbance: Fmu,
}

impl Fmus {
    /// Opens both in the folder `options` names.
    pub(super) fn open(options: &Options) -> Result<Self, StudyError> {
        Ok(Self {
            plant: options.fmu("MomentumPlant.fmu")?,
            disturbance: options.fmu("DisturbanceTorque.fmu")?,
        })
    }

    /// Runs one case.
    pub(super) fn simulate(&self, case: &ThermalCase) -> Result<Vec<AccelerationSample>, StudyError> {
        let trajectory = self.trajectory(case)?;
        let mut ahead = trajectory.iter();
        let mut inputs = |_: RowReader<'_>| ahead.next().map_or(Settings::new(), TrajectoryPoint::inputs);
        let forces = case.disturbance(trajectory.len());
        let forces: Vec<Forces> = forces.steer(&self.disturbance, Forces::NAMES, &mut inputs)?.all(0);
        let mut revolution = PlanetRevolution::default();
        let sample = |(point, forces): (&TrajectoryPoint, &Forces)| {
            let revolution_deg = revolution.to(&point.planet_m).to_degrees();
            AccelerationSample::of(point, case.true_anomaly_deg + revolution_deg, forces)
        };
        Ok(trajectory.iter().zip(&forces[1..]).map(sample).collect())
    }

    /// Where everything is at every communication point.
    fn trajectory(&self, case: &ThermalCase) -> Result<Vec<TrajectoryPoint>, StudyError> {
        let recorded = case.trajectory().simulate(&self.plant, TrajectoryPoint::NAMES)?;
        let mut points: Vec<TrajectoryPoint> = recorded.all(0);
        points.iter_mut().for_each(|point| point.planet_m -= point.position_m);
        if let (Planet::Still, Some(first)) = (case.planet, points.first().copied()) {
            for point in &mut points {
                (point.planet_m, point.q) = (first.planet_m, first.q);
            }
        }
        Ok(points)
    }
}

recorded! {
    /// One communication point of the trajectory, in EME2000.
    struct TrajectoryPoint {
        @time_s,
        /// Spacecraft from the planet's centre.
        position_m: Vector = "position",
        /// Planet from the Sun; the spacecraft, as it is recorded.
        planet_m: Vector = "heliocentric.position",
        /// EME2000 to body, scalar last.
        q: Attitude = "attitude.q",
        mass_kg: f64 = "mass",
    }
}

recorded! {
    /// What light and heat do at one point.
    struct Forces {
        /// Solar, albedo, infrared, thermal.
        effects_n: [Vector; 4] = "force.solar" "force.albedo" "force.infrared" "force.thermal",
        lit_fraction: f64 = "sun.litFraction",
    }
}

impl TrajectoryPoint {
    /// Sun and planet in the body frame.
    fn inputs(&self) -> Settings {
        let body = |name: &str, v: Vector| set(name, self.q.inverse_transform_vector(&v));
        let sun = body("sun.positionBody", -self.planet_m - self.position_m);
        [sun, body("planet.positionBody", -self.position_m)].concat()
    }
}

impl AccelerationSample {
    fn of(point: &TrajectoryPoint, true_anomaly_deg: f64, forces: &Forces) -> Self {
        let effects = forces.effects_n.map(|force_n| force_n / point.mass_kg);
        let without_solar: Vector = effects[1..].iter().sum();
        Self {
            time_s: point.time_s,
            true_anomaly_deg,
            lit: forces.lit_fraction > 0.0,
            effects: effects.map(|effect| effect.norm()),
            total: effects.iter().sum::<Vector>().norm(),
            without_solar: without_solar.norm(),
        }
    }
}

/// How far the planet has gone round.
#[derive(Default)]
struct PlanetRevolution {
    angle_rad: f64,
    last: Option<Vector>,
}

impl PlanetRevolution {
    fn to(&mut self, planet_m: &Vector) -> f64 {
        if let Some(last) = self.last.replace(*planet_m) {
            self.angle_rad += angle_rad(&last, planet_m);
        }
        self.angle_rad
    }
}
