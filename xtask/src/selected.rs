//! `cargo xtask test NAME`: the tests whose name contains a text; `cargo xtask bless`: what they compare with, written anew.

use std::path::PathBuf;
use std::process::Stdio;

use serde_json::Value;

use crate::build::TESTS;
use crate::shell::{Outcome, cargo, command, output, run};
use crate::{python, test};

/// Folders whose tests need nothing that is built or packed.
const FREE_STANDING: &[&str] = &["fmu-src", "modelDescription", "tests/models", "tests/physics"];

/// With this set, tests write what they compare with.
const BLESS: (&str, &str) = ("HELIOTORQUE_BLESS", "1");

/// Recordings that can be written anew: name, the tests in Rust that write them, those in Python.
const RECORDED: &[(&str, Option<&str>, Option<&str>)] = &[
    ("golden", Some("golden::every_shipped_model"), None),
    ("reference", Some("reference::"), None),
    ("schema", Some("in_step"), None),
    ("mistakes", Some("mistakes::"), None),
    ("legs", Some("the_shipped_missions_are_those_of_their_legs"), None),
    ("guide", None, Some("prints_what or follow_the_schemas or written")),
];

/// A program with tests, its source file and the folder of its crate.
struct TestProgram {
    path: PathBuf,
    source: PathBuf,
    crate_folder: PathBuf,
}

/// Runs the tests in Rust and in Python whose name contains `name`, after building what they need.
pub(crate) fn named(name: &str) -> Outcome {
    let programs = with_tests(name)?;
    let in_python = collects(name)?;
    if programs.is_empty() && !in_python {
        return Err(format!("no test has `{name}` in its name"));
    }
    run_selected(&programs, name, in_python.then_some(name), &[])
}

/// Writes anew what the tests of that name compare with.
pub(crate) fn bless(name: &str) -> Outcome {
    let known = || RECORDED.iter().map(|(name, ..)| *name).collect::<Vec<_>>().join(", ");
    let (_, rust, python) = RECORDED
        .iter()
        .find(|(recorded, ..)| *recorded == name)
        .ok_or_else(|| format!("bless: `{name}` is not recorded; there are {}", known()))?;
    let programs = rust.map_or(Ok(Vec::new()), with_tests)?;
    run_selected(&programs, rust.unwrap_or_default(), *python, &[BLESS])
}

fn run_selected(
    programs: &[TestProgram],
    in_rust: &str,
    in_python: Option<&str>,
    more: &[(&str, &str)],
) -> Outcome {
    let is_free_standing = |program: &TestProgram| {
        FREE_STANDING.iter().any(|folder| program.source.starts_with(crate::shell::root().join(folder)))
    };
    let environment = if in_python.is_none() && programs.iter().all(is_free_standing) {
        Vec::new()
    } else {
        test::current_environment()?
    };
    for program in programs {
        run(command(&program.path)
            .arg(in_rust)
            .current_dir(&program.crate_folder)
            .envs(environment.clone())
            .envs(more.iter().copied()))?;
    }
    let Some(name) = in_python else { return Ok(()) };
    let mut tests = python::pytest()?;
    run(tests.args(["tests/python", "-k", name]).envs(environment).envs(more.iter().copied()))
}

/// The programs that have a test with `name` in its name.
fn with_tests(name: &str) -> Result<Vec<TestProgram>, String> {
    let build = output(
        cargo(&format!("test --tests --no-run --message-format=json-render-diagnostics {TESTS}"))
            .stderr(Stdio::inherit()),
    )?;
    let mut found = Vec::new();
    for program in build.lines().filter_map(test_program) {
        let listed =
            output(command(&program.path).args(["--list", name]).current_dir(&program.crate_folder))?;
        if listed.lines().any(|line| line.ends_with(": test")) {
            found.push(program);
        }
    }
    Ok(found)
}

/// The test program that a line of cargo's messages names.
fn test_program(line: &str) -> Option<TestProgram> {
    let message: Value = serde_json::from_str(line).ok()?;
    let path = |value: &Value| value.as_str().map(PathBuf::from);
    let executable = path(&message["executable"]).filter(|_| message["profile"]["test"] == true)?;
    let source = path(&message["target"]["src_path"])?;
    let crate_folder = path(&message["manifest_path"])?.parent()?.to_owned();
    Some(TestProgram { path: executable, source, crate_folder })
}

/// Whether a test in Python has `name` in its name.
fn collects(name: &str) -> Result<bool, String> {
    /// Exit status of pytest where it collects nothing.
    const NOTHING: i32 = 5;
    let ended = python::pytest()?.args(["--collect-only", "tests/python", "-k", name]).output();
    let ended = ended.map_err(|error| format!("cannot start pytest: {error}"))?;
    match ended.status.code() {
        Some(0) => Ok(true),
        Some(NOTHING) => Ok(false),
        _ => Err(format!("pytest does not collect the tests:\n{}", String::from_utf8_lossy(&ended.stdout))),
    }
}

#[cfg(test)]
mod tests {
    //! Cargo's messages name the programs with tests.

    use super::*;

    #[test]
    fn programs_with_tests_are_reported_from_others() {
        let message = |test: bool, executable: &str| {
            format!(
                r#"{{"reason":"compiler-artifact","package_id":"a#0.1.0","manifest_path":"/w/a/Cargo.toml","target":{{"kind":["lib"],"name":"a","src_path":"/w/a/src/lib.rs","doctest":true,"test":true}},"profile":{{"opt_level":"3","debug_assertions":false,"test":{test}}},"filenames":[],"executable":{executable},"fresh":true}}"#
            )
        };
        let program = test_program(&message(true, "\"/w/target/a-1\"")).unwrap();
        assert_eq!((program.path, program.crate_folder), ("/w/target/a-1".into(), "/w/a".into()));
        assert_eq!(program.source, PathBuf::from("/w/a/src/lib.rs"));
        assert!(test_program(&message(false, "\"/w/target/a\"")).is_none());
        assert!(test_program(&message(true, "null")).is_none());
        assert!(test_program(r#"{"reason":"build-finished","success":true}"#).is_none());
    }
}
