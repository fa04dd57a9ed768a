//! The thrust that a spacecraft file promises of a set of thrusters: direction in the body frame and acceleration.

use nalgebra::Vector3;

use crate::spacecraft::{Spacecraft, ThrusterSet};

/// A sum of forces below this share of their magnitudes has no direction: they stand against each other.
const BALANCED: f64 = 1e-6;

/// The nominal thrust of a burn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NominalThrust {
    /// Unit vector.
    pub direction_body: Vector3<f64>,
    /// In m/s2; 0 where no thruster of the set pushes that way.
    pub acceleration_m_s2: f64,
}

impl NominalThrust {
    /// Nominal thrust of the thrusters of `set` along `direction_body`, of any length. Where that is zero: along the sum of their forces, or
    /// along +Z where they have none. Those count that push along it at all.
    pub fn new(spacecraft: &Spacecraft, set: Option<ThrusterSet>, direction_body: Vector3<f64>) -> Self {
        let firing = spacecraft.thrusters.iter().filter(|it| set.is_some() && it.set == set);
        let forces_n = firing.map(|thruster| thruster.force_body_n);
        let (sum_n, size_n) = forces_n
            .clone()
            .fold((Vector3::zeros(), 0.0), |(sum, size), force| (sum + force, size + force.norm()));
        let along_forces = || sum_n.try_normalize(BALANCED * size_n);
        let direction_body =
            direction_body.try_normalize(0.0).or_else(along_forces).unwrap_or_else(Vector3::z);
        let force_n: f64 = forces_n.map(|force| force.dot(&direction_body).max(0.0)).sum();
        Self { direction_body, acceleration_m_s2: force_n / spacecraft.mass_properties.mass_kg }
    }
}

#[cfg(test)]
mod tests {
    //! Of sets whose sum is known.
    use approx::assert_relative_eq;

    use super::*;
    use crate::spacecraft::{MESSENGER_TOML, Thruster, ValveTiming};

    fn spacecraft() -> Spacecraft {
        let mut spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let thruster = |force_body_n: [f64; 3], set| Thruster {
            name: String::new(),
            position_body_m: Vector3::zeros(),
            force_body_n: Vector3::from(force_body_n),
            torque_body_n_m: Vector3::zeros(),
            flow_kg_s: 0.01,
            valve: ValveTiming::default(),
            scatter: 0.0,
            power_w: None,
            set: Some(set),
            attitude_control: true,
            tank: 0,
            at_pressure_pa: None,
            plume_half_angle_rad: 0.0,
        };
        spacecraft.thrusters = vec![
            thruster([13.2, 0.0, 17.6], ThrusterSet(1)),
            thruster([-13.2, 0.0, 17.6], ThrusterSet(1)),
            thruster([0.0, 4.4, 0.0], ThrusterSet(2)),
            thruster([0.0, -4.4, 0.0], ThrusterSet(2)),
        ];
        spacecraft
    }

    #[test]
    fn a_set_pushes_along_the_sum_of_its_forces() {
        let spacecraft = spacecraft();
        let mass_kg = spacecraft.mass_properties.mass_kg;
        let canted = NominalThrust::new(&spacecraft, Some(ThrusterSet(1)), Vector3::zeros());
        assert_relative_eq!(canted.direction_body, Vector3::z(), epsilon = 1e-15);
        assert_relative_eq!(canted.acceleration_m_s2, 35.2 / mass_kg, max_relative = 1e-14);
        let sideways = NominalThrust::new(&spacecraft, Some(ThrusterSet(2)), -Vector3::y() * 3.0);
        assert_relative_eq!(sideways.direction_body, -Vector3::y(), epsilon = 1e-15);
        assert_relative_eq!(sideways.acceleration_m_s2, 4.4 / mass_kg, max_relative = 1e-14);
    }

    #[test]
    fn without_thrusters_or_sum_the_direction_is_plus_z() {
        let spacecraft = spacecraft();
        for set in [None, Some(ThrusterSet(0)), Some(ThrusterSet(2))] {
            let nominal = NominalThrust::new(&spacecraft, set, Vector3::zeros());
            assert_eq!(nominal.direction_body, Vector3::z());
            assert_eq!(nominal.acceleration_m_s2, 0.0);
        }
    }
}
