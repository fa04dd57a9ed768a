//! The spinner's choices.

use fmi_export::Enumeration;
use physics::spin::{
    forecast::Timing,
    plant::{self, Sampling},
};

use crate::common::choices::enumeration_of;

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

enumeration_of! {
    /// What pulses are timed by.
    BurnTiming(Timing) {
        /// The first pulse by phase, the others at fixed intervals of the assumed spin period.
        clock = 1 => Clock,
        /// A delay at the assumed spin rate after each Sun crossing.
        sunCrossing = 2 => SunCrossing,
        /// The instant that points exactly at the target, each turn.
        truePhase = 3 => TruePhase,
    }
}

/// Origin of the directions of Sun and Earth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum GeometrySource {
    /// The inputs sun.direction and earth.direction.
    Inputs = 1,
    /// A Lissajous orbit about the Sun-Earth L1 point.
    L1Orbit = 2,
}

enumeration_of! {
    /// Origin of moments and products of inertia.
    MassSource(plant::MassSource) {
        /// The parameters inertia and productsOfInertia, unchanged by propellant use.
        fixed = 1 => Fixed,
        /// The setup's table over propellant, at the end of each pulse.
        propellant = 2 => Propellant,
    }
}

enumeration_of! {
    /// When the star tracker samples its star.
    StarSampling(Sampling) {
        /// When it passes the boresight, on the turns that search its picket.
        spins = 1 => Spins,
        /// Every 8 turns of the nominal rate by the clock, as paper 002 assumes in eqs 16 to 20.
        clock = 2 => Clock,
    }
}
