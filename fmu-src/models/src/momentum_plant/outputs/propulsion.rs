//! Writes thrusters, tanks and accelerometers.

use fmi_export::Values;
use physics::plant::{AttitudeDynamics, DynamicsSettings, ReactionControlSettings};
use physics::propulsion::{PropellantState, hits_a_surface};

use super::super::setup::Plan;

/// Thrusters, tanks and accelerometers of controlled and free flight.
pub fn write_thrusters(
    context: &Plan<'_>,
    values: &mut Values,
    settings: &DynamicsSettings,
    flown: &AttitudeDynamics,
    propellant: &PropellantState,
    time_s: f64,
) {
    let v = context.variables;
    let spacecraft = &context.setup.spacecraft;
    let flown_thrusters = flown.thrusters();
    for (k, (thruster, variables)) in settings.thrusters.thrusters.iter().zip(&v.thruster).enumerate() {
        let thrust_n = flown_thrusters.thrust_n(&settings.thrusters, propellant, k, time_s);
        let pulses = i32::try_from(flown_thrusters.pulses(k)).unwrap_or(i32::MAX);
        let hits = thrust_n > 0.0 && {
            let angle = |panel: usize| {
                let enabled = v.panel.get(panel).filter(|it| values.boolean(it.enabled));
                enabled.map(|it| values.real(it.angle_actual))
            };
            hits_a_surface(spacecraft, thruster, angle)
        };
        values.set_real(variables.thrust, thrust_n);
        values.set_integer(variables.pulses, pulses);
        values.set_boolean(variables.too_short, flown_thrusters.was_too_short(k));
        values.set_boolean(variables.plume, hits);
    }
    values.set_boolean(v.thrust.active, flown_thrusters.burning().is_some());
    values.set_vector(v.accelerometer.delta_v, (*flown.accelerometer_body_m_s()).into());
    write_tanks(context, values, &settings.thrusters, propellant, time_s);
}

/// What is left in the tanks.
pub fn write_tanks(
    context: &Plan<'_>,
    values: &mut Values,
    settings: &ReactionControlSettings,
    propellant: &PropellantState,
    time_s: f64,
) {
    let v = context.variables;
    for (k, (tank, variables)) in settings.tanks.iter().zip(&v.tank).enumerate() {
        let used_kg = propellant.used_kg(k, time_s);
        values.set_real(variables.propellant_left, tank.left_kg(used_kg));
        values.set_real(variables.pressure_actual, tank.pressure_pa(used_kg));
        values.set_boolean(variables.feeds, tank.feeds(used_kg));
    }
    values.set_real(v.propellant.used, propellant.total_used_kg(time_s));
}
