//! Torque of thrusters about the centre of mass, each way about the body axes, and the surface that a plume meets.

use nalgebra::Vector3;

use crate::propulsion::surface_in_plume;
use crate::spacecraft::Spacecraft;

/// Torque below this part of force times arm is rounding of the arm.
const ROUNDING: f64 = 1e-9;

/// Force and torque of one thruster at full thrust.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrusterFigures {
    /// Its name.
    pub name: String,
    /// Its force, in N.
    pub force_body_n: Vector3<f64>,
    /// Its torque about the centre of mass, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// The plate or panel that its plume meets.
    pub meets: Option<String>,
}

impl ThrusterFigures {
    /// Computes the figures of all thrusters, with the panels at these angles in rad, about a centre of mass in m.
    pub(super) fn for_all(
        spacecraft: &Spacecraft,
        panel_angles_rad: &[f64],
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Vec<Self> {
        let angle_rad = |index: usize| panel_angles_rad.get(index).copied();
        let all = spacecraft.thrusters.iter().map(|thruster| Self {
            name: thruster.name.clone(),
            force_body_n: thruster.force_body_n,
            torque_body_n_m: thruster.torque_about_n_m(center_of_mass_body_m),
            meets: surface_in_plume(spacecraft, thruster, angle_rad).map(str::to_owned),
        });
        all.collect()
    }
}

/// Greatest torque about each body axis, each way, of thrusters that fire whatever else they give, in N m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueBothWays {
    /// About +X, +Y, +Z.
    pub plus_n_m: Vector3<f64>,
    /// About -X, -Y, -Z, as magnitudes.
    pub minus_n_m: Vector3<f64>,
}

impl TorqueBothWays {
    /// Computes the torque of the thrusters that may control the attitude, each way about every axis.
    pub(super) fn new(spacecraft: &Spacecraft, center_of_mass_body_m: &Vector3<f64>) -> Option<Self> {
        let may_control = spacecraft.thrusters.iter().filter(|it| it.attitude_control);
        let torques_n_m = may_control.map(|thruster| {
            let arm_m = (thruster.position_body_m - center_of_mass_body_m).norm();
            let least_n_m = ROUNDING * arm_m * thruster.force_body_n.norm();
            let torque_n_m = thruster.torque_about_n_m(center_of_mass_body_m);
            torque_n_m.map(|part_n_m| if part_n_m.abs() > least_n_m { part_n_m } else { 0.0 })
        });
        let split = torques_n_m.map(|torque_n_m| Self {
            plus_n_m: torque_n_m.map(|part_n_m| part_n_m.max(0.0)),
            minus_n_m: torque_n_m.map(|part_n_m| (-part_n_m).max(0.0)),
        });
        split.reduce(|sum, one| Self {
            plus_n_m: sum.plus_n_m + one.plus_n_m,
            minus_n_m: sum.minus_n_m + one.minus_n_m,
        })
    }
}
