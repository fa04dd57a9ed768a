//! Packing the shipped systems: their FMUs with start values of their own, wired by the command line.
//!
//! What a system needs stands in its FMUs, because not every tool applies parameters of an SSP.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::Built;
use crate::paths::{dist, resource};
use crate::shell::{Beside, Outcome, command, run};

/// The attitude that the orbit phase's guidance commands at the start of `MessengerLoop.ssp`: from any other the first slew would
/// lead the Sun out of its zone.
const GUIDED_AT_START: &str = "\
    start.q[1]=0.4133464981480585 --set start.q[2]=0.895282817659325 --set start.q[3]=0.1473540549832279 \
    --set start.q[4]=0.07681231250728458";

/// Options of `pack` in a text, with the attitude that guidance commands at the start by the name of its constant.
pub(crate) fn options(text: &str) -> Vec<String> {
    let text = text.replace("GUIDED_AT_START", GUIDED_AT_START);
    text.split_whitespace().map(str::to_owned).collect()
}

/// An FMU of a system: component, model, spacecraft (without one it is one of the probe's models), further options of `pack`.
type Component = (&'static str, &'static str, Option<&'static str>, &'static str);

/// A system: file, that without enumerations if there is one, stop and step of its default experiment, components, further outputs
/// that its connectors show, and connectors of the system itself, which libcosim refuses: a file that it reads has none.
struct System {
    file: &'static str,
    plain_file: Option<&'static str>,
    stop: &'static str,
    step: &'static str,
    components: &'static [Component],
    outputs: &'static str,
    exports: Option<&'static str>,
}

const SYSTEMS: &[System] = &[
    // A day about Mercury: science attitude, downlink after every second periapsis.
    System {
        file: "MessengerLoop.ssp",
        plain_file: Some("MessengerLoopPlain.ssp"),
        stop: "1d",
        step: "1s",
        components: &[
            (
                "guidance",
                "Guidance",
                Some("messenger.toml"),
                "--set pointing.scenario=orbitPhase --set GUIDED_AT_START",
            ),
            // Forces and torques every 10 s: shadows then cost what a second without them does. No command turns the body at once,
            // nor while it waits for orbit or Sun: there is no algebraic loop.
            (
                "plant",
                "MomentumPlant",
                Some("messenger-full.toml"),
                "--set shadowing.enabled=true --set solver.dynamicsStep=10 --set GUIDED_AT_START \
                 --fix attitude.source=controlled --fix start.attitude=given --fix command.source=inputs --fix orbit.source=elements \
                 --fix ephemeris.source=vsop87",
            ),
        ],
        outputs: "plant.attitude.q,plant.attitude.rate,plant.momentum.body,plant.momentum.inertial,plant.dump.count,\
                  guidance.mode.active",
        // What a user asks and sees. FMPy sets the input to 0, where it starts.
        exports: Some(
            "guidance.mode.request,guidance.mode.active,plant.attitude.q,plant.attitude.rate,plant.momentum.body,\
             plant.momentum.inertial,plant.dump.count",
        ),
    },
    // Half a day of a small body that light and the gravity gradient turn.
    System {
        file: "DisturbanceLoop.ssp",
        plain_file: None,
        stop: "12h",
        step: "10s",
        components: &[
            ("disturbance", "DisturbanceTorque", Some("messenger-thermal.toml"), ""),
            ("body", "RigidBody", None, ""),
        ],
        outputs: "body.attitude.q,body.attitude.rate",
        exports: None,
    },
];

/// Packs every shipped system into `dist/`.
pub(crate) fn pack(built: &Built, scratch: &Path) -> Outcome {
    let mut records = Vec::new();
    for system in SYSTEMS {
        let mut fmus = Vec::new();
        for component in system.components {
            let fmu = pack_component(built, component, scratch)?;
            fmus.push(format!("{}={}", component.0, fmu.display()));
        }
        let exports = system.exports.map_or_else(Vec::new, |exports| vec!["--export", exports]);
        let whole = [(system.file, exports)].into_iter();
        let plain = system.plain_file.map(|file| (file, vec!["--without-enumerations"]));
        for (file, options) in whole.chain(plain) {
            run(command(&built.heliotorque)
                .arg("wire")
                .args(&fmus)
                .args(["--stop", system.stop, "--step", system.step, "--outputs", system.outputs, "--quiet"])
                .args(options)
                .arg("--output")
                .arg(dist(file)))?;
            // A simulation waits for one core, as packing does.
            records.push(Beside::start(&mut record(built, file))?);
        }
    }
    records.into_iter().try_for_each(Beside::finish)
}

/// Time between two rows of a reference flight, in s.
const EVERY: &str = "600";

/// The default experiment of the system, with outputs at the start exchanged in initialization.
fn record(built: &Built, file: &str) -> Command {
    let system = dist(file);
    let mut simulation = command(&built.heliotorque);
    simulation.arg("run").arg(&system).args(["--quiet", "--first-exchange", "initial", "--every", EVERY]);
    simulation.arg("--output").arg(system.with_extension("csv"));
    simulation
}

fn pack_component(built: &Built, component: &Component, scratch: &Path) -> Result<PathBuf, String> {
    let (name, model, spacecraft, further) = component;
    let fmu = scratch.join(format!("{name}.fmu"));
    let library: fn(&Built) -> &PathBuf =
        if spacecraft.is_some() { |it| &it.library } else { |it| &it.probe };
    let mut pack = command(&built.heliotorque);
    pack.args(["pack", "--model", model]).args(built.library_options(library));
    if let Some(spacecraft) = spacecraft {
        pack.arg("--spacecraft").arg(resource(spacecraft));
    }
    run(pack.args(options(further)).arg("--output").arg(&fmu).stdout(std::io::stderr()))?;
    Ok(fmu)
}
