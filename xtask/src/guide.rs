//! `cargo xtask guide`: the guide of `docs/`, by mdBook, in a workspace of its own.

use std::ffi::OsString;

use crate::shell::{Outcome, cargo, root, run, target};

/// Builds it into `target/guide`; says where its first page is.
pub(crate) fn build() -> Outcome {
    run(&mut in_workspace("run --locked"))
}

/// Checks the form of its builder's code.
pub(crate) fn check_format() -> Outcome {
    run(&mut in_workspace("fmt --check"))
}

/// Lints its builder's code.
pub(crate) fn lint() -> Outcome {
    run(&mut in_workspace("clippy --locked --all-targets --quiet -- -D warnings"))
}

/// Builds it and checks its links, commands and completeness.
pub(crate) fn test(environment: impl IntoIterator<Item = (&'static str, impl Into<OsString>)>) -> Outcome {
    let environment = environment.into_iter().map(|(name, value)| (name, value.into()));
    run(in_workspace("test --locked").envs(environment))
}

/// Cargo in the folder of the guide's builder; its products stand next to all others.
fn in_workspace(arguments: &str) -> std::process::Command {
    let mut command = cargo(arguments);
    command.current_dir(root().join("tests").join("guide")).env("CARGO_TARGET_DIR", target());
    command
}
