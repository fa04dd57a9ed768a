//! The spacecraft in one step of its flight: where it is, its thrusters, and what acts on it from outside.

use nalgebra::Vector3;

use crate::attitude::{Attitude, BodyMotion, GyrostatMotion, MovingFrame};
use crate::guidance::pointing::boresight::Gimbal;
use crate::guidance::{Activity, Guided, Schedule, ScienceArc, ScienceRule, SelectedSunDirection, Window};
use crate::loads::ForceTorque;
use crate::momentum::{Convention, TorqueModel, Totals, WorkKind};

use crate::numerics::Span;
use crate::plant::disturbances::evaluation::External;
use crate::plant::disturbances::plant::{Plant, PlantSettings};
use crate::plant::disturbances::simulation_context::{ForkScratch, SimulationContext};
use crate::plant::disturbances::simulation_models::SimulationModels;
use crate::plant::settings::attitude_source::{Command, Turning};
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::dynamics_settings::DynamicsInputs;
use crate::plant::settings::error::PlantError;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::plant::settings::thruster_events::ThrusterEvent;
use crate::plant::sources::Dipoles;
use crate::plant::sources::sunlight::sunlit::SunlitConfiguration;
use crate::plant::state::disturbance_interval::DisturbanceInterval;
use crate::plant::state::propagator_state::PropagatorState;
use crate::plant::thrusters::allocation::ThrusterAllocator;
use crate::plant::thrusters::reaction_control::Thrusters;
use crate::spacecraft::MassProperties;

/// A window computed in epochs begins this near its number in flight time, in s.
const EPOCH_ROUNDING_S: f64 = 1e-6;

/// Units of a choice for science that unloads: each of its trials goes through all of it.
const SCIENCE_UNITS: u32 = 50_000;

/// When a window ends, in s past J2000 TDB: of science whose next downlink waits for a periapsis to come, by the schedule's own
/// counting; infinite where nothing ends it.
fn end_epoch_s(schedule: &Schedule, window: &Window, now_epoch_s: f64) -> f64 {
    if window.until_s.is_finite() || window.activity == Activity::Downlink {
        return window.until_s;
    }
    if window.since_s.is_finite() {
        return window.since_s + (schedule.cycle_s() - schedule.downlink_s());
    }
    let counted = schedule.window(now_epoch_s);
    if counted.activity == Activity::Science { counted.until_s } else { f64::INFINITY }
}

/// Momentum where a downlink begins, in N m s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartMomentum {
    /// EME2000; it stays there while the body turns.
    Inertial(Vector3<f64>),
    /// Body components, whatever the attitude: the integral of each component of torque, or a start that is given in them.
    Body(Vector3<f64>),
}

impl StartMomentum {
    /// Momentum from which a choice of attitude counts, from totals under a convention.
    pub fn from_totals(totals: &Totals, convention: Convention) -> Self {
        match convention {
            Convention::Inertial => Self::Inertial(totals.momentum_inertial_n_m_s),
            Convention::BodyIntegral => Self::Body(totals.torque_integral_body_n_m_s),
        }
    }

    /// Magnitude, in N m s.
    pub fn magnitude_n_m_s(&self) -> f64 {
        match self {
            Self::Inertial(momentum) | Self::Body(momentum) => momentum.norm(),
        }
    }
}

/// Chooses the Sun's place, and tells whether limits keep the momentum from its target; no place where the default attitude is to be
/// simulated. Called once a downlink or science that unloads, and again after a dump at its very beginning.
pub type SunPlanner<'a> =
    dyn Fn(&mut DownlinkForecast<'_, '_>) -> Result<Option<SelectedSunDirection>, PlantError> + 'a;

/// Start of a downlink, or of science that unloads, from which it is forecast.
pub struct DownlinkForecast<'o, 'f> {
    pub(crate) flight: &'o mut ConfiguredFlight<'f>,
    pub(crate) law: Guided,
    /// Time, totals and momentum here.
    pub begin: SunSelectionStart,
    /// How long it lasts, in s.
    pub span_s: f64,
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Vector3<f64>,
    /// Unit vector to the Earth, EME2000; `None` where its place is not known.
    pub to_earth: Option<Vector3<f64>>,
    /// Distance from the Sun's centre, in m.
    pub sun_distance_m: f64,
    /// Pressure of sunlight, in Pa, without a shadow.
    pub pressure_pa: f64,
    /// Least and greatest angle between Sun and Earth while the downlink lasts, in rad.
    pub separations_rad: [f64; 2],
    /// The science that begins; `None`: a downlink does.
    pub science: Option<ScienceArc>,
}

impl DownlinkForecast<'_, '_> {
    /// The spacecraft in direct sunlight without shadows.
    pub(crate) fn sunlit(&self) -> SunlitConfiguration<'_> {
        let prepared = &self.flight.given.prepared;
        SunlitConfiguration {
            solar: self.flight.models.solar.as_ref().unwrap_or(prepared.solar),
            panels: prepared.panels,
            settings: &self.flight.configuration.panels,
            current_mass_panels_stowed: *self.flight.current_mass_panels_stowed,
            time_s: self.begin.time_s,
            sun_distance_m: self.sun_distance_m,
        }
    }

    /// Settings of the flight.
    pub(crate) fn configuration(&self) -> &Configuration {
        self.flight.configuration
    }
}

/// Spacecraft, loads from outside, planner and work limit of a step.
#[derive(Clone, Copy)]
pub struct StepContext<'a> {
    /// The spacecraft.
    pub prepared: PreparedSpacecraft<'a>,
    /// Force and torque from outside.
    pub external: &'a External<'a>,
    /// Inputs of the step.
    pub inputs: &'a DynamicsInputs,
    /// Planner of the Sun's direction in downlinks and in science that unloads; called where the guidance is managed.
    pub planner: &'a SunPlanner<'a>,
    /// Units of about a microsecond that a step may take.
    pub work_limit: u32,
    /// Receives dumps and maneuvers.
    pub log: &'a dyn Fn(&ThrusterEvent),
}

impl<'a> StepContext<'a> {
    /// Context in which nothing advances and nothing acts from outside.
    pub(super) fn at_rest(prepared: PreparedSpacecraft<'a>, inputs: &'a DynamicsInputs) -> Self {
        Self {
            prepared,
            external: &|_| [ForceTorque::zero(); 2],
            inputs,
            planner: &|_| Ok(None),
            work_limit: 0,
            log: &|_| {},
        }
    }
}

/// A flight in one step: everything that its loads follow from.
pub(crate) struct ConfiguredFlight<'a> {
    pub given: StepContext<'a>,
    pub configuration: &'a mut Configuration,
    /// With every panel at angle 0.
    pub current_mass_panels_stowed: &'a mut MassProperties,
    pub models: &'a mut SimulationModels,
    pub allocator: &'a mut ThrusterAllocator,
    /// Memory of a fork; none for forks of a fork.
    pub scratch: Option<&'a mut ForkScratch>,
    pub propagator: &'a mut PropagatorState,
    pub thrusters: &'a mut Thrusters,
    /// Attitude and rate of a body that turns by torque.
    pub turning: Turning,
}

/// Flight where the Sun's direction may be selected.
#[derive(Clone, Copy, Debug)]
pub struct SunSelectionStart {
    /// When, in s.
    pub time_s: f64,
    /// Momentum and velocity change so far.
    pub totals: Totals,
    /// Momentum from which a choice of attitude counts.
    pub momentum: StartMomentum,
    /// Whether the flight begins there.
    pub is_first: bool,
}

impl<'a> ConfiguredFlight<'a> {
    pub(super) fn new(
        given: StepContext<'a>,
        context: &'a mut SimulationContext,
        propagator: &'a mut PropagatorState,
        thrusters: &'a mut Thrusters,
        turning: Turning,
    ) -> Self {
        let SimulationContext { configuration, current_mass_panels_stowed, models, allocator, fork } =
            context;
        let scratch = Some(&mut **fork);
        Self {
            given,
            configuration,
            current_mass_panels_stowed,
            models,
            allocator,
            scratch,
            propagator,
            thrusters,
            turning,
        }
    }

    /// Dipoles of the sources at `time_s`.
    pub(super) fn dipoles(&self, time_s: f64) -> Dipoles {
        self.propagator.sources.dipoles(self.configuration, time_s)
    }

    /// Mass properties at `time_s` without the propellant used, panels at angle 0.
    pub(super) fn used_mass(&self, wet: &MassProperties, time_s: f64) -> MassProperties {
        self.thrusters.propellant.mass_properties(wet, &self.allocator.settings.tanks, time_s)
    }

    /// Frame and rate that this guidance commands where the flight begins.
    pub(super) fn frame_by(&mut self, law: &Guided, time_s: f64) -> Result<MovingFrame, PlantError> {
        self.models.begin_work(self.given.work_limit);
        let mut plant = self.plant();
        plant.prepare(time_s, time_s)?;
        Ok(plant.path.attitude_by(law, time_s).frame)
    }

    /// Selects the Sun's direction where a downlink has begun at `start`, or began right there and its momentum changed since;
    /// where it is over, the next one may select. A downlink of the timeline is planned as long as the windows'. Science that
    /// unloads is alike. Where a flight begins nothing is forecast, and a downlink that has begun before keeps its
    /// default attitude; science that has is planned for its remaining time.
    pub(super) fn select_sun_direction(&mut self, start: &SunSelectionStart) -> Result<(), PlantError> {
        let SunSelectionStart { time_s, is_first, .. } = *start;
        let Some(law) = self.configuration.attitude.guided().copied().filter(|law| law.managed) else {
            return Ok(());
        };
        let Some(guided) = self.plant().path.guided_attitude(time_s) else { return Ok(()) };
        let downlink = guided.window.activity == Activity::Downlink;
        let gimbal = match law.science {
            ScienceRule::Unloading { gimbal, .. } if !downlink => Some(gimbal),
            _ => None,
        };
        let has_place = downlink || gimbal.is_some();
        let choice = &mut self.propagator.sun_choice;
        let is_due = choice.is_due(downlink, guided.row);
        let is_anew = has_place && choice.in_force == downlink && choice.chosen_s == Some(time_s);
        if !(is_due || is_anew || (is_first && gimbal.is_some())) {
            return Ok(());
        }
        choice.in_force = downlink;
        if !has_place {
            return Ok(());
        }
        if downlink {
            choice.row = guided.row;
        }
        // A dump at the very start changes nothing of it.
        choice.chosen_s = (!is_first).then_some(time_s);
        let epoch_minus_time_s = self.configuration.epoch_minus_time_s;
        let now_epoch_s = time_s + epoch_minus_time_s;
        let (law, until_s) = match downlink && guided.row != 0 {
            true => {
                let schedule = law.schedule.begun_at(now_epoch_s);
                (Guided { schedule, ..law }, time_s + schedule.downlink_s())
            }
            false => (law, end_epoch_s(&law.schedule, &guided.window, now_epoch_s) - epoch_minus_time_s),
        };
        let since_s = guided.window.since_s - epoch_minus_time_s;
        let is_under_way = is_first && downlink && since_s < time_s - EPOCH_ROUNDING_S;
        let is_ahead = until_s.is_finite() && until_s > time_s && !is_under_way;
        let chosen = if is_ahead { self.plan_sun_direction(start, law, gimbal, until_s)? } else { None };
        let selected = &mut self.propagator.sun_choice.selected;
        *(if downlink { &mut selected.downlink } else { &mut selected.science }) = chosen;
        self.propagator.command_slews.cut(time_s);
        Ok(())
    }

    /// Direction of the Sun that the planner selects for a window up to `until_s`, of science that unloads with the gimbal of its
    /// camera; `None`: on -Y.
    fn plan_sun_direction(
        &mut self,
        start: &SunSelectionStart,
        law: Guided,
        gimbal: Option<Gimbal>,
        until_s: f64,
    ) -> Result<Option<SelectedSunDirection>, PlantError> {
        let time_s = start.time_s;
        let mut plant = self.plant();
        let instant = plant.instant(time_s);
        let pressure_pa = plant.path.configuration.light.pressure_pa(instant.sun_distance_m);
        let separations_rad = plant.path.separations_rad(time_s, until_s);
        let science = gimbal.map(|gimbal| plant.path.science_arc(gimbal, time_s, until_s));
        if science.is_some() {
            self.models.spend(WorkKind::Search, SCIENCE_UNITS, time_s)?;
        }
        let planner = self.given.planner;
        let mut downlink_forecast = DownlinkForecast {
            flight: self,
            law,
            begin: *start,
            span_s: until_s - time_s,
            to_sun: instant.geometry.to_sun.position_m.normalize(),
            to_earth: instant.geometry.to_earth.position_m.try_normalize(0.0),
            sun_distance_m: instant.sun_distance_m,
            pressure_pa,
            separations_rad,
            science,
        };
        planner(&mut downlink_forecast)
    }

    /// Integrates the deviation of the orbit under thrust over the present segment of the motion, and with Encke's method under the
    /// disturbances of `interval` at this mass.
    pub(super) fn integrate_thrust(
        &mut self,
        motion: &GyrostatMotion,
        interval: &DisturbanceInterval,
        mass_kg: f64,
    ) -> Result<(), PlantError> {
        let (load, configuration) = (&self.thrusters.load, &*self.configuration);
        let trajectory = &mut self.propagator.trajectory;
        let span = Span::new(motion.start_s(), motion.end_s());
        let (thrusts, disturbed) = (!load.law.is_none(), configuration.uses_encke());
        if !thrusts && disturbed && trajectory.is_deviated_until(span.end_s) {
            return Ok(());
        }
        let applied = disturbed.then(|| (self.given.external)(span.start_s));
        let acceleration_m_s2 = (thrusts || disturbed).then_some(|time_s: f64| {
            let mut acceleration_body_m_s2 = Vector3::zeros();
            if thrusts {
                acceleration_body_m_s2 += load.acceleration_body_m_s2(time_s);
            }
            if let Some(applied) = &applied {
                acceleration_body_m_s2 += interval.force_body_n(applied, span.start_s, time_s) / mass_kg;
            }
            motion.attitude_at(time_s).inertial_from_body(&acceleration_body_m_s2)
        });
        Ok(trajectory.accelerate(configuration, span, acceleration_m_s2)?)
    }

    /// The plant in the attitude of its configuration.
    pub(super) fn plant(&mut self) -> Plant<'_> {
        let Self { given, configuration, current_mass_panels_stowed, models, propagator, turning, .. } = self;
        let (current_mass_panels_stowed, turning) = (**current_mass_panels_stowed, *turning);
        let settings = PlantSettings { configuration, current_mass_panels_stowed, turning };
        Plant::new(given.prepared, settings, models, propagator, given.external)
    }

    /// The plant with the body as it turns at `time_s`.
    pub(super) fn plant_at(&mut self, time_s: f64, body: &BodyMotion) -> Plant<'_> {
        self.turning_plant(time_s, body, [Vector3::zeros(); 2])
    }

    /// The same, its rate changing by these terms of its series, in rad/s2 and rad/s3.
    pub(super) fn turning_plant(
        &mut self,
        time_s: f64,
        body: &BodyMotion,
        rate_terms_body: [Vector3<f64>; 2],
    ) -> Plant<'_> {
        let motion = Command {
            attitude: Attitude::from_unit(body.attitude),
            rate_body_rad_s: body.rate_body_rad_s,
            since_s: time_s,
        };
        self.turning = Turning { motion, rate_terms_body };
        self.plant()
    }
}
