//! Paper 001's attitude law with its options, scenarios and scans.

pub mod aimpoint;
pub mod aligned;
pub mod antenna;
pub mod boresight;
pub mod command;
pub mod law;
pub mod scan;
