//! Forecast after the begin of a downlink, or of science that unloads: momentum and light through the coming cycles, simulated in default attitudes and without
//! dumps.
//!
//! Components that are integrated on their own are noted one by one over the whole horizon ([`super::profile`]); the physical
//! momentum, under which the body turns, through the next science ([`super::turning`]). Science that begins and unloads stands for the
//! downlink that begins, without a science between it and the next downlink.

use nalgebra::{Rotation3, Vector3};

use super::profile::{ControlAuthority, Cycle, Excursion};
use super::rotated_momentum::{RotatedMomentum, SquareSum};
use crate::attitude::angle_between_rad;
use crate::momentum::{Convention, DumpPolicy};
use crate::plant::ForecastMomentum;

/// The greatest number of cycles that are looked ahead.
pub const LONGEST_HORIZON: usize = 100;

/// Samples of the next science, of components that are integrated on their own: peaks at the slews in it are short.
const NEXT_SAMPLES: usize = 128;
/// Samples of each science after it.
const LATER_SAMPLES: usize = 32;
/// Samples of the next cycle, of the physical momentum.
const SAMPLES: usize = 96;

/// Times of a forecast, which momentum is watched, and how it is dumped.
#[derive(Clone, Copy, Debug)]
pub struct ForecastTerms {
    /// Begin of the downlink, or of science that unloads, in s.
    pub begin_s: f64,
    /// Length of a cycle of science and downlink, in s; infinite or 0 where none follows.
    pub cycle_s: f64,
    /// How long it lasts, in s.
    pub span_s: f64,
    /// Whether science that unloads begins.
    pub begins_in_science: bool,
    /// Length of a coming downlink, in s.
    pub downlink_s: f64,
    /// Convention of the momentum that is watched.
    pub convention: Convention,
    /// When thrusters dump, and what they leave.
    pub policy: DumpPolicy,
}

/// Momentum ahead of a downlink's begin.
pub trait Forecast {
    /// Why there is none.
    type Error;

    /// Its terms.
    fn terms(&self) -> ForecastTerms;

    /// Visits the momentum at these times in s, which do not descend, the downlink's begin first; about `step_s` apart.
    ///
    /// # Errors
    /// What ends a forecast.
    fn simulated(
        &mut self,
        times_s: impl Iterator<Item = f64>,
        step_s: f64,
        visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), Self::Error>;
}

/// Forecast of the coming cycles.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "a step allocates nothing")]
pub enum Prediction {
    /// By components, where each is integrated on its own.
    Components(Components),
    /// Forecast of the physical momentum.
    Science(PredictedScience),
}

impl Prediction {
    /// Forecasts `horizon` cycles, or the next science where the body turns under the momentum; `None` without a cycle.
    ///
    /// # Errors
    /// What ends a forecast.
    pub fn new<F: Forecast>(forecast: &mut F, horizon: u32) -> Result<Option<Self>, F::Error> {
        let ForecastTerms { cycle_s, downlink_s, convention, begins_in_science, .. } = forecast.terms();
        let science_s = cycle_s - downlink_s;
        if !(cycle_s.is_finite() && science_s > 0.0 && horizon > 0) {
            return Ok(None);
        }
        Ok(match convention {
            Convention::BodyIntegral => {
                Some(Self::Components(Components::new(forecast, science_s, horizon)?))
            }
            Convention::Inertial if begins_in_science => None,
            Convention::Inertial => PredictedScience::new(forecast, cycle_s)?.map(Self::Science),
        })
    }
}

/// A downlink to come, or the one that begins.
#[derive(Clone, Copy, Debug, Default)]
pub struct PredictedDownlink {
    /// How long it lasts, in s.
    pub span_s: f64,
    /// Angles between Sun and Earth where it begins and where it ends, in rad; `None` where one has no direction.
    pub separations_rad: Option<[f64; 2]>,
    /// Pressure of sunlight there, in Pa.
    pub pressure_pa: f64,
    /// Momentum that its default attitude adds to X and Z, in N m s.
    pub added: [f64; 2],
}

impl PredictedDownlink {
    /// How long sunlight of this pressure, in Pa, takes to do what its own does in all of it, in s; 0 without pressure.
    pub fn equivalent_s(&self, pressure_pa: f64) -> f64 {
        if pressure_pa > 0.0 { self.span_s * (self.pressure_pa / pressure_pa) } else { 0.0 }
    }
}

/// Changes of X and Z of the momentum through each coming span of science and each downlink.
#[derive(Clone, Copy, Debug)]
pub struct Components {
    /// Cycles that were forecast.
    pub count: usize,
    excursions: [[Excursion; LONGEST_HORIZON]; 2],
    /// The downlink that begins, and those to come.
    pub downlinks: [PredictedDownlink; LONGEST_HORIZON],
    /// X and Z through the first science, relative to its start, in N m s.
    pub path: [[f64; NEXT_SAMPLES]; 2],
    /// When thrusters dump, and what they leave.
    pub policy: DumpPolicy,
}

impl Components {
    fn new<F: Forecast>(forecast: &mut F, science_s: f64, horizon: u32) -> Result<Self, F::Error> {
        let ForecastTerms { begin_s, cycle_s, span_s, begins_in_science, downlink_s, policy, .. } =
            forecast.terms();
        let count = (horizon as usize).min(LONGEST_HORIZON);
        let mut components = Self {
            count,
            excursions: [[Excursion::default(); LONGEST_HORIZON]; 2],
            downlinks: [PredictedDownlink::default(); LONGEST_HORIZON],
            path: [[0.0; NEXT_SAMPLES]; 2],
            policy,
        };
        let spans_s = [span_s, downlink_s];
        let first_end_s = begin_s + spans_s[0];
        // Without a science first all that comes after it comes so much sooner.
        let sooner_s = if begins_in_science { science_s } else { 0.0 };
        // Each cycle has the begin of its downlink, then its science, whose last sample is the next downlink's begin.
        let samples = |cycle| (0..=samples_of(cycle)).map(move |sample| (cycle, sample));
        let mut visits = (0..count).flat_map(samples).chain([(count, 0)]);
        let times_s = visits.clone().map(|visit| match visit {
            (0, 0) => begin_s,
            (0, _) if sooner_s > 0.0 => first_end_s,
            (cycle, 0) => first_end_s + (cycle - 1) as f64 * cycle_s + (science_s - sooner_s),
            (cycle, sample) => {
                let share = (sample - 1) as f64 / samples_of(cycle) as f64;
                first_end_s + cycle as f64 * cycle_s + (share * science_s - sooner_s)
            }
        });
        let mut base = [0.0; 2];
        forecast.simulated(times_s, science_s / LATER_SAMPLES as f64, |at| {
            let separation_rad = at.to_earth.map(|earth| angle_between_rad(&at.to_sun, &earth));
            let Some((cycle, sample)) = visits.next() else { return };
            let momentum = [at.momentum_body_n_m_s.x, at.momentum_body_n_m_s.z];
            let since = [momentum[0] - base[0], momentum[1] - base[1]];
            match sample {
                0 => {
                    if let Some(ended) = cycle.checked_sub(1) {
                        components.record(ended, samples_of(ended) - 1, since);
                    }
                    if let Some(downlink) = components.downlinks.get_mut(cycle) {
                        *downlink = PredictedDownlink {
                            span_s: spans_s[cycle.min(1)],
                            separations_rad: separation_rad.map(|it| [it; 2]),
                            pressure_pa: at.pressure_pa,
                            added: [0.0; 2],
                        };
                    }
                    base = momentum;
                }
                1 => {
                    if let Some(downlink) = components.downlinks.get_mut(cycle) {
                        downlink.added = since;
                        if let Some(([_, end_rad], at_end_rad)) =
                            downlink.separations_rad.as_mut().zip(separation_rad)
                        {
                            *end_rad = at_end_rad;
                        }
                    }
                    base = momentum;
                }
                _ => components.record(cycle, sample - 2, since),
            }
        })?;
        Ok(components)
    }

    /// Takes record of a sample of a span of science.
    fn record(&mut self, cycle: usize, sample: usize, since: [f64; 2]) {
        for ((excursions, path), since) in self.excursions.iter_mut().zip(&mut self.path).zip(since) {
            if let Some(excursion) = excursions.get_mut(cycle) {
                excursion.record(since);
            }
            if let Some(path) = path.get_mut(sample).filter(|_| cycle == 0) {
                *path = since;
            }
        }
    }

    /// Cycles to come of X and of Z, `authority` being what a coming downlink can add to each.
    pub fn cycles(
        &self,
        authority: impl Fn(&PredictedDownlink) -> [ControlAuthority; 2],
    ) -> [[Cycle; LONGEST_HORIZON]; 2] {
        let mut cycles = [[Cycle::default(); LONGEST_HORIZON]; 2];
        for cycle in 0..self.count {
            // The last science has no downlink after it within the horizon.
            let authorities =
                self.downlinks.get(cycle + 1).filter(|_| cycle + 1 < self.count).map(&authority);
            for (axis, cycles) in cycles.iter_mut().enumerate() {
                cycles[cycle] = Cycle {
                    excursion: self.excursions[axis][cycle],
                    authority: authorities.map_or([0.0; 2], |it| it[axis]),
                };
            }
        }
        cycles
    }
}

/// Samples of the science of a cycle.
fn samples_of(cycle: usize) -> usize {
    if cycle == 0 { NEXT_SAMPLES } else { LATER_SAMPLES }
}

/// The science after a downlink in its default attitude.
#[derive(Clone, Copy, Debug)]
pub struct PredictedScience {
    /// Momentum at the downlink's end, body frame, in N m s.
    pub end_body_n_m_s: Vector3<f64>,
    /// Attitude at the downlink's end.
    pub inertial_from_body: Rotation3<f64>,
    /// Sum of squares of the momentum through the science, by the momentum at the downlink's end.
    pub squares: SquareSum,
}

impl PredictedScience {
    /// The next science; `None` where none follows.
    fn new<F: Forecast>(forecast: &mut F, cycle_s: f64) -> Result<Option<Self>, F::Error> {
        let ForecastTerms { begin_s, policy, .. } = forecast.terms();
        let step_s = cycle_s / SAMPLES as f64;
        // Half a sample before the next downlink: rounding must not say how many samples there are.
        let until_s = begin_s + cycle_s * (1.0 - 0.5 / SAMPLES as f64);
        let threshold = policy.threshold_body_n_m_s;
        let (mut left, mut has_begun, mut has_ended) = (None, false, false);
        let mut squares = SquareSum::default();
        let times_s = (0..=SAMPLES).map(|k| (begin_s + k as f64 * step_s).min(until_s));
        forecast.simulated(times_s, step_s, |at| {
            if at.downlink {
                has_ended |= has_begun;
                if !has_ended {
                    left = Some(at);
                }
            } else if let Some(left) = left.filter(|_| !has_ended) {
                let turn = at.body_from_inertial * left.body_from_inertial.inverse();
                let added = at.momentum_inertial_n_m_s - left.momentum_inertial_n_m_s;
                // Of what counts, from the wheels' bias on.
                let added_body_n_m_s = at.body_from_inertial * added - policy.bias_body_n_m_s;
                squares.add(&RotatedMomentum { turn: turn.into_inner(), added_body_n_m_s }, &threshold);
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
