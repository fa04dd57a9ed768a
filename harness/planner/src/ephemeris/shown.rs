//! A source whose work is shown by a bar and ended by Ctrl-C.

use isolation::interrupt;
use physics::{
    bodies::Body,
    environment::{CartesianState, onboard::OnboardTarget},
};

use crate::ephemeris::{Failure, Source};

/// A source with its bar, unless that is hidden.
pub(super) struct Shown {
    pub source: Box<dyn Source>,
    pub is_quiet: bool,
}

impl Source for Shown {
    fn center(&self) -> Body {
        self.source.center()
    }

    fn title(&self) -> String {
        self.source.title()
    }

    fn states(
        &self,
        targets: &[OnboardTarget],
        epochs_s: &[f64],
        reported: &mut dyn FnMut() -> Result<(), Failure>,
    ) -> Result<Vec<Vec<CartesianState>>, Failure> {
        let named: Vec<String> = targets.iter().map(ToString::to_string).collect();
        let unit = format!("epochs of {}", named.join(", "));
        let bar = terminal::progress(epochs_s.len() as u64, &unit, self.is_quiet);
        let states = self.source.states(targets, epochs_s, &mut || {
            bar.inc(1);
            if interrupt::raised() { Err("interrupted".into()) } else { reported() }
        });
        bar.finish_and_clear();
        states
    }
}
