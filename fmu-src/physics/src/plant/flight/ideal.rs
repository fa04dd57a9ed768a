//! Flight in an attitude that is followed ideally: momentum, and dumps whose thrusters take propellant and push at once.
//!
//! Equations: t = S dH by the thrusters' selection S; dv = sum F t / m; du = sum q t from each tank, nominal thrust and no
//! shortest pulse. Centre of mass and inertia are those of what is left from there on. Where no thrusters give torque all ways
//! about the centre of mass a dump is as one of a spacecraft without thrusters.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::momentum::{DumpEvent, DumpSpacing, MomentumIntegrator, Stop, TorqueModel, Totals};

use super::configured::ConfiguredFlight;
use super::downlink_forecast::StartMomentum;
use crate::plant::settings::error::PlantError;

/// Momentum and dumps of a flight in an attitude that is followed ideally.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct IdealFlight {
    /// Momentum and velocity change so far.
    pub integrator: MomentumIntegrator,
    /// Time between dumps.
    pub spacing: DumpSpacing,
    /// Velocity change of the last dump, EME2000, in m/s.
    pub dump_delta_v_inertial_m_s: Vector3<f64>,
}

impl IdealFlight {
    /// From `time_s` on with these totals.
    pub(super) fn new(time_s: f64, totals: Totals) -> Self {
        Self {
            integrator: MomentumIntegrator::new(time_s, totals),
            spacing: DumpSpacing::default(),
            dump_delta_v_inertial_m_s: Vector3::zeros(),
        }
    }

    /// Whether a simulation can produce it.
    pub(super) fn is_valid(&self) -> bool {
        self.integrator.is_valid() && self.spacing.is_valid()
    }

    /// At the start of a flight, where the system has this momentum, body frame, in N m s.
    pub(super) fn begin(
        spacecraft: &mut ConfiguredFlight<'_>,
        time_s: f64,
        momentum_body_n_m_s: Vector3<f64>,
    ) -> Result<Self, PlantError> {
        spacecraft.world.begin_work(spacecraft.given.work_limit);
        let frame = spacecraft.plant().instant(time_s).frame;
        let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
        spacecraft.choose_sun_place(time_s, &totals, StartMomentum::Body(momentum_body_n_m_s), true)?;
        spacecraft.world.begin_work(spacecraft.given.work_limit);
        let mut plant = spacecraft.plant();
        plant.prepare(time_s, time_s)?;
        let frame = plant.instant(time_s).frame;
        let mut begun = Self::new(time_s, Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body));
        begun.advance(spacecraft, time_s)?;
        Ok(begun)
    }

    /// Dumps to this momentum, body frame, in N m s, at `time_s` on request.
    pub(super) fn dump_to(
        &mut self,
        spacecraft: &mut ConfiguredFlight<'_>,
        time_s: f64,
        target_body_n_m_s: Vector3<f64>,
    ) {
        let settings = spacecraft.world.configuration.momentum;
        let event = self.integrator.dump_to(&mut spacecraft.plant(), &settings, time_s, target_body_n_m_s);
        self.dumped(spacecraft, &event);
    }

    /// Advances until the momentum is known at `time_s`.
    pub(super) fn advance(
        &mut self,
        spacecraft: &mut ConfiguredFlight<'_>,
        time_s: f64,
    ) -> Result<(), PlantError> {
        let settings = spacecraft.world.configuration.momentum;
        let mut dumped_s = None;
        spacecraft.world.begin_work(spacecraft.given.work_limit);
        loop {
            let stop =
                self.integrator.advance_to_stop(&mut spacecraft.plant(), &settings, time_s, dumped_s)?;
            let at_s = match stop {
                Stop::Reached => return Ok(()),
                Stop::Choice { at_s } => at_s,
                Stop::Dump(event) => {
                    self.dumped(spacecraft, &event);
                    dumped_s = Some(event.time_s);
                    event.time_s
                }
            };
            let totals = self.integrator.totals(at_s);
            let momentum = StartMomentum::of(&totals, settings.convention);
            spacecraft.choose_sun_place(at_s, &totals, momentum, false)?;
        }
    }

    /// Counts a dump; propellant, push and mass properties after it.
    fn dumped(&mut self, spacecraft: &mut ConfiguredFlight<'_>, event: &DumpEvent) {
        self.spacing.dumped(event);
        if !spacecraft.thrusters.settings.thrusters.is_empty() {
            self.push(spacecraft, event);
        }
        (spacecraft.log)(event);
    }

    fn push(&mut self, spacecraft: &mut ConfiguredFlight<'_>, event: &DumpEvent) {
        let time_s = event.time_s;
        let mut plant = spacecraft.plant();
        let instant = plant.instant(time_s);
        let mass = plant.mass_properties(&instant, time_s);
        let push_body_n_s = spacecraft.thrusters.dump_at_once(event, &mass.center_of_mass_body_m);
        let Some(push_body_n_s) = push_body_n_s else {
            self.dump_delta_v_inertial_m_s = Vector3::zeros();
            return;
        };
        let delta_v_inertial_m_s = instant.frame.inertial_from_body * push_body_n_s / mass.mass_kg;
        self.dump_delta_v_inertial_m_s = delta_v_inertial_m_s;
        self.integrator.push(&delta_v_inertial_m_s);
        let loaded = spacecraft.world.configuration.loaded();
        spacecraft.world.mass_at_zero = spacecraft.thrusters.left(&loaded, time_s).unwrap_or(loaded);
        spacecraft.propagator.cut_with_jump(
            &spacecraft.world.configuration,
            time_s,
            true,
            &delta_v_inertial_m_s,
        );
    }
}
