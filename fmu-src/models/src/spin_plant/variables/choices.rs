//! The spinner's choices.

use fmi_export::Enumeration;
use physics::spin::{
    forecast::Timing,
    plant::{self, Sampling},
};

use crate::common::choices::choices;

/// Shape of the burn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum BurnPlan {
    /// Equal pulses.
    Uniform = 1,
    /// Pulses rise and fall by binomial sums: 1 2 2 ... 2 1 for burn.taperOrder 1.
    Tapered = 2,
    /// Two equal halves, the second delayed until its nutation cancels the first's.
    Split = 3,
    /// None: thrusters fire by their inputs only.
    Commanded = 4,
}

choices! {
    /// What pulses are timed by.
    BurnTiming(Timing);
}

/// Origin of the directions of Sun and Earth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum GeometrySource {
    /// The inputs sun.direction and earth.direction.
    Inputs = 1,
    /// A Lissajous orbit about the Sun-Earth L1 point.
    L1Orbit = 2,
}

choices! {
    /// Origin of moments and products of inertia.
    MassSource(plant::MassSource);
    /// When the star tracker samples its star.
    StarSampling(Sampling);
}
