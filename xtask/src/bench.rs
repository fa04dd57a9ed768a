//! `cargo xtask bench`: medians as `bench <name> <value> <unit>` lines.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::build::{self, Built};
use crate::dist;
use crate::shell::{Outcome, cargo, command, need, output, root, run};
use crate::test::compile_c;

/// Kernel benchmarks, as examples of `physics`.
const EXAMPLES: &[&str] = &["bench_solar", "bench_radiation"];
/// Studies and systems are simulated this often; the median counts.
const RUNS: usize = 3;

/// Kernels (Rust examples of `physics`), the C interface, a system, a whole study.
pub(crate) fn all() -> Outcome {
    let built = dist::dist()?;
    for example in EXAMPLES {
        run(cargo("run --locked --quiet --release -p physics --example").arg(example))?;
    }
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
    system(&built)?;
    study(&built)?;
    plans(&built)
}

/// A cruise of 200 days by its timeline, its plans, and a refit of ten days of a history; starts of the processes with them.
fn plans(built: &Built) -> Outcome {
    let scratch = build::scratch("bench-plans")?;
    let resources = root().join("fmu-src").join("resources");
    let missions = resources.join("examples").join("missions");
    let heliotorque = |words: &str| {
        let mut command = command(&built.heliotorque);
        command.current_dir(&scratch).args(words.split_whitespace()).arg("--quiet");
        command.arg("--template").arg(root().join("dist").join("MomentumPlant.fmu"));
        command
    };
    let row = |name: &str, command: &mut Command| -> Outcome {
        println!("bench {name} {:.2} s", median_s(command)?);
        Ok(())
    };
    let write = |name: &str, text: &str| {
        let path = scratch.join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
    };
    let flight = "run cruise.toml --output cruise.csv";
    for (from, to) in [(&resources, "messenger.toml"), (&missions, "messenger-cruise-timeline.toml")] {
        let path = from.join(to);
        std::fs::copy(&path, scratch.join(to)).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let mission = missions.join("messenger-cruise.toml");
    let text =
        std::fs::read_to_string(&mission).map_err(|error| format!("{}: {error}", mission.display()))?;
    let text = text.replace("../../messenger.toml", "messenger.toml");
    write("cruise.toml", &text)?;
    row("cruise_200_days_by_timeline", &mut heliotorque(flight))?;
    if let Some(bytes) = peak_bytes(&mut heliotorque(flight))? {
        println!("bench cruise_200_days_by_timeline_peak {:.1} MB", bytes as f64 / 1e6);
    }
    // Without angles of the arrays nothing is counted.
    let plan = "mission = \"cruise.toml\"\n[momentum]\nlimit = 5.5\n[tilt]\nazimuth = \"5 deg\"\nelevation = \"5 deg\"\n";
    write("convex.toml", &format!("windmill = 0\n{plan}"))?;
    write("counted.toml", plan)?;
    row("plan_cruise_200_days_convex", &mut heliotorque("plan momentum convex.toml --output plan"))?;
    row(
        "plan_cruise_200_days_counted_changes",
        &mut heliotorque("plan momentum counted.toml --output plan"),
    )?;
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
            .arg(root().join("dist").join("MessengerLoop.ssp"))
            .args(["--quiet", "--step", "20ms", "--every", "600", "--record", "plant.momentum.body"])
            .args(["--stop", &SPAN_S.to_string(), "--output", "-"]),
    )?;
    let fast = SPAN_S / seconds;
    println!("bench messenger_loop_50_hz_over_real_time {fast:.0} times");
    Ok(())
}

/// Folders as an FMU's `resources/`, with two spacecraft whose surfaces give off heat.
fn spacecraft_folders(scratch: &Path) -> Result<[PathBuf; 2], String> {
    let resources = root().join("fmu-src").join("resources");
    let folder = |name: &str, file: PathBuf| {
        let folder = scratch.join(name);
        let copy = || {
            std::fs::create_dir_all(&folder)?;
            std::fs::copy(&file, folder.join("spacecraft.toml"))
        };
        copy().map_err(|error| format!("{}: {error}", file.display()))?;
        Ok::<_, String>(folder)
    };
    let orbiter = folder("orbiter", resources.join("examples").join("mercury-orbiter.toml"))?;
    Ok([orbiter, folder("messenger", resources.join("messenger-thermal.toml"))?])
}

/// Paper 000's Table 2 with the FMU's own dumps: every shade, convention, threshold and offset, on all cores.
fn study(built: &Built) -> Outcome {
    let folder = build::scratch("bench")?.join("study");
    let seconds = median_s(
        command(&built.heliotorque)
            .args(["study", "momentum/table2", "--quiet", "--only", "to 0.9", "--dist"])
            .arg(root().join("dist"))
            .arg("--output")
            .arg(&folder),
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
    seconds.sort_by(f64::total_cmp);
    Ok(seconds[RUNS / 2])
}
