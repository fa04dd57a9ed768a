//! Force and torque of sunlight by array offset, windmill angle, place of the Sun and alternation, and their derivatives.
//!
//! The downlink attitude puts the Sun at azimuth A and elevation E of the body frame, the Earth in the XY plane; the alternate one is the
//! same turned by 180 deg about the Sun line s, so that its torque is T' = 2 s (s.T) - T, its force alike: what lies across the Sun line changes sign.
//! Derivatives by the angles are central differences of the physics with a step of [`STEP_RAD`] (error of its square, 1e-8 relative).

use nalgebra::{Matrix3, Rotation3, Vector3};
use physics::{
    attitude::SunAngles,
    guidance::{
        downlink::sun_direction::{Downlink, DownlinkRequest, downlink},
        geometry::moving::fixed,
        pointing::antenna::Antennas,
    },
    momentum::Convention,
    plant::{PanelSetting, Ramp, SunLight, SunlitConfiguration, Tilt},
    radiation::{Beam, SolarModel},
    refusal::Refusal,
    spacecraft::{MassProperties, Material, Panel, Spacecraft, SunshadeModel},
};

use super::{
    controls::{ARRAYS, Control, Controls, PLACE},
    linear_torque::{LinearLoad, LinearTorque},
    simulated::FlightRow,
};

/// Step of the central differences, in rad or as a share.
const STEP_RAD: f64 = 1e-4;

/// Attitude of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attitude {
    /// As it was simulated.
    SimulatedFlight,
    /// A downlink with the Sun where the controls put it.
    Downlink,
}

/// A panel as its mission has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunlitPanel {
    /// Whether it takes part.
    pub is_enabled: bool,
    /// Side of the windmill, as in the spacecraft's file.
    pub windmill_side: f64,
    /// Tilt about its axis.
    pub tilt: Tilt,
    /// Light on its cells that it is turned for as the distance from the Sun changes, in suns, where it is.
    pub followed_suns: Option<f64>,
}

impl SunlitPanel {
    fn setting(&self, own: PanelSetting) -> PanelSetting {
        if self.is_enabled { own } else { PanelSetting::Disabled }
    }
}

/// A spacecraft in sunlight as its mission has it.
#[derive(Clone, Debug)]
pub struct SunlitSpacecraft {
    /// As its file has it.
    pub spacecraft: Spacecraft,
    /// Sunlight.
    pub light: SunLight,
    /// Mass, centre of mass and inertia with every panel at angle 0.
    pub current_mass_panels_stowed: MassProperties,
    /// Centres of mass by the time from which on they count, in s, body frame, in m; before the first that of `current_mass_panels_stowed`.
    pub centers_of_mass: Vec<(f64, Vector3<f64>)>,
    /// Panels.
    pub panels: Vec<SunlitPanel>,
    /// Frame of the torques: EME2000, or, where the body components are integrated, the body frame.
    pub convention: Convention,
    solar: SolarModel,
    antennas: Antennas,
}

impl SunlitSpacecraft {
    /// Model of a spacecraft with its panels tilted as its file says.
    ///
    /// # Errors
    /// A sunshade that is not there in this form.
    pub fn new(
        spacecraft: Spacecraft,
        light: SunLight,
        sunshade: Option<SunshadeModel>,
    ) -> Result<Self, Refusal> {
        let panel = |panel: &Panel| SunlitPanel {
            is_enabled: true,
            windmill_side: panel.windmill_side,
            tilt: panel.tilt_sign.into(),
            followed_suns: None,
        };
        Ok(Self {
            solar: SolarModel::new(&spacecraft, sunshade)?,
            antennas: Antennas::new(&spacecraft.antennas),
            current_mass_panels_stowed: spacecraft.mass_properties,
            panels: spacecraft.panels.iter().map(panel).collect(),
            centers_of_mass: Vec::new(),
            convention: Convention::Inertial,
            light,
            spacecraft,
        })
    }

    /// Sets the material in this place of the spacecraft's.
    pub fn set_material(&mut self, place: usize, material: &Material) {
        self.solar.set_material(place, material);
    }

    /// Sense in which a windmill angle turns each panel that takes part.
    pub fn windmill_sides(&self) -> impl Iterator<Item = f64> + '_ {
        self.panels.iter().filter(|panel| panel.is_enabled).map(|panel| panel.windmill_side)
    }

    fn mass_at(&self, time_s: f64) -> MassProperties {
        let begun = self.centers_of_mass.iter().rev().find(|(at_s, _)| *at_s <= time_s);
        let center =
            begun.map_or(self.current_mass_panels_stowed.center_of_mass_body_m, |(_, center)| *center);
        MassProperties { center_of_mass_body_m: center, ..self.current_mass_panels_stowed }
    }

    /// The attitude of a downlink with the Sun there; `None` where Sun or Earth has no direction.
    pub fn downlink_attitude(
        &self,
        row: &FlightRow,
        azimuth_rad: f64,
        elevation_rad: f64,
    ) -> Option<Rotation3<f64>> {
        let found = self.downlink(row, SunAngles { azimuth_rad, elevation_rad })?;
        Some(found.vectors.pointing()?.frame().inertial_from_body)
    }

    /// Whether Sun, Earth and antennas allow a downlink with the Sun there.
    pub fn allows(&self, row: &FlightRow, azimuth_rad: f64, elevation_rad: f64) -> bool {
        let found = self.downlink(row, SunAngles { azimuth_rad, elevation_rad });
        found.is_some_and(|found| !found.clamped)
    }

    fn downlink(&self, row: &FlightRow, sun_body: SunAngles) -> Option<Downlink> {
        let request = DownlinkRequest { sun_body, ..DownlinkRequest::default() };
        downlink(&fixed(row.to_sun_m), &fixed(row.to_earth_m), &self.antennas, &request)
    }

    /// Takes vectors of the body frame to that in which torques are given.
    fn given_from_body(&self, inertial_from_body: &Rotation3<f64>) -> Rotation3<f64> {
        match self.convention {
            Convention::Inertial => *inertial_from_body,
            Convention::BodyIntegral => Rotation3::identity(),
        }
    }

    fn settings(&self, controls: &Controls) -> Vec<PanelSetting> {
        let [offset_rad, windmill_rad] = controls.each(ARRAYS);
        let setting = |panel: &SunlitPanel| {
            let offset = Ramp::held(offset_rad + windmill_rad * panel.windmill_side);
            panel.setting(PanelSetting::SunOffset { offset, tilt: panel.tilt })
        };
        self.panels.iter().map(setting).collect()
    }

    /// Force in EME2000 and torque about the centre of mass of direct sunlight, in N and N m.
    fn load(
        &self,
        row: &FlightRow,
        inertial_from_body: &Rotation3<f64>,
        settings: &[PanelSetting],
    ) -> [Vector3<f64>; 2] {
        let distance_m = row.to_sun_m.norm();
        let sun_body = inertial_from_body.inverse() * (row.to_sun_m / distance_m);
        let sunlit = self.spacecraft_at(row, settings, distance_m);
        let center = sunlit.mass_properties(&sun_body).center_of_mass_body_m;
        let load = sunlit.load(&self.beam(row, sun_body), &center);
        let torque = self.given_from_body(inertial_from_body) * load.torque_body_n_m;
        [inertial_from_body * load.force_body_n, torque]
    }

    fn beam(&self, row: &FlightRow, source_body: Vector3<f64>) -> Beam<f64> {
        Beam { source_body, pressure_pa: self.light.pressure_pa(row.to_sun_m.norm()) * row.lit_fraction }
    }

    /// At a row, its panels standing as they do this far from the Sun, in m.
    fn spacecraft_at<'a>(
        &'a self,
        row: &FlightRow,
        settings: &'a [PanelSetting],
        sun_distance_m: f64,
    ) -> SunlitConfiguration<'a> {
        SunlitConfiguration {
            solar: &self.solar,
            panels: &self.spacecraft.panels,
            settings,
            current_mass_panels_stowed: self.mass_at(row.time_s),
            time_s: row.time_s,
            sun_distance_m,
        }
    }

    /// Change of the force with the distance from the Sun by panels that follow it, at the same pressure, EME2000, in N/m.
    pub fn force_by_distance_n_m(&self, row: &FlightRow) -> Vector3<f64> {
        if self.panels.iter().all(|panel| panel.followed_suns.is_none()) {
            return Vector3::zeros();
        }
        let setting = |(panel, angle_rad): (&SunlitPanel, &f64)| {
            panel.setting(match panel.followed_suns {
                Some(suns) => PanelSetting::Distance { suns, tilt: panel.tilt },
                None => PanelSetting::Angle(Ramp::held(*angle_rad)),
            })
        };
        let settings: Vec<_> = self.panels.iter().zip(&row.panel_angles_rad).map(setting).collect();
        let distance_m = row.to_sun_m.norm();
        let sun_body = row.inertial_from_body.inverse() * (row.to_sun_m / distance_m);
        let [high_n, low_n] = [STEP_RAD, -STEP_RAD].map(|step| {
            let sunlit = self.spacecraft_at(row, &settings, distance_m * (1.0 + step));
            sunlit.load(&self.beam(row, sun_body), &Vector3::zeros()).force_body_n
        });
        row.inertial_from_body * (high_n - low_n) / (2.0 * STEP_RAD * distance_m)
    }

    /// Torque of direct sunlight with arrays and attitude as they were simulated; no angle is a control.
    pub fn simulated(&self, row: &FlightRow) -> LinearTorque {
        let setting = |(panel, angle_rad): (&SunlitPanel, &f64)| {
            panel.setting(PanelSetting::Angle(Ramp::held(*angle_rad)))
        };
        let settings: Vec<_> = self.panels.iter().zip(&row.panel_angles_rad).map(setting).collect();
        let loads = self.load(row, &row.inertial_from_body, &settings);
        self.linear(row, &row.inertial_from_body, loads, [[Vector3::zeros(); 2]; 4])
    }

    /// Torque of direct sunlight in the attitude that is not alternate, in N m.
    pub fn torque_n_m(&self, row: &FlightRow, attitude: Attitude, controls: &Controls) -> Vector3<f64> {
        self.loads(row, attitude, controls)[1]
    }

    fn loads(&self, row: &FlightRow, attitude: Attitude, controls: &Controls) -> [Vector3<f64>; 2] {
        self.load(row, &self.inertial_from_body(row, attitude, controls), &self.settings(controls))
    }

    /// Returns the matrix of the attitude; the simulated one where the downlink has none.
    pub(super) fn inertial_from_body(
        &self,
        row: &FlightRow,
        attitude: Attitude,
        controls: &Controls,
    ) -> Rotation3<f64> {
        let [azimuth_rad, elevation_rad] = controls.each(PLACE);
        let turns = attitude == Attitude::Downlink;
        let downlink = turns.then(|| self.downlink_attitude(row, azimuth_rad, elevation_rad)).flatten();
        downlink.unwrap_or(row.inertial_from_body)
    }

    /// Returns the torque, the force with it, and their derivatives by the angles.
    pub fn linearised(&self, row: &FlightRow, attitude: Attitude, controls: &Controls) -> LinearTorque {
        let by = |control: Control| {
            let value = controls.get(control);
            let at = |step: f64| self.loads(row, attitude, &controls.with(control, value + step));
            let [high, low] = [at(STEP_RAD), at(-STEP_RAD)];
            [0, 1].map(|of| (high[of] - low[of]) / (2.0 * STEP_RAD))
        };
        let mut by_angle = [[Vector3::zeros(); 2]; 4];
        by_angle[0] = by(Control::Offset);
        by_angle[1] = by(Control::Windmill);
        if attitude == Attitude::Downlink {
            by_angle[2] = by(Control::Azimuth);
            by_angle[3] = by(Control::Elevation);
        }
        let inertial_from_body = self.inertial_from_body(row, attitude, controls);
        let loads = self.load(row, &inertial_from_body, &self.settings(controls));
        self.linear(row, &inertial_from_body, loads, by_angle)
    }

    /// The same of a downlink whose alternate attitude has its own place of the Sun.
    pub fn linearised_apart(&self, row: &FlightRow, controls: &Controls) -> LinearTorque {
        let of = |controls: &Controls| self.linearised(row, Attitude::Downlink, controls);
        LinearTorque { alternate: Some(of(&controls.alternate()).normal), ..of(controls) }
    }

    fn linear(
        &self,
        row: &FlightRow,
        inertial_from_body: &Rotation3<f64>,
        [force_n, torque]: [Vector3<f64>; 2],
        loads_by_angle: [[Vector3<f64>; 2]; 4],
    ) -> LinearTorque {
        // T = sum (r - c) x F, so dT/dc_i = -e_i x F.
        let given_from_body = self.given_from_body(inertial_from_body);
        let given_force_n = given_from_body * (inertial_from_body.inverse() * force_n);
        LinearTorque {
            normal: LinearLoad {
                torque,
                by_angle: loads_by_angle.map(|[_, torque]| torque),
                force_n,
                force_by_angle: loads_by_angle.map(|[force, _]| force),
                by_center: given_force_n.cross_matrix() * given_from_body.matrix(),
            },
            alternate: None,
            half_turn: half_turn(&row.to_sun_m),
        }
    }
}

/// 2 s sT - 1 about a direction of any length.
fn half_turn(about: &Vector3<f64>) -> Matrix3<f64> {
    let axis = about.normalize();
    axis * axis.transpose() * 2.0 - Matrix3::identity()
}

#[cfg(test)]
mod tests;
