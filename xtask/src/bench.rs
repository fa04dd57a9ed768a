//! `cargo xtask bench`: medians as `bench <name> <value> <unit>` lines.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::build::{self, Built};
use crate::shell::{Outcome, cargo, command, need, output, root, run};
use crate::test::compile_c;
use crate::{paths, python, studies};

/// Kernel benchmarks: examples of `physics`, built as the library is.
const EXAMPLES: &[&str] = &["bench_solar", "bench_radiation"];
/// Studies and systems are simulated this often; the median counts.
const RUNS: usize = 3;
/// Number of turns in which processor times are compared.
const TURNS: usize = 5;

type Part = fn(&Built) -> Outcome;

/// Kernels (Rust examples of `physics`), the C interface, a system, a whole study, plans, a campaign, a day compared with Basilisk.
const PARTS: &[(&str, Part)] = &[
    ("kernels", kernels),
    ("c", c_interface),
    ("system", system),
    ("study", study),
    ("plans", plans),
    ("flybys", flybys),
    ("sweep", sweep),
    ("earth", earth),
];

/// The benchmarks of these parts; of all without any.
pub(crate) fn parts(names: &[String]) -> Outcome {
    let known = || PARTS.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    if let Some(name) = names.iter().find(|name| PARTS.iter().all(|(known, _)| known != name)) {
        return Err(format!("unknown part `{name}` of bench; there are {}", known()));
    }
    let built = crate::dist::dist()?;
    if let Ok(library) = std::fs::metadata(&built.library) {
        println!("bench library_size {:.3} MB", library.len() as f64 / 1e6);
    }
    let is_chosen = |name: &str| names.is_empty() || names.iter().any(|it| it == name);
    PARTS.iter().filter(|(name, _)| is_chosen(name)).try_for_each(|(_, part)| part(&built))
}

fn kernels(_: &Built) -> Outcome {
    EXAMPLES.iter().try_for_each(|example| {
        run(cargo("run --locked --quiet --profile fmu -p physics --example").arg(example))
    })
}

fn c_interface(built: &Built) -> Outcome {
    if need("gcc", "the benchmark through the C interface")? {
        let scratch = build::scratch("bench")?;
        let program = compile_c(&scratch, "bench")?;
        let [orbiter, messenger] = spacecraft_folders(&scratch)?;
        run(command(&program)
            .arg(&built.library)
            .arg(&built.probe)
            .args([orbiter, messenger])
            .current_dir(&scratch))?;
        let program = compile_c(&scratch, "bench_dynamics")?;
        run(command(&program).arg(&built.library).current_dir(&scratch))?;
    }
    Ok(())
}

/// A day of ten plates about the Earth, compared with Basilisk.
fn earth(built: &Built) -> Outcome {
    let script = root().join("tests").join("python").join("bench_earth.py");
    run(command(python::basilisk()?)
        .arg(script)
        .arg(&built.heliotorque)
        .arg(paths::dist("MomentumPlant.fmu")))
}

/// Flights of ten days in one step each: `sweep` compared with a C program with the same values, with one and two workers and its memory; then
/// steps of a minute compared with FMPy.
fn sweep(built: &Built) -> Outcome {
    const FLIGHTS: u32 = 1000;
    let folder = Folder::new(built, "bench-sweep")?;
    let campaign = root().join("examples").join("campaign.toml");
    let text = paths::read(&campaign)?
        .replace("../dist", &root().join("dist").display().to_string())
        .replace("runs = 10000", &format!("runs = {FLIGHTS}"));
    folder.write("campaign.toml", &text)?;
    let swept = |words: &str| {
        let mut command = command(&built.heliotorque);
        command.current_dir(&folder.path).args(["sweep", "campaign.toml", "--quiet"]);
        command.args(words.split_whitespace());
        command
    };
    if need("gcc", "the benchmark of a sweep beside C")? {
        let program = compile_c(&folder.path, "bench_sweep")?;
        output(&mut swept("--dry-run --output values.csv"))?;
        let processor_of = |command: &mut Command| {
            let begin = processor_s();
            output(command).map(|_| processor_s() - begin)
        };
        // By turns, as the clock of a processor changes.
        let (mut all_s, mut ratios) = (Vec::new(), Vec::new());
        for _ in 0..TURNS {
            let mut by_c = command(&program);
            let by_c_s = processor_of(by_c.arg(&built.library).arg("values.csv").current_dir(&folder.path))?;
            let own_s = processor_of(&mut swept("--workers 1"))?;
            all_s.push(own_s);
            ratios.push(own_s / by_c_s);
        }
        println!("bench sweep_{FLIGHTS}_flights_of_10_days_processor_time {:.2} s", median(all_s));
        println!("bench sweep_over_c_loop_processor_time {:.3} times", median(ratios));
    }
    let [one_s, two_s] = [median_s(&mut swept("--workers 1"))?, median_s(&mut swept("--workers 2"))?];
    println!("bench sweep_two_workers_over_one {:.2} times", one_s / two_s);
    peak_row("sweep_peak_of_a_process", &mut swept("--workers 2"))?;
    let script = root().join("tests").join("python").join("bench_sweep.py");
    run(command(python::interpreter()?)
        .arg(script)
        .arg(&built.heliotorque)
        .arg(paths::dist("MomentumPlant.fmu")))
}

/// Processor time of all processes that this one has waited for, and theirs, in s; 0 where the system does not report it.
fn processor_s() -> f64 {
    const TICKS_PER_S: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // Behind the name in parentheses: user and system time of children are the 14th and 15th field.
    let fields = stat.rsplit_once(')').map_or("", |(_, fields)| fields).split_whitespace();
    fields.skip(13).take(2).filter_map(|it| it.parse::<f64>().ok()).sum::<f64>() / TICKS_PER_S
}

/// A cruise of 200 days by its timeline, its plans, and a refit of ten days of a history; starts of the processes with them.
fn plans(built: &Built) -> Outcome {
    let folder = Folder::new(built, "bench-plans")?;
    let heliotorque = |words: &str| folder.quiet(words);
    let write = |name: &str, text: &str| folder.write(name, text);
    let flight = "run cruise.toml --output cruise.csv";
    write("messenger-cruise-timeline.toml", &resource("examples/missions/messenger-cruise-timeline.toml")?)?;
    let text = resource("examples/missions/messenger-cruise.toml")?
        .replace("../../messenger.toml", "messenger.toml");
    write("cruise.toml", &text)?;
    row("cruise_200_days_by_timeline", &mut heliotorque(flight))?;
    peak_row("cruise_200_days_by_timeline_peak", &mut heliotorque(flight))?;
    // Without angles of the arrays nothing is counted.
    let plan = "mission = \"cruise.toml\"\n[momentum]\nlimit = 5.5\n[tilt]\nazimuth = \"5 deg\"\nelevation = \"5 deg\"\n";
    write("convex.toml", &format!("windmill = 0\n{plan}"))?;
    write("counted.toml", plan)?;
    row("plan_cruise_200_days_convex", &mut heliotorque("plan convex.toml --output plan"))?;
    row("plan_cruise_200_days_counted_changes", &mut heliotorque("plan counted.toml --output plan"))?;
    // A history has no other columns: what the mission records, draws and limits is left out.
    let kept = |line: &&str| {
        ["record", "every", "[[plot]]", "file", "names", "[limits]", "\"panel[1].cor", "\"panel[2].cor"]
            .iter()
            .all(|begin| !line.starts_with(begin))
    };
    let ten_days: String = text.lines().filter(kept).map(|line| format!("{line}\n")).collect();
    write("ten-days.toml", &ten_days.replace("stop = \"200 d\"", "stop = \"10 d\""))?;
    let history = "run ten-days.toml --step 600 --record momentum.inertial,dump.count --output history.csv";
    output(&mut heliotorque(history))?;
    row(
        "refit_10_days_1441_rows",
        &mut heliotorque("refit ten-days.toml --telemetry history.csv --output refit.toml"),
    )
}

/// The leg to the second flyby of Mercury: simulated, with the partials of all windows, planned for an aim 170 km off, and dispersed.
fn flybys(built: &Built) -> Outcome {
    const LEGS: u32 = 1000;
    let folder = Folder::new(built, "bench-flybys")?;
    let heliotorque = |words: &str| folder.quiet(words);
    let mission = resource("examples/missions/messenger-flyby2.toml")?;
    folder.write("flyby.toml", &mission.replace("../../messenger.toml", "messenger.toml"))?;
    let leg = resource("examples/legs/messenger-flyby2.toml")?;
    folder.write("leg.toml", &leg.replace("../missions/messenger-flyby2.toml", "momentum/mission.toml"))?;
    let flight = "run flyby.toml --stop 17280000 --output flyby.csv";
    row("n_body_200_days", &mut heliotorque(flight))?;
    peak_row("n_body_200_days_peak", &mut heliotorque(flight))?;
    n_body_by_c(&folder)?;
    // Arrays of a plan flyby stay as they are up to its date: they come from a plan of the momentum, to which the departure is led.
    let tilt = "[tilt]\nazimuth = \"10 deg\"\nelevation = \"12 deg\"\n";
    folder.write(
        "momentum.toml",
        &format!("mission = \"flyby.toml\"\nfreeze = 0\nwindow = \"10 d\"\n{tilt}"),
    )?;
    output(&mut heliotorque("plan momentum.toml --output momentum"))?;
    output(&mut heliotorque("plan leg.toml --output leg"))?;
    let aim = |altitude: &str| {
        format!(
            "[flyby]\nbody = \"mercury\"\naltitude = \"{altitude}\"\nangle = 0\nfrom = \"2008-06-17 UTC\"\n"
        )
    };
    let met = format!("mission = \"leg/mission.toml\"\nwindmill = 0\n{tilt}{}", aim("200 km"));
    folder.write("met.toml", &met)?;
    // The progress message `reach` follows the simulation and its partials.
    let plan = folder.command("plan met.toml --output met").output().map_err(|error| error.to_string())?;
    let progress = String::from_utf8_lossy(&plan.stderr).into_owned();
    let partials_s = progress.lines().find_map(|line| line.strip_suffix(" s: reach"));
    let partials_s =
        partials_s.ok_or_else(|| format!("`plan` with `[flyby]` reported no reach: {progress}"))?;
    println!("bench partials_of_all_windows_with_the_flight {partials_s} s");
    let text = format!(
        "mission = \"leg/mission.toml\"\nwindow = \"10 d\"\n{tilt}[sunOffset]\nchange = true\nlargest = \"20 deg\"\n{}",
        aim("370 km")
    );
    folder.write("plan.toml", &text)?;
    row("plan_flyby_170_km", &mut heliotorque("plan plan.toml --output plan"))?;
    let variances = [1e6, 1e6, 1e6, 1e-6, 1e-6, 1e-6];
    let line = |row: usize| {
        let cells = (0..6).map(|column| if row == column { variances[row] } else { 0.0 });
        cells.map(|it| it.to_string()).collect::<Vec<_>>().join(",")
    };
    folder.write("covariance.csv", &(0..6).map(line).collect::<Vec<_>>().join("\n"))?;
    let state = "[update]\nat = \"2008-03-19 UTC\"\ncovariance = \"covariance.csv\"\n";
    folder.write("dispersed.toml", &format!("{met}{state}[montecarlo]\nruns = {LEGS}\nscale = 0.01\n"))?;
    let begin = Instant::now();
    output(&mut heliotorque("plan dispersed.toml --output dispersed"))?;
    println!("bench plan_flyby_{LEGS}_dispersed_legs {:.2} s", begin.elapsed().as_secs_f64());
    Ok(())
}

/// The same simulation in one step through the C interface.
fn n_body_by_c(folder: &Folder<'_>) -> Outcome {
    if !need("gcc", "the benchmark of a flight between planets by C")? {
        return Ok(());
    }
    let mission = resource("examples/missions/messenger-flyby2.toml")?;
    let one_step = mission.replace("../../messenger.toml", "messenger.toml").replace("\nevery = \"6 h\"", "");
    let one_step = one_step.replace("\"203 d\"", "\"200 d\"").replace("\"1 h\"", "\"200 d\"");
    folder.write("one-step.toml", &one_step)?;
    run(&mut folder.command("pack one-step.toml --name Leg --output Leg.fmu"))?;
    run(command("python3").args(["-m", "zipfile", "-e", "Leg.fmu", "Leg"]).current_dir(&folder.path))?;
    let program = compile_c(&folder.path, "flight")?;
    let unpacked = folder.path.join("Leg");
    let mut by_c = command(&program);
    by_c.arg(&folder.built.library).arg(unpacked.join("modelDescription.xml"));
    by_c.arg(format!("file://{}", unpacked.join("resources").display()));
    row("n_body_200_days_by_c", &mut by_c)?;
    peak_row("n_body_200_days_by_c_peak", &mut by_c)
}

/// A file of the resources.
fn resource(name: &str) -> Result<String, String> {
    paths::read(&paths::resource(name))
}

/// An empty folder with the spacecraft, in which the program runs.
struct Folder<'b> {
    path: PathBuf,
    built: &'b Built,
}

impl<'b> Folder<'b> {
    fn new(built: &'b Built, name: &str) -> Result<Self, String> {
        let folder = Self { path: build::scratch(name)?, built };
        folder.write("messenger.toml", &resource("messenger.toml")?)?;
        Ok(folder)
    }

    fn write(&self, name: &str, text: &str) -> Outcome {
        paths::write(&self.path.join(name), text)
    }

    fn command(&self, words: &str) -> Command {
        let mut command = command(&self.built.heliotorque);
        command.current_dir(&self.path).args(words.split_whitespace());
        command.arg("--template").arg(paths::dist("MomentumPlant.fmu"));
        command
    }

    /// Without progress.
    fn quiet(&self, words: &str) -> Command {
        let mut command = self.command(words);
        command.arg("--quiet");
        command
    }
}

/// How long a command takes.
fn row(name: &str, command: &mut Command) -> Outcome {
    println!("bench {name} {:.2} s", median_s(command)?);
    Ok(())
}

/// The memory that it takes, where the system reports it.
fn peak_row(name: &str, command: &mut Command) -> Outcome {
    if let Some(bytes) = peak_bytes(command)? {
        println!("bench {name} {:.1} MB", bytes as f64 / 1e6);
    }
    Ok(())
}

/// The greatest memory of a command and what it starts, each by itself; `None` where the system does not report it.
fn peak_bytes(command: &mut Command) -> Result<Option<u64>, String> {
    let mut child = command.spawn().map_err(|error| error.to_string())?;
    let mut peak = None;
    loop {
        peak = peak.max(peak_of(child.id()));
        if child.try_wait().map_err(|error| error.to_string())?.is_some() {
            return Ok(peak);
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
}

/// The most that a process and its children have held so far, each by itself, as Linux reports it.
fn peak_of(process: u32) -> Option<u64> {
    let folder = PathBuf::from(format!("/proc/{process}"));
    let status = std::fs::read_to_string(folder.join("status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let own = line.split_whitespace().next()?.parse::<u64>().ok()? * 1024;
    let children =
        std::fs::read_to_string(folder.join(format!("task/{process}/children"))).unwrap_or_default();
    children.split_whitespace().filter_map(|child| peak_of(child.parse().ok()?)).chain([own]).max()
}

/// Guidance and plant in a loop of 20 ms: simulated over elapsed time, the start of the process with it.
fn system(built: &Built) -> Outcome {
    const SPAN_S: f64 = 20_000.0;
    let seconds = median_s(
        command(&built.heliotorque)
            .arg("run")
            .arg(paths::dist("MessengerLoop.ssp"))
            .args(["--quiet", "--step", "20ms", "--every", "600", "--record", "plant.momentum.body"])
            .args(["--stop", &SPAN_S.to_string(), "--output", "-"]),
    )?;
    let fast = SPAN_S / seconds;
    println!("bench messenger_loop_50_hz_over_real_time {fast:.0} times");
    Ok(())
}

/// Folders as an FMU's `resources/`, with two spacecraft whose surfaces give off heat.
fn spacecraft_folders(scratch: &Path) -> Result<[PathBuf; 2], String> {
    let folder = |name: &str, file: &str| {
        let (folder, file) = (scratch.join(name), paths::resource(file));
        let copy = || {
            std::fs::create_dir_all(&folder)?;
            std::fs::copy(&file, folder.join("spacecraft.toml"))
        };
        paths::at(&file, copy())?;
        Ok::<_, String>(folder)
    };
    Ok([folder("orbiter", "examples/mercury-orbiter.toml")?, folder("messenger", "messenger-thermal.toml")?])
}

/// Paper 000's Table 2 with the FMU's own dumps: every shade, convention, threshold and offset, on all cores.
fn study(built: &Built) -> Outcome {
    let folder = build::scratch("bench")?.join("study");
    let seconds = median_s(
        studies::program(built, "momentum/tables", &folder)?
            .args(["--table", "2", "--only", "to 0.9", "--quiet"]),
    )?;
    println!("bench study_momentum_table2_30_simulations {seconds:.2} s");
    Ok(())
}

/// How long a command takes, in s: the median of several runs.
fn median_s(command: &mut Command) -> Result<f64, String> {
    let mut seconds = Vec::new();
    for _ in 0..RUNS {
        let begin = Instant::now();
        output(command)?;
        seconds.push(begin.elapsed().as_secs_f64());
    }
    Ok(median(seconds))
}

/// The value in the middle; not a number without any.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
