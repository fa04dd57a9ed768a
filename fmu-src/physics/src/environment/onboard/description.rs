//! The shape of an ephemeris file.

use serde::Deserialize;

use super::target::OnboardTarget;
use crate::bodies::Body;
use crate::toml::{Epoch, Finite, NonEmpty, NotNegative, tables};

/// A frame.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) enum Frame {
    /// Mean equator and equinox of J2000.
    #[serde(rename = "EME2000")]
    Eme2000,
}

tables! {
/// Positions of bodies over time, as a spacecraft carries them.
#[cfg_attr(feature = "schema", schemars(title = "heliotorque ephemeris"))]
struct EphemerisDescription {
    /// The axes of all coordinates.
    frame: Frame,
    /// Where the positions come from, for people.
    source: Option<String>,
    /// The precise models: Chebyshev segments.
    body: Option<Vec<BodyDescription>>,
    /// The coarse models: polynomials of fourth degree of Keplerian elements.
    coarse: Option<Vec<CoarseDescription>>,
}

/// The precise model of a body.
struct BodyDescription {
    /// What is placed.
    body: OnboardTarget,
    /// From where its position counts; the Earth is not the barycentre of Earth and Moon.
    center: Body,
    /// Degree of every polynomial.
    degree: u32,
    /// Greatest error of position against the source, at epochs that were not fitted.
    error_m: NotNegative,
    /// Greatest error of velocity likewise.
    error_m_s: NotNegative,
    /// The polynomials in the order of time, each from where the one before ends.
    segment: NonEmpty<SegmentDescription>,
}

/// A polynomial of position: the sum of the coefficients times the Chebyshev polynomials T_0, T_1 and so on of x, which
/// goes from -1 to 1 over the segment.
struct SegmentDescription {
    /// Where it begins, in s past J2000 TDB.
    start_s: Epoch,
    /// Where it ends.
    end_s: Epoch,
    /// Coefficients of the position along X, one more than the degree.
    x_m: Vec<Finite>,
    /// Along Y.
    y_m: Vec<Finite>,
    /// Along Z.
    z_m: Vec<Finite>,
}

/// The coarse model of a body: classical elements, five Chebyshev coefficients each over the whole span.
struct CoarseDescription {
    /// What is placed: a planet about the Sun, or the spacecraft.
    body: OnboardTarget,
    /// What it moves about.
    center: Body,
    /// Where the span begins, in s past J2000 TDB.
    start_s: Epoch,
    /// Where it ends.
    end_s: Epoch,
    /// Greatest error of position against the source.
    error_m: NotNegative,
    /// Greatest error of velocity likewise.
    error_m_s: NotNegative,
    /// Semi-major axis.
    semi_major_axis_m: [Finite; 5],
    /// Eccentricity.
    eccentricity: [Finite; 5],
    /// Inclination to the equator of EME2000.
    inclination_rad: [Finite; 5],
    /// Right ascension of the ascending node.
    ascending_node_rad: [Finite; 5],
    /// Argument of periapsis.
    periapsis_argument_rad: [Finite; 5],
    /// Mean anomaly, running on over full turns.
    mean_anomaly_rad: [Finite; 5],
}
}

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
#[cfg(feature = "schema")]
pub fn schema() -> String {
    crate::toml::schema::<EphemerisDescription>()
}
