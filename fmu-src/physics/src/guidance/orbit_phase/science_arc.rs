//! Science arc ahead with the Sun fixed in the body: momentum at its end under sunlight.
//!
//! Equation: H(end) = C(end)^T (H + sum of w_k C_k T), C_k the attitude of [`unloading`] at a node, T the torque at the begin, w_k the
//! time that it would take to do what it does about the node, by the pressure there.
//! Method: Gauss-Legendre quadrature of order 6 on 16 equal intervals, no shadows and no slews.
//! Error measure: none at run time.

use nalgebra::{Rotation3, Vector3};

use super::attitudes::{LinesOfSight, sun_pointing, unloading};
use crate::attitude::{MovingUnit, SunAngles};
use crate::guidance::pointing::boresight::Gimbal;
use crate::numerics::quadrature::GAUSS_3;

/// Intervals.
const INTERVALS: usize = 16;
/// Nodes.
const NODES: usize = 3 * INTERVALS;

/// Positions of Sun and planet at a time of the arc.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ArcPoint {
    /// From the spacecraft to the Sun, EME2000, in m.
    pub to_sun_m: Vector3<f64>,
    /// To the planet's centre, in m.
    pub to_planet_m: Vector3<f64>,
    /// Pressure of sunlight, in Pa.
    pub pressure_pa: f64,
}

/// Science ahead, with the nodes of its quadrature.
#[derive(Clone, Copy, Debug)]
pub struct ScienceArc {
    gimbal: Gimbal,
    nodes: [(ArcPoint, f64); NODES],
    begin: ArcPoint,
    end: ArcPoint,
}

impl ScienceArc {
    /// Science of `span_s`, from its points at fractions of the span from 0 to 1.
    pub fn new(gimbal: Gimbal, span_s: f64, mut at: impl FnMut(f64) -> ArcPoint) -> Self {
        let begin = at(0.0);
        let interval = 1.0 / INTERVALS as f64;
        let mut nodes = [(ArcPoint::default(), 0.0); NODES];
        let shares = (0..INTERVALS).flat_map(|k| GAUSS_3.map(|(node, weight)| (k as f64 + node, weight)));
        for (node, (share, weight)) in nodes.iter_mut().zip(shares) {
            let point = at(share * interval);
            let brightness =
                if begin.pressure_pa > 0.0 { point.pressure_pa / begin.pressure_pa } else { 1.0 };
            *node = (point, weight * interval * span_s * brightness);
        }
        Self { gimbal, nodes, begin, end: at(1.0) }
    }

    /// How long sunlight as at the begin takes to do what it does in all of it, in s.
    pub fn light_s(&self) -> f64 {
        self.nodes.iter().map(|(_, light_s)| light_s).sum()
    }

    /// Momentum at the end in N m s, body frame, of a momentum in EME2000 at the begin, the Sun at `sun` and its torque at the begin in
    /// N m, body frame.
    pub fn end_body_n_m_s(
        &self,
        sun: SunAngles,
        momentum_inertial_n_m_s: &Vector3<f64>,
        torque_body_n_m: &Vector3<f64>,
    ) -> Vector3<f64> {
        let added = self
            .nodes
            .iter()
            .map(|(point, light_s)| self.attitude(point, sun) * (torque_body_n_m * *light_s));
        self.attitude(&self.end, sun).inverse() * (momentum_inertial_n_m_s + added.sum::<Vector3<f64>>())
    }

    /// In EME2000, of a momentum along the body axes at the begin.
    pub fn begin_inertial_n_m_s(&self, sun: SunAngles, momentum_body_n_m_s: &Vector3<f64>) -> Vector3<f64> {
        self.attitude(&self.begin, sun) * momentum_body_n_m_s
    }

    /// The momentum of a body without torque at the end, body frame.
    pub fn carried_body_n_m_s(&self, sun: SunAngles, momentum_inertial_n_m_s: &Vector3<f64>) -> Vector3<f64> {
        self.attitude(&self.end, sun).inverse() * momentum_inertial_n_m_s
    }

    fn attitude(&self, point: &ArcPoint, sun: SunAngles) -> Rotation3<f64> {
        let still = |to_m: Vector3<f64>| MovingUnit::from_vector(to_m, Vector3::zeros());
        let to_sun = still(point.to_sun_m)
            .unwrap_or(MovingUnit { direction: Vector3::x(), rate_1_s: Vector3::zeros() });
        let lines = LinesOfSight {
            sun: to_sun,
            planet: still(point.to_planet_m),
            earth: to_sun,
            sun_from_planet: None,
        };
        let command = unloading(&lines, sun, &self.gimbal).unwrap_or_else(|| sun_pointing(&lines));
        command.frame.inertial_from_body
    }
}
