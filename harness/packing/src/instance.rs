//! An instance whose parameters and outputs can be read.

use fmi::{Error, Fmu, Instance, InstanceOptions, Value};
use nalgebra::Vector3;

/// An instance just initialised with these values: from then on parameters can be read too.
pub fn started(fmu: &Fmu, name: &str, start_s: f64, sets: &[(String, Value)]) -> Result<Instance, Error> {
    let mut instance = Instance::new(fmu, name, &InstanceOptions::default())?;
    instance.setup_experiment(None, start_s, None)?;
    fmi::initialize(&mut instance, sets.iter().map(|(name, value)| (name, value)))?;
    instance.exit_initialization_mode()?;
    Ok(instance)
}

/// Three parameters or outputs of an instance.
pub fn vector(instance: &mut Instance, name: &str) -> Result<Vector3<f64>, Error> {
    let [x, y, z] = [1, 2, 3].map(|axis| instance.get_real(&format!("{name}[{axis}]")));
    Ok(Vector3::new(x?, y?, z?))
}
