//! Spacecraft that is sized: the FMU of a file, its spacecraft, and the values that it is simulated with.

use campaign::run::{Run, Simulated};
use files::Scratch;
use fmi::{Fmu, Instance, Value};
use inputs::{kind::FileKind, mission::Inputs, variables::assigned};
use nalgebra::Vector3;
use packing::{
    assembly::{Parts, Source, assemble, spacecraft_of},
    instance::{self, vector},
};
use physics::{
    bodies::Body,
    constants::DAY_S,
    spacecraft::{SlewDemand, Spacecraft},
};

use super::options::Size;
use crate::{Failure, momentum::plant::StartValues, simulation::Simulation};

/// The model that is simulated.
const MODEL: &str = "MomentumPlant";
/// Variable of the phase of guided flight.
const PHASE: &str = "guided.phase";
/// A year, in s.
pub(super) const YEAR_S: f64 = 365.25 * DAY_S;

/// Longest flight, in years: its columns are in memory whole.
const MAX_YEARS: f64 = 50.0;

/// A spacecraft ready for simulation.
pub(super) struct SizedSpacecraft {
    pub simulation: Simulation,
    pub spacecraft: Spacecraft,
    pub span_s: f64,
    /// Period of the orbit at the start, in s.
    pub period_s: f64,
    /// Time between unloadings, in s.
    pub every_s: f64,
    /// Slew about every axis; `None`: none.
    pub slew: Option<SlewDemand>,
    /// Momentum of the wheels' bias, body frame, in N m s.
    pub bias_n_m_s: Vector3<f64>,
    /// Whether `momentum.*` are integrals of body components.
    pub is_body_integral: bool,
    /// Strategies of unloading by sunlight where there are downlinks, by item; the first is dumps alone.
    pub strategies: &'static [&'static str],
}

/// Packs a file; whether it is a mission with inputs, timeline or ephemeris, which are those of its own time.
fn opened(arguments: &Size, file: &str) -> Result<(Simulation, bool), Failure> {
    let text = files::read_text(&arguments.file)?;
    if FileKind::recognize(&text) != Some(FileKind::Mission) {
        FileKind::Spacecraft.check(file, &text)?;
        let source = Source::open(arguments.template.as_deref(), &[])?;
        let parts = Parts { spacecraft: Some(&arguments.file), model: Some(MODEL), ..Parts::default() };
        let folder = Scratch::new()?;
        assemble(&source, &parts)?.entries.write_below(folder.path())?;
        let fmu = Fmu::open(folder.path())?;
        return Ok((Simulation::new(fmu, Some(folder), [0.0, YEAR_S]), false));
    }
    let (fmu, template) = (arguments.file.clone(), arguments.template.clone());
    let simulated = Simulated::new(&Run { fmu, template, ..Run::default() })?;
    let mut simulation = Simulation::open(&simulated, "a spacecraft or an FMU")?;
    let is_of_its_time = simulated.mission.as_ref().is_some_and(|mission| {
        let has_table = matches!(mission.inputs, Some(Inputs::File(_))) || simulation.inputs.is_some();
        mission.fmu.is_none() && (mission.timeline.is_some() || mission.ephemeris.is_some() || has_table)
    });
    if !is_of_its_time {
        simulation.stop_s = simulation.start_s + YEAR_S;
    }
    Ok((simulation, is_of_its_time))
}

impl SizedSpacecraft {
    /// Reads the file, packs it and starts it once.
    pub(super) fn open(arguments: &Size) -> Result<Self, Failure> {
        let file = arguments.file.display().to_string();
        let (mut simulation, is_of_its_time) = opened(arguments, &file)?;
        let description = simulation.fmu.description();
        simulation.sets.extend(assigned(description, &arguments.set)?);
        let Simulation { start_s, stop_s, .. } = simulation;
        let values = simulation.values();
        check_plant(&file, &values)?;
        let mut started = instance::started(&simulation.fmu, "size", start_s, values.sets)?;
        let period_s = period_s(values.item("orbit.center") == Some("sun"), &mut started)?;
        // As it acts: by default it follows the centre.
        let phase = description.variables.iter().find(|it| it.name == PHASE);
        let phase = phase.map(|it| started.get_variable(it)).transpose()?;
        let phase: Vec<_> = phase.into_iter().map(|value| (PHASE.to_owned(), value)).collect();
        let is_in_cruise = StartValues { description, sets: &phase }.item(PHASE) == Some("cruise");
        let bias_n_m_s = vector(&mut started, "momentum.bias")?;
        drop(started);
        let span_s = arguments.duration.unwrap_or(stop_s - start_s);
        if span_s > MAX_YEARS * YEAR_S {
            let [found, most] = [span_s / YEAR_S, MAX_YEARS].map(terminal::short);
            let what = format!("found a flight of {found} years, allowed: up to {most}: --duration");
            return Err(format!("{file}: {what}").into());
        }
        let spacecraft = spacecraft_of(&simulation.fmu)?;
        let by_file_s = spacecraft.unload_every.map(|every| every.in_orbit_s(period_s));
        let has_fan = spacecraft.antennas.iter().any(|named| named.antenna.fan().is_some());
        if arguments.years.is_some() && is_of_its_time {
            let allowed = "a mission without inputs, timeline and ephemeris, which are those of its own time";
            return Err(
                format!("{file}: --years: found a mission of its own time, allowed: {allowed}").into()
            );
        }
        Ok(Self {
            span_s,
            period_s,
            every_s: arguments.every.or(by_file_s).unwrap_or(DAY_S),
            slew: arguments.slew.or(spacecraft.slew),
            bias_n_m_s,
            is_body_integral: values.item("momentum.convention") == Some("bodyIntegral"),
            strategies: strategies(&values, period_s, has_fan && !is_in_cruise),
            spacecraft,
            simulation,
        })
    }

    /// An instance that has just been initialised.
    pub(super) fn started(&self) -> Result<Instance, fmi::Error> {
        instance::started(&self.simulation.fmu, "size", self.simulation.start_s, &self.simulation.sets)
    }

    /// Whether the file or the call gives a variable, or an element of it, a value.
    pub(super) fn says(&self, name: &str) -> bool {
        let is_it =
            |given: &str| given == name || given.strip_prefix(name).is_some_and(|it| it.starts_with('['));
        self.simulation.sets.iter().any(|(given, _)| is_it(given))
            || self.spacecraft.start.iter().any(|entry| is_it(&entry.name))
    }

    /// Values set in the last year of a mission of `years`.
    pub(super) fn last_year(&self, years: f64, end: &[String]) -> Result<Vec<(String, Value)>, Failure> {
        let first_s = self.started()?.get_real("start.epoch")?;
        let mut sets = vec![("start.epoch".to_owned(), Value::Real(first_s + (years - 1.0) * YEAR_S))];
        sets.extend(assigned(self.simulation.fmu.description(), end)?);
        Ok(sets)
    }

    /// Scales a figure of a flight to a year.
    pub(super) fn per_year(&self, of_flight: f64) -> f64 {
        of_flight * YEAR_S / self.span_s
    }
}

/// A plant whose momentum is guided; in controlled and free flight a year takes too long.
fn check_plant(file: &str, values: &StartValues<'_>) -> Result<(), Failure> {
    let model = &values.description.model_name;
    match values.item("attitude.source") {
        None => Err(format!("{file}: found the model {model}, allowed: {MODEL}").into()),
        Some(source @ ("controlled" | "free")) => Err(format!(
            "{file}: attitude.source: found {source}, allowed: guided, commanded (a year of wheels at 50 Hz takes hours): \
             --set attitude.source=guided"
        )
        .into()),
        Some(_) => Ok(()),
    }
}

/// Period of the orbit at the start.
fn period_s(is_about_sun: bool, instance: &mut Instance) -> Result<f64, fmi::Error> {
    let gm_m3_s2 = match is_about_sun {
        true => Body::Sun.data().gm_m3_s2,
        false => instance.get_real("planet.gravitationalParameter")?,
    };
    Ok(core::f64::consts::TAU * (instance.get_real("orbit.semiMajorAxis")?.powi(3) / gm_m3_s2).sqrt())
}

/// Dumps alone, and what sunlight can do where guided flight has downlinks with science between them, of an antenna that is steered
/// (`can_choose`).
fn strategies(values: &StartValues<'_>, period_s: f64, can_choose: bool) -> &'static [&'static str] {
    let number = |name: &str| values.real_or(name, 0.0);
    let window_s = number("guided.downlinkEnd") - number("guided.downlinkStart");
    let has_science = (0.0..number("guided.downlinkEvery") * period_s).contains(&window_s);
    let is_guided = values.item("attitude.source") == Some("guided");
    if has_science && is_guided && can_choose {
        &["dumpsOnly", "reactive", "predictive"]
    } else {
        &["dumpsOnly"]
    }
}
