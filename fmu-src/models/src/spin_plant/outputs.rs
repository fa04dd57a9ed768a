//! From what the physics shows to the master's variables.

use fmi_export::{OutputRates, Real, RealVector, Values};
use nalgebra::Vector3;
use physics::spin::plant::{Bounds, Outputs, Plant, Predictions, Rates};

use super::setup::{Plan, SpinPlant};

/// Writes what holds for the whole flight.
pub(super) fn write_calculated(context: &Plan<'_>, values: &mut Values, plant: &Plant) {
    let v = context.variables;
    let seen = Predictions::from_plant(plant);
    values.set_integer(v.burn.planned_count, count(seen.count));
    values.set_real(v.burn.planned_duration, seen.duration_s);
    values.set_real(v.burn.planned_angle, seen.manoeuvre_rad);
    values.set_real(v.burn.pulse_angle, seen.manoeuvre_per_pulse_rad);
    values.set_real(v.nutation.ratio, seen.nutation_ratio);
    values.set_real(v.nutation.kick, seen.kick_rad);
    values.set_real(v.nutation.envelope, seen.envelope_rad);
    values.set_real(v.star_tracker.observation_time, seen.observation_time_s);
    values.set_real(v.star_tracker.observation_time_nominal, seen.observation_time_eq20_s);
}

/// Writes what changes from step to step.
pub(super) fn write(context: &Plan<'_>, values: &mut Values, plant: &Plant) {
    let v = context.variables;
    let spinner = context.setup;
    let seen = Outputs::from_plant(plant, spinner);
    let Plant { time_s, propulsion, .. } = plant;
    let (directions, valves) = (plant.directions_at(*time_s), &propulsion.valves);
    values.set_vector(v.attitude.q, seen.state.attitude.0);
    values.set_vector(v.attitude.rate, seen.rate_rad_s.into());
    values.set_vector(v.momentum.inertial, seen.state.momentum_inertial.into());
    values.set_vector(v.momentum.body, seen.state.momentum_body.into());
    values.set_real(v.momentum.displacement, seen.momentum_displacement_rad);
    values.set_vector(v.spin_axis.inertial, seen.spin_axis_inertial.into());
    values.set_real(v.spin_axis.displacement, seen.spin_axis_displacement_rad);
    values.set_real(v.nutation.angle, seen.nutation_rad);
    values.set_real(v.nutation.phase, seen.nutation_phase_rad);
    values.set_real(v.coning_angle, seen.inertia.coning_rad());
    values.set_real(v.nutation.predicted, seen.predicted_nutation_rad);
    values.set_real(v.spin.rate, seen.spin_rate_rad_s);
    values.set_real(v.spin.period, seen.period_s);
    values.set_real(v.spin.period_change, seen.period_change_s);
    values.set_real(v.spin.period_variation, seen.period_variation_s);
    values.set_real(v.spin.sector_error, seen.sector_error);
    values.set_integer(v.spin.sun_crossings, count(plant.sensors.sun.count));
    values.set_vector(v.sun.inertial, directions.sun_inertial.into());
    values.set_real(v.sun.angle, seen.sun_angle_rad);
    values.set_vector(v.earth.inertial, directions.earth_inertial.into());
    values.set_real(v.earth.angle, seen.earth_angle_rad);
    values.set_real(v.sun_sensor_angle, plant.sensors.sun_sample_rad);
    values.set_real(v.star_tracker.declination, plant.sensors.sample.declination_rad);
    values.set_real(v.star_tracker.declination_true, seen.declination_rad);
    values.set_real(v.star_tracker.sample_time, plant.sensors.sample.time_s);
    values.set_integer(v.star_tracker.sample_count, count(plant.sensors.sample.count));
    values.set_real(v.star_tracker.nutation, seen.estimate.nutation_rad);
    values.set_real(v.star_tracker.nutation_sigma, seen.estimate.sigma_rad);
    values.set_integer(v.burn.pulses_fired, count(seen.pulses_fired));
    values.set_boolean(v.burn.active, seen.burn_active);
    values.set_boolean(v.burn.done, seen.burn_done);
    values.set_real(v.burn.next_edge, seen.next_edge_s);
    values.set_vector(v.mass_properties.inertia, seen.inertia.principal_kg_m2());
    values.set_real(v.inertia_ratio, seen.inertia.ratio());
    for (k, thruster) in v.thruster.iter().enumerate() {
        values.set_boolean(thruster.active, valves.open_mask() >> k & 1 == 1);
        values.set_boolean(thruster.too_short, valves.too_short_mask() >> k & 1 == 1);
    }
    values.set_vector(v.force_thruster, valves.law.force_at_n(*time_s).into());
    values.set_vector(v.torque.thruster, valves.law.torque_at_n_m(*time_s).into());
    values.set_vector(v.delta_v, seen.delta_v_inertial_m_s.into());
    values.set_real(v.propellant.used, seen.propellant_used_kg);
    values.set_real(v.propellant.left, seen.propellant_remaining_kg);
    values.set_real(v.mass, propulsion.mass_at_kg(spinner, *time_s));
    values.set_real(v.energy, seen.energy_j);
    let violated = seen.violations(&Bounds {
        sun_angle_rad: values.real(v.limit.sun_angle),
        earth_angle_rad: values.real(v.limit.earth_angle),
        spin_rate_rad_s: values.real(v.limit.spin_rate),
        spin_rate_tolerance_rad_s: values.real(v.limit.spin_rate_tolerance),
        period_variation_s: values.real(v.limit.period_variation),
    });
    values.set_boolean(v.limit.sun_angle_violated, violated.sun_angle);
    values.set_boolean(v.limit.earth_angle_violated, violated.earth_angle);
    values.set_boolean(v.limit.spin_rate_violated, violated.spin_rate);
    values.set_boolean(v.limit.period_variation_violated, violated.period_variation);
    values.set_boolean(v.limit.any_violated, violated.any());
}

/// A number as an Integer of FMI, at most its greatest.
fn count(number: impl TryInto<i32>) -> i32 {
    number.try_into().unwrap_or(i32::MAX)
}

impl OutputRates for SpinPlant {
    /// First time derivative of an output that is continuous in time.
    fn output_rate(context: &Plan<'_>, _values: &Values, plant: &Plant, output: Real) -> Option<f64> {
        let v = context.variables;
        let rates = Rates::from_plant(plant, context.setup);
        let law = &plant.propulsion.valves.law;
        let of = |handle: Real, value: f64| (handle == output).then_some(value);
        let of_vector =
            |handle: RealVector<3>, value: &Vector3<f64>| handle.index_of(output).map(|index| value[index]);
        let of_q = v.attitude.q.index_of(output).map(|index| rates.attitude_1_s[index]);
        of_q.or_else(|| of_vector(v.attitude.rate, &rates.rate_rad_s2))
            .or_else(|| of_vector(v.momentum.inertial, &rates.momentum_inertial_n_m))
            .or_else(|| of_vector(v.momentum.body, &rates.momentum_body_n_m))
            .or_else(|| of_vector(v.spin_axis.inertial, &rates.spin_axis_1_s))
            .or_else(|| of_vector(v.delta_v, &rates.delta_v_m_s2))
            .or_else(|| of_vector(v.force_thruster, &law.force_body_n[1]))
            .or_else(|| of_vector(v.torque.thruster, &law.torque_body_n_m[1]))
            .or_else(|| of(v.spin.rate, rates.spin_rate_rad_s2))
            .or_else(|| of(v.nutation.angle, rates.nutation_rad_s))
            .or_else(|| of(v.nutation.phase, rates.nutation_phase_rad_s))
            .or_else(|| of(v.sun.angle, rates.sun_angle_rad_s))
            .or_else(|| of(v.earth.angle, rates.earth_angle_rad_s))
            .or_else(|| of(v.spin_axis.displacement, rates.spin_axis_displacement_rad_s))
            .or_else(|| of(v.momentum.displacement, rates.momentum_displacement_rad_s))
            .or_else(|| of(v.star_tracker.declination_true, rates.declination_rad_s))
            .or_else(|| of(v.energy, rates.power_w))
            .or_else(|| of(v.propellant.used, rates.flow_kg_s))
            .or_else(|| of(v.propellant.left, rates.mass_kg_s))
            .or_else(|| of(v.mass, rates.mass_kg_s))
            .filter(|rate| rate.is_finite())
    }
}
