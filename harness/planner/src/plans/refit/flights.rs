//! Flights of the mission's FMU with any centre of mass and factor of sunlight, without dumps by threshold.

use std::cell::Cell;

use campaign::run::{Run, Settings, Simulated};
use files::Scratch;
use fmi::{Ended, Fmu, InputTable, Options, Value};
use inputs::variables::{NEVER_N_M_S, elements, item, numbers, real, selected};
use model_description::Description;
use nalgebra::Vector3;
use packing::assembly::spacecraft_of;
use physics::constants::DAY_S;
use terminal::ProgressBar;

use super::options::Refit;
use crate::refit::{FITTED, Failure, Flights, History, MOMENTUM, Parameters, Telemetry};

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
    fmu: Fmu,
    sets: Vec<(String, Value)>,
    inputs: Option<InputTable>,
    start_s: f64,
    stop_s: f64,
    step_s: f64,
    /// Time of flights that are over, in s, and the bar that it is shown by.
    simulated_s: Cell<f64>,
    pub bar: ProgressBar,
    // A mission's packed FMU, as long as it is in use.
    _folder: Option<Scratch>,
}

impl RefitMission {
    /// Reads the mission and packs its files.
    pub(super) fn open(arguments: &Refit) -> Result<(Self, Simulated), Failure> {
        let file = arguments.mission.display().to_string();
        if arguments.mission.extension().is_none_or(|it| !it.eq_ignore_ascii_case("toml")) {
            return Err(format!(
                "{file}: found no TOML file, allowed: a mission: see `heliotorque new mission`"
            )
            .into());
        }
        let template = arguments.template.clone();
        let run = Run { fmu: arguments.mission.clone(), template, ..Run::default() };
        let simulated = Simulated::new(&run)?;
        let (fmu, Settings { times, mut sets, inputs, .. }, folder) =
            Settings::of_fmu(&simulated, &format!("a {MODEL}"))?;
        check_plant(&file, fmu.description(), &sets)?;
        check_inputs(&file, fmu.description(), inputs.as_ref())?;
        let is_drawn = |name: &str| fmu.variable(name).is_ok_and(|it| fmi::set_early(it).is_ok());
        sets.extend(
            DRAWN.iter().filter(|name| is_drawn(name)).map(|name| ((*name).to_owned(), Value::Real(0.0))),
        );
        let opened = Self {
            fmu,
            sets,
            start_s: times.start_s,
            stop_s: times.stop_s,
            // Inputs change at the mission's steps alone; without any, a flight does not depend on them.
            step_s: if inputs.is_some() { times.step_s } else { times.step_s.max(DAY_S) },
            inputs,
            simulated_s: Cell::new(0.0),
            bar: ProgressBar::hidden(),
            _folder: folder,
        };
        Ok((opened, simulated))
    }

    /// The values that the mission sets.
    pub(super) fn prior(&self) -> Result<Parameters, Failure> {
        let value = |name: &str| {
            real(self.fmu.description(), &self.sets, name)
                .ok_or_else(|| format!("{MODEL} has no value of {name}, allowed: one in the mission's [set]"))
        };
        let [x, y, z, scale] = FITTED.map(value);
        Ok(Parameters { center_of_mass_body_m: Vector3::new(x?, y?, z?), solar_scale: scale? })
    }

    /// Name of the spacecraft that is simulated.
    pub(super) fn spacecraft_name(&self) -> Result<String, Failure> {
        Ok(spacecraft_of(&self.fmu).map_err(|error| error.to_string())?.name)
    }

    /// Refuses rows before and after the mission.
    pub(super) fn check_times(&self, file: &str, telemetry: &Telemetry) -> Result<(), String> {
        let outside = telemetry.times_s.iter().position(|at_s| !(self.start_s..=self.stop_s).contains(at_s));
        let Some(row) = outside else { return Ok(()) };
        let [at, start, stop] = [telemetry.times_s[row], self.start_s, self.stop_s].map(terminal::short);
        let line = telemetry.lines[row];
        Err(format!(
            "{file}:{line}: time: found {at} s, allowed: times of the mission, from {start} s to {stop} s"
        ))
    }

    /// Span of one flight over the rows, in s.
    pub(super) fn span_s(&self, telemetry: &Telemetry) -> f64 {
        telemetry.times_s.last().map_or(0.0, |last_s| last_s - self.start_s)
    }
}

impl Flights for RefitMission {
    fn simulate(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, Failure> {
        let description = self.fmu.description();
        let mut sets = self.sets.clone();
        let values: [f64; 4] = parameters.values().into();
        sets.extend(FITTED.iter().zip(values).map(|(name, value)| ((*name).to_owned(), Value::Real(value))));
        sets.extend(elements(THRESHOLD, Vector3::repeat(NEVER_N_M_S)));
        let names: Vec<String> = MOMENTUM.iter().chain(&[DUMPS]).map(|name| (*name).to_owned()).collect();
        let last_s = times_s.last().copied().unwrap_or(self.stop_s);
        let before_s = self.simulated_s.get();
        let mut reported = |time_s: f64| {
            self.bar.set_position((before_s + time_s - self.start_s) as u64);
            true
        };
        let options = Options {
            start_s: Some(self.start_s),
            stop_s: Some(last_s),
            step_s: Some(self.step_s.min(last_s - self.start_s)),
            sets,
            inputs: self.inputs.as_ref(),
            record: Some(selected(description, &names, fmi::select_outputs)?),
            record_at_s: Some(times_s),
            progress: Some(&mut reported),
            ..Options::default()
        };
        let simulation = fmi::simulate(&self.fmu, options)?;
        self.simulated_s.set(before_s + last_s - self.start_s);
        let recording = simulation.recording;
        if simulation.ended != Ended::AtStop || recording.times_s.len() != times_s.len() {
            let at = terminal::short(recording.times_s.last().copied().unwrap_or(self.start_s));
            let last = terminal::short(last_s);
            return Err(format!(
                "the flight ended by itself after {at} s, allowed: one up to the last row, {last} s"
            )
            .into());
        }
        let [x, y, z] = MOMENTUM.map(|name| numbers(&recording, name));
        let (x, y, z) = (x?, y?, z?);
        Ok(History {
            momentum_inertial_n_m_s: (0..x.len()).map(|row| Vector3::new(x[row], y[row], z[row])).collect(),
            dumps: numbers(&recording, DUMPS)?.into_iter().map(|count| count as i32).collect(),
        })
    }
}

/// A plant whose attitude is followed whatever the momentum is.
fn check_plant(file: &str, description: &Description, sets: &[(String, Value)]) -> Result<(), String> {
    let model = &description.model_name;
    let variable = |name: &str| description.variables.iter().find(|it| it.name == name);
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
    let source = item(description, sets, SOURCE);
    if let Some(found @ ("controlled" | "free")) = source {
        return Err(format!(
            "{file}: {SOURCE}: found {found}, allowed: guided, commanded, in which momentum is linear in what is fitted"
        ));
    }
    let strategy = item(description, sets, STRATEGY);
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
