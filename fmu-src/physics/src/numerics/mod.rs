//! Numerical tools: Chebyshev segments, quadrature, roots, integrator with dense output, random draws, the
//! scalar of the kernels.

pub mod adaptive;
pub mod chebyshev;
pub mod collocation;
pub mod error_function;
pub mod events;
pub mod golden_section;
pub mod intervals;
pub mod noise;
pub mod or_infinite;
pub mod quadrature;
pub mod roots;
pub mod scalar;
pub mod spacing;
pub mod span;
pub mod work;

pub use golden_section::golden_section;
pub use span::Span;
