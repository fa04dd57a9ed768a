//! What an ephemeris is fitted to: states of bodies and of the spacecraft about a centre.

use physics::{
    bodies::Body,
    environment::{CartesianState, dates, onboard::OnboardTarget},
};

use crate::Failure;

/// The UTC date of an epoch in s past J2000 TDB; `None` where UTC has no leap seconds yet.
pub fn utc_date(epoch_s: f64) -> Option<String> {
    let date = dates::utc(epoch_s);
    dates::epoch_s(&date).is_ok_and(|read_s| (read_s - epoch_s).abs() <= 1e-3).then_some(date)
}

/// States over time in EME2000.
pub trait Source {
    /// From where positions count.
    fn center(&self) -> Body;

    /// What an ephemeris says of where it comes from.
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
