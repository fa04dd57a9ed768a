//! Request to a child process, and the frames that it answers with.

use std::{borrow::Cow, ffi::OsString};

use files::outcome::Answer;
use fmi::{Ended, Row, conformance::Finding};
use serde::{Deserialize, Serialize};

/// The only argument of a child process.
pub const CHILD: &str = "in-child";
/// Fault of a frame that was not requested.
pub const NOT_REQUESTED: &str = "it sent what was not requested";

/// Task of a child process. A path may hold any bytes, as an argument does.
#[derive(Debug, Serialize, Deserialize)]
pub enum Request {
    /// Command, by the arguments after the program.
    Command(Vec<OsString>),
    /// The FMU of a mission's files, put together in an empty folder.
    Assemble {
        /// File of the mission.
        mission: OsString,
        /// File that messages name.
        file: OsString,
        /// FMU whose library reads the files.
        template: Option<OsString>,
        /// Folder that becomes the FMU's.
        into: OsString,
    },
    /// Probe or trial of an unpacked FMU.
    Probe {
        /// Folder of the FMU.
        folder: OsString,
        /// Name of the probe.
        name: String,
    },
    /// Run of an unpacked FMU or system.
    Run {
        /// The parent's arguments after the program.
        arguments: Vec<OsString>,
        /// Folder of the FMU or system.
        folder: OsString,
        /// Copy of the parent's standard input.
        input_copy: Option<OsString>,
    },
    /// Runs of a campaign.
    Sweep(Runs),
}

/// Every n-th run of a campaign.
#[derive(Debug, Serialize, Deserialize)]
pub struct Runs {
    /// File of the campaign.
    pub campaign: OsString,
    /// Folder of the unpacked FMU.
    pub folder: OsString,
    /// The first run.
    pub first: u64,
    /// Distance of the runs.
    pub stride: u64,
    /// The first run that is not simulated.
    pub end: u64,
    /// Whether every run has a new instance.
    pub is_fresh: bool,
}

/// Message of a child process to its parent.
#[derive(Debug, Serialize, Deserialize)]
pub enum Frame<'a> {
    /// Bytes of the standard output.
    Output(&'a [u8]),
    /// Line beside the output.
    Note(&'a str),
    /// Text of a progress bar.
    Bar(&'a str),
    /// Recorded values at a time.
    Row(Row<'a>),
    /// Numbers whose order both processes know.
    Numbers(Cow<'a, [f64]>),
    /// Message of an instance's log: status, category, text.
    Message(i32, #[serde(borrow)] Option<&'a str>, &'a str),
    /// Finding of a probe.
    Finding(Finding),
    /// Number of a run of a campaign that starts; whether its instance was reset for it.
    RunStarted(u64, bool),
    /// End of that run: number of its status, kept numbers, reason.
    RunEnded(u8, Cow<'a, [f64]>, Cow<'a, str>),
    /// End of a simulation.
    Ended(Ended),
    /// End of the task.
    Done(Answer),
    /// Failure of the task.
    Failed(Cow<'a, str>),
}
