//! What thrusters, tanks and accelerometers depend on, and what depends on them.

use fmi_export::{Dependencies, Knowns, knowns};

use super::super::setup::PlantSetup;
use super::super::variables::PlantVariables;
use super::groups::{Inputs, Start, can_control, turned_by};

/// Thrusters fire on command, for a dump, and in place of wheels; a dump at once takes propellant.
pub fn thrusters(
    table: &mut Dependencies,
    setup: &PlantSetup,
    v: &PlantVariables,
    inputs: &Inputs,
    start: &Start,
) {
    let (dump, thrust) = (&v.dump, &v.thrust);
    let has_thrusters = !setup.spacecraft.thrusters.is_empty();
    let commanded = v.thruster.iter().map(|thruster| knowns![thruster.on_delay, thruster.on_time]);
    let failed = v.wheel.iter().map(|wheel| wheel.failed).collect::<Knowns>();
    let dumped = &knowns![&inputs.attitude, dump.request, dump.target, &inputs.weighed_panels];
    let burnt = knowns![thrust.request, thrust.command, thrust.stop];
    let fires = knowns![commanded.collect::<Knowns>(), burnt, dumped, &inputs.sensors, failed];
    let fires = &fires.only_if(has_thrusters);
    let dumped = &dumped.clone().only_if(has_thrusters);

    let valves =
        v.thruster.iter().map(|it| knowns![it.min_on_time, it.rise_time, it.tail_off_time, it.scatter]);
    let tanks = &v.tank.iter().map(|tank| knowns![tank.propellant, tank.pressure]).collect::<Knowns>();
    let thresholds = knowns![
        v.start.momentum,
        dump.threshold,
        dump.reinit_to,
        dump.reinit_fraction,
        dump.target,
        dump.torque,
        dump.pulse_period,
    ];
    let wheels = v
        .wheel
        .iter()
        .map(|wheel| knowns![wheel.axis, wheel.inertia, wheel.locked, wheel.failed, wheel.start_momentum]);
    let body = knowns![v.spacecraft.inertia, v.spacecraft.center_of_mass, v.spacecraft.mass];
    let gains = knowns![
        v.control.thruster_bandwidth,
        v.control.thruster_acceleration,
        v.control.pulse_period,
        v.control.damping,
        v.control.integral,
        v.control.slew_rate,
        v.control.rate,
    ];
    let command = knowns![v.command.kind, v.command.q, v.command.rate, v.command.error];
    let measured = knowns![&start.measured_attitude, v.gyro.noise, v.gyro.drift, v.gyro.bias, v.noise.seed];
    let controls = knowns![gains, command, measured, wheels.collect::<Knowns>()].only_if(can_control(v));
    let at_start = knowns![
        &start.begun,
        &start.attitude,
        &start.turning,
        v.attitude.source,
        thresholds,
        body,
        tanks,
        valves.collect::<Knowns>(),
        controls,
    ];
    let at_start = &at_start.only_if(has_thrusters);

    for thruster in &v.thruster {
        let pulse = knowns![fires, thruster.on_delay, thruster.on_time];
        table.output(thruster.thrust, &pulse, at_start);
        table.output(thruster.pulses, &pulse, at_start);
        table.output(thruster.too_short, &pulse, knowns![]);
        let panels = v.panel.iter().map(turned_by).collect::<Knowns>();
        table.output(
            thruster.plume,
            knowns![&pulse, panels],
            knowns![at_start, &start.panels.iter().collect::<Knowns>()],
        );
    }
    for tank in &v.tank {
        table.output(tank.propellant_left, dumped, knowns![at_start, tank.propellant]);
        table.output(tank.pressure_actual, dumped, knowns![at_start, tank.pressure]);
        table.output(tank.feeds, dumped, knowns![at_start, tank.propellant, tank.pressure]);
    }
    table.output(v.propellant.used, dumped, at_start);
    table.output(thrust.active, fires, knowns![]);
    table.output(v.accelerometer.delta_v, fires, knowns![]);
    table.output(dump.delta_v, dumped, at_start);
    table.output(v.mass, dumped, at_start);
    for output in [v.center_of_mass, v.momentum.inertial, v.delta_v, dump.impulse, v.torque.thruster] {
        table.output(output, fires, at_start);
    }
    for output in [v.force.thruster, v.torque.total, v.force.total, v.force.inertial, v.acceleration] {
        table.output(output, fires, at_start);
    }
}
