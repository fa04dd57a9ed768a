//! One flight: `MomentumPlant` moves along its orbit, `Guidance` commands; both get each other's outputs once a second.

use loader::{Error, Fmu, Instance, InstanceOptions, Value};

use super::planet::Planet;
use crate::settings::{Settings, digits, real, vector_setting};
use crate::vector::{Vector, body_angles_deg, difference, rotated, scaled, turn, turn_back};
use crate::{Options, StudyError};

/// 2009-04-06 00:00 TDB in seconds past J2000, the start of the default flight.
pub const DEFAULT_EPOCH_S: f64 = 292_248_000.0;

/// Both FMUs.
pub struct Fmus {
    plant: Fmu,
    guidance: Fmu,
}

/// Where everything is at one second, in EME2000.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Time from the start, in s.
    pub time_s: f64,
    /// Past J2000 TDB, in s.
    pub epoch_s: f64,
    /// Spacecraft from the planet's centre, in m.
    pub position_m: Vector,
    /// Its velocity, in m/s.
    pub velocity_m_s: Vector,
    /// Spacecraft to the Sun, in m.
    pub to_sun_m: Vector,
    /// Spacecraft to the Earth: a unit vector.
    pub to_earth: Vector,
}

/// What was commanded at that second.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Where everything was.
    pub place: Place,
    /// Commanded attitude: EME2000 to body, scalar last.
    pub q: [f64; 4],
    /// Commanded rate, body frame, in rad/s.
    pub rate_rad_s: Vector,
    /// The camera's angle from +Z, positive sunward, in rad.
    pub mdis_angle_rad: f64,
    /// Whether the boresight is on the aimpoint.
    pub reachable: bool,
    /// Whether a scan moves it.
    pub scan_active: bool,
    /// Whether a constraint or a range changed the command.
    pub constrained: bool,
}

/// Columns of a sample's geometry in CSV files: EME2000, positions from the planet's centre.
pub const GEOMETRY: [&str; 15] = [
    "time_s", "epoch_s", "q1", "q2", "q3", "q4", "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s",
    "sun_x_m", "sun_y_m", "sun_z_m",
];

impl Sample {
    /// The cells of [`GEOMETRY`].
    pub fn geometry(&self) -> impl Iterator<Item = String> {
        let Place { time_s, epoch_s, position_m, velocity_m_s, .. } = self.place;
        let numbers = [time_s, epoch_s].into_iter().chain(self.q).chain(position_m).chain(velocity_m_s);
        numbers.chain(self.place.sun_m()).map(digits)
    }

    /// EME2000 direction of a body direction.
    pub fn inertial(&self, body: &Vector) -> Vector {
        turn_back(&self.q, body)
    }

    /// Azimuth and elevation of a direction in the body frame, in deg.
    pub fn body_angles_deg(&self, inertial: &Vector) -> [f64; 2] {
        body_angles_deg(&turn(&self.q, inertial))
    }
}

/// What is flown.
pub struct Flight<'a> {
    /// For messages and tables.
    pub label: &'a str,
    /// Past J2000 TDB, in s.
    pub epoch_s: f64,
    /// Where on the orbit it starts, in deg from periapsis.
    pub true_anomaly_deg: f64,
    /// Length, in s.
    pub seconds: u32,
    /// Parameters of `Guidance`.
    pub parameters: Settings,
    /// What is commanded from the place of each second on; nothing new where empty.
    pub command: &'a (dyn Fn(&Place) -> Settings + Sync),
}

/// The samples of a flight, one a second, and the planet it is over.
pub struct Flown {
    /// One a second from 0 on.
    pub samples: Vec<Sample>,
    /// By the parameters of `Guidance`.
    pub planet: Planet,
}

impl Fmus {
    /// Opens both in the folder `options` names.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        Ok(Self { plant: options.fmu("MomentumPlant.fmu")?, guidance: options.fmu("Guidance.fmu")? })
    }

    /// Flies it.
    pub fn fly(&self, flight: &Flight<'_>) -> Result<Flown, StudyError> {
        self.samples(flight)
            .map_err(|error| StudyError::Simulation { case: flight.label.to_owned(), source: error.into() })
    }

    fn samples(&self, flight: &Flight<'_>) -> Result<Flown, Error> {
        let epoch = real("start.epoch", flight.epoch_s);
        let anomaly = real("orbit.trueAnomaly", flight.true_anomaly_deg.to_radians());
        let mut plant = Connected::start(&self.plant, &PLANT_OUTPUTS, &[epoch.clone(), anomaly])?;
        let mut guidance = Connected::start(
            &self.guidance,
            &GUIDANCE_OUTPUTS,
            &[vec![epoch], flight.parameters.clone()].concat(),
        )?;
        let planet = Planet::read(&mut guidance.instance)?;
        let mut samples = Vec::with_capacity(flight.seconds as usize + 1);
        for second in 0..=flight.seconds {
            let time_s = f64::from(second);
            let place = plant.place(time_s, flight.epoch_s + time_s)?;
            let inputs = vector_setting("position", &place.position_m)
                .into_iter()
                .chain(vector_setting("velocity", &place.velocity_m_s))
                .chain((flight.command)(&place));
            for (name, value) in inputs {
                guidance.instance.set(&name, &value)?;
            }
            guidance.instance.do_step(time_s, 1.0, true)?;
            plant.instance.do_step(time_s, 1.0, true)?;
            samples.push(guidance.sample(place)?);
        }
        Ok(Flown { samples, planet })
    }
}

/// An instance and the outputs that are read together.
struct Connected {
    instance: Instance,
    reals: Vec<u32>,
    booleans: Vec<u32>,
}

/// Vectors and their sizes.
type Outputs = (&'static [(&'static str, usize)], &'static [&'static str]);

const PLANT_OUTPUTS: Outputs = (
    &[
        ("position", 3),
        ("velocity", 3),
        ("heliocentric.position", 3),
        ("attitude.q", 4),
        ("earth.azimuth", 0),
        ("earth.elevation", 0),
    ],
    &[],
);

const GUIDANCE_OUTPUTS: Outputs = (
    &[("command.q", 4), ("command.rate", 3), ("mdis.angle", 0)],
    &["target.reachable", "scan.active", "constraint.sunKeepIn", "constraint.hotPole", "constraint.clamped"],
);

impl Connected {
    fn start(fmu: &Fmu, (reals, booleans): &Outputs, parameters: &[(String, Value)]) -> Result<Self, Error> {
        let mut instance = Instance::new(fmu, fmu.name(), &InstanceOptions::default())?;
        for (name, value) in parameters {
            instance.set(name, value)?;
        }
        instance.setup_experiment(None, 0.0, None)?;
        instance.enter_initialization_mode()?;
        instance.exit_initialization_mode()?;
        let reference = |name: &str| fmu.variable(name).map(|variable| variable.value_reference);
        let names = reals.iter().flat_map(|(name, size)| match size {
            0 => vec![(*name).to_owned()],
            _ => (1..=*size).map(|i| format!("{name}[{i}]")).collect(),
        });
        Ok(Self {
            reals: names.map(|name| reference(&name)).collect::<Result<_, _>>()?,
            booleans: booleans.iter().map(|name| reference(name)).collect::<Result<_, _>>()?,
            instance,
        })
    }

    fn values<const N: usize>(&mut self) -> Result<[f64; N], Error> {
        let mut values = [0.0; N];
        self.instance.get_reals(&self.reals, &mut values)?;
        Ok(values)
    }

    /// Where the plant is.
    fn place(&mut self, time_s: f64, epoch_s: f64) -> Result<Place, Error> {
        let x = self.values::<15>()?;
        let vector = |first: usize| -> Vector { [0, 1, 2].map(|i| x[first + i]) };
        let (sin_a, cos_a) = x[13].sin_cos();
        let (sin_e, cos_e) = x[14].sin_cos();
        let earth_body = [cos_e * sin_a, -cos_e * cos_a, -sin_e];
        Ok(Place {
            time_s,
            epoch_s,
            position_m: vector(0),
            velocity_m_s: vector(3),
            to_sun_m: scaled(&vector(6), -1.0),
            to_earth: turn_back(&[x[9], x[10], x[11], x[12]], &earth_body),
        })
    }

    /// What guidance commanded a second ago, at `place`: since then it has turned by its constant rate.
    fn sample(&mut self, place: Place) -> Result<Sample, Error> {
        let x = self.values::<8>()?;
        let rate_rad_s = [x[4], x[5], x[6]];
        let mut flags = [0; 5];
        self.instance.get_booleans(&self.booleans, &mut flags)?;
        let [reachable, scan_active, sun_keep_in, hot_pole, clamped] = flags.map(|flag| flag != 0);
        Ok(Sample {
            place,
            q: rotated(&[x[0], x[1], x[2], x[3]], &rate_rad_s, -1.0),
            rate_rad_s,
            mdis_angle_rad: x[7],
            reachable,
            scan_active,
            constrained: sun_keep_in || hot_pole || clamped,
        })
    }
}

impl Place {
    /// From the spacecraft to the planet's centre, in m.
    pub fn nadir_m(&self) -> Vector {
        scaled(&self.position_m, -1.0)
    }

    /// From the planet's centre to the Sun, in m.
    pub fn sun_m(&self) -> Vector {
        difference(&self.to_sun_m, &self.nadir_m())
    }
}
