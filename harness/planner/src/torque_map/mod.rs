//! Torque of sunlight over the Sun's azimuth and elevation: loads, where they vanish, where they balance, what a degree is worth.

mod balance;
mod contour;
mod grid;
mod mapped;
mod panels;
mod sunlight;
mod worth;
mod zero_lines;

pub use balance::{Balance, least};
pub use contour::{Edge, lines};
pub use grid::{Angles, Grid, direction};
pub use mapped::Mapped;
pub use panels::{Rule, TurnedPanels};
pub use sunlight::{LitSpacecraft, Load, Sunlight};
pub use worth::{TorqueSensitivity, worths};
pub use zero_lines::ZeroLine;
