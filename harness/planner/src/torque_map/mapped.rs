//! A rectangle of the Sun's directions and what is found in it.

use std::{panic::resume_unwind, thread};

use loader::Error;

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
    /// Where X, Y and Z vanish.
    pub lines: [Vec<ZeroLine>; 3],
    /// Where X and Z vanish together.
    pub balances: Vec<Balance>,
}

impl Mapped {
    /// Asks the FMU for all of it, on several threads.
    ///
    /// # Errors
    /// A call that failed.
    pub fn new(spacecraft: &LitSpacecraft, limits_deg: Angles, steps: [usize; 2]) -> Result<Self, Error> {
        let grid = Grid::new(spacecraft, limits_deg, steps)?;
        let requested = &grid;
        let (lines, balances) = thread::scope(|scope| {
            let of = |axis: usize| {
                scope.spawn(move || zero_lines::find(&mut Sunlight::new(spacecraft)?, requested, axis))
            };
            let workers = [of(0), of(1), of(2)];
            let balances =
                Sunlight::new(spacecraft).and_then(|mut sunlight| balance::find(&mut sunlight, requested));
            (workers.map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic))), balances)
        });
        let [x, y, z] = lines;
        Ok(Self { grid, lines: [x?, y?, z?], balances: balances? })
    }
}
