//! Ctrl-C and the other signals that request a program's end.

use std::{
    process,
    sync::atomic::{AtomicBool, Ordering},
};

use files::outcome::Answer;

static RAISED: AtomicBool = AtomicBool::new(false);

/// From now on SIGINT, SIGTERM and SIGHUP end the program, its children by `end_children`, and leave no temporary files. A
/// patient command is notified the first time only: see [`raised`].
pub fn listen(patient: bool, end_children: fn()) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(move || {
        if RAISED.swap(true, Ordering::Relaxed) || !patient {
            end_children();
            files::remove_temporaries();
            process::exit(Answer::Interrupted as i32);
        }
    })
}

/// Whether a signal came that requests the end of the command.
pub fn raised() -> bool {
    RAISED.load(Ordering::Relaxed)
}
