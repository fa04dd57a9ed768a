//! Disturbances of an attitude that is not known ahead: force and torque over one interval of their grid, linear in time.
//!
//! Equation: T(t) = a + b (t - start) through the loads at the two nodes of Gauss-Legendre quadrature, the body taken to turn
//! on at its present rate where a controller holds that, else under the torque that the interval before has there.
//! Method: an interval ends at the grid's next edge or sooner: where light changes abruptly, where the body has turned by
//! [`LONGEST_TURN_RAD`], or where the fit is not what the tolerance asks for ([`crate::numerics::adaptive`]). Where it ends
//! follows from the state at its start alone.
//! Order: the impulse over an interval has an error of h^5 as long as the body does turn on like that. Torque that is off by dT
//! from what was foreseen, J being the inertia, leaves an attitude that is off by J^-1 dT h^2 / 2 at its end.
//! Error measure: the first term that a line leaves out is Legendre's second, c P2; at both ends it shows whole, and so does a
//! kink next to them, where the load falls on another side of a surface. It does not change the integral; what the momentum in
//! inertial axes has of it is its product with the second term of the turning body's axes, (w h)^2 / 12, and what the two nodes
//! alias is of the size of c^2. So c max(c, (w h)^2 / 12) is below the tolerance, c relative to the largest force and torque of
//! all effects in the interval. An interval in which body and orbit turn by less than [`SHORTEST_TURN_RAD`] is not judged by it.
//! In free flight the attitude by which the disturbances are off from those foreseen, in rad, is below the tolerance as well.
//! Reference: Davis and Rabinowitz, Methods of Numerical Integration, 2.7; see [`crate::numerics::adaptive`].

use nalgebra::{Matrix3, Vector3};

use crate::environment::CartesianState;
use crate::loads::{Active, ByEffect, Effect, Linear, Loads};
use crate::math;
use crate::momentum::{TorqueModel, WorkKind};
use crate::numerics::adaptive::{AdaptiveInterval, Attempt};
use crate::numerics::intervals::next_multiple_s;
use crate::numerics::quadrature::GAUSS_2;

use super::evaluation::Evaluation;
use super::plant::Plant;
use crate::plant::instant::at_time::Instant;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::settings::error::PlantError;
use crate::plant::sources::Dipoles;
use crate::plant::sources::sunlight::light_and_heat::LEAST_ARM_M;
use crate::plant::state::disturbance_interval::DisturbanceInterval;

/// Nodes of Gauss-Legendre quadrature of order 4 on [0, 1].
const NODES: [f64; 2] = [GAUSS_2[0].0, GAUSS_2[1].0];
/// By how much the body turns within an interval at most, in rad: so far apart the nodes see every side of it.
const LONGEST_TURN_RAD: f64 = 0.5;
/// An interval in which body and orbit turn by less, in rad, is not shortened for the fit: where light falls on another side of
/// a surface the load has a kink, which no interval resolves and so short a one hardly feels.
const SHORTEST_TURN_RAD: f64 = 0.01;
/// Nor is an interval shorter than this share of the grid's.
const SHORTEST_SHARE: f64 = 0.1;
/// Order of the impulse's error relative to the impulse.
const ORDER: usize = 4;

/// The interval of `plant` that begins at `start_s`, after `last`, and lasts to the next multiple of `grid_s` at most; a body
/// that nothing holds has this inverse of its inertia.
///
/// # Errors
/// What ends a flight.
pub(crate) fn next_interval(
    last: &DisturbanceInterval,
    plant: &mut Plant<'_>,
    start_s: f64,
    grid_s: f64,
    free_inverse_inertia: Option<&Matrix3<f64>>,
) -> Result<DisturbanceInterval, PlantError> {
    plant.spend(WorkKind::Segment, start_s)?;
    let (known_s, begin) = plant.begin(start_s, next_multiple_s(start_s, grid_s))?;
    let limit_s = match plant.path.excludes_events(&begin, known_s - start_s) {
        true => known_s,
        false => plant.path.smooth_until(start_s, known_s),
    };
    let rate_rad_s = begin.law.frame.rate_body_rad_s.norm();
    let turning_rad_s = rate_rad_s + orbital_rate_rad_s(&begin.geometry.spacecraft);
    let longest_s = last.span.next_longest_s.min(LONGEST_TURN_RAD / rate_rad_s);
    let shortest_s = (SHORTEST_TURN_RAD / turning_rad_s).min(SHORTEST_SHARE * grid_s);
    let configuration = plant.path.configuration;
    let (active, tolerance) = (configuration.effects, configuration.light_and_heat.tolerance);
    let interval = AdaptiveInterval::new(start_s, grid_s, longest_s, limit_s, shortest_s);
    let ([first, second], span) = interval.fit::<_, PlantError>(ORDER, |interval| {
        if interval.is_refinement() {
            plant.spend(WorkKind::Refinement, start_s)?;
        }
        let span_s = interval.end_s() - start_s;
        let nodes = NODES.map(|node| plant.evaluate(start_s + node * span_s));
        nodes[0].check(start_s)?;
        let unforeseen_rad_s2 =
            free_inverse_inertia.map_or(0.0, |it| unforeseen(last, active, it, &nodes, span_s));
        let mut unresolved = 0.5 * unforeseen_rad_s2 * span_s * span_s;
        if turning_rad_s * span_s >= SHORTEST_TURN_RAD {
            let last_s = plant.path.configuration.last_of_panels_s(start_s, interval.end_s());
            let ends = [start_s, last_s].map(|at_s| plant.evaluate(at_s));
            let fit_error = fit_error(active, &nodes, &ends);
            unresolved = unresolved.max(fit_error * fit_error.max(math::powi(rate_rad_s * span_s, 2) / 12.0));
        } else if unresolved <= tolerance {
            return Ok(Attempt::Short(nodes));
        }
        Ok(Attempt::Fitted { fit: nodes, unresolved, tolerance })
    })?;
    let span_s = span.end_s - start_s;
    let line = |of: &dyn Fn(&Evaluation) -> Vector3<f64>| -> Linear {
        let (a, b) = (of(&first), of(&second));
        let slope = (b - a) / (NODES[1] - NODES[0]);
        [a - slope * NODES[0], slope / span_s]
    };
    let mut loads = ByEffect::default();
    for effect in active.disturbances().filter(|effect| !effect.is_in_field()) {
        let force = line(&|it| it.loads[effect].force_body_n);
        loads[effect] = Some([force, line(&|it| it.loads[effect].torque_body_n_m)]);
    }
    let field_inertial_t = line(&|it| it.air_and_field.field_inertial_t);
    // The Sun is seen from the start on, however long the interval is.
    let (now, then) = (&begin, &second.instant);
    let elapsed_s = NODES[1] * span_s;
    let [to_sun, to_sun_then] = [now, then].map(|it| it.geometry.to_sun.position_m.normalize());
    let to_sun = [to_sun, (to_sun_then - to_sun) / elapsed_s];
    let lit_fraction = [now.lit_fraction, (then.lit_fraction - now.lit_fraction) / elapsed_s];
    Ok(DisturbanceInterval {
        span,
        made_for: plant.path.digest,
        loads,
        field_inertial_t,
        to_sun,
        lit_fraction,
    })
}

/// Force and torque by effect within an interval, with those of these dipoles in its field.
pub(crate) fn loads_at(interval: &DisturbanceInterval, dipoles: &Dipoles, instant: &Instant) -> Loads {
    let mut loads = interval.loads_at(instant.time_s);
    for (row, dipole) in Effect::FIELD.into_iter().zip(dipoles) {
        if let Some([dipole_body_a_m2, _]) = dipole.filter(|[now, _]| *now != Vector3::zeros()) {
            let [field_inertial_t, _] = interval.field_at(instant.time_s);
            loads[row].torque_body_n_m = dipole_body_a_m2.cross(&(instant.to_body * field_inertial_t));
        }
    }
    loads
}

/// Angular acceleration by which the disturbances at the nodes of an interval after this one, `span_s` long, are off from what
/// this one has there, in rad/s2.
fn unforeseen(
    last: &DisturbanceInterval,
    active: Active,
    inverse_inertia: &Matrix3<f64>,
    nodes: &[Evaluation; 2],
    span_s: f64,
) -> f64 {
    let off_rad_s2 = |(node, share): (&Evaluation, f64)| {
        let [_, [foreseen_n_m, slope_n_m_s]] = last.total_at(last.span.end_s);
        let effects = active.disturbances().filter(|effect| !effect.is_in_field());
        let found_n_m: Vector3<f64> = effects.map(|effect| node.loads[effect].torque_body_n_m).sum();
        (inverse_inertia * (found_n_m - foreseen_n_m - slope_n_m_s * (share * span_s))).norm()
    };
    nodes.iter().zip(NODES).map(off_rad_s2).fold(0.0, f64::max)
}

/// Integrates the deviation of the orbit under the forces of the interval, at the predicted attitude (Encke's method).
///
/// # Errors
/// What ends a flight.
pub(crate) fn deviate(interval: &DisturbanceInterval, plant: &mut Plant<'_>) -> Result<(), PlantError> {
    let applied = (plant.external)(interval.span.start_s);
    let Kinematics { configuration, turning, trajectory, current_mass_panels_stowed, .. } = &mut plant.path;
    if !configuration.uses_encke() {
        return Ok(());
    }
    let acceleration_m_s2 = |time_s: f64| {
        let force_body_n = interval.force_body_n(&applied, interval.span.start_s, time_s);
        turning.frame_at(time_s).inertial_from_body * (force_body_n / current_mass_panels_stowed.mass_kg)
    };
    Ok(trajectory.accelerate(configuration, interval.span.span(), Some(acceleration_m_s2))?)
}

/// By how much the direction from the centre turns, in rad/s; 0 at the centre.
fn orbital_rate_rad_s(spacecraft: &CartesianState) -> f64 {
    let (distance_m, speed_m_s) = (spacecraft.position_m.norm(), spacecraft.velocity_m_s.norm());
    if distance_m > 0.0 { speed_m_s / distance_m } else { 0.0 }
}

/// Largest distance at the two ends of force, torque and magnetic field from the line through those at the two nodes, relative to the
/// largest force and torque of all effects there, and the field; a torque counts against the largest force at an arm of 1 cm at least.
fn fit_error(active: Active, nodes: &[Evaluation; 2], ends: &[Evaluation; 2]) -> f64 {
    let (mut scale, mut most) = ([0.0_f64; 2], [0.0_f64; 2]);
    // Distance at the ends, and the largest value.
    let off_line = |[a, b, start, end]: [Vector3<f64>; 4]| {
        let slope = (b - a) * (NODES[0] / (NODES[1] - NODES[0]));
        [(start - (a - slope)).amax().max((end - (b + slope)).amax()), a.amax().max(b.amax())]
    };
    let evaluations = [&nodes[0], &nodes[1], &ends[0], &ends[1]];
    for effect in active.disturbances().filter(|effect| !effect.is_in_field()) {
        let loads = evaluations.map(|it| it.loads[effect]);
        let kinds = [loads.map(|it| it.force_body_n), loads.map(|it| it.torque_body_n_m)];
        for (kind, values) in kinds.into_iter().enumerate() {
            most[kind] = most[kind].max(off_line(values)[0]);
            scale[kind] = values.iter().fold(scale[kind], |most, it| most.max(it.amax()));
        }
    }
    let [force_n, torque_n_m] = scale;
    let torque_n_m = torque_n_m.max(force_n * LEAST_ARM_M);
    let share = |most: f64, scale: f64| if scale > 0.0 { most / scale } else { 0.0 };
    let [field_most_t, field_t] = off_line(evaluations.map(|it| it.air_and_field.field_inertial_t));
    share(most[0], force_n).max(share(most[1], torque_n_m)).max(share(field_most_t, field_t))
}
