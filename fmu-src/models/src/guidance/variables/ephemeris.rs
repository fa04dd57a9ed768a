//! Ephemerides, and whether those that the spacecraft carries are trusted.

use core::f64::consts::PI;

use fmi_export::{Boolean, Choice, Real, Variables};
use physics::guidance::modes::body_positions;

use super::super::setup::GuidanceSetup as Setup;
use super::choices::{EphemerisModel, EphemerisSource};
use crate::common::ellipse::EllipseVariables;

/// Positions of the Sun, the target planet and the Earth.
#[derive(Variables)]
pub struct EphemerisVariables {
    /// Where the positions of Sun and Earth come from.
    #[parameter(start = EphemerisSource::Vsop87)]
    pub source: Choice<EphemerisSource>,
    #[group(name = "", setup = &setup.target)]
    pub ellipse: EllipseVariables,
    /// When source is chebyshev: how far from the sensed Sun that of the precise models, in the estimated body frame, may
    /// be (assumed; paper 001 names no angle).
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = body_positions::SUN_TOLERANCE_RAD)]
    pub tolerance: Real,
    /// For how long it may be farther away before the precise models are declared invalid (assumed).
    #[parameter(tunable, unit = "s", min = 0.0, max = 1e9, start = body_positions::SUN_PERSISTENCE_S)]
    pub persistence: Real,
    /// Whether the precise models are trusted; false once they disagreed with the Sun sensors or their span was left, until
    /// mode.request changes to operational.
    #[output]
    pub valid: Boolean,
    /// Which models the command goes by.
    #[output]
    pub active: Choice<EphemerisModel>,
}
