//! Momentum segment: an interval on which the rates are smooth, with its totals as a polynomial in time.

use nalgebra::{Rotation3, SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::numerics::chebyshev::{GREATEST_IN_STATE, Segment};
use crate::numerics::events::first_event;
use crate::numerics::intervals::next_multiple_s;
use crate::numerics::spacing::spacing;

use super::dump::{DumpPolicy, EXCEEDED_N_M_S};
use super::integrator::TooManyDumps;
use super::{Convention, Settings};

/// Sampled quantities that are integrated: torque (inertial), torque (body), acceleration (inertial).
const RATES: usize = 9;
/// Chebyshev nodes a segment.
const NODES: usize = 8;
/// An event this soon after the start of a segment is the one that it starts with, in s: an orbit computed anew moves it.
const EVENT_GAP_S: f64 = 1e-4;
/// No segment is halved below this, in s.
const SHORTEST_S: f64 = 1e-3;
/// Terms of a series this much below its largest are rounding; halving the segment does not make them smaller.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The first time after `start_s` at which an event is another than the one there.
pub fn after_event_s(start_s: f64) -> f64 {
    start_s + EVENT_GAP_S.max(4.0 * spacing(start_s))
}

/// What a flight gives at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Matrix that takes body components to inertial components.
    pub inertial_from_body: Rotation3<f64>,
    /// Total external torque about the centre of mass, body frame, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// Acceleration by non-gravitational forces, inertial frame, in m/s2.
    pub acceleration_inertial_m_s2: Vector3<f64>,
    /// Event functions: between two of their roots the sample is a smooth function of time. Infinite where there is nothing
    /// to watch.
    pub events: EventValues,
}

/// Values of the event functions of a flight.
pub type EventValues = SVector<f64, 4>;

/// What the integration of momentum costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// A segment as long as the grid and the flight let it be.
    Segment,
    /// A segment tried at a shorter length, because the tolerance asks for it.
    Refinement,
    /// A search for the time at which something changes abruptly.
    Search,
    /// A dump.
    Dump,
}

/// What gives attitude, torque and acceleration at any time.
pub trait TorqueModel {
    /// Why a flight cannot go on.
    type Failure: From<TooManyDumps>;

    /// Makes the flight ready for samples from `start_s` on, and tells up to where, at most to the next change whose time is
    /// known: a segment that starts there ends at that time or before. Called with rising times, and again with the same one.
    ///
    /// # Errors
    /// Whatever ends a flight.
    fn prepare(&mut self, start_s: f64) -> Result<f64, Self::Failure>;

    /// Sample at `time_s`; a pure function of time within what was prepared.
    fn sample(&mut self, time_s: f64) -> Sample;

    /// The event functions of the sample alone.
    fn events(&mut self, time_s: f64) -> EventValues;

    /// Counts what is about to be done, the flight having come to `time_s`.
    ///
    /// # Errors
    /// More was spent than may be.
    fn spend(&mut self, _effort: Effort, _time_s: f64) -> Result<(), Self::Failure> {
        Ok(())
    }
}

/// What is integrated over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Totals {
    /// Angular momentum of the whole spacecraft in the inertial frame, in N m s: dH/dt = T.
    pub momentum_inertial_n_m_s: Vector3<f64>,
    /// Integral of the body components of torque, in N m s (paper 000's eq 13, read component by component).
    pub torque_integral_body_n_m_s: Vector3<f64>,
    /// Velocity change by non-gravitational forces, inertial frame, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
}

impl Totals {
    /// System momentum in the body frame by `convention`, in N m s.
    pub fn momentum_body_n_m_s(
        &self,
        convention: Convention,
        inertial_from_body: &Rotation3<f64>,
    ) -> Vector3<f64> {
        match convention {
            Convention::Inertial => inertial_from_body.inverse() * self.momentum_inertial_n_m_s,
            Convention::BodyIntegral => self.torque_integral_body_n_m_s,
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.to_vector().iter().all(|x| x.is_finite())
    }

    fn to_vector(self) -> SVector<f64, RATES> {
        pack(self.momentum_inertial_n_m_s, self.torque_integral_body_n_m_s, self.delta_v_inertial_m_s)
    }

    fn from_vector(v: &SVector<f64, RATES>) -> Self {
        Self {
            momentum_inertial_n_m_s: Vector3::new(v[0], v[1], v[2]),
            torque_integral_body_n_m_s: Vector3::new(v[3], v[4], v[5]),
            delta_v_inertial_m_s: Vector3::new(v[6], v[7], v[8]),
        }
    }
}

fn pack(a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>) -> SVector<f64, RATES> {
    SVector::from([a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z])
}

/// One interval without events.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MomentumSegment {
    start_s: f64,
    end_s: f64,
    at_start: Totals,
    /// Length the tolerance will probably allow the next segment, in s.
    next_longest_s: f64,
    /// Absent for a segment without length.
    totals: Option<Segment<RATES, { NODES + 1 }>>,
}

impl MomentumSegment {
    /// A segment without length at `time_s`.
    pub fn point(time_s: f64, totals: Totals) -> Self {
        Self { start_s: time_s, end_s: time_s, at_start: totals, next_longest_s: f64::INFINITY, totals: None }
    }

    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        let totals = self.at_start.to_vector();
        let numbers = totals.iter().chain([&self.start_s, &self.end_s]);
        numbers.into_iter().all(|x| x.abs() <= GREATEST_IN_STATE)
            && self.next_longest_s > 0.0
            && self.totals.as_ref().is_none_or(|it| it.is_sound() && it.spans(self.start_s, self.end_s))
    }

    /// The same, expecting that the tolerance allows the next segment this length, in s.
    pub fn expecting(self, next_longest_s: f64) -> Self {
        Self { next_longest_s, ..self }
    }

    /// Builds the segment that begins at `start_s` with `first`, the sample there. It ends at the next multiple of
    /// the grid step or sooner: at `horizon_s`, up to where the flight is prepared, at an event, where the last Chebyshev
    /// terms of a total would exceed the tolerance, or where momentum exceeds a dump threshold.
    ///
    /// `longest_s` is the length that the segment before expects the tolerance to allow: trying more would be work for
    /// nothing.
    ///
    /// # Errors
    /// More work than the flight may take.
    pub fn build<F: TorqueModel>(
        flight: &mut F,
        settings: &Settings,
        start_s: f64,
        horizon_s: f64,
        at_start: Totals,
        first: &Sample,
        longest_s: f64,
    ) -> Result<Self, F::Failure> {
        flight.spend(Effort::Segment, start_s)?;
        // Never without length, whatever a restored state expects.
        let limit_s = next_multiple_s(start_s, settings.grid_s)
            .min(start_s + longest_s)
            .min(horizon_s)
            .max(start_s.next_up());
        let mut end_s = limit_s;
        let mut watched = false;
        let mut samples = [*first; NODES];
        let mut shortened = false;
        let (nodes, totals, growth) = loop {
            let nodes = Segment::<RATES, NODES>::nodes(start_s, end_s);
            for (sample, &time_s) in samples.iter_mut().zip(&nodes) {
                *sample = flight.sample(time_s);
            }
            // A shorter segment has no event that a longer one has not.
            if !core::mem::replace(&mut watched, true) {
                let values = samples.map(|sample| sample.events);
                let after_s = after_event_s(start_s);
                let event_s = first_event(after_s, start_s, end_s, &values, |at_s| flight.events(at_s));
                if let Some(event_s) = event_s {
                    flight.spend(Effort::Search, start_s)?;
                    end_s = event_s;
                    continue;
                }
            }
            let rates = samples.map(|s| {
                let torque_inertial_n_m = s.inertial_from_body * s.torque_body_n_m;
                pack(torque_inertial_n_m, s.torque_body_n_m, s.acceleration_inertial_m_s2)
            });
            let totals: Segment<RATES, { NODES + 1 }> =
                Segment::<RATES, NODES>::from_samples(start_s, end_s, &rates).integral(at_start.to_vector());
            let terms = totals.coefficients();
            let unresolved = terms.column(NODES).amax().max(terms.column(NODES - 1).amax());
            let tolerance = settings.tolerance.max(ROUNDING * terms.amax());
            // The terms fall with the length to this power, as long as everything is smooth.
            let growth = 0.9 * (tolerance / unresolved).powf(1.0 / (NODES as f64));
            let shorter_s = start_s + (end_s - start_s) * growth.clamp(0.1, 0.7);
            // A number that is not finite cannot be resolved by shortening; it shows in the outputs.
            if unresolved <= tolerance
                || !unresolved.is_finite()
                || end_s - start_s < SHORTEST_S
                || shorter_s <= start_s
            {
                break (nodes, totals, growth);
            }
            end_s = shorter_s;
            shortened = true;
            flight.spend(Effort::Refinement, start_s)?;
        };
        let expected_s = (end_s - start_s) * if growth.is_finite() { growth.clamp(0.5, 4.0) } else { 4.0 };
        let next_longest_s = if shortened { expected_s } else { expected_s.max(longest_s) };
        let mut segment = Self { start_s, end_s, at_start, next_longest_s, totals: Some(totals) };
        if let Some(dump_s) = segment.first_excess_s(settings, &nodes, &samples) {
            segment.end_s = dump_s;
        }
        Ok(segment)
    }

    /// Start, in s.
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// End, in s.
    pub fn end_s(&self) -> f64 {
        self.end_s
    }

    /// Length the tolerance will probably allow the next segment, in s.
    pub fn next_longest_s(&self) -> f64 {
        self.next_longest_s
    }

    /// Totals at a time inside the segment.
    pub fn totals(&self, time_s: f64) -> Totals {
        match &self.totals {
            Some(totals) if time_s > self.start_s => Totals::from_vector(&totals.value(time_s)),
            _ => self.at_start,
        }
    }

    /// The first time inside the segment at which a momentum component exceeds its threshold.
    fn first_excess_s(
        &self,
        settings: &Settings,
        nodes: &[f64; NODES],
        samples: &[Sample; NODES],
    ) -> Option<f64> {
        let totals = self.totals.as_ref()?;
        match settings.convention {
            Convention::BodyIntegral => first_crossing_s(totals, 3, &settings.policy, self),
            Convention::Inertial => {
                let spread: f64 =
                    totals.coefficients().fixed_rows::<3>(0).column_iter().map(|c| c.norm()).sum();
                if spread < settings.policy.threshold_body_n_m_s.min() {
                    return None;
                }
                let body: [SVector<f64, 3>; NODES] = core::array::from_fn(|j| {
                    let momentum = Totals::from_vector(&totals.value(nodes[j])).momentum_inertial_n_m_s;
                    samples[j].inertial_from_body.inverse() * momentum
                });
                let body = Segment::<3, NODES>::from_samples(totals.start(), totals.end(), &body);
                first_crossing_s(&body, 0, &settings.policy, self)
            }
        }
    }
}

/// First crossing of a threshold by rows `row`..`row + 3` of `momentum` inside `segment`.
fn first_crossing_s<const D: usize, const N: usize>(
    momentum: &Segment<D, N>,
    row: usize,
    policy: &DumpPolicy,
    segment: &MomentumSegment,
) -> Option<f64> {
    let mut first: Option<f64> = None;
    for axis in 0..3 {
        let limit_n_m_s = policy.threshold_body_n_m_s[axis] + 2.0 * EXCEEDED_N_M_S;
        let terms = momentum.coefficients().row(row + axis);
        let bound: f64 = terms.iter().map(|c| c.abs()).sum();
        if bound.is_nan() || bound < limit_n_m_s {
            continue;
        }
        for sign in [1.0, -1.0] {
            let mut direction = SVector::<f64, D>::zeros();
            direction[row + axis] = sign;
            let excess = momentum.project(&direction, -limit_n_m_s);
            let crossing = excess.sign_changes(segment.start_s, segment.end_s).first();
            first = match (first, crossing) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
        }
    }
    first.filter(|&time_s| time_s > segment.start_s && time_s < segment.end_s)
}
