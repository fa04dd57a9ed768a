//! SpinPlant through the functions a master calls.

mod driver;
mod flights;
mod refusals;
mod torn_states;
mod warnings;
