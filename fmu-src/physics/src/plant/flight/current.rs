//! Where the body flies: everything that its loads follow from, with the attitude that dynamics give it.

use nalgebra::Vector3;

use crate::attitude::{Attitude, BodyMotion, GyrostatMotion, MovingFrame};
use crate::environment::ephemeris::Ephemeris;
use crate::guidance::{Activity, Schedule, ScienceRule, Window};
use crate::momentum::{TorqueModel, Totals};
use crate::propulsion::PropellantState;
use crate::spacecraft::MassProperties;

use super::outlook::{Outlook, StartMomentum, SunPlanner};
use super::propagator_state::PropagatorState;
use crate::plant::disturbances::evaluation::{ExternalLoad, Plant, PreparedSpacecraft};
use crate::plant::light::radiation_solver::RadiationSolver;
use crate::plant::motion::panel_motion::PanelMotion;
use crate::plant::settings::configuration::{AttitudeSource, Command, Configuration, DynamicAttitude};
use crate::plant::settings::error::PlantError;
use crate::plant::settings::work::{Cost, Work};
use crate::plant::thrusters::thruster_load::ThrusterLoad;

/// Units of a choice for science that unloads: each of its trials goes through all of it.
const SCIENCE_UNITS: u32 = 50_000;
/// A window computed in epochs begins this near its number in flight time, in s.
const EPOCH_ROUNDING_S: f64 = 1e-6;

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
    /// Who chooses the Sun's place in downlinks and in science that unloads; asked where the guidance is managed.
    pub planner: &'f dyn SunPlanner,
}

impl Flight<'_> {
    /// Frame and rate that the orbit phase's own guidance commands where the flight begins; `None` without it.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn guided_start(&mut self, time_s: f64, work_limit: u32) -> Result<Option<MovingFrame>, PlantError> {
        let mut plant = self.as_configured(work_limit);
        plant.prepare(time_s, time_s)?;
        Ok(plant.guided_attitude(time_s).map(|guided| guided.frame))
    }

    /// Chooses the Sun's place where a downlink has begun at `time_s`, or began right there and its momentum is another since;
    /// where it is over, the next one may choose. Science that unloads is alike. At the `first` time of a flight nothing is forecast,
    /// and a downlink that has begun before keeps its default attitude; science that has is chosen for what is left of it.
    ///
    /// # Errors
    /// What ends a flight.
    pub(crate) fn choose_sun_place(
        &mut self,
        time_s: f64,
        totals: &Totals,
        momentum: StartMomentum,
        first: bool,
        work: &mut Work,
    ) -> Result<(), PlantError> {
        let Some(law) = self.configuration.attitude.guided().copied().filter(|law| law.managed) else {
            return Ok(());
        };
        let mut plant = self.after(*work);
        let Some(guided) = plant.guided_attitude(time_s) else { return Ok(()) };
        let downlink = guided.window.activity == Activity::Downlink;
        let camera = match law.science {
            ScienceRule::Unloading { camera, .. } if !downlink => Some(camera),
            _ => None,
        };
        let has_place = downlink || camera.is_some();
        let choice = &mut self.propagator.sun_choice;
        let is_anew = has_place && choice.in_force == downlink && choice.chosen_s == Some(time_s);
        if !(choice.is_due(downlink) || is_anew || (first && camera.is_some())) {
            return Ok(());
        }
        choice.in_force = downlink;
        if !has_place {
            return Ok(());
        }
        // A dump at the very start changes nothing of it.
        choice.chosen_s = (!first).then_some(time_s);
        let epoch_minus_time_s = self.configuration.epoch_minus_time_s;
        let until_s =
            end_epoch_s(&law.schedule, &guided.window, time_s + epoch_minus_time_s) - epoch_minus_time_s;
        let since_s = guided.window.since_s - epoch_minus_time_s;
        let is_under_way = first && downlink && since_s < time_s - EPOCH_ROUNDING_S;
        let chosen = if until_s.is_finite() && until_s > time_s && !is_under_way {
            let planner = self.planner;
            let mut plant = self.after(*work);
            let instant = plant.instant(time_s);
            let pressure_pa = plant.pressure_pa(&instant);
            let separations_rad = plant.separations_rad(time_s, until_s);
            let science = camera.map(|camera| plant.science_course(camera, time_s, until_s));
            if science.is_some() {
                work.spend(Cost::Search, SCIENCE_UNITS, self.ephemeris.evaluations(), time_s)?;
            }
            let mut outlook = Outlook {
                prepared: self.prepared,
                configuration: self.configuration,
                propagator: self.propagator,
                ephemeris: self.ephemeris,
                light: self.light.as_deref_mut(),
                applied: (self.external)(time_s),
                law,
                totals: *totals,
                forecasts: !first,
                work,
                time_s,
                span_s: until_s - time_s,
                momentum,
                to_sun: instant.geometry.to_sun.position_m.normalize(),
                to_earth: instant.geometry.to_earth.position_m.try_normalize(0.0),
                pressure_pa,
                separations_rad,
                science,
            };
            planner.choose(&mut outlook)?
        } else {
            None
        };
        let choice = &mut self.propagator.sun_choice;
        if downlink {
            choice.chosen = chosen;
        } else {
            choice.science = chosen;
        }
        self.configuration.attitude.set_sun_places(choice.place(), choice.in_science());
        Ok(())
    }

    /// Thrust over the present segment of the motion moves the spacecraft off the orbit that was computed ahead.
    ///
    /// # Errors
    /// What ends a flight.
    pub(crate) fn take_thrust(
        &mut self,
        load: &ThrusterLoad,
        motion: &GyrostatMotion,
    ) -> Result<(), PlantError> {
        let thrust_m_s2 = (!load.law.is_none()).then_some(|time_s: f64| {
            motion.attitude_at(time_s).inertial_from_body(&load.acceleration_body_m_s2(time_s))
        });
        let (trajectory, method) = (&mut self.propagator.trajectory, self.prepared.orbit_method);
        let span_s = [motion.start_s(), motion.end_s()];
        Ok(trajectory.accelerate(self.configuration, method, span_s, thrust_m_s2)?)
    }

    /// Mass properties with the panels as they stand where the flight begins in this attitude.
    pub fn mass_at_start(&mut self, time_s: f64, attitude: Attitude) -> MassProperties {
        let body = BodyMotion {
            attitude: attitude.unit_quaternion(),
            rate_body_rad_s: Vector3::zeros(),
            momentum_inertial_n_m_s: Vector3::zeros(),
            delta_v_inertial_m_s: Vector3::zeros(),
        };
        let mut plant = self.plant_at(time_s, &body);
        let instant = plant.instant(time_s);
        plant.mass_properties(&instant, time_s)
    }

    /// The panels as their laws turn them where the flight begins in this attitude and at this rate.
    pub fn panels_at_start(
        &mut self,
        time_s: f64,
        attitude: Attitude,
        rate_body_rad_s: Vector3<f64>,
    ) -> PanelMotion {
        let body = BodyMotion {
            attitude: attitude.unit_quaternion(),
            rate_body_rad_s,
            momentum_inertial_n_m_s: Vector3::zeros(),
            delta_v_inertial_m_s: Vector3::zeros(),
        };
        let mut plant = self.plant_at(time_s, &body);
        let instant = plant.instant(time_s);
        PanelMotion::at_start(plant.hinged(), &instant, time_s)
    }

    /// The plant with the body as it turns now, where work is not counted.
    pub(crate) fn plant_at(
        &mut self,
        time_s: f64,
        body: &BodyMotion,
    ) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        let work = Work::new(u32::MAX, self.ephemeris.evaluations());
        self.plant(time_s, body, work)
    }

    /// The plant with the body as it turns now, the step having cost this much.
    pub(crate) fn plant(
        &mut self,
        time_s: f64,
        body: &BodyMotion,
        work: Work,
    ) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        self.turning_plant(time_s, body, [Vector3::zeros(); 2], work)
    }

    /// The same, its rate changing by these terms of its series, in rad/s2 and rad/s3.
    pub(crate) fn turning_plant(
        &mut self,
        time_s: f64,
        body: &BodyMotion,
        rate_terms_body: [Vector3<f64>; 2],
        work: Work,
    ) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        let motion = Command {
            attitude: Attitude::from_unit(body.attitude),
            rate_body_rad_s: body.rate_body_rad_s,
            since_s: time_s,
        };
        let guided = self.configuration.attitude.guided().copied();
        self.configuration.attitude =
            AttitudeSource::Dynamic(DynamicAttitude { motion, rate_terms_body, guided });
        self.after(work)
    }

    /// The plant in the attitude of its configuration, at the beginning of a step.
    pub(crate) fn as_configured(&mut self, work_limit: u32) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        let work = Work::new(work_limit, self.ephemeris.evaluations());
        self.after(work)
    }

    /// The plant in the attitude of its configuration, the step having cost this much.
    pub(crate) fn after(&mut self, work: Work) -> Plant<'_, &dyn Fn(f64) -> ExternalLoad> {
        Plant::new(
            self.prepared,
            self.configuration,
            self.propagator,
            self.ephemeris,
            self.light.as_deref_mut(),
            self.external,
            work,
        )
    }

    /// A step begins: nothing spent of `limit` units of about a microsecond.
    pub fn begin_work(&mut self, limit: u32) -> Work {
        self.ephemeris.count_from_here();
        Work::new(limit, self.ephemeris.evaluations())
    }
}
