//! Starts a child and supervises it until it ends, or ends it.

use std::{
    io,
    path::Path,
    process::{Child, Command, ExitStatus, Stdio},
    time::{Duration, Instant},
};

use fmi::{CallRecord, RecordedCalls};

use super::{
    channel::{Inbox, RING_WORDS},
    frame::{CHILD, Frame, Request},
    limits::ResourceLimits,
    printed::Printed,
    system,
};
use crate::interrupt;

/// Shortest and longest pause between two readings of the child; short while many words come. Output and exit of the child end a pause
/// early; frames, cancellation and timeouts wait for its end.
const PAUSES: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(25)];
/// Number of words from which on a read is large.
const MANY: usize = RING_WORDS / 8;
/// How long a child that has reported its end may take to exit.
const GRACE: Duration = Duration::from_secs(2);
/// How long a child that was requested to end may take: who presses Ctrl-C waits less than a second.
const CANCEL_GRACE: Duration = Duration::from_millis(500);

/// Bounds at which the parent ends the child.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bounds {
    /// When the child has to have ended, and the whole time until then, in s.
    pub deadline: Option<(Instant, f64)>,
    /// Time that one FMI call may take, in s.
    pub call_s: Option<f64>,
    /// Bytes that it may print.
    pub printed: Option<u64>,
}

impl Bounds {
    /// Bounds of FMI calls alone: the longest time that one may take, in s.
    pub fn of_calls(call_s: f64) -> Self {
        Self { call_s: Some(call_s), ..Self::default() }
    }
}

/// How a child came to its end.
#[derive(Debug)]
pub enum EndReason {
    /// By itself.
    Ended(ExitStatus),
    /// The child ran when the whole time was over, in s.
    Hangs(f64),
    /// A call took longer than it may, in s.
    CallHangs(f64),
    /// The child reported its end and continued.
    DoesNotExit,
    /// The child printed more bytes than allowed.
    Prints(u64),
    /// The child exceeded its memory limit, in bytes.
    Allocates(u64),
    /// The child was requested to end.
    Interrupted,
    /// A message of the child could not be taken.
    Refused(String),
}

impl EndReason {
    /// Whether somebody else ended it: a user, a batch system, a host without memory.
    pub fn is_from_outside(&self) -> bool {
        matches!(self, Self::Ended(status) if system::is_from_outside(*status))
    }
}

/// A child that was supervised to its end.
#[derive(Debug)]
pub struct Supervised {
    /// How it ended.
    pub end_reason: EndReason,
    /// The call it was in.
    pub calls: RecordedCalls,
    /// The last lines it printed, each after a line break.
    pub printed: String,
    /// The processes that it left behind, which were ended.
    pub left: Vec<String>,
}

/// Processes that are named at most.
const NAMED: usize = 5;

impl Supervised {
    /// Why it is no good end, with the call it came in; `None` for a good one.
    pub fn fault(&self) -> Option<String> {
        let what = match &self.end_reason {
            EndReason::Ended(status) if status.success() => return None,
            end_reason => describe(end_reason),
        };
        Some(self.placed(&what))
    }

    /// Returns the message that it ended without a result.
    pub fn without_result(&self) -> String {
        self.placed(&describe(&self.end_reason))
    }

    /// Returns the processes that it left behind, if any.
    pub fn left_behind(&self) -> Option<String> {
        let named = self.left.iter().take(NAMED).map(String::as_str).collect::<Vec<_>>().join(", ");
        let more = self.left.len().checked_sub(NAMED).filter(|more| *more > 0);
        let more = more.map_or_else(String::new, |more| format!(" and {more} more"));
        (!self.left.is_empty()).then(|| format!("left processes behind, which were ended: {named}{more}"))
    }

    fn placed(&self, what: &str) -> String {
        let printed = &self.printed;
        match (&self.calls.in_progress, &self.calls.last) {
            (Some(call), _) => format!("{call}: {what}{printed}"),
            (None, Some(call)) => format!("{what}, after {call} had returned{printed}"),
            (None, None) => format!("{what}, before any call{printed}"),
        }
    }
}

fn describe(end_reason: &EndReason) -> String {
    match end_reason {
        EndReason::Ended(status) => format!("the process ended: {}", system::describe_exit(*status)),
        EndReason::Hangs(time_s) => format!("hangs: still busy after {time_s} s in all (see --timeout)"),
        EndReason::CallHangs(time_s) => {
            format!("hangs: the call did not return within {time_s} s (see --timeout)")
        }
        EndReason::DoesNotExit => "its process does not exit".to_owned(),
        EndReason::Prints(bytes) => format!("prints without end: more than {} MiB", bytes >> 20),
        EndReason::Allocates(bytes) => format!("allocates without end: more than {} MiB", bytes >> 20),
        EndReason::Interrupted => "interrupted".to_owned(),
        EndReason::Refused(why) => why.clone(),
    }
}

/// A child that runs.
pub struct ChildProcess {
    child: Child,
    inbox: Inbox,
    printed: Printed,
    memory: Option<u64>,
}

impl ChildProcess {
    /// Starts this program with a request, its temporary files in a folder of their own if one is given.
    ///
    /// # Errors
    /// A process that cannot be started, as the message says.
    pub fn new(request: Request, limits: ResourceLimits, temporary: Option<&Path>) -> Result<Self, String> {
        Self::start(request, limits, temporary)
            .map_err(|error| format!("the process of the FMU cannot be started: {error}"))
    }

    fn start(request: Request, limits: ResourceLimits, temporary: Option<&Path>) -> io::Result<Self> {
        let (file, inbox) = Inbox::create(request, limits)?;
        let mut command = Command::new(std::env::current_exe()?);
        command.arg(CHILD).stdin(file).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
            .envs(temporary.iter().flat_map(|folder| ["TMPDIR", "TMP", "TEMP"].map(|name| (name, folder))));
        let mut child = system::spawn(&mut command, limits)?;
        match Printed::from_child(&mut child) {
            Ok(printed) => Ok(Self { child, inbox, printed, memory: limits.memory }),
            Err(error) => {
                let _ = system::end(&mut child)?;
                Err(error)
            }
        }
    }

    /// Supervises it to its end. `take` gets every frame and returns whether it was the last one, `line` every line that
    /// is printed; `tick` is called between.
    pub fn supervise(
        mut self,
        bounds: Bounds,
        take: &mut dyn FnMut(Frame<'_>) -> Result<bool, String>,
        line: &mut dyn FnMut(&str),
        tick: &mut dyn FnMut(Option<&CallRecord>) -> Result<(), String>,
    ) -> Supervised {
        let end_reason = self.follow(bounds, take, line, tick);
        let calls = self.inbox.calls().map(fmi::recorded_calls).unwrap_or_default();
        let status = system::end(&mut self.child);
        self.printed.finish(line);
        let (end_reason, left) = match (end_reason, status) {
            (end_reason, Ok((status, left))) => (end_reason.unwrap_or(EndReason::Ended(status)), left),
            (Some(end_reason), Err(_)) => (end_reason, Vec::new()),
            (None, Err(error)) => {
                (EndReason::Refused(format!("the process cannot be waited for: {error}")), Vec::new())
            }
        };
        Supervised { end_reason, calls, printed: self.printed.last(), left }
    }

    /// Until it ended by itself (`None`) or has to be ended.
    fn follow(
        &mut self,
        bounds: Bounds,
        take: &mut dyn FnMut(Frame<'_>) -> Result<bool, String>,
        line: &mut dyn FnMut(&str),
        tick: &mut dyn FnMut(Option<&CallRecord>) -> Result<(), String>,
    ) -> Option<EndReason> {
        let (mut call, mut call_began) = (None, Instant::now());
        let (mut finished, mut cancelled) = (None::<Instant>, None::<Instant>);
        let [often, seldom] = PAUSES;
        let mut pause = often;
        loop {
            // Before its frames are taken: what it sent until its end is then complete.
            let ended = system::has_ended(&mut self.child).unwrap_or(true);
            let mut is_last = false;
            let came = self.inbox.drain(&mut |frame| {
                is_last |= take(frame)?;
                Ok(())
            });
            let came = match came {
                Ok(came) => came,
                Err(why) => return Some(EndReason::Refused(why)),
            };
            if let Err(why) = tick(self.inbox.calls()) {
                return Some(EndReason::Refused(why));
            }
            let printed = self.printed.read(line);
            if ended {
                return None;
            }
            if let Some(allowed) = bounds.printed.filter(|allowed| self.printed.bytes() > *allowed) {
                return Some(EndReason::Prints(allowed));
            }
            if let Some(allowed) =
                self.memory.filter(|allowed| system::committed_bytes(&self.child) > Some(*allowed))
            {
                return Some(EndReason::Allocates(allowed));
            }
            let now = Instant::now();
            // The call under way and its number.
            let in_progress = self.inbox.calls().and_then(fmi::call_in_progress);
            if in_progress != call {
                (call, call_began) = (in_progress, now);
            }
            if let Some((_, time_s)) = bounds.deadline.filter(|(deadline, _)| now > *deadline) {
                return Some(EndReason::Hangs(time_s));
            }
            let is_over = |from: Instant, time_s: &f64| (now - from).as_secs_f64() > *time_s;
            let in_call = call.is_some();
            if let Some(time_s) = bounds.call_s.filter(|time_s| in_call && is_over(call_began, time_s)) {
                return Some(EndReason::CallHangs(time_s));
            }
            if is_last {
                finished = Some(now);
            }
            if finished.is_some_and(|from| now - from > GRACE) {
                return Some(EndReason::DoesNotExit);
            }
            if interrupt::raised() && cancelled.is_none() {
                self.inbox.cancel();
                cancelled = Some(now);
            }
            if cancelled.is_some_and(|from| now - from > CANCEL_GRACE) {
                return Some(EndReason::Interrupted);
            }
            if printed {
                // More output, or the exit of the process, usually follows at once.
                std::thread::sleep(often);
            } else {
                self.printed.wait(pause);
            }
            pause = if came > MANY || printed { (pause / 2).max(often) } else { (pause * 2).min(seldom) };
        }
    }
}
