//! Forces and torques by source, system momentum, dumps, and the solver.

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Variables};

use physics::management::Strategy;
use physics::momentum::Convention;
use physics::plant::{DUMP_TORQUE_N_M, LEAST_DUMP_THRESHOLD_N_M_S};

use super::super::setup::PlantSetup as Setup;
use super::choices::DumpReinitTo;
use crate::common::choices::MomentumConvention;
use crate::common::loads::{self, BySource};
use crate::common::management::{MomentumStrategy, TargetingVariables};
use crate::common::variables::WorkLimit;

/// Torque about the centre of mass by source, body frame.
#[derive(Variables)]
pub struct TorqueVariables {
    /// Torque from outside this model, body frame.
    #[input(unit = "N.m", display = "uN.m", start = [0.0; 3])]
    pub applied: RealVector<3>,
    #[group(name = "", setup = &loads::TORQUE_IN_FLIGHT)]
    pub by_source: BySource,
    /// Torque of the thrusters, in controlled and free flight.
    #[output(unit = "N.m", nominal = 1.0)]
    pub thruster: RealVector<3>,
    /// Sum of all sources, the external one included.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub total: RealVector<3>,
}

/// Force by source, body frame unless said otherwise.
#[derive(Variables)]
pub struct ForceVariables {
    /// Force from outside this model, body frame, through the centre of mass.
    #[input(unit = "N", display = "uN", start = [0.0; 3])]
    pub applied: RealVector<3>,
    #[group(name = "", setup = &loads::FORCE)]
    pub by_source: BySource,
    /// Force of the thrusters, in controlled and free flight.
    #[output(unit = "N", nominal = 1.0)]
    pub thruster: RealVector<3>,
    /// Sum of all sources, the external one included.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub total: RealVector<3>,
    /// The total in EME2000.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub inertial: RealVector<3>,
}

/// Steps and tolerances of the integration.
#[derive(Variables)]
pub struct SolverVariables {
    /// Longest internal step; steps end at its multiples, at attitude changes and at dumps.
    #[parameter(unit = "s", min = 1e-3, max = 86_400.0, start = 600.0)]
    pub step: Real,
    /// Largest last Chebyshev term of momentum and delta-v in an internal step, which is halved until it holds.
    #[parameter(unit = "1", min = 1e-15, max = 1.0, start = 1e-10)]
    pub tolerance: Real,
    /// Longest stretch over which planet light, recoil and shadowing are computed at a few nodes and read from a
    /// polynomial in between; stretches end at its multiples and where light or attitude change abruptly.
    #[parameter(unit = "s", min = 1e-3, max = 86_400.0, start = 600.0)]
    pub disturbance_step: Real,
    /// Largest last Chebyshev term of such a stretch relative to the largest force and torque in it; the stretch is
    /// shortened until it holds.
    #[parameter(unit = "1", min = 1e-12, max = 1.0, start = 1e-5)]
    pub disturbance_tolerance: Real,
    /// In controlled and free flight, over how long at most force and torque of all effects are taken as linear in time, the
    /// body turning on as it does; intervals end at its multiples, where light changes abruptly, and sooner where the body turns
    /// fast, until the disturbance tolerance holds.
    #[parameter(unit = "s", min = 1e-3, max = 600.0, start = 1.0)]
    pub dynamics_step: Real,
    #[group(name = "")]
    pub work: WorkLimit,
}

/// System momentum.
#[derive(Variables)]
pub struct MomentumVariables {
    /// What sunlight is used for during downlinks, and in science with guided.scienceUnload. It acts where the attitude is guided, in
    /// controlled flight with command.source = guidance too.
    #[parameter(start = MomentumStrategy(Strategy::DumpsOnly))]
    pub strategy: Choice<MomentumStrategy>,
    #[group(name = "")]
    pub targeting: TargetingVariables,
    /// What momentum.body and the dump thresholds mean.
    #[parameter(start = MomentumConvention(Convention::Inertial))]
    pub convention: Choice<MomentumConvention>,
    /// System momentum in the body frame, by momentum.convention.
    #[output(unit = "N.m.s", nominal = 1.0)]
    #[annotation(limited_by = "dump.threshold[i]")]
    pub body: RealVector<3>,
    /// System momentum in EME2000: always the physical total.
    #[output(unit = "N.m.s", nominal = 1.0)]
    pub inertial: RealVector<3>,
    /// What the wheels' biases come to, body frame: start.momentum, dump thresholds and targets count from here.
    #[output(unit = "N.m.s", nominal = 1.0)]
    pub bias: RealVector<3>,
    /// What no wheel holds in guided and commanded flight, body frame: momentum across the wheels' axes, and beyond their capacities.
    /// In controlled and free flight the body takes it.
    #[output(unit = "N.m.s", nominal = 1.0)]
    pub unheld: RealVector<3>,
    #[group(name = "", setup = &loads::MOMENTUM)]
    pub by_source: BySource,
    /// Whether the Sun's place that brings the momentum to the target of the present downlink, or of science with
    /// guided.scienceUnload, is not admissible, so that it comes as near as one that is can bring it.
    #[output]
    pub target_clamped: Boolean,
}

/// Thruster dumps: in guided and commanded flight an impulse, in controlled and free flight pulses of the file's thrusters, or
/// the constant dump.torque where it has none that give torque about every axis both ways.
#[derive(Variables)]
pub struct DumpVariables {
    /// Magnitude of a body component of momentum, from momentum.bias, that triggers a dump; a very large value means never, and in free
    /// flight, where the master controls, none is triggered unless this is set. By default what the wheels hold beside their bias on
    /// all body axes that they span at once, about others 1e9.
    #[parameter(tunable, unit = "N.m.s", min = LEAST_DUMP_THRESHOLD_N_M_S, start = setup.control.dump_threshold_n_m_s.into())]
    pub threshold: RealVector<3>,
    /// Where a component goes that exceeded its threshold.
    #[parameter(start = DumpReinitTo::Target)]
    pub reinit_to: Choice<DumpReinitTo>,
    /// Fraction of the threshold, of opposite sign, after a dump: 1 is paper 000's, which dumps again within minutes
    /// where the drift reverses; 0.9 is robust; 0 dumps to zero.
    #[parameter(tunable, unit = "1", min = 0.0, max = 1.0, start = 0.9)]
    pub reinit_fraction: Real,
    /// A rising edge dumps all components to dump.target.
    #[input(start = false)]
    pub request: Boolean,
    /// Momentum after a requested dump, body frame, from momentum.bias; also where a component goes with dump.reinitTo target.
    #[input(unit = "N.m.s", start = [0.0; 3])]
    pub target: RealVector<3>,
    /// Time that must lie between dumps, by which dump.tooClose goes.
    #[parameter(unit = "s", display = "d", min = 0.0, max = 1e12, start = 0.0)]
    pub required_spacing: Real,
    /// Largest threshold at which no wheel saturates whatever components stay within it, by their capacities beside their bias, spin
    /// axes and the distribution of wheel[k].momentum; 0 without wheels in all directions. Paper 000 states 4, 5.5 and 7 N.m.s for wheels of 4, 8 and 12 N.m.s without printing the axes.
    #[calculated_parameter(unit = "N.m.s")]
    pub guaranteed_threshold: Real,
    /// Greatest component of the thrusters' mean torque in controlled and free flight, where a dump lasts as long as this takes;
    /// the default is half of what the wheels can hold against.
    #[parameter(unit = "N.m", min = DUMP_TORQUE_N_M[0], max = DUMP_TORQUE_N_M[1], start = setup.control.dump_torque_n_m)]
    pub torque: Real,
    /// Shortest time from pulse to pulse of a dump.
    #[parameter(unit = "s", min = 1e-3, max = 1e4, start = 2.0)]
    pub pulse_period: Real,
    /// Whether thrusters are dumping.
    #[output]
    pub active: Boolean,
    /// Whether two dumps lay closer together than dump.requiredSpacing.
    #[output]
    pub too_close: Boolean,
    /// Dumps so far.
    #[output]
    pub count: Integer,
    /// Time of the last dump; -1 before any.
    #[output(discrete, unit = "s", display = "d")]
    pub last_time: Real,
    /// Shortest time between two dumps so far; -1 before the second.
    #[output(discrete, unit = "s", display = "d")]
    pub closest: Real,
    /// Angular impulse of the last dump so far, in the body frame at its start.
    #[output(unit = "N.m.s")]
    pub impulse: RealVector<3>,
    /// Velocity change by the last dump so far, which the thrusters' forces leave beside their torque, in EME2000.
    #[output(unit = "m/s", display = "mm/s", nominal = 1e-3)]
    pub delta_v: RealVector<3>,
}
