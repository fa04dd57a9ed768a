//! Temperatures of surfaces that store heat, along one segment of light and heat.

use crate::numerics::chebyshev::Segment;
use crate::numerics::quadrature::lagrange;
use crate::radiation::disturbance::DisturbanceModel;

use super::radiation_node::RadiationNode;
use super::radiation_segment::NODES;

/// Pieces between two neighbouring nodes, and between the outer nodes and the segment's ends.
const PIECES: usize = 2;

/// How to integrate from a segment's start over its nodes to its end: along each piece heat runs on a straight line between
/// values of the polynomial through the nodes.
#[derive(Clone, Debug)]
pub(crate) struct HeatRule {
    /// The points in rising order; the first is the segment's start.
    points: Vec<Point>,
    from_w: Vec<f64>,
    to_w: Vec<f64>,
    /// Temperatures at the end of the segment last integrated.
    pub temperatures_k: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Point {
    /// From -1 at the segment's start to 1 at its end.
    at: f64,
    /// Shares of the nodes' values in the polynomial's value here.
    shares: [f64; NODES],
    /// The node this is.
    node: Option<usize>,
}

impl HeatRule {
    pub(crate) fn new() -> Self {
        let nodes = Segment::<1, NODES>::nodes(-1.0, 1.0);
        let point = |at: f64, node| Point { at, shares: lagrange(&nodes, at), node };
        let mut points = vec![point(-1.0, None)];
        let rising = (0..NODES).rev().map(|j| (nodes[j], Some(j)));
        let mut from = -1.0;
        for (to, node) in rising.chain([(1.0, None)]) {
            for piece in 1..=PIECES {
                let at = from + (to - from) * piece as f64 / PIECES as f64;
                points.push(point(at, node.filter(|_| piece == PIECES)));
            }
            from = to;
        }
        Self { points, from_w: Vec::new(), to_w: Vec::new(), temperatures_k: Vec::new() }
    }

    /// Temperatures at every node (the segment's nodes, whose heat is known) and at the segment's end.
    pub(crate) fn integrate(
        &mut self,
        model: &DisturbanceModel,
        nodes: &mut [RadiationNode],
        start_k: &[f64],
        length_s: f64,
    ) {
        self.temperatures_k.clear();
        self.temperatures_k.extend_from_slice(start_k);
        self.from_w.resize(start_k.len(), 0.0);
        self.to_w.resize(start_k.len(), 0.0);
        let mut from = -1.0;
        for point in &self.points {
            core::mem::swap(&mut self.from_w, &mut self.to_w);
            for (face, heat_w) in self.to_w.iter_mut().enumerate() {
                let values = nodes.iter().zip(point.shares);
                *heat_w = values.map(|(node, share)| share * node.heat_w[face]).sum();
            }
            let duration_s = 0.5 * (point.at - from) * length_s;
            model.advance_temperatures(&mut self.temperatures_k, &self.from_w, &self.to_w, duration_s);
            if let Some(node) = point.node.and_then(|node| nodes.get_mut(node)) {
                node.temperatures_k.copy_from_slice(&self.temperatures_k);
            }
            from = point.at;
        }
    }
}
