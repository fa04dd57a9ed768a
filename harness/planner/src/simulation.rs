//! A mission's FMU with its values, simulated again and again by instances that are reset.

use std::sync::{Mutex, PoisonError};

use campaign::run::{Settings, Simulated};
use files::Scratch;
use fmi::{Ended, Fmu, InputTable, Instance, InstanceOptions, Options, Recording, Value};
use inputs::variables::selected;
use isolation::interrupt;

use crate::{Failure, momentum::plant::StartValues};

/// A mission's FMU with its values.
pub(crate) struct Simulation {
    pub fmu: Fmu,
    pub sets: Vec<(String, Value)>,
    pub inputs: Option<InputTable>,
    pub start_s: f64,
    pub stop_s: f64,
    /// Its own communication step, in s.
    pub step_s: f64,
    // Idle instances, at most one for each thread.
    idle: Mutex<Vec<Instance>>,
    // The FMU's folder, as long as it is in use.
    _folder: Option<Scratch>,
}

/// Extent of one flight.
#[derive(Clone, Copy, Default)]
pub(crate) struct Flight<'a> {
    /// Values that win over those of all flights.
    pub sets: &'a [(String, Value)],
    /// Outputs, as `record` of a mission names them.
    pub outputs: &'a [&'a str],
    /// Distance of communication points, in s, no longer than the flight; otherwise that of all flights.
    pub step_s: Option<f64>,
    /// Rows at these times alone, in s, which grow from the start on; otherwise at communication points.
    pub at_s: Option<&'a [f64]>,
    /// End, in s; otherwise that of all flights.
    pub stop_s: Option<f64>,
    /// Whether every dump has a row of its own.
    pub dumps_apart: bool,
    /// Hears of the time in s after every step.
    pub progress: Option<&'a dyn Fn(f64)>,
}

/// A flight that came to its end, or an error that ended it, with what was recorded until then.
pub(crate) struct Flown {
    pub recording: Recording,
    pub ended: Result<Ended, String>,
}

impl Simulation {
    /// FMU with these values from a start to a stop.
    pub(crate) fn new(fmu: Fmu, folder: Option<Scratch>, [start_s, stop_s]: [f64; 2]) -> Self {
        let (sets, inputs, idle) = (Vec::new(), None, Mutex::default());
        Self { fmu, sets, inputs, start_s, stop_s, step_s: stop_s - start_s, idle, _folder: folder }
    }

    /// Packs a mission, or opens an FMU; `allowed` is said of a system.
    pub(crate) fn open(simulated: &Simulated, allowed: &str) -> Result<Self, Failure> {
        let (fmu, settings, folder) = Settings::of_fmu(simulated, allowed)?;
        let Settings { times, sets, inputs, .. } = settings;
        let opened = Self::new(fmu, folder, [times.start_s, times.stop_s]);
        Ok(Self { sets, inputs, step_s: times.step_s, ..opened })
    }

    /// Values that its flights start with.
    pub(crate) fn values(&self) -> StartValues<'_> {
        StartValues { description: self.fmu.description(), sets: &self.sets }
    }

    /// Simulates one flight.
    ///
    /// # Errors
    /// Settings that are refused before the first step, and Ctrl-C.
    pub(crate) fn fly(&self, flight: &Flight<'_>) -> Result<Flown, Failure> {
        let description = self.fmu.description();
        let counter = || description.variables.iter().position(|it| it.name == "dump.count");
        let mut goes_on = |time_s: f64| {
            flight.progress.iter().for_each(|progress| progress(time_s));
            !interrupt::raised()
        };
        let options = Options {
            start_s: Some(self.start_s),
            stop_s: Some(flight.stop_s.unwrap_or(self.stop_s)),
            step_s: Some(flight.step_s.unwrap_or(self.step_s)),
            sets: [&self.sets, flight.sets].concat(),
            inputs: self.inputs.as_ref(),
            record: Some(selected(description, flight.outputs, fmi::select_outputs)?),
            record_at_s: flight.at_s,
            apart: flight.dumps_apart.then(counter).flatten(),
            progress: Some(&mut goes_on),
            ..Options::default()
        };
        let mut instance = self.instance()?;
        let simulated = fmi::simulate_instance(&mut instance, options);
        if simulated.is_ok() {
            self.idle.lock().unwrap_or_else(PoisonError::into_inner).push(instance);
        }
        if interrupt::raised() {
            return Err("interrupted".into());
        }
        Ok(match simulated {
            Ok((recording, ended)) => Flown { recording, ended: Ok(ended) },
            Err(stopped) => Flown { ended: Err(fmi::Error::chain(&stopped)), recording: stopped.partial },
        })
    }

    /// An idle instance after a reset, which keeps its ephemeris cache; otherwise a new one.
    fn instance(&self) -> Result<Instance, fmi::Error> {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        match idle {
            Some(mut instance) => instance.reset().map(|()| instance),
            None => Instance::new(&self.fmu, "run", &InstanceOptions::default()),
        }
    }
}
