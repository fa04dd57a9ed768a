//! The plant: attitude, torque and force at any time of a configured flight, and the propagator that makes them known.
//!
//! A span of the propagator is one on which the orbit is known and attitude law and shadow keep their branch.
//! An orbit that light and heat act on has to be known before they can be computed, and they before it. A segment begins
//! with the orbit under gravity alone. Within a segment it is off by centimetres, which changes light and heat by less than
//! 1e-7 of themselves; with their acceleration the orbit is then integrated again, up to the segment's end. With an
//! attitude simulated by dynamics the reference orbit is the one under gravity, and forces perturb it interval by interval of the
//! disturbances (Encke's method).

use nalgebra::{Rotation3, Vector3};

use super::evaluation::{Evaluation, External};
use super::simulation_models::SimulationModels;
use crate::loads::{ForceTorque, Loads};
use crate::momentum::{EventValues, TorqueModel, TorqueSample, WorkKind, torques_body_n_m};
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;
use crate::plant::instant::air_and_field_builder;
use crate::plant::instant::at_time::Instant;
use crate::plant::instant::conditions::Conditions;
use crate::plant::instant::geometry::SimulationEphemeris;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::motion::panel_turns::PanelTurns;
use crate::plant::settings::attitude_source::{AttitudeSource, Turning};
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::sources::sunlight::light_and_heat::RadiationBuilder;
use crate::plant::sources::{SourceStates, Sources};
use crate::plant::state::propagator_state::{PropagatorState, SunDirectionSelection};
use crate::spacecraft::MassProperties;

/// Nodes at which the acceleration of a segment is taken.
const NODES: usize = 8;

/// Settings under which a plant is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct PlantSettings<'a> {
    /// Spacecraft and orbit.
    pub configuration: &'a Configuration,
    /// Mass properties with every panel at angle 0 and the propellant left.
    pub current_mass_panels_stowed: MassProperties,
    /// Attitude and rate of a body that turns by torque.
    pub turning: Turning,
}

/// A configured flight, ready to be evaluated.
pub struct Plant<'a> {
    pub(crate) path: Kinematics<'a>,
    sources: &'a mut Sources,
    states: &'a mut SourceStates,
    sun_choice: SunDirectionSelection,
    panel_turns: &'a mut PanelTurns,
    pub(crate) external: &'a External<'a>,
}

impl<'a> Plant<'a> {
    /// Units of a sample, sunlight on many faces aside: everything that is not read from a polynomial.
    const SAMPLE_UNITS: u32 = 3;

    /// `propagator` belongs to these settings; `external` gives the load from outside at any time.
    pub fn new(
        prepared: PreparedSpacecraft<'a>,
        settings: PlantSettings<'a>,
        models: &'a mut SimulationModels,
        propagator: &'a mut PropagatorState,
        external: &'a External<'a>,
    ) -> Self {
        let PlantSettings { configuration, current_mass_panels_stowed, turning } = settings;
        let SimulationModels { ephemeris, solar, digest, sources, work } = models;
        let spacecraft = PreparedSpacecraft { solar: solar.as_ref().unwrap_or(prepared.solar), ..prepared };
        let PropagatorState {
            trajectory,
            sources: states,
            air_and_field,
            sun_choice,
            panel_turns,
            command_slews,
            ..
        } = propagator;
        let guided = configuration.attitude.guided();
        let law = guided.map(|law| law.with_sun_directions(&sun_choice.selected));
        let bodies = SimulationEphemeris { configuration, ephemeris };
        let path = Kinematics {
            digest: *digest,
            configuration,
            law,
            turning,
            trajectory,
            bodies,
            spacecraft,
            command_slews,
            work,
            current_mass_panels_stowed,
            air_and_field,
        };
        Self { path, sources, states, sun_choice: *sun_choice, panel_turns, external }
    }

    /// Everything at `time_s`, which the propagator must have reached ([`TorqueModel::prepare`]).
    pub fn evaluate(&mut self, time_s: f64) -> Evaluation {
        let mut evaluation = self.evaluate_without_loads(time_s);
        self.write_loads(&mut evaluation, (self.external)(time_s)[0]);
        evaluation
    }

    /// The same but for the loads, which are zero.
    pub(crate) fn evaluate_without_loads(&mut self, time_s: f64) -> Evaluation {
        let instant = self.path.instant(time_s);
        let air_and_field = self.path.air_and_field(time_s);
        let mass = self.mass_properties(&instant);
        let panels_body_n_m_s = self.panel_momentum_body_n_m_s(&instant, &mass);
        Evaluation { instant, loads: Loads::zero(), mass, panels_body_n_m_s, air_and_field }
    }

    /// Writes the loads of an evaluation, `applied` from outside.
    pub(crate) fn write_loads(&mut self, evaluation: &mut Evaluation, applied: ForceTorque) {
        let Evaluation { instant, loads, mass, air_and_field, .. } = evaluation;
        let at = Conditions {
            kinematics: &self.path,
            instant,
            mass,
            air_and_field,
            flow: air_and_field.flow(instant),
            applied,
        };
        self.sources.write_loads(self.states, &at, loads);
    }

    /// Mass, centre of mass and inertia as the panels stand at `instant`.
    pub fn mass_properties(&self, instant: &Instant) -> MassProperties {
        self.path.mass_properties(&instant.sun())
    }

    /// Momentum in N m s of the panels relative to the body, body frame, as their laws turn them at `instant`.
    pub(crate) fn panel_momentum_body_n_m_s(&self, instant: &Instant, mass: &MassProperties) -> Vector3<f64> {
        let Kinematics { configuration, spacecraft, .. } = &self.path;
        if !spacecraft.has_panel_mass() {
            return Vector3::zeros();
        }
        configuration.panel_momentum_body_n_m_s(spacecraft.panels, mass, &instant.moving_sun())
    }

    /// Geometry and attitude at `time_s`.
    pub fn instant(&mut self, time_s: f64) -> Instant {
        self.path.instant(time_s)
    }

    /// Time since the last periapsis, in s.
    pub fn time_since_periapsis_s(&self, time_s: f64) -> f64 {
        self.path.trajectory.time_since_periapsis_s(self.path.configuration, time_s)
    }

    /// Reports temperature in K and force in N, body frame, of every face of the light model at `time_s`, in its order; the
    /// force of the effects that act.
    ///
    /// # Errors
    /// A geometry without meaning.
    pub fn faces(&mut self, time_s: f64, report: impl FnMut(f64, Vector3<f64>)) -> Result<(), PlantError> {
        let Some(solver) = &mut self.sources.sunlight else { return Ok(()) };
        let segment = self.states.sunlight.as_ref();
        RadiationBuilder { solver, path: &mut self.path }.faces(segment, time_s, report)
    }

    /// Extends air, magnetic field and the states of the sources over a span; returns up to where they are valid, at most to its end.
    fn extend_disturbances(&mut self, span: Span, orbit_has_moved: bool) -> Result<f64, PlantError> {
        let known_s = air_and_field_builder::extend(&mut self.path, span, orbit_has_moved)?;
        Ok(self.sources.extend(self.states, &mut self.path, span)?.min(known_s))
    }

    /// [`TorqueModel::prepare`] with the whole instant at `start_s`.
    pub(crate) fn begin(&mut self, start_s: f64, limit_s: f64) -> Result<(f64, Instant), PlantError> {
        let known_s = self.orbit_and_light(start_s)?.min(limit_s);
        let instant = self.path.instant(start_s);
        let Kinematics { configuration, spacecraft, .. } = &self.path;
        self.panel_turns.begin(&configuration.panels, spacecraft.panels, &instant.moving_sun());
        Ok((self.path.laws_until_s(&instant, known_s), instant))
    }

    /// Makes sure that the orbit is known from `start_s` on, with the light that pushes it; returns up to where.
    ///
    /// # Errors
    /// What ends a flight.
    pub(crate) fn orbit_and_light(&mut self, start_s: f64) -> Result<f64, PlantError> {
        let configuration = self.path.configuration;
        let by_interval = configuration.uses_encke();
        let known = Span::new(start_s, self.path.trajectory.end_s());
        if known.end_s > start_s {
            return self.extend_disturbances(known, by_interval);
        }
        // Two integrations of some 40 evaluations, and the search for changes in between.
        self.path.spend_units(WorkKind::Orbit, 60, start_s)?;
        self.path.trajectory.close_segment(configuration, start_s);
        let before = *self.path.trajectory;
        self.integrate(f64::INFINITY, |_| Vector3::zeros())?;
        if configuration.motion.has_nongravitational_forces() && !by_interval {
            let predicted = Span::new(start_s, self.path.trajectory.end_s());
            let lit_s = self.extend_disturbances(predicted, false)?;
            let mut end_s = self.path.smooth_until(start_s, lit_s);
            let acceleration_m_s2 = loop {
                let acceleration_m_s2 = |at_s: f64| self.sample(at_s).acceleration_inertial_m_s2;
                let fitted = Segment::<3, NODES>::fit(start_s, end_s, acceleration_m_s2);
                if configuration.motion.resolves(&fitted) {
                    break fitted;
                }
                self.path.spend_units(WorkKind::Orbit, NODES as u32, start_s)?;
                end_s = 0.5 * (start_s + end_s);
            };
            *self.path.trajectory = before;
            self.integrate(end_s, |at_s| acceleration_m_s2.value(at_s))?;
            // Those ahead began on the predicted orbit.
            self.path.command_slews.forget_after(start_s);
        }
        let end_s = self.path.trajectory.end_s();
        // Written so that a NaN is stuck too.
        if end_s > start_s {
            self.extend_disturbances(Span { start_s, end_s }, true)
        } else {
            Err(PlantError::Stuck { start_s, end_s })
        }
    }

    /// Whether the Sun's direction has to be chosen at `start_s`, where a segment begins, before it can be made ready.
    pub(crate) fn must_choose(&mut self, start_s: f64) -> bool {
        let attitude = &self.path.configuration.attitude;
        matches!(attitude, AttitudeSource::Guided(guided) if guided.managed) && {
            let instant = self.path.instant(start_s);
            self.sun_choice.is_due(instant.is_in_downlink(), instant.law.row)
        }
    }

    fn integrate(
        &mut self,
        limit_s: f64,
        extra_m_s2: impl FnMut(f64) -> Vector3<f64>,
    ) -> Result<(), PlantError> {
        let Kinematics { configuration, spacecraft, trajectory, bodies, .. } = &mut self.path;
        let shortened =
            trajectory.advance(configuration, bodies, spacecraft.orbit_method, limit_s, extra_m_s2)?;
        if shortened > 0 {
            // Between bodies a segment is tried until it is short enough: some 40 times the gravity of all of them a trial.
            let end_s = self.path.trajectory.end_s();
            self.path.spend_units(WorkKind::Orbit, 60 * shortened, end_s)?;
        }
        Ok(())
    }
}

impl TorqueModel for Plant<'_> {
    type Failure = PlantError;

    fn prepare(&mut self, start_s: f64, limit_s: f64) -> Result<(f64, Rotation3<f64>), PlantError> {
        let (until_s, instant) = self.begin(start_s, limit_s)?;
        Ok((until_s, instant.law.frame.inertial_from_body))
    }

    fn sample(&mut self, time_s: f64) -> TorqueSample {
        let evaluation = self.evaluate(time_s);
        let Kinematics { configuration, spacecraft, .. } = &self.path;
        let [_, acceleration_inertial_m_s2] = evaluation.force_and_acceleration_inertial();
        TorqueSample {
            inertial_from_body: evaluation.instant.law.frame.inertial_from_body,
            rate_body_rad_s: evaluation.instant.law.frame.rate_body_rad_s,
            structure_body_n_m_s: spacecraft.has_panel_mass().then(|| evaluation.structure_body_n_m_s()),
            torque_body_n_m: evaluation.loads.total().torque_body_n_m,
            by_source_body_n_m: torques_body_n_m(&evaluation.loads, configuration.effects),
            acceleration_inertial_m_s2,
            events: evaluation.instant.events,
        }
    }

    fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64> {
        self.path.inertial_from_body(time_s)
    }

    fn events(&mut self, time_s: f64) -> EventValues {
        self.path.events(time_s)
    }

    fn time_rounding_s(&self, time_s: f64) -> f64 {
        self.path.time_rounding_s(time_s)
    }

    fn spend(&mut self, kind: WorkKind, time_s: f64) -> Result<(), PlantError> {
        let samples = match kind {
            WorkKind::Segment | WorkKind::Refinement => 10,
            WorkKind::Search => 60,
            // With the segment that it begins.
            WorkKind::Dump => 16,
            WorkKind::Light | WorkKind::Orbit | WorkKind::Ephemeris | WorkKind::Air => 1,
        };
        let Kinematics { configuration, spacecraft, .. } = &self.path;
        let faces = spacecraft.solar.face_count() as u32;
        let units = Self::SAMPLE_UNITS + faces / 50 + self.sources.load_units(configuration);
        self.path.spend_units(kind, samples * units, time_s)
    }
}
