//! Flight in an attitude that is followed ideally: momentum, and dumps whose thrusters take propellant and push at once.
//!
//! Equations: t = S dH by the thrusters' selection S; dv = sum F t / m; du = sum q t from each tank, nominal thrust and no
//! shortest pulse. Centre of mass and inertia are those of what is left from there on. Where no thrusters give torque all ways
//! about the centre of mass a dump is as one of a spacecraft without thrusters.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::momentum::{DumpEvent, MomentumIntegrator, Stop, TorqueModel, Totals};
use crate::numerics::chebyshev::GREATEST_IN_STATE;

use super::current::Flight;
use super::outlook::StartMomentum;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::reaction_control_settings::ReactionControlSettings;
use crate::plant::settings::work::Work;

/// What the last dump left beside its impulse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DumpSideEffect {
    /// Velocity change, EME2000, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
    /// How many dumps so far found no thrusters that give their torque: they take no propellant and push nothing.
    pub unserved: u32,
}

impl DumpSideEffect {
    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        self.delta_v_inertial_m_s.iter().all(|x| x.abs() <= GREATEST_IN_STATE)
    }
}

/// Momentum and dumps of a flight in an attitude that is followed ideally.
pub struct IdealFlight<'f, 'c> {
    /// What flies, where.
    pub flight: Flight<'f>,
    /// Momentum so far.
    pub integrator: &'c mut MomentumIntegrator,
    /// Thrusters and tanks.
    pub thrusters: &'c ReactionControlSettings,
    /// What the last dump left beside its impulse.
    pub side_effect: &'c mut DumpSideEffect,
    /// Units of about a microsecond that a step may take.
    pub work_limit: u32,
}

impl IdealFlight<'_, '_> {
    /// Makes the flight ready at its start, where the system has this momentum, body frame, in N m s; everything there.
    ///
    /// # Errors
    /// What ends the flight.
    pub fn begin(
        &mut self,
        time_s: f64,
        momentum_body_n_m_s: Vector3<f64>,
    ) -> Result<Evaluation, PlantError> {
        let mut plant = self.flight.as_configured(self.work_limit);
        let frame = plant.instant(time_s).frame;
        let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
        let given = StartMomentum::Body(momentum_body_n_m_s);
        let mut work = self.flight.begin_work(self.work_limit);
        self.flight.choose_sun_place(time_s, &totals, given, true, &mut work)?;
        let mut plant = self.flight.as_configured(self.work_limit);
        plant.prepare(time_s, time_s)?;
        Ok(plant.evaluate(time_s))
    }

    /// Everything at `time_s`, where the flight has come.
    pub fn evaluate(&mut self, time_s: f64) -> Evaluation {
        self.flight.as_configured(self.work_limit).evaluate(time_s)
    }

    /// Dumps to this momentum, body frame, in N m s, at `time_s` on request.
    pub fn dump_to(&mut self, time_s: f64, target_body_n_m_s: Vector3<f64>) -> DumpEvent {
        let settings = self.flight.configuration.momentum;
        let mut plant = self.flight.as_configured(self.work_limit);
        let event = self.integrator.dump_to(&mut plant, &settings, time_s, target_body_n_m_s);
        self.book(&event);
        event
    }

    /// Advances until the momentum is known at `time_s`.
    ///
    /// # Errors
    /// What ends the flight.
    pub fn advance(&mut self, time_s: f64, mut report: impl FnMut(&DumpEvent)) -> Result<(), PlantError> {
        let settings = self.flight.configuration.momentum;
        let mut dumped_s = None;
        let mut work = self.flight.begin_work(self.work_limit);
        loop {
            let mut plant = self.flight.after(work);
            let stop = self.integrator.advance_to_stop(&mut plant, &settings, time_s, dumped_s)?;
            match stop {
                Stop::Reached => return Ok(()),
                Stop::Choice { at_s } => {
                    work = plant.work(at_s)?;
                    self.choose(at_s, &mut work)?;
                }
                Stop::Dump(event) => {
                    work = plant.work(event.time_s)?;
                    self.book(&event);
                    report(&event);
                    dumped_s = Some(event.time_s);
                    self.choose(event.time_s, &mut work)?;
                }
            }
        }
    }

    /// The Sun's place, where it is due.
    fn choose(&mut self, time_s: f64, work: &mut Work) -> Result<(), PlantError> {
        let totals = self.integrator.totals(time_s);
        let momentum = StartMomentum::of(&totals, self.flight.configuration.momentum.convention);
        self.flight.choose_sun_place(time_s, &totals, momentum, false, work)
    }

    /// Propellant, push and mass properties after a dump.
    fn book(&mut self, event: &DumpEvent) {
        let Self { flight, integrator, thrusters, side_effect, work_limit } = self;
        if thrusters.thrusters.is_empty() {
            return;
        }
        let time_s = event.time_s;
        let mut plant = flight.as_configured(*work_limit);
        let sample = plant.sample(time_s);
        let instant = plant.instant(time_s);
        let mass = plant.mass_properties(&instant, time_s);
        let Ok(selection) = thrusters.dump_selection(&mass.center_of_mass_body_m) else {
            side_effect.delta_v_inertial_m_s = Vector3::zeros();
            side_effect.unserved = side_effect.unserved.saturating_add(1);
            return;
        };
        let mut push_body_n_s = Vector3::zeros();
        let on_times = selection.on_times_s(&event.impulse_body_n_m_s());
        for (thruster, full_s) in thrusters.thrusters.iter().zip(on_times) {
            push_body_n_s += thruster.force_body_n * full_s;
            if let Some(tank) = thrusters.tanks.get(thruster.tank) {
                flight.propellant.take(thruster.tank, tank, thruster.flow_kg_s * full_s);
            }
        }
        let delta_v_inertial_m_s = sample.inertial_from_body * push_body_n_s / mass.mass_kg;
        side_effect.delta_v_inertial_m_s = delta_v_inertial_m_s;
        integrator.push(&delta_v_inertial_m_s);
        let loaded = flight.configuration.loaded();
        let left = flight.propellant.mass_properties(&loaded, &thrusters.tanks, time_s);
        flight.configuration.left = Some(left);
        flight.propagator.cut_with_jump(flight.configuration, time_s, &delta_v_inertial_m_s);
    }
}
