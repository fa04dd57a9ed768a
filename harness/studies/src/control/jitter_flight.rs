//! Flights of a flexible spacecraft with a wheel out of balance: at constant speed, free and under control, and run up.

use loader::Fmu;

use super::jitter_theory::Structure;
use super::spectrum::Spectrum;
use crate::StudyError;
use crate::case::Case;

/// Samples a second.
pub(super) const RATE_HZ: f64 = 100.0;
/// Samples of a spectrum.
pub(super) const COUNT: usize = 1 << 14;
/// What rings at first has died away then, in s.
const SETTLED_S: f64 = 240.0;
/// Below it the attitude moves as a whole, in Hz.
pub(super) const LOWEST_HZ: f64 = 0.2;
/// The wheel is run up to this, in Hz.
pub(super) const FASTEST_HZ: f64 = 9.0;
/// Duration of the run-up, in s.
const RUN_UP_S: f64 = 600.0;
/// Noise of star tracker (rad) and gyros (rad after a second) under control, assumed.
const NOISE: [f64; 2] = [2e-5, 1e-6];

/// What is simulated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct JitterCase {
    /// For tables and pictures.
    pub label: String,
    /// Speed of the first wheel, in Hz; the others stand.
    pub wheel_hz: f64,
    /// Under the controller with noisy sensors, or free.
    pub controlled: bool,
}

/// The attitude's spectrum, in rad.
pub(super) struct Shaken {
    /// What was simulated.
    pub flight: JitterCase,
    /// All axes together.
    pub spectrum: Spectrum,
}

/// Nothing acts but wheels; they start at these momenta, in N m s.
fn dark(label: &str, stop_s: f64) -> Case {
    Case::new(label, stop_s, 1.0 / RATE_HZ).set("solar.flux", 0.0).set("gravityGradient.enabled", false)
}

impl JitterCase {
    /// Simulates it.
    pub(super) fn simulated(&self, fmu: &Fmu, structure: &Structure) -> Result<Shaken, StudyError> {
        let stop_s = SETTLED_S + COUNT as f64 / RATE_HZ;
        let held_n_m_s = structure.rotor_kg_m2 * std::f64::consts::TAU * self.wheel_hz;
        let mut case = dark(&self.label, stop_s).set("wheel[1].startMomentum", held_n_m_s);
        if self.controlled {
            let [tracker, gyro] = NOISE;
            let q = [0.1, 0.2, -0.3, 0.927_361_849_549_570_4];
            case = case
                .set("attitude.source", "controlled")
                .set("control.balanceTime", 0.0)
                .set("gyro.noise", gyro)
                .set("start.q", q)
                .set("command.q", q)
                .set("starTracker.noise", [tracker; 3]);
        } else {
            case = at_rest(case);
        }
        let recorded = case.simulate(fmu, &["attitude.rate"])?;
        let axes: Vec<Spectrum> =
            recorded.columns.iter().map(|rate| Spectrum::of(&rate[rate.len() - COUNT..], RATE_HZ)).collect();
        let angle = |frequency_hz: f64, rate_rad_s: f64| {
            if frequency_hz > 0.0 { rate_rad_s / (std::f64::consts::TAU * frequency_hz) } else { 0.0 }
        };
        Ok(Shaken { flight: self.clone(), spectrum: Spectrum::combined(&axes, angle) })
    }
}

/// In free flight, begun at rest.
fn at_rest(case: Case) -> Case {
    case.set("attitude.source", "free").set("start.q", [0.0, 0.0, 0.0, 1.0])
}

/// Jitter while the wheel is run up: its speed in Hz, and the amplitude over windows of some seconds in rad.
pub(super) fn run_up(fmu: &Fmu, structure: &Structure) -> Result<Vec<(f64, f64)>, StudyError> {
    const WINDOW: usize = 400;
    let torque_n_m = structure.rotor_kg_m2 * std::f64::consts::TAU * FASTEST_HZ / RUN_UP_S;
    let case = at_rest(dark("run-up", RUN_UP_S)).set("wheel[1].torqueCommand", torque_n_m);
    let recorded = case.simulate(fmu, &["attitude.rate", "wheel[1].speed"])?;
    let windows = recorded.times_s.len() / (WINDOW / 4);
    let points = (0..windows.saturating_sub(4)).map(|window| {
        let span = window * WINDOW / 4..window * WINDOW / 4 + WINDOW;
        let middle = span.start + WINDOW / 2;
        let wheel_hz = recorded.columns[3][middle] / std::f64::consts::TAU;
        let square: f64 = recorded.columns[..3].iter().map(|rate| mean_square(&rate[span.clone()])).sum();
        (wheel_hz, (2.0 * square).sqrt() / (std::f64::consts::TAU * wheel_hz))
    });
    Ok(points.filter(|(wheel_hz, _)| *wheel_hz > 0.5).collect())
}

/// Of samples about their straight line.
fn mean_square(samples: &[f64]) -> f64 {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let middle = 0.5 * (count - 1.0);
    let (along, spread) = samples.iter().enumerate().fold((0.0, 0.0), |(along, spread), (k, x)| {
        let off = k as f64 - middle;
        (along + off * (x - mean), spread + off * off)
    });
    let off_line = |(k, x): (usize, &f64)| (x - mean - along / spread * (k as f64 - middle)).powi(2);
    samples.iter().enumerate().map(off_line).sum::<f64>() / count
}
