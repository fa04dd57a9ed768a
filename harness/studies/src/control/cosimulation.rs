//! Co-simulation: instances that hand each other their outputs at every communication point, and what is read of them.
//!
//! The exchange is Jacobi's: every input of a step is the output at its beginning, whichever instance is stepped first.

use loader::{Error, Fmu, Instance, InstanceOptions, Value};

use crate::settings::Settings;

/// An instance, and the outputs that are read of it.
pub struct Unit {
    instance: Instance,
    /// Positions in `ModelVariables`.
    outputs: Vec<usize>,
}

/// Positions of the variables that names of variables and vectors mean.
fn positions<S: AsRef<str>>(fmu: &Fmu, names: &[S]) -> Result<Vec<usize>, Error> {
    let found: Result<Vec<_>, _> = names.iter().map(|name| fmu.select(name.as_ref())).collect();
    Ok(found?.concat())
}

impl Unit {
    /// Initialized with parameters and first inputs; `outputs` are names of variables and vectors, read in this order.
    pub fn start<S: AsRef<str>>(
        fmu: &Fmu,
        parameters: &Settings,
        inputs: &Settings,
        outputs: &[S],
    ) -> Result<Self, Error> {
        let outputs = positions(fmu, outputs)?;
        let instance = Instance::new(fmu, fmu.name(), &InstanceOptions::default())?;
        let mut unit = Self { instance, outputs };
        unit.set(parameters)?;
        unit.instance.setup_experiment(None, 0.0, None)?;
        unit.instance.enter_initialization_mode()?;
        unit.set(inputs)?;
        unit.instance.exit_initialization_mode()?;
        Ok(unit)
    }

    /// Sets variables.
    pub fn set(&mut self, settings: &Settings) -> Result<(), Error> {
        settings.iter().try_for_each(|(name, value)| self.instance.set(name, value))
    }

    /// One step.
    pub fn step(&mut self, time_s: f64, step_s: f64) -> Result<(), Error> {
        self.instance.do_step(time_s, step_s, true)
    }

    /// The outputs now, every value as a number: of a flag 1 or 0, of an option its number.
    pub fn read(&mut self) -> Result<Vec<f64>, Error> {
        let outputs = std::mem::take(&mut self.outputs);
        let row = outputs.iter().map(|position| Ok(as_number(&self.value(*position)?))).collect();
        self.outputs = outputs;
        row
    }

    fn value(&mut self, position: usize) -> Result<Value, Error> {
        let fmu = self.instance.fmu().clone();
        self.instance.get_variable(&fmu.description().variables[position])
    }
}

fn as_number(value: &Value) -> f64 {
    match value {
        Value::Real(x) => *x,
        Value::Integer(number) => f64::from(*number),
        Value::Boolean(is) => f64::from(u8::from(*is)),
        Value::Text(_) => f64::NAN,
    }
}

/// The values of a row one after the other, as they were asked for.
pub struct Row<'a>(std::slice::Iter<'a, f64>);

impl<'a> Row<'a> {
    /// From the first value on.
    pub fn of(values: &'a [f64]) -> Self {
        Self(values.iter())
    }

    /// The next; not a number beyond the last.
    pub fn real(&mut self) -> f64 {
        self.0.next().copied().unwrap_or(f64::NAN)
    }

    /// The next `N`.
    pub fn vector<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.real())
    }

    /// Whether the next is true.
    pub fn flag(&mut self) -> bool {
        self.real() != 0.0
    }
}

/// Outputs of one unit and the inputs of another that get them: numbers of units, positions of variables.
pub struct Wires {
    from: (usize, Vec<usize>),
    to: (usize, Vec<usize>),
}

impl Wires {
    /// From one unit to another, by number, by pairs of names of variables or vectors.
    pub fn connect(
        (from, source): (usize, &Fmu),
        (to, sink): (usize, &Fmu),
        pairs: &[(&str, &str)],
    ) -> Result<Self, Error> {
        let (outputs, inputs): (Vec<_>, Vec<_>) = pairs.iter().copied().unzip();
        Ok(Self { from: (from, positions(source, &outputs)?), to: (to, positions(sink, &inputs)?) })
    }
}

/// How long is flown, in which steps, and how often a sample is taken, in s.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// From 0 on.
    pub stop_s: f64,
    /// Communication step.
    pub step_s: f64,
    /// A whole number of steps.
    pub sample_s: f64,
}

/// Flies `units` together. At every sample `inputs` says what is set on which unit, from the time and every unit's
/// outputs, and `sample` takes what is kept.
pub fn fly<S>(
    units: &mut [Unit],
    wires: &[Wires],
    grid: Grid,
    mut inputs: impl FnMut(f64, &[Vec<f64>]) -> Vec<(usize, Settings)>,
    mut sample: impl FnMut(f64, &[Vec<f64>]) -> S,
) -> Result<Vec<S>, Error> {
    let steps = (grid.stop_s / grid.step_s).round() as u64;
    let every = ((grid.sample_s / grid.step_s).round() as u64).max(1);
    let mut samples = Vec::new();
    for step in 0..=steps {
        let time_s = step as f64 * grid.step_s;
        exchange(units, wires)?;
        if step.is_multiple_of(every) {
            let rows = units.iter_mut().map(Unit::read).collect::<Result<Vec<_>, _>>()?;
            samples.push(sample(time_s, &rows));
            for (unit, settings) in inputs(time_s, &rows) {
                units[unit].set(&settings)?;
            }
        }
        if step < steps {
            units.iter_mut().try_for_each(|unit| unit.step(time_s, grid.step_s))?;
        }
    }
    Ok(samples)
}

fn exchange(units: &mut [Unit], wires: &[Wires]) -> Result<(), Error> {
    for Wires { from: (from, outputs), to: (to, inputs) } in wires {
        let fmu = units[*to].instance.fmu().clone();
        for (output, input) in outputs.iter().zip(inputs) {
            let value = units[*from].value(*output)?;
            units[*to].instance.set_variable(&fmu.description().variables[*input], &value)?;
        }
    }
    Ok(())
}
