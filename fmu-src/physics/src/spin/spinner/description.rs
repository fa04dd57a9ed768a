//! Description of a spinner by its file: tables, keys, and defaults.

use super::hardware::{Limits, MassTable, StarTracker, SunSensor};
use crate::environment::frames::OBLIQUITY_J2000_RAD;
use crate::spacecraft::StartTable;
use crate::toml::{
    AtLeastOne, Deviation, Distance, FieldOfView, Finite, Fraction, NotNegative, Positive, SpecificImpulse,
    tables,
};
use crate::{constants::ASTRONOMICAL_UNIT_M, spin::geometry::L1Orbit};

tables! {
/// A spin-stabilised spacecraft: the file that SpinPlant is packed with. +Z is the spin axis, the origin the centre of mass.
#[cfg_attr(feature = "schema", schemars(title = "heliotorque spinner"))]
struct SpinnerDescription {
    /// Name of the spacecraft.
    name: String,
    /// Mass and inertia as functions of the propellant on board.
    mass_properties: MassEntry,
    /// Passive nutation damper; otherwise there is none.
    damper: Option<DamperEntry>,
    /// What all thrusters have in common.
    thrusters: ThrustersEntry,
    /// The thrusters.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::toml::MOST_THRUSTERS)))]
    thruster: Vec<ThrusterEntry>,
    /// Thrusters that fire together.
    group: Option<Vec<GroupEntry>>,
    /// Star tracker; what is left out is that of paper 002, without noise.
    star_tracker: Option<StarTrackerEntry>,
    /// Sun sensor, from which spins are timed; what is left out is a slit in the XZ plane, without noise.
    sun_sensor: Option<SunSensorEntry>,
    /// Mission limits.
    limits: Limits,
    /// Orbit about the Sun-Earth L1 point, where geometry.source asks for it; what is left out is the point itself.
    l1_orbit: Option<L1OrbitEntry>,
    /// Start values of SpinPlant's parameters and inputs by their names.
    start: Option<StartTable>,
    /// Variables that are local constants of this FMU, with their values; `heliotorque pack --fix` writes them.
    fixed: Option<StartTable>,
}

/// Mass and inertia as functions of the propellant on board.
struct MassEntry {
    /// I3 at each point, in kg m2.
    #[cfg_attr(feature = "schema", schemars(length(min = 2)))]
    spin_inertia_kg_m2: Vec<f64>,
    /// I3/I_T at each point.
    #[cfg_attr(feature = "schema", schemars(length(min = 2)))]
    inertia_ratio: Vec<f64>,
    /// The points, rising from empty, in kg.
    #[cfg_attr(feature = "schema", schemars(length(min = 2)))]
    propellant_kg: Vec<f64>,
    /// Everything but propellant, in kg.
    dry_mass_kg: Positive,
    /// On board at the start, in kg; otherwise the last point.
    initial_propellant_kg: Option<f64>,
    /// I1/I2; otherwise 1.
    transverse_quotient: Option<Positive>,
    /// Products of inertia 12, 13, 23 at each point, in kg m2: elements of the tensor; otherwise 0.
    products_of_inertia_kg_m2: Option<Vec<[f64; 3]>>,
}

/// Passive nutation damper.
struct DamperEntry {
    /// 1/e time of the nutation angle, in s; 0 without a damper.
    time_constant_s: NotNegative,
}

/// What all thrusters have in common.
struct ThrustersEntry {
    /// Smallest pulse, and the step to which its width and thruster[k].onDelay are rounded, in s.
    resolution_s: Positive,
    /// Specific impulse, in s.
    specific_impulse_s: SpecificImpulse,
}

/// One thruster.
struct ThrusterEntry {
    /// A name of its own.
    name: String,
    /// Force at full thrust, in N.
    force_n: Positive,
    /// Where it stands from the centre of mass, body axes, in m.
    position_m: [f64; 3],
    /// Direction of the force on the spacecraft, a unit vector in body axes.
    direction: [f64; 3],
    /// Shortest time for which its valve opens, in s; otherwise 0.
    min_on_time_s: Option<NotNegative>,
    /// Time over which the thrust rises after the valve opens, in s; otherwise 0.
    rise_time_s: Option<NotNegative>,
    /// Time over which the thrust falls after the valve closes, in s; otherwise 0.
    tail_off_time_s: Option<NotNegative>,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it; otherwise 0.
    scatter: Option<Fraction>,
}

/// Thrusters that fire together.
struct GroupEntry {
    /// A name of its own.
    name: String,
    /// Names of the thrusters.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    thrusters: Vec<String>,
    /// Name of the group that pushes the other way half a turn later.
    opposite: Option<String>,
}

/// Star tracker that searches pickets of sky.
#[derive(Default)]
struct StarTrackerEntry {
    /// Boresight azimuth from body X toward Y, in deg; otherwise 90.
    azimuth_deg: Option<Finite>,
    /// Full width of the field in declination, in deg; otherwise 20.
    field_of_view_deg: Option<FieldOfView>,
    /// Pickets in a turn, a multiple of 4; otherwise 900.
    #[cfg_attr(feature = "schema", schemars(range(min = 4)))]
    pickets: Option<u32>,
    /// One in so many is searched in a turn; otherwise 8.
    every: Option<AtLeastOne>,
    /// Standard deviation of a declination, in deg; otherwise 0.
    noise_deg: Option<Deviation>,
}

/// Sun sensor with a slit, from which spins are timed.
#[derive(Default)]
struct SunSensorEntry {
    /// Azimuth of the slit from body X toward Y, in deg; otherwise 0.
    azimuth_deg: Option<Finite>,
    /// Standard deviation of a Sun angle, in deg; otherwise 0.
    noise_deg: Option<Deviation>,
    /// Sectors into which science data of one spin are sorted; otherwise 16384.
    sectors: Option<AtLeastOne>,
}

/// Orbit about the Sun-Earth L1 point.
#[derive(Default)]
struct L1OrbitEntry {
    /// Rate of the Earth-Sun line, in deg/day; otherwise the Earth's mean, 0.98561.
    line_rate_deg_day: Option<Finite>,
    /// Sun to Earth, in m; otherwise 1 AU.
    sun_earth_distance_m: Option<Distance>,
    /// Earth to L1, in m; otherwise 1.4976e9.
    earth_l1_distance_m: Option<Distance>,
    /// Lissajous amplitudes along the line, in the ecliptic across it, normal to the ecliptic, in m; otherwise 0.
    amplitude_m: Option<[f64; 3]>,
    /// In-plane frequency over the line's rate; otherwise 2.0864.
    in_plane_frequency: Option<Finite>,
    /// Out-of-plane frequency over the line's rate; otherwise 2.0152.
    out_of_plane_frequency: Option<Finite>,
    /// Ecliptic to equator, in deg; otherwise that of J2000.
    obliquity_deg: Option<Finite>,
}
}

impl MassEntry {
    /// With what is left out.
    pub(super) fn table(self) -> MassTable {
        let most_kg = self.propellant_kg.last().copied().unwrap_or(0.0);
        MassTable {
            spin_inertia_kg_m2: self.spin_inertia_kg_m2,
            inertia_ratio: self.inertia_ratio,
            propellant_kg: self.propellant_kg,
            dry_mass_kg: self.dry_mass_kg.0,
            initial_propellant_kg: self.initial_propellant_kg.unwrap_or(most_kg),
            transverse_quotient: self.transverse_quotient.map_or(1.0, f64::from),
            products_of_inertia_kg_m2: self.products_of_inertia_kg_m2,
        }
    }
}

impl StarTrackerEntry {
    /// With what is left out.
    pub(super) fn tracker(&self) -> StarTracker {
        StarTracker {
            azimuth_deg: self.azimuth_deg.map_or(90.0, f64::from),
            field_of_view_deg: self.field_of_view_deg.map_or(20.0, f64::from),
            pickets: self.pickets.unwrap_or(900),
            every: self.every.map_or(8, u32::from),
            noise_deg: self.noise_deg.map_or(0.0, f64::from),
        }
    }
}

impl SunSensorEntry {
    /// With what is left out.
    pub(super) fn sensor(&self) -> SunSensor {
        SunSensor {
            azimuth_deg: self.azimuth_deg.map_or(0.0, f64::from),
            noise_deg: self.noise_deg.map_or(0.0, f64::from),
            sectors: self.sectors.map_or(16_384, u32::from),
        }
    }
}

/// Mean rate of the Earth about the Sun: 360 deg in a sidereal year of 365.256363 days.
const LINE_RATE_DEG_DAY: f64 = 360.0 / 365.256_363;
/// From the Earth to L1: 0.0100109 AU, the root of Euler's quintic for the mass of Earth and Moon, 1/328900.56 of the Sun's.
const EARTH_L1_AU: f64 = 0.010_010_9;
/// Linear frequencies about it in units of the mean motion, from the same root.
const L1_FREQUENCIES: [f64; 2] = [2.0864, 2.0152];

impl L1OrbitEntry {
    /// With what is left out.
    pub(super) fn orbit(&self) -> L1Orbit {
        let [in_plane, out_of_plane] = L1_FREQUENCIES;
        L1Orbit {
            line_rate_deg_day: self.line_rate_deg_day.map_or(LINE_RATE_DEG_DAY, f64::from),
            sun_earth_distance_m: self.sun_earth_distance_m.map_or(ASTRONOMICAL_UNIT_M, f64::from),
            earth_l1_distance_m: self
                .earth_l1_distance_m
                .map_or(EARTH_L1_AU * ASTRONOMICAL_UNIT_M, f64::from),
            amplitude_m: self.amplitude_m.unwrap_or([0.0; 3]),
            in_plane_frequency: self.in_plane_frequency.map_or(in_plane, f64::from),
            out_of_plane_frequency: self.out_of_plane_frequency.map_or(out_of_plane, f64::from),
            obliquity_deg: self.obliquity_deg.map_or(OBLIQUITY_J2000_RAD.to_degrees(), f64::from),
        }
    }
}
