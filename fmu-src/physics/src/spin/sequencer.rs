//! Turns a burn into edges in time, on the trajectory as it is.

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::Inertia;
use crate::math;

use super::{
    burn::Burn,
    crossing::{Crossing, Pole},
    forecast::Timing,
    motion::Motion,
    work::Work,
};

/// Slowest and fastest spin that burns are timed for.
pub const SLOWEST_RAD_S: f64 = 1e-4;
/// See [`SLOWEST_RAD_S`].
pub const FASTEST_RAD_S: f64 = 1e4;

/// Phase of the sequence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Phase {
    /// No edge is known: no Sun crossing seen yet, or the body does not bring the thruster round.
    Idle,
    /// Too early to follow the motion to the next pulse: it will be timed later.
    Later {
        /// Time, in s.
        at_s: f64,
    },
    /// The next pulse is timed.
    Waiting {
        /// First edge, in s.
        on_s: f64,
        /// Second edge, in s.
        off_s: f64,
    },
    /// A pulse is on.
    Firing {
        /// Second edge, in s.
        off_s: f64,
    },
    /// All pulses fired.
    Done,
}

/// State of a burn in flight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sequencer {
    /// The burn.
    pub burn: Burn,
    /// Pulses finished.
    pub fired: u32,
    /// Present phase.
    pub phase: Phase,
    /// Centre of the first pulse, in s.
    first_centre_s: f64,
    /// Last centre without its deliberate offset, in s.
    last_centre_s: f64,
    /// Last Sun crossing, in s.
    sun_crossing_s: Option<f64>,
    /// Azimuth of the Sun sensor's slit in the body, in rad.
    sensor_azimuth_rad: f64,
}

impl Sequencer {
    /// A burn about to be simulated.
    pub fn new(burn: Burn, sensor_azimuth_rad: f64) -> Self {
        Self {
            burn,
            fired: 0,
            phase: Phase::Idle,
            first_centre_s: 0.0,
            last_centre_s: 0.0,
            sun_crossing_s: None,
            sensor_azimuth_rad,
        }
    }

    /// Whether the numbers of a decoded state belong together.
    pub fn is_valid(&self) -> bool {
        let edges = match self.phase {
            Phase::Waiting { on_s, off_s } => off_s >= on_s,
            _ => true,
        };
        let (rate, count) = (self.burn.assumed_rate_rad_s, self.burn.train.count);
        let counted = matches!(self.phase, Phase::Done) == (self.fired >= count);
        edges
            && self.burn.is_valid()
            && counted
            && self.fired <= count
            && self.burn.train.is_valid()
            && (0.1 * SLOWEST_RAD_S..=10.0 * FASTEST_RAD_S).contains(&rate)
    }

    /// Whether a pulse is on.
    pub fn is_firing(&self) -> bool {
        matches!(self.phase, Phase::Firing { .. })
    }

    /// Whether the sequence is neither finished nor yet to start.
    pub fn is_active(&self) -> bool {
        self.is_firing() || (self.fired > 0 && !matches!(self.phase, Phase::Done))
    }

    /// Thrusters of the pulse that is on.
    pub fn mask(&self) -> u32 {
        if self.is_firing() { self.burn.actuator(self.fired).0 } else { 0 }
    }

    /// The next edge, in s; infinite without one.
    pub fn next_edge_s(&self) -> f64 {
        match self.phase {
            Phase::Waiting { on_s, .. } => on_s,
            Phase::Firing { off_s } => off_s,
            Phase::Later { at_s } => at_s,
            Phase::Idle | Phase::Done => f64::INFINITY,
        }
    }

    /// Passes the next edge at `now_s`. How long the pulse lasts, if it continued.
    pub fn pass_edge(&mut self, now_s: f64) -> Option<f64> {
        match self.phase {
            Phase::Waiting { off_s, .. } => {
                self.phase = Phase::Firing { off_s };
                Some(off_s - now_s)
            }
            Phase::Firing { .. } => {
                self.fired += 1;
                self.phase = if self.fired == self.burn.train.count { Phase::Done } else { Phase::Idle };
                None
            }
            Phase::Later { .. } => {
                self.phase = Phase::Idle;
                None
            }
            Phase::Idle | Phase::Done => None,
        }
    }

    /// Ends the burn where it stands; a pulse under way does not count as fired.
    pub fn stop(&mut self) {
        if self.phase != Phase::Done {
            self.phase = Phase::Idle;
        }
    }

    /// Times the next pulse on the motion from `now_s` on, where it may have changed.
    pub fn schedule(&mut self, motion: &Motion, now_s: f64, sun_inertial: &Vector3<f64>, work: &mut Work) {
        if matches!(self.phase, Phase::Firing { .. } | Phase::Done) {
            return;
        }
        let train = &self.burn.train;
        let k = self.fired;
        let period_s = self.burn.assumed_period_s();
        // From the opening of the valve to the centre of the thrust, and on to the closing.
        let about = self.burn.about_centre(k);
        let (before_s, after_s) = (-about.start_s, about.end_s);
        let offset_s = train.offset_turns(k) * period_s;
        let turns = |k: u32| 0.5 * f64::from(train.half_turns(k));
        // Earliest exact centre: after the burn's start, now, and three quarters of the spacing since the last.
        let mut earliest_s = self.burn.start_s.max(now_s) + before_s - offset_s;
        if k > 0 {
            earliest_s = earliest_s.max(self.last_centre_s + (turns(k) - turns(k - 1) - 0.25) * period_s);
        }
        let far = earliest_s - now_s > 2.0 * period_s && motion.segment_end_s().is_finite();
        let clocked = k > 0 && self.burn.timing == Timing::Clock;
        let centre_s = if !self.burn.points() {
            let first_s = self.burn.start_s.max(now_s) + before_s;
            Some(if k > 0 { self.first_centre_s + turns(k) * period_s } else { first_s })
        } else if clocked {
            Some(self.first_centre_s + train.turns(k) * period_s - offset_s)
        } else if self.burn.timing == Timing::SunCrossing {
            self.after_sun_crossing(motion, now_s, sun_inertial, earliest_s)
        } else if far {
            None
        } else {
            self.exact_phase(motion, earliest_s, work)
        };
        let exact = self.burn.points() && !clocked && self.burn.timing != Timing::SunCrossing;
        self.phase = match centre_s {
            None if far && exact => Phase::Later { at_s: earliest_s - period_s },
            None => Phase::Idle,
            Some(centre_s) => {
                let centre_s = centre_s + offset_s;
                Phase::Waiting { on_s: (centre_s - before_s).max(now_s), off_s: centre_s + after_s }
            }
        };
    }

    /// Records where the pulse that starts now is centred; called at its first edge.
    pub fn record_centre(&mut self) {
        if let Phase::Waiting { off_s, .. } = self.phase {
            let k = self.fired;
            let centre_s = off_s - self.burn.about_centre(k).end_s;
            if k == 0 {
                self.first_centre_s = centre_s;
            }
            self.last_centre_s = centre_s - self.burn.train.offset_turns(k) * self.burn.assumed_period_s();
        }
    }

    /// A Sun pulse at `time_s`: the pulse that waits for it is timed anew, unless it would be late.
    pub fn sun_pulse(&mut self, motion: &Motion, time_s: f64, sun_inertial: &Vector3<f64>, work: &mut Work) {
        if self.burn.timing != Timing::SunCrossing {
            return;
        }
        let (before, phase) = (self.sun_crossing_s, self.phase);
        self.sun_crossing_s = Some(time_s);
        self.schedule(motion, time_s, sun_inertial, work);
        if let (Phase::Waiting { on_s, .. }, Phase::Waiting { on_s: old_s, .. }, Some(_)) =
            (self.phase, phase, before)
            && on_s > old_s + 0.25 * self.burn.assumed_period_s()
        {
            self.phase = phase;
        }
    }

    /// Whether an edge known before must be timed again when the motion changes.
    pub fn follows_motion(&self) -> bool {
        matches!(self.phase, Phase::Idle | Phase::Later { .. } | Phase::Waiting { .. })
            && self.burn.points()
            && (self.fired == 0 || self.burn.timing == Timing::TruePhase)
            && self.burn.timing != Timing::SunCrossing
    }

    fn exact_phase(&self, motion: &Motion, earliest_s: f64, work: &mut Work) -> Option<f64> {
        let (_, torque) = self.burn.actuator(self.fired);
        let axis = motion.inertia.spin_axis_body();
        let across = torque - axis * axis.dot(&torque);
        let crossing = Crossing { body: across, inertial: self.burn.target_inertial, pole: Pole::Momentum };
        crossing.next_s(motion, earliest_s, work)
    }

    /// The last Sun crossing plus the delay that the ground computes from the directions and the assumed rate.
    fn after_sun_crossing(
        &self,
        motion: &Motion,
        now_s: f64,
        sun_inertial: &Vector3<f64>,
        earliest_s: f64,
    ) -> Option<f64> {
        let crossing_s = self.sun_crossing_s?;
        let state = motion.at(now_s);
        let pole = state.momentum_inertial.normalize();
        let (_, torque) = self.burn.actuator(self.fired);
        // Spin from the instant the Sun's azimuth about the momentum is on the sensor to that of the target on the
        // torque: both read off the present attitude, whose own phase cancels.
        let inertia = &motion.inertia;
        let azimuth = |direction: &Vector3<f64>| {
            let seen = state.attitude.body_from_inertial(&(direction - pole * pole.dot(direction)));
            let seen = inertia.spin_frame_from_body(&seen);
            math::atan2(seen.y, seen.x)
        };
        let torque = inertia.spin_frame_from_body(&torque);
        let spin =
            azimuth(&self.burn.target_inertial) - math::atan2(torque.y, torque.x) - azimuth(sun_inertial)
                + self.crossing_azimuth_rad(inertia, sun_inertial.dot(&pole));
        let period_s = self.burn.assumed_period_s();
        let delay_s = spin.rem_euclid(2.0 * PI) / (2.0 * PI) * period_s;
        let first_s = crossing_s + delay_s;
        let turns = ((earliest_s - first_s) / period_s).ceil().max(0.0);
        Some(first_s + turns * period_s)
    }

    /// Azimuth about the spin axis at which a Sun whose angle from it has this cosine crosses the slit: that of the slit, and a
    /// little off it where the slit is not parallel to the spin axis.
    fn crossing_azimuth_rad(&self, inertia: &Inertia, cosine: f64) -> f64 {
        let (sine_slit, cosine_slit) = math::sin_cos(self.sensor_azimuth_rad);
        let normal = inertia.spin_frame_from_body(&Vector3::new(-sine_slit, cosine_slit, 0.0));
        if normal.z == 0.0 {
            return self.sensor_azimuth_rad;
        }
        // Normal and Sun are perpendicular: sin(azimuth - slit) = -n3 cot(angle) / |n12|.
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let off = math::asin((-normal.z * cosine / (normal.xy().norm() * sine)).clamp(-1.0, 1.0));
        math::atan2(-normal.x, normal.y) + off
    }
}
