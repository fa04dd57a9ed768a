//! The spacecraft in direct sunlight: its panels as they stand to the Sun, its centre of mass, and the load.

use nalgebra::Vector3;

use crate::loads::ForceTorque;
use crate::plant::settings::panel_setting::{PanelSetting, SunAt, panel_angle_rad};
use crate::radiation::{Beam, SolarModel};
use crate::spacecraft::{MassProperties, Panel, with_panels};

/// A spacecraft as sunlight meets it.
#[derive(Clone, Copy, Debug)]
pub struct SunlitConfiguration<'a> {
    /// Prepared for sunlight.
    pub solar: &'a SolarModel,
    /// Its panels.
    pub panels: &'a [Panel],
    /// One setting a panel.
    pub settings: &'a [PanelSetting],
    /// Mass, centre of mass and inertia with every panel at angle 0.
    pub current_mass_panels_stowed: MassProperties,
    /// When, in s: angles that are set may change.
    pub time_s: f64,
    /// How far from the Sun's centre, in m.
    pub sun_distance_m: f64,
}

impl SunlitConfiguration<'_> {
    /// Mass, centre of mass and inertia as the panels stand, the Sun being there (unit vector, body frame).
    pub fn mass_properties(&self, sun_body: &Vector3<f64>) -> MassProperties {
        let sun = self.sun_at(sun_body);
        let angle_rad = |index| panel_angle_rad(self.settings, self.panels, index, &sun);
        with_panels(&self.current_mass_panels_stowed, self.panels, angle_rad)
    }

    /// Direct sunlight without self-shadows, about the centre of mass.
    pub fn load(&self, beam: &Beam<f64>, center_of_mass_body_m: &Vector3<f64>) -> ForceTorque<f64> {
        let sun = self.sun_at(&beam.source_body);
        let normal_body = |index: usize, panel: &Panel| self.settings.get(index)?.normal_body(panel, &sun);
        self.solar.load(beam, normal_body, center_of_mass_body_m)
    }

    fn sun_at(&self, direction_body: &Vector3<f64>) -> SunAt {
        SunAt { time_s: self.time_s, direction_body: *direction_body, distance_m: self.sun_distance_m }
    }

    /// Its torque in N m, body frame, at this pressure in Pa, the Sun being there.
    pub fn torque_body_n_m(&self, sun_body: &Vector3<f64>, pressure_pa: f64) -> Vector3<f64> {
        let center_of_mass = self.mass_properties(sun_body).center_of_mass_body_m;
        self.load(&Beam { source_body: *sun_body, pressure_pa }, &center_of_mass).torque_body_n_m
    }

    /// Centre of mass with the panels as they stand to a Sun on -Y, body frame, in m.
    pub fn center_of_mass_body_m(&self) -> Vector3<f64> {
        self.mass_properties(&-Vector3::y()).center_of_mass_body_m
    }
}
