//! The heliotorque command line.

// They panic when the reader went away; `terminal` does not.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod app;
mod check;
mod compare;
mod completions;
mod draw;
mod ephemeris;
mod info;
mod manual;
mod map;
mod new;
mod pack;
mod patience;
mod plan;
mod plot;
mod refit;
mod run;
mod schema;
mod size;
mod sweep;
mod usage;
mod wire;

use std::process::ExitCode;

fn main() -> ExitCode {
    let status = app::run().map_or_else(
        |error| {
            terminal::note(&format!("heliotorque: {}", fmi::Error::chain(error.as_ref())));
            if isolation::interrupt::raised() {
                files::outcome::Answer::Interrupted as u8
            } else {
                files::outcome::TROUBLE
            }
        },
        |answer| answer as u8,
    );
    ExitCode::from(status)
}
