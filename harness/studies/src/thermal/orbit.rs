//! One simulation: `MomentumPlant` runs the orbit in the paper's attitude, `DisturbanceTorque` gives the force of light and heat.

use loader::{Fmu, Instance, InstanceOptions, Value};

use crate::case;
use crate::vector::{Vector, cross, dot, turn};
use crate::{Options, StudyError};

/// Mercury's sidereal revolution by the paper's semi-major axis, in s.
pub const MERCURY_YEAR_S: f64 = 7_600_714.0;

/// Revolution of the spacecraft by Table 3, in s.
pub const ORBIT_S: f64 = 43_446.6;

/// How the planet moves during a simulation, and how its shadow falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planet {
    /// It stands still and casts a cylindrical shadow: the paper's analytical model.
    Still,
    /// It goes round the Sun, and no light comes as soon as the discs touch: the paper's numerical model.
    Moving,
}

/// What is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
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

impl Case {
    /// How `MomentumPlant` runs along the orbit.
    fn trajectory(&self) -> case::Case {
        let label = format!("Mercury at {} deg", self.true_anomaly_deg);
        case::Case::new(label, self.duration_s, self.step_s)
            .integer("guided.scienceRule", 3)
            .integer("guided.downlinkEvery", 0)
            .integer("ephemeris.source", 2)
            .real("ephemeris.trueAnomaly", self.true_anomaly_deg.to_radians())
            .integer("orbit.frame", 1)
            .real("orbit.semiMajorAxis", 10_175_000.0)
            .integer("eclipse.method", 4)
    }
}

/// Accelerations at one time, in m/s2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
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

/// Names of the effects in [`Sample::effects`].
pub const EFFECTS: [&str; 4] = ["solar", "albedo", "infrared", "thermal"];

/// Both FMUs.
pub struct Fmus {
    plant: Fmu,
    disturbance: Fmu,
}

impl Fmus {
    /// Opens both in the folder `options` names.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        Ok(Self {
            plant: options.fmu("MomentumPlant.fmu")?,
            disturbance: options.fmu("DisturbanceTorque.fmu")?,
        })
    }

    /// Runs one case.
    pub fn simulate(&self, case: &Case) -> Result<Vec<Sample>, StudyError> {
        let trajectory_case = case.trajectory();
        let fail = |error: loader::Error| trajectory_case.failed(error);
        let trajectory = self.trajectory(case, &trajectory_case)?;
        let mut disturbance = DisturbanceRun::start(&self.disturbance, case).map_err(fail)?;
        let mut samples = Vec::with_capacity(trajectory.len());
        let mut revolution = PlanetRevolution::default();
        for point in &trajectory {
            let true_anomaly_deg = case.true_anomaly_deg + revolution.to(&point.planet_m).to_degrees();
            samples.push(disturbance.at(point, true_anomaly_deg).map_err(fail)?);
        }
        Ok(samples)
    }

    /// Where everything is at every communication point.
    fn trajectory(&self, case: &Case, trajectory: &case::Case) -> Result<Vec<TrajectoryPoint>, StudyError> {
        let vectors = [("position", 3), ("heliocentric.position", 3), ("attitude.q", 4)];
        let names: Vec<String> = vectors
            .iter()
            .flat_map(|(name, count)| (1..=*count).map(move |i| format!("{name}[{i}]")))
            .chain(["mass".to_owned()])
            .collect();
        let recorded = trajectory.simulate(&self.plant, &names)?;
        let mut points: Vec<TrajectoryPoint> = recorded
            .times_s
            .iter()
            .enumerate()
            .map(|(row, &time_s)| {
                let value = |column: usize| recorded.columns[column][row];
                let position_m = [0, 1, 2].map(value);
                let heliocentric_m = [3, 4, 5].map(value);
                let planet_m = [0, 1, 2].map(|i| heliocentric_m[i] - position_m[i]);
                TrajectoryPoint {
                    time_s,
                    position_m,
                    planet_m,
                    q: [6, 7, 8, 9].map(value),
                    mass_kg: value(10),
                }
            })
            .collect();
        if let (Planet::Still, Some(first)) = (case.planet, points.first().copied()) {
            for point in &mut points {
                *point = TrajectoryPoint { planet_m: first.planet_m, q: first.q, ..*point };
            }
        }
        Ok(points)
    }
}

/// One communication point of the trajectory, in EME2000.
#[derive(Clone, Copy, Debug)]
struct TrajectoryPoint {
    time_s: f64,
    /// Spacecraft from the planet's centre.
    position_m: Vector,
    /// Planet from the Sun.
    planet_m: Vector,
    /// EME2000 to body, scalar last.
    q: [f64; 4],
    mass_kg: f64,
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
            let across = cross(&last, planet_m);
            self.angle_rad += dot(&across, &across).sqrt().atan2(dot(&last, planet_m));
        }
        self.angle_rad
    }
}

/// An instance of `DisturbanceTorque`, stepped along a trajectory.
struct DisturbanceRun {
    instance: Instance,
    inputs: Vec<u32>,
    outputs: Vec<u32>,
    step_s: f64,
    steps: u32,
}

impl DisturbanceRun {
    fn start(fmu: &Fmu, case: &Case) -> Result<Self, loader::Error> {
        let mut instance = Instance::new(fmu, "disturbance", &InstanceOptions::default())?;
        let eclipse = if case.planet == Planet::Still { 3 } else { 2 };
        instance.set("eclipse.method", &Value::Integer(eclipse))?;
        if let Some(belts) = case.belts {
            instance.set("planetLight.method", &Value::Integer(2))?;
            instance.set("planetLight.belts", &Value::Integer(belts))?;
        }
        instance.setup_experiment(None, 0.0, None)?;
        instance.enter_initialization_mode()?;
        instance.exit_initialization_mode()?;
        let reference = |name: String| fmu.variable(&name).map(|variable| variable.value_reference);
        let vector = |name: &str| (1..=3).map(|i| format!("{name}[{i}]")).collect::<Vec<_>>();
        let inputs = ["sun.positionBody", "planet.positionBody"].iter().flat_map(|name| vector(name));
        let outputs = EFFECTS.iter().flat_map(|effect| vector(&format!("force.{effect}")));
        Ok(Self {
            inputs: inputs.map(reference).collect::<Result<_, _>>()?,
            outputs: outputs
                .chain(["sun.litFraction".to_owned()])
                .map(reference)
                .collect::<Result<_, _>>()?,
            instance,
            step_s: case.step_s,
            steps: 0,
        })
    }

    fn at(&mut self, point: &TrajectoryPoint, true_anomaly_deg: f64) -> Result<Sample, loader::Error> {
        let to_sun = [0, 1, 2].map(|i| -point.planet_m[i] - point.position_m[i]);
        let [sun, planet] = [to_sun, point.position_m.map(|x| -x)].map(|v| turn(&point.q, &v));
        let inputs: Vec<f64> = sun.into_iter().chain(planet).collect();
        self.instance.set_reals(&self.inputs, &inputs)?;
        self.instance.do_step(f64::from(self.steps) * self.step_s, self.step_s, true)?;
        self.steps += 1;
        let mut outputs = [0.0; 13];
        self.instance.get_reals(&self.outputs, &mut outputs)?;
        let effect = |index: usize| -> Vector { [0, 1, 2].map(|i| outputs[3 * index + i] / point.mass_kg) };
        let sum = |effects: &[usize]| {
            let vector = [0, 1, 2].map(|i| effects.iter().map(|&k| effect(k)[i]).sum::<f64>());
            dot(&vector, &vector).sqrt()
        };
        Ok(Sample {
            time_s: point.time_s,
            true_anomaly_deg,
            lit: outputs[12] > 0.0,
            effects: [0, 1, 2, 3].map(|k| sum(&[k])),
            total: sum(&[0, 1, 2, 3]),
            without_solar: sum(&[1, 2, 3]),
        })
    }
}
