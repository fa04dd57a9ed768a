//! Description of a spinner by its file: tables, keys, and defaults.

use super::hardware::{Limits, MassEntry, StarTrackerEntry, SunSensorEntry};
use crate::spacecraft::StartTable;
use crate::spin::geometry::L1OrbitEntry;
use crate::toml::{
    Fraction, List, MOST_THRUSTERS, NonEmpty, NotNegative, Point, Positive, SpecificImpulse, UnitVector,
    tables,
};

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
    thruster: List<ThrusterEntry, 1, MOST_THRUSTERS>,
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
    position_m as position_body_m: Point,
    /// Direction of the force on the spacecraft, a unit vector in body axes.
    direction: UnitVector,
    /// Shortest time for which its valve opens, in s.
    min_on_time_s: NotNegative = 0.0,
    /// Time over which the thrust rises after the valve opens, in s.
    rise_time_s: NotNegative = 0.0,
    /// Time over which the thrust falls after the valve closes, in s.
    tail_off_time_s: NotNegative = 0.0,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it.
    scatter: Fraction = 0.0,
}

/// Thrusters that fire together.
struct GroupEntry {
    /// A name of its own.
    name: String,
    /// Names of the thrusters.
    thrusters: NonEmpty<String>,
    /// Name of the group that pushes the other way half a turn later.
    opposite: Option<String>,
}
}

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
#[cfg(feature = "schema")]
pub fn schema() -> String {
    crate::toml::schema::<SpinnerDescription>()
}
