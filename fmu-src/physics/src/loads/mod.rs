//! Loads on a spacecraft: the table of effects, and force and torque of each as data. Their laws stand in later modules.

mod by_effect;
mod effect;
mod force_torque;

pub use by_effect::{ByEffect, Loads};
pub use effect::{Active, Effect, EffectRow, Grid, Switch, Writer};
pub use force_torque::{ForceTorque, Linear};
