//! A command that loads an FMU's library, in a process of its own: this one shows what that one has to show.

use std::{
    io::{self, Write},
    sync::{Arc, Mutex, PoisonError},
};

use files::{
    Scratch,
    outcome::{Answer, Outcome},
};
use terminal::Relay;

use super::{
    channel::Link,
    frame::{Frame, NOT_REQUESTED, Request},
    limits::ResourceLimits,
    printed::Shown,
    supervisor::{Bounds, ChildProcess},
};

/// Bytes of the standard output in one frame.
const AT_ONCE: usize = 1 << 20;

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
    /// Hands a request to a child and gives its answer or the error it failed with; a child that ends otherwise is an error with
    /// the call it was in.
    pub fn run(&self, request: Request) -> Outcome {
        // What the child leaves when it is ended goes with this folder.
        let scratch = Scratch::new()?;
        let child = ChildProcess::new(request, self.limits, Some(scratch.path()))?;
        let mut ended: Option<Result<Answer, String>> = None;
        let mut shown = Shown::new(&self.name);
        let supervised = child.supervise(
            self.bounds,
            &mut |frame| {
                if ended.is_some() {
                    return Err(NOT_REQUESTED.to_owned());
                }
                ended = take(frame)?;
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

/// Shows a frame; the answer or the failure with the last one.
fn take(frame: Frame<'_>) -> Result<Option<Result<Answer, String>>, String> {
    match frame {
        Frame::Output(bytes) => {
            match terminal::Output.write_all(bytes).and_then(|()| terminal::Output.flush()) {
                Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                    return Err(format!("standard output: {error}"));
                }
                _ => {}
            }
        }
        Frame::Note(text) => terminal::note(text),
        Frame::Bar(text) => terminal::show_bar(text),
        Frame::Done(answer) => return Ok(Some(Ok(answer))),
        Frame::Failed(why) => return Ok(Some(Err(why.into_owned()))),
        _ => return Err(NOT_REQUESTED.to_owned()),
    }
    Ok(None)
}

impl Link {
    /// Performs a task and sends what it ends with, its failure too; nothing where the parent is to see that it did not end.
    pub fn answer<'a>(
        mut self,
        task: impl FnOnce(&mut Self) -> Result<Option<Frame<'a>>, Box<dyn std::error::Error>>,
    ) -> Outcome {
        let last = task(&mut self).unwrap_or_else(|error| Some(failed(error.as_ref())));
        last.map_or(Ok(()), |last| self.send(&last))?;
        // The parent has the answer; how this process ends tells whether the library let it.
        Ok(Answer::Yes)
    }

    /// Carries out a command for the parent, which shows everything on its screen.
    pub fn relay(self, command: impl FnOnce() -> Outcome) -> Outcome {
        let screen = self.screen;
        let link = Arc::new(Mutex::new(self));
        terminal::relay_to(Box::new(ToParent(Arc::clone(&link))), screen);
        let last = command().map_or_else(|error| failed(error.as_ref()), Frame::Done);
        link.lock().unwrap_or_else(PoisonError::into_inner).send(&last)?;
        Ok(Answer::Yes)
    }
}

fn failed(error: &dyn std::error::Error) -> Frame<'static> {
    Frame::Failed(fmi::Error::chain(error).into())
}

/// Hands everything that is shown to the parent.
struct ToParent(Arc<Mutex<Link>>);

impl ToParent {
    fn send(&self, frame: &Frame<'_>) -> io::Result<()> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).send(frame).map_err(io::Error::other)
    }
}

impl Relay for ToParent {
    fn output(&self, bytes: &[u8]) -> io::Result<()> {
        bytes.chunks(AT_ONCE).try_for_each(|chunk| self.send(&Frame::Output(chunk)))
    }

    fn note(&self, text: &str) {
        // Nobody there to read it is no error.
        let _ = self.send(&Frame::Note(text));
    }

    fn bar(&self, text: &str) -> io::Result<()> {
        self.send(&Frame::Bar(text))
    }
}
