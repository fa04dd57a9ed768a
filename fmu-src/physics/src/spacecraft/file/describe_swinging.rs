//! The shape of flexible modes and propellant in a spacecraft file.

use crate::spacecraft::swinging::COAST_FREQUENCY_HZ;
use crate::toml::{Fraction, Frequency, Point, Positive, UnitVector, tables};

/// Damping ratio of what swings where the file gives none. Assumed.
const DAMPING: f64 = 0.005;

tables! {
/// A flexible mode, of a panel or a boom, in hybrid coordinates: with modal displacement e, e'' + 2 z w e' + w^2 e = -d.w',
/// and the body's momentum holds d e'.
struct FlexibleModeDescription called "flexible mode" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Frequency with the body held, in Hz.
    frequency_hz: Frequency,
    /// Damping ratio.
    damping: Fraction = DAMPING,
    /// Coupling d to rotation about the body axes, for a modal mass of 1, in sqrt(kg) m; the sum of d d^T over all modes is less
    /// than the inertia.
    coupling_sqrt_kg_m as coupling_body_sqrt_kg_m: Point,
}

/// Propellant that swings as a pendulum.
struct SloshDescription called "slosh" {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Mass that swings, in kg; a part of mass_properties.mass_kg, at rest in its inertia.
    mass_kg: Positive,
    /// Length of the pendulum, in m.
    length_m: Positive,
    /// Pivot, body frame, in m.
    pivot_m as pivot_body_m: Point,
    /// Unit vector from the pivot to the mass at rest, body frame: against the acceleration by the thrusters it swings under.
    axis as axis_body: UnitVector,
    /// Damping ratio.
    damping: Fraction = DAMPING,
    /// Frequency without acceleration, in Hz, by surface tension or a membrane.
    coast_frequency_hz: Frequency = COAST_FREQUENCY_HZ,
}
}
