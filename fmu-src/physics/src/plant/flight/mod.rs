//! The spacecraft in simulation: context, thrusters, state and mode (attitude followed ideally, or by dynamics) in one.
//!
//! Parameters and inputs are no state: a restored flight is configured anew before it advances.

pub(super) mod configured;
mod dynamic;
mod encounter_prediction;
pub(super) mod fork;
mod grid_edge;
mod ideal;
mod in_flight;
mod reached;
pub(super) mod report;
mod simulated;
mod survey;

pub use survey::{Occultation, survey};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize, Serializer};

use crate::attitude::control::Estimate;
use crate::loads::ForceTorque;
use crate::numerics::Span;
use crate::plant::control::wheel_control::WheelDistribution;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::disturbances::simulation_context::SimulationContext;
use crate::plant::events::{EventKind, Eventful};
use crate::plant::motion::command_slews::CommandSlews;
use crate::plant::settings::attitude_source::{Command, Turning};
use crate::plant::settings::configuration::{Configuration, PredictionSettings};
use crate::plant::settings::dynamics_settings::DynamicsInputs;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::mode_settings::ModeSettings;
use crate::plant::settings::panel_setting::PanelSetting;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::state::disturbance_interval::DisturbanceInterval;
use crate::plant::state::flight_state::{EncounterPrediction, FlightState, Mode};
use crate::plant::state::propagator_state::{PropagatorState, SunDirectionSelection};
use crate::plant::thrusters::reaction_control::Thrusters;
use crate::spacecraft::Spacecraft;
use configured::{ConfiguredFlight, StepContext};
use dynamic::Dynamic;
use encounter_prediction::predict_encounter;
use ideal::Ideal;
use in_flight::{Evaluated, InFlight};
use reached::Reached;
use report::{ReachedState, Report};
use simulated::Simulated as _;

/// A flight: its state, and apart from it settings and caches, which are not saved.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "FlightState")]
pub struct Flight {
    state: FlightState,
    setup: Option<Box<FlightSetup>>,
}

/// Configuration, settings and caches of a flight, none of them saved.
#[derive(Clone, Debug)]
struct FlightSetup {
    context: SimulationContext,
    settings: ModeSettings,
    distribution: WheelDistribution,
    evaluated: Evaluated,
}

impl From<FlightState> for Flight {
    fn from(state: FlightState) -> Self {
        Self { state, setup: None }
    }
}

impl Serialize for Flight {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.state.serialize(serializer)
    }
}

impl Flight {
    /// Flight that waits for its inputs.
    pub fn waiting(thrusters: Thrusters) -> Self {
        let propagator = PropagatorState::default();
        FlightState { propagator, thrusters, mode: Mode::Waiting, prediction: None }.into()
    }

    /// Rejects decoded states that no flight of this spacecraft can produce.
    pub fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        self.state.is_valid(spacecraft)
    }

    /// Names a part of the flight that was not computed at `time_s`, if any.
    pub fn first_uncovered(&self, time_s: f64) -> Option<&'static str> {
        self.state.first_uncovered(time_s)
    }

    /// The configuration that is simulated.
    pub fn configuration(&self) -> Option<&Configuration> {
        self.setup.as_ref().map(|setup| &setup.context.configuration)
    }

    /// Geometry, attitude and loads at the last report; `None` before any.
    pub fn evaluation(&self) -> Option<&Evaluation> {
        self.setup.as_ref()?.evaluated.evaluation.as_ref().filter(|_| !self.is_waiting())
    }

    /// Whether it waits.
    pub fn is_waiting(&self) -> bool {
        matches!(self.state.mode, Mode::Waiting)
    }

    /// The estimate of the attitude at `time_s`, where sensors sample it.
    pub fn estimate_at(&self, time_s: f64) -> Option<Estimate> {
        let Mode::Dynamic(dynamics) = &self.state.mode else { return None };
        Some(dynamics.sensing.estimate_at(time_s))
    }

    /// The torque with `others_body_n_m` of everything else, in N m, where a dump is a constant torque.
    pub fn with_dump_body_n_m(&self, others_body_n_m: &Vector3<f64>) -> Vector3<f64> {
        let Mode::Dynamic(dynamics) = &self.state.mode else { return *others_body_n_m };
        others_body_n_m + dynamics.dumps.torque_body_n_m()
    }

    /// Thrusters and tanks.
    pub fn thrusters(&self) -> &Thrusters {
        &self.state.thrusters
    }

    /// Direction of the Sun during downlinks.
    pub fn sun_choice(&self) -> &SunDirectionSelection {
        &self.state.propagator.sun_choice
    }

    /// Takes what parameters and inputs set.
    pub fn configure(&mut self, context: SimulationContext, settings: ModeSettings) {
        self.setup = Some(Box::new(FlightSetup {
            context,
            settings,
            distribution: Default::default(),
            evaluated: Default::default(),
        }));
        self.update_current_mass();
    }

    /// Configuration, environment and caches; `None` before the first configuration.
    pub fn context(&self) -> Option<&SimulationContext> {
        self.setup.as_ref().map(|setup| &setup.context)
    }

    /// Configuration, environment and caches, to be changed; `None` before the first configuration.
    pub fn context_mut(&mut self) -> Option<&mut SimulationContext> {
        self.setup.as_mut().map(|setup| &mut setup.context)
    }

    /// Takes the memory of the panels' settings for the next configuration.
    pub fn extract_panels(&mut self) -> Vec<PanelSetting> {
        self.setup.as_mut().map_or_else(Vec::new, |it| core::mem::take(&mut it.context.configuration.panels))
    }

    /// In flight that is followed ideally nothing flows between dumps.
    fn update_current_mass(&mut self) {
        if let Some(FlightSetup { context, .. }) = self.setup.as_deref_mut() {
            let loaded = self.state.propagator.center_of_mass.mass_properties(&context.configuration);
            let propellant = &self.state.thrusters.propellant;
            let tanks = &context.allocator.settings.tanks;
            context.current_mass_panels_stowed = propellant.mass_properties(&loaded, tanks, 0.0);
        }
    }

    /// Something changes at `time_s`: what was computed beyond it is void, and from there on these configuration and settings count.
    /// Loads are cut where the digest of the models is not the one that they were computed for.
    ///
    /// # Errors
    /// A flight that was never configured.
    pub fn apply(
        &mut self,
        configuration: Option<Configuration>,
        settings: Option<ModeSettings>,
        time_s: f64,
    ) -> Result<(), PlantError> {
        let Some(setup) = self.setup.as_deref_mut() else { return Err(PlantError::OtherMode) };
        let so_far = &setup.context.configuration;
        match &mut self.state.mode {
            Mode::Waiting => {}
            Mode::Ideal(ideal) => {
                ideal.integrator.cut(time_s);
                self.state.propagator.cut_with_jump(so_far, time_s, &Vector3::zeros());
            }
            Mode::Dynamic(dynamics) => {
                let DisturbanceInterval { span, made_for, .. } = &dynamics.disturbance;
                let loads_change = span.is_before() || *made_for != setup.context.models.digest;
                dynamics.cut(time_s);
                self.state.propagator.command_slews.cut(time_s);
                if loads_change {
                    dynamics.disturbance.span.cut(time_s);
                    self.state.propagator.cut(so_far, time_s);
                }
            }
        }
        if let Some(configuration) = configuration {
            setup.context.configuration = configuration;
            self.state.propagator.center_of_mass.reconfigured(&setup.context.configuration);
        }
        if let Some(settings) = settings {
            setup.settings = settings;
        }
        self.update_current_mass();
        Ok(())
    }

    /// Position and velocity are given at `time_s`, as the configuration has them.
    ///
    /// # Errors
    /// A place below the surface.
    pub fn move_to(&mut self, time_s: f64) -> Result<(), PlantError> {
        let setup = self.setup.as_deref().ok_or(PlantError::OtherMode)?;
        self.state.propagator.move_to(&setup.context.configuration, time_s)
    }

    /// Returns the body before the Sun's disc where the flight was evaluated; `quiet_until_s` becomes the time of the next look.
    pub fn occultation(&mut self, time_s: f64, quiet_until_s: &mut Option<f64>) -> Option<Occultation> {
        let FlightSetup { context, evaluated, .. } = self.setup.as_deref_mut()?;
        survey::occultation(context, &evaluated.evaluation.as_ref()?.instant.geometry, time_s, quiet_until_s)
    }

    /// Replaces the schedule from `time_s` on: earlier events are past, and the Sun's direction in a downlink is selected anew.
    pub fn reschedule(&mut self, time_s: f64) {
        match &mut self.state.mode {
            Mode::Waiting => {}
            Mode::Ideal(ideal) => ideal.last.of_kind(EventKind::Schedule).skip_to(time_s),
            Mode::Dynamic(dynamics) => dynamics.last.of_kind(EventKind::Schedule).skip_to(time_s),
        }
        self.state.propagator.sun_choice.row = 0;
        self.state.propagator.command_slews = CommandSlews::beginning(time_s);
    }

    /// The flight in one step, its settings and its mode.
    fn in_flight<'a>(
        &'a mut self,
        given: StepContext<'a>,
    ) -> Result<(InFlight<'a>, &'a mut Evaluated), PlantError> {
        let Self { state: FlightState { propagator, thrusters, mode, .. }, setup: Some(setup) } = self else {
            return Err(PlantError::OtherMode);
        };
        let FlightSetup { context, settings, distribution, evaluated } = &mut **setup;
        let flight = ConfiguredFlight::new(given, context, propagator, thrusters, Turning::still());
        let reached = Reached::default();
        let in_flight = match (mode, settings) {
            (Mode::Waiting, ModeSettings::Ideal(settings)) => InFlight::Waiting { settings, flight },
            (Mode::Ideal(state), ModeSettings::Ideal(settings)) => {
                InFlight::Ideal(Ideal { state, flight, is_fork: false, prepared: None }, settings)
            }
            (Mode::Dynamic(state), ModeSettings::Dynamic(settings)) => {
                InFlight::Dynamic(Dynamic { state, settings, flight, distribution, reached })
            }
            _ => return Err(PlantError::OtherMode),
        };
        Ok((in_flight, evaluated))
    }

    /// Begins at `time_s`, where the attitude was the one of `held`: the quaternion takes the sign nearer to that.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn begin(&mut self, given: StepContext<'_>, held: &Command, time_s: f64) -> Result<(), PlantError> {
        let Self { state: FlightState { propagator, thrusters, mode, .. }, setup: Some(setup) } = self else {
            return Err(PlantError::OtherMode);
        };
        let FlightSetup { context, settings, .. } = &mut **setup;
        *propagator = PropagatorState::new(&context.configuration, time_s)?;
        let turning = Turning::from(*held);
        let mut flight = ConfiguredFlight::new(given, context, propagator, thrusters, turning);
        let held = held.attitude_at(time_s);
        *mode = match settings {
            ModeSettings::Ideal(settings) => {
                Mode::Ideal(Box::new(Ideal::begin(settings, flight, time_s, &held)?))
            }
            ModeSettings::Dynamic(settings) => {
                Mode::Dynamic(Box::new(grid_edge::begin(settings, &mut flight, time_s, &held)?))
            }
        };
        Ok(())
    }

    /// Advances until everything is known at the end of the step; predictions due at its start are its own, at its end the next's.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn advance(&mut self, given: StepContext<'_>, step: Span) -> Result<(), PlantError> {
        let predicted = self.prediction_settings();
        if let Some(simulated) = self.in_flight(given)?.0.simulated() {
            simulated.flight().models.begin_work(given.work_limit);
            simulated.apply_requests(step)?;
        }
        for time_s in predicted.times_s(step) {
            self.advance_to(given, time_s)?;
            self.predict(given, time_s)?;
        }
        self.advance_to(given, step.end_s)
    }

    fn advance_to(&mut self, given: StepContext<'_>, time_s: f64) -> Result<(), PlantError> {
        self.in_flight(given)?.0.simulated().map_or(Ok(()), |simulated| simulated.advance_to(time_s))
    }

    fn prediction_settings(&self) -> PredictionSettings {
        let encounter = self.configuration().and_then(|it| it.encounter);
        encounter.filter(|_| !self.is_waiting()).map_or(PredictionSettings::NEVER, |it| it.prediction)
    }

    /// Predicts the encounter at `time_s`, where the flight has come, in the attitude that timeline and inputs command.
    fn predict(&mut self, given: StepContext<'_>, time_s: f64) -> Result<(), PlantError> {
        let (mut in_flight, _) = self.in_flight(given)?;
        let Some(simulated) = in_flight.simulated() else { return Ok(()) };
        let attitude = simulated.fork_attitude(time_s);
        self.state.prediction = Some(predict_encounter(simulated.flight(), attitude, time_s)?);
        Ok(())
    }

    /// Takes the samples at the start with these inputs, to be reported there, and returns how to undo them: the first step takes them
    /// with its own inputs.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn sample_at_start(&mut self, given: StepContext<'_>, time_s: f64) -> Result<Undo, PlantError> {
        let undo = Undo(self.state.mode.clone(), self.state.thrusters.clone(), self.state.prediction);
        let given = StepContext { log: &|_| {}, ..given };
        if let (InFlight::Dynamic(mut dynamic), _) = self.in_flight(given)? {
            dynamic.flight.models.begin_work(given.work_limit);
            dynamic.apply_due()?;
            dynamic.complete();
        }
        if self.prediction_settings().is_due(time_s) {
            self.predict(given, time_s)?;
        }
        Ok(undo)
    }

    /// Undoes samples at the start.
    pub fn undo(&mut self, Undo(mode, thrusters, prediction): Undo) {
        (self.state.mode, self.state.thrusters, self.state.prediction) = (mode, thrusters, prediction);
    }

    /// Evaluates geometry and attitude at `time_s`, where the flight has come, and `with_loads` its loads, else [`Self::report`] computes
    /// them. A flight that waits holds the attitude of `held`.
    ///
    /// # Errors
    /// A state that belongs to another mode than the settings.
    pub fn evaluate(
        &mut self,
        given: StepContext<'_>,
        held: &Command,
        with_loads: bool,
        time_s: f64,
    ) -> Result<ReachedState, PlantError> {
        let (mut in_flight, evaluated) = self.in_flight(given)?;
        Ok(in_flight.evaluate(held, evaluated, with_loads, time_s))
    }

    /// Everything at `time_s`, where the flight was evaluated last, with loads and the wheels' torques where they are computed already or
    /// `with_loads`; one that waits has the attitude of `held`.
    ///
    /// # Errors
    /// A state that belongs to another mode than the settings.
    pub fn report<'a>(
        &'a mut self,
        prepared: PreparedSpacecraft<'a>,
        inputs: &'a DynamicsInputs,
        held: &Command,
        with_loads: bool,
        time_s: f64,
    ) -> Result<Report<'a>, PlantError> {
        let prediction = self.state.prediction;
        let (mut in_flight, evaluated) = self.in_flight(StepContext::at_rest(prepared, inputs))?;
        if with_loads {
            in_flight.write_loads(evaluated);
        }
        let evaluation = evaluated.evaluation.as_ref().ok_or(PlantError::OtherMode)?;
        Ok(in_flight.report(held, evaluation, prediction, time_s))
    }

    /// Reports temperature in K and force in N, body frame, of every face of the light model at `time_s`, in its order.
    ///
    /// # Errors
    /// A geometry without meaning.
    pub fn faces(
        &mut self,
        prepared: PreparedSpacecraft<'_>,
        time_s: f64,
        report: impl FnMut(f64, Vector3<f64>),
    ) -> Result<(), PlantError> {
        let FlightSetup { context, .. } = self.setup.as_deref_mut().ok_or(PlantError::OtherMode)?;
        let (propagator, still) = (&mut self.state.propagator, Turning::still());
        context.plant(prepared, still, propagator, &|_| [ForceTorque::zero(); 2]).faces(time_s, report)
    }
}

/// A flight before samples at its start.
pub struct Undo(Mode, Thrusters, Option<EncounterPrediction>);
