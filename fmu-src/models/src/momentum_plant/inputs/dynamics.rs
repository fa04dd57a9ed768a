//! From parameters and inputs to the dynamics of body, wheels, sensors and controller; refuses what cannot be simulated, by name.

use fmi_export::{Failure, InputsOverTime, Real, RealVector, Values};
use nalgebra::Vector3;
use physics::attitude::control::{
    AccelerometerSettings, ControllerSettings, Gyro, SensorHealth, SensorSettings, StarTracker, SunSensor,
    WheelAllocator,
};
use physics::attitude::{Attitude, Gyrostat, ReactionWheel};
use physics::guidance::modes::guidance_command::CommandKind as Kind;
use physics::loads::ForceTorque;
use physics::momentum::{Convention, WheelArray};
use physics::plant::{
    Command, Configuration, Control, DynamicsInputs, DynamicsSettings, IdealSettings, StartMotion,
    ThrusterControl, Tracked, WheelControlSettings,
};
use physics::propulsion::PulseCommand;

use super::{flexibility, propulsion};
use crate::common::choices::CommandKind;
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::variables::choices::{AttitudeSource, CommandSource};

/// Whether the attitude follows from dynamics.
pub fn is_dynamic(context: &Plan<'_>, values: &Values) -> bool {
    let source = values.choice(context.variables.attitude.source);
    matches!(source, AttitudeSource::Controlled | AttitudeSource::Free)
}

/// Whether the orbit phase's own guidance gives the commands that are followed or tracked.
pub fn guides_itself(context: &Plan<'_>, values: &Values) -> bool {
    let variables = context.variables;
    let from_guidance = matches!(values.choice(variables.command.source), CommandSource::Guidance);
    match values.choice(variables.attitude.source) {
        AttitudeSource::Guided => true,
        AttitudeSource::Commanded | AttitudeSource::Controlled => from_guidance,
        AttitudeSource::Free => false,
    }
}

/// Zero stands for none.
fn or_none(value: f64) -> f64 {
    if value == 0.0 { f64::INFINITY } else { value }
}

/// What parameters say about dynamics and control.
pub fn settings(
    context: &Plan<'_>,
    values: &Values,
    configuration: &Configuration,
) -> Result<DynamicsSettings, Failure> {
    let v = context.variables;
    let real = |handle: Real| values.real(handle);
    if configuration.momentum.convention == Convention::BodyIntegral {
        return Err(Failure::new(
            "momentum.convention: found bodyIntegral (2), allowed with attitude.source controlled (3) and free (4): inertial \
             (1), as the wheels hold physical momentum",
        ));
    }
    let start_momentum = values.vector(v.start.momentum);
    if start_momentum != [0.0; 3] {
        return Err(Failure::new(format!(
            "start.momentum: found {start_momentum:?} N.m.s, allowed with attitude.source controlled (3) and free (4): 0, as \
             the momentum follows from start.rate and wheel[k].startMomentum"
        )));
    }
    let wheels: Vec<ReactionWheel> = v
        .wheel
        .iter()
        .map(|wheel| ReactionWheel {
            axis_body: Vector3::from(values.vector(wheel.axis)),
            inertia_kg_m2: real(wheel.inertia),
            max_torque_n_m: real(wheel.max_torque),
            capacity_n_m_s: real(wheel.capacity),
            coulomb_friction_n_m: real(wheel.coulomb_friction),
            viscous_friction_n_m_s: real(wheel.viscous_friction),
            locked: values.boolean(wheel.locked),
        })
        .collect();
    for (index, (wheel, body)) in v.wheel.iter().zip(&wheels).enumerate() {
        let (number, found) = (index + 1, real(wheel.start_momentum));
        let allowed_n_m_s = if body.locked { 0.0 } else { body.capacity_n_m_s };
        if found.abs() > allowed_n_m_s {
            let why = if body.locked { "the rotor is locked" } else { "its capacity" };
            return Err(Failure::new(format!(
                "wheel[{number}].startMomentum: found {found:?} N.m.s, allowed: up to {allowed_n_m_s:?} N.m.s either way, {why}"
            )));
        }
    }
    let axes: Vec<_> = wheels.iter().map(|wheel| wheel.axis_body).collect();
    let appendages = flexibility::appendages(context, values)?;
    let gyrostat = Gyrostat::new(configuration.inertia_body_kg_m2, wheels)
        .and_then(|rigid| {
            rigid.with_appendages(appendages, configuration.mass_kg, configuration.center_of_mass_body_m)
        })
        .map_err(|error| Failure::new(format!("spacecraft.inertia, wheel[k].*: {error}")))?;
    let controlled = matches!(values.choice(v.attitude.source), AttitudeSource::Controlled);
    let control = if controlled {
        let turns = |k: usize| !gyrostat.wheels()[k].locked;
        if WheelAllocator::new(&axes, turns).is_none() {
            return Err(Failure::new(format!(
                "wheel[k].axis: found {} wheels whose axes lie in a plane or are locked, allowed with attitude.source \
                 controlled (3): wheels in all directions",
                axes.len()
            )));
        }
        Some(control(context, values)?)
    } else {
        None
    };
    let seed = values.integer(v.noise.seed).unsigned_abs().into();
    let controller = controller(context, values);
    Ok(DynamicsSettings {
        gyrostat,
        rate_hz: controller.rate_hz,
        sensors: SensorSettings {
            star_tracker: StarTracker {
                noise_rad: Vector3::from(values.vector(v.star_tracker.noise)),
                interval_s: real(v.star_tracker.period),
            },
            gyro: Gyro {
                angle_random_walk_rad_sqrt_s: real(v.gyro.noise),
                rate_random_walk_rad_s_sqrt_s: real(v.gyro.drift),
                initial_bias_rad_s: Vector3::from(values.vector(v.gyro.bias)),
            },
            seed,
            interval_s: controller.interval_s(),
            acceleration_rad_s2: or_none(controller.slew_acceleration_rad_s2),
            longest_without_tracker_s: real(v.star_tracker.outage),
        },
        sun_sensors: sun_sensors(context, values)?,
        control,
        accelerometer: AccelerometerSettings {
            bias_m_s2: real(v.accelerometer.bias),
            scale: real(v.accelerometer.scale),
            noise_m_s2: real(v.accelerometer.noise),
            drift_m_s2_sqrt_s: real(v.accelerometer.drift),
            seed,
        },
        dump: configuration.momentum.policy,
        grid_s: real(v.solver.dynamics_step),
        panels_have_mass: context.setup.spacecraft.panels.iter().any(|panel| panel.mass.is_some()),
    })
}

fn controller(context: &Plan<'_>, values: &Values) -> ControllerSettings {
    let control = &context.variables.control;
    ControllerSettings {
        rate_hz: values.real(control.rate),
        bandwidth_rad_s: values.real(control.bandwidth),
        damping: values.real(control.damping),
        integral: values.real(control.integral),
        slew_rate_rad_s: values.real(control.slew_rate),
        slew_acceleration_rad_s2: values.real(control.slew_acceleration),
        keeps_reference: false,
    }
}

fn control(context: &Plan<'_>, values: &Values) -> Result<Control, Failure> {
    let control = &context.variables.control;
    let controller = controller(context, values);
    controller.check().map_err(|error| {
        Failure::new(format!("control.bandwidth, control.damping, control.integral: {error}"))
    })?;
    let by_thrusters = ThrusterControl::new(
        ControllerSettings {
            bandwidth_rad_s: values.real(control.thruster_bandwidth),
            slew_acceleration_rad_s2: values.real(control.thruster_acceleration),
            ..controller
        },
        values.real(control.pulse_period),
    );
    if !context.variables.thruster.is_empty() {
        by_thrusters.controller.check().map_err(|error| {
            Failure::new(format!(
                "control.thrusterBandwidth, control.pulsePeriod, control.damping, control.integral: {error}"
            ))
        })?;
    }
    Ok(Control {
        controller,
        wheels: WheelControlSettings {
            allocation: values.choice(control.allocation).0,
            balance_time_s: or_none(values.real(control.balance_time)),
            compensates_friction: values.boolean(control.friction_compensation),
        },
        thrusters: by_thrusters,
    })
}

fn sun_sensors(context: &Plan<'_>, values: &Values) -> Result<Vec<SunSensor>, Failure> {
    let sensors = context.variables.sun_sensor.iter().enumerate();
    let sensors = sensors.map(|(index, sensor)| {
        let found = values.vector(sensor.axis);
        let axis_body = Vector3::from(found).try_normalize(0.0).ok_or_else(|| {
            Failure::new(format!(
                "sunSensor[{}].axis: found {found:?}, allowed: a vector of any length but zero",
                index.saturating_add(1)
            ))
        })?;
        Ok(SunSensor {
            axis_body,
            half_field_of_view_rad: values.real(sensor.field_of_view),
            noise_rad: values.real(sensor.noise),
        })
    });
    sensors.collect()
}

/// Wheels and sensors of a flight that is followed ideally.
pub fn ideal_settings(context: &Plan<'_>, values: &Values) -> Result<IdealSettings, Failure> {
    let v = context.variables;
    Ok(IdealSettings {
        array: wheel_array(context, values),
        wheels: v.wheel.iter().map(|it| [it.inertia, it.capacity].map(|it| values.real(it))).collect(),
        sun_sensors: sun_sensors(context, values)?,
        rate_hz: values.real(v.control.rate),
        seed: values.integer(v.noise.seed).unsigned_abs().into(),
    })
}

/// Distribution of momentum over the wheels; `None` unless they span all directions.
pub fn wheel_array(context: &Plan<'_>, values: &Values) -> Option<WheelArray> {
    let wheels = context.variables.wheel.iter();
    let axes = wheels.map(|wheel| Vector3::from(values.vector(wheel.axis)).try_normalize(0.0));
    WheelArray::new(&axes.collect::<Option<Vec<_>>>()?)
}

/// What the inputs of a step say beside `command`, in this memory if there is any.
pub fn step_inputs(
    context: &Plan<'_>,
    values: &Values,
    command: Command,
    memory: Option<DynamicsInputs>,
) -> DynamicsInputs {
    let v = context.variables;
    let tracked = if guides_itself(context, values) {
        Tracked::Guidance
    } else if matches!(values.choice(v.command.kind), CommandKind(Kind::RateOnly)) {
        Tracked::Rate(command.rate_body_rad_s)
    } else {
        Tracked::Attitude(command)
    };
    let thrust = propulsion::thrust_command(context, values);
    // The spare takes over where the first star tracker has failed.
    let health = SensorHealth {
        star_tracker: !(values.boolean(v.star_tracker.failed) && values.boolean(v.star_tracker.spare_failed)),
        gyro: !values.boolean(v.gyro.failed),
    };
    let mut inputs = memory.unwrap_or_else(|| DynamicsInputs::new(tracked, thrust, health));
    (inputs.tracked, inputs.thrust, inputs.health) = (tracked, thrust, health);
    inputs.refill(
        v.wheel.iter().map(|it| (values.real(it.torque_command), values.boolean(it.failed))),
        v.sun_sensor.iter().map(|it| values.boolean(it.failed)),
        v.thruster
            .iter()
            .map(|it| PulseCommand { delay_s: values.real(it.on_delay), on_s: values.real(it.on_time) }),
    );
    inputs
}

/// Force and torque from outside at a time, and how they change.
pub fn external(
    context: &Plan<'_>,
    values: &Values,
    inputs: InputsOverTime<'_>,
    time_s: f64,
) -> [ForceTorque; 2] {
    let v = context.variables;
    let value = |handle: RealVector<3>| Vector3::from(inputs.vector(values, handle, time_s));
    let rate =
        |handle: RealVector<3>| Vector3::from([0, 1, 2].map(|i| inputs.rate(handle.element(i), time_s)));
    [
        ForceTorque { force_body_n: value(v.force.applied), torque_body_n_m: value(v.torque.applied) },
        ForceTorque { force_body_n: rate(v.force.applied), torque_body_n_m: rate(v.torque.applied) },
    ]
}

/// What start.q and start.rate say of the motion at the start.
pub fn start_motion(context: &Plan<'_>, values: &Values) -> Result<StartMotion, Failure> {
    let start = &context.variables.start;
    let q = values.vector(start.q);
    let attitude = Attitude::from_quaternion(q).map_err(|error| Failure::new(format!("start.q: {error}")))?;
    let given = context.given(values, &[start.q.into(), start.rate.into()]);
    let attitude_is_guided = guides_itself(context, values) && !given.has(start.q);
    Ok(StartMotion {
        attitude,
        rate_body_rad_s: Vector3::from(values.vector(start.rate)),
        attitude_is_guided,
        rate_is_guided: attitude_is_guided && !given.has(start.rate),
    })
}
