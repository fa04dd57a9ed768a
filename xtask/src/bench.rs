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
    study(&built)
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
