//! The heliotorque command line.

// They panic when the reader went away; `terminal` does not.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod app;
mod assembly;
mod carried;
mod check;
mod child;
mod compare;
mod completions;
mod draw;
mod ephemeris;
mod epoch;
mod home;
mod info;
mod instance;
mod interrupt;
mod kind;
mod library;
mod manual;
mod map;
mod mission;
mod new;
mod outcome;
mod output;
mod pack;
mod patience;
mod plan;
mod plot;
mod pointing;
mod reading;
mod refit;
mod run;
mod schema;
mod size;
mod study;
mod sweep;
mod table;
mod values;
mod variables;
mod wire;

use std::process::ExitCode;

fn main() -> ExitCode {
    app::run().unwrap_or_else(|error| {
        terminal::note(&format!("heliotorque: {}", fmi::Error::chain(error.as_ref())));
        if interrupt::raised() { ExitCode::from(interrupt::INTERRUPTED) } else { ExitCode::FAILURE }
    })
}
