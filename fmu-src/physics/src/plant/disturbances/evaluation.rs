//! Everything about one time of a flight: geometry, attitude, loads, mass properties, air and field.

use nalgebra::Vector3;

use crate::attitude::MovingFrame;
use crate::constants::RADIUS_SUN_M;
use crate::loads::{ForceTorque, Loads};
use crate::plant::instant::air_and_field_segment::AirAndField;
use crate::plant::instant::at_time::Instant;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::plant::sources::gravity_gradient::pole_inertial;
use crate::spacecraft::MassProperties;

/// Everything about one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// Geometry and attitude.
    pub instant: Instant,
    /// Force and torque by effect.
    pub loads: Loads,
    /// Mass, centre of mass and inertia as the panels stand.
    pub mass: MassProperties,
    /// Momentum of panels that turn, relative to the body, body frame, in N m s.
    pub panels_body_n_m_s: Vector3<f64>,
    /// Air and magnetic field about it.
    pub air_and_field: AirAndField,
}

impl Evaluation {
    /// Spacecraft with a known attitude and no position: no Sun, no planet, no force.
    pub fn without_position(frame: MovingFrame, mass: MassProperties, time_s: f64) -> Self {
        Self {
            instant: Instant::without_position(frame, time_s),
            loads: Loads::zero(),
            mass,
            panels_body_n_m_s: Vector3::zeros(),
            air_and_field: AirAndField::default(),
        }
    }

    /// Checks that a spacecraft can be there at `time_s`: outside the planet and the Sun, the planet outside
    /// the Sun, every number finite.
    ///
    /// # Errors
    /// A place inside one of them.
    pub fn check(&self, time_s: f64) -> Result<(), PlantError> {
        let geometry = &self.instant.geometry;
        let is_outside = |planet| (geometry.to_sun - planet).position_m.norm() > RADIUS_SUN_M;
        let planet_is_outside = geometry.to_planet.is_none_or(is_outside);
        let is_somewhere = self.instant.sun_distance_m > RADIUS_SUN_M
            && planet_is_outside
            && self.instant.lit_fraction.is_finite()
            && self.loads.total().is_finite();
        let position_m = geometry.spacecraft.position_m;
        if is_somewhere {
            Ok(())
        } else {
            Err(PlantError::WithoutPosition { time_s, position_m: position_m.into() })
        }
    }

    /// Momentum of the body and its panels without the wheels, J w + h_p, body frame, in N m s.
    pub fn structure_body_n_m_s(&self) -> Vector3<f64> {
        self.mass.inertia_body_kg_m2 * self.instant.law.frame.rate_body_rad_s + self.panels_body_n_m_s
    }

    /// Force of all effects in N and the acceleration of the spacecraft by it in m/s2, EME2000.
    pub fn force_and_acceleration_inertial(&self) -> [Vector3<f64>; 2] {
        let force_inertial_n = self.instant.law.frame.inertial_from_body * self.loads.total().force_body_n;
        [force_inertial_n, force_inertial_n / self.mass.mass_kg]
    }

    /// Velocity relative to the air, body frame, in m/s; zero without a planet.
    pub fn velocity_in_air_body_m_s(&self) -> Vector3<f64> {
        self.air_and_field.velocity_body_m_s(&self.instant).unwrap_or_else(Vector3::zeros)
    }

    /// North of the planet, body frame, where its flattening acts on the gravity gradient; otherwise zero.
    pub fn pole_body(&self, configuration: &Configuration) -> Vector3<f64> {
        pole_inertial(configuration, self.instant.time_s)
            .map_or_else(Vector3::zeros, |it| self.instant.to_body * it)
    }

    /// Magnetic field, body frame, in T.
    pub fn field_body_t(&self) -> Vector3<f64> {
        self.instant.to_body * self.air_and_field.field_inertial_t
    }
}

/// Force through the centre of mass and torque from outside at a time, body frame, and how they change per second.
pub type External<'a> = dyn Fn(f64) -> [ForceTorque; 2] + 'a;
