//! Packing the shipped systems: their FMUs with start values of their own, wired by the command line.
//!
//! What a system needs stands in its FMUs, because not every tool applies parameters of an SSP.

use std::path::{Path, PathBuf};

use crate::build::Built;
use crate::shell::{Outcome, command, root, run};

/// How the plant of `MessengerLoop.ssp` follows the command of Guidance.
const PLANT_ATTITUDE_SOURCE: &str = "attitude.source=commanded";
/// The attitude that Guidance commands at the default epoch: both begin there, not in a slew that Safe Hold would interrupt.
const MESSENGER_START: &str =
    "start.q=0.4133464981480585,0.895282817659325,0.1473540549832279,0.07681231250728461";

/// An FMU of a system: component, model, whether it is one of the probe's, spacecraft, start values.
struct Component {
    name: &'static str,
    model: &'static str,
    is_probe: bool,
    spacecraft: Option<&'static str>,
    start: &'static [&'static str],
}

/// A system: file, stop and step of its default experiment, components, further outputs that its connectors show.
struct System {
    file: &'static str,
    stop: &'static str,
    step: &'static str,
    components: &'static [Component],
    outputs: &'static str,
}

const SYSTEMS: &[System] = &[
    // A day about Mercury: science attitude, downlink after every second periapsis.
    System {
        file: "MessengerLoop.ssp",
        stop: "1d",
        step: "1s",
        components: &[
            Component {
                name: "guidance",
                model: "Guidance",
                is_probe: false,
                spacecraft: Some("messenger.toml"),
                start: &["pointing.scenario=orbitPhase", MESSENGER_START],
            },
            Component {
                name: "plant",
                model: "MomentumPlant",
                is_probe: false,
                spacecraft: Some("messenger.toml"),
                start: &[PLANT_ATTITUDE_SOURCE, MESSENGER_START],
            },
        ],
        outputs: "plant.attitude.q,plant.attitude.rate,plant.momentum.body,plant.momentum.inertial,plant.dump.count,\
                  guidance.mode.active",
    },
    // Half a day of a small body that light and the gravity gradient turn.
    System {
        file: "DisturbanceLoop.ssp",
        stop: "12h",
        step: "10s",
        components: &[
            Component {
                name: "disturbance",
                model: "DisturbanceTorque",
                is_probe: false,
                spacecraft: Some("messenger-thermal.toml"),
                start: &[],
            },
            Component { name: "body", model: "RigidBody", is_probe: true, spacecraft: None, start: &[] },
        ],
        outputs: "body.attitude.q,body.attitude.rate",
    },
];

/// Packs every shipped system into `dist/`.
pub fn pack(built: &Built, scratch: &Path) -> Outcome {
    for system in SYSTEMS {
        let mut fmus = Vec::new();
        for component in system.components {
            let fmu = pack_component(built, component, scratch)?;
            fmus.push(format!("{}={}", component.name, fmu.display()));
        }
        run(command(&built.heliotorque)
            .arg("wire")
            .args(fmus)
            .args(["--stop", system.stop, "--step", system.step, "--outputs", system.outputs, "--quiet"])
            .arg("--output")
            .arg(root().join("dist").join(system.file)))?;
    }
    Ok(())
}

fn pack_component(built: &Built, component: &Component, scratch: &Path) -> Result<PathBuf, String> {
    let fmu = scratch.join(format!("{}.fmu", component.name));
    let library = if component.is_probe { &built.probe } else { &built.library };
    let mut pack = command(&built.heliotorque);
    pack.args(["pack", "--model", component.model, "--library"]).arg(library);
    if let Some(spacecraft) = component.spacecraft {
        pack.arg("--spacecraft").arg(root().join("fmu-src").join("resources").join(spacecraft));
    }
    for start in component.start {
        pack.args(["--set", start]);
    }
    run(pack.arg("--output").arg(&fmu))?;
    Ok(fmu)
}
