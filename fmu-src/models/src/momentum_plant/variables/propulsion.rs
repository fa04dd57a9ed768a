//! Thrusters, tanks, what is commanded for a delta-v, accelerometers.

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Variables};

use super::super::setup::PlantSetup as Setup;
use crate::common::choices::ThrustRequest;
use crate::common::variables::ValveVariables;

/// One thruster, in controlled and free flight; descriptions begin with its name in the spacecraft's file.
#[derive(Variables)]
#[variables(label = setup.spacecraft.thrusters[index].name)]
pub struct ThrusterVariables {
    #[group(name = "", setup = &setup.spacecraft.thrusters[index].valve)]
    pub valve: ValveVariables,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it.
    #[parameter(unit = "1", display = "%", min = 0.0, max = 1.0, start = setup.spacecraft.thrusters[index].scatter)]
    pub scatter: Real,
    /// From the start of each step to the pulse.
    #[input(unit = "s", display = "ms", min = 0.0, start = 0.0)]
    pub on_delay: Real,
    /// Length of a pulse in each step; 0 = none. It fires if it is at least minOnTime, or reaches the step's end, or goes on with a
    /// pulse from the step before. A pulse that reaches beyond the step is cut there. While the thruster takes part in a dump or
    /// a delta-v it does not count.
    #[input(unit = "s", display = "ms", min = 0.0, start = 0.0)]
    pub on_time: Real,
    /// Thrust, its scatter and the tank's pressure counted in.
    #[output(unit = "N", nominal = 1.0)]
    pub thrust: Real,
    /// Pulses begun so far.
    #[output]
    pub pulses: Integer,
    /// Whether the last step commanded a pulse that did not open the valve: shorter than minOnTime, within the step, or after it.
    #[output]
    pub too_short: Boolean,
    /// Whether it fires and a plate or panel stands in its plume.
    #[output]
    pub plume: Boolean,
}

/// One propellant tank; descriptions begin with its name in the spacecraft's file.
#[derive(Variables)]
#[variables(label = setup.spacecraft.tanks[index].name)]
pub struct TankVariables {
    /// Propellant loaded, a part of spacecraft.mass; inertia and centre of mass are those of the loaded spacecraft.
    #[parameter(unit = "kg", min = 1e-9, max = 1e12, start = setup.spacecraft.tanks[index].propellant_kg)]
    pub propellant: Real,
    /// Pressure when loaded.
    #[parameter(unit = "Pa", display = "bar", min = 1.0, max = 1e12, start = setup.spacecraft.tanks[index].pressure_pa)]
    pub pressure: Real,
    /// Propellant left.
    #[output(unit = "kg", nominal = 100.0)]
    pub propellant_left: Real,
    /// Pressure now.
    #[output(unit = "Pa", display = "bar", nominal = 1e6)]
    pub pressure_actual: Real,
    /// Whether it feeds thrusters: there is propellant, and the pressure is within the file's range.
    #[output]
    pub feeds: Boolean,
}

/// A delta-v, in controlled and free flight. While it lasts the other thrusters control the attitude of controlled flight, the
/// wheels go on as they are, and no dump begins.
#[derive(Variables)]
pub struct ThrustVariables {
    /// The thrusters that fire.
    #[input(start = ThrustRequest(None), items = ThrustRequest::sets(&setup.spacecraft))]
    pub request: Choice<ThrustRequest>,
    /// Whether they fire.
    #[input(start = false)]
    pub command: Boolean,
    /// When they stop at the latest, in simulation time, exactly; -1 = when thrust.command falls.
    #[input(unit = "s", start = -1.0)]
    pub stop: Real,
    /// Angle between the thrust and its nominal direction; which way, noise.seed tells.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 0.5, start = 0.0)]
    pub misalignment: Real,
    /// Rate at which the thrust's direction moves on from there, as the centre of mass does; which way, noise.seed tells.
    #[parameter(unit = "rad/s", display = "deg/s", min = 0.0, max = 0.1, start = 0.0)]
    pub drift: Real,
    /// Standard deviation of the thrust's direction about each axis across it, drawn anew every second.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 0.5, start = 0.0)]
    pub jitter: Real,
    /// Whether thrusters give a delta-v.
    #[output]
    pub active: Boolean,
}

/// A delta-v as an impulse through the centre of mass, in guided and commanded flight; in controlled and free flight burns are
/// thrust.*, and a request is refused. Momentum stays as it is, and the orbit changes there unless it is held.
#[derive(Variables)]
pub struct ManeuverVariables {
    /// A rising edge executes maneuver.deltaV where the step begins.
    #[input(start = false)]
    pub request: Boolean,
    /// Velocity to add, in EME2000; a request with 0 does nothing but warn.
    #[input(unit = "m/s", start = [0.0; 3])]
    pub delta_v: RealVector<3>,
    /// The thrusters whose propellant it takes, by the specific impulse of their total force; none takes none. The first set of
    /// the spacecraft file unless its start table says another.
    #[parameter(
        start = ThrustRequest::first(&setup.spacecraft),
        items = ThrustRequest::sets(&setup.spacecraft)
    )]
    pub thrusters: Choice<ThrustRequest>,
    /// Whether a dump to dump.target goes with it.
    #[parameter(start = true)]
    pub dump: Boolean,
    /// Standard deviation of the magnitude, as a share of it, drawn from noise.seed for each maneuver.
    #[parameter(unit = "1", display = "%", min = 0.0, max = 0.5, start = 0.0)]
    pub magnitude_error: Real,
    /// Standard deviation of the direction about each axis across it, drawn likewise.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 0.5, start = 0.0)]
    pub direction_error: Real,
    /// Maneuvers so far.
    #[output]
    pub count: Integer,
    /// Time of the last maneuver; -1 before any.
    #[output(discrete, unit = "s", display = "d")]
    pub last_time: Real,
    /// Velocity that the last maneuver added, its errors included, in EME2000.
    #[output(unit = "m/s")]
    pub executed: RealVector<3>,
}

/// Accelerometers along the body axes, sampled at control.rate in controlled and free flight.
#[derive(Variables)]
pub struct AccelerometerVariables {
    /// Standard deviation of each axis's bias, drawn once.
    #[parameter(unit = "m/s2", min = 0.0, max = 1.0, start = 0.0)]
    pub bias: Real,
    /// Standard deviation of each axis's scale error, drawn once.
    #[parameter(unit = "1", display = "%", min = 0.0, max = 0.5, start = 0.0)]
    pub scale: Real,
    /// Standard deviation of each axis's mean acceleration over a sample.
    #[parameter(unit = "m/s2", min = 0.0, max = 1.0, start = 0.0)]
    pub noise: Real,
    /// Standard deviation by which the bias moves in one second.
    #[parameter(unit = "m/s2", min = 0.0, max = 1.0, start = 0.0)]
    pub drift: Real,
    /// Sum of the measured velocity increments along the body axes since the start, without gravity; 0 in guided and
    /// commanded flight.
    #[output(unit = "m/s", display = "mm/s", nominal = 1e-3)]
    pub delta_v: RealVector<3>,
}
