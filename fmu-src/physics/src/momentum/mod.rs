//! What the torques add up to: system momentum, delta-v, thruster dumps.
//!
//! A stretch of flight is cut into *cells* on which everything is smooth: a cell ends at the next multiple of the
//! grid step, at an event (the attitude law changes form, an edge of the shadow), or where a thruster dump falls. Inside a cell the totals are a
//! polynomial in time, so any communication point merely evaluates it, and how a master cuts its steps cannot
//! change a bit.

mod accumulator;
mod cell;
mod dump;
mod wheels;

pub use accumulator::{Accumulator, Convention, Dumps, Event, Settings, TooManyDumps};
pub use cell::{Effort, EventValues, Flight, Sample, Totals, after_event_s};
pub use dump::{DumpPolicy, Reinitialise};
pub use wheels::WheelArray;
