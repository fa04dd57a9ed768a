//! Papers 000 and 003: 90 days of momentum under their strategies, what sunlight does to the whole spacecraft, and what changes it.

mod authority;
mod cases;
mod figures;
mod lists;
mod off_sun;
mod optimum;
mod paper;
mod sensitivity;
mod spacing;
mod sphere;
mod tables;
mod trends;
mod variant;
mod wheels;

pub(crate) use authority::authority;
pub(crate) use figures::{figure4, figure5};
pub(crate) use off_sun::off_sun;
pub(crate) use sensitivity::sensitivity;
pub(crate) use tables::{assumptions, dump_targets, table2, table3, table4, table5, tables};
pub(crate) use wheels::wheels;
