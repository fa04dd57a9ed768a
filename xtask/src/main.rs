//! `cargo xtask demo | test [--long | --all-platforms | NAME] | study NAME|list|all | bless | env | dist | wheel | install | bench [--against FOLDER] [PART...] | lines | guide | notices`: the project's own chores. No dependencies; spawns cargo and python.

mod archives;
mod bench;
mod build;
mod dist;
mod guide;
mod install;
mod lines;
mod locale;
mod long;
mod notices;
mod paired;
mod paths;
mod platform_tests;
mod platforms;
mod prefix;
mod python;
mod selected;
mod shell;
mod studies;
mod systems;
mod test;
mod timing;
mod tools;
mod windows;

use std::process::ExitCode;

use shell::Outcome;

/// Builds for, or tests on, every platform.
const ALL_PLATFORMS: &str = "--all-platforms";

const HELP: &str = "\
cargo xtask <task>

  demo    build the library, pack dist/MomentumPlant.fmu, simulate paper 000's 90 days, compare with its Table 2
  test    everything that must hold: format, Rust tests, FMPy, C client; prints processor time by step and the slowest tests
  test --long
          the same, then lints, the guide, long tests of the models, of the shared library and in Python, and the
          longer searches for faults: each fuzz target of tests/fuzz for a minute
          (cargo-fuzz, nightly), the C client under the address and thread sanitizers, the exporter's unit tests in Miri, a failing n-th
          allocation, a full disk from the n-th write on; what this machine lacks is named and skipped.
          HELIOTORQUE_LONG picks parts alone (lints,guide,fuzz,sanitizers,miri,allocations,writes,models,suite,python,shipped);
          HELIOTORQUE_FUZZ_SECONDS is another time per target
  test NAME
          the tests in Rust and Python that have NAME in their name, with what they need built first
  study NAME|list|all
          the tables and figures of the papers: Python programs of harness/studies, in an environment under target/; what follows
          NAME is handed on: --only TEXT, --output FOLDER
  bless golden|reference|schema|mistakes|legs|guide
          write anew what tests compare with, after a change that is meant
  env     build everything, then print the variables that the tests read, as `export NAME='value'`
  test --all-platforms
          the same bits on Linux, Windows (wine) and Arm (qemu), states of one restored on another, the programs and the wheels;
          apart from the others, after `dist --all-platforms`; what this machine lacks is named with what brings it
  dist    build for Linux with glibc 2.17 or later and pack every shipped FMU and system into dist/
  dist --all-platforms
          the same with libraries for linux64, win64 and aarch64-linux in every FMU, and archives of the program for each
  wheel   the same, then a wheel of program, library and FMUs for each platform into dist/; this computer's is tried
  install build and pack everything, then put the program, its library and the FMUs below a prefix: ~/.local or
          --prefix FOLDER; the program then works in any folder; --built takes what target/ and dist/ have
  bench [PART...]
          measure speed and memory; prints `bench <name> <value> <unit>` lines. Parts: kernels, c, system, study, plans, flybys,
          sweep, earth
  bench --against FOLDER [PART...]
          the same here and in another checkout in turns; the last number of a line is the median of now over then
  lines   count lines of code by crate and by folder of physics: no blanks, comments, lone brackets, tests
  guide   build the guide of docs/ into target/guide
  notices write anew what licences the linked crates have, after Cargo.lock has changed
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let task = arguments.first().cloned().unwrap_or_default();
    let option = arguments.get(1).map(String::as_str);
    let outcome = match task.as_str() {
        "demo" => demo(),
        "test" if option == Some("--long") => timed(long::all),
        "test" if option == Some(ALL_PLATFORMS) => platform_tests::all(),
        "test" => match option {
            None => timed(test::all),
            Some(option) if option.starts_with('-') => {
                Err(format!("unknown option `{option}` of test; there are --long, {ALL_PLATFORMS}"))
            }
            Some(name) => selected::named(name),
        },
        "study" => studies::study(arguments.get(1..).unwrap_or_default()),
        "bless" => selected::bless(option.unwrap_or_default()),
        "env" => test::print_environment(),
        "dist" => match option {
            None => dist::shipped().map(|_| ()),
            Some(ALL_PLATFORMS) => dist::all_platforms().map(|_| ()),
            Some(option) => Err(format!("unknown option `{option}` of dist; there is {ALL_PLATFORMS}")),
        },
        "wheel" => dist::all_platforms()
            .and_then(|built| archives::write_wheels(&built))
            .and_then(|()| archives::try_wheel()),
        "install" => install::install(arguments.get(1..).unwrap_or_default()),
        "bench" => match arguments.get(1..).unwrap_or_default() {
            [option, folder, parts @ ..] if option == "--against" => paired::against(folder, parts),
            parts => bench::parts(parts),
        },
        "lines" => lines::print(),
        "guide" => guide::build(),
        "notices" => notices::write(),
        "" | "help" | "--help" | "-h" => {
            print!("{HELP}");
            Ok(())
        }
        other => Err(format!(
            "unknown task `{other}`; there are demo, test, study, bless, env, dist, wheel, install, bench, lines, guide and notices"
        )),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("xtask: {problem}");
            ExitCode::FAILURE
        }
    }
}

/// Prints after a task what time its steps took.
fn timed(task: fn() -> Outcome) -> Outcome {
    let outcome = task();
    timing::print();
    outcome
}

fn demo() -> Outcome {
    let built = dist::dist()?;
    let folder = paths::dist("demo");
    let only = ["--table", "2", "--only", "4 N.m.s"];
    shell::run(studies::program(&built, "momentum/tables", &folder)?.args(only))
}
