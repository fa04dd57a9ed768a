//! The plant: attitude, torque and force at any time of a configured flight.

use nalgebra::Vector3;

use crate::attitude::{MovingFrame, gravity_gradient_n_m};
use crate::constants::RADIUS_SUN_M;
use crate::environment::ephemeris::Ephemeris;
use crate::environment::orbit::OrbitMethod;
use crate::momentum::{Effort, EventValues, Sample, TorqueModel};
use crate::numerics::spacing::spacing;
use crate::radiation::{Beam, Effect, ForceTorque, Loads, SolarModel};
use crate::spacecraft::Panel;

use super::configuration::Configuration;
use super::error::PlantError;
use super::instant::Instant;
use super::propagator_state::PropagatorState;
use super::radiation_solver::RadiationSolver;
use super::work::{Cost, Work};

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
pub struct Evaluation {
    /// Where everything is and how the body stands.
    pub instant: Instant,
    /// What acts on it.
    pub loads: Loads,
}

impl Evaluation {
    /// Of a spacecraft of which nothing is known but how it stands: no Sun, no planet, no force.
    pub fn nowhere(frame: MovingFrame) -> Self {
        Self { instant: Instant::nowhere(frame), loads: Loads::zero() }
    }

    /// Whether a spacecraft can be there: outside the planet and the Sun, every number finite.
    pub fn is_somewhere(&self) -> bool {
        let total = self.loads.total();
        self.instant.sun_distance_m > RADIUS_SUN_M
            && self.instant.lit_fraction.is_finite()
            && total.torque_body_n_m.iter().chain(&total.force_body_n).all(|x| x.is_finite())
    }

    /// Force of all effects, EME2000, in N.
    pub fn force_inertial_n(&self) -> Vector3<f64> {
        self.instant.frame.inertial_from_body * self.loads.total().force_body_n
    }

    /// Acceleration of a spacecraft of this mass by all effects, EME2000, in m/s2.
    pub fn acceleration_inertial_m_s2(&self, mass_kg: f64) -> Vector3<f64> {
        self.force_inertial_n() / mass_kg
    }
}

/// What flies, prepared once.
#[derive(Clone, Copy, Debug)]
pub struct PreparedSpacecraft<'a> {
    /// Its panels.
    pub panels: &'a [Panel],
    /// The whole of it in sunlight.
    pub solar: &'a SolarModel,
    /// How its orbit is integrated, if it is.
    pub orbit_method: &'a OrbitMethod,
}

/// A configured flight, ready to be evaluated.
pub struct Plant<'a, L> {
    pub(super) prepared: PreparedSpacecraft<'a>,
    pub(super) configuration: &'a Configuration,
    pub(super) propagator: &'a mut PropagatorState,
    pub(super) ephemeris: &'a mut Ephemeris,
    pub(super) light: Option<&'a mut RadiationSolver>,
    external: L,
    work: Work,
    /// Spent on event functions and not counted yet.
    pub(super) searched_units: u32,
}

impl<'a, L: Fn(f64) -> ExternalLoad> Plant<'a, L> {
    /// Units of a sample, sunlight on many faces aside: everything that is not read from a polynomial.
    const SAMPLE_UNITS: u32 = 3;

    /// `propagator` belongs to this configuration, and so does `light`, without which direct sunlight is all there is;
    /// `external` gives the load from outside at any time. At most `work_limit` units of work are done, of about a
    /// microsecond each.
    pub fn new(
        prepared: PreparedSpacecraft<'a>,
        configuration: &'a Configuration,
        propagator: &'a mut PropagatorState,
        ephemeris: &'a mut Ephemeris,
        light: Option<&'a mut RadiationSolver>,
        external: L,
        work_limit: u32,
    ) -> Self {
        let work = Work::new(work_limit, ephemeris.evaluations());
        Self { prepared, configuration, propagator, ephemeris, light, external, work, searched_units: 0 }
    }

    /// Counts work, the flight having come to `time_s`.
    pub(super) fn spend_units(&mut self, cost: Cost, units: u32, time_s: f64) -> Result<(), PlantError> {
        let searched = core::mem::take(&mut self.searched_units);
        self.work.spend(Cost::Search, searched, self.ephemeris.evaluations(), time_s)?;
        Ok(self.work.spend(cost, units, self.ephemeris.evaluations(), time_s)?)
    }

    /// Everything at `time_s`, which the propagator must have reached ([`TorqueModel::prepare`]).
    pub fn evaluate(&mut self, time_s: f64) -> Evaluation {
        let instant = self.instant(time_s);
        let mut loads = self.radiation(time_s, &instant);
        if let Some(planet_body_m) = &instant.planet_body_m {
            loads[Effect::GravityGradient].torque_body_n_m = gravity_gradient_n_m(
                self.configuration.gravity_gradient_m3_s2,
                &self.configuration.inertia_body_kg_m2,
                planet_body_m,
            );
        }
        let ExternalLoad { force_body_n, torque_body_n_m } = (self.external)(time_s);
        loads[Effect::Applied] = ForceTorque { force_body_n, torque_body_n_m };
        Evaluation { instant, loads }
    }

    /// Time since the last periapsis, in s.
    pub fn time_since_periapsis_s(&self, time_s: f64) -> f64 {
        self.propagator.trajectory.time_since_periapsis_s(self.configuration, time_s)
    }

    /// Light and heat: slow effects from their segment, plain sunlight in closed form.
    fn radiation(&self, time_s: f64, instant: &Instant) -> Loads {
        let effects = &self.configuration.light_and_heat;
        let mut loads = Loads::zero();
        let mut shadowed = false;
        if let (Some(segment), Some(light)) = (&self.propagator.light, &self.light)
            && effects.any()
        {
            shadowed = effects.shadowing && light.model.can_shadow();
            segment.loads(time_s, &mut loads);
        }
        if !shadowed {
            let pressure_pa = self.configuration.light.pressure_pa(instant.sun_distance_m);
            loads[Effect::Solar] = self.sunlight(&Beam {
                source_body: instant.sun_body,
                pressure_pa: pressure_pa * instant.lit_fraction,
            });
        }
        loads
    }

    fn sunlight(&self, beam: &Beam<f64>) -> ForceTorque<f64> {
        let center_of_mass = &self.configuration.center_of_mass_body_m;
        let solar = self.prepared.solar;
        let mut sum = solar.sunshade(beam, center_of_mass) + solar.body(beam, center_of_mass);
        for (index, (panel, setting)) in
            self.prepared.panels.iter().zip(&self.configuration.panels).enumerate()
        {
            if let Some(angle_rad) = setting.angle_rad(panel, &beam.source_body) {
                sum += solar.panel(index, beam, angle_rad, center_of_mass);
            }
        }
        sum
    }
}

impl<L: Fn(f64) -> ExternalLoad> TorqueModel for Plant<'_, L> {
    type Failure = PlantError;

    fn prepare(&mut self, start_s: f64, limit_s: f64) -> Result<f64, PlantError> {
        self.reach(start_s, limit_s)
    }

    fn sample(&mut self, time_s: f64) -> Sample {
        let evaluation = self.evaluate(time_s);
        Sample {
            inertial_from_body: evaluation.instant.frame.inertial_from_body,
            torque_body_n_m: evaluation.loads.total().torque_body_n_m,
            acceleration_inertial_m_s2: evaluation.acceleration_inertial_m_s2(self.configuration.mass_kg),
            events: evaluation.instant.events,
        }
    }

    fn events(&mut self, time_s: f64) -> EventValues {
        self.searched_units = self.searched_units.saturating_add(1);
        self.instant(time_s).events
    }

    fn time_rounding_s(&self, time_s: f64) -> f64 {
        spacing(time_s).max(spacing(time_s + self.configuration.epoch_minus_time_s))
    }

    fn spend(&mut self, effort: Effort, time_s: f64) -> Result<(), PlantError> {
        let samples = match effort {
            Effort::Segment | Effort::Refinement => 10,
            Effort::Search => 60,
            // With the segment that it begins.
            Effort::Dump => 16,
        };
        let faces = self.prepared.solar.face_count() as u32;
        self.spend_units(effort.into(), samples * (Self::SAMPLE_UNITS + faces / 50), time_s)
    }
}
