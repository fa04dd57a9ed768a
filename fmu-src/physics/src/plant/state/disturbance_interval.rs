//! Disturbances over one interval of their grid, linear in time.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::loads::{ByEffect, Effect, ForceTorque, Linear, Loads};
use crate::numerics::adaptive::SegmentSpan;
use crate::plant::settings::digest::Digest;

/// Loads on the body and direction of the Sun over one interval. The default stands before the first one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct DisturbanceInterval {
    pub span: SegmentSpan,
    /// Digest of the settings that it was made for.
    pub made_for: Digest,
    /// Force and torque of the disturbances that act, body frame; what is applied is known at any time, what acts by a field follows
    /// from it and the attitude.
    pub loads: ByEffect<Option<[Linear; 2]>>,
    /// Magnetic field, EME2000.
    pub field_inertial_t: Linear,
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Linear,
    /// Visible part of the Sun's disc, at the start and per second.
    pub lit_fraction: [f64; 2],
}

impl DisturbanceInterval {
    /// Whether no interval has begun.
    pub(crate) fn is_before(&self) -> bool {
        self.span.is_before()
    }

    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        self.span.is_valid() && (self.is_before() || self.span.start_s <= self.span.end_s)
    }

    /// Force and torque by effect at `time_s`.
    pub(crate) fn loads_at(&self, time_s: f64) -> Loads {
        let elapsed_s = time_s - self.span.start_s;
        let mut loads = Loads::zero();
        for (effect, lines) in self.loads.present() {
            let [force_body_n, torque_body_n_m] = lines.map(|[start, slope]| start + slope * elapsed_s);
            loads[effect] = ForceTorque { force_body_n, torque_body_n_m };
        }
        loads
    }

    /// Magnetic field at `time_s`, EME2000, in T, and its rate in T/s.
    pub(crate) fn field_at(&self, time_s: f64) -> Linear {
        let [start, rate] = self.field_inertial_t;
        [start + rate * (time_s - self.span.start_s), rate]
    }

    /// Torque of a disturbance that acts at `time_s` and its slope, in N m and N m/s.
    pub(crate) fn torque_at(&self, effect: Effect, time_s: f64) -> Option<Linear> {
        self.loads[effect].map(|[_, [start, slope]]| [start + slope * (time_s - self.span.start_s), slope])
    }

    /// Sum over the effects at `time_s`: force in N and its slope in N/s, torque in N m and its slope in N m/s.
    pub(crate) fn total_at(&self, time_s: f64) -> [Linear; 2] {
        let elapsed_s = time_s - self.span.start_s;
        let mut total = [[Vector3::zeros(); 2]; 2];
        for (_, lines) in self.loads.present() {
            for ([sum, sum_slope], [start, slope]) in total.iter_mut().zip(lines) {
                *sum += start + slope * elapsed_s;
                *sum_slope += slope;
            }
        }
        total
    }

    /// Total force at `time_s`, body frame, in N: the disturbances and the `applied` load, given with its slope at `since_s`.
    pub(crate) fn force_body_n(&self, applied: &[ForceTorque; 2], since_s: f64, time_s: f64) -> Vector3<f64> {
        let ([[disturbance_n, _], _], [load, slope]) = (self.total_at(time_s), applied);
        disturbance_n + load.force_body_n + slope.force_body_n * (time_s - since_s)
    }

    /// Unit vector to the Sun, EME2000, and the visible part of its disc at `time_s`.
    pub(crate) fn sun_at(&self, time_s: f64) -> (Vector3<f64>, f64) {
        let elapsed_s = time_s - self.span.start_s;
        let to_sun = (self.to_sun[0] + self.to_sun[1] * elapsed_s).normalize();
        (to_sun, (self.lit_fraction[0] + self.lit_fraction[1] * elapsed_s).clamp(0.0, 1.0))
    }
}
