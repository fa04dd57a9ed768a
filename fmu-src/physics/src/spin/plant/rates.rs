//! Time derivatives of the continuous outputs of a spinner in flight.

use nalgebra::Vector3;

use super::state::Plant;
use crate::spin::spinner::Spinner;

/// First time derivatives of the continuous outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Rate of the quaternion.
    pub attitude_1_s: [f64; 4],
    /// Rate of the angular rate, body components.
    pub rate_rad_s2: Vector3<f64>,
    /// Rate of the spin about the third principal axis.
    pub spin_rate_rad_s2: f64,
    /// Rate of the momentum, inertial.
    pub momentum_inertial_n_m: Vector3<f64>,
    /// Rate of the momentum, body components.
    pub momentum_body_n_m: Vector3<f64>,
    /// Rate of the spin axis, inertial.
    pub spin_axis_1_s: Vector3<f64>,
    /// Rate of the thrusters' delta-v, inertial.
    pub delta_v_m_s2: Vector3<f64>,
    /// Rate of the nutation angle.
    pub nutation_rad_s: f64,
    /// Rate of the azimuth of the transverse momentum.
    pub nutation_phase_rad_s: f64,
    /// Rate of the Sun angle, for a Sun that stands still.
    pub sun_angle_rad_s: f64,
    /// Rate of the Earth angle, for an Earth that stands still.
    pub earth_angle_rad_s: f64,
    /// Rate of the spin axis's angle from its start.
    pub spin_axis_displacement_rad_s: f64,
    /// Rate of the momentum's angle from its start.
    pub momentum_displacement_rad_s: f64,
    /// Rate of the star's declination.
    pub declination_rad_s: f64,
    /// Rate of the kinetic energy.
    pub power_w: f64,
    /// Rate of the propellant used.
    pub flow_kg_s: f64,
    /// Rate of the mass and of the remaining propellant.
    pub mass_kg_s: f64,
}

impl Rates {
    /// Returns the derivatives at the present time.
    pub fn from_plant(plant: &Plant, spinner: &Spinner) -> Self {
        let time_s = plant.time_s;
        let motion = &plant.motion;
        let state = plant.state();
        let inertia = &motion.inertia;
        let q = state.attitude;
        // Everything about the principal axes, and from there to the body's.
        let h = inertia.principal_from_body(&state.momentum_body);
        let moments_kg_m2 = Vector3::from(inertia.principal_kg_m2());
        let rate = h.component_div(&moments_kg_m2);
        let gain = motion.damper.gain(&h);
        // See `damper`: the body turns at J^-1 h and a little about the line of nodes.
        let turning_principal = rate + Vector3::new(-h.y, h.x, 0.0) * gain;
        let turning = inertia.body_from_principal(&turning_principal);
        let torque_body = motion.torque.at(time_s, &turning);
        let torque = inertia.principal_from_body(&torque_body);
        let h_dot = h.cross(&turning_principal) + torque;
        let rate_dot = h_dot.component_div(&moments_kg_m2);
        let [x, y, z, w] = q.0;
        let v_dot = turning * w + Vector3::new(x, y, z).cross(&turning);
        let w_dot = -(x * turning.x + y * turning.y + z * turning.z);
        let axis = q.spin_axis_inertial();
        let axis_dot = q.inertial_from_body(&turning.cross(&Vector3::z()));
        let momentum_dot = q.inertial_from_body(&torque_body);
        let pull = state.momentum_inertial;
        let across_square = h.x * h.x + h.y * h.y;
        let across = across_square.sqrt();
        let directions = plant.directions_at(time_s);
        let law = &plant.propulsion.valves.law;
        let flow_kg_s = law.flow_at_kg_s(time_s);
        let mass_kg = plant.propulsion.mass_at_kg(spinner, time_s);
        let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        let across_dot = ratio(h.x * h_dot.x + h.y * h_dot.y, across);
        Self {
            attitude_1_s: [0.5 * v_dot.x, 0.5 * v_dot.y, 0.5 * v_dot.z, 0.5 * w_dot],
            rate_rad_s2: inertia.body_from_principal(&rate_dot),
            spin_rate_rad_s2: rate_dot.z,
            momentum_inertial_n_m: momentum_dot,
            momentum_body_n_m: inertia.body_from_principal(&h_dot),
            spin_axis_1_s: axis_dot,
            delta_v_m_s2: q.inertial_from_body(&law.force_at_n(time_s)) / mass_kg,
            nutation_rad_s: ratio(across_dot * h.z - across * h_dot.z, h.norm_squared()),
            nutation_phase_rad_s: ratio(h.x * h_dot.y - h.y * h_dot.x, across_square),
            sun_angle_rad_s: angle_rate(&axis, &axis_dot, &directions.sun_inertial),
            earth_angle_rad_s: angle_rate(&-axis, &-axis_dot, &directions.earth_inertial),
            spin_axis_displacement_rad_s: angle_rate(&axis, &axis_dot, &plant.initial.spin_axis_inertial),
            momentum_displacement_rad_s: angle_rate(&pull, &momentum_dot, &plant.initial.momentum_inertial),
            declination_rad_s: {
                let sine = axis.dot(&directions.star_inertial);
                ratio(axis_dot.dot(&directions.star_inertial), (1.0 - sine * sine).max(0.0).sqrt())
            },
            power_w: 0.5 * (rate_dot.dot(&h) + rate.dot(&h_dot)),
            flow_kg_s,
            mass_kg_s: -flow_kg_s,
        }
    }
}

/// Rate of the angle between a moving vector of any length and a fixed one; 0 where they are parallel.
fn angle_rate(moving: &Vector3<f64>, moving_dot: &Vector3<f64>, fixed: &Vector3<f64>) -> f64 {
    let normal = moving.cross(fixed);
    let (sine, square) = (normal.norm(), moving.norm_squared());
    if sine == 0.0 || square == 0.0 {
        return 0.0;
    }
    // The part of the motion toward the fixed vector closes the angle.
    let toward = normal.cross(moving);
    -moving_dot.dot(&toward) / (sine * square)
}
