//! The simulations whose bits are compared between platforms.

use std::path::{Path, PathBuf};

use crate::build::scratch;
use crate::{dist, paths};

/// Inputs of a simulation.
#[derive(Clone, Copy)]
enum Inputs {
    None,
    /// Inputs of the reference trajectory in the FMU, for its duration.
    OfReference,
    /// A CSV.
    Rows(&'static str),
}

/// Argument of an option of the C master.
pub(super) enum Value {
    Text(String),
    File(PathBuf),
}

/// A simulation of an FMU of `dist/` to the stop of its default experiment.
#[derive(Clone, Copy)]
pub(super) struct Simulation {
    pub fmu: &'static str,
    inputs: Inputs,
    sets: &'static [&'static str],
    what: &'static str,
}

/// Steps of a reference trajectory.
const REFERENCE_STEPS: u32 = 40;

/// Two burns in 90 days.
const BURNS: &str = "\
time,maneuver.request,maneuver.deltaV[1],maneuver.deltaV[2],maneuver.deltaV[3]
0,0,0,0,0
1728000,1,0.5,-0.25,0.125
1731600,0,0,0,0
5184000,1,-0.2,0.3,0.4
5187600,0,0,0,0
";

const WITH_EVERYTHING: Simulation = Simulation {
    fmu: "MomentumPlant",
    inputs: Inputs::Rows(BURNS),
    sets: &[
        "planetLight.enabled=true",
        "thermal.enabled=true",
        "dump.threshold[1]=4",
        "dump.threshold[2]=4",
        "dump.threshold[3]=4",
        "spacecraft.centerOfMass[3]=-0.0254",
    ],
    what: "90 days with dumps, burns, planet light and heat",
};

/// Simulations whose state is restored on another platform.
pub(super) const SAVED: &[Simulation] = &[of_default("SpinPlant"), of_reference("Guidance")];

const fn of_default(fmu: &'static str) -> Simulation {
    Simulation { fmu, inputs: Inputs::None, sets: &[], what: "default experiment" }
}

const fn of_reference(fmu: &'static str) -> Simulation {
    Simulation { fmu, inputs: Inputs::OfReference, sets: &[], what: "inputs of its reference flight" }
}

/// All simulations.
pub(super) fn all() -> impl Iterator<Item = Simulation> {
    dist::names().flat_map(|fmu| [of_default(fmu), of_reference(fmu)]).chain([WITH_EVERYTHING])
}

impl Simulation {
    pub(super) fn label(&self) -> String {
        format!("{}, {}", self.fmu, self.what)
    }

    /// Options of the C master for the FMU in a folder; writes the file of inputs that one names.
    pub(super) fn options(&self, fmu: &Path) -> Result<Vec<(&'static str, Value)>, String> {
        let mut options: Vec<_> =
            self.sets.iter().map(|set| ("--set", Value::Text((*set).to_owned()))).collect();
        match self.inputs {
            Inputs::None => {}
            Inputs::OfReference => {
                let file = format!("extra/org.fmi-standard.fmi-ls-ref/{}_in.csv", self.fmu);
                options.push(("--inputs", Value::File(fmu.join(file))));
                options.push(("--steps", Value::Text(REFERENCE_STEPS.to_string())));
            }
            Inputs::Rows(text) => {
                let path = scratch("platforms")?.join("inputs.csv");
                paths::write(&path, text)?;
                options.push(("--inputs", Value::File(path)));
            }
        }
        Ok(options)
    }
}
