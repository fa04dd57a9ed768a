//! One flight: `MomentumPlant` moves along its orbit, `Guidance` gets where it is once a second and commands.

use loader::Fmu;

use super::planet::Planet;
use crate::attitude::{Attitude, Vector, body_angles_deg, body_direction};
use crate::case::{Case, Row};
use crate::settings::{Settings, cells, elements};
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
    pub q: Attitude,
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
pub const GEOMETRY: &str = "\
    time_s | epoch_s | q1 | q2 | q3 | q4 | x_m | y_m | z_m | vx_m_s | vy_m_s | vz_m_s | sun_x_m | sun_y_m | \
    sun_z_m";

impl Sample {
    /// The cells of [`GEOMETRY`].
    pub fn geometry(&self) -> Vec<String> {
        let Place { time_s, epoch_s, position_m, velocity_m_s, .. } = &self.place;
        let sun_m = self.place.sun_m();
        let vectors = [position_m, velocity_m_s, &sun_m].map(|vector| cells(&[vector.as_slice()]));
        [cells(&[&[*time_s, *epoch_s], self.q.coords.as_slice()]), vectors.concat()].concat()
    }

    /// EME2000 direction of a body direction.
    pub fn inertial(&self, body: &Vector) -> Vector {
        self.q.transform_vector(body)
    }

    /// Azimuth and elevation of a direction in the body frame, in deg.
    pub fn body_angles_deg(&self, inertial: &Vector) -> [f64; 2] {
        body_angles_deg(&self.q.inverse_transform_vector(inertial))
    }
}

/// What is simulated.
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
pub struct Simulated {
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

    /// Flies it. Where the plant is does not hang on what is commanded: it goes first.
    pub fn fly(&self, flight: &Flight<'_>) -> Result<Simulated, StudyError> {
        let case = || {
            let case = Case::new(flight.label, f64::from(flight.seconds + 1), 1.0);
            case.real("start.epoch", flight.epoch_s)
        };
        let anomaly_rad = flight.true_anomaly_deg.to_radians();
        let trajectory =
            case().real("orbit.trueAnomaly", anomaly_rad).simulate(&self.plant, &PLANT_OUTPUTS)?;
        let places: Vec<Place> = trajectory.rows().map(|row| Place::of(row, flight.epoch_s)).collect();
        let mut ahead = places.iter();
        let mut inputs = |_: Row<'_>| {
            ahead.next().map_or(Settings::new(), |place| {
                let mut inputs = elements("position", place.position_m.iter().copied());
                inputs.extend(elements("velocity", place.velocity_m_s.iter().copied()));
                inputs.extend((flight.command)(place));
                inputs
            })
        };
        let case = case().with(flight.parameters.clone());
        let commanded = case.steer(&self.guidance, &GUIDANCE_OUTPUTS, &mut inputs)?;
        let planet = Planet::of(commanded.row(0, PLANET_COLUMN));
        let samples = places.into_iter().zip(commanded.rows().skip(1));
        Ok(Simulated { samples: samples.map(|(place, row)| Sample::of(place, row)).collect(), planet })
    }
}

const PLANT_OUTPUTS: [&str; 6] =
    ["position", "velocity", "heliocentric.position", "attitude.q", "earth.azimuth", "earth.elevation"];

const GUIDANCE_OUTPUTS: [&str; 13] = [
    "command.q",
    "command.rate",
    "mdis.angle",
    "target.reachable",
    "scan.active",
    "constraint.sunKeepIn",
    "constraint.hotPole",
    "constraint.clamped",
    "planet.radii",
    "planet.poleRightAscension",
    "planet.poleDeclination",
    "planet.primeMeridian",
    "planet.rotationRate",
];
/// Where the planet's parameters begin.
const PLANET_COLUMN: usize = 13;

impl Sample {
    /// What guidance commanded a second ago, at `place`: since then it has turned by its constant rate.
    fn of(place: Place, mut row: Row<'_>) -> Self {
        let (q, rate_rad_s) = (row.attitude(), row.vector());
        Self {
            place,
            q: q * Attitude::from_scaled_axis(rate_rad_s * -1.0),
            rate_rad_s,
            mdis_angle_rad: row.real(),
            reachable: row.flag(),
            scan_active: row.flag(),
            constrained: row.flag() | row.flag() | row.flag(),
        }
    }
}

impl Place {
    fn of(mut row: Row<'_>, start_epoch_s: f64) -> Self {
        let (position_m, velocity_m_s) = (row.vector(), row.vector());
        let heliocentric_m: Vector = row.vector();
        let q = row.attitude();
        Self {
            time_s: row.time_s,
            epoch_s: start_epoch_s + row.time_s,
            position_m,
            velocity_m_s,
            to_sun_m: -heliocentric_m,
            to_earth: q.transform_vector(&body_direction(row.real(), row.real())),
        }
    }

    /// From the spacecraft to the planet's centre, in m.
    pub fn nadir_m(&self) -> Vector {
        -self.position_m
    }

    /// From the planet's centre to the Sun, in m.
    pub fn sun_m(&self) -> Vector {
        self.to_sun_m - self.nadir_m()
    }
}
