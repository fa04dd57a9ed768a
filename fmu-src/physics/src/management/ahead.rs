//! What lies ahead of a downlink's begin: momentum through the coming cycles, flown in default attitudes and without dumps.
//!
//! Components that are integrated on their own are noted one by one over the whole horizon ([`super::profile`]); the physical
//! momentum, under which the body turns, through the next science ([`super::turning`]).

use nalgebra::{Rotation3, Vector3};

use super::profile::Swing;
use super::turning::{SquareSum, Turned};
use crate::momentum::Convention;
use crate::plant::ForecastMomentum;

/// The greatest number of cycles that are looked ahead.
pub const LONGEST_HORIZON: usize = 100;

/// Samples of a forecast a cycle.
const SAMPLES: f64 = 96.0;

/// Momentum ahead of a downlink's begin.
pub trait Forecast {
    /// Why there is none.
    type Error;

    /// Where the downlink begins, in s.
    fn begin_s(&self) -> f64;

    /// Length of a cycle of science and downlink, in s; infinite or 0 where none follows.
    fn cycle_s(&self) -> f64;

    /// Which momentum is watched.
    fn convention(&self) -> Convention;

    /// Magnitude of each component that triggers a dump, in N m s.
    fn threshold_body_n_m_s(&self) -> Vector3<f64>;

    /// Visits the momentum from the begin to `until_s`, every `step_s`, the downlink's begin first.
    ///
    /// # Errors
    /// What ends a forecast.
    fn fly(
        &mut self,
        until_s: f64,
        step_s: f64,
        visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), Self::Error>;
}

/// What was forecast; nothing by default.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ahead {
    /// By components, where each is integrated on its own.
    pub swings: Swings,
    /// Of the physical momentum.
    pub science: Option<ScienceAhead>,
    /// Magnitude of each component that triggers a dump, in N m s.
    pub threshold_body_n_m_s: Vector3<f64>,
}

impl Ahead {
    /// What `horizon` cycles bring, or the next science where the body turns under the momentum; nothing without a cycle.
    ///
    /// # Errors
    /// What ends a forecast.
    pub fn of<F: Forecast>(forecast: &mut F, horizon: u32) -> Result<Self, F::Error> {
        let (cycle_s, threshold_body_n_m_s) = (forecast.cycle_s(), forecast.threshold_body_n_m_s());
        let mut ahead = Self { threshold_body_n_m_s, ..Self::default() };
        if cycle_s.is_finite() && cycle_s > 0.0 {
            match forecast.convention() {
                Convention::BodyIntegral => ahead.swings = Swings::of(forecast, cycle_s, horizon)?,
                Convention::Inertial => ahead.science = ScienceAhead::of(forecast, cycle_s)?,
            }
        }
        Ok(ahead)
    }
}

/// What each coming span of science does to X and Z of the momentum.
#[derive(Clone, Copy, Debug)]
pub struct Swings {
    count: usize,
    by_axis: [[Swing; LONGEST_HORIZON]; 2],
}

impl Default for Swings {
    fn default() -> Self {
        Self { count: 0, by_axis: [[Swing::default(); LONGEST_HORIZON]; 2] }
    }
}

impl Swings {
    fn of<F: Forecast>(forecast: &mut F, cycle_s: f64, horizon: u32) -> Result<Self, F::Error> {
        let mut swings = Self::default();
        let until_s = forecast.begin_s() + f64::from(horizon) * cycle_s;
        let (mut base, mut was_downlink) = (Vector3::zeros(), true);
        forecast.fly(until_s, cycle_s / SAMPLES, |at| {
            if at.downlink {
                base = at.momentum_body_n_m_s;
            } else {
                swings.count += usize::from(was_downlink);
                let since = at.momentum_body_n_m_s - base;
                let at = swings.count.wrapping_sub(1);
                for (swings, since) in swings.by_axis.iter_mut().zip([since.x, since.z]) {
                    if let Some(swing) = swings.get_mut(at) {
                        swing.note(since);
                    }
                }
            }
            was_downlink = at.downlink;
        })?;
        swings.count = swings.count.min(LONGEST_HORIZON);
        Ok(swings)
    }

    /// Of X and of Z, one a span of science.
    pub fn along(&self) -> [&[Swing]; 2] {
        self.by_axis.each_ref().map(|swings| swings.get(..self.count).unwrap_or_default())
    }
}

/// The science after a downlink in its default attitude.
#[derive(Clone, Copy, Debug)]
pub struct ScienceAhead {
    /// Momentum at the downlink's end, body frame, in N m s.
    pub end_body_n_m_s: Vector3<f64>,
    /// Attitude at the downlink's end.
    pub inertial_from_body: Rotation3<f64>,
    /// What becomes of the momentum left with.
    pub squares: SquareSum,
}

impl ScienceAhead {
    /// The next science; `None` where none follows.
    fn of<F: Forecast>(forecast: &mut F, cycle_s: f64) -> Result<Option<Self>, F::Error> {
        // Half a sample before the next downlink: rounding must not say how many samples there are.
        let until_s = forecast.begin_s() + cycle_s * (1.0 - 0.5 / SAMPLES);
        let threshold = forecast.threshold_body_n_m_s();
        let (mut left, mut has_begun, mut has_ended) = (None, false, false);
        let mut squares = SquareSum::default();
        forecast.fly(until_s, cycle_s / SAMPLES, |at| {
            if at.downlink {
                has_ended |= has_begun;
                if !has_ended {
                    left = Some(at);
                }
            } else if let Some(left) = left.filter(|_| !has_ended) {
                let turn = at.body_from_inertial * left.body_from_inertial.inverse();
                let added = at.momentum_inertial_n_m_s - left.momentum_inertial_n_m_s;
                let added_body_n_m_s = at.body_from_inertial * added;
                squares.add(&Turned { turn: turn.into_inner(), added_body_n_m_s }, &threshold);
                has_begun = true;
            }
        })?;
        Ok(left.filter(|_| has_begun).map(|left| Self {
            end_body_n_m_s: left.momentum_body_n_m_s,
            inertial_from_body: left.body_from_inertial.inverse(),
            squares,
        }))
    }
}
