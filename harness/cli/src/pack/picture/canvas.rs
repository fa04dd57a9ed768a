//! Size of the picture.

pub const WIDTH: f64 = 480.0;
pub const HEIGHT: f64 = 320.0;
pub const MARGIN: f64 = 28.0;
