//! Attitude dynamics and control: controller, sensors, what they estimate.

use fmi_export::{Boolean, Choice, Real, RealVector, Variables};
use physics::attitude::control::Allocation;
use physics::plant::{SLEW_ACCELERATION_RAD_S2, SLEW_RATE_RAD_S};

use super::super::setup::PlantSetup as Setup;
use super::choices::WheelAllocation;

/// The controller when attitude.source is controlled.
#[derive(Variables)]
pub struct ControlVariables {
    /// Samples of sensors and controller a second, in free flight of the sensors alone.
    #[parameter(unit = "Hz", min = 0.1, max = 1_000.0, start = 50.0)]
    pub rate: Real,
    /// Bandwidth w of the attitude loop, assumed: no paper prints the gains. With damping d and integral c its poles are those
    /// of (s^2 + 2 d w s + w^2)(s + c w).
    #[parameter(unit = "rad/s", min = 1e-5, max = 1e3, start = 0.1)]
    pub bandwidth: Real,
    /// Damping ratio of the attitude loop.
    #[parameter(unit = "1", min = 0.01, max = 100.0, start = 0.8)]
    pub damping: Real,
    /// Pole of the integral part as a share of the bandwidth; 0 = no integral part.
    #[parameter(unit = "1", min = 0.0, max = 10.0, start = 0.1)]
    pub integral: Real,
    /// Greatest rate relative to the command about the eigenaxis while the attitude follows a command that jumped; 0 = no
    /// limit.
    #[parameter(unit = "rad/s", display = "deg/s", min = SLEW_RATE_RAD_S[0], max = SLEW_RATE_RAD_S[1], start = setup.control.slew_rate_rad_s)]
    pub slew_rate: Real,
    /// Greatest angular acceleration in such a turn; 0 = no limit. The default leaves half of the wheels' torque to other
    /// uses.
    #[parameter(unit = "rad/s2", display = "deg/s2", min = SLEW_ACCELERATION_RAD_S2[0], max = SLEW_ACCELERATION_RAD_S2[1], start = setup.control.slew_acceleration_rad_s2)]
    pub slew_acceleration: Real,
    /// Bandwidth where thrusters control the attitude: during a delta-v, and where wheels fail.
    #[parameter(unit = "rad/s", min = 1e-5, max = 1e3, start = 3.0)]
    pub thruster_bandwidth: Real,
    /// Greatest angular acceleration of a turn by thrusters; 0 = no limit.
    #[parameter(unit = "rad/s2", display = "deg/s2", min = SLEW_ACCELERATION_RAD_S2[0], max = SLEW_ACCELERATION_RAD_S2[1], start = setup.control.thruster_acceleration_rad_s2)]
    pub thruster_acceleration: Real,
    /// Time from one decision on the thrusters' pulses to the next; a whole number of samples.
    #[parameter(unit = "s", min = 1e-3, max = 1e3, start = 0.1)]
    pub pulse_period: Real,
    /// How torque is spread over the wheels.
    #[parameter(start = WheelAllocation(Allocation::PseudoInverse))]
    pub allocation: Choice<WheelAllocation>,
    /// Time constant with which wheels that hold more or less than their share of the momentum return to it; 0 = not at all.
    #[parameter(unit = "s", min = 0.0, max = 1e9, start = 1_000.0)]
    pub balance_time: Real,
    /// Whether the motors make up for the wheels' friction, which the controller knows.
    #[parameter(start = true)]
    pub friction_compensation: Boolean,
    /// Angle between the estimated and the commanded attitude at the last sample; 0 where only a rate is commanded.
    #[output(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, nominal = 1e-4)]
    pub error: Real,
    /// Whether the reference that the slew limits make of the command has come to it.
    #[output]
    pub settled: Boolean,
    /// Whether wheels or thrusters could not give the torque that was requested at the last sample.
    #[output]
    pub saturated: Boolean,
}

/// Attitude and rate as star tracker and gyros give them, at the last sample and propagated by the rate. In guided and
/// commanded flight they are the true ones.
#[derive(Variables)]
pub struct EstimateVariables {
    /// Estimated attitude quaternion, scalar last, from EME2000 to the body frame, its sign as attitude.q's.
    #[output(unit = "1", nominal = 1.0)]
    #[annotation(interpolation = "attitude", rate = "estimate.rate")]
    pub q: RealVector<4>,
    /// Estimated angular rate of the body in EME2000, in body components: the gyros', without their estimated bias; without gyros
    /// a filter's of the star tracker's attitudes, which expects control.slewAcceleration between two; 0 without both.
    #[output(unit = "rad/s", display = "deg/s", nominal = 1e-3)]
    pub rate: RealVector<3>,
    /// Whether the estimated attitude is one: a star tracker works, or the gyros do and one did not long ago.
    #[output]
    pub valid: Boolean,
}

/// Star tracker, and a spare one of the same kind that takes over where it has failed.
#[derive(Variables)]
pub struct StarTrackerVariables {
    /// Whether it gives no attitude: the spare does, unless it has failed too.
    #[input(start = false)]
    pub failed: Boolean,
    /// Whether the spare gives no attitude.
    #[input(start = false)]
    pub spare_failed: Boolean,
    /// Standard deviation of its angle about each body axis.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 0.1, start = [0.0; 3])]
    pub noise: RealVector<3>,
    /// Time between two of its measurements; they fall on samples of control.rate.
    #[parameter(unit = "s", min = 0.0, max = 1e3, start = 0.1)]
    pub period: Real,
    /// How long the gyros alone keep the estimate valid.
    #[parameter(unit = "s", min = 0.0, max = 1e9, start = 600.0)]
    pub outage: Real,
}

/// Gyros.
#[derive(Variables)]
pub struct GyroVariables {
    /// Whether they give no rate.
    #[input(start = false)]
    pub failed: Boolean,
    /// Angle random walk: standard deviation of the angle about each axis after one second.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 0.1, start = 0.0)]
    pub noise: Real,
    /// Rate random walk: standard deviation by which the bias moves in one second.
    #[parameter(unit = "rad/s", display = "deg/s", min = 0.0, max = 0.1, start = 0.0)]
    pub drift: Real,
    /// Bias at the start, in body components.
    #[parameter(unit = "rad/s", display = "deg/s", min = -0.1, max = 0.1, start = [0.0; 3])]
    pub bias: RealVector<3>,
}

/// One Sun sensor.
#[derive(Variables)]
pub struct SunSensorVariables {
    /// Whether it gives nothing.
    #[input(start = false)]
    pub failed: Boolean,
    /// Its axis in the body frame.
    #[parameter(unit = "1", min = -1e6, max = 1e6, start = setup.spacecraft.sun_sensors[index].axis_body.into())]
    pub axis: RealVector<3>,
    /// Half its field of view, from the axis.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = setup.spacecraft.sun_sensors[index].half_field_of_view_rad)]
    pub field_of_view: Real,
    /// Standard deviation of the Sun's angle about each of two axes across.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = 0.1, start = 0.0)]
    pub noise: Real,
}
