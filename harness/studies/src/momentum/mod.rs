//! Paper 000: 90 days of momentum under its strategies, and what sunlight does to the whole spacecraft.

mod cases;
mod figures;
mod lists;
mod off_sun;
mod paper;
mod spacing;
mod sphere;
mod tables;
mod trends;

pub use figures::{figure4, figure5};
pub use off_sun::off_sun;
pub use tables::{assumptions, table2, table3, table4, table5};
