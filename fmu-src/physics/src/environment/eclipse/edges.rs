//! Crossings of a shadow's edges, in a list of fixed size.

use serde::{Deserialize, Serialize};

/// Most edges [`super::Shadow::edges`] reports at once.
pub const MOST_EDGES: usize = 16;

/// Which edge of a shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum EdgeKind {
    /// Between full light and the penumbra (or the all-or-nothing shadow).
    Outer,
    /// Between the penumbra and the umbra, or the annular eclipse.
    Inner,
}

/// One crossing of a shadow's edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// When, s, on the clock of the geometry.
    pub at_s: f64,
    /// Which edge.
    pub kind: EdgeKind,
    /// Whether it gets darker.
    pub into_shadow: bool,
}

/// Up to [`MOST_EDGES`] crossings in order of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Edges {
    held: [Option<Edge>; MOST_EDGES],
}

impl Edges {
    /// All of them, in order of time.
    pub fn iter(&self) -> impl Iterator<Item = Edge> + '_ {
        self.held.iter().flatten().copied()
    }

    /// The first one.
    pub fn first(&self) -> Option<Edge> {
        self.held[0]
    }

    pub(super) fn insert(&mut self, edge: Edge) {
        let mut carried = Some(edge);
        for slot in &mut self.held {
            let later = match (&carried, &*slot) {
                (Some(new), Some(held)) => new.at_s < held.at_s,
                (Some(_), None) => true,
                (None, _) => return,
            };
            if later {
                core::mem::swap(slot, &mut carried);
            }
        }
    }
}
