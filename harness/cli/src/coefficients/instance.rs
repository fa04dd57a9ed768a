//! An instance whose parameters can be read.

use loader::{Error, Fmu, Instance, InstanceOptions, Times, Value};
use model_description::{Causality, Variability};

/// An instance just initialised with these values: from then on parameters can be read too.
pub fn started(fmu: &Fmu, sets: &[(String, Value)]) -> Result<Instance, Error> {
    let times = Times::of(fmu, None, None, None)?;
    let mut instance = Instance::new(fmu, "info", &InstanceOptions::default())?;
    instance.setup_experiment(None, times.start_s, None)?;
    let mut inputs = Vec::new();
    for (name, value) in sets {
        let variable = fmu.variable(name)?;
        if variable.causality == Causality::Input {
            inputs.push((name, value));
        } else if variable.causality == Causality::Parameter && variable.variability != Variability::Constant
        {
            instance.set(name, value)?;
        } else {
            return Err(Error::Value {
                variable: name.clone(),
                what: "it cannot be set: only parameters and inputs can".to_owned(),
            });
        }
    }
    instance.enter_initialization_mode()?;
    for (name, value) in inputs {
        instance.set(name, value)?;
    }
    instance.exit_initialization_mode()?;
    Ok(instance)
}
