//! When a sampled guidance asks thrusters for a dump, and to which momentum.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::momentum::DumpPolicy;

/// Requests so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DumpRequests {
    /// Components beyond their thresholds at the last sample.
    exceeded: [bool; 3],
    /// Whether the last sample asks for a dump.
    pub is_requested: bool,
    /// Momentum after the last request, body frame, from the wheels' bias, in N m s; zero before any.
    pub target_body_n_m_s: Vector3<f64>,
}

impl DumpRequests {
    /// Takes a sample: a component asks once, and again after it came back below its threshold; a dump that is `scheduled` for it
    /// leaves the momentum that it names.
    pub fn sample(
        &mut self,
        policy: &DumpPolicy,
        momentum_body_n_m_s: &Vector3<f64>,
        scheduled: Option<Vector3<f64>>,
    ) {
        let exceeded = policy.exceeded_by(momentum_body_n_m_s);
        self.is_requested = exceeded.iter().zip(self.exceeded).any(|(now, before)| *now && !before);
        self.exceeded = exceeded;
        if self.is_requested {
            self.target_body_n_m_s = policy.after(momentum_body_n_m_s) - policy.bias_body_n_m_s;
        }
        if let Some(target_body_n_m_s) = scheduled {
            (self.is_requested, self.target_body_n_m_s) = (true, target_body_n_m_s);
        }
    }
}

#[cfg(test)]
mod tests {
    //! A request lasts a sample, and each component has its own.
    use super::*;
    use crate::momentum::Reinitialise;

    #[test]
    fn every_crossing_asks_once() {
        let policy = DumpPolicy {
            threshold_body_n_m_s: Vector3::new(4.0, 5.0, 1.0),
            reinitialise: Reinitialise::Opposite { fraction: 0.5 },
            bias_body_n_m_s: Vector3::zeros(),
        };
        let mut requests = DumpRequests::default();
        let mut sample = |x, y, z| {
            requests.sample(&policy, &Vector3::new(x, y, z), None);
            (requests.is_requested, requests.target_body_n_m_s)
        };
        assert_eq!(sample(4.0, -5.0, 0.0), (false, Vector3::zeros()));
        let remaining = Vector3::new(-2.0, 3.0, 0.5);
        assert_eq!(sample(4.1, 3.0, 0.5), (true, remaining));
        assert_eq!(sample(4.2, 3.0, 0.5), (false, remaining));
        assert_eq!(sample(4.2, 3.0, -1.1), (true, Vector3::new(-2.0, 3.0, 0.5)));
        assert!(!sample(3.9, 3.0, -1.1).0);
        assert_eq!(sample(-4.5, 3.0, -1.1), (true, Vector3::new(2.0, 3.0, 0.5)));
    }
}
