//! The spinner's hardware, read once from its TOML file: masses, thrusters, sensors, limits.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::inertia::{Inertia, InertiaError};
use crate::spacecraft::{SpacecraftError, StartEntry};

mod check;

/// A set of thrusters is a bit mask.
pub const MOST_THRUSTERS: usize = 24;

/// Mass and inertia as functions of the propellant on board.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MassProperties {
    /// I3 at each point, in kg m2.
    pub spin_inertia_kg_m2: Vec<f64>,
    /// I3/I_T at each point.
    pub inertia_ratio: Vec<f64>,
    /// The points, rising from empty, in kg.
    pub propellant_kg: Vec<f64>,
    /// Everything but propellant, in kg.
    pub dry_mass_kg: f64,
    /// On board at the start, in kg.
    pub initial_propellant_kg: f64,
    /// I1/I2.
    pub transverse_quotient: f64,
}

impl MassProperties {
    /// Inertia with `propellant_kg` on board; held constant outside the table.
    pub fn inertia(&self, propellant_kg: f64) -> Result<Inertia, InertiaError> {
        let spin = self.interpolate(&self.spin_inertia_kg_m2, propellant_kg);
        let transverse = spin / self.interpolate(&self.inertia_ratio, propellant_kg);
        let root = self.transverse_quotient.sqrt();
        Inertia::new([transverse * root, transverse / root, spin])
    }

    /// Propellant at the last point of the table, in kg.
    pub fn most_propellant_kg(&self) -> f64 {
        self.propellant_kg.last().copied().unwrap_or(0.0)
    }

    fn interpolate(&self, values: &[f64], propellant_kg: f64) -> f64 {
        let points = &self.propellant_kg;
        let mut result = values.first().copied().unwrap_or(0.0);
        for (x, y) in points.windows(2).zip(values.windows(2)) {
            if propellant_kg >= x[0] {
                let share = ((propellant_kg - x[0]) / (x[1] - x[0])).clamp(0.0, 1.0);
                result = y[0] + share * (y[1] - y[0]);
            }
        }
        result
    }
}

/// One thruster.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Thruster {
    /// Name.
    pub name: String,
    /// Where it stands from the centre of mass, body frame, in m; for pictures, the torque is what acts.
    #[serde(skip)]
    pub position_body_m: Vector3<f64>,
    /// Force on the spacecraft, body components, in N.
    pub force_body_n: Vector3<f64>,
    /// Torque about the centre of mass, body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// Propellant flow, in kg/s.
    pub flow_kg_s: f64,
}

/// Thrusters that fire together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// Name.
    pub name: String,
    /// Bit k stands for thruster k, from 0.
    pub mask: u32,
    /// Index of the group that pushes the other way.
    pub opposite: Option<usize>,
}

/// Star tracker of a spinner that searches pickets of sky.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StarTracker {
    /// Boresight azimuth from body X toward Y, in deg.
    pub azimuth_deg: f64,
    /// Full width of the field in declination, in deg.
    pub field_of_view_deg: f64,
    /// Pickets in a turn.
    pub pickets: u32,
    /// One in so many is searched in a turn.
    pub every: u32,
    /// Standard deviation of a declination, in deg.
    pub noise_deg: f64,
}

/// Sun sensor with a slit, from which spins are timed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SunSensor {
    /// Azimuth of the slit from body X toward Y, in deg.
    pub azimuth_deg: f64,
    /// Standard deviation of a Sun angle, in deg.
    pub noise_deg: f64,
    /// Sectors into which science data of one spin are sorted.
    pub sectors: u32,
}

/// Mission limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Greatest angle from the spin axis to the Sun, in deg.
    pub sun_angle_deg: f64,
    /// Greatest angle from the antenna (-Z) to the Earth, in deg.
    pub earth_angle_deg: f64,
    /// Nominal spin rate, in rpm.
    pub spin_rate_rpm: f64,
    /// Allowed either way, in rpm.
    pub spin_rate_tolerance_rpm: f64,
    /// Greatest variation of the spin period, in s.
    pub period_variation_s: f64,
}

/// Linear Lissajous motion about the Sun-Earth L1 point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct L1Orbit {
    /// Rate of the Earth-Sun line, in deg/day.
    pub line_rate_deg_day: f64,
    /// Sun to Earth, in m.
    pub sun_earth_distance_m: f64,
    /// Earth to L1, in m.
    pub earth_l1_distance_m: f64,
    /// Along the line, in the ecliptic across it, normal to the ecliptic, in m.
    pub amplitude_m: [f64; 3],
    /// In-plane frequency over the line's rate.
    pub in_plane_frequency: f64,
    /// Out-of-plane frequency over the line's rate.
    pub out_of_plane_frequency: f64,
    /// Ecliptic to equator, in deg.
    pub obliquity_deg: f64,
}

/// The whole setup, validated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spinner {
    /// Name.
    pub name: String,
    /// Mass properties.
    pub mass_properties: MassProperties,
    /// 1/e time of the nutation angle, in s; 0 without a damper.
    pub damper_time_constant_s: f64,
    /// Smallest step of pulse width, in s.
    pub resolution_s: f64,
    /// Thrusters.
    pub thrusters: Vec<Thruster>,
    /// Named groups.
    pub groups: Vec<Group>,
    /// Star tracker.
    pub star_tracker: StarTracker,
    /// Sun sensor.
    pub sun_sensor: SunSensor,
    /// Limits.
    pub limits: Limits,
    /// Orbit.
    pub l1_orbit: L1Orbit,
    /// Start values of the model's variables, handed on as they were written.
    #[serde(skip)]
    pub start: Vec<StartEntry>,
}

/// Force, torque and flow of a set of thrusters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrust {
    /// Body components, in N.
    pub force_body_n: Vector3<f64>,
    /// Body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// In kg/s.
    pub flow_kg_s: f64,
}

impl Spinner {
    /// Reads a spinner from TOML text; `file` only names it in errors.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys and all values no spinner can have, each with
    /// line, key, what was found and what is allowed.
    pub fn parse(file: &str, text: &str) -> Result<Self, SpacecraftError> {
        check::parse(file, text)
    }

    /// What the thrusters of `mask` do together.
    pub fn thrust(&self, mask: u32) -> Thrust {
        let mut sum =
            Thrust { force_body_n: Vector3::zeros(), torque_body_n_m: Vector3::zeros(), flow_kg_s: 0.0 };
        for (k, thruster) in self.thrusters.iter().enumerate() {
            if mask >> k & 1 == 1 {
                sum.force_body_n += thruster.force_body_n;
                sum.torque_body_n_m += thruster.torque_body_n_m;
                sum.flow_kg_s += thruster.flow_kg_s;
            }
        }
        sum
    }

    /// The group or single thruster called `name`: its mask and that of its opposite.
    pub fn named(&self, name: &str) -> Option<(u32, Option<u32>)> {
        if let Some(group) = self.groups.iter().find(|group| group.name == name) {
            return Some((group.mask, group.opposite.and_then(|o| self.groups.get(o)).map(|g| g.mask)));
        }
        self.thrusters.iter().position(|thruster| thruster.name == name).map(|k| (1 << k, None))
    }
}
