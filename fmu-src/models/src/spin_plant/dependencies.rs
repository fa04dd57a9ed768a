//! What each output and calculated parameter depends on.

use fmi_export::{Dependencies, Knowns, knowns};
use physics::spin::spinner::Spinner;

use super::variables::SpinVariables;

/// One row an unknown.
pub fn table(setup: &Spinner, v: &SpinVariables) -> Dependencies {
    let mut table = Dependencies::new();
    motion(&mut table, setup, v);
    thrusters(&mut table, setup, v);
    burn(&mut table, v);
    directions(&mut table, v);
    sensors(&mut table, v);
    table
}

/// What fires a thruster.
fn commands(v: &SpinVariables) -> Vec<Knowns> {
    v.thruster.iter().map(|it| knowns![it.fire, it.on_delay, it.on_time]).collect()
}

/// Where thrusters or the outside torque change, a pulse that is on ends and is booked: inertia follows the propellant,
/// the foreseen nutation its torque, the estimate of nutation begins anew and the plan's next pulse is timed anew.
fn switches(v: &SpinVariables) -> Knowns {
    knowns![commands(v).iter().collect::<Knowns>(), v.torque.applied]
}

/// Parameters of the inertia in force: products of inertia turn the principal axes, about which all else goes.
fn inertia(v: &SpinVariables) -> Knowns {
    knowns![v.inertia, v.products_of_inertia, v.mass_properties.source, v.propellant.loaded]
}

/// Attitude, rate, momentum, nutation.
fn motion(table: &mut Dependencies, setup: &Spinner, v: &SpinVariables) {
    let nothing = &knowns![];
    let (switches, start) = (&switches(v), &v.start);
    let spin = &knowns![v.spin.initial_rate];
    let tilted = &knowns![spin, inertia(v), start.nutation, start.nutation_phase];
    let attitude = &knowns![start.q];
    // Propellant turns the principal axes in the body where the table has products of inertia.
    let propellant_turns = setup.mass_properties.products_of_inertia_kg_m2.is_some();
    let turns_axes = &switches.clone().only_if(propellant_turns);
    let loaded = knowns![v.propellant.loaded].only_if(propellant_turns);
    let axes = &knowns![v.inertia, v.products_of_inertia, v.mass_properties.source, loaded];

    table.output(v.attitude.q, nothing, attitude);
    table.output(v.spin_axis.inertial, nothing, attitude);
    table.output(v.spin_axis.displacement, nothing, nothing);
    table.output(v.momentum.body, nothing, tilted);
    for axis in 0..2 {
        table.output(v.attitude.rate.element(axis), switches, tilted);
    }
    let coned = knowns![spin, axes, start.nutation, start.nutation_phase];
    table.output(v.attitude.rate.element(2), switches, coned);
    table.output(v.momentum.inertial, nothing, knowns![tilted, attitude]);
    table.output(v.momentum.displacement, nothing, nothing);
    table.output(v.spin.rate, switches, spin);
    table.output(v.energy, switches, tilted);
    table.output(v.mass_properties.inertia, switches, inertia(v));
    table.output(v.inertia_ratio, switches, inertia(v));
    table.output(v.nutation.angle, turns_axes, start.nutation);
    table.output(v.coning.angle, turns_axes, axes);
    // Without nutation its phase is what rounding leaves.
    table.output(v.nutation.phase, switches, knowns![tilted, attitude]);
    table.output(v.nutation.predicted, switches, nothing);
    table.calculated(v.nutation.ratio, inertia(v));
}

/// What is on, and what it uses and does.
fn thrusters(table: &mut Dependencies, setup: &Spinner, v: &SpinVariables) {
    let nothing = &knowns![];
    let commands = commands(v);
    for (thruster, command) in v.thruster.iter().zip(&commands) {
        table.output(thruster.active, command, nothing);
        let shortest = knowns![thruster.on_time, thruster.min_on_time, v.pulse.resolution];
        table.output(thruster.too_short, thruster.on_time, shortest);
    }
    for axis in 0..3 {
        let acting = |acts: &dyn Fn(usize) -> bool| {
            let those = commands.iter().enumerate().filter(|(k, _)| acts(*k));
            those.map(|(_, command)| command).collect::<Knowns>()
        };
        let force = acting(&|k| setup.thrusters[k].force_body_n[axis] != 0.0);
        let torque = acting(&|k| setup.thrusters[k].torque_body_n_m[axis] != 0.0);
        table.output(v.force.thruster.element(axis), force, nothing);
        table.output(v.torque.thruster.element(axis), torque, nothing);
    }
    table.output(v.delta_v, nothing, nothing);
    table.output(v.propellant.used, nothing, nothing);
    table.output(v.propellant.left, nothing, v.propellant.loaded);
    table.output(v.mass, nothing, v.propellant.loaded);
}

/// The burn in flight and as planned.
fn burn(table: &mut Dependencies, v: &SpinVariables) {
    let nothing = &knowns![];
    let burn = &v.burn;
    let actuator = &knowns![burn.plan, burn.thruster, burn.group];
    let body = &knowns![inertia(v), v.spin.initial_rate];
    let widths = &knowns![burn.plan, burn.pulse_width, burn.taper_order, v.pulse.resolution];
    let turns = &knowns![burn.turns_per_pulse];
    let number = &knowns![burn.count, burn.angle];
    let assumed = &knowns![burn.spin_rate_error, burn.ratio_error];
    let pulse = &knowns![actuator, body, widths, number, assumed];
    let train = &knowns![pulse, turns];

    table.output(burn.pulses_fired, nothing, nothing);
    table.output(burn.active, nothing, nothing);
    table.output(burn.done, nothing, nothing);
    table.output(
        burn.next_edge,
        switches(v),
        knowns![
            actuator,
            body,
            assumed,
            number,
            turns,
            burn.pulse_width,
            burn.timing,
            burn.start,
            burn.target_direction,
            v.start.q,
            v.start.nutation,
            v.start.nutation_phase,
            v.damper.time_constant,
            v.thruster.iter().map(|it| knowns![it.rise_time, it.tail_off_time]).collect::<Knowns>(),
        ],
    );
    table.calculated(burn.planned_count, train);
    table.calculated(burn.planned_duration, train);
    table.calculated(burn.planned_angle, train);
    table.calculated(burn.pulse_angle, pulse);
    table.calculated(v.nutation.kick, pulse);
    table.calculated(v.nutation.envelope, knowns![pulse, turns]);
}

/// Sun and Earth, and the limits they set.
fn directions(table: &mut Dependencies, v: &SpinVariables) {
    let (orbit, limit) = (&v.geometry, &v.limit);
    let on_orbit = &knowns![
        orbit.source,
        orbit.line_rate,
        orbit.amplitude,
        orbit.longitude,
        orbit.in_plane_phase,
        orbit.out_of_plane_phase,
    ];
    let bodies = [
        (v.sun.direction, v.sun.inertial, v.sun.angle, limit.sun_angle_violated, limit.sun_angle),
        (v.earth.direction, v.earth.inertial, v.earth.angle, limit.earth_angle_violated, limit.earth_angle),
    ];
    for (direction, inertial, angle, violated, limit) in bodies {
        let at_start = &knowns![direction, on_orbit];
        table.output(inertial, direction, at_start);
        table.output(angle, direction, knowns![at_start, v.start.q]);
        table.output(violated, direction, knowns![at_start, v.start.q, limit]);
    }
    let switches = &switches(v);
    let rate = &knowns![v.spin.initial_rate];
    let variation = &knowns![v.sun.direction, on_orbit, v.start.q, v.start.nutation, rate];
    table.output(v.spin.period_variation, knowns![switches, v.sun.direction], variation);
    table.output(
        limit.period_variation_violated,
        knowns![switches, v.sun.direction],
        knowns![variation, limit.period_variation],
    );
    let spin_limits = &knowns![rate, limit.spin_rate, limit.spin_rate_tolerance];
    table.output(limit.spin_rate_violated, switches, spin_limits);
    table.output(
        limit.any_violated,
        knowns![switches, v.sun.direction, v.earth.direction],
        knowns![
            variation,
            v.earth.direction,
            spin_limits,
            limit.sun_angle,
            limit.earth_angle,
            limit.period_variation,
        ],
    );
}

/// Sun sensor and star tracker. The clock's first sample is due at the start time and belongs to the first step.
fn sensors(table: &mut Dependencies, v: &SpinVariables) {
    let nothing = &knowns![];
    let (tracker, star) = (&v.star_tracker, v.star.direction);
    let switches = &switches(v);
    table.output(v.spin.period, switches, v.spin.initial_rate);
    table.output(v.spin.period_change, nothing, nothing);
    table.output(v.spin.sector_error, nothing, nothing);
    table.output(v.spin.sun_crossings, nothing, nothing);
    table.output(v.sun_sensor.angle, nothing, nothing);
    table.output(tracker.declination, star, nothing);
    table.output(tracker.sample_time, star, nothing);
    table.output(tracker.sample_count, star, nothing);
    table.output(tracker.declination_true, star, knowns![star, v.start.q]);
    table.output(tracker.nutation, switches, nothing);
    table.output(tracker.nutation_sigma, switches, nothing);
    let observed = &knowns![v.spin.initial_rate, inertia(v)];
    table.calculated(tracker.observation_time, knowns![observed, tracker.sampling, v.limit.spin_rate]);
    table.calculated(tracker.observation_time_nominal, observed);
}
