//! Dependencies of outputs and calculated parameters, by groups.

use fmi_export::{Dependencies, knowns};
use physics::spin::spinner::Spinner;

use super::variables::SpinVariables;

/// Rows by groups of outputs.
pub(super) fn table(_setup: &Spinner, v: &SpinVariables) -> Dependencies {
    let mut table = Dependencies::new();
    let nothing = &knowns![];
    // Where thrusters or the outside torque change, a pulse that is on ends and its propellant is taken: inertia and rate follow,
    // the predicted nutation is that of the new torque, and the plan's next pulse is timed anew.
    let switched = &knowns![&v.thruster, v.torque.applied];
    let mass = knowns![v.inertia, v.products_of_inertia, &v.mass_properties, &v.propellant];
    let body = &knowns![mass, &v.spin, &v.start, v.damper_time_constant];
    let plan = &knowns![body, &v.burn, v.pulse_resolution, &v.thruster];
    let seen = &knowns![body, &v.geometry, &v.limit, &v.star_tracker];

    let motion = knowns![v.attitude.q, &v.spin_axis, &v.momentum, v.delta_v];
    let spent = knowns![v.propellant.used, v.propellant.left, v.mass];
    table.output(knowns![motion, spent], nothing, body);
    let turning = knowns![v.attitude.rate, v.spin.rate, v.spin.period, v.energy];
    let inertia = knowns![v.mass_properties.inertia, v.inertia_ratio, v.coning_angle];
    table.output(knowns![turning, inertia], switched, body);
    table.output(knowns![v.nutation.angle, v.nutation.phase, v.nutation.predicted], switched, body);
    table.calculated(&v.nutation, plan);

    table.output(knowns![&v.thruster, v.force_thruster, v.torque.thruster], switched, plan);
    table.output(knowns![v.burn.pulses_fired, v.burn.active, v.burn.done], nothing, nothing);
    table.output(v.burn.next_edge, switched, plan);
    table.calculated(&v.burn, plan);

    let variation = knowns![v.spin.period_variation, v.limit.period_variation_violated];
    let sun = knowns![&v.sun, v.limit.sun_angle_violated, variation];
    let earth = knowns![&v.earth, v.limit.earth_angle_violated];
    table.output(sun, knowns![v.sun.direction, switched], seen);
    table.output(earth, v.earth.direction, seen);
    table.output(v.limit.spin_rate_violated, switched, seen);
    let directions = &knowns![v.sun.direction, v.earth.direction, switched];
    table.output(v.limit.any_violated, directions, seen);
    let clock = knowns![v.spin.period_change, v.spin.sector_error, v.spin.sun_crossings, v.sun_sensor_angle];
    table.output(clock, nothing, nothing);
    table.output(&v.star_tracker, knowns![v.star_direction, switched], seen);
    table.calculated(&v.star_tracker, seen);
    table
}
