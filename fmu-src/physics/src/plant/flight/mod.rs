//! The spacecraft in simulation: context, thrusters, state and mode (attitude followed ideally, or by dynamics) in one.
//!
//! Parameters and inputs are no state: a restored flight is configured anew before it advances.

mod configured;
mod control_loop;
mod dynamic;
mod encounter_prediction;
mod fork;
mod momentum_dumps;
mod sensing;
mod survey;

pub(super) mod downlink_forecast;
pub(super) mod ideal;
pub(super) mod report;
pub(super) mod wheel_control;

pub use configured::StepContext;
pub use encounter_prediction::{EncounterPrediction, PredictedArrival};
pub use fork::ForecastMomentum;
pub use survey::Occultation;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::control::{Estimate, sample_number, sensed_sun};
use crate::momentum::Totals;

use crate::loads::ForceTorque;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::disturbances::plant::Plant;
use crate::plant::disturbances::simulation_context::SimulationContext;
use crate::plant::motion::command_slews::CommandSlews;
use crate::plant::motion::instant::Instant;
use crate::plant::settings::configuration::{Command, Configuration, PredictionSettings};
use crate::plant::settings::dynamics_settings::{DynamicsInputs, DynamicsSettings};
use crate::plant::settings::error::PlantError;
use crate::plant::settings::ideal_settings::IdealSettings;
use crate::plant::settings::panel_setting::PanelSetting;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::settings::thruster_events::ThrusterEvent;
use crate::plant::state::propagator_state::PropagatorState;
use crate::plant::state::sun_choice::SunDirectionSelection;
use crate::plant::thrusters::reaction_control::Thrusters;
use crate::radiation::SolarModel;
use crate::spacecraft::Spacecraft;
use configured::ConfiguredFlight;
use dynamic::{AttitudeDynamics, DynamicStep};
use ideal::IdealFlight;
use report::{Report, dynamic, ideal};

/// A flight.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Flight {
    propagator: PropagatorState,
    /// Thrusters and tanks.
    pub thrusters: Thrusters,
    mode: Mode,
    /// The last prediction of the encounter; none before any.
    prediction: Option<EncounterPrediction>,
    #[serde(skip)]
    setup: Option<Box<FlightSetup>>,
}

/// How the attitude comes about.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum Mode {
    /// Flight that waits for its inputs: no loads, the attitude held.
    Waiting,
    Ideal(Box<IdealFlight>),
    Dynamic(Box<AttitudeDynamics>),
}

/// Configuration, settings and caches, none of them saved.
#[derive(Clone, Debug)]
struct FlightSetup {
    context: SimulationContext,
    settings: ModeSettings,
    /// Geometry, attitude and loads at the last report, kept in place because they are large.
    evaluation: Option<Evaluation>,
}

/// Settings of a mode, next to the configuration.
#[derive(Clone, Debug)]
pub enum ModeSettings {
    /// Settings of a flight whose attitude is followed ideally, and of one that waits.
    Ideal(IdealSettings),
    /// Settings of a flight by torque.
    Dynamic(Box<DynamicsSettings>),
}

/// Groups of parameters and inputs that changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Changes {
    /// Position and velocity were given.
    pub orbit: bool,
    /// Attitude, panels or Sun changed, on which light and heat depend.
    pub light: bool,
    /// Mass, centre of mass or inertia changed.
    pub mass: bool,
    /// The force from outside changed.
    pub force: bool,
    /// Mass, thresholds or target of dumps changed.
    pub tunables: bool,
}

impl Flight {
    /// Flight that waits for its inputs.
    pub fn waiting(thrusters: Thrusters) -> Self {
        Self {
            propagator: PropagatorState::default(),
            thrusters,
            mode: Mode::Waiting,
            prediction: None,
            setup: None,
        }
    }

    /// Rejects decoded states that no flight of this spacecraft can produce.
    pub fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        // Panels without mass have no motion of their own.
        let has_mass = spacecraft.panels.iter().any(|panel| panel.mass.is_some());
        let panels = if has_mass { spacecraft.panels.len() } else { 0 };
        let (wheels, oscillators) = (spacecraft.wheels.len(), spacecraft.oscillator_count());
        self.propagator.is_valid(spacecraft)
            && self.prediction.as_ref().is_none_or(EncounterPrediction::is_valid)
            && self.thrusters.is_valid(spacecraft)
            && match &self.mode {
                Mode::Waiting => true,
                Mode::Ideal(ideal) => ideal.is_valid(),
                Mode::Dynamic(dynamics) => dynamics.is_valid(wheels, oscillators, panels),
            }
    }

    /// Names a part of the flight that was not computed at `time_s`, if any.
    pub fn first_uncovered(&self, time_s: f64) -> Option<&'static str> {
        let PropagatorState { sources, trajectory, air_and_field, .. } = &self.propagator;
        let uncovered = sources.first_uncovered(time_s);
        let (is_covered, what) = match &self.mode {
            _ if uncovered.is_some() => return uncovered,
            _ if !air_and_field.covers(time_s) => (false, "air and magnetic field were computed"),
            _ if !trajectory.covers(time_s) => (false, "the orbit was integrated"),
            Mode::Waiting => (true, ""),
            Mode::Ideal(ideal) => (ideal.integrator.covers(time_s), "the momentum was accumulated"),
            Mode::Dynamic(dynamics) => (dynamics.covers(time_s), "the attitude was computed"),
        };
        (!is_covered).then_some(what)
    }

    /// Whether parameters and inputs have been read since the start or a restore.
    pub fn is_configured(&self) -> bool {
        self.setup.is_some()
    }

    /// The configuration that is simulated.
    pub fn configuration(&self) -> Option<&Configuration> {
        self.setup.as_ref().map(|setup| &setup.context.configuration)
    }

    /// Geometry, attitude and loads at the last report; `None` before any.
    pub fn evaluation(&self) -> Option<&Evaluation> {
        self.setup.as_ref()?.evaluation.as_ref().filter(|_| !self.is_waiting())
    }

    /// Whether it waits.
    pub fn is_waiting(&self) -> bool {
        matches!(self.mode, Mode::Waiting)
    }

    /// The estimate of the attitude at `time_s`, where sensors sample it.
    pub fn estimate_at(&self, time_s: f64) -> Option<Estimate> {
        match &self.mode {
            Mode::Dynamic(dynamics) => Some(dynamics.sensing.estimate_at(time_s)),
            Mode::Waiting | Mode::Ideal(_) => None,
        }
    }

    /// The torque with `others_body_n_m` of everything else, in N m, where a dump is a constant torque.
    pub fn with_dump_body_n_m(&self, others_body_n_m: &Vector3<f64>) -> Vector3<f64> {
        match &self.mode {
            Mode::Dynamic(dynamics) => others_body_n_m + dynamics.dumps.torque_body_n_m(),
            Mode::Waiting | Mode::Ideal(_) => *others_body_n_m,
        }
    }

    /// Direction of the Sun during downlinks.
    pub fn sun_choice(&self) -> &SunDirectionSelection {
        &self.propagator.sun_choice
    }

    /// Takes what parameters and inputs set.
    pub fn configure(&mut self, context: SimulationContext, settings: ModeSettings) {
        self.setup = Some(Box::new(FlightSetup { context, settings, evaluation: None }));
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
            let loaded = self.propagator.center_of_mass.mass_properties(&context.configuration);
            let settings = &context.allocator.settings;
            let current = self.thrusters.mass_properties_stowed(settings, &loaded, 0.0);
            context.current_mass_panels_stowed = current.unwrap_or(loaded);
        }
    }

    /// Something changes at `time_s`: what was computed beyond it is void, and from there on these configuration and settings count.
    ///
    /// # Errors
    /// A place that is given below the surface.
    pub fn apply(
        &mut self,
        changes: Changes,
        configuration: Option<Configuration>,
        settings: Option<ModeSettings>,
        time_s: f64,
    ) -> Result<(), PlantError> {
        let Some(setup) = self.setup.as_deref_mut() else { return Err(PlantError::OtherMode) };
        let so_far = &setup.context.configuration;
        // On a disturbed orbit the mass decides where the spacecraft goes.
        let pushed = changes.force && so_far.motion.has_nongravitational_forces();
        match &mut self.mode {
            Mode::Waiting => {}
            Mode::Ideal(ideal) => {
                ideal.integrator.cut(time_s);
                self.propagator.cut(so_far, time_s, changes.light);
            }
            Mode::Dynamic(dynamics) => {
                let loads_change = changes.light || changes.mass || pushed;
                dynamics.cut(time_s, loads_change);
                self.propagator.command_slews.cut(time_s);
                if loads_change {
                    self.propagator.cut(so_far, time_s, true);
                }
            }
        }
        if let Some(configuration) = configuration {
            setup.context.configuration = configuration;
            self.propagator.center_of_mass.reconfigured(&setup.context.configuration);
        }
        if let Some(settings) = settings {
            setup.settings = settings;
        }
        if changes.orbit {
            self.propagator.move_to(&setup.context.configuration, time_s)?;
        }
        self.update_current_mass();
        Ok(())
    }

    /// Shows how the spacecraft stands at these times by its own guidance, followed ideally on the orbit under the centre's gravity
    /// alone; nothing where something else gives the attitude.
    pub fn survey(
        &self,
        given: StepContext<'_>,
        times_s: impl IntoIterator<Item = f64>,
        see: impl FnMut(&Configuration, f64, &Instant),
    ) {
        if let Some(setup) = self.setup.as_deref() {
            survey::survey(&setup.context, given, times_s, see);
        }
    }

    /// Returns the body before the Sun's disc at `time_s`, where the flight was reported, which its shadow does not know; `quiet_until_s`
    /// becomes the time of the next look.
    pub fn occultation(&mut self, time_s: f64, quiet_until_s: &mut Option<f64>) -> Option<Occultation> {
        let FlightSetup { context, evaluation, .. } = self.setup.as_deref_mut()?;
        survey::occultation(context, &evaluation.as_ref()?.instant.geometry, time_s, quiet_until_s)
    }

    /// Replaces the schedule from `time_s` on: its earlier events are past, the Sun's direction in a downlink is selected anew, and the
    /// body has the attitude of the command in force.
    pub fn reschedule(&mut self, time_s: f64) {
        match &mut self.mode {
            Mode::Waiting => {}
            Mode::Ideal(ideal) => ideal.scheduled.skip_to(time_s),
            Mode::Dynamic(dynamics) => dynamics.scheduled.skip_to(time_s),
        }
        self.propagator.sun_choice.row = 0;
        self.propagator.command_slews = CommandSlews::beginning(time_s);
    }

    /// The flight in one step, its settings and its mode.
    fn parts<'a>(
        &'a mut self,
        given: StepContext<'a>,
        log: &'a mut dyn FnMut(&ThrusterEvent),
    ) -> Result<(ConfiguredFlight<'a>, &'a mut ModeSettings, &'a mut Mode), PlantError> {
        let Self { propagator, thrusters, setup: Some(setup), mode, .. } = self else {
            return Err(PlantError::OtherMode);
        };
        let FlightSetup { context, settings, .. } = &mut **setup;
        Ok((ConfiguredFlight { given, context, propagator, thrusters, log }, settings, mode))
    }

    /// Begins at `time_s`, where the attitude was the one of `held`: the quaternion takes the sign nearer to that.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn begin(
        &mut self,
        given: StepContext<'_>,
        held: &Command,
        time_s: f64,
        log: &mut dyn FnMut(&ThrusterEvent),
    ) -> Result<(), PlantError> {
        let (mut flight, settings, mode) = self.parts(given, log)?;
        *flight.propagator = PropagatorState::new(&flight.context.configuration, time_s)?;
        let held = held.attitude_at(time_s);
        *mode = match settings {
            ModeSettings::Ideal(IdealSettings { start_momentum_body_n_m_s: momentum, .. }) => {
                Mode::Ideal(Box::new(IdealFlight::begin(&mut flight, time_s, &held, *momentum)?))
            }
            ModeSettings::Dynamic(settings) => {
                Mode::Dynamic(Box::new(AttitudeDynamics::begin(settings, &mut flight, time_s, &held)?))
            }
        };
        Ok(())
    }

    /// Advances until everything is known at the end of the step; predictions due at its start are its own, at its end the next's.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn advance(
        &mut self,
        given: StepContext<'_>,
        inputs: &DynamicsInputs,
        [start_s, end_s]: [f64; 2],
        log: &mut dyn FnMut(&ThrusterEvent),
    ) -> Result<(), PlantError> {
        self.apply_requests(given, inputs, [start_s, end_s], log)?;
        for time_s in self.prediction_settings().times_s([start_s, end_s]) {
            self.advance_to(given, inputs, time_s, log)?;
            self.predict(given, inputs, time_s)?;
        }
        self.advance_to(given, inputs, end_s, log)
    }

    /// A step's work begins, and what it requests from its start on is taken.
    fn apply_requests(
        &mut self,
        given: StepContext<'_>,
        inputs: &DynamicsInputs,
        span_s: [f64; 2],
        log: &mut dyn FnMut(&ThrusterEvent),
    ) -> Result<(), PlantError> {
        let (mut flight, settings, mode) = self.parts(given, log)?;
        flight.context.begin_work(given.work_limit);
        match (mode, settings) {
            (Mode::Waiting, _) => Ok(()),
            (Mode::Ideal(ideal), ModeSettings::Ideal(_)) => {
                ideal.apply_requests(&mut flight, inputs, span_s[0])
            }
            (Mode::Dynamic(dynamics), ModeSettings::Dynamic(settings)) => {
                dynamics.apply_requests(&mut DynamicStep { settings, flight: &mut flight, inputs }, span_s)
            }
            _ => Err(PlantError::OtherMode),
        }
    }

    /// Advances until everything is known at `time_s`.
    fn advance_to(
        &mut self,
        given: StepContext<'_>,
        inputs: &DynamicsInputs,
        time_s: f64,
        log: &mut dyn FnMut(&ThrusterEvent),
    ) -> Result<(), PlantError> {
        let (mut flight, settings, mode) = self.parts(given, log)?;
        match (mode, settings) {
            (Mode::Waiting, _) => Ok(()),
            (Mode::Ideal(ideal), ModeSettings::Ideal(_)) => ideal.advance(&mut flight, time_s),
            (Mode::Dynamic(dynamics), ModeSettings::Dynamic(settings)) => {
                dynamics.advance(&mut DynamicStep { settings, flight: &mut flight, inputs }, time_s)
            }
            _ => Err(PlantError::OtherMode),
        }
    }

    fn prediction_settings(&self) -> PredictionSettings {
        let encounter = self.configuration().and_then(|it| it.encounter);
        encounter.filter(|_| !self.is_waiting()).map_or(PredictionSettings::NEVER, |it| it.prediction)
    }

    /// Predicts the encounter at `time_s`, where the flight has come, in the attitude that timeline and inputs command.
    fn predict(
        &mut self,
        given: StepContext<'_>,
        inputs: &DynamicsInputs,
        time_s: f64,
    ) -> Result<(), PlantError> {
        let ignored = &mut |_: &ThrusterEvent| {};
        let (mut flight, settings, mode) = self.parts(given, ignored)?;
        let mut attitude = None;
        if let (Mode::Dynamic(dynamics), ModeSettings::Dynamic(settings)) = (mode, settings) {
            let step = DynamicStep { settings, flight: &mut flight, inputs };
            attitude = Some(dynamics.ideal_attitude(&step, time_s));
        }
        self.prediction = Some(EncounterPrediction::from_flight(&mut flight, attitude, time_s)?);
        Ok(())
    }

    /// Takes the samples at the start with these inputs, to be reported there, and returns how to undo them: the first step takes them
    /// with its own inputs.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn sample_at_start(
        &mut self,
        given: StepContext<'_>,
        inputs: &DynamicsInputs,
        time_s: f64,
    ) -> Result<Undo, PlantError> {
        let undo = Undo(self.mode.clone(), self.thrusters.clone(), self.prediction);
        let ignored = &mut |_: &ThrusterEvent| {};
        let (mut flight, settings, mode) = self.parts(given, ignored)?;
        if let (Mode::Dynamic(dynamics), ModeSettings::Dynamic(settings)) = (mode, settings) {
            flight.context.begin_work(given.work_limit);
            dynamics.process_events(&mut DynamicStep { settings, flight: &mut flight, inputs })?;
        }
        if self.prediction_settings().is_due(time_s) {
            self.predict(given, inputs, time_s)?;
        }
        Ok(undo)
    }

    /// Undoes samples at the start.
    pub fn undo(&mut self, Undo(mode, thrusters, prediction): Undo) {
        (self.mode, self.thrusters, self.prediction) = (mode, thrusters, prediction);
    }

    /// Everything at `time_s`, where the flight has come; one that waits holds the attitude of `held`, and the momentum of its
    /// start.
    ///
    /// # Errors
    /// A state that belongs to another mode than the settings.
    pub fn report(
        &mut self,
        given: StepContext<'_>,
        inputs: &DynamicsInputs,
        held: &Command,
        time_s: f64,
    ) -> Result<Report<'_>, PlantError> {
        let (is_waiting, frame) = (self.is_waiting(), held.frame_at(time_s));
        let Self { propagator, thrusters, setup: Some(setup), mode, prediction } = self else {
            return Err(PlantError::OtherMode);
        };
        let FlightSetup { context, settings, evaluation } = &mut **setup;
        let mut flight = ConfiguredFlight { given, context, propagator, thrusters, log: &mut |_| {} };
        let mut sampled = None;
        let (evaluation, summary) = match (mode, settings) {
            (Mode::Dynamic(dynamics), ModeSettings::Dynamic(settings)) => {
                dynamics.resume(settings, &mut flight);
                sampled = Some((dynamics.control.downlink, dynamics.control.is_degenerate));
                let body = dynamics.motion.remembered_at(&settings.gyrostat, time_s);
                let evaluation =
                    &*evaluation.insert(dynamics.evaluation(settings, &mut flight, &body, time_s));
                (evaluation, dynamic(dynamics, settings, flight.thrusters, (body, evaluation), time_s))
            }
            (Mode::Ideal(simulated), ModeSettings::Ideal(settings)) => {
                let evaluation = &*evaluation.insert(flight.plant().evaluate(time_s));
                let mut summary = ideal(simulated, settings, evaluation, inputs, time_s);
                let Instant { sun_body, lit_fraction, .. } = &evaluation.instant;
                summary.sun_sensed_body = sensed_sun(
                    &settings.sun_sensors,
                    |k| inputs.sun_sensor_failed.get(k).is_some_and(|failed| *failed),
                    sun_body,
                    *lit_fraction,
                    (settings.seed, sample_number(time_s, settings.rate_hz)),
                );
                (evaluation, summary)
            }
            (Mode::Waiting, ModeSettings::Ideal(settings)) => {
                let evaluated =
                    Evaluation::without_position(frame, flight.context.current_mass_panels_stowed);
                let evaluation = &*evaluation.insert(evaluated);
                let waiting = waiting(&context.configuration, settings, held, time_s);
                (evaluation, ideal(&waiting, settings, evaluation, inputs, time_s))
            }
            _ => return Err(PlantError::OtherMode),
        };
        let (configuration, thrusters) = (&context.configuration, &*thrusters);
        let since_periapsis_s = match is_waiting {
            true => 0.0,
            false => propagator.trajectory.time_since_periapsis_s(configuration, time_s),
        };
        let Instant { downlink, is_degenerate, .. } = evaluation.instant;
        let (downlink, is_degenerate) = sampled.unwrap_or((downlink, is_degenerate));
        let followed = configuration.timeline.filter(|_| configuration.attitude.guided().is_some());
        let slot = given
            .prepared
            .timeline
            .zip(followed)
            .map(|(law, settings)| law.timeline.slot(time_s, settings.clock_minus_time_s));
        let target_is_clamped = propagator.sun_choice.is_clamped();
        Ok(Report {
            time_s,
            configuration,
            materials: context.solar.as_ref().map_or(&[], SolarModel::materials),
            thrusters,
            reaction_control: &context.allocator.settings,
            since_periapsis_s,
            downlink,
            is_degenerate,
            timeline_row: slot.map_or(0, |slot| slot.row),
            timeline_until_s: slot.map(|slot| slot.until_s).filter(|until_s| until_s.is_finite()),
            target_is_clamped,
            evaluation,
            integration_center: propagator.trajectory.integration_center(configuration),
            from_integration_center: propagator.trajectory.state_from_integration_center(time_s),
            approaches: propagator.trajectory.approaches_until(time_s),
            panel_turns: &propagator.panel_turns,
            prediction: *prediction,
            summary,
        })
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
        let Self { propagator, setup: Some(setup), .. } = self else { return Err(PlantError::OtherMode) };
        let external = |_: f64| [ForceTorque::zero(); 2];
        Plant::new(prepared, &mut setup.context, propagator, &external).faces(time_s, report)
    }
}

/// Flight that holds the attitude of `held` and the momentum of its start.
fn waiting(
    configuration: &Configuration,
    settings: &IdealSettings,
    held: &Command,
    time_s: f64,
) -> IdealFlight {
    let bias_body_n_m_s = configuration.momentum.policy.bias_body_n_m_s;
    let momentum_body_n_m_s = bias_body_n_m_s + settings.start_momentum_body_n_m_s;
    let totals = Totals::at_start(momentum_body_n_m_s, &held.frame_at(time_s).inertial_from_body);
    IdealFlight::new(time_s, &held.attitude_at(time_s), totals)
}

/// A flight before samples at its start.
pub struct Undo(Mode, Thrusters, Option<EncounterPrediction>);
