//! When thrusters take momentum off the wheels, and what they leave (paper 000, "Simulation").

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A component re-initialised exactly at the opposite threshold hovers there within rounding; only more than this
/// counts as exceeding, in N m s.
pub(super) const EXCEEDED_N_M_S: f64 = 0.5e-9;

/// Target of a component that exceeded its threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reinitialise {
    /// The opposite sign at this fraction of the threshold; the paper uses 1.
    Opposite {
        /// Between 0 (to zero) and 1 (to the opposite threshold).
        fraction: f64,
    },
    /// The component of a chosen vector (zero, or biased against what is coming), in N m s.
    Target {
        /// Body frame, from the wheels' bias.
        momentum_body_n_m_s: Vector3<f64>,
    },
}

/// Thresholds and what follows when one is exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DumpPolicy {
    /// Magnitude that triggers a dump, per body axis, in N m s; infinite = never.
    pub threshold_body_n_m_s: Vector3<f64>,
    /// Target of a component that exceeded its threshold.
    pub reinitialise: Reinitialise,
    /// Momentum of the wheels' bias, body frame, in N m s: thresholds and what a dump leaves count from there.
    pub bias_body_n_m_s: Vector3<f64>,
}

impl DumpPolicy {
    /// Whether no momentum is large enough for a dump.
    pub fn begins_none(&self) -> bool {
        self.threshold_body_n_m_s.iter().all(|it| it.is_infinite())
    }

    /// Whether a component exceeds its threshold, by more than rounding does.
    pub fn exceeded(&self, momentum_body_n_m_s: &Vector3<f64>) -> bool {
        self.exceeded_by(momentum_body_n_m_s).contains(&true)
    }

    /// The same of each component.
    pub fn exceeded_by(&self, momentum_body_n_m_s: &Vector3<f64>) -> [bool; 3] {
        self.excesses_n_m_s(momentum_body_n_m_s).map(|it| it > EXCEEDED_N_M_S).into()
    }

    /// How far each component lies above its threshold, in N m s; negative while it does not.
    fn excesses_n_m_s(&self, momentum_body_n_m_s: &Vector3<f64>) -> Vector3<f64> {
        (momentum_body_n_m_s - self.bias_body_n_m_s).abs() - self.threshold_body_n_m_s
    }

    /// The momentum after a dump at `momentum_body_n_m_s`: components above their threshold are set anew, the
    /// others stay.
    pub fn after(&self, momentum_body_n_m_s: &Vector3<f64>) -> Vector3<f64> {
        self.reinitialised(momentum_body_n_m_s, &self.exceeded_by(momentum_body_n_m_s))
    }

    /// The same with the components that are set anew named.
    pub fn reinitialised(&self, momentum_body_n_m_s: &Vector3<f64>, components: &[bool; 3]) -> Vector3<f64> {
        Vector3::from_fn(|axis, _| {
            let (now_n_m_s, bias_n_m_s) = (momentum_body_n_m_s[axis], self.bias_body_n_m_s[axis]);
            let from_bias_n_m_s = match self.reinitialise {
                _ if !components[axis] => return now_n_m_s,
                Reinitialise::Opposite { fraction } => {
                    -(now_n_m_s - bias_n_m_s).signum() * fraction * self.threshold_body_n_m_s[axis]
                }
                Reinitialise::Target { momentum_body_n_m_s } => momentum_body_n_m_s[axis],
            };
            bias_n_m_s + from_bias_n_m_s
        })
    }
}

/// No thruster dumps this often within [`DUMP_WINDOW_S`].
const MOST_DUMPS_IN_WINDOW: u32 = 1_000;
/// See [`MOST_DUMPS_IN_WINDOW`], in s.
pub(super) const DUMP_WINDOW_S: f64 = 1.0;

/// Dumps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dumps {
    /// How many.
    pub count: i32,
    /// The last one, once there was one.
    pub last: Option<DumpEvent>,
    /// The first of those that followed one another within [`DUMP_WINDOW_S`], and how many followed.
    window: (f64, u32),
}

/// Dumps without end: the torque outruns what a dump leaves.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "{MOST_DUMPS_IN_WINDOW} dumps between {from_s:?} s and {to_s:?} s, allowed: fewer within {DUMP_WINDOW_S} s; the thresholds are too low \
     for the torque"
)]
pub struct TooManyDumps {
    /// The first of them, in s.
    pub from_s: f64,
    /// The last of them, in s.
    pub to_s: f64,
}

/// A dump as it happens; instantaneous.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DumpEvent {
    /// When, in s.
    pub time_s: f64,
    /// Momentum before, body frame, in the watched convention, in N m s.
    pub before_body_n_m_s: Vector3<f64>,
    /// Momentum after, likewise.
    pub after_body_n_m_s: Vector3<f64>,
}

impl DumpEvent {
    /// Angular impulse of the thrusters, body frame, in N m s.
    pub fn impulse_body_n_m_s(&self) -> Vector3<f64> {
        self.after_body_n_m_s - self.before_body_n_m_s
    }
}

/// Shortest time between two dumps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DumpSpacing {
    last_s: Option<f64>,
    /// In s; absent before the second dump.
    pub closest_s: Option<f64>,
}

impl DumpSpacing {
    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.closest_s.is_none_or(|gap_s| gap_s >= 0.0)
    }

    /// Counts a dump.
    pub fn dumped(&mut self, event: &DumpEvent) {
        if let Some(last_s) = self.last_s.replace(event.time_s) {
            let gap_s = event.time_s - last_s;
            self.closest_s = Some(self.closest_s.map_or(gap_s, |closest_s| closest_s.min(gap_s)));
        }
    }
}

impl Dumps {
    /// Rejects decoded states that no simulation can produce.
    pub(crate) fn is_valid(&self) -> bool {
        self.count >= 0
    }

    pub(crate) fn with(self, event: DumpEvent) -> Self {
        let (from_s, count) = self.window;
        // Written so that a restored NaN begins anew.
        let goes_on = event.time_s - from_s < DUMP_WINDOW_S;
        let window = if goes_on && count > 0 { (from_s, count.saturating_add(1)) } else { (event.time_s, 1) };
        Self { count: self.count.saturating_add(1), last: Some(event), window }
    }

    pub(crate) fn check(&self) -> Result<(), TooManyDumps> {
        let (from_s, count) = self.window;
        let to_s = self.last.map_or(from_s, |event| event.time_s);
        if count < MOST_DUMPS_IN_WINDOW { Ok(()) } else { Err(TooManyDumps { from_s, to_s }) }
    }
}

#[cfg(test)]
mod tests {
    //! Only the component that exceeded moves, and it moves where the policy says.
    use super::*;

    const POLICY: DumpPolicy = DumpPolicy {
        threshold_body_n_m_s: Vector3::new(4.0, 5.0, f64::INFINITY),
        reinitialise: Reinitialise::Opposite { fraction: 0.9 },
        bias_body_n_m_s: Vector3::new(0.0, 0.0, 0.0),
    };

    #[test]
    fn only_what_exceeded_is_set_anew() {
        let after = POLICY.after(&Vector3::new(-4.1, 3.0, 1e6));
        assert_eq!(after, Vector3::new(3.6, 3.0, 1e6));
    }

    #[test]
    fn a_target_replaces_the_opposite_threshold() {
        let policy = DumpPolicy {
            reinitialise: Reinitialise::Target { momentum_body_n_m_s: Vector3::new(0.5, -1.0, 2.0) },
            ..POLICY
        };
        assert_eq!(policy.after(&Vector3::new(4.1, 5.5, 0.0)), Vector3::new(0.5, -1.0, 0.0));
    }

    /// A flight about a bias is that about rest, moved by it.
    #[test]
    fn everything_counts_from_the_bias() {
        let bias = Vector3::new(1.0, -8.0, 2.0);
        for reinitialise in
            [POLICY.reinitialise, Reinitialise::Target { momentum_body_n_m_s: Vector3::new(0.5, -1.0, 2.0) }]
        {
            let rest = DumpPolicy { reinitialise, ..POLICY };
            let moved = DumpPolicy { bias_body_n_m_s: bias, ..rest };
            for momentum in [Vector3::new(-4.5, 5.5, 1e6), Vector3::new(4.5, 4.5, 0.0), Vector3::zeros()] {
                assert_eq!(moved.exceeded_by(&(momentum + bias)), rest.exceeded_by(&momentum));
                assert!((moved.after(&(momentum + bias)) - bias - rest.after(&momentum)).norm() < 1e-9);
            }
        }
    }

    #[test]
    fn excess_changes_sign_at_the_threshold() {
        let excess_n_m_s = |momentum| POLICY.excesses_n_m_s(&momentum).max();
        assert!(excess_n_m_s(Vector3::new(3.999, -4.999, 1e9)) < 0.0);
        assert_eq!(excess_n_m_s(Vector3::new(0.0, -5.0, 0.0)), 0.0);
        assert!(excess_n_m_s(Vector3::new(-4.001, 0.0, 0.0)) > 0.0);
    }
}
