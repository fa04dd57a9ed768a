//! The orbit phase of paper 000: science, downlink and the turns between them, by a schedule after periapsis.

pub mod attitudes;
pub mod downlink_sun;
pub mod guided;
pub mod periapsis_count;
pub mod predicted_orbit;
pub mod schedule;
pub mod science_arc;
