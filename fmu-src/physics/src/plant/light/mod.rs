//! Light and heat on the surfaces over a span of time.

pub(super) mod light_and_heat;
pub(super) mod radiation_node;
pub(super) mod radiation_segment;
pub(super) mod radiation_solver;
pub(super) mod stored_heat;
pub(super) mod sunlit;
