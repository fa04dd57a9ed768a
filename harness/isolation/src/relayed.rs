//! A command that loads an FMU's library, in a process of its own: this one shows what that one has to show.

use std::{
    ffi::OsString,
    io::{self, Write},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

use files::{
    Scratch,
    outcome::{Answer, Outcome},
};
use terminal::{Relay, Screen};

use super::{
    channel::{Link, NOT_REQUESTED, Payload, push_bytes, push_text},
    limits::ResourceLimits,
    printed::Shown,
    supervisor::{Bounds, ChildProcess},
};

/// Kinds of frames: bytes of the standard output, a note, a progress bar, the end of the command, its failure.
const OUTPUT: u8 = 1;
const NOTE: u8 = 2;
const BAR: u8 = 3;
const ENDED: u8 = 4;
const FAILED: u8 = 5;

/// Bytes of the standard output in one frame.
const AT_ONCE: usize = 1 << 20;

/// Whether this process is such a child.
static IS_CHILD: AtomicBool = AtomicBool::new(false);

/// Whether this process was started to load libraries.
pub fn is_child() -> bool {
    IS_CHILD.load(Ordering::Relaxed)
}

/// A command and what its process may take.
pub struct Relayed {
    /// File that loads the library, as the user named it.
    pub name: String,
    /// Bounds at which it is ended.
    pub bounds: Bounds,
    /// Resources that its process may use.
    pub limits: ResourceLimits,
}

impl Relayed {
    /// Runs this program with these arguments in a child and gives its exit status or the error it failed with; a child that
    /// ends otherwise is an error with the call it was in.
    pub fn run(&self, arguments: impl IntoIterator<Item = OsString>) -> Outcome {
        // What the child leaves when it is ended goes with this folder.
        let scratch = Scratch::new()?;
        let Screen { output_columns, note_columns } = terminal::screen();
        let columns = |name: &str, columns: Option<u16>| {
            columns.map(|columns| OsString::from(format!("--{name}-columns={columns}")))
        };
        let own = [Some("in-child".into()), columns("output", output_columns), columns("note", note_columns)];
        let own = own.into_iter().flatten().chain([OsString::from("--")]);
        let child = ChildProcess::new(own.chain(arguments), self.limits, Some(scratch.path()))
            .map_err(|error| format!("the process of the FMU cannot be started: {error}"))?;
        let mut ended: Option<Result<Answer, String>> = None;
        let mut shown = Shown::new(&self.name);
        let supervised = child.supervise(
            self.bounds,
            &mut |kind, payload| {
                if ended.is_some() {
                    return Err(NOT_REQUESTED.to_owned());
                }
                ended = take(kind, payload)?;
                Ok(ended.is_some())
            },
            &mut |line| shown.line(line),
            &mut |_| Ok(()),
        );
        if let Some(left) = supervised.left_behind() {
            terminal::note(&format!("{}: {left}", self.name));
        }
        match (ended, supervised.fault()) {
            (Some(Err(why)), _) => Err(why.into()),
            (Some(Ok(answer)), None) => Ok(answer),
            (_, fault) => {
                let what = fault.unwrap_or_else(|| supervised.without_result());
                Err(format!("{}: {what}", self.name).into())
            }
        }
    }
}

/// Shows a frame; the exit status or the failure with the last one.
fn take(kind: u8, mut payload: Payload<'_>) -> Result<Option<Result<Answer, String>>, String> {
    match kind {
        OUTPUT => {
            let bytes = payload.bytes().ok_or(NOT_REQUESTED)?;
            match terminal::Output.write_all(&bytes).and_then(|()| terminal::Output.flush()) {
                Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                    return Err(format!("standard output: {error}"));
                }
                _ => {}
            }
        }
        NOTE => terminal::note(&payload.text().ok_or(NOT_REQUESTED)?),
        BAR => terminal::show_bar(&payload.text().ok_or(NOT_REQUESTED)?),
        ENDED => {
            let status = payload.word().and_then(|status| u8::try_from(status).ok());
            return Ok(Some(Ok(status.and_then(Answer::of_status).ok_or(NOT_REQUESTED)?)));
        }
        FAILED => return Ok(Some(Err(payload.text().ok_or(NOT_REQUESTED)?))),
        _ => return Err(NOT_REQUESTED.to_owned()),
    }
    Ok(None)
}

/// Carries out a command in this process for the parent that started it, which shows everything on its screen.
pub fn serve(screen: Screen, command: impl FnOnce() -> Outcome) -> Outcome {
    let link = Arc::new(Mutex::new(Link::attach("heliotorque")?));
    IS_CHILD.store(true, Ordering::Relaxed);
    terminal::relay_to(Box::new(ToParent(Arc::clone(&link))), screen);
    let outcome = command();
    let mut link = link.lock().unwrap_or_else(PoisonError::into_inner);
    match outcome {
        Ok(answer) => link.send(ENDED, |payload| payload.push(answer as u64))?,
        Err(error) => {
            let text = fmi::Error::chain(error.as_ref());
            link.send(FAILED, |payload| push_text(payload, &text))?;
        }
    }
    // The parent has the status; how this process ends tells whether the library let it.
    Ok(Answer::Yes)
}

/// Hands everything that is shown to the parent.
struct ToParent(Arc<Mutex<Link>>);

impl ToParent {
    fn send(&self, kind: u8, payload: impl FnOnce(&mut Vec<u64>)) -> io::Result<()> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).send(kind, payload).map_err(io::Error::other)
    }
}

impl Relay for ToParent {
    fn output(&self, bytes: &[u8]) -> io::Result<()> {
        bytes.chunks(AT_ONCE).try_for_each(|chunk| self.send(OUTPUT, |payload| push_bytes(payload, chunk)))
    }

    fn note(&self, text: &str) {
        // Nobody there to read it is no error.
        let _ = self.send(NOTE, |payload| push_text(payload, text));
    }

    fn bar(&self, text: &str) -> io::Result<()> {
        self.send(BAR, |payload| push_text(payload, text))
    }
}
