//! `cargo xtask test`: format, Rust tests, FMPy, C client.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::thread::ScopedJoinHandle;

use crate::build::{self, Built, TESTS};
use crate::shell::{Echo, Outcome, cargo, command, need, root, run, run_tests};
use crate::{dist, guide, locale, paths, python};

/// Seed of the property tests: the same draws in every run, so that what turns red was changed; set it for others.
const DRAWS: &str = "PROPTEST_RNG_SEED";

/// Runs everything but what stands in `--long`: formatting or a build that fail end it, tests that fail are named at the end.
pub(crate) fn all() -> Outcome {
    if need("rustfmt", "the format check")? {
        run(&mut cargo("fmt --all --check"))?;
        guide::check_format()?;
    }
    let built = build()?;
    dist::pack_all(&built)?;
    let environment = environment(&built)?;
    let locale = locale::environment()?;
    let outcomes = std::thread::scope(|scope| {
        // Each of the three has tests that wait for one core.
        let client = scope.spawn(|| c_client(&built, false));
        let in_python = scope.spawn(|| python(environment.clone(), "not long"));
        let mut in_rust = timed_tests(&format!("--no-fail-fast --tests {TESTS}"));
        let in_rust = run_tests(in_rust.envs(environment.clone()).envs(locale), Echo::AsItComes);
        let ended = |thread: ScopedJoinHandle<'_, Outcome>, of: &str| {
            thread.join().unwrap_or_else(|_| Err(format!("the thread of {of} panicked")))
        };
        [in_rust, ended(client, "the C client"), ended(in_python, "the tests in Python")]
    });
    let failures: Vec<String> = outcomes.into_iter().filter_map(Outcome::err).collect();
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// `cargo test` whose tests print their times where that is possible: libtest of the stable toolchain does so for programs that have
/// this variable, whose value keeps compilers to stable features. Cargo itself would build anew for it.
fn timed_tests(options: &str) -> std::process::Command {
    let mut tests = cargo(&format!("test {options}"));
    if cfg!(unix) {
        tests.args(["--config", r#"target."cfg(unix)".runner=["env","RUSTC_BOOTSTRAP=-1"]"#]);
        tests.args(["--", "-Zunstable-options", "--report-time"]);
    }
    tests
}

/// Builds libraries, programs and tests.
fn build() -> Result<Built, String> {
    let interpreter = std::thread::spawn(python::interpreter);
    let built = build::tested("")?;
    interpreter.join().unwrap_or_else(|_| Err("the thread of the Python environment panicked".to_owned()))?;
    Ok(built)
}

/// Variables by which the tests find the build's products, and the seed of their draws.
pub(crate) fn environment(built: &Built) -> Result<Vec<(&'static str, PathBuf)>, String> {
    let mut environment = build::test_environment(built).to_vec();
    environment.push(("HELIOTORQUE_FOREIGN_FMU", foreign_fmu()?));
    if std::env::var_os(DRAWS).is_none() {
        environment.push((DRAWS, "20040803".into()));
    }
    Ok(environment)
}

/// The same, after building and packing what is stale.
pub(crate) fn current_environment() -> Result<Vec<(&'static str, PathBuf)>, String> {
    let built = build::tested("--quiet")?;
    dist::pack_stale(&built)?;
    environment(&built)
}

/// Prints the environment of the tests as a shell takes it, with everything built.
pub(crate) fn print_environment() -> Outcome {
    for (name, value) in current_environment()? {
        println!("export {name}='{}'", value.display());
    }
    Ok(())
}

/// Runs the tests in Python of a mark on up to four processes.
pub(crate) fn python(environment: Vec<(&'static str, PathBuf)>, mark: &str) -> Outcome {
    let processes = ["--numprocesses=auto", "--maxprocesses=4", "--dist=loadgroup"];
    let times = ["--durations=10", "--durations-min=1"];
    let mut tests = python::pytest()?;
    tests.args(processes).args(times).args(["-m", mark, "tests/python"]).envs(environment);
    run_tests(&mut tests, Echo::AtTheEnd)
}

/// Runs the tests of one file in Python, with more in the environment.
pub(crate) fn python_file(
    name: &str,
    environment: impl IntoIterator<Item = (&'static str, OsString)>,
) -> Outcome {
    run(python::pytest()?.arg(Path::new("tests/python").join(name)).envs(environment))
}

/// An FMU whose library others built: FMPy's container around our plant.
fn foreign_fmu() -> Result<PathBuf, String> {
    let fmu = build::scratch("foreign")?.join("container.fmu");
    run(command(python::interpreter()?)
        .args(["tests/python/foreign_fmu.py"])
        .arg(paths::dist("MomentumPlant.fmu"))
        .arg(&fmu))?;
    Ok(fmu)
}

/// Compiles the C client against the standard's headers and runs it, also under valgrind if available; if `is_long`, with more
/// loads and unloads, also under valgrind.
pub(crate) fn c_client(built: &Built, is_long: bool) -> Outcome {
    if !need("gcc", "the C client")? {
        return Ok(());
    }
    let scratch = build::scratch("c-client")?;
    let has_valgrind = need("valgrind", "the memory check of the C client")?;
    // Further arguments of each program, alone and under valgrind.
    let simulations = if is_long { "1000" } else { "100" };
    let programs = [("unload", &[simulations][..], is_long.then_some("3")), ("client", &[], Some("--short"))];
    for (name, whole, short) in programs {
        let program = compile_c(&scratch, name)?;
        run(command(&program).arg(&built.library).arg(&built.probe).args(whole).current_dir(&scratch))?;
        if let Some(short) = short.filter(|_| has_valgrind) {
            run(command("valgrind")
                .args(
                    "--quiet --leak-check=full --errors-for-leak-kinds=definite --error-exitcode=9"
                        .split(' '),
                )
                .arg(&program)
                .arg(&built.library)
                .arg(&built.probe)
                .arg(short)
                .current_dir(&scratch))?;
        }
    }
    Ok(())
}

/// Compiles `tests/c/<name>.c` into the scratch folder.
pub(crate) fn compile_c(scratch: &Path, name: &str) -> Result<PathBuf, String> {
    compile_c_for(&CCompiler::HERE, scratch, (name, name), &[])
}

/// A compiler of C and how it links.
pub(crate) struct CCompiler {
    pub program: &'static str,
    pub libraries: &'static [&'static str],
}

impl CCompiler {
    /// For this computer.
    pub(crate) const HERE: Self = Self { program: "gcc", libraries: &["-ldl", "-lm", "-pthread"] };
}

/// The same by another compiler, with more flags, under a name of its own.
pub(crate) fn compile_c_for(
    compiler: &CCompiler,
    scratch: &Path,
    (name, called): (&str, &str),
    flags: &[&str],
) -> Result<PathBuf, String> {
    let program = scratch.join(called);
    run(command(compiler.program)
        .args(["-std=c11", "-O2", "-g", "-Wall", "-Wextra", "-Werror"])
        .args(flags)
        .arg("-I")
        .arg(python::fmi_headers()?)
        .arg(root().join("tests").join("c").join(format!("{name}.c")))
        .arg("-o")
        .arg(&program)
        .args(compiler.libraries))?;
    Ok(program)
}
