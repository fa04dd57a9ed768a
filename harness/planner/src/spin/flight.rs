//! A plan simulated pulse by pulse on the plant's physics, with everything as it is assumed.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use physics::{
    attitude::{RigidBodyState, angle_between_rad},
    spin::{
        burn_request::BurnRequest,
        plant::{Commands, Directions, MOST_WORK, MassSource, Plant, Sampling, Start},
        sequencer::{Phase, Sequencer},
        spinner::Spinner,
    },
};

use super::{Firing, PlanError, Task, TrainForecast};

/// Samples of a turn.
const SAMPLES: f64 = 16.0;
/// A step that ends this close to an edge, in turns, has found it.
const SAME_TURNS: f64 = 1e-9;
/// Turns that are followed after the last pulse.
const TURNS_AFTER: f64 = 3.0;

/// One pulse as it is simulated.
#[derive(Clone, Debug)]
pub struct Pulse {
    /// Opening of the valve, in s.
    pub time_s: f64,
    /// For which it is open, in s.
    pub on_time_s: f64,
    /// Thruster that fires.
    pub thruster: String,
    /// Since the last Sun crossing, at the opening, in s; `None` before any.
    pub after_sun_s: Option<f64>,
    /// Turn since the Sun stood in the sensor's slit, at the middle of the thrust, in rad.
    pub phase_rad: f64,
    /// Angular momentum's direction after it: the spin axis without nutation.
    pub axis_inertial: Vector3<f64>,
    /// After it, in rad.
    pub nutation_rad: f64,
}

/// Sample between and in pulses.
#[derive(Clone, Copy, Debug)]
pub struct SpinSample {
    /// In s.
    pub time_s: f64,
    /// In rad.
    pub nutation_rad: f64,
    /// Spin axis +Z.
    pub spin_axis_inertial: Vector3<f64>,
    /// In rad/s.
    pub spin_rate_rad_s: f64,
}

/// A simulated plan.
#[derive(Clone, Debug)]
pub struct SimulatedPlan {
    /// Direction of the axis before the first pulse.
    pub start_axis_inertial: Vector3<f64>,
    /// The pulses.
    pub pulses: Vec<Pulse>,
    /// Over the whole flight.
    pub samples: Vec<SpinSample>,
}

impl SimulatedPlan {
    /// Returns the direction of the axis after the last pulse.
    pub fn end_axis_inertial(&self) -> Vector3<f64> {
        self.pulses.last().map_or(self.start_axis_inertial, |pulse| pulse.axis_inertial)
    }

    /// From where the axis ends to the target, in rad.
    pub fn miss_rad(&self, task: &Task) -> f64 {
        angle_between_rad(&self.end_axis_inertial(), &task.geometry.target_inertial)
    }
}

/// How the plant starts.
fn start(spinner: &Spinner, task: &Task, row: &TrainForecast) -> Start {
    let (train, case) = (&row.train, &task.case);
    let (thruster, opposite_thruster, group) = match &task.actuator.firing {
        Firing::Group(name) => (1, 0, name.clone()),
        Firing::Thruster { number, opposite } => (*number, opposite.unwrap_or(0), String::new()),
    };
    Start {
        inertia_kg_m2: task.body.moments_kg_m2,
        products_kg_m2: task.body.products_kg_m2,
        mass_source: MassSource::Fixed,
        propellant_kg: task.body.propellant_kg,
        execution: spinner.execution(),
        spin_rate_rad_s: case.spin.rate_rad_s,
        attitude: task.attitude().0,
        nutation_rad: 0.0,
        nutation_phase_rad: 0.0,
        damper_time_constant_s: task.damper_time_constant_s,
        burn: Some(BurnRequest {
            shape: train.shape,
            timing: case.timing,
            start_s: 0.0,
            thruster,
            opposite_thruster,
            group,
            pulse_width_s: train.width_s(0),
            turns_per_pulse: train.turns_per_pulse(),
            count: i32::try_from(train.count).unwrap_or(i32::MAX),
            angle_rad: 0.0,
            resolution_s: task.resolution_s,
            target_inertial: task.geometry.burn_target_inertial(),
            spin_rate_error: 0.0,
            ratio_error: 0.0,
            ratio_uncertainty: 0.0,
            max_nutation_rad: 0.0,
            max_duration_s: 0.0,
        }),
        l1: None,
        sampling: Sampling::Spins,
        nominal_rate_rad_s: spinner.limits.spin_rate_rad_s(),
        seed: 1,
        work_limit: MOST_WORK,
    }
}

/// Simulates `row` to a few turns after its last pulse.
///
/// # Errors
/// A burn that the plant refuses, or that does not end.
pub(crate) fn simulated(
    spinner: &Spinner,
    task: &Task,
    row: &TrainForecast,
) -> Result<SimulatedPlan, PlanError> {
    let directions = Directions {
        sun_inertial: task.geometry.sun_inertial,
        earth_inertial: task.geometry.earth_inertial.unwrap_or_else(Vector3::zeros),
        star_inertial: Vector3::zeros(),
    };
    let plant = Plant::start(spinner, &start(spinner, task, row), directions, Commands::default(), 0.0)
        .map_err(failed)?;
    let period_s = task.case.spin.period_s();
    let latest_s = row.duration_s + 6.0 * period_s;
    let mut flyer = Flyer {
        spinner,
        task,
        period_s,
        flight: SimulatedPlan {
            start_axis_inertial: plant.state().momentum_inertial.normalize(),
            pulses: Vec::new(),
            samples: Vec::new(),
        },
        plant,
        opened: None,
    };
    flyer.sample();
    let mut step_s = period_s / SAMPLES;
    while flyer.phase() != Some(Phase::Done) {
        if flyer.plant.time_s > latest_s {
            return Err(failed(format_args!("the burn did not end within {latest_s:.1} s")));
        }
        step_s = if flyer.step(step_s)? { period_s / SAMPLES } else { 0.25 * step_s };
    }
    let end_s = flyer.plant.time_s + TURNS_AFTER * period_s;
    while flyer.plant.time_s < end_s {
        flyer.advance(flyer.plant.time_s + period_s / SAMPLES)?;
        flyer.sample();
    }
    Ok(flyer.flight)
}

fn failed(error: impl core::fmt::Display) -> PlanError {
    PlanError::Flight(error.to_string())
}

struct Flyer<'a> {
    spinner: &'a Spinner,
    task: &'a Task,
    period_s: f64,
    plant: Plant,
    flight: SimulatedPlan,
    /// The pulse under way.
    opened: Option<Pulse>,
}

impl Flyer<'_> {
    fn phase(&self) -> Option<Phase> {
        self.plant.sequencer.as_ref().map(|it| it.phase)
    }

    fn advance(&mut self, end_s: f64) -> Result<(), PlanError> {
        self.plant.advance(self.spinner, end_s).map_err(failed)
    }

    /// Takes a step of at most `step_s`, to the next edge if that is nearer. False, and nothing done, if an edge that was not
    /// known before lies within: a shorter step finds it.
    fn step(&mut self, step_s: f64) -> Result<bool, PlanError> {
        let Some(sequencer) = &self.plant.sequencer else { return Ok(true) };
        let seen = |sequencer: &Sequencer| 2 * sequencer.fired + u32::from(sequencer.is_firing());
        let (before, edge_s, now_s) = (seen(sequencer), sequencer.next_edge_s(), self.plant.time_s);
        let is_near = edge_s - now_s <= step_s;
        let end_s = if is_near { edge_s.max(now_s) } else { now_s + step_s };
        let kept = self.plant.clone();
        self.advance(end_s)?;
        let after = self.plant.sequencer.as_ref().map_or(before, seen);
        if after == before {
            self.sample();
            return Ok(true);
        }
        if after > before + 1 || !(is_near || step_s < SAME_TURNS * self.period_s) {
            self.plant = kept;
            return Ok(false);
        }
        if after % 2 == 1 {
            self.open(end_s)?;
        } else {
            self.close(end_s)?;
        }
        self.sample();
        Ok(true)
    }

    /// A pulse begins at `time_s`.
    fn open(&mut self, time_s: f64) -> Result<(), PlanError> {
        let Some(sequencer) = &self.plant.sequencer else { return Ok(()) };
        let k = sequencer.fired;
        let (burn, mask) = (&sequencer.burn, sequencer.mask());
        let about = burn.about_centre(k);
        let mut centred = self.plant.clone();
        centred.advance(self.spinner, time_s - about.start_s).map_err(failed)?;
        let sun = centred.state().attitude.body_from_inertial(&self.task.geometry.sun_inertial);
        let slit_rad = self.spinner.sun_sensor.azimuth_deg.to_radians();
        let last_s = self.plant.sensors.sun.last_s;
        self.opened = Some(Pulse {
            time_s,
            on_time_s: about.length_s(),
            thruster: self.name(mask),
            after_sun_s: last_s.map(|crossing_s| time_s - crossing_s),
            phase_rad: (slit_rad - sun.y.atan2(sun.x)).rem_euclid(TAU),
            axis_inertial: Vector3::zeros(),
            nutation_rad: f64::NAN,
        });
        Ok(())
    }

    /// The pulse under way ends at `time_s`; what it did is read when its thrust is gone.
    fn close(&mut self, time_s: f64) -> Result<(), PlanError> {
        let Some(mut pulse) = self.opened.take() else { return Ok(()) };
        let tail_s = self.plant.sequencer.as_ref().map_or(0.0, |sequencer| {
            sequencer.burn.valves.iter().map(|valve| valve.tail_off_s).fold(0.0, f64::max)
        });
        let mut later = self.plant.clone();
        later.advance(self.spinner, time_s + tail_s).map_err(failed)?;
        let state: RigidBodyState = later.state();
        pulse.axis_inertial = state.momentum_inertial.normalize();
        pulse.nutation_rad = state.nutation_rad(&later.motion.inertia);
        self.flight.pulses.push(pulse);
        Ok(())
    }

    /// A group's name where it fires whole, otherwise that of the thrusters.
    fn name(&self, mask: u32) -> String {
        if let Some(group) = self.spinner.groups.iter().find(|group| group.mask == mask)
            && matches!(self.task.actuator.firing, Firing::Group(_))
        {
            return group.name.clone();
        }
        let names = self.spinner.thrusters.iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1);
        names.map(|(_, thruster)| thruster.name.as_str()).collect::<Vec<_>>().join(" + ")
    }

    fn sample(&mut self) {
        let (state, inertia) = (self.plant.state(), &self.plant.motion.inertia);
        self.flight.samples.push(SpinSample {
            time_s: self.plant.time_s,
            nutation_rad: state.nutation_rad(inertia),
            spin_axis_inertial: state.attitude.spin_axis_inertial(),
            spin_rate_rad_s: inertia.spin_frame_from_body(&state.rate_rad_s(inertia)).z,
        });
    }
}
