//! Guidance through the functions a master calls.

mod antennas;
mod burn;
mod burn_timeline;
mod controlled;
mod cuts;
mod ephemeris;
mod modes;
mod momentum;
mod own_spacecraft;
mod pointing;
mod predictive;
mod same_law;
mod zeros;

pub(crate) use cuts::CUT;
use models::Guidance;
use nalgebra::UnitQuaternion;

use super::named_model::NamedInstance;

type GuidanceInstance<'a> = NamedInstance<'a, Guidance>;

/// Above Mercury, with Sun and Earth as inputs.
pub(crate) const PLACED: &[(&str, f64)] = &[
    ("ephemeris.source", 3.0),
    ("position[1]", 3e6),
    ("position[2]", 1e6),
    ("position[3]", 2e6),
    ("velocity[1]", -900.0),
    ("velocity[2]", 2_000.0),
    ("velocity[3]", 400.0),
    ("sun.position[1]", 3e10),
    ("sun.position[2]", -4e10),
    ("sun.position[3]", 2e9),
    ("earth.position[1]", -9e10),
    ("earth.position[2]", 5e10),
    ("earth.position[3]", -3e9),
];

/// An attitude without constraints or monitor.
const FREE: &[(&str, f64)] = &[("keepIn.enabled", 0.0), ("hotPole.enabled", 0.0), ("monitor.enabled", 0.0)];

fn with<'a>(lists: &[&[(&'a str, f64)]]) -> Vec<(&'a str, f64)> {
    lists.concat()
}

/// From body to inertial components.
fn to_inertial(flight: &GuidanceInstance<'_>) -> UnitQuaternion<f64> {
    flight.to_inertial("command.q")
}
