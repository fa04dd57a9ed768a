//! Thrusters, pulses and the burn they make.

use core::f64::consts::PI;

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Text, Variables};

use super::choices::{BurnPlan, BurnTiming};
use crate::common::variables::ValveVariables;
use physics::spacecraft::Thruster;
use physics::spin::{forecast::Timing, spinner::Spinner as Setup};

/// The burn the spacecraft makes without commands.
#[derive(Variables)]
pub struct BurnVariables {
    /// Shape of the train of pulses; commanded where the spacecraft file has no thruster that tilts the momentum.
    #[parameter(start = plan(setup))]
    pub plan: Choice<BurnPlan>,
    /// What pulses are timed by.
    #[parameter(start = BurnTiming(Timing::Clock))]
    pub timing: Choice<BurnTiming>,
    /// No pulse begins before this time.
    #[parameter(unit = "s", start = 0.0)]
    pub start: Real,
    /// Number of the thruster, from 1 in the order of the spacecraft file. The default is the first that tilts the momentum and
    /// leaves the spin, pushing across the spin axis if any does: ACE's 8, IIIR.
    #[parameter(start = thruster(setup).0)]
    pub thruster: Integer,
    /// Number of the thruster that fires on odd half turns, opposite to the first; 0 = none.
    #[parameter(start = thruster(setup).1)]
    pub opposite_thruster: Integer,
    /// Name of a group or thruster of the setup to fire instead of the numbers; empty = use the numbers.
    #[parameter(start = "")]
    pub group: Text,
    /// Width of a pulse at full thrust; of the first and last for the tapered plan. The valve opens for this less half of
    /// tailOffTime - riseTime, so that the impulse is the force times this width.
    #[parameter(unit = "s", display = "ms", min = 0.0, max = 1e6, start = 0.032)]
    pub pulse_width: Real,
    /// Turns from pulse to pulse: 0.5, 1, 1.5 and so on; half turns alternate the two thrusters.
    #[parameter(unit = "1", min = 0.5, max = 100.0, start = 1.0)]
    pub turns_per_pulse: Real,
    /// Number of pulses, used where burn.angle is 0.
    #[parameter(min = 1, max = 1_000_000, start = 114)]
    pub count: Integer,
    /// How far the momentum shall move, up to where burn.targetDirection stands; 0 = by burn.count.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = PI, start = 0.0)]
    pub angle: Real,
    /// Order of the taper: 1 is 1 2 2 ... 2 1, 2 is 1 3 4 ... 4 3 1.
    #[parameter(min = 1, max = 6, start = 1)]
    pub taper_order: Integer,
    /// Direction in EME2000 toward which the momentum moves; only its part across the momentum counts.
    #[parameter(unit = "1", start = [1.0, 0.0, 0.0])]
    pub target_direction: RealVector<3>,
    /// (assumed - true) / true spin rate: what the train is made for and clock and Sun-crossing delays are computed with.
    #[parameter(unit = "1", display = "%", min = -0.5, max = 0.5, start = 0.0)]
    pub spin_rate_error: Real,
    /// (assumed - true) / true inertia ratio: what tapers are sized and the halves of a split train are placed for.
    #[parameter(unit = "1", display = "%", min = -0.5, max = 0.5, start = 0.0)]
    pub ratio_error: Real,
    /// Half width of the range of inertia ratios over which burn.maxNutation shall hold.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = 0.0)]
    pub ratio_uncertainty: Real,
    /// Refuse a plan whose nutation would exceed this at any time; 0 = no limit.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = PI, start = 0.0)]
    pub max_nutation: Real,
    /// Refuse a plan that takes longer; 0 = no limit.
    #[parameter(unit = "s", display = "min", min = 0.0, start = 0.0)]
    pub max_duration: Real,
    /// Pulses whose valve closed; one that an empty tank cut short does not count.
    #[output]
    pub pulses_fired: Integer,
    /// Whether the burn runs: from the first edge of its first pulse to the last edge of its last.
    #[output]
    pub active: Boolean,
    /// Whether its last pulse ended.
    #[output]
    pub done: Boolean,
    /// Next edge of the burn as predicted from the present motion; -1 while none is timed. Before the first pulse, and always
    /// with burn.timing 2 and 3, it moves as torques and Sun crossings change what is predicted.
    #[output(discrete, unit = "s")]
    #[annotation(role = "nextEvent")]
    pub next_edge: Real,
    /// Pulses of the plan.
    #[calculated_parameter]
    pub planned_count: Integer,
    /// From the plan's first edge to its last.
    #[calculated_parameter(unit = "s", display = "min")]
    pub planned_duration: Real,
    /// How far the plan moves the momentum: the sum of paper 002 eq 3.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub planned_angle: Real,
    /// How far its widest pulse moves the momentum, eq 3.
    #[calculated_parameter(unit = "rad", display = "deg")]
    pub pulse_angle: Real,
}

/// Numbers of the thruster that moves the momentum and of its opposite, from 1; 0 for none.
fn thruster(setup: &Setup) -> (i32, i32) {
    let number = |index: usize| i32::try_from(index + 1).unwrap_or(0);
    let pair = setup.steering_pair();
    pair.map_or((0, 0), |(first, opposite)| (number(first), opposite.map_or(0, number)))
}

/// The train that can be simulated.
fn plan(setup: &Setup) -> BurnPlan {
    if setup.steering_pair().is_some() { BurnPlan::Uniform } else { BurnPlan::Commanded }
}

/// One thruster; descriptions begin with its name in the setup.
#[derive(Variables)]
#[variables(setup = Thruster, label = setup.name)]
pub struct ThrusterVariables {
    #[group(name = "", setup = &setup.valve)]
    pub valve: ValveVariables,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it; drawn by seed.
    #[parameter(unit = "1", display = "%", min = 0.0, max = 1.0, start = setup.scatter)]
    pub scatter: Real,
    /// From the start of each step to the pulse.
    #[input(unit = "s", display = "ms", min = 0.0, start = 0.0)]
    pub on_delay: Real,
    /// Length of a pulse in each step; 0 = none. It fires if it is at least minOnTime, or reaches the step's end, or goes on with a
    /// pulse from the step before. A pulse that reaches beyond the step is cut there.
    #[input(unit = "s", display = "ms", min = 0.0, start = 0.0)]
    pub on_time: Real,
    /// Fires over the whole step.
    #[input(start = false)]
    pub fire: Boolean,
    /// Whether its valve is open.
    #[output]
    pub active: Boolean,
    /// Whether the last step commanded a pulse that did not open the valve: shorter than minOnTime, within the step, or after it.
    #[output]
    pub too_short: Boolean,
    /// Moment arm across the spin axis, paper 002 Table 1.
    #[output(constant, unit = "m", start = setup.arm_across_z_m())]
    pub arm: Real,
}

/// Torques on the body.
#[derive(Variables)]
pub struct TorqueVariables {
    /// Torque from outside this model, body frame.
    #[input(unit = "N.m", display = "uN.m", start = [0.0; 3])]
    pub applied: RealVector<3>,
    /// Torque of the thrusters, body frame.
    #[output(unit = "N.m", nominal = 1.0)]
    pub thruster: RealVector<3>,
}
