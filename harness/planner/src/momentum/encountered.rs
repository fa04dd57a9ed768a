//! How a simulated flight misses what it is aimed at, and what moves that: B.T (m), B.R (m), arrival (s).

use nalgebra::{Matrix3, Vector3};

/// How a flight misses its aimpoint, and what moves that.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Encountered {
    /// Reached less aimed at.
    pub miss: Vector3<f64>,
    /// By a change of velocity in m/s, EME2000, at times in s of the flight, which grow; nothing moves it behind the last.
    pub by_velocity: Vec<(f64, Matrix3<f64>)>,
}

impl Encountered {
    /// By a change of velocity at a time, interpolated.
    pub fn by_velocity_at(&self, time_s: f64) -> Matrix3<f64> {
        let after = self.by_velocity.partition_point(|(at_s, _)| *at_s <= time_s);
        let before = after.checked_sub(1).and_then(|at| self.by_velocity.get(at));
        match (before, self.by_velocity.get(after)) {
            (Some((from_s, from)), Some((to_s, to))) => {
                from + (to - from) * ((time_s - from_s) / (to_s - from_s))
            }
            (None, Some((_, first))) => *first,
            (Some((at_s, last)), None) if *at_s == time_s => *last,
            _ => Matrix3::zeros(),
        }
    }
}
