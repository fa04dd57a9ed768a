//! Systems of FMUs in SSP 1.0: read, checked, written, wired and simulated.
//!
//! [`System::open`] unpacks an SSP and holds it against its FMUs; [`simulate_into`] runs it with a fixed communication step;
//! [`wire`] makes one of FMUs by the names of their variables. FMUs are loaded and called through `fmi`.

mod annotations;
mod check;
mod connectors;
mod elements;
mod error;
mod exchange;
mod experiment;
mod joint;
mod master;
mod merged;
mod own;
mod package;
mod parameter_mapping;
mod parameter_set;
mod parameters;
mod reader;
mod recorder;
mod simulate;
mod structure;
mod system;
mod units;
mod unread;
mod wire;
mod writer;

pub use check::findings;
pub use error::Error;
pub use joint::{ConnectedVariable, Joint};
pub use master::{FirstExchange, Master};
pub use own::Own;
pub use package::{MAX_BYTES, is_system};
pub use reader::{MAX_COMPONENTS, read as read_structure};
pub use simulate::simulate_into;
pub use structure::{
    Binding, Component, Connection, Connector, ConnectorKind, End, Enumeration, Linear, Mapping,
    MappingEntry, Parameter, ParameterSet, SSD_FILE, Signal, Structure, Transformation, Written,
};
pub use system::{Part, System};
pub use unread::Unread;
pub use wire::{OpenInput, Wired, Wiring, component_name, wire};
pub use writer::{to_parameter_set, to_xml};
