//! A flight in one step by its mode: its evaluation and report, and those of one that waits.

use crate::guidance::DownlinkStatus;
use crate::loads::ForceTorque;
use crate::momentum::Totals;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::settings::attitude_source::Command;
use crate::plant::settings::mode_settings::IdealSettings;
use crate::plant::state::flight_state::EncounterPrediction;
use crate::plant::state::ideal_state::IdealState;

use super::configured::ConfiguredFlight;
use super::dynamic::Dynamic;
use super::ideal::Ideal;
use super::report::{FlightSummary, ReachedState, Report};
use super::simulated::Simulated;

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
    Ideal(Ideal<'f>, &'f IdealSettings),
    /// The body turns by torque.
    Dynamic(Dynamic<'f>),
}

impl<'f> InFlight<'f> {
    /// The flight that is simulated; `None` where it waits.
    pub(super) fn simulated(&mut self) -> Option<&mut dyn Simulated<'f>> {
        match self {
            Self::Waiting { .. } => None,
            Self::Ideal(it, _) => Some(it),
            Self::Dynamic(it) => Some(it),
        }
    }

    /// Evaluates geometry and attitude at `time_s`, where the flight has come, and `with_loads` its loads; a flight that waits holds the
    /// attitude of `held`.
    pub(super) fn evaluate(
        &mut self,
        held: &Command,
        Evaluated { evaluation, applied }: &mut Evaluated,
        with_loads: bool,
        time_s: f64,
    ) -> ReachedState {
        *applied = None;
        if let Self::Waiting { flight, .. } = self {
            let mass = *flight.current_mass_panels_stowed;
            *evaluation = Some(Evaluation::without_position(held.frame_at(time_s), mass, time_s));
        }
        let Some(simulated) = self.simulated() else {
            return ReachedState { totals_are_finite: true, is_degenerate: false };
        };
        let evaluation = evaluation.insert(simulated.frame(time_s));
        let [outside, _] = (simulated.flight().given.external)(time_s);
        match with_loads {
            true => simulated.rows(evaluation, outside),
            false => *applied = Some(outside),
        }
        ReachedState {
            totals_are_finite: simulated.totals(time_s).is_finite(),
            is_degenerate: evaluation.instant.law.degenerate,
        }
    }

    /// Computes the loads where the flight was evaluated, if that was without them.
    pub(super) fn write_loads(&mut self, Evaluated { evaluation, applied }: &mut Evaluated) {
        if let (Some(it), Some(evaluation), Some(applied)) =
            (self.simulated(), evaluation.as_mut(), applied.take())
        {
            it.rows(evaluation, applied);
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
        let mut downlink = DownlinkStatus::from_attitude(&evaluation.instant.law);
        let is_waiting = matches!(self, Self::Waiting { .. });
        let (summary, flight) = match self {
            Self::Dynamic(mut it) => {
                let at = it.at(time_s);
                let Dynamic { state, settings, flight, .. } = it;
                downlink = state.control.downlink;
                (FlightSummary::dynamic(state, settings, flight.thrusters, evaluation, at), flight)
            }
            Self::Ideal(Ideal { state, flight, .. }, settings) => {
                let integrator = Some(&state.integrator);
                (FlightSummary::ideal(state, settings, integrator, evaluation, flight.given.inputs), flight)
            }
            Self::Waiting { settings, flight } => {
                let bias_body_n_m_s = flight.configuration.momentum.policy.bias_body_n_m_s;
                let momentum_body_n_m_s = bias_body_n_m_s + settings.start_momentum_body_n_m_s;
                let attitude = held.attitude_at(time_s);
                let totals = Totals::at_start(momentum_body_n_m_s, &attitude.inertial_from_body());
                let waiting = IdealState::new(time_s, &attitude, totals);
                (FlightSummary::ideal(&waiting, settings, None, evaluation, flight.given.inputs), flight)
            }
        };
        let ConfiguredFlight { given, configuration, allocator, propagator, thrusters, .. } = flight;
        let followed = configuration.timeline.filter(|_| configuration.attitude.guided().is_some());
        let timeline = given.prepared.timeline.zip(followed);
        let slot = timeline.map(|(law, settings)| law.timeline.slot(time_s, settings.clock_minus_time_s));
        Report {
            time_s,
            configuration,
            reaction_control: &allocator.settings,
            propagator,
            thrusters,
            since_periapsis_s: match is_waiting {
                true => 0.0,
                false => propagator.trajectory.time_since_periapsis_s(configuration, time_s),
            },
            downlink,
            timeline_row: slot.map_or(0, |slot| slot.row),
            timeline_until_s: slot.map(|slot| slot.until_s).filter(|until_s| until_s.is_finite()),
            evaluation,
            prediction,
            summary,
        }
    }
}
