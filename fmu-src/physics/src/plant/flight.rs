//! The plant: attitude, torque and force at any time of a configured flight.

use nalgebra::Vector3;

use crate::attitude::{MovingFrame, gravity_gradient_n_m};
use crate::environment::State;
use crate::environment::ephemeris::Ephemeris;
use crate::environment::orbit::OrbitMethod;
use crate::momentum::{Flight, Sample};
use crate::radiation::{Beam, ForceTorque, SolarModel};
use crate::spacecraft::Panel;

use super::configuration::{AttitudeSource, Configuration};
use super::geometry::Geometry;
use super::light::{LightModel, Loads};
use super::stretch::{Course, PlantError};

/// The attitude law's branch numbers stay below this bit.
const SHADOW_SHIFT: u32 = 8;

/// Force and torque from outside, body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExternalLoad {
    /// Through the centre of mass, in N.
    pub force_body_n: Vector3<f64>,
    /// About the centre of mass, in N m.
    pub torque_body_n_m: Vector3<f64>,
}

/// Everything about one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapshot {
    /// Where everything is.
    pub geometry: Geometry,
    /// Body frame and rate.
    pub frame: MovingFrame,
    /// Unit vector to the Sun, body frame.
    pub sun_body: Vector3<f64>,
    /// Unit vector to the Earth, body frame.
    pub earth_body: Vector3<f64>,
    /// Visible part of the Sun's disc, 0 to 1.
    pub lit_fraction: f64,
    /// Direct sunlight.
    pub solar: ForceTorque<f64>,
    /// Sunlight reflected by the planet.
    pub albedo: ForceTorque<f64>,
    /// Infrared light of the planet.
    pub infrared: ForceTorque<f64>,
    /// Recoil of the heat the spacecraft radiates.
    pub thermal: ForceTorque<f64>,
    /// Torque by the planet's gravity gradient, body frame, in N m.
    pub gravity_gradient_body_n_m: Vector3<f64>,
    /// From outside.
    pub external: ExternalLoad,
    /// Branch of the attitude law.
    pub branch: u32,
}

impl Snapshot {
    /// Sum of all torques, body frame, in N m.
    pub fn torque_body_n_m(&self) -> Vector3<f64> {
        self.solar.torque_body_n_m
            + self.gravity_gradient_body_n_m
            + self.external.torque_body_n_m
            + self.albedo.torque_body_n_m
            + self.infrared.torque_body_n_m
            + self.thermal.torque_body_n_m
    }

    /// Sum of all forces but gravity, body frame, in N.
    pub fn force_body_n(&self) -> Vector3<f64> {
        self.solar.force_body_n
            + self.external.force_body_n
            + self.albedo.force_body_n
            + self.infrared.force_body_n
            + self.thermal.force_body_n
    }
}

/// What flies, prepared once.
#[derive(Clone, Copy, Debug)]
pub struct Craft<'a> {
    /// Its panels.
    pub panels: &'a [Panel],
    /// The whole of it in sunlight.
    pub solar: &'a SolarModel,
    /// How its orbit is integrated, if it is.
    pub orbit_method: &'a OrbitMethod,
}

/// A configured flight, ready to be evaluated.
pub struct Plant<'a, L> {
    pub(super) craft: Craft<'a>,
    pub(super) configuration: &'a Configuration,
    pub(super) course: &'a mut Course,
    pub(super) ephemeris: &'a mut Ephemeris,
    pub(super) light: Option<&'a mut LightModel>,
    external: L,
}

impl<'a, L: Fn(f64) -> ExternalLoad> Plant<'a, L> {
    /// `course` belongs to this configuration, and so does `light`, without which direct sunlight is all there is;
    /// `external` gives the load from outside at any time.
    pub fn new(
        craft: Craft<'a>,
        configuration: &'a Configuration,
        course: &'a mut Course,
        ephemeris: &'a mut Ephemeris,
        light: Option<&'a mut LightModel>,
        external: L,
    ) -> Self {
        Self { craft, configuration, course, ephemeris, light, external }
    }

    /// Everything at `time_s`, which the course must have reached ([`Flight::prepare`]).
    pub fn snapshot(&mut self, time_s: f64) -> Snapshot {
        let configuration = self.configuration;
        let geometry = self.geometry(time_s);
        let (frame, branch) = self.attitude(time_s, &geometry);
        let to_body = frame.inertial_from_body.inverse();
        let sun_distance_m = geometry.to_sun.position_m.norm();
        let sun_body = to_body * direction(&geometry.to_sun.position_m);
        let (lit_fraction, shadow_branch) = self.lit_fraction(&geometry);
        let pressure_pa = configuration.light.pressure_pa(sun_distance_m);
        let gravity_gradient_body_n_m = match &geometry.to_planet {
            Some(to_planet) => gravity_gradient_n_m(
                configuration.gravity_gradient_m3_s2,
                &configuration.inertia_body_kg_m2,
                &(to_body * to_planet.position_m),
            ),
            None => Vector3::zeros(),
        };
        let Loads { shadowed_solar, albedo, infrared, thermal } = self.loads(time_s);
        let solar = shadowed_solar.unwrap_or_else(|| {
            self.sunlight(&Beam { source_body: sun_body, pressure_pa: pressure_pa * lit_fraction })
        });
        Snapshot {
            geometry,
            frame,
            sun_body,
            earth_body: to_body * direction(&geometry.to_earth.position_m),
            solar,
            albedo,
            infrared,
            thermal,
            lit_fraction,
            gravity_gradient_body_n_m,
            external: (self.external)(time_s),
            branch: branch | shadow_branch << SHADOW_SHIFT,
        }
    }

    /// Time since the last periapsis, in s.
    pub fn time_since_periapsis_s(&self, time_s: f64) -> f64 {
        self.course.trajectory.time_since_periapsis_s(self.configuration, time_s)
    }

    fn loads(&self, time_s: f64) -> Loads {
        match (&self.course.light, &self.light) {
            (Some(cell), Some(light)) if self.configuration.light_and_heat.any() => {
                let shadowed = self.configuration.light_and_heat.shadowing && light.model.can_shadow();
                cell.loads(time_s, shadowed)
            }
            _ => Loads::none(),
        }
    }

    fn sunlight(&self, beam: &Beam<f64>) -> ForceTorque<f64> {
        let center_of_mass = &self.configuration.center_of_mass_body_m;
        let solar = self.craft.solar;
        let mut sum = solar.sunshade(beam, center_of_mass) + solar.body(beam, center_of_mass);
        for (index, (panel, setting)) in self.craft.panels.iter().zip(&self.configuration.panels).enumerate()
        {
            if let Some(angle_rad) = setting.angle_rad(panel, &beam.source_body) {
                sum += solar.panel(index, beam, angle_rad, center_of_mass);
            }
        }
        sum
    }

    /// Smooth while this number stays the same.
    pub(super) fn branch(&mut self, time_s: f64) -> u32 {
        let geometry = self.geometry(time_s);
        let (_, shadow_branch) = self.lit_fraction(&geometry);
        self.attitude(time_s, &geometry).1 | shadow_branch << SHADOW_SHIFT
    }

    /// Visible part of the Sun, and which part of the shadow this is: outside, penumbra, inside.
    pub(super) fn lit_fraction(&self, geometry: &Geometry) -> (f64, u32) {
        if geometry.to_planet.is_none() {
            return (1.0, 0);
        }
        let spacecraft_m = geometry.spacecraft.position_m;
        let sun_m = spacecraft_m + geometry.to_sun.position_m;
        let shadow = &self.configuration.shadow;
        let gaps_rad = shadow.gaps_rad(&spacecraft_m, &sun_m).unwrap_or([f64::NAN; 2]);
        if gaps_rad[0] > 0.0 {
            return (1.0, 0);
        }
        let inside = u32::from(gaps_rad[1] <= 0.0);
        (shadow.lit_fraction(&spacecraft_m, &sun_m).unwrap_or(f64::NAN), 1 + inside)
    }

    /// Where everything is at `time_s`.
    pub(super) fn geometry(&mut self, time_s: f64) -> Geometry {
        let spacecraft: State = self.course.trajectory.state_at(self.configuration, time_s);
        Geometry::at(self.configuration, self.ephemeris, time_s, spacecraft)
    }

    /// Body frame and rate, and which branch of the law they come from.
    pub(super) fn attitude(&mut self, time_s: f64, geometry: &Geometry) -> (MovingFrame, u32) {
        match &self.configuration.attitude {
            AttitudeSource::Guided(guided) => {
                let (configuration, ephemeris) = (self.configuration, &mut *self.ephemeris);
                let trajectory = &self.course.trajectory;
                let epoch_s = time_s + configuration.epoch_minus_time_s;
                let window = trajectory
                    .window(configuration, time_s)
                    .unwrap_or_else(|| guided.schedule.window(epoch_s));
                let guided = guided.within(window, epoch_s, |at_epoch_s| {
                    if at_epoch_s == epoch_s {
                        return geometry.lines_of_sight();
                    }
                    let at_s = at_epoch_s - configuration.epoch_minus_time_s;
                    let spacecraft = trajectory.state_at_window_start(configuration, at_s);
                    Geometry::at(configuration, ephemeris, at_s, spacecraft).lines_of_sight()
                });
                (guided.frame, u32::from(guided.branch))
            }
            AttitudeSource::Commanded(command) => {
                let frame = MovingFrame {
                    inertial_from_body: command.attitude_at(time_s).inertial_from_body(),
                    rate_body_rad_s: command.rate_body_rad_s,
                };
                (frame, 0)
            }
        }
    }
}

impl<L: Fn(f64) -> ExternalLoad> Flight for Plant<'_, L> {
    type Failure = PlantError;

    fn prepare(&mut self, start_s: f64) -> Result<f64, PlantError> {
        self.reach(start_s)
    }

    fn sample(&mut self, time_s: f64) -> Sample {
        let snapshot = self.snapshot(time_s);
        Sample {
            inertial_from_body: snapshot.frame.inertial_from_body,
            torque_body_n_m: snapshot.torque_body_n_m(),
            acceleration_inertial_m_s2: snapshot.frame.inertial_from_body * snapshot.force_body_n()
                / self.configuration.mass_kg,
            branch: snapshot.branch,
        }
    }
}

fn direction(vector: &Vector3<f64>) -> Vector3<f64> {
    vector / vector.norm()
}
