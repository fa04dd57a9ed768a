//! `dependencies` are exact: every input and every exact parameter is changed at many states, and what follows at once
//! is what the lists of `ModelStructure` say, no more and no less.

mod bench;
mod disturbance;
mod guidance;
mod plant;
mod plant_dynamics;
pub mod random;
pub mod spacecraft;
mod spin;
mod variable;
