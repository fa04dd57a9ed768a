//! The heliotorque command line.

mod app;
mod args;
mod check;
mod coefficients;
mod fly;
mod info;
mod output;
mod pack;
mod plan;
mod plot;
mod study;

use std::process::ExitCode;

fn main() -> ExitCode {
    app::run().unwrap_or_else(|error| {
        eprintln!("heliotorque: {}", output::chain(error.as_ref()));
        ExitCode::FAILURE
    })
}
