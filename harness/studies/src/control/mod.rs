//! Control: `MomentumPlant` with its own controller, alone and in a loop with `Guidance`.
//!
//! Burns with delta-V steering; large slews, saturation and a failed wheel; dumps by pulses; jitter of a flexible structure; the
//! safe modes of paper 001; the estimated curves of its Figures 7 and 8.

mod burn;
mod burn_flight;
mod dump;
mod guided_loop;
mod jitter;
mod jitter_flight;
mod jitter_theory;
mod safe_mode;
mod safe_mode_checks;
mod safe_mode_flight;
mod slew;
mod slew_figures;
mod slew_flight;
mod slew_limits;
mod spectrum;
mod transition;

pub(crate) use burn::burn;
pub(crate) use dump::dump;
pub(crate) use jitter::jitter;
pub(crate) use safe_mode::safe_mode;
pub(crate) use slew::slew;
pub(crate) use transition::transition;
