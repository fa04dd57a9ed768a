//! Integrates torque over time, segment by segment, and lets thrusters dump when a threshold is exceeded.

use nalgebra::{Rotation3, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::{Attitude, Quaternion};
use crate::numerics::intervals::next_multiple_s;

use super::by_source::SourceMomenta;
use super::dump::{DumpEvent, Dumps};
use super::segment::{MomentumSegment, Settings};
use super::torque_model::TorqueModel;
use super::totals::Totals;

/// Totals of a flight with their dense output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MomentumIntegrator {
    /// The current segment.
    pub(crate) segment: MomentumSegment,
    dumps: Dumps,
}

/// The next segment, ready to be integrated.
#[derive(Clone, Copy, Debug)]
pub struct PreparedSegment {
    horizon_s: f64,
    attitude: Quaternion,
    totals: Totals,
    by_source: SourceMomenta,
    /// The dump that is due where it begins, if the momentum exceeds a threshold there.
    pub due: Option<DumpEvent>,
}

impl MomentumIntegrator {
    /// Begins at `time_s` with `totals`.
    pub fn new(time_s: f64, totals: Totals) -> Self {
        Self::after(time_s, Quaternion::IDENTITY, totals)
    }

    /// The same where the quaternion of the attitude continues the sign of `attitude`.
    pub fn after(time_s: f64, attitude: Quaternion, totals: Totals) -> Self {
        let segment = MomentumSegment::point(time_s, attitude, totals, SourceMomenta::default());
        Self { segment, dumps: Dumps::default() }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.segment.is_valid() && self.dumps.is_valid()
    }

    /// Dumps so far: those at or before the time last advanced to.
    pub fn dumps(&self) -> &Dumps {
        &self.dumps
    }

    /// Totals at a time inside the current segment, which the integration has reached.
    pub fn totals(&self, time_s: f64) -> Totals {
        self.segment.totals(time_s)
    }

    /// Change of momentum by each effect since the last dump, at a time inside the current segment.
    pub fn by_source(&self, time_s: f64) -> SourceMomenta {
        self.segment.by_source(time_s)
    }

    /// The attitude of this frame, which the body has at a time inside the current segment, its quaternion continuous along the
    /// flight; where the law jumps, the sign is the nearer one.
    pub fn attitude(&self, inertial_from_body: &Rotation3<f64>, time_s: f64) -> Attitude {
        Attitude::from_rotation(inertial_from_body).continuing(&self.segment.sign_reference(time_s))
    }

    /// Whether the integration has reached `time_s`, and its totals are known there.
    pub fn covers(&self, time_s: f64) -> bool {
        let edge_tolerance_s = edge_tolerance_s(time_s);
        self.segment.span.start_s <= time_s + edge_tolerance_s && time_s <= self.segment.span.end_s
    }

    /// Forgets what was computed ahead of `time_s`: the flight changes there.
    pub fn cut(&mut self, time_s: f64) {
        self.go_on(time_s, self.segment.totals(time_s));
    }

    /// The dump at `time_s` that brings the momentum to `target_body_n_m_s` in the watched convention; the flight changes there.
    pub fn request(
        &mut self,
        flight: &mut impl TorqueModel,
        settings: &Settings,
        time_s: f64,
        target_body_n_m_s: Vector3<f64>,
    ) -> DumpEvent {
        let totals = self.segment.totals(time_s);
        let inertial_from_body = flight.inertial_from_body(time_s);
        let before_body_n_m_s = totals.momentum_body_n_m_s(settings.convention, &inertial_from_body);
        self.segment.span.next_longest_s = f64::INFINITY;
        DumpEvent { time_s, before_body_n_m_s, after_body_n_m_s: target_body_n_m_s }
    }

    /// Dumps as this event says.
    pub fn dump(&mut self, flight: &mut impl TorqueModel, event: &DumpEvent) {
        let time_s = event.time_s;
        let mut totals = self.segment.totals(time_s);
        totals.torque_integral_body_n_m_s += event.impulse_body_n_m_s();
        totals.momentum_inertial_n_m_s += flight.inertial_from_body(time_s) * event.impulse_body_n_m_s();
        self.segment = self.segment.restarted(time_s, totals, SourceMomenta::default());
        self.dumps = self.dumps.with(*event);
    }

    /// End of the current segment, in s: up to there everything is known.
    pub fn end_s(&self) -> f64 {
        self.segment.span.end_s
    }

    /// Whether the current segment ends before `time_s` or there; an edge belongs to the segment that begins there.
    pub fn ends_by(&self, time_s: f64) -> bool {
        self.segment.span.end_s <= time_s + edge_tolerance_s(time_s)
    }

    /// Makes the next segment ready, which ends at `limit_s` at the latest.
    ///
    /// # Errors
    /// What ends the flight.
    pub fn prepare<F: TorqueModel>(
        &self,
        flight: &mut F,
        settings: &Settings,
        limit_s: f64,
    ) -> Result<PreparedSegment, F::Failure> {
        let start_s = self.segment.span.end_s;
        let (totals, by_source) = (self.segment.totals(start_s), self.segment.by_source(start_s));
        let limit_s = next_multiple_s(start_s, settings.grid_s).min(limit_s);
        let (horizon_s, inertial_from_body) = flight.prepare(start_s, limit_s)?;
        let before_body_n_m_s = totals.momentum_body_n_m_s(settings.convention, &inertial_from_body);
        // A component that just came to its threshold does not exceed it yet.
        let mut exceeded = settings.policy.exceeded_by(&before_body_n_m_s);
        exceeded.iter_mut().zip(self.segment.at_threshold).for_each(|(it, reached)| *it |= reached);
        let due = exceeded.contains(&true).then(|| {
            let after_body_n_m_s = settings.policy.reinitialised(&before_body_n_m_s, &exceeded);
            DumpEvent { time_s: start_s, before_body_n_m_s, after_body_n_m_s }
        });
        // A law that jumps here takes the sign nearer to the motion that ends.
        let ended = self.segment.attitude(start_s);
        let attitude = Attitude::from_rotation(&inertial_from_body).continuing(&ended).unit_quaternion();
        Ok(PreparedSegment { horizon_s, attitude, totals, by_source, due })
    }

    /// Integrates over the next segment.
    ///
    /// # Errors
    /// What ends the flight; everything before stays.
    pub fn advance_segment<F: TorqueModel>(
        &mut self,
        flight: &mut F,
        settings: &Settings,
        prepared: &PreparedSegment,
    ) -> Result<(), F::Failure> {
        let PreparedSegment { horizon_s, attitude, totals, by_source, .. } = *prepared;
        let start = MomentumSegment::point(self.segment.span.end_s, attitude, totals, by_source);
        self.segment.advance(flight, settings, horizon_s, &start)
    }

    /// The velocity changes by `delta_v_inertial_m_s` where a dump just ended.
    pub fn push(&mut self, delta_v_inertial_m_s: &Vector3<f64>) {
        let time_s = self.segment.span.end_s;
        let mut totals = self.segment.totals(time_s);
        totals.delta_v_inertial_m_s += delta_v_inertial_m_s;
        self.go_on(time_s, totals);
    }

    /// Goes on from `time_s`, inside the current segment, with these totals.
    fn go_on(&mut self, time_s: f64, totals: Totals) {
        self.segment = self.segment.restarted(time_s, totals, self.segment.by_source(time_s));
    }
}

/// Times this close to an edge count as the edge.
fn edge_tolerance_s(time_s: f64) -> f64 {
    4.0 * f64::EPSILON * time_s.abs()
}

#[cfg(test)]
mod tests;
