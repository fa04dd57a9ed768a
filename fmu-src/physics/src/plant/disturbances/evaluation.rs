//! The plant: attitude, torque and force at any time of a configured flight, and the propagator that makes them known.
//!
//! A span of the propagator is one on which the orbit is known and attitude law and shadow keep their branch.
//! An orbit that light and heat act on has to be known before they can be computed, and they before it. A segment begins
//! with the orbit under gravity alone. Within a segment it is off by centimetres, which changes light and heat by less than
//! 1e-7 of themselves; with their acceleration the orbit is then integrated again, up to the segment's end. With an
//! attitude simulated by dynamics the reference orbit is the one under gravity, and forces perturb it interval by interval of the
//! disturbances (Encke's method).

use nalgebra::{Rotation3, Vector3};

use crate::aerodynamics::AirFlow;
use crate::attitude::MovingFrame;
use crate::constants::RADIUS_SUN_M;
use crate::loads::{Effect, ForceTorque, Loads};
use crate::momentum::{EventValues, TorqueModel, TorqueSample, WorkKind, torques_body_n_m};
use crate::numerics::chebyshev::Segment;
use crate::radiation::Beam;
use crate::spacecraft::MassProperties;

use super::laws::{self, LocalEnvironment};
use super::simulation_context::{PreparedSpacecraft, SimulationContext};
use crate::plant::air_and_field::aerodynamic_solver::AerodynamicSolver;
use crate::plant::air_and_field::air_and_field_builder::AirAndFieldBuilder;
use crate::plant::air_and_field::air_and_field_segment::{AirAndField, AirAndFieldSegment};
use crate::plant::light::light_and_heat::RadiationBuilder;
use crate::plant::light::radiation_segment::RadiationSegment;
use crate::plant::light::radiation_solver::RadiationSolver;
use crate::plant::motion::instant::Instant;
use crate::plant::motion::kinematics::Kinematics;
use crate::plant::motion::panel_motion::Hinged;
use crate::plant::motion::panel_turns::PanelTurns;
use crate::plant::settings::configuration::{AttitudeSource, Configuration};
use crate::plant::settings::error::PlantError;
use crate::plant::state::propagator_state::PropagatorState;
use crate::plant::state::sun_choice::SunDirectionSelection;

/// Nodes at which the acceleration of a segment is taken.
const NODES: usize = 8;

/// Everything about one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// Geometry and attitude.
    pub instant: Instant,
    /// Force and torque by effect.
    pub loads: Loads,
    /// Mass, centre of mass and inertia as the panels stand.
    pub mass: MassProperties,
    /// Momentum of panels that turn, relative to the body, body frame, in N m s.
    pub panels_body_n_m_s: Vector3<f64>,
    /// Air and magnetic field about it.
    pub air_and_field: AirAndField,
}

impl Evaluation {
    /// Spacecraft with a known attitude and no position: no Sun, no planet, no force.
    pub fn without_position(frame: MovingFrame, mass: MassProperties) -> Self {
        Self {
            instant: Instant::without_position(frame),
            loads: Loads::zero(),
            mass,
            panels_body_n_m_s: Vector3::zeros(),
            air_and_field: AirAndField::default(),
        }
    }

    /// Checks that a spacecraft can be there at `time_s`: outside the planet and the Sun, the planet outside
    /// the Sun, every number finite.
    ///
    /// # Errors
    /// A place inside one of them.
    pub fn check(&self, time_s: f64) -> Result<(), PlantError> {
        let geometry = &self.instant.geometry;
        let is_outside = |planet| (geometry.to_sun - planet).position_m.norm() > RADIUS_SUN_M;
        let planet_is_outside = geometry.to_planet.is_none_or(is_outside);
        let is_somewhere = self.instant.sun_distance_m > RADIUS_SUN_M
            && planet_is_outside
            && self.instant.lit_fraction.is_finite()
            && self.loads.total().is_finite();
        let position_m = geometry.spacecraft.position_m;
        if is_somewhere {
            Ok(())
        } else {
            Err(PlantError::WithoutPosition { time_s, position_m: position_m.into() })
        }
    }

    /// Momentum of the body and its panels without the wheels, J w + h_p, body frame, in N m s.
    pub fn structure_body_n_m_s(&self) -> Vector3<f64> {
        self.mass.inertia_body_kg_m2 * self.instant.frame.rate_body_rad_s + self.panels_body_n_m_s
    }

    /// Force of all effects in N and the acceleration of the spacecraft by it in m/s2, EME2000.
    pub fn force_and_acceleration_inertial(&self) -> [Vector3<f64>; 2] {
        let force_inertial_n = self.instant.frame.inertial_from_body * self.loads.total().force_body_n;
        [force_inertial_n, force_inertial_n / self.mass.mass_kg]
    }

    /// Velocity relative to the air, body frame, in m/s; zero without a planet.
    pub fn velocity_in_air_body_m_s(&self) -> Vector3<f64> {
        velocity_in_air_body_m_s(&self.instant, &self.air_and_field).unwrap_or_else(Vector3::zeros)
    }

    /// North of the planet, body frame, where its flattening acts on the gravity gradient; otherwise zero.
    pub fn pole_body(&self, configuration: &Configuration, time_s: f64) -> Vector3<f64> {
        pole_inertial(configuration, time_s).map_or_else(Vector3::zeros, |it| self.instant.to_body * it)
    }

    /// Magnetic field, body frame, in T.
    pub fn field_body_t(&self) -> Vector3<f64> {
        self.instant.to_body * self.air_and_field.field_inertial_t
    }
}

/// Force through the centre of mass and torque from outside at a time, body frame, and how they change per second.
pub type External<'a> = dyn Fn(f64) -> [ForceTorque; 2] + 'a;

/// Velocity relative to the air, body frame, in m/s; `None` without a planet.
fn velocity_in_air_body_m_s(instant: &Instant, about: &AirAndField) -> Option<Vector3<f64>> {
    let from_planet = instant.geometry.from_planet()?;
    Some(instant.to_body * (from_planet.velocity_m_s - about.air_velocity_m_s))
}

/// North of the planet, EME2000, where its flattening acts on the gravity gradient.
fn pole_inertial(configuration: &Configuration, time_s: f64) -> Option<Vector3<f64>> {
    let Configuration { figure, laws, epoch_minus_time_s, .. } = configuration;
    let figure = figure.as_ref().filter(|_| laws.flattening.is_some());
    figure.map(|it| it.orientation.pole_eme2000(time_s + epoch_minus_time_s))
}

/// A configured flight, ready to be evaluated.
pub struct Plant<'a> {
    prepared: PreparedSpacecraft<'a>,
    pub(crate) kinematics: Kinematics<'a>,
    segment: &'a mut Option<RadiationSegment>,
    light: Option<&'a mut RadiationSolver>,
    air_and_field: &'a mut AirAndFieldSegment,
    air: Option<&'a mut AerodynamicSolver>,
    sun_choice: SunDirectionSelection,
    panel_turns: &'a mut PanelTurns,
    external: &'a External<'a>,
}

impl<'a> Plant<'a> {
    /// Units of a sample, sunlight on many faces aside: everything that is not read from a polynomial.
    const SAMPLE_UNITS: u32 = 3;

    /// `propagator` belongs to this context; `external` gives the load from outside at any time.
    pub fn new(
        prepared: PreparedSpacecraft<'a>,
        context: &'a mut SimulationContext,
        propagator: &'a mut PropagatorState,
        external: &'a External<'a>,
    ) -> Self {
        let SimulationContext {
            configuration,
            current_mass_panels_stowed,
            ephemeris,
            solar,
            light,
            air,
            work,
            ..
        } = context;
        let prepared = PreparedSpacecraft { solar: solar.as_ref().unwrap_or(prepared.solar), ..prepared };
        let PropagatorState {
            trajectory,
            light: segment,
            air_and_field,
            sun_choice,
            panel_turns,
            command_slews,
            ..
        } = propagator;
        let kinematics = Kinematics {
            configuration,
            trajectory,
            ephemeris,
            default_downlink: prepared.default_downlink,
            timeline: prepared.timeline,
            command_slews,
            work,
            current_mass_panels_stowed: *current_mass_panels_stowed,
        };
        Self {
            prepared,
            kinematics,
            segment,
            light: light.as_mut(),
            air_and_field,
            air: air.as_mut(),
            sun_choice: *sun_choice,
            panel_turns,
            external,
        }
    }

    /// Everything at `time_s`, which the propagator must have reached ([`TorqueModel::prepare`]).
    pub fn evaluate(&mut self, time_s: f64) -> Evaluation {
        let instant = self.kinematics.instant(time_s);
        let air_and_field = self.air_and_field(time_s);
        let configuration = self.kinematics.configuration;
        let mass = self.mass_properties(&instant, time_s);
        let mut loads = Loads::zero();
        self.radiation(time_s, &instant, &mass.center_of_mass_body_m, &mut loads);
        if let Some(planet_body_m) = instant.planet_body_m {
            let is_magnetic = configuration.effects.has(Effect::Magnetic);
            let at = LocalEnvironment {
                planet_body_m: Some(planet_body_m),
                pole_body: instant.to_body * pole_inertial(configuration, time_s).unwrap_or_else(Vector3::z),
                inertia_body_kg_m2: mass.inertia_body_kg_m2,
                field_body_t: match is_magnetic {
                    true => instant.to_body * air_and_field.field_inertial_t,
                    false => Vector3::zeros(),
                },
                air: self.air_load(time_s, &instant, &air_and_field, &mass.center_of_mass_body_m),
            };
            laws::write_loads(&configuration.laws, configuration.effects, &at, &mut loads);
        }
        [loads[Effect::Applied], _] = (self.external)(time_s);
        let panels_body_n_m_s = self.panel_momentum_body_n_m_s(&instant, &mass, time_s);
        Evaluation { instant, loads, mass, panels_body_n_m_s, air_and_field }
    }

    /// Force and torque from outside at `time_s` and their slopes per second.
    pub(crate) fn external(&self, time_s: f64) -> [ForceTorque; 2] {
        (self.external)(time_s)
    }

    /// Air and magnetic field at `time_s`, which the propagator must have reached.
    pub(crate) fn air_and_field(&self, time_s: f64) -> AirAndField {
        let settings = &self.kinematics.configuration.air_and_field;
        settings.as_ref().map_or_else(AirAndField::default, |it| self.air_and_field.at(it, time_s))
    }

    /// Aerodynamic force and torque.
    fn air_load(
        &mut self,
        time_s: f64,
        instant: &Instant,
        found: &AirAndField,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> ForceTorque {
        let configuration = self.kinematics.configuration;
        let acts = configuration.effects.has(Effect::Aerodynamic) && found.air.density_kg_m3 > 0.0;
        let velocity = velocity_in_air_body_m_s(instant, found).filter(|_| acts);
        let Some((solver, velocity_body_m_s)) = self.air.as_deref_mut().zip(velocity) else {
            return ForceTorque::zero();
        };
        let flow = AirFlow {
            density_kg_m3: found.air.density_kg_m3,
            temperature_k: found.air.temperature_k,
            molar_mass_kg_mol: found.air.molar_mass_kg_mol,
            velocity_body_m_s,
        };
        let light = self.segment.as_ref().map(|segment| (segment, time_s));
        let sun = instant.sun_at(time_s);
        solver.load((configuration, self.prepared.panels), light, &sun, &flow, center_of_mass_body_m)
    }

    /// Mass, centre of mass and inertia as the panels stand at `time_s`.
    pub fn mass_properties(&self, instant: &Instant, time_s: f64) -> MassProperties {
        self.kinematics.mass_properties(self.prepared.panels, &instant.sun_at(time_s))
    }

    /// Momentum in N m s of the panels relative to the body, body frame, as their laws turn them at `time_s`.
    pub(crate) fn panel_momentum_body_n_m_s(
        &self,
        instant: &Instant,
        mass: &MassProperties,
        time_s: f64,
    ) -> Vector3<f64> {
        if !self.has_panel_mass() {
            return Vector3::zeros();
        }
        let configuration = self.kinematics.configuration;
        configuration.panel_momentum_body_n_m_s(self.prepared.panels, mass, &instant.moving_sun_at(time_s))
    }

    fn has_panel_mass(&self) -> bool {
        self.prepared.panels.iter().any(|panel| panel.mass.is_some())
    }

    /// The panels with what they belong to.
    pub(crate) fn hinged(&self) -> Hinged<'a> {
        let Kinematics { configuration, current_mass_panels_stowed, .. } = self.kinematics;
        Hinged { panels: self.prepared.panels, configuration, current_mass_panels_stowed }
    }

    /// Geometry and attitude at `time_s`.
    pub fn instant(&mut self, time_s: f64) -> Instant {
        self.kinematics.instant(time_s)
    }

    /// Time since the last periapsis, in s.
    pub fn time_since_periapsis_s(&self, time_s: f64) -> f64 {
        self.kinematics.trajectory.time_since_periapsis_s(self.kinematics.configuration, time_s)
    }

    /// Writes light and heat: slow effects from their segment, plain sunlight in closed form.
    fn radiation(
        &self,
        time_s: f64,
        instant: &Instant,
        center_of_mass_body_m: &Vector3<f64>,
        loads: &mut Loads,
    ) {
        let configuration = self.kinematics.configuration;
        let mut shadowed = false;
        if let (Some(segment), Some(light)) = (&*self.segment, &self.light)
            && configuration.has_light_and_heat()
        {
            shadowed = configuration.light_and_heat.shadowing && light.model.can_shadow();
            *loads = segment.loads(time_s);
            loads[Effect::Solar] = loads[Effect::Solar].scaled(configuration.light.scale);
        }
        if !shadowed {
            let pressure_pa = configuration.light.pressure_pa(instant.sun_distance_m);
            let beam =
                Beam { source_body: instant.sun_body, pressure_pa: pressure_pa * instant.lit_fraction };
            let at = [time_s, instant.sun_distance_m];
            let sunlit = self.prepared.sunlit(configuration, &self.kinematics.current_mass_panels_stowed, at);
            loads[Effect::Solar] = sunlit.load(&beam, center_of_mass_body_m);
        }
    }

    /// Reports temperature in K and force in N, body frame, of every face of the light model at `time_s`, in its order; the
    /// force of the effects that act.
    ///
    /// # Errors
    /// A geometry without meaning.
    pub fn faces(&mut self, time_s: f64, report: impl FnMut(f64, Vector3<f64>)) -> Result<(), PlantError> {
        let Some(light) = self.light.as_deref_mut() else { return Ok(()) };
        let mut builder = RadiationBuilder { panels: self.prepared.panels, kinematics: &mut self.kinematics };
        builder.faces(light, self.segment.as_ref(), time_s, report)
    }

    /// Extends light, heat, air and magnetic field from `start_s` on; returns up to where they are valid, at most `limit_s`.
    fn extend_disturbances(
        &mut self,
        start_s: f64,
        limit_s: f64,
        orbit_has_moved: bool,
    ) -> Result<f64, PlantError> {
        let known_s = self.extend_air_and_field(start_s, limit_s, orbit_has_moved)?;
        Ok(self.extend_radiation(start_s, limit_s)?.min(known_s))
    }

    /// Extends air and magnetic field likewise.
    fn extend_air_and_field(
        &mut self,
        start_s: f64,
        limit_s: f64,
        orbit_has_moved: bool,
    ) -> Result<f64, PlantError> {
        let Configuration { air_and_field, figure, .. } = self.kinematics.configuration;
        let Some((settings, figure)) = air_and_field.zip(*figure) else { return Ok(limit_s) };
        let mut builder =
            AirAndFieldBuilder { settings, figure, kinematics: &mut self.kinematics, orbit_has_moved };
        builder.extend(self.air_and_field, start_s, limit_s)
    }

    /// Makes sure that light and heat are known from `start_s` on, and tells up to where, at most `limit_s`.
    fn extend_radiation(&mut self, start_s: f64, limit_s: f64) -> Result<f64, PlantError> {
        match &mut self.light {
            Some(light) if self.kinematics.configuration.has_light_and_heat() => {
                let mut builder =
                    RadiationBuilder { panels: self.prepared.panels, kinematics: &mut self.kinematics };
                builder.extend(light, self.segment, start_s, limit_s)
            }
            _ => Ok(limit_s),
        }
    }

    /// [`TorqueModel::prepare`] with the whole instant at `start_s`.
    pub(crate) fn begin(&mut self, start_s: f64, limit_s: f64) -> Result<(f64, Instant), PlantError> {
        let known_s = self.orbit_and_light(start_s)?.min(limit_s);
        let instant = self.kinematics.instant(start_s);
        let settings = &self.kinematics.configuration.panels;
        self.panel_turns.begin(settings, self.prepared.panels, &instant, start_s);
        Ok((self.kinematics.laws_until_s(start_s, &instant, known_s), instant))
    }

    /// Makes sure that the orbit is known from `start_s` on, with the light that pushes it; returns up to where.
    ///
    /// # Errors
    /// What ends a flight.
    pub(crate) fn orbit_and_light(&mut self, start_s: f64) -> Result<f64, PlantError> {
        let by_interval = self.kinematics.configuration.uses_encke();
        if self.kinematics.trajectory.end_s() > start_s {
            return self.extend_disturbances(start_s, self.kinematics.trajectory.end_s(), by_interval);
        }
        // Two integrations of some 40 evaluations, and the search for changes in between.
        self.kinematics.spend_units(WorkKind::Orbit, 60, start_s)?;
        self.kinematics.trajectory.close_segment(self.kinematics.configuration, start_s);
        let before = *self.kinematics.trajectory;
        self.integrate(f64::INFINITY, |_| Vector3::zeros())?;
        if self.kinematics.configuration.motion.has_nongravitational_forces() && !by_interval {
            let lit_s = self.extend_disturbances(start_s, self.kinematics.trajectory.end_s(), false)?;
            let mut end_s = self.kinematics.smooth_until(start_s, lit_s);
            let acceleration_m_s2 = loop {
                let fitted = Segment::<3, NODES>::fit(start_s, end_s, |at_s| {
                    self.sample(at_s).acceleration_inertial_m_s2
                });
                if self.kinematics.configuration.motion.resolves(&fitted) {
                    break fitted;
                }
                self.kinematics.spend_units(WorkKind::Orbit, NODES as u32, start_s)?;
                end_s = 0.5 * (start_s + end_s);
            };
            *self.kinematics.trajectory = before;
            self.integrate(end_s, |at_s| acceleration_m_s2.value(at_s))?;
            // Those ahead began on the predicted orbit.
            self.kinematics.command_slews.forget_after(start_s);
        }
        let end_s = self.kinematics.trajectory.end_s();
        // Written so that a NaN is stuck too.
        if end_s > start_s {
            self.extend_disturbances(start_s, end_s, true)
        } else {
            Err(PlantError::Stuck { start_s, end_s })
        }
    }

    fn integrate(
        &mut self,
        limit_s: f64,
        extra_m_s2: impl FnMut(f64) -> Vector3<f64>,
    ) -> Result<(), PlantError> {
        let Kinematics { configuration, trajectory, ephemeris, .. } = &mut self.kinematics;
        let method = self.prepared.orbit_method;
        let shortened = trajectory.advance(configuration, ephemeris, method, limit_s, extra_m_s2)?;
        if shortened > 0 {
            // Between bodies a segment is tried until it is short enough: some 40 times the gravity of all of them a trial.
            let end_s = self.kinematics.trajectory.end_s();
            self.kinematics.spend_units(WorkKind::Orbit, 60 * shortened, end_s)?;
        }
        Ok(())
    }
}

impl TorqueModel for Plant<'_> {
    type Failure = PlantError;

    fn prepare(&mut self, start_s: f64, limit_s: f64) -> Result<(f64, Rotation3<f64>), PlantError> {
        let (until_s, instant) = self.begin(start_s, limit_s)?;
        Ok((until_s, instant.frame.inertial_from_body))
    }

    fn must_choose(&mut self, start_s: f64) -> bool {
        match &self.kinematics.configuration.attitude {
            AttitudeSource::Guided(guided) if guided.managed => {
                let regime = self.kinematics.instant(start_s).regime;
                self.sun_choice.is_due(regime.downlink, regime.row)
            }
            _ => false,
        }
    }

    fn sample(&mut self, time_s: f64) -> TorqueSample {
        let evaluation = self.evaluate(time_s);
        let [_, acceleration_inertial_m_s2] = evaluation.force_and_acceleration_inertial();
        TorqueSample {
            inertial_from_body: evaluation.instant.frame.inertial_from_body,
            rate_body_rad_s: evaluation.instant.frame.rate_body_rad_s,
            structure_body_n_m_s: self.has_panel_mass().then(|| evaluation.structure_body_n_m_s()),
            torque_body_n_m: evaluation.loads.total().torque_body_n_m,
            by_source_body_n_m: torques_body_n_m(&evaluation.loads, self.kinematics.configuration.effects),
            acceleration_inertial_m_s2,
            events: evaluation.instant.events,
        }
    }

    fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64> {
        self.kinematics.inertial_from_body(time_s)
    }

    fn events(&mut self, time_s: f64) -> EventValues {
        self.kinematics.events(time_s)
    }

    fn time_rounding_s(&self, time_s: f64) -> f64 {
        self.kinematics.time_rounding_s(time_s)
    }

    fn spend(&mut self, kind: WorkKind, time_s: f64) -> Result<(), PlantError> {
        let samples = match kind {
            WorkKind::Segment | WorkKind::Refinement => 10,
            WorkKind::Search => 60,
            // With the segment that it begins.
            WorkKind::Dump => 16,
            WorkKind::Light | WorkKind::Orbit | WorkKind::Ephemeris | WorkKind::Air => 1,
        };
        let faces = self.prepared.solar.face_count() as u32;
        let acts = self.kinematics.configuration.effects.has(Effect::Aerodynamic);
        let air = self.air.as_ref().filter(|_| acts).map_or(0, |air| air.evaluation_units());
        let units = Self::SAMPLE_UNITS + faces / 50 + air;
        self.kinematics.spend_units(kind, samples * units, time_s)
    }
}
