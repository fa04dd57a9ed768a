//! Control: `MomentumPlant` with its own controller, alone and in a loop with `Guidance`.
//!
//! Large slews, saturation and a failed wheel; the safe modes of paper 001; the estimated curves of its Figures 7 and 8.

mod cosimulation;
mod slew;
mod slew_figures;
mod slew_flight;

pub use slew::slew;
