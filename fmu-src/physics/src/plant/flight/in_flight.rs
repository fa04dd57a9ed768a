//! A flight in one step by its mode, with the settings of that: what both ways of flight and one that waits do alike.

use crate::attitude::MotionAt;
use crate::attitude::control::{sample_number, sensed_sun};
use crate::loads::ForceTorque;
use crate::momentum::Totals;
use crate::numerics::Span;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::events;
use crate::plant::motion::instant::Instant;
use crate::plant::settings::attitude_source::Command;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::mode_settings::IdealSettings;
use crate::plant::state::flight_state::EncounterPrediction;
use crate::plant::state::ideal_state::IdealState;
use crate::radiation::SolarModel;

use super::configured::ConfiguredFlight;
use super::dynamic::Dynamic;
use super::ideal::Ideal;
use super::report::{ReachedState, Report, dynamic, dynamic_totals, ideal};

/// The last evaluation, kept in memory because it is large.
#[derive(Clone, Debug, Default)]
pub(super) struct Evaluated {
    pub evaluation: Option<Evaluation>,
    /// Load from outside, where the loads are not computed yet.
    pub applied: Option<ForceTorque>,
}

/// A flight in one step.
pub(super) enum InFlight<'f> {
    /// The attitude is held, and nothing acts.
    Waiting { settings: &'f IdealSettings, flight: ConfiguredFlight<'f> },
    /// The attitude is followed ideally.
    Ideal(Ideal<'f>),
    /// The body turns by torque.
    Dynamic(Dynamic<'f>),
}

impl<'f> InFlight<'f> {
    /// The flight that advances.
    pub(super) fn flight(&mut self) -> &mut ConfiguredFlight<'f> {
        match self {
            Self::Waiting { flight, .. } => flight,
            Self::Ideal(it) => &mut it.flight,
            Self::Dynamic(it) => &mut it.flight,
        }
    }

    /// Applies the requests of a step.
    pub(super) fn apply_requests(&mut self, step: Span) -> Result<(), PlantError> {
        match self {
            Self::Waiting { .. } => Ok(()),
            Self::Ideal(it) => it.apply_requests(step.start_s),
            Self::Dynamic(it) => it.apply_requests(step),
        }
    }

    /// Advances until everything is known at `time_s`.
    pub(super) fn advance(&mut self, time_s: f64) -> Result<(), PlantError> {
        match self {
            Self::Waiting { .. } => Ok(()),
            Self::Ideal(it) => events::advance(it, time_s),
            Self::Dynamic(it) => {
                it.resume();
                let advanced = events::advance(it, time_s);
                it.complete_sample();
                advanced
            }
        }
    }

    /// Evaluates geometry and attitude at `time_s`, where the flight has come, and its loads, of an attitude that is followed ideally only
    /// `with_loads`; a flight that waits holds the attitude of `held`.
    pub(super) fn evaluate(
        &mut self,
        held: &Command,
        evaluated: &mut Evaluated,
        with_loads: bool,
        time_s: f64,
    ) -> ReachedState {
        let Evaluated { evaluation, applied } = evaluated;
        *applied = None;
        match self {
            Self::Dynamic(it) => {
                it.resume();
                let at: MotionAt = it.state.motion.evaluated_at(&it.settings.gyrostat, time_s);
                *evaluation = Some(it.evaluation(&at));
                ReachedState {
                    totals_are_finite: dynamic_totals(&at).is_finite(),
                    is_degenerate: it.state.control.is_degenerate,
                }
            }
            Self::Ideal(Ideal { state, flight, .. }) => {
                let mut plant = flight.plant();
                let evaluation = evaluation.insert(plant.evaluate_without_loads(time_s));
                let [outside, _] = (plant.external)(time_s);
                match with_loads {
                    true => plant.write_loads(evaluation, outside),
                    false => *applied = Some(outside),
                }
                ReachedState {
                    totals_are_finite: state.integrator.totals(time_s).is_finite(),
                    is_degenerate: evaluation.instant.is_degenerate,
                }
            }
            Self::Waiting { flight, .. } => {
                let mass = flight.context.current_mass_panels_stowed;
                let evaluated = Evaluation::without_position(held.frame_at(time_s), mass, time_s);
                let evaluation = evaluation.insert(evaluated);
                ReachedState { totals_are_finite: true, is_degenerate: evaluation.instant.is_degenerate }
            }
        }
    }

    /// Computes the loads where the flight was evaluated, if that was without them.
    pub(super) fn write_loads(&mut self, Evaluated { evaluation, applied }: &mut Evaluated) {
        if let Some((evaluation, outside)) = evaluation.as_mut().zip(applied.take()) {
            self.flight().plant().write_loads(evaluation, outside);
        }
    }

    /// Everything at `time_s`, where the flight was evaluated; one that waits has the attitude of `held`, and the momentum of its start.
    pub(super) fn report(
        self,
        held: &Command,
        evaluation: &'f Evaluation,
        prediction: Option<EncounterPrediction>,
        time_s: f64,
    ) -> Report<'f> {
        let is_waiting = matches!(self, Self::Waiting { .. });
        let mut sampled = None;
        let (summary, flight) = match self {
            Self::Dynamic(Dynamic { state, settings, flight, .. }) => {
                sampled = Some((state.control.downlink, state.control.is_degenerate));
                let at: MotionAt = state.motion.evaluated_at(&settings.gyrostat, time_s);
                (dynamic(state, settings, flight.thrusters, evaluation, at), flight)
            }
            Self::Ideal(Ideal { state, settings, flight, .. }) => {
                let inputs = flight.given.inputs;
                let integrator = Some(&state.integrator);
                let mut summary = ideal(state, settings, integrator, evaluation, inputs);
                let Instant { sun_body, lit_fraction, .. } = &evaluation.instant;
                summary.sun_sensed_body = sensed_sun(
                    &settings.sun_sensors,
                    |k| inputs.sun_sensor_failed.get(k).is_some_and(|failed| *failed),
                    sun_body,
                    *lit_fraction,
                    (settings.seed, sample_number(time_s, settings.rate_hz)),
                );
                (summary, flight)
            }
            Self::Waiting { settings, flight } => {
                let (frame, attitude) = (held.frame_at(time_s), held.attitude_at(time_s));
                let bias_body_n_m_s = flight.context.configuration.momentum.policy.bias_body_n_m_s;
                let momentum_body_n_m_s = bias_body_n_m_s + settings.start_momentum_body_n_m_s;
                let totals = Totals::at_start(momentum_body_n_m_s, &frame.inertial_from_body);
                let waiting = IdealState::new(time_s, &attitude, totals);
                (ideal(&waiting, settings, None, evaluation, flight.given.inputs), flight)
            }
        };
        let ConfiguredFlight { given, context, propagator, thrusters, .. } = flight;
        let (configuration, trajectory) = (&context.configuration, &propagator.trajectory);
        let Instant { downlink, is_degenerate, .. } = evaluation.instant;
        let (downlink, is_degenerate) = sampled.unwrap_or((downlink, is_degenerate));
        let followed = configuration.timeline.filter(|_| configuration.attitude.guided().is_some());
        let timeline = given.prepared.timeline.zip(followed);
        let slot = timeline.map(|(law, settings)| law.timeline.slot(time_s, settings.clock_minus_time_s));
        Report {
            time_s,
            configuration,
            materials: context.models.solar.as_ref().map_or(&[], SolarModel::materials),
            thrusters,
            reaction_control: &context.allocator.settings,
            since_periapsis_s: match is_waiting {
                true => 0.0,
                false => trajectory.time_since_periapsis_s(configuration, time_s),
            },
            downlink,
            is_degenerate,
            timeline_row: slot.map_or(0, |slot| slot.row),
            timeline_until_s: slot.map(|slot| slot.until_s).filter(|until_s| until_s.is_finite()),
            target_is_clamped: propagator.sun_choice.is_clamped(),
            evaluation,
            integration_center: trajectory.integration_center(configuration),
            from_integration_center: trajectory.state_from_integration_center(time_s),
            approaches: trajectory.approaches.until(time_s),
            panel_turns: &propagator.panel_turns,
            prediction,
            summary,
        }
    }
}
