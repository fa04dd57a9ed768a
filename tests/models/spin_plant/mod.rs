//! SpinPlant through the functions a master calls.

mod driver;
mod extremes;
mod flights;
mod refusals;
mod unknown_directions;
mod warnings;
