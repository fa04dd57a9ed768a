//! Limits of control where the user gives none: what the wheels of a spacecraft allow.

use nalgebra::Vector3;

use crate::constants::DEG_RAD;
use crate::momentum::WheelArray;
use crate::spacecraft::{Spacecraft, Wheel};

use super::reaction_control_settings::{Purpose, ReactionControlSettings};
use crate::guidance::modes::monitor::MARGIN_RAD;

/// Greatest rate of a turn by wheels, assumed.
const GREATEST_SLEW_RATE_RAD_S: f64 = 0.5 * DEG_RAD;
/// Rate of an ordinary scan, assumed; where it reverses the command's rate jumps by twice as much.
const SCAN_RATE_RAD_S: f64 = 0.05 * DEG_RAD;
/// How much farther than by the acceleration alone the body swings beyond such a reversal, assumed: the controller's own lag.
const REVERSAL_LAG: f64 = 1.25;
/// Torque of a dump of a spacecraft without wheels, in N m, assumed.
const TORQUE_WITHOUT_WHEELS_N_M: f64 = 0.05;

/// Rate of a turn that may be set, in rad/s.
pub const SLEW_RATE_RAD_S: [f64; 2] = [0.0, 10.0];
/// Acceleration of a turn that may be set, in rad/s2.
pub const SLEW_ACCELERATION_RAD_S2: [f64; 2] = [0.0, 10.0];
/// Least dump threshold that may be set, in N m s.
pub const LEAST_DUMP_THRESHOLD_N_M_S: f64 = 1e-6;
/// A dump threshold that no momentum reaches, in N m s.
pub const NEVER_DUMPED_N_M_S: f64 = 1e9;
/// Torque of a dump that may be set, in N m.
pub const DUMP_TORQUE_N_M: [f64; 2] = [1e-9, 1e6];

/// Limits of turns and dumps, each within what may be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlDefaults {
    /// Dump threshold by body axis, in N m s: the file's, else what the wheels hold beside their bias about all body axes that they
    /// span at once, and about others [`NEVER_DUMPED_N_M_S`].
    pub dump_threshold_n_m_s: Vector3<f64>,
    /// Rate of a turn in rad/s: half a degree a second, less where it would take more than a quarter of what the wheels hold; 0, no
    /// limit, without wheels in all directions.
    pub slew_rate_rad_s: f64,
    /// Acceleration of a turn in rad/s2: half of what the wheels' torque gives the axis of largest inertia; 0 without wheels
    /// in all directions.
    pub slew_acceleration_rad_s2: f64,
    /// By how much a scan that reverses at a constraint's boundary may exceed it, in rad: v^2 / 2a and a quarter more, v twice
    /// the scan's rate and a the acceleration of a turn; at least [`MARGIN_RAD`].
    pub monitor_margin_rad: f64,
    /// Acceleration of a turn by thrusters in rad/s2: half of what they give the axis of largest inertia; 0 without.
    pub thruster_acceleration_rad_s2: f64,
    /// Torque of a dump in N m: half of what the wheels can hold against.
    pub dump_torque_n_m: f64,
}

impl ControlDefaults {
    /// Defaults of a spacecraft with these wheels.
    pub fn new(spacecraft: &Spacecraft, wheels: &WheelArray) -> Self {
        let guaranteed = |of_wheel: fn(&Wheel) -> f64| {
            wheels.guaranteed_threshold_n_m_s(spacecraft.wheels.iter().map(of_wheel))
        };
        let largest_kg_m2 = spacecraft.mass_properties.inertia_body_kg_m2.diagonal().max();
        let momentum_n_m_s = guaranteed(Wheel::free_capacity_n_m_s);
        let torque_n_m = guaranteed(|wheel| wheel.max_torque_n_m);
        let thrusters = ReactionControlSettings {
            thrusters: spacecraft.thrusters.clone(),
            ..ReactionControlSettings::default()
        };
        let center = &spacecraft.mass_properties.center_of_mass_body_m;
        let selected = thrusters.selection(Purpose::Attitude(None), &|_| true, center);
        let by_thrusters = selected.map_or(0.0, |it| it.least_torque_n_m());
        let acceleration_rad_s2 = 0.5 * torque_n_m / largest_kg_m2;
        let jump_rad_s = 2.0 * SCAN_RATE_RAD_S;
        let reversal_rad = if acceleration_rad_s2 > 0.0 {
            REVERSAL_LAG * 0.5 * jump_rad_s * jump_rad_s / acceleration_rad_s2
        } else {
            0.0
        };
        let fastest_rad_s = 0.25 * momentum_n_m_s / largest_kg_m2;
        let free_n_m_s = spacecraft.wheels.iter().map(Wheel::free_capacity_n_m_s);
        let spanned_n_m_s = wheels
            .spanned_threshold_n_m_s(free_n_m_s)
            .map(|it| within(it, [LEAST_DUMP_THRESHOLD_N_M_S, NEVER_DUMPED_N_M_S]));
        Self {
            dump_threshold_n_m_s: spacecraft.dump_threshold_n_m_s.unwrap_or(spanned_n_m_s),
            slew_rate_rad_s: fastest_rad_s.min(GREATEST_SLEW_RATE_RAD_S),
            slew_acceleration_rad_s2: within(acceleration_rad_s2, SLEW_ACCELERATION_RAD_S2),
            monitor_margin_rad: reversal_rad.clamp(MARGIN_RAD, core::f64::consts::FRAC_PI_2),
            thruster_acceleration_rad_s2: within(
                0.5 * by_thrusters / largest_kg_m2,
                SLEW_ACCELERATION_RAD_S2,
            ),
            dump_torque_n_m: if torque_n_m > 0.0 {
                within(0.5 * torque_n_m, DUMP_TORQUE_N_M)
            } else {
                TORQUE_WITHOUT_WHEELS_N_M
            },
        }
    }
}

fn within(value: f64, [min, max]: [f64; 2]) -> f64 {
    value.max(min).min(max)
}
