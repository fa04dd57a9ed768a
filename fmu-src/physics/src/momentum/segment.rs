//! Momentum segment: an interval on which the rates are smooth, with its totals as a polynomial in time.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::{Attitude, Quaternion};
use crate::loads::{ByEffect, Effect};
use crate::numerics::adaptive::{AdaptiveInterval, Attempt, SegmentSpan};
use crate::numerics::chebyshev::Segment;
use crate::numerics::events::first_event;

use super::by_source::{SourceMomenta, SourceSegments, rate};
use super::dump::DumpPolicy;
use super::excess::{Excess, Watched};
use super::torque_model::{TorqueModel, TorqueSample, WorkKind, after_event_s};
use super::totals::{Convention, RATES, Totals, pack};

/// Chebyshev nodes a segment.
const NODES: usize = 8;
/// No segment is halved below this, in s.
const SHORTEST_S: f64 = 1e-3;
/// Largest last Chebyshev term of the momentum of body and panels relative to its largest: only the wheels' torque that is shown
/// follows from it.
const STRUCTURE_TOLERANCE: f64 = 1e-8;
/// Longest turn of a step along the body rate, in rad, and most steps: only the sign of the attitude there matters.
const STEP_RAD: f64 = 1.0;
/// See [`STEP_RAD`].
const MOST_STEPS: f64 = 1000.0;
/// Terms of a series this much below its largest are rounding; halving the segment does not make them smaller.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How momentum is integrated; constant within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Longest segment: segments end at multiples of this, in s.
    pub grid_s: f64,
    /// Largest last Chebyshev term of a segment's totals, in N m s and m/s.
    pub tolerance: f64,
    /// Momentum that the dump thresholds watch.
    pub convention: Convention,
    /// Thresholds and what follows.
    pub policy: DumpPolicy,
}

/// One interval without events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MomentumSegment {
    pub(super) span: SegmentSpan,
    at_start: Totals,
    /// Attitude at the start, the sign of its quaternion continuing from segment to segment.
    attitude_at_start: Quaternion,
    /// Absent for a segment without length.
    totals: Option<Segment<RATES, { NODES + 1 }>>,
    by_source_at_start: SourceMomenta,
    /// Momentum by source; empty for a segment without length.
    by_source: SourceSegments<{ NODES + 1 }>,
    /// Angular rate, body frame, in rad/s; absent for a segment without length.
    rate_body_rad_s: Option<Segment<3, NODES>>,
    /// Bound of its norm, in rad/s.
    fastest_rad_s: f64,
    /// Momentum of the body and its panels, body frame, in N m s; absent where no panel has a mass.
    structure_body_n_m_s: Option<Segment<3, NODES>>,
    /// Components of the momentum, body frame, that come to their dump thresholds at the end: there thrusters dump.
    pub(super) at_threshold: [bool; 3],
}

impl MomentumSegment {
    /// A segment without length at `time_s`.
    pub(super) fn point(time_s: f64, attitude: Quaternion, totals: Totals, by_source: SourceMomenta) -> Self {
        Self {
            span: SegmentSpan { start_s: time_s, end_s: time_s, next_longest_s: f64::INFINITY },
            at_start: totals,
            attitude_at_start: attitude,
            by_source_at_start: by_source,
            ..Self::default()
        }
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        let SegmentSpan { start_s, end_s, .. } = self.span;
        let vectors = [&self.rate_body_rad_s, &self.structure_body_n_m_s];
        self.span.is_valid()
            && !self.span.is_before()
            && self.fastest_rad_s >= 0.0
            && Attitude::from_unit(self.attitude_at_start).is_rotation()
            && self.totals.as_ref().is_none_or(|it| it.is_valid() && it.spans(start_s, end_s))
            && self.by_source.present().all(|(_, it)| it.is_valid() && it.spans(start_s, end_s))
            && vectors.into_iter().flatten().all(|it| it.is_valid() && it.spans(start_s, end_s))
    }

    /// A segment without length at `time_s`, in the attitude there; the tolerance allows the next one the same length.
    pub(super) fn restarted(&self, time_s: f64, totals: Totals, by_source: SourceMomenta) -> Self {
        let mut point = Self::point(time_s, self.attitude(time_s), totals, by_source);
        point.span.next_longest_s = self.span.next_longest_s;
        point
    }

    /// Becomes the next segment, with attitude and totals of this one without length at its start. It ends at the next multiple of the grid step or sooner: at
    /// `horizon_s`, up to where the flight is prepared, at an event, where the last Chebyshev terms of a total or of the momentum of
    /// body and panels would exceed the tolerance, or where momentum exceeds a dump threshold. Longer than this segment expects the
    /// tolerance to allow is not tried.
    ///
    /// # Errors
    /// More work than the flight may take; the segment is as before.
    pub(super) fn advance<F: TorqueModel>(
        &mut self,
        flight: &mut F,
        settings: &Settings,
        horizon_s: f64,
        start: &Self,
    ) -> Result<(), F::Failure> {
        let Self { at_start, attitude_at_start, by_source_at_start, .. } = *start;
        let (start_s, longest_s) = (self.span.end_s, self.span.next_longest_s);
        flight.spend(WorkKind::Segment, start_s)?;
        let interval = AdaptiveInterval::new(start_s, settings.grid_s, longest_s, horizon_s, SHORTEST_S);
        let mut watched = false;
        let (mut samples, mut nodes) = ([TorqueSample::default(); NODES], [0.0; NODES]);
        let ((totals, structure_body_n_m_s), span) = interval.fit::<_, F::Failure>(NODES, |interval| {
            if interval.is_refinement() {
                flight.spend(WorkKind::Refinement, start_s)?;
            }
            let end_s = interval.end_s();
            nodes = Segment::<RATES, NODES>::nodes(start_s, end_s);
            samples.iter_mut().zip(nodes).for_each(|(sample, at_s)| *sample = flight.sample(at_s));
            // A shorter segment has no event that a longer one has not.
            if !core::mem::replace(&mut watched, true) {
                let values = samples.each_ref().map(|sample| sample.events);
                let after_s = after_event_s(start_s);
                let rounding_s = flight.time_rounding_s(end_s);
                let event_s =
                    first_event([after_s, start_s, end_s], rounding_s, &values, |at_s| flight.events(at_s));
                if let Some(event_s) = event_s {
                    flight.spend(WorkKind::Search, start_s)?;
                    return Ok(Attempt::Event(event_s));
                }
            }
            let rates = samples.each_ref().map(|s| {
                let torque_inertial_n_m = s.inertial_from_body * s.torque_body_n_m;
                pack(torque_inertial_n_m, s.torque_body_n_m, s.acceleration_inertial_m_s2)
            });
            let totals = Segment::<RATES, NODES>::from_samples(start_s, end_s, &rates)
                .integral::<{ NODES + 1 }>(at_start.to_vector());
            let structure_body_n_m_s = samples[0].structure_body_n_m_s.map(|_| {
                let momenta = samples.each_ref().map(|s| s.structure_body_n_m_s.unwrap_or_default());
                Segment::<3, NODES>::from_samples(start_s, end_s, &momenta)
            });
            let mut unresolved = totals.largest_term(NODES - 1);
            let tolerance = settings.tolerance.max(ROUNDING * totals.largest_term(0));
            if let Some(structure) = &structure_body_n_m_s
                && structure.largest_term(0) > 0.0
            {
                let share = structure.largest_term(NODES - 2) / structure.largest_term(0);
                unresolved = unresolved.max(share / STRUCTURE_TOLERANCE * tolerance);
            }
            Ok(Attempt::Fitted { fit: (totals, structure_body_n_m_s), unresolved, tolerance })
        })?;
        let end_s = span.end_s;
        let rate_body_rad_s =
            Segment::from_samples(start_s, end_s, &samples.each_ref().map(|s| s.rate_body_rad_s));
        (self.span, self.at_start, self.totals) = (span, at_start, Some(totals));
        (self.attitude_at_start, self.by_source_at_start) = (attitude_at_start, by_source_at_start);
        self.fastest_rad_s = rate_body_rad_s.coefficients().column_iter().map(|term| term.norm()).sum();
        (self.rate_body_rad_s, self.structure_body_n_m_s) = (Some(rate_body_rad_s), structure_body_n_m_s);
        self.at_threshold = [false; 3];
        for effect in Effect::ALL {
            let of = |sample: &TorqueSample| {
                let torque_body_n_m = sample.by_source_body_n_m[effect]?;
                Some(rate(settings.convention, &sample.inertial_from_body, &torque_body_n_m))
            };
            self.by_source[effect] = of(&samples[0]).map(|_| {
                let rates = samples.each_ref().map(|sample| of(sample).unwrap_or_default());
                let segment = Segment::<3, NODES>::from_samples(start_s, end_s, &rates);
                segment.integral(by_source_at_start.0[effect])
            });
        }
        if let Some(excess) = self.first_excess(flight, settings, &nodes, &samples) {
            (self.span.end_s, self.at_threshold) = (excess.time_s, excess.components);
        }
        Ok(())
    }

    /// Totals at a time inside the segment.
    pub(super) fn totals(&self, time_s: f64) -> Totals {
        match &self.totals {
            Some(totals) if time_s > self.span.start_s => Totals::from_vector(&totals.value(time_s)),
            _ => self.at_start,
        }
    }

    /// Change of momentum by each effect since the last dump, at a time inside the segment.
    pub(super) fn by_source(&self, time_s: f64) -> SourceMomenta {
        SourceMomenta(ByEffect::from_fn(|effect| match &self.by_source[effect] {
            Some(momentum) if time_s > self.span.start_s => momentum.value(time_s),
            _ => self.by_source_at_start.0[effect],
        }))
    }

    /// Quaternion inside the segment whose sign is that of the motion at `time_s`: the one at the start, until the body may have
    /// turned far.
    pub(super) fn sign_reference(&self, time_s: f64) -> Quaternion {
        let turned_rad = self.fastest_rad_s * (time_s - self.span.start_s);
        if turned_rad < STEP_RAD { self.attitude_at_start } else { self.attitude(time_s) }
    }

    /// Attitude at a time inside the segment by the body rate since its start, whose sign is that of the motion, be the turn a whole
    /// one or more.
    pub(super) fn attitude(&self, time_s: f64) -> Quaternion {
        let span_s = time_s - self.span.start_s;
        let Some(rate) = self.rate_body_rad_s.as_ref().filter(|_| span_s > 0.0) else {
            return self.attitude_at_start;
        };
        let steps = (self.fastest_rad_s * span_s / STEP_RAD).ceil().clamp(1.0, MOST_STEPS);
        let step_s = span_s / steps;
        (0..steps as u32).fold(self.attitude_at_start, |attitude, step| {
            let rate_body_rad_s = rate.value(self.span.start_s + (f64::from(step) + 0.5) * step_s);
            attitude.after(Quaternion::by_vector(&(rate_body_rad_s * step_s)))
        })
    }

    /// Angular acceleration at a time inside the segment, body frame, in rad/s2; none where it has no length.
    pub(crate) fn acceleration_body_rad_s2(&self, time_s: f64) -> Vector3<f64> {
        self.rate_body_rad_s.as_ref().map_or(Vector3::zeros(), |it| it.value_and_derivative(time_s).1)
    }

    /// Rate in the body frame of what the body and its panels have of momentum, d/dt (J w + h_p), at a time inside the segment, in
    /// N m; J w' where no panel has a mass.
    pub(crate) fn structure_rate_body_n_m(
        &self,
        inertia_body_kg_m2: &Matrix3<f64>,
        time_s: f64,
    ) -> Vector3<f64> {
        match &self.structure_body_n_m_s {
            Some(momentum) => momentum.value_and_derivative(time_s).1,
            None => inertia_body_kg_m2 * self.acceleration_body_rad_s2(time_s),
        }
    }

    /// The first time inside the segment at which a component of the momentum exceeds its threshold.
    fn first_excess<F: TorqueModel>(
        &self,
        flight: &mut F,
        settings: &Settings,
        nodes: &[f64; NODES],
        samples: &[TorqueSample; NODES],
    ) -> Option<Excess> {
        let totals = self.totals.as_ref()?;
        let (row, rate_rad_s) = match settings.convention {
            Convention::Inertial => {
                (0, samples.iter().map(|it| it.rate_body_rad_s.norm()).fold(0.0, f64::max))
            }
            Convention::BodyIntegral => (3, 0.0),
        };
        let rows = totals.coefficients().fixed_rows::<3>(row);
        let most_n_m_s: f64 = rows.column_iter().map(|terms| terms.norm()).sum();
        let most_n_m_s = most_n_m_s + settings.policy.bias_body_n_m_s.norm();
        if most_n_m_s.is_nan() || most_n_m_s < settings.policy.threshold_body_n_m_s.min() {
            return None;
        }
        let (start_s, end_s) = (self.span.start_s, self.span.end_s);
        let watched = Watched { start_s, end_s, rounding_s: flight.time_rounding_s(end_s), rate_rad_s };
        let momentum_at = |at_s: f64| Totals::from_vector(&totals.value(at_s));
        let at_nodes: [Vector3<f64>; NODES] = core::array::from_fn(|j| {
            momentum_at(nodes[j]).momentum_body_n_m_s(settings.convention, &samples[j].inertial_from_body)
        });
        watched.first_excess(&settings.policy, &at_nodes, |at_s| match settings.convention {
            Convention::BodyIntegral => momentum_at(at_s).torque_integral_body_n_m_s,
            Convention::Inertial => {
                let inertial_from_body = flight.inertial_from_body(at_s);
                momentum_at(at_s).momentum_body_n_m_s(settings.convention, &inertial_from_body)
            }
        })
    }
}
