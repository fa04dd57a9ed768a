//! `cargo xtask test --all-platforms`: the same bits on every platform, states of one on another, programs and wheels of each.
//!
//! Windows is emulated by Wine, Arm by QEMU.

mod simulations;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::{Built, scratch};
use crate::platforms::{ALL, ARM, Platform, WINDOWS};
use crate::shell::{Outcome, command, output, run};
use crate::test::{CCompiler, compile_c_for};
use crate::{archives, tools, windows};
use crate::{dist, paths};
use simulations::{SAVED, Simulation, Value};

/// Folder of the C library for Arm.
const ARM_LIBRARIES: (&str, &str) = ("QEMU_LD_PREFIX", "/usr/aarch64-linux-gnu");

/// FMU that the program of each platform simulates and checks.
const SIMULATED: &str = "MomentumPlant";

/// Builds for all platforms and runs all tests; missing tools are reported first.
pub(crate) fn all() -> Outcome {
    let missing = [
        tools::need(&[&tools::MINGW, &tools::WINE, &tools::ARM_GCC, &tools::QEMU]),
        tools::need_arm_programs(),
    ];
    let missing: Vec<String> = missing.into_iter().filter_map(Outcome::err).collect();
    if !missing.is_empty() {
        return Err(missing.join("\n"));
    }
    let built = dist::all_platforms()?;
    let machines = machines()?;
    let outcomes =
        [same_bits(&machines), programs(&machines, &built), windows::test(&built), wheels(&machines, &built)];
    let failures: Vec<String> = outcomes.into_iter().filter_map(Outcome::err).collect();
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// Installs the wheel of each platform and simulates with its program.
fn wheels(machines: &[Machine], built: &Built) -> Outcome {
    archives::write_wheels(built)?;
    archives::try_wheel()?;
    machines.iter().try_for_each(|machine| {
        let package = archives::installed(machine.platform)?.join("heliotorque");
        let program = package.join("bin").join(format!("heliotorque{}", machine.platform.program_suffix));
        let fmu = package.join("lib").join("heliotorque").join(format!("{SIMULATED}.fmu"));
        run(machine.start(&program).arg("run").arg(machine.path(&fmu)).args(["--stop", "1d", "--quiet"]))
    })
}

/// A platform and its build of the C master.
struct Machine {
    platform: &'static Platform,
    master: PathBuf,
}

impl Machine {
    fn new(platform: &'static Platform, scratch: &Path) -> Result<Self, String> {
        let compiler = match platform.folder {
            folder if folder == WINDOWS.folder => {
                CCompiler { program: tools::MINGW.program, libraries: &["-static"] }
            }
            folder if folder == ARM.folder => {
                CCompiler { program: tools::ARM_GCC.program, ..CCompiler::HERE }
            }
            _ => CCompiler::HERE,
        };
        let called = format!("flight-{}{}", platform.folder, platform.program_suffix);
        Ok(Self { platform, master: compile_c_for(&compiler, scratch, ("flight", &called), &[])? })
    }

    /// Command that runs a program of this platform on the host.
    fn start(&self, program: &Path) -> Command {
        if self.platform.folder == WINDOWS.folder {
            let mut started = command(tools::WINE.program);
            started.arg(program).envs(windows::wine());
            return started;
        }
        let mut started = command(program);
        if self.platform.folder == ARM.folder {
            started.env(ARM_LIBRARIES.0, ARM_LIBRARIES.1);
        }
        started
    }

    /// A path in the notation of this platform.
    fn path(&self, path: &Path) -> String {
        let path = path.display().to_string();
        if self.platform.folder == WINDOWS.folder { format!("Z:{}", path.replace('/', "\\")) } else { path }
    }

    /// Runs the C master and returns its output.
    fn simulate(&self, simulation: &Prepared, state: Option<(&str, &Path)>) -> Result<String, String> {
        let Prepared { name, folder, options } = simulation;
        let library = format!("{name}{}", self.platform.library_suffix());
        let library = folder.join("binaries").join(self.platform.folder).join(library);
        let drive = if self.platform.folder == WINDOWS.folder { "/Z:" } else { "" };
        let mut master = self.start(&self.master);
        master.arg(self.path(&library)).arg(self.path(&folder.join("modelDescription.xml")));
        master.arg(format!("file://{drive}{}", folder.join("resources").display()));
        for (option, value) in options {
            master.arg(option).arg(match value {
                Value::Text(text) => text.clone(),
                Value::File(path) => self.path(path),
            });
        }
        if let Some((option, file)) = state {
            master.arg(option).arg(self.path(file));
        }
        Ok(output(&mut master)?.replace('\r', ""))
    }
}

/// A simulation with its FMU unpacked.
struct Prepared {
    name: &'static str,
    folder: PathBuf,
    options: Vec<(&'static str, Value)>,
}

impl Prepared {
    fn new(simulation: &Simulation) -> Result<Self, String> {
        let folder = unpacked(simulation.fmu)?;
        Ok(Self { name: simulation.fmu, options: simulation.options(&folder)?, folder })
    }
}

/// Folder with an FMU of `dist/`, unpacked again where that has changed.
fn unpacked(fmu: &str) -> Result<PathBuf, String> {
    let archive = paths::dist(format!("{fmu}.fmu"));
    let folder = scratch("unpacked")?.join(fmu);
    let changed = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).ok();
    if changed(&folder) < changed(&archive) {
        if folder.exists() {
            paths::at(&folder, fs::remove_dir_all(&folder))?;
        }
        run(command("python3").args(["-m", "zipfile", "-e"]).arg(&archive).arg(&folder))?;
    }
    Ok(folder)
}

fn machines() -> Result<Vec<Machine>, String> {
    let scratch = scratch("platforms")?;
    ALL.iter().map(|platform| Machine::new(platform, &scratch)).collect()
}

/// Every simulation on every platform, then the states of each restored on each; prints a table.
fn same_bits(machines: &[Machine]) -> Outcome {
    let mut table = Table::new();
    for simulation in simulations::all() {
        let prepared = Prepared::new(&simulation)?;
        let found = each(machines, |machine| machine.simulate(&prepared, None))?;
        table.add(&simulation.label(), machines, &found);
    }
    let folder = scratch("platforms")?;
    for simulation in SAVED {
        let prepared = Prepared::new(simulation)?;
        let state =
            |machine: &Machine| folder.join(format!("{}-{}.state", simulation.fmu, machine.platform.folder));
        let uninterrupted =
            each(machines, |machine| machine.simulate(&prepared, Some(("--save", &state(machine)))))?;
        for writer in machines {
            let mut found =
                each(machines, |reader| reader.simulate(&prepared, Some(("--restore", &state(writer)))))?;
            // Against the simulation that was never interrupted.
            found.insert(0, uninterrupted[0].clone());
            let label = format!("{}, state of {}", simulation.label(), writer.platform.folder);
            table.add(&label, machines, &found);
        }
    }
    table.finish()
}

/// Runs `work` for all machines in parallel.
fn each<T: Send>(
    machines: &[Machine],
    work: impl Fn(&Machine) -> Result<T, String> + Sync,
) -> Result<Vec<T>, String> {
    std::thread::scope(|scope| {
        let threads: Vec<_> = machines.iter().map(|machine| scope.spawn(|| work(machine))).collect();
        let joined =
            threads.into_iter().map(|it| it.join().unwrap_or_else(|_| Err("a thread panicked".to_owned())));
        joined.collect()
    })
}

/// Rows of the comparison, as Markdown.
struct Table {
    text: String,
    different: Vec<String>,
}

impl Table {
    fn new() -> Self {
        let folders = ALL.each_ref().map(|platform| platform.folder).join(" | ");
        Self {
            text: format!("| simulation | points | outputs | {folders} |\n|---|---|---|---|---|---|\n"),
            different: Vec::new(),
        }
    }

    /// Compares the last of `found`, one a machine, with the first of all.
    fn add(&mut self, label: &str, machines: &[Machine], found: &[String]) {
        let expected: Vec<&str> = found[0].lines().collect();
        let points = expected[0].split(' ').next().unwrap_or_default();
        let mut row = format!("| {label} | {points} | {} |", expected.len() - 1);
        for (machine, found) in machines.iter().zip(&found[found.len() - machines.len()..]) {
            let different: Vec<String> = differences(&expected, found);
            let verdict =
                if different.is_empty() { "equal".to_owned() } else { format!("{} differ", different.len()) };
            row.push_str(&format!(" {verdict} |"));
            self.different
                .extend(different.iter().map(|it| format!("{label}, {}: {it}", machine.platform.folder)));
        }
        eprintln!("{row}");
        self.text.push_str(&row);
        self.text.push('\n');
    }

    fn finish(self) -> Outcome {
        println!("{}", self.text);
        let failed = |error: std::io::Error| format!("the table of bits: {error}");
        fs::write(scratch("platforms")?.join("bits.md"), &self.text).map_err(failed)?;
        if self.different.is_empty() { Ok(()) } else { Err(self.different.join("\n")) }
    }
}

/// The outputs whose digests differ, with their last values.
fn differences(expected: &[&str], found: &str) -> Vec<String> {
    let found: Vec<&str> = found.lines().collect();
    if found.len() != expected.len() {
        return vec![format!("{} lines, expected {}", found.len(), expected.len())];
    }
    let pairs = expected.iter().zip(found).filter(|(expected, found)| *expected != found);
    pairs.map(|(expected, found)| format!("{found}, expected {expected}")).collect()
}

/// The program of each platform simulates and checks an FMU; its recording equals the host's byte for byte.
fn programs(machines: &[Machine], built: &Built) -> Outcome {
    let fmu = paths::dist(format!("{SIMULATED}.fmu"));
    let folder = scratch("platforms")?;
    let mut first: Option<Vec<u8>> = None;
    for (machine, it) in machines.iter().zip(built.each()) {
        let recording = folder.join(format!("{}.csv", machine.platform.folder));
        let options = ["--stop", "10d", "--quiet", "--output"];
        run(machine
            .start(&it.heliotorque)
            .arg("run")
            .arg(machine.path(&fmu))
            .args(options)
            .arg(machine.path(&recording)))?;
        let bytes = paths::at(&recording, fs::read(&recording))?;
        if bytes != *first.get_or_insert_with(|| bytes.clone()) {
            return Err(format!("{}: differs from the recording of the host's program", recording.display()));
        }
        // An emulated machine is slow.
        run(machine
            .start(&it.heliotorque)
            .arg("check")
            .arg(machine.path(&fmu))
            .args(["--timeout", "10 min"]))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    //! A difference in one bit is found and named.

    use super::*;

    #[test]
    fn an_output_with_other_bits_is_named() {
        let expected = ["2 communication points", "a 00000000000000ff 1", "b 0000000000000001 2"];
        assert!(differences(&expected, &expected.join("\n")).is_empty());
        let found = expected.join("\n").replace("ff", "fe");
        assert_eq!(differences(&expected, &found), ["a 00000000000000fe 1, expected a 00000000000000ff 1"]);
        assert_eq!(differences(&expected, "2 communication points"), ["1 lines, expected 3"]);
    }
}
