//! Light and heat on the surfaces over a span of time.

pub mod light_and_heat;
pub mod radiation_node;
pub mod radiation_segment;
pub mod radiation_solver;
pub mod stored_heat;
pub mod sunlit;
