//! Thrusters: where each stands, its force, torque, propellant flow and valve.

use nalgebra::Vector3;
use serde::Serialize;

use super::names::check_item_name;
use super::part_reader::PartReader;
use super::tank::Tank;
use crate::constants::STANDARD_GRAVITY_M_S2;
use crate::toml::{
    Fraction, Named, NotNegative, Place, Point, Positive, QuarterTurn, SpecificImpulse, UnitVector, Written,
    hint, tables,
};

tables! {
/// A thruster.
struct ThrusterDescription called "thruster" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Position, body frame, in m.
    position_m as position_body_m: Point,
    /// Unit vector of its force on the spacecraft, body frame; the plume goes the other way.
    direction as direction_body: UnitVector,
    /// Full thrust, in N.
    force_n: Positive,
    /// Pressure at which it has that thrust, in Pa; its tank's when loaded unless given. Thrust and flow are proportional to
    /// the pressure.
    at_pressure_pa: Option<Positive>,
    /// Specific impulse, in s.
    specific_impulse_s: SpecificImpulse,
    /// Name of the tank that feeds it; the first unless given.
    tank: Option<String>,
    /// Name of the set whose delta-v it takes part in: letters and digits, the first a letter; none unless given.
    set: Option<String>,
    /// Whether it may control the attitude and dump momentum; a main engine does not.
    attitude_control: bool = true,
    /// Shortest time for which its valve opens, in s.
    min_on_time_s: NotNegative = 0.0,
    /// Time over which the thrust rises linearly, in s.
    rise_time_s: NotNegative = 0.0,
    /// Time over which the full thrust falls linearly to nothing, in s.
    tail_off_time_s: NotNegative = 0.0,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it.
    scatter: Fraction = 0.0,
    /// Electric power while it fires, in W, for `heliotorque size`.
    power_w: Option<NotNegative>,
    /// Half angle of the plume, in deg: surfaces within it are flagged while it fires; 0 is none.
    plume_half_angle_deg as plume_half_angle_rad: QuarterTurn = 0.0,
}
}

/// Thrusters that give a delta-v together (paper 001, "Delta-V"), by their row among the spacecraft's sets, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct ThrusterSet(pub u16);

impl ThrusterSet {
    /// Returns the set of this name among the spacecraft's sets.
    pub(super) fn named(sets: &[String], name: &str) -> Option<Self> {
        let index = sets.iter().position(|set| set == name)?;
        u16::try_from(index).ok().map(Self)
    }
}

/// How a valve opens and closes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct ValveTiming {
    /// Shortest time for which it opens, in s; what is requested less does not fire.
    pub min_on_s: f64,
    /// Time over which the thrust rises linearly after the valve opens, in s.
    pub rise_s: f64,
    /// Time over which the full thrust falls linearly to nothing after the valve closes, in s.
    pub tail_off_s: f64,
}

impl ValveTiming {
    /// Seconds of full thrust of a pulse whose valve is open for `on_s`, at least the time it takes to rise.
    pub fn full_thrust_s(&self, on_s: f64) -> f64 {
        on_s + 0.5 * (self.tail_off_s - self.rise_s)
    }

    /// Returns how long the valve is open so that a pulse has this many seconds of full thrust.
    pub fn on_s(&self, full_thrust_s: f64) -> f64 {
        full_thrust_s - 0.5 * (self.tail_off_s - self.rise_s)
    }

    /// From the opening of the valve to the centre of the thrust of a pulse whose valve is open for `on_s`, at least the time
    /// it takes to rise.
    pub fn centre_s(&self, on_s: f64) -> f64 {
        let (rise_s, tail_s) = (self.rise_s, self.tail_off_s);
        if rise_s == 0.0 && tail_s == 0.0 {
            return 0.5 * on_s;
        }
        // First moment of the trapezoid over its area.
        let moment = 0.5 * on_s * (on_s + tail_s) + (tail_s * tail_s - rise_s * rise_s) / 6.0;
        moment / self.full_thrust_s(on_s)
    }

    /// Whether decoded times can be some.
    pub fn is_valid(&self) -> bool {
        [self.min_on_s, self.rise_s, self.tail_off_s].iter().all(|time_s| (0.0..=1e12).contains(time_s))
    }
}

/// One thruster.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Thruster {
    /// Name.
    pub name: String,
    /// Position of the thruster, body frame, in m; a spinner's is relative to the centre of mass.
    pub position_body_m: Vector3<f64>,
    /// Force on the spacecraft at full thrust, body components, in N.
    pub force_body_n: Vector3<f64>,
    /// Torque about the body frame's origin, body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// Propellant flow at full thrust, in kg/s.
    pub flow_kg_s: f64,
    /// How its valve opens and closes.
    pub valve: ValveTiming,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it.
    pub scatter: f64,
    /// Electric power while it fires, in W.
    #[serde(skip)]
    pub power_w: Option<f64>,
    /// The delta-v that it takes part in.
    pub set: Option<ThrusterSet>,
    /// Whether it may control the attitude and dump momentum.
    pub attitude_control: bool,
    /// The tank that feeds it, from 0; a spinner has one for all.
    pub tank: usize,
    /// Pressure at which it has that force, in Pa; that of its tank at the start where there is none.
    pub at_pressure_pa: Option<f64>,
    /// Half angle of its plume about the opposite of its force, in rad; 0 where none is given.
    pub plume_half_angle_rad: f64,
}

impl Thruster {
    /// Moment arm across the body's Z axis, in m (paper 002 Table 1).
    pub fn arm_across_z_m(&self) -> f64 {
        self.torque_body_n_m.xy().norm() / self.force_body_n.norm()
    }

    /// Torque about a point of the body frame, in N m.
    pub fn torque_about_n_m(&self, point_body_m: &Vector3<f64>) -> Vector3<f64> {
        self.torque_body_n_m - point_body_m.cross(&self.force_body_n)
    }

    /// Its full thrust, torque about the body frame's origin.
    pub fn thrust(&self) -> Thrust {
        Thrust {
            force_body_n: self.force_body_n,
            torque_body_n_m: self.torque_body_n_m,
            flow_kg_s: self.flow_kg_s,
        }
    }
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

/// A thruster that one of `tanks` feeds, of one of `sets` or none.
pub(super) fn thruster(
    part: &PartReader<'_>,
    description: &ThrusterDescription,
    tanks: &[Tank],
    sets: &[String],
) -> Thruster {
    let force_n = description.force_n.0;
    let valve = ValveTiming {
        min_on_s: description.min_on_time_s(),
        rise_s: description.rise_time_s(),
        tail_off_s: description.tail_off_time_s(),
    };
    let position_body_m = description.position_body_m();
    let force_body_n = description.direction_body() * force_n;
    Thruster {
        name: description.called(part.index),
        position_body_m,
        force_body_n,
        torque_body_n_m: position_body_m.cross(&force_body_n),
        flow_kg_s: force_n / (description.specific_impulse_s.0 * STANDARD_GRAVITY_M_S2),
        valve,
        scatter: description.scatter(),
        power_w: description.power_w.value(),
        set: description.set.as_deref().and_then(|name| ThrusterSet::named(sets, name)),
        attitude_control: description.attitude_control(),
        tank: tank_of(part, tanks, description.tank.as_deref()),
        at_pressure_pa: description.at_pressure_pa.value(),
        plume_half_angle_rad: description.plume_half_angle_rad(),
    }
}

/// Index of the tank of this name, the first without one.
fn tank_of(part: &PartReader<'_>, tanks: &[Tank], name: Option<&str>) -> usize {
    if tanks.is_empty() {
        if !part.of_file("tanks").is_stand_in() {
            part.report("a thruster without a tank", "at least one of [[tanks]] in the file");
        }
        return 0;
    }
    let Some(name) = name else { return 0 };
    let names: Vec<&str> = tanks.iter().map(|tank| tank.name.as_str()).collect();
    let found = names.iter().position(|known| *known == name);
    let unknown = format!("the unknown tank `{name}`{}", hint(name, &names));
    let allowed = format!("a name under [[tanks]]: {}", names.join(", "));
    part.key("tank").known(found, unknown, allowed).unwrap_or(0)
}

/// The names of the sets: those that `sets` lists, then others in the order of their first thruster.
pub(super) fn thruster_sets(
    root: &Place<'_>,
    listed: Option<&[String]>,
    thrusters: Option<&[ThrusterDescription]>,
) -> Vec<String> {
    let mut sets: Vec<String> = Vec::new();
    for (at, name) in root.key("sets").items(listed.unwrap_or_default()) {
        check_item_name(&at, name);
        if sets.contains(name) {
            at.report(format_args!("`{name}` once more"), "each set once");
        } else {
            sets.push(name.clone());
        }
    }
    for (at, thruster) in root.key("thrusters").items(thrusters.unwrap_or_default()) {
        let Some(name) = thruster.set.as_ref().filter(|name| !sets.contains(name)) else { continue };
        check_item_name(&at.key("set"), name);
        sets.push(name.clone());
    }
    sets
}
