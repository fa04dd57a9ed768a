//! One flight: `MomentumPlant` moves along its orbit, `Guidance` gets where it is once a second and commands.

use loader::Fmu;

use super::planet::Planet;
use crate::attitude::{Attitude, Vector, body_angles_deg, body_direction};
use crate::case::{Case, RowReader, recorded};
use crate::cells::row;
use crate::settings::{Settings, set};
use crate::{Options, StudyError};

/// 2009-04-06 00:00 TDB in seconds past J2000, the start of the default flight.
pub(super) const DEFAULT_EPOCH_S: f64 = 292_248_000.0;

/// Both FMUs.
pub(super) struct Fmus {
    plant: Fmu,
    guidance: Fmu,
}

recorded! {
    /// Where the plant is at one second, in EME2000.
    struct Seen {
        @time_s,
        position_m: Vector = "position",
        velocity_m_s: Vector = "velocity",
        heliocentric_m: Vector = "heliocentric.position",
        q: Attitude = "attitude.q",
        earth_azimuth_rad: f64 = "earth.azimuth",
        earth_elevation_rad: f64 = "earth.elevation",
    }
}

recorded! {
    /// What Guidance commands.
    struct Commanded {
        q: Attitude = "command.q",
        rate_rad_s: Vector = "command.rate",
        mdis_angle_rad: f64 = "gimbal.angle",
        reachable: bool = "target.reachable",
        scan_active: bool = "scan.active",
        keep_in: bool = "constraint.sunKeepIn",
        hot_pole: bool = "constraint.hotPole",
        clamped: bool = "constraint.clamped",
    }
}

/// Where everything is at one second, in EME2000.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointingGeometry {
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
pub(super) struct PointingSample {
    /// Where everything was.
    pub place: PointingGeometry,
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
pub(super) const GEOMETRY: &str = "\
    time_s | epoch_s | q1 | q2 | q3 | q4 | x_m | y_m | z_m | vx_m_s | vy_m_s | vz_m_s | sun_x_m | sun_y_m | \
    sun_z_m";

impl PointingSample {
    /// The cells of [`GEOMETRY`].
    pub(super) fn geometry(&self) -> Vec<String> {
        let PointingGeometry { time_s, epoch_s, position_m, velocity_m_s, .. } = &self.place;
        let sun_m = self.place.sun_m();
        row![*time_s, *epoch_s, self.q, *position_m, *velocity_m_s, sun_m]
    }

    /// EME2000 direction of a body direction.
    pub(super) fn inertial(&self, body: &Vector) -> Vector {
        self.q.transform_vector(body)
    }

    /// Azimuth and elevation of a direction in the body frame, in deg.
    pub(super) fn body_angles_deg(&self, inertial: &Vector) -> [f64; 2] {
        body_angles_deg(&self.q.inverse_transform_vector(inertial))
    }
}

/// What is simulated.
pub(super) struct PointingCase<'a> {
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
    pub command: &'a (dyn Fn(&PointingGeometry) -> Settings + Sync),
}

/// The samples of a flight, one a second, and the planet it is over.
pub(super) struct Simulated {
    /// One a second from 0 on.
    pub samples: Vec<PointingSample>,
    /// By the parameters of `Guidance`.
    pub planet: Planet,
}

impl Fmus {
    /// Opens both in the folder `options` names.
    pub(super) fn open(options: &Options) -> Result<Self, StudyError> {
        Ok(Self { plant: options.fmu("MomentumPlant.fmu")?, guidance: options.fmu("Guidance.fmu")? })
    }

    /// Simulates it. The plant's orbit does not depend on commands: it goes first.
    pub(super) fn simulated(&self, flight: &PointingCase<'_>) -> Result<Simulated, StudyError> {
        let case = Case::new(flight.label, f64::from(flight.seconds + 1), 1.0);
        let case = case.set("start.epoch", flight.epoch_s);
        let anomaly_rad = flight.true_anomaly_deg.to_radians();
        let moving = case.clone().set("orbit.trueAnomaly", anomaly_rad);
        let seen: Vec<Seen> = moving.simulate(&self.plant, Seen::NAMES)?.all(0);
        let places: Vec<PointingGeometry> =
            seen.iter().map(|seen| PointingGeometry::of(seen, flight.epoch_s)).collect();
        let mut ahead = places.iter();
        let mut inputs = |_: RowReader<'_>| {
            ahead.next().map_or(Settings::new(), |place| {
                let motion = [set("position", place.position_m), set("velocity", place.velocity_m_s)];
                [motion.concat(), (flight.command)(place)].concat()
            })
        };
        let case = case.with(flight.parameters.clone());
        let commanded =
            case.steer(&self.guidance, &[Commanded::NAMES, Planet::NAMES].concat(), &mut inputs)?;
        let commanded: Vec<(Commanded, Planet)> = commanded.all(0);
        let samples = places.into_iter().zip(&commanded[1..]);
        let samples = samples.map(|(place, (commanded, _))| PointingSample::of(place, commanded)).collect();
        Ok(Simulated { samples, planet: commanded[0].1 })
    }
}

impl PointingSample {
    /// What guidance commanded a second ago, at `place`: since then it has turned by its constant rate.
    fn of(place: PointingGeometry, commanded: &Commanded) -> Self {
        let Commanded { q, rate_rad_s, mdis_angle_rad, reachable, scan_active, .. } = *commanded;
        let q = q * Attitude::from_scaled_axis(rate_rad_s * -1.0);
        let constrained = commanded.keep_in || commanded.hot_pole || commanded.clamped;
        Self { place, q, rate_rad_s, mdis_angle_rad, reachable, scan_active, constrained }
    }
}

impl PointingGeometry {
    fn of(seen: &Seen, start_epoch_s: f64) -> Self {
        let to_earth = body_direction(seen.earth_azimuth_rad, seen.earth_elevation_rad);
        Self {
            time_s: seen.time_s,
            epoch_s: start_epoch_s + seen.time_s,
            position_m: seen.position_m,
            velocity_m_s: seen.velocity_m_s,
            to_sun_m: -seen.heliocentric_m,
            to_earth: seen.q.transform_vector(&to_earth),
        }
    }

    /// From the spacecraft to the planet's centre, in m.
    pub(super) fn nadir_m(&self) -> Vector {
        -self.position_m
    }

    /// From the planet's centre to the Sun, in m.
    pub(super) fn sun_m(&self) -> Vector {
        self.to_sun_m - self.nadir_m()
    }
}
