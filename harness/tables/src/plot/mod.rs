//! Pictures of tables: over time, overlaid, percentiles, histogram, scatter, heat, tornado.

pub mod bands;
pub mod cells;
pub mod heat;
pub mod over_time;
pub mod runs;
pub mod tornado;
