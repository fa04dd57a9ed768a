//! Dynamics of body, wheels, flexible modes, propellant, sensors and controller by parameters; refuses by name.

use fmi_export::{Failure, Real, RealVector, Values};
use nalgebra::Vector3;
use physics::attitude::control::{
    AccelerometerSettings, ControllerSettings, Gyro, SensorSettings, StarTracker, SunSensor, WheelAllocator,
};
use physics::attitude::{Appendages, FlexibleMode, Gyrostat, ReactionWheel, RotorImbalance, SloshPendulum};
use physics::momentum::Convention;
use physics::plant::{
    Configuration, Control, DynamicsSettings, IdealSettings, StartMotion, ThrusterControl,
    WheelControlSettings,
};

use super::wheels;
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::variables::choices::AttitudeSource;

/// Zero stands for none.
fn or_none(value: f64) -> f64 {
    if value == 0.0 { f64::INFINITY } else { value }
}

/// Refuses momentum that only ideal wheels hold.
fn check_momentum(read: Read<'_>, configuration: &Configuration) -> Result<(), Failure> {
    if configuration.momentum.convention == Convention::BodyIntegral {
        return Err(Failure::new(
            "momentum.convention: found bodyIntegral (2), allowed with attitude.source controlled (3) and free (4): inertial \
             (1), as the wheels hold physical momentum",
        ));
    }
    let start_momentum = read.values.vector(read.variables.start.momentum);
    if start_momentum != [0.0; 3] {
        return Err(Failure::new(format!(
            "start.momentum: found {start_momentum:?} N.m.s, allowed with attitude.source controlled (3) and free (4): 0, as \
             the momentum follows from start.rate and wheel[k].startMomentum"
        )));
    }
    Ok(())
}

/// Settings of dynamics and control by parameters.
pub(super) fn dynamic(
    read: Read<'_>,
    configuration: &Configuration,
    start: StartMotion,
) -> Result<DynamicsSettings, Failure> {
    let v = read.variables;
    let real = |handle: Real| read.real(handle);
    check_momentum(read, configuration)?;
    wheels::check(read)?;
    let rotors = wheels::rotors(read);
    check_start(read, &rotors)?;
    let shift = read.values.vector(v.spacecraft.center_of_mass_shift);
    if shift != [0.0; 3] {
        return Err(Failure::new(format!(
            "spacecraft.centerOfMassShift: found {shift:?} m, allowed with attitude.source controlled (3) and free (4): 0, as \
             thruster events move the centre of mass in guided and commanded flight alone"
        )));
    }
    let axes: Vec<_> = rotors.iter().map(|wheel| wheel.axis_body).collect();
    let appendages = appendages(read)?;
    let gyrostat = Gyrostat::new(configuration.wet_mass.inertia_body_kg_m2, rotors)
        .and_then(|rigid| {
            rigid.with_appendages(
                appendages,
                configuration.wet_mass.mass_kg,
                configuration.wet_mass.center_of_mass_body_m,
            )
        })
        .map_err(|error| Failure::new(format!("spacecraft.inertia, wheel[k].*: {error}")))?;
    let control = match read.choice(v.attitude.source) {
        AttitudeSource::Controlled => {
            check_axes(&gyrostat, &axes)?;
            Some(control(read)?)
        }
        _ => None,
    };
    let seed = read.count(v.noise_seed).into();
    let controller = controller(read);
    Ok(DynamicsSettings {
        gyrostat,
        rate_hz: controller.rate_hz,
        sensors: SensorSettings {
            star_tracker: StarTracker {
                noise_rad: read.vector(v.star_tracker.noise),
                interval_s: real(v.star_tracker.period),
            },
            gyro: Gyro {
                angle_random_walk_rad_sqrt_s: real(v.gyro.noise),
                rate_random_walk_rad_s_sqrt_s: real(v.gyro.drift),
                initial_bias_rad_s: read.vector(v.gyro.bias),
            },
            seed,
            interval_s: controller.interval_s(),
            acceleration_rad_s2: or_none(controller.slew_acceleration_rad_s2),
            longest_without_tracker_s: real(v.star_tracker.outage),
        },
        sun_sensors: sun_sensors(read)?,
        control,
        accelerometer: AccelerometerSettings {
            bias_m_s2: real(v.accelerometer.bias),
            scale: real(v.accelerometer.scale),
            noise_m_s2: real(v.accelerometer.noise),
            drift_m_s2_sqrt_s: real(v.accelerometer.drift),
            seed,
        },
        grid_s: real(v.solver.dynamics_step),
        start,
    })
}

/// Refuses momentum at the start beyond a wheel's capacity.
fn check_start(read: Read<'_>, rotors: &[ReactionWheel]) -> Result<(), Failure> {
    for (index, (wheel, body)) in read.variables.wheel.iter().zip(rotors).enumerate() {
        let (number, found) = (index + 1, wheels::start_n_m_s(read, wheel));
        let allowed_n_m_s = if body.locked { 0.0 } else { body.capacity_n_m_s };
        if found.abs() > allowed_n_m_s {
            let why = if body.locked { "the rotor is locked" } else { "its capacity" };
            return Err(Failure::new(format!(
                "wheel[{number}].startMomentum: found {found:?} N.m.s, allowed: up to {allowed_n_m_s:?} N.m.s either way, {why}"
            )));
        }
    }
    Ok(())
}

/// Refuses a controller whose wheels do not turn the body in every direction.
fn check_axes(gyrostat: &Gyrostat, axes: &[Vector3<f64>]) -> Result<(), Failure> {
    if WheelAllocator::new(axes, |k: usize| !gyrostat.wheels()[k].locked).is_none() {
        return Err(Failure::new(format!(
            "wheel[k].axis: found {} wheels whose axes lie in a plane or are locked, allowed with attitude.source \
             controlled (3): wheels in all directions",
            axes.len()
        )));
    }
    Ok(())
}

fn controller(read: Read<'_>) -> ControllerSettings {
    let control = &read.variables.control;
    ControllerSettings {
        rate_hz: read.real(control.rate),
        bandwidth_rad_s: read.real(control.bandwidth),
        damping: read.real(control.damping),
        integral: read.real(control.integral),
        slew_rate_rad_s: read.real(control.slew_rate),
        slew_acceleration_rad_s2: read.real(control.slew_acceleration),
        keeps_reference: false,
    }
}

fn control(read: Read<'_>) -> Result<Control, Failure> {
    let control = &read.variables.control;
    let controller = controller(read);
    controller.check().map_err(|error| {
        Failure::new(format!("control.bandwidth, control.damping, control.integral: {error}"))
    })?;
    let by_thrusters = ThrusterControl::new(
        ControllerSettings {
            bandwidth_rad_s: read.real(control.thruster_bandwidth),
            slew_acceleration_rad_s2: read.real(control.thruster_acceleration),
            ..controller
        },
        read.real(control.pulse_period),
    );
    if !read.variables.thruster.is_empty() {
        by_thrusters.controller.check().map_err(|error| {
            Failure::new(format!(
                "control.thrusterBandwidth, control.pulsePeriod, control.damping, control.integral: {error}"
            ))
        })?;
    }
    Ok(Control {
        controller,
        wheels: WheelControlSettings {
            allocation: read.choice(control.allocation).0,
            balance_time_s: or_none(read.real(control.balance_time)),
            compensates_friction: read.boolean(control.friction_compensation),
        },
        thrusters: by_thrusters,
    })
}

fn sun_sensors(read: Read<'_>) -> Result<Vec<SunSensor>, Failure> {
    let sensors = read.variables.sun_sensor.iter().enumerate();
    let sensors = sensors.map(|(index, sensor)| {
        Ok(SunSensor {
            axis_body: direction(read.values, sensor.axis, "sunSensor", index)?,
            half_field_of_view_rad: read.real(sensor.field_of_view),
            noise_rad: read.real(sensor.noise),
        })
    });
    sensors.collect()
}

/// Unit vector along the axis of a device, body frame.
fn direction(
    values: &Values,
    axis: RealVector<3>,
    device: &str,
    index: usize,
) -> Result<Vector3<f64>, Failure> {
    let found = values.vector(axis);
    Vector3::from(found).try_normalize(0.0).ok_or_else(|| {
        let number = index.saturating_add(1);
        Failure::new(format!(
            "{device}[{number}].axis: found {found:?}, allowed: a vector of any length but zero"
        ))
    })
}

/// Wheels and sensors of a flight that is followed ideally.
pub(super) fn ideal(read: Read<'_>) -> Result<IdealSettings, Failure> {
    let v = read.variables;
    wheels::check(read)?;
    Ok(IdealSettings {
        array: wheels::array(read),
        wheels: wheels::rotors(read),
        sun_sensors: sun_sensors(read)?,
        rate_hz: read.real(v.control.rate),
        seed: read.count(v.noise_seed).into(),
        start_momentum_body_n_m_s: read.vector(v.start.momentum),
    })
}

/// Flexible modes, propellant and rotors out of balance.
fn appendages(read: Read<'_>) -> Result<Appendages, Failure> {
    let v = read.variables;
    let real = |handle: Real| read.real(handle);
    let modes = v.flexible_mode.iter().map(|mode| FlexibleMode {
        frequency_hz: real(mode.frequency),
        damping: real(mode.damping),
        coupling_body_sqrt_kg_m: read.vector(mode.coupling),
    });
    let sloshes = v.slosh.iter().enumerate().map(|(index, slosh)| {
        Ok(SloshPendulum {
            mass_kg: real(slosh.mass),
            length_m: real(slosh.length),
            pivot_body_m: read.vector(slosh.pivot),
            axis_body: direction(read.values, slosh.axis, "slosh", index)?,
            coast_frequency_hz: real(slosh.coast_frequency),
            damping: real(slosh.damping),
        })
    });
    let wheels = v.wheel.iter().enumerate().filter(|(_, wheel)| real(wheel.static_imbalance) > 0.0);
    Ok(Appendages {
        modes: modes.collect(),
        sloshes: sloshes.collect::<Result<_, Failure>>()?,
        imbalances: wheels
            .map(|(index, wheel)| RotorImbalance {
                wheel: index,
                static_imbalance_kg_m: real(wheel.static_imbalance),
                position_body_m: read.vector(wheel.position),
            })
            .collect(),
    })
}
