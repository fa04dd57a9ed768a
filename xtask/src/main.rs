//! `cargo xtask demo | test | dist | bench | notices`: the project's own chores. No dependencies; spawns cargo and python.

mod bench;
mod build;
mod locale;
mod notices;
mod python;
mod shell;
mod test;

use std::process::ExitCode;

use shell::Outcome;

const HELP: &str = "\
cargo xtask <task>

  demo    build the library, pack dist/MomentumPlant.fmu, fly paper 000's 90 days, compare with its Table 2
  test    everything that must hold: format, lints, Rust tests, FMPy, C client
  dist    build and pack every shipped FMU into dist/
  bench   measure speed and memory; prints `bench <name> <value> <unit>` lines
  notices write anew what licences the linked crates have, after Cargo.lock has changed
";

fn main() -> ExitCode {
    let task = std::env::args().nth(1).unwrap_or_default();
    let outcome = match task.as_str() {
        "demo" => demo(),
        "test" => test::all(),
        "dist" => build::dist().map(|_| ()),
        "bench" => bench::all(),
        "notices" => notices::write(),
        "" | "help" | "--help" | "-h" => {
            print!("{HELP}");
            Ok(())
        }
        other => Err(format!("unknown task `{other}`; there are demo, test, dist, bench and notices")),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("xtask: {problem}");
            ExitCode::FAILURE
        }
    }
}

fn demo() -> Outcome {
    let built = build::dist()?;
    let folder = shell::root().join("dist").join("demo");
    shell::run(
        shell::command(&built.heliotorque)
            .args(["study", "momentum/table2", "--only", "4 N.m.s"])
            .arg("--dist")
            .arg(shell::root().join("dist"))
            .arg("--output")
            .arg(&folder),
    )
}
