//! Request of an ephemeris.

use std::path::PathBuf;

use physics::environment::onboard::OnboardTarget;

use super::spk::Center;

/// Request of `heliotorque ephemeris`.
#[derive(Clone, Debug)]
pub struct EphemerisRequest {
    /// FMU that is simulated where there are no kernels.
    pub fmu: PathBuf,
    /// Start values of that FMU.
    pub set: Vec<String>,
    /// SPK kernels.
    pub kernels: Vec<PathBuf>,
    /// Centre of positions in kernels.
    pub center: Option<Center>,
    /// NAIF id of the spacecraft in kernels.
    pub spacecraft: Option<i32>,
    /// Bodies that are fitted.
    pub targets: Vec<OnboardTarget>,
    /// First and last epoch, in s past J2000 TDB.
    pub span_s: [f64; 2],
    /// Last epoch of coarse models, where they are requested.
    pub coarse_until_s: Option<f64>,
    /// Length of a segment, in s.
    pub segment_s: Option<f64>,
    /// Degree of the polynomials.
    pub degree: Option<usize>,
    /// Error of position that is allowed, in m.
    pub tolerance_m: f64,
    /// Whether no progress is shown.
    pub is_quiet: bool,
}
