//! Where the body flies: everything that its loads follow from, with the attitude that dynamics give it.

use nalgebra::Vector3;

use crate::attitude::{Attitude, BodyMotion, MovingFrame};
use crate::environment::ephemeris::Ephemeris;
use crate::momentum::TorqueModel;
use crate::propulsion::PropellantState;
use crate::spacecraft::MassProperties;

use super::configuration::{AttitudeSource, Command, Configuration, DynamicAttitude};
use super::error::PlantError;
use super::evaluation::{ExternalLoad, Plant, PreparedSpacecraft};
use super::propagator_state::PropagatorState;
use super::radiation_solver::RadiationSolver;

/// Where the body flies: everything that its loads follow from.
pub struct Flight<'f> {
    /// The spacecraft.
    pub prepared: PreparedSpacecraft<'f>,
    /// What flies, where; its attitude is set here.
    pub configuration: &'f mut Configuration,
    /// Orbit, light and heat.
    pub propagator: &'f mut PropagatorState,
    /// Planets.
    pub ephemeris: &'f mut Ephemeris,
    /// Light and heat beyond direct sunlight.
    pub light: Option<&'f mut RadiationSolver>,
    /// Propellant used so far.
    pub propellant: &'f mut PropellantState,
    /// Force and torque from outside at a time, body frame, by which an orbit goes that forces act on.
    pub external: &'f dyn Fn(f64) -> ExternalLoad,
}

impl Flight<'_> {
    /// Frame and rate that the orbit phase's own guidance commands where the flight begins; `None` without it.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn guided_start(&mut self, time_s: f64, work_limit: u32) -> Result<Option<MovingFrame>, PlantError> {
        let mut plant = self.as_configured(work_limit);
        plant.prepare(time_s, time_s)?;
        Ok(plant.guided_frame(time_s))
    }

    /// Mass properties with the panels as they stand where the flight begins in this attitude.
    pub fn mass_at_start(&mut self, time_s: f64, attitude: Attitude) -> MassProperties {
        let body = BodyMotion {
            attitude: attitude.unit_quaternion(),
            rate_body_rad_s: Vector3::zeros(),
            momentum_inertial_n_m_s: Vector3::zeros(),
            delta_v_inertial_m_s: Vector3::zeros(),
        };
        let mut plant = self.plant(time_s, &body, u32::MAX);
        let instant = plant.instant(time_s);
        plant.mass_properties(&instant)
    }

    /// The plant with the body as it turns now.
    pub(super) fn plant(
        &mut self,
        time_s: f64,
        body: &BodyMotion,
        work_limit: u32,
    ) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        let motion = Command {
            attitude: Attitude::from_unit(body.attitude),
            rate_body_rad_s: body.rate_body_rad_s,
            since_s: time_s,
        };
        let guided = self.configuration.attitude.guided().copied();
        self.configuration.attitude = AttitudeSource::Dynamic(DynamicAttitude { motion, guided });
        self.as_configured(work_limit)
    }

    /// The plant in the attitude of its configuration.
    pub(super) fn as_configured(&mut self, work_limit: u32) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        Plant::new(
            self.prepared,
            self.configuration,
            self.propagator,
            self.ephemeris,
            self.light.as_deref_mut(),
            self.external,
            work_limit,
        )
    }
}
