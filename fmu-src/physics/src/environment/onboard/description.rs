//! The shape of an ephemeris file.

use serde::Deserialize;

use super::target::OnboardTarget;
use crate::bodies::Body;

/// Positions of bodies over time, as a spacecraft carries them.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(title = "heliotorque ephemeris"))]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    /// The axes of all coordinates.
    pub frame: Frame,
    /// Where the positions come from, for people.
    pub source: Option<String>,
    /// The precise models: Chebyshev segments.
    pub body: Option<Vec<BodyDescription>>,
    /// The coarse models: polynomials of fourth degree of Keplerian elements.
    pub coarse: Option<Vec<CoarseDescription>>,
}

/// A frame.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) enum Frame {
    /// Mean equator and equinox of J2000.
    #[serde(rename = "EME2000")]
    Eme2000,
}

/// The precise model of a body.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct BodyDescription {
    /// What is placed.
    pub body: OnboardTarget,
    /// From where its position counts; the Earth is not the barycentre of Earth and Moon.
    pub center: Body,
    /// Degree of every polynomial.
    pub degree: u32,
    /// Greatest error of position against the source, at epochs that were not fitted.
    pub error_m: f64,
    /// Greatest error of velocity likewise.
    pub error_m_s: f64,
    /// The polynomials in the order of time, each from where the one before ends.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub segment: Vec<SegmentDescription>,
}

/// A polynomial of position: the sum of the coefficients times the Chebyshev polynomials T_0, T_1 and so on of x, which
/// goes from -1 to 1 over the segment.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct SegmentDescription {
    /// Where it begins, in s past J2000 TDB.
    pub start_s: f64,
    /// Where it ends.
    pub end_s: f64,
    /// Coefficients of the position along X, one more than the degree.
    pub x_m: Vec<f64>,
    /// Along Y.
    pub y_m: Vec<f64>,
    /// Along Z.
    pub z_m: Vec<f64>,
}

/// The coarse model of a body: classical elements, five Chebyshev coefficients each over the whole span.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct CoarseDescription {
    /// What is placed: a planet about the Sun, or the spacecraft.
    pub body: OnboardTarget,
    /// What it moves about.
    pub center: Body,
    /// Where the span begins, in s past J2000 TDB.
    pub start_s: f64,
    /// Where it ends.
    pub end_s: f64,
    /// Greatest error of position against the source.
    pub error_m: f64,
    /// Greatest error of velocity likewise.
    pub error_m_s: f64,
    /// Semi-major axis.
    pub semi_major_axis_m: [f64; 5],
    /// Eccentricity.
    pub eccentricity: [f64; 5],
    /// Inclination to the equator of EME2000.
    pub inclination_rad: [f64; 5],
    /// Right ascension of the ascending node.
    pub ascending_node_rad: [f64; 5],
    /// Argument of periapsis.
    pub periapsis_argument_rad: [f64; 5],
    /// Mean anomaly, running on over full turns.
    pub mean_anomaly_rad: [f64; 5],
}
