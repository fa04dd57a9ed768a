//! The spinner's choices.

use fmi_export::Enumeration;

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

/// What pulses are timed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum BurnTiming {
    /// The first pulse by phase, the others at fixed intervals of the assumed spin period.
    Clock = 1,
    /// A delay at the assumed spin rate after each Sun crossing.
    SunCrossing = 2,
    /// The instant that points exactly at the target, each turn.
    TruePhase = 3,
}

/// Origin of the directions of Sun and Earth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum GeometrySource {
    /// The inputs sun.direction and earth.direction.
    Inputs = 1,
    /// A Lissajous orbit about the Sun-Earth L1 point.
    L1Orbit = 2,
}

/// Origin of the moments of inertia.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum MassSource {
    /// The parameter inertia, unchanged by propellant use.
    Fixed = 1,
    /// The setup's table over propellant, at the end of each pulse.
    Propellant = 2,
}

/// When the star tracker samples its star.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum StarSampling {
    /// When it passes the boresight, on the turns that search its picket.
    Spins = 1,
    /// Every 8 turns of the nominal rate by the clock, as paper 002 assumes in eqs 16 to 20.
    Clock = 2,
}
