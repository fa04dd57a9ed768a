//! A rectangle of the Sun's directions and what is found in it.

use fmi::Error;
use rayon::join;

use super::{
    balance::{self, Balance},
    grid::{Angles, Grid},
    sunlight::{LitSpacecraft, Sunlight},
    zero_lines::{self, ZeroLine},
};

/// A rectangle of directions and what is found in it.
pub struct Mapped {
    /// The loads.
    pub grid: Grid,
    /// Lines on which X, Y and Z vanish.
    pub lines: [Vec<ZeroLine>; 3],
    /// Points at which X and Z vanish together.
    pub balances: Vec<Balance>,
}

impl Mapped {
    /// Asks the FMU for all of it, on several threads.
    ///
    /// # Errors
    /// A call that failed.
    pub fn new(spacecraft: &LitSpacecraft, limits_deg: Angles, steps: [usize; 2]) -> Result<Self, Error> {
        let grid = Grid::new(spacecraft, limits_deg, steps)?;
        let lines = |axis: usize| zero_lines::find(&mut Sunlight::new(spacecraft)?, &grid, axis);
        let balances = || balance::find(&mut Sunlight::new(spacecraft)?, &grid);
        let ((x, y), (z, balances)) = join(|| join(|| lines(0), || lines(1)), || join(|| lines(2), balances));
        Ok(Self { lines: [x?, y?, z?], balances: balances?, grid })
    }
}
