//! Loads, steps and probes any FMI 2.0 co-simulation FMU.
//!
//! [`Fmu::open`] unpacks and reads an FMU, [`Instance::new`] makes a safe instance of it, and [`simulate`] runs
//! one from start to stop; [`conformance`] probes one, [`reference`] holds the flights that it carries. Everything this crate knows of an FMU it reads from the FMU; no model is linked here.
//!
//! All unsafe code of the harness stands in one folder, `abi/`.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]

mod abi;
mod access;
mod apart;
mod archive;
mod call_record;
mod checker;
pub mod conformance;
pub mod csv;
mod error;
mod fmu;
mod folder;
mod foreign;
mod inputs;
mod instance;
mod recorder;
mod recording;
pub mod reference;
mod requirements;
mod select;
mod simulate;
mod status;
mod times;
mod uri;
mod values;
mod watch;

pub use abi::{Binary, Callbacks, Described, SharedWords, set_locale};
pub use archive::{ArchiveLimits, path_inside, unpack};
pub use call_record::{
    CALL_RECORD_WORDS, CallRecord, RecordedCalls, call_in_progress, log_calls, record_calls, record_instance,
    recorded_calls, step_begin_s,
};
pub use checker::Checking;
pub use error::{CallError, Error, Outcome};
pub use fmu::{Fmu, platform_folders};
pub use folder::copy_folder;
pub use inputs::InputTable;
pub use instance::{Instance, InstanceOptions, Resources, State};
pub use model_description::Status;
pub use model_description::value::{Value, display_unit, unit};
pub use recorder::{Collector, Row, Rows};
pub use recording::{Column, Recording};
pub use requirements::Requirements;
pub use select::{select, select_outputs};
pub use simulate::{
    Ended, Options, Simulation, Stopped, initialize, outputs, set_early, simulate, simulate_instance,
    simulate_into, simulate_with,
};
pub use status::{LogMessage, warnings};
pub use times::{RecordedPoints, Times};
pub use uri::file_uri;
pub use values::{Assigned, assignment, parse_assignment, parse_value};
pub use watch::Watcher;
