//! Request of a turn of a spinner.

use std::path::PathBuf;

use physics::spin::forecast::Timing;

/// The spacecraft that is planned for unless another is named: the shipped ACE.
pub(crate) const ACE: &str = include_str!("../../../../fmu-src/resources/ace.toml");

/// A direction in EME2000.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct RightAscensionDeclination {
    /// In deg.
    pub right_ascension_deg: f64,
    /// In deg, -90 to 90.
    pub declination_deg: f64,
}

/// Request of `heliotorque plan spin`.
#[derive(Clone, Debug)]
pub struct TurnRequest {
    /// Angle by which the spin axis shall turn.
    pub angle_deg: f64,
    /// Way of that turn about the spin axis, right-handed from the Sun.
    pub direction_deg: f64,
    /// Target of the turn, in place of angle and direction.
    pub target: Option<RightAscensionDeclination>,
    /// Spin axis at the start; otherwise by the spacecraft's file.
    pub from: Option<RightAscensionDeclination>,
    /// Date of the turn, in s past J2000 TDB.
    pub date: Option<f64>,
    /// Toward the Sun, in place of the date.
    pub sun: Option<RightAscensionDeclination>,
    /// Toward the Earth, in place of the date.
    pub earth: Option<RightAscensionDeclination>,
    /// Part of the angle by which trains may miss it.
    pub angle_tolerance_percent: f64,
    /// Inertia ratio I3/IT; otherwise the spacecraft's.
    pub ratio: Option<f64>,
    /// Error of the ratio either way.
    pub ratio_uncertainty: f64,
    /// Spin rate; otherwise by the spacecraft's file.
    pub rate_rpm: Option<f64>,
    /// Error of the spin rate either way.
    pub rate_uncertainty_rpm: f64,
    /// Name of the thruster or group; otherwise the first that tilts the spin axis alone.
    pub thruster: Option<String>,
    /// Timing of the pulses.
    pub timing: Timing,
    /// Angle from the spin axis to the Sun where neither date nor Sun is given.
    pub sun_angle_deg: f64,
    /// Limit on nutation at any time.
    pub max_nutation_deg: Option<f64>,
    /// Limit on nutation after the last pulse.
    pub max_final_deg: Option<f64>,
    /// Limit on the time from first to last pulse, in s.
    pub max_duration_s: Option<f64>,
    /// Propellant on board, in kg; otherwise the spacecraft's.
    pub propellant_kg: Option<f64>,
    /// File of the spacecraft; otherwise ACE.
    pub spacecraft: Option<PathBuf>,
    /// SpinPlant through which the plan is simulated again.
    pub template: Option<PathBuf>,
    /// Length of a campaign of antenna pointing in place of one turn, in s.
    pub campaign_s: Option<f64>,
    /// Rows of the trade table.
    pub rows: usize,
    /// Folder to write.
    pub output: Option<PathBuf>,
}
