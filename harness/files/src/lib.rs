//! Files of the harness: inputs that are regular files, outputs that are whole or absent.
//!
//! Every file that a command writes goes through [`Destination`]: it is written beside its target and renamed. A
//! recording in progress is a [`Growing`] file, `<name>.part`. Temporary files and folders are known to
//! [`remove_temporaries`], which a signal handler calls.
#![allow(clippy::disallowed_methods, reason = "what others shall use is made of these")]

/// Type of what we add to files of other standards, which ask for a reversed domain name.
pub const ANNOTATION: &str = "io.github.heliotorque";

mod destination;
mod entries;
mod folder;
mod identity;
mod input;
pub mod outcome;
mod part;
mod paths;
mod place;
mod system;
mod temporary;

pub use destination::{Destination, Growing, is_stdout};
pub use entries::Entries;
pub use folder::{OutputFolder, leads_below, remove};
pub use input::{
    MAX_TABLE_BYTES, MAX_TEXT_BYTES, kind, names_in, open, open_at_most, read, read_at_most, read_text,
};
pub use part::Part;
pub use paths::{part_of, sidecar_of};
pub use system::canonical;
pub use temporary::{Scratch, remove_temporaries};
