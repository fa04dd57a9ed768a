//! Common code of the probes: an instance brought to a state, and all its values as bits.

use crate::{Checking, Error, Fmu, Instance, InstanceOptions, Times};
use model_description::call_table::State;
use model_description::{Causality, Variability};

/// Steps of a short simulation.
pub(crate) const STEPS: u64 = 12;

/// Options of a probe that stays within the standard.
pub(crate) fn strict() -> InstanceOptions {
    InstanceOptions { logging: true, ..InstanceOptions::default() }
}

/// Options of a probe that breaks the rules on purpose.
pub(crate) fn unchecked() -> InstanceOptions {
    InstanceOptions { logging: true, checking: Checking::Off, ..InstanceOptions::default() }
}

/// The FMU's own times.
pub(crate) fn times(fmu: &Fmu) -> Result<Times, Error> {
    Times::from_fmu(fmu, None, None, None)
}

/// References of continuous variables.
pub(crate) fn continuous(fmu: &Fmu, causality: Causality) -> Vec<u32> {
    let variables = fmu.description().variables.iter();
    variables
        .filter(|it| it.causality == causality && it.variability == Variability::Continuous)
        .map(|it| it.value_reference)
        .collect()
}

/// The value references of all variables of a causality: Reals, Integers and Enumerations, Booleans, Strings.
pub(crate) fn references(fmu: &Fmu, causality: Causality) -> [Vec<u32>; 4] {
    let mut references: [Vec<u32>; 4] = Default::default();
    for variable in fmu.description().variables.iter().filter(|it| it.causality == causality) {
        references[variable.kind.base_type() as usize].push(variable.value_reference);
    }
    references
}

/// Every output as bits, so that equal means equal to the bit.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(crate) struct Bits(Vec<u64>, Vec<i32>, Vec<String>);

/// Reads every output.
pub(crate) fn outputs(instance: &mut Instance) -> Result<Bits, Error> {
    let [reals, integers, booleans, strings] = references(instance.fmu(), Causality::Output);
    let mut bits = Bits::default();
    let mut values = vec![0.0; reals.len()];
    instance.get_reals(&reals, &mut values)?;
    bits.0.extend(values.iter().map(|real| real.to_bits()));
    let mut values = vec![0; integers.len()];
    instance.get_integers(&integers, &mut values)?;
    bits.1.append(&mut values);
    let mut values = vec![0; booleans.len()];
    instance.get_booleans(&booleans, &mut values)?;
    bits.1.extend(values.into_iter().map(|flag| i32::from(flag != 0)));
    if !strings.is_empty() {
        bits.2 = instance.get_strings(&strings)?;
    }
    Ok(bits)
}

/// A fresh instance in `state`, to which every FMU can be brought.
pub(crate) fn at(fmu: &Fmu, options: &InstanceOptions, state: State) -> Result<Instance, Error> {
    let mut instance = Instance::new(fmu, "probe", options)?;
    advance(&mut instance, state)?;
    Ok(instance)
}

/// Brings a freshly instantiated or reset instance to `state`; false where the FMU cannot be brought there.
pub(crate) fn advance(instance: &mut Instance, state: State) -> Result<bool, Error> {
    let times = times(instance.fmu())?;
    let tolerance = instance.fmu().description().default_experiment.and_then(|it| it.tolerance);
    if state == State::Instantiated {
        return Ok(true);
    }
    instance.setup_experiment(tolerance, times.start_s, Some(times.stop_s))?;
    instance.enter_initialization_mode()?;
    if state == State::InitializationMode {
        return Ok(true);
    }
    instance.exit_initialization_mode()?;
    match state {
        State::StepComplete => Ok(true),
        State::Terminated => instance.terminate().map(|()| true),
        // Initialization comes before the first step and never again.
        State::Error => Ok(instance.enter_initialization_mode().is_err()),
        _ => Ok(false),
    }
}

/// A ready instance between steps.
pub(crate) fn ready(fmu: &Fmu, options: &InstanceOptions) -> Result<Instance, Error> {
    at(fmu, options, State::StepComplete)
}

/// Runs steps `from..to` of the default experiment.
pub(crate) fn simulate(instance: &mut Instance, from: u64, to: u64) -> Result<(), Error> {
    let times = times(instance.fmu())?;
    for k in from..to.min(times.steps()) {
        let time_s = times.point_s(k);
        let last = k + 1 == times.steps();
        let step_s = if last { times.stop_s - time_s } else { times.step_s };
        instance.do_step(time_s, step_s, false)?;
    }
    Ok(())
}

/// All values at the end of a short simulation.
pub(crate) fn short_simulation(fmu: &Fmu, options: &InstanceOptions) -> Result<Bits, Error> {
    let mut instance = ready(fmu, options)?;
    simulate(&mut instance, 0, STEPS)?;
    outputs(&mut instance)
}
