//! Sources of a fit: states of bodies and of the spacecraft about a centre.

use isolation::interrupt;
use physics::{
    bodies::Body,
    environment::{CartesianState, onboard::OnboardTarget},
};

use crate::Failure;

/// States over time in EME2000.
pub trait Source {
    /// From where positions count.
    fn center(&self) -> Body;

    /// Title of the ephemeris, which names its origin.
    fn title(&self) -> String;

    /// Positions and velocities of each target from the centre at epochs that do not fall, in s past J2000 TDB; `reported` hears
    /// of each epoch and may end the work.
    ///
    /// # Errors
    /// What a source cannot place, and what `reported` gives.
    fn states(
        &self,
        targets: &[OnboardTarget],
        epochs_s: &[f64],
        reported: &mut dyn FnMut() -> Result<(), Failure>,
    ) -> Result<Vec<Vec<CartesianState>>, Failure>;
}

/// States of a source, with a bar unless that is hidden, until Ctrl-C.
pub(super) fn states(
    source: &dyn Source,
    targets: &[OnboardTarget],
    epochs_s: &[f64],
    is_quiet: bool,
) -> Result<Vec<Vec<CartesianState>>, Failure> {
    let named: Vec<String> = targets.iter().map(ToString::to_string).collect();
    let bar = terminal::progress(epochs_s.len() as u64, &format!("epochs of {}", named.join(", ")), is_quiet);
    let states = source.states(targets, epochs_s, &mut || {
        bar.inc(1);
        if interrupt::raised() { Err("interrupted".into()) } else { Ok(()) }
    });
    bar.finish_and_clear();
    states
}
