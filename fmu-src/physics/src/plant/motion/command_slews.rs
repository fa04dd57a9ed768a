//! Memory of the slews into a timeline's commands: of the present command and the one before it.

use serde::{Deserialize, Serialize};

use crate::guidance::constraints::command_slew::CommandSlew;

/// A slew and the beginning of its command, in s.
type Remembered = (f64, CommandSlew);

/// Slews into commands. Empty where commands are taken at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CommandSlews {
    /// The body stands in a command that began by then, in s.
    begun_s: f64,
    /// The last one first.
    last: [Option<Remembered>; 2],
}

impl CommandSlews {
    /// Slews of a flight, or a timeline, that begins at `time_s`.
    pub fn beginning(time_s: f64) -> Self {
        Self { begun_s: time_s, last: [None; 2] }
    }

    /// Whether the body slews into a command that begins then.
    pub fn lead_into(&self, since_s: f64) -> bool {
        since_s > self.begun_s
    }

    /// The slew into the command that began at `since_s`.
    pub fn find(&self, since_s: f64) -> Option<CommandSlew> {
        self.last.iter().flatten().find(|(own_s, _)| *own_s == since_s).map(|(_, slew)| *slew)
    }

    /// Keeps the slew into the command that begins at `since_s`.
    pub fn keep(&mut self, since_s: f64, slew: CommandSlew) {
        if let Some((_, known)) = self.last.iter_mut().flatten().find(|(own_s, _)| *own_s == since_s) {
            *known = slew;
        } else {
            self.last = [Some((since_s, slew)), self.last[0]];
        }
    }

    /// Forgets slews that begin later than `time_s`: something changes there.
    pub fn forget_after(&mut self, time_s: f64) {
        if matches!(&self.last[0], Some((_, slew)) if slew.begin_s > time_s) {
            self.last = [self.last[1], None];
        }
    }

    /// The same, and a slew that begins at `time_s` goes another way from the same attitude.
    pub fn cut(&mut self, time_s: f64) {
        self.forget_after(time_s);
        if let Some((_, slew)) = self.last[0].as_mut().filter(|(_, slew)| slew.begin_s == time_s) {
            slew.reopen();
        }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.last.iter().flatten().all(|(_, slew)| slew.is_valid())
    }
}
