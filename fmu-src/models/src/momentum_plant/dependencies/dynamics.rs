//! What sensors, momentum, wheels and control depend on.

use fmi_export::{Dependencies, Knowns, knowns};

use super::super::setup::PlantSetup;
use super::super::variables::PlantVariables;
use super::groups::{Inputs, Start, can_control, panels_weigh};
use crate::common::spacecraft::inertia_along;

/// What star tracker, gyros and Sun sensors give, but for the rate.
pub fn sensors(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    table.output(
        v.estimate.q,
        knowns![&inputs.attitude, &inputs.sensors],
        knowns![&start.attitude, &start.measured_attitude],
    );
    // The first sample of controlled and free flight is valid.
    table.output(
        v.estimate.valid,
        knowns![&inputs.places, &inputs.sensors],
        knowns![&start.begun, v.attitude.source, v.star_tracker.failed],
    );
    let failed = v.sun_sensor.iter().map(|sensor| sensor.failed).collect::<Knowns>();
    let has_sensors = !v.sun_sensor.is_empty();
    let at_step = &knowns![&inputs.attitude, &failed].only_if(has_sensors);
    let fields = v.sun_sensor.iter().map(|sensor| knowns![sensor.axis, sensor.field_of_view]);
    let eclipse = knowns![v.planet.radius, v.eclipse.method];
    let seen = &knowns![&start.attitude, failed, fields.collect::<Knowns>(), eclipse].only_if(has_sensors);
    let noise = v.sun_sensor.iter().map(|sensor| sensor.noise).collect::<Knowns>();
    let drawn = knowns![noise, v.noise.seed, v.control.rate].only_if(has_sensors);
    table.output(v.sun.sensed_valid, at_step, seen);
    table.output(v.sun.sensed, at_step, knowns![seen, drawn]);
}

/// System momentum and dumps. A change of attitude can lift a component over its threshold, so that it is dumped at once.
pub fn momentum(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    let (momentum, dump) = (&v.momentum, &v.dump);
    let dumped = &knowns![&inputs.attitude, dump.request, &inputs.weighed_panels];
    let to_target = &knowns![dumped, dump.target];
    for axis in 0..3 {
        let [initial, threshold, target] =
            [v.start.momentum, dump.threshold, dump.target].map(|vector| vector.element(axis));
        let set = knowns![initial, threshold, target, dump.reinit_to, dump.reinit_fraction];
        let inertia = inertia_along(v.spacecraft.inertia, axis);
        let at_start = &knowns![&start.begun, set, &start.turning, inertia];
        table.output(momentum.body.element(axis), knowns![dumped, target], at_start);
        table.output(dump.impulse.element(axis), to_target, at_start);
    }
    let turning = &knowns![&start.turning, v.spacecraft.inertia];
    table.output(momentum.inertial, to_target, knowns![&start.attitude, &start.momentum, turning]);
    let exceeded = &knowns![&start.begun, v.start.momentum, dump.threshold, turning];
    for (_, output) in momentum.by_source.all() {
        table.output(output, dumped, knowns![]);
    }
    table.output(
        momentum.target_clamped,
        &inputs.management,
        knowns![&start.guidance, v.start.q, &start.chosen_by_momentum],
    );
    table.output(dump.count, to_target, exceeded);
    table.output(dump.last_time, dumped, exceeded);
    table.output(dump.closest, to_target, knowns![]);
    table.output(dump.too_close, to_target, knowns![]);
    // Only in controlled and free flight, whose attitude follows guidance where the flight begins.
    let earth = knowns![v.earth.position].only_if(can_control(v));
    let requested = knowns![&inputs.places, earth, dump.request, dump.target, &inputs.weighed_panels];
    table.output(dump.active, requested, knowns![turning, dump.threshold]);
}

/// Wheels, and the controller that drives them.
pub fn wheels_and_control(
    table: &mut Dependencies,
    setup: &PlantSetup,
    v: &PlantVariables,
    inputs: &Inputs,
    start: &Start,
) {
    let (control, dump, can_control) = (&v.control, &v.dump, can_control(v));
    let axes = &v.wheel.iter().map(|wheel| wheel.axis).collect::<Knowns>();
    // Ideal wheels hold what is left of the momentum; where the flight begins others hold what they start with.
    let dumped = knowns![&inputs.attitude, dump.request, dump.target].only_if(can_control);
    let held = &knowns![&inputs.places, dumped, &inputs.weighed_panels];
    let weight = &knowns![&start.weight, v.spacecraft.center_of_mass].only_if(panels_weigh(setup));
    let ideal = knowns![&start.rate, v.command.rate, v.spacecraft.inertia, &start.momentum, axes, weight];
    let ideal = &ideal.only_if(can_control);

    let references = knowns![
        &start.begun,
        &start.guided,
        v.start.rate,
        knowns![v.command.kind, v.command.q, v.command.rate, v.command.error],
    ];
    let gains = knowns![
        control.bandwidth,
        control.damping,
        control.integral,
        control.slew_rate,
        control.slew_acceleration,
    ];
    let gyro = knowns![v.gyro.noise, v.gyro.drift, v.gyro.bias];
    let settled = &knowns![references, gains, &start.measured_attitude, gyro].only_if(can_control);
    let wheels = v.wheel.iter().map(|wheel| {
        let friction = knowns![wheel.coulomb_friction, wheel.viscous_friction, wheel.inertia];
        knowns![wheel.axis, wheel.start_momentum, wheel.failed, wheel.locked, wheel.max_torque, friction]
    });
    let shared = knowns![
        v.spacecraft.inertia,
        weight,
        wheels.collect::<Knowns>(),
        control.allocation,
        control.balance_time,
        control.friction_compensation,
    ];
    let dumping = knowns![dump.torque, dump.threshold, dump.reinit_to, dump.reinit_fraction, dump.target];
    let controller = &knowns![settled, shared, dumping].only_if(can_control);
    for wheel in &v.wheel {
        let at_start = &knowns![&start.begun, v.attitude.source, wheel.start_momentum, ideal];
        table.output(wheel.momentum, held, at_start);
        table.output(wheel.speed, held, knowns![at_start, wheel.inertia]);
        table.output(wheel.saturated, held, knowns![at_start, wheel.capacity]);
        let commanded = knowns![wheel.torque_command, wheel.failed];
        let free = knowns![&start.begun, v.attitude.source, &commanded, wheel.max_torque];
        table.output(
            wheel.torque,
            knowns![&inputs.places, commanded, &inputs.controller],
            knowns![free, controller],
        );
    }
    let tracked = &knowns![&inputs.attitude, &inputs.sensors].only_if(can_control);
    let command = knowns![v.command.kind, v.command.q, v.command.error];
    let error =
        knowns![&start.begun, &start.guided, &start.chosen_by_momentum, command, &start.measured_attitude];
    table.output(control.error, tracked, error.only_if(can_control));
    let rate_jumps = inputs.weighed_panels.clone().only_if(can_control);
    table.output(control.settled, knowns![tracked, rate_jumps], settled);
    table.output(control.saturated, &inputs.controller, controller);

    let capacities = v.wheel.iter().map(|wheel| wheel.capacity).collect::<Knowns>();
    table.calculated(dump.guaranteed_threshold, knowns![capacities, axes].only_if(can_control));
}
