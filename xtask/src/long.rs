//! `cargo xtask test --long`: lints, the guide, fuzzing, sanitizers, Miri, failing allocations, failing writes, long tests of
//! the models, of the shared library and in Python.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::build::{self, Built, TESTS};
use crate::shell::{Outcome, available, cargo, command, root, run, target};
use crate::test::{self, CCompiler, compile_c_for};
use crate::{dist, guide, paths, shell};

/// Fuzz targets, in `tests/fuzz/targets`.
const TARGETS: &[&str] = &["spacecraft", "model_description", "state", "calls", "zip"];
/// How long each target runs, in s; another number by this variable.
const SECONDS: &str = "60";
/// Limits of each input: time, memory, length.
const LIMITS: &str = "-timeout=20 -rss_limit_mb=2048 -max_len=32768 -len_control=0 -print_final_stats=1";
const SECONDS_VARIABLE: &str = "HELIOTORQUE_FUZZ_SECONDS";
/// Names the parts to run; without it `cargo xtask test` and all parts run. Tests have their long extent where it is set.
const VARIABLE: &str = "HELIOTORQUE_LONG";
/// Models, and the step in s, whose allocations fail.
const FAILING: &[(&str, &str)] =
    &[("MomentumPlant", "600"), ("SpinPlant", "0.5"), ("DisturbanceTorque", "60"), ("Guidance", "1")];
/// Allocations per model that fail in turn, evenly spread.
const ALLOCATIONS: &str = "300";
/// Number of writes after which a command that still fails on a full disk counts as one that never succeeds.
const MAX_WRITES: u32 = 2_000;

type Part = (&'static str, fn() -> Outcome);

const PARTS: &[Part] = &[
    ("lints", lints),
    ("guide", guide),
    ("fuzz", fuzz),
    ("sanitizers", sanitizers),
    ("miri", miri),
    ("allocations", allocations),
    ("writes", writes),
    ("models", models),
    ("suite", suite),
    ("python", python),
    ("shipped", shipped),
];

/// The suite, the tests in Python and the C client on the shipped libraries; before that, default experiments of all FMUs, which have the bits
/// of those by the libraries of `release`.
fn shipped() -> Outcome {
    test::current_environment()?;
    let flown = |name: &str| {
        let folder = build::scratch(&format!("shipped/{name}"))?;
        for fmu in dist::names() {
            run(command(&build::built().heliotorque)
                .arg("run")
                .arg(paths::dist(format!("{fmu}.fmu")))
                .args(["--quiet", "--output"])
                .arg(folder.join(format!("{fmu}.csv"))))?;
        }
        Ok::<_, String>(folder)
    };
    let with_tests = flown("with-tests")?;
    let built = dist::dist()?;
    let shipped = flown("shipped")?;
    for fmu in dist::names() {
        let [one, other] = [&with_tests, &shipped].map(|folder| fs::read(folder.join(format!("{fmu}.csv"))));
        if one.map_err(|error| error.to_string())? != other.map_err(|error| error.to_string())? {
            return Err(format!("{fmu}: the shipped library has other bits than that of profile release"));
        }
    }
    let environment = test::environment(&built)?;
    let mut suite = cargo(&format!("test {TESTS} --test suite"));
    run(suite.envs(environment.clone()).env_remove(VARIABLE).env("HELIOTORQUE_SHIPPED", "1"))?;
    test::python(environment, "not long")?;
    test::c_client(&built, false)
}

/// Everything `cargo xtask test` runs, then the longer searches for faults; stops at the first that fails.
pub(crate) fn all() -> Outcome {
    let Some(chosen) = std::env::var_os(VARIABLE) else {
        test::all()?;
        return PARTS.iter().try_for_each(|(_, part)| part());
    };
    let chosen = chosen.to_string_lossy().into_owned();
    for name in chosen.split(',') {
        let (_, part) = PARTS.iter().find(|(known, _)| *known == name).ok_or_else(|| {
            let names: Vec<&str> = PARTS.iter().map(|(name, _)| *name).collect();
            format!("{VARIABLE}: no part `{name}`; there are {}", names.join(", "))
        })?;
        part()?;
    }
    Ok(())
}

/// The tests in Python that take minutes, last what builds and packs anew what the others read.
fn python() -> Outcome {
    let environment = test::current_environment()?;
    test::python(environment.clone(), "long and not rebuilds")?;
    test::python(environment, "rebuilds")
}

/// Lints of all crates, including the guide's builder.
fn lints() -> Outcome {
    if shell::output(&mut cargo("clippy --version")).is_err() {
        return shell::lacks("cargo clippy", "lints");
    }
    run(&mut cargo(&format!("clippy {TESTS} --all-targets --quiet -- -D warnings")))?;
    guide::lint()
}

/// Tests of the guide: links, commands, completeness.
fn guide() -> Outcome {
    guide::test(test::current_environment()?)
}

/// Tests of the physics and of the models in their long extent.
fn models() -> Outcome {
    // Its unit tests are `physics-units`.
    let programs = "--exclude physics --lib --test models --test physics --test physics-units";
    run(cargo(&format!("test {TESTS} {programs}")).env(VARIABLE, "models"))
}

/// Tests of the shared library and of the command line in their long extent, and the C client.
fn suite() -> Outcome {
    let environment = test::current_environment()?;
    run(cargo(&format!("test {TESTS} --test suite --test main")).envs(environment).env(VARIABLE, "suite"))?;
    test::c_client(&build::built(), true)
}

fn skipped(what: &str, missing: &str) -> Outcome {
    eprintln!("skipped: {what} (no {missing} on this machine)");
    Ok(())
}

/// `cargo +nightly`; the outer cargo's own choice of toolchain must not reach it.
fn nightly(arguments: &str) -> Command {
    let mut nightly = command("cargo");
    nightly.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN").env_remove("RUSTC");
    nightly.arg("+nightly").args(arguments.split_whitespace());
    nightly
}

fn answers(program: &mut Command) -> bool {
    program.output().is_ok_and(|output| output.status.success())
}

/// Each target for its time, on a copy of its corpus: what is found stays under `target/`.
fn fuzz() -> Outcome {
    if !answers(&mut nightly("--version")) {
        return skipped("fuzzing", "nightly toolchain: `rustup toolchain install nightly`");
    }
    if !answers(&mut nightly("fuzz --version")) {
        return skipped("fuzzing", "cargo-fuzz: `cargo install cargo-fuzz`");
    }
    let package = root().join("tests").join("fuzz");
    let seconds = std::env::var(SECONDS_VARIABLE).unwrap_or_else(|_| SECONDS.to_owned());
    for name in TARGETS {
        let found = build::scratch(&format!("fuzz/{name}"))?;
        run(nightly("fuzz run --fuzz-dir")
            .arg(&package)
            .arg("--target-dir")
            .arg(target().join("fuzz"))
            .arg(name)
            .arg(&found)
            .arg(package.join("corpus").join(name))
            .arg("--")
            .arg(format!("-max_total_time={seconds}"))
            .arg(format!(
                "-artifact_prefix={}/",
                build::scratch(&format!("fuzz/{name}-artifacts"))?.display()
            ))
            .args(LIMITS.split_whitespace()))?;
    }
    Ok(())
}

/// The C client, instrumented: the library's blocks are checked at the boundary, the client's threads against each
/// other.
fn sanitizers() -> Outcome {
    if !available("gcc") {
        return skipped("the C client under the sanitizers", "gcc");
    }
    let built = build::build()?;
    let scratch = build::scratch("sanitizers")?;
    for sanitizer in ["address,undefined", "thread"] {
        let flag = format!("-fsanitize={sanitizer}");
        let empty = scratch.join("empty.c");
        paths::write(&empty, "int main(void) { return 0; }\n")?;
        if !answers(command("gcc").arg(&flag).arg(&empty).arg("-o").arg(scratch.join("empty"))) {
            skipped(&format!("the C client under {flag}"), "library of this sanitizer")?;
            continue;
        }
        let name = sanitizer.replace(',', "-");
        let called = format!("client-{name}");
        let flags = [flag.as_str(), "-fno-omit-frame-pointer"];
        let client = compile_c_for(&CCompiler::HERE, &scratch, ("client", &called), &flags)?;
        // Older thread sanitizers do not work with addresses as random as newer kernels make them.
        let mut launched = command(&client);
        if available("setarch") {
            launched = command("setarch");
            launched.arg("--addr-no-randomize").arg(&client);
        }
        run(launched.arg(&built.library).arg(&built.probe).arg("--short").current_dir(&scratch))?;
    }
    Ok(())
}

/// The exporter's unit tests in Miri. Not those of its interface: Miri refuses a logger of fixed arguments behind the
/// variadic type, which stable Rust cannot define, and describes a model for minutes. Nor what starts a process.
fn miri() -> Outcome {
    if !answers(&mut nightly("miri --version")) {
        return skipped("Miri", "Miri: `rustup component add --toolchain nightly miri rust-src`");
    }
    run(nightly("miri test --locked -p fmi-export --lib --target-dir")
        .arg(target().join("miri"))
        .args(["--", "--skip", "what_is_no_regular_file_is_refused_by_name"])
        .env("MIRIFLAGS", "-Zmiri-disable-isolation"))
}

/// The n-th allocation fails: an answer, or the abort that Rust documents, and nothing else.
fn allocations() -> Outcome {
    if !available("gcc") || !cfg!(all(target_os = "linux", target_env = "gnu")) {
        return skipped("failing allocations", "gcc with glibc");
    }
    let built = build::build()?;
    let scratch = build::scratch("allocations")?;
    let client = compile_c_for(&CCompiler::HERE, &scratch, ("allocation", "allocation"), &["-rdynamic"])?;
    for (model, step_s) in FAILING {
        run(command(&client).arg(&built.library).args([model, step_s, ALLOCATIONS]).current_dir(&scratch))?;
    }
    Ok(())
}

/// The disk is full from the n-th write on: the command fails, names the file and leaves the old one whole.
fn writes() -> Outcome {
    if !available("gcc") || !cfg!(target_os = "linux") {
        return skipped("failing writes", "gcc on Linux");
    }
    let built = dist::dist()?;
    let scratch = build::scratch("writes")?;
    let full_disk = scratch.join("full_disk.so");
    run(command("gcc")
        .args(["-std=c11", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC"])
        .arg(root().join("tests").join("c").join("full_disk.c"))
        .arg("-o")
        .arg(&full_disk)
        .arg("-ldl"))?;
    let plant = paths::dist("MomentumPlant.fmu");
    let plant = plant.to_string_lossy();
    let spacecraft = paths::resource("messenger.toml");
    let commands: [(&[&str], &str, &str); 3] = [
        (&["run", &plant, "--stop", "2d", "--quiet"], "--output", "rows.csv"),
        (&["run", &plant, "--stop", "2d", "--quiet"], "--output", "rows.svg"),
        (
            &["pack", "--template", &plant, "--spacecraft", &spacecraft.to_string_lossy()],
            "--output",
            "Own.fmu",
        ),
    ];
    commands.into_iter().try_for_each(|command| on_a_full_disk(&built, &scratch, &full_disk, command))
}

/// Content of the target before the command.
const OLD: &str = "old";

fn on_a_full_disk(
    built: &Built,
    scratch: &Path,
    full_disk: &Path,
    (arguments, option, file): (&[&str], &str, &str),
) -> Outcome {
    let [target_folder, unpacked] = [scratch.join("full-disk"), scratch.join("unpacked")];
    let target = target_folder.join(file);
    let named = format!("heliotorque {} {option} {file}", arguments[0]);
    let at_target = |error: std::io::Error| format!("{}: {error}", target_folder.display());
    for write in 1..=MAX_WRITES {
        for folder in [&target_folder, &unpacked] {
            if folder.exists() {
                fs::remove_dir_all(folder).map_err(at_target)?;
            }
            fs::create_dir_all(folder).map_err(at_target)?;
        }
        fs::write(&target, OLD).map_err(at_target)?;
        let output = command(&built.heliotorque)
            .args(arguments)
            .arg(option)
            .arg(&target)
            .env("TMPDIR", &unpacked)
            .env("LD_PRELOAD", full_disk)
            .env("FULL_DISK_FROM", write.to_string())
            .output()
            .map_err(|error| format!("{named}: {error}"))?;
        if output.status.success() {
            eprintln!("{named}: {} writes failed in turn, each reported and no file damaged", write - 1);
            return if write > 1 { Ok(()) } else { Err(format!("{named}: wrote nothing that could fail")) };
        }
        let stderr = String::from_utf8_lossy(&output.stderr);
        let fault =
            |what: &str| Err(format!("{named}, disk full from write {write} on: {what}; stderr: {stderr}"));
        if output.status.code().is_none() {
            return fault("it crashed");
        }
        if !stderr.contains("No space left") {
            return fault("the cause is not reported");
        }
        if !stderr.contains(file) && !stderr.contains(&*unpacked.to_string_lossy()) {
            return fault("no file is named");
        }
        if fs::read(&target).ok().as_deref() != Some(OLD.as_bytes()) {
            return fault("the old file is damaged or gone");
        }
        if fs::read_dir(&unpacked).map_err(at_target)?.next().is_some() {
            return fault("it left what it unpacked");
        }
        // A recording in progress stays as far as it came.
        let mut left =
            fs::read_dir(&target_folder).map_err(at_target)?.flatten().map(|entry| entry.file_name());
        if let Some(left) = left.find(|name| name != file && *name != *format!("{file}.part")) {
            return fault(&format!("it left {}", left.display()));
        }
    }
    Err(format!("{named}: still fails with {MAX_WRITES} writes"))
}
