//! Flights of the mission's FMU with any centre of mass and factor of sunlight, without dumps by threshold.

use std::cell::Cell;

use campaign::run::{Run, Simulated};
use fmi::{Ended, InputTable, Value};
use inputs::variables::{NEVER_N_M_S, elements, numbers, real, vectors};
use model_description::Description;
use nalgebra::Vector3;
use packing::assembly::spacecraft_of;
use physics::constants::DAY_S;
use terminal::ProgressBar;

use super::options::Refit;
use crate::{
    Failure,
    momentum::plant::StartValues,
    refit::{FITTED, Flights, History, MOMENTUM, Parameters, Telemetry},
    simulation::{Flight, Simulation},
};

/// The model that is simulated.
const MODEL: &str = "MomentumPlant";
const DUMPS: &str = "dump.count";
const SOURCE: &str = "attitude.source";
const STRATEGY: &str = "momentum.strategy";
const THRESHOLD: &str = "dump.threshold";
/// Standard deviations that are drawn by a seed: flights of a history are without, as it does not know them.
const DRAWN: [&str; 5] = [
    "spacecraft.centerOfMassShift[1]",
    "spacecraft.centerOfMassShift[2]",
    "spacecraft.centerOfMassShift[3]",
    "maneuver.magnitudeError",
    "maneuver.directionError",
];

/// A mission ready to be simulated.
pub(super) struct RefitMission {
    simulation: Simulation,
    /// Time of flights that are over, in s, and the bar that it is shown by.
    simulated_s: Cell<f64>,
    pub bar: ProgressBar,
}

impl RefitMission {
    /// Reads the mission and packs its files.
    pub(super) fn open(arguments: &Refit) -> Result<(Self, Simulated), Failure> {
        let file = arguments.mission.display().to_string();
        if arguments.mission.extension().is_none_or(|it| !it.eq_ignore_ascii_case("toml")) {
            let allowed = "allowed: a mission: see `heliotorque new mission`";
            return Err(format!("{file}: found no TOML file, {allowed}").into());
        }
        let template = arguments.template.clone();
        let run = Run { fmu: arguments.mission.clone(), template, ..Run::default() };
        let simulated = Simulated::new(&run)?;
        let mut simulation = Simulation::open(&simulated, &format!("a {MODEL}"))?;
        let Simulation { fmu, sets, inputs, step_s, .. } = &mut simulation;
        check_plant(&file, &StartValues { description: fmu.description(), sets })?;
        check_inputs(&file, fmu.description(), inputs.as_ref())?;
        let is_drawn = |name: &str| fmu.variable(name).is_ok_and(|it| fmi::set_early(it).is_ok());
        let drawn = DRAWN.iter().filter(|name| is_drawn(name));
        sets.extend(drawn.map(|name| ((*name).to_owned(), Value::Real(0.0))));
        // Inputs change at the mission's steps alone; without any, a flight does not depend on them.
        if inputs.is_none() {
            *step_s = step_s.max(DAY_S);
        }
        Ok((Self { simulation, simulated_s: Cell::new(0.0), bar: ProgressBar::hidden() }, simulated))
    }

    /// The values that the mission sets.
    pub(super) fn prior(&self) -> Result<Parameters, Failure> {
        let value = |name: &str| {
            real(self.simulation.fmu.description(), &self.simulation.sets, name)
                .ok_or_else(|| format!("{MODEL} has no value of {name}, allowed: one in the mission's [set]"))
        };
        let [x, y, z, scale] = FITTED.map(value);
        Ok(Parameters { center_of_mass_body_m: Vector3::new(x?, y?, z?), solar_scale: scale? })
    }

    /// Name of the spacecraft that is simulated.
    pub(super) fn spacecraft_name(&self) -> Result<String, Failure> {
        Ok(spacecraft_of(&self.simulation.fmu).map_err(|error| error.to_string())?.name)
    }

    /// Refuses rows before and after the mission.
    pub(super) fn check_times(&self, file: &str, telemetry: &Telemetry) -> Result<(), String> {
        let Simulation { start_s, stop_s, .. } = self.simulation;
        let outside = telemetry.times_s.iter().position(|at_s| !(start_s..=stop_s).contains(at_s));
        let Some(row) = outside else { return Ok(()) };
        let [at, start, stop] = [telemetry.times_s[row], start_s, stop_s].map(terminal::short);
        let line = telemetry.lines[row];
        Err(format!(
            "{file}:{line}: time: found {at} s, allowed: times of the mission, from {start} s to {stop} s"
        ))
    }

    /// Span of one flight over the rows, in s.
    pub(super) fn span_s(&self, telemetry: &Telemetry) -> f64 {
        telemetry.times_s.last().map_or(0.0, |last_s| last_s - self.simulation.start_s)
    }
}

impl Flights for RefitMission {
    fn simulate(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, Failure> {
        let Simulation { start_s, stop_s, step_s, .. } = self.simulation;
        let values: [f64; 4] = parameters.values().into();
        let fitted = FITTED.iter().zip(values).map(|(name, value)| ((*name).to_owned(), Value::Real(value)));
        let sets: Vec<_> = fitted.chain(elements(THRESHOLD, Vector3::repeat(NEVER_N_M_S))).collect();
        let last_s = times_s.last().copied().unwrap_or(stop_s);
        let before_s = self.simulated_s.get();
        let flown = self.simulation.fly(&Flight {
            sets: &sets,
            outputs: &["momentum.inertial", DUMPS],
            step_s: Some(step_s.min(last_s - start_s)),
            at_s: Some(times_s),
            stop_s: Some(last_s),
            dumps_apart: false,
            progress: Some(&|time_s| self.bar.set_position((before_s + time_s - start_s) as u64)),
        })?;
        self.simulated_s.set(before_s + last_s - start_s);
        let recording = flown.recording;
        if flown.ended? != Ended::AtStop || recording.times_s.len() != times_s.len() {
            let at = terminal::short(recording.times_s.last().copied().unwrap_or(start_s));
            let last = terminal::short(last_s);
            return Err(format!(
                "the flight ended by itself after {at} s, allowed: one up to the last row, {last} s"
            )
            .into());
        }
        Ok(History {
            momentum_inertial_n_m_s: vectors(&recording, "momentum.inertial")?,
            dumps: numbers(&recording, DUMPS)?.into_iter().map(|count| count as i32).collect(),
        })
    }
}

/// A plant whose attitude is followed whatever the momentum is.
fn check_plant(file: &str, values: &StartValues<'_>) -> Result<(), String> {
    let model = &values.description.model_name;
    let variable = |name: &str| values.description.variables.iter().find(|it| it.name == name);
    let names = [SOURCE, STRATEGY, DUMPS].into_iter().chain(FITTED).chain(MOMENTUM);
    if let Some(name) = names.into_iter().find(|name| variable(name).is_none()) {
        return Err(format!("{file}: {model} has no variable {name}, allowed: a {MODEL}"));
    }
    let is_fixed = |name: &str| variable(name).is_some_and(|it| fmi::set_early(it).is_err());
    if let Some(name) = FITTED.into_iter().find(|name| is_fixed(name)) {
        return Err(format!(
            "{file}: {name}: found a constant of {model} (`pack --fix`), allowed: a parameter"
        ));
    }
    let source = values.item(SOURCE);
    if let Some(found @ ("controlled" | "free")) = source {
        return Err(format!(
            "{file}: {SOURCE}: found {found}, allowed: guided, commanded, in which momentum is linear in what is fitted"
        ));
    }
    let strategy = values.item(STRATEGY);
    if let (Some("guided"), Some(found @ ("reactive" | "predictive"))) = (source, strategy) {
        return Err(format!(
            "{file}: {STRATEGY}: found {found}, allowed: dumpsOnly: the attitude that the spacecraft had must not follow the \
             momentum that is fitted; give the Sun's places as they were (timeline, downlink.*)"
        ));
    }
    Ok(())
}

/// Checks that fitted variables have one value, and that thresholds are off.
fn check_inputs(file: &str, description: &Description, inputs: Option<&InputTable>) -> Result<(), String> {
    let positions = inputs.into_iter().flat_map(InputTable::positions);
    let names = positions.map(|position| &description.variables[position].name);
    let mut over_time = names.filter(|name| FITTED.contains(&name.as_str()) || name.starts_with(THRESHOLD));
    over_time.next().map_or(Ok(()), |name| {
        Err(format!("{file}: inputs: found {name} over time, allowed: one value of it, in [set]"))
    })
}
