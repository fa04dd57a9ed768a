//! From the master's parameters and inputs to what the physics takes.

use fmi_export::{Failure, RealVector, Step, Values};
use nalgebra::Vector3;
use physics::spacecraft::MOST_THRUSTERS;
use physics::spin::{
    burn_request::BurnRequest,
    geometry::{L1Ephemeris, L1Phases},
    plant::{Commands, Directions, PulseCommand, PulseExecution, Start},
    series::{BodyTorque, TORQUE_TERMS},
    train::Shape,
};

use super::{
    setup::Plan,
    variables::choices::{BurnPlan, GeometrySource},
};

/// How the flight starts.
pub(super) fn start(context: &Plan<'_>, values: &Values) -> Start {
    let v = context.variables;
    Start {
        inertia_kg_m2: values.vector(v.inertia),
        products_kg_m2: values.vector(v.products_of_inertia),
        mass_source: values.choice(v.mass_properties.source).0,
        propellant_kg: values.real(v.propellant.loaded),
        execution: execution(context, values),
        spin_rate_rad_s: values.real(v.spin.initial_rate),
        attitude: values.vector(v.start.q),
        nutation_rad: values.real(v.start.nutation),
        nutation_phase_rad: values.real(v.start.nutation_phase),
        damper_time_constant_s: values.real(v.damper_time_constant),
        burn: burn(context, values),
        l1: match values.choice(v.geometry.source) {
            GeometrySource::L1Orbit => {
                let (line_rate, amplitude) = (v.geometry.line_rate, v.geometry.amplitude);
                Some(L1Ephemeris {
                    orbit: context.setup.l1_orbit.changed(values.real(line_rate), values.vector(amplitude)),
                    phases: L1Phases {
                        longitude_rad: values.real(v.geometry.longitude),
                        in_plane_rad: values.real(v.geometry.in_plane_phase),
                        out_of_plane_rad: values.real(v.geometry.out_of_plane_phase),
                    },
                })
            }
            GeometrySource::Inputs => None,
        },
        sampling: values.choice(v.star_tracker.sampling).0,
        nominal_rate_rad_s: values.real(v.limit.spin_rate),
        seed: i64::from(values.integer(v.seed)) as u64,
        work_limit: v.solver.units(values),
    }
}

/// How thrusters execute pulses.
fn execution(context: &Plan<'_>, values: &Values) -> [PulseExecution; MOST_THRUSTERS] {
    let mut execution = [PulseExecution::default(); MOST_THRUSTERS];
    for (of_one, v) in execution.iter_mut().zip(&context.variables.thruster) {
        *of_one = PulseExecution { valve: v.valve.read(values), scatter: values.real(v.scatter) };
    }
    execution
}

fn burn(context: &Plan<'_>, values: &Values) -> Option<BurnRequest> {
    let v = &context.variables.burn;
    let shape = match values.choice(v.plan) {
        BurnPlan::Uniform => Shape::Uniform,
        BurnPlan::Tapered => {
            Shape::Tapered { order: u32::try_from(values.integer(v.taper_order)).unwrap_or(0) }
        }
        BurnPlan::Split => Shape::Split,
        BurnPlan::Commanded => return None,
    };
    Some(BurnRequest {
        shape,
        timing: values.choice(v.timing).0,
        start_s: values.real(v.start),
        thruster: values.integer(v.thruster),
        opposite_thruster: values.integer(v.opposite_thruster),
        group: values.text(v.group).to_owned(),
        pulse_width_s: values.real(v.pulse_width),
        turns_per_pulse: values.real(v.turns_per_pulse),
        count: values.integer(v.count),
        angle_rad: values.real(v.angle),
        resolution_s: values.real(context.variables.pulse_resolution),
        target_inertial: values.vector(v.target_direction).into(),
        spin_rate_error: values.real(v.spin_rate_error),
        ratio_error: values.real(v.ratio_error),
        ratio_uncertainty: values.real(v.ratio_uncertainty),
        max_nutation_rad: values.real(v.max_nutation),
        max_duration_s: values.real(v.max_duration),
    })
}

/// Commands of the master from now on.
pub(super) fn commands(context: &Plan<'_>, values: &Values) -> Commands {
    let v = context.variables;
    let resolution_s = values.real(v.pulse_resolution);
    let mut commands = Commands {
        torque: BodyTorque::constant(values.vector(v.torque.applied).into()),
        ..Commands::default()
    };
    for (k, (thruster, pulse)) in v.thruster.iter().zip(&mut commands.pulses).enumerate() {
        if values.boolean(thruster.fire) {
            commands.fire |= 1 << k;
        }
        let (delay_s, on_s) = (values.real(thruster.on_delay), values.real(thruster.on_time));
        *pulse = PulseCommand::rounded(delay_s, on_s, resolution_s);
        commands.any_pulse |= pulse.on_s > 0.0;
    }
    commands
}

/// The outside torque of a step whose input derivatives make it a polynomial in time.
pub(super) fn torque(context: &Plan<'_>, values: &Values, step: &Step<'_>) -> Result<BodyTorque, Failure> {
    let handle = context.variables.torque.applied;
    let mut torque = BodyTorque::constant(values.vector(handle).into());
    for axis in 0..3 {
        for (order, derivative) in step.inputs.derivatives(handle.element(axis)) {
            torque.set_derivative(axis, order, derivative).ok_or_else(|| {
                Failure::new(format!(
                    "torque.applied[{}]: a derivative of order {order} was given; orders 1 to {} are used",
                    axis + 1,
                    TORQUE_TERMS - 1
                ))
            })?;
            torque.origin_s = step.inputs.start_s();
        }
    }
    Ok(torque)
}

/// Whether Sun and Earth come from the inputs.
pub(super) fn takes_directions(context: &Plan<'_>, values: &Values) -> bool {
    values.choice(context.variables.geometry.source) != GeometrySource::L1Orbit
}

/// Unit vectors to Sun, Earth and star; 0 where the input is 0, and for Sun and Earth where the L1 orbit has them.
///
/// # Errors
/// A vector that is used, and so short or long that rounding takes its direction.
pub(super) fn directions(
    context: &Plan<'_>,
    values: &Values,
    read: impl Fn(RealVector<3>) -> [f64; 3],
) -> Result<Directions, Failure> {
    let v = context.variables;
    let unit = |name: &str, handle| {
        let given = read(handle);
        let allowed = "allowed is 0 or a vector of length 1e-100 to 1e100";
        Directions::unit(given).ok_or_else(|| Failure::new(format!("{name} is {given:?}; {allowed}")))
    };
    let from_inputs = takes_directions(context, values);
    let unless_orbit = |name, handle| if from_inputs { unit(name, handle) } else { Ok(Vector3::zeros()) };
    Ok(Directions {
        sun_inertial: unless_orbit("sun.direction", v.sun.direction)?,
        earth_inertial: unless_orbit("earth.direction", v.earth.direction)?,
        star_inertial: unit("star.direction", v.star_direction)?,
    })
}
