//! Progress of a plan on the terminal: what is done, with the time since it began.

use std::{cell::RefCell, time::Instant};

/// Reports what is done, each once as long as it lasts.
pub(super) struct Progress {
    began: Instant,
    last: RefCell<String>,
    is_quiet: bool,
}

impl Progress {
    /// Begins to count the time.
    pub(super) fn begin(is_quiet: bool) -> Self {
        Self { began: Instant::now(), last: RefCell::default(), is_quiet }
    }

    /// Time since it began, in s.
    pub(super) fn elapsed_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Says what is being done.
    pub(super) fn say(&self, doing: &str) {
        if !self.is_quiet && *self.last.borrow() != doing {
            doing.clone_into(&mut self.last.borrow_mut());
            terminal::note(&format!("{:.1} s: {doing}", self.elapsed_s()));
        }
    }
}
