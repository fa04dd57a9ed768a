//! Unix: process groups, resource limits, signals.
//!
//! On Linux this process takes over what a child leaves behind, also in a session of its own (PR_SET_CHILD_SUBREAPER): once the
//! child has ended, its descendants are children of this process, which ends them one generation after the other.

use std::{
    fs::File,
    io::{self, Read},
    mem,
    os::{
        fd::{AsFd, OwnedFd},
        unix::process::{CommandExt, ExitStatusExt},
    },
    process::{Child, Command, ExitStatus},
    sync::{Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use rustix::process::{
    Pid, Resource, Rlimit, Signal, WaitId, WaitIdOptions, getrlimit, kill_process_group, setrlimit, waitid,
};

use crate::limits::ResourceLimits;

/// How long the end of what a child left behind is waited for.
const PATIENCE: Duration = Duration::from_millis(500);

/// Groups of children that run now.
static GROUPS: Mutex<Vec<u32>> = Mutex::new(Vec::new());

fn groups() -> MutexGuard<'static, Vec<u32>> {
    GROUPS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Starts a child as the first of a process group of its own; it takes its limits itself, by [`restrict`].
pub(crate) fn spawn(command: &mut Command, _limits: ResourceLimits) -> io::Result<Child> {
    command.process_group(0);
    // Held meanwhile, so that a signal finds every child.
    let mut groups = groups();
    orphans::adopt();
    let child = command.spawn()?;
    groups.push(child.id());
    Ok(child)
}

/// Ends a child with all that it started and takes its exit status; also gives the processes that it left behind.
pub(crate) fn end(child: &mut Child) -> io::Result<(ExitStatus, Vec<String>)> {
    let mut groups = groups();
    // It may have ended by itself. While it is not waited for, its number is nobody else's.
    let _ = child.kill();
    wait_for_end(child.id());
    groups.retain(|group| *group != child.id());
    let left = orphans::end(PATIENCE, |number| number == child.id() || groups.contains(&number));
    end_group(child.id());
    Ok((child.wait()?, left))
}

/// Ends every child with all that it started; the program ends next, and a thread that starts another one waits for that end.
pub fn end_all() {
    let mut groups = groups();
    let leaders = mem::take(&mut *groups);
    leaders.iter().for_each(|leader| end_group(*leader));
    // Processes that left a group become orphans when the leader has ended.
    leaders.iter().for_each(|leader| wait_for_end(*leader));
    if !leaders.is_empty() {
        orphans::end(PATIENCE, |_| false);
    }
    mem::forget(groups);
}

/// Waits until a child that was killed has ended, without taking its exit status.
fn wait_for_end(child: u32) {
    if let Some(pid) = i32::try_from(child).ok().and_then(Pid::from_raw) {
        let _ = waitid(WaitId::Pid(pid), WaitIdOptions::EXITED | WaitIdOptions::NOWAIT);
    }
}

/// Processes that lost their parent, a child of this one.
#[cfg(target_os = "linux")]
mod orphans {
    use std::{
        collections::BTreeMap,
        fs,
        sync::OnceLock,
        thread,
        time::{Duration, Instant},
    };

    use rustix::process::{Pid, Signal, WaitOptions, getpid, kill_process, set_child_subreaper, waitpid};

    /// Between two looks at the processes.
    const PAUSE: Duration = Duration::from_millis(1);

    /// Children that this process had before it started any: those of the shell that it took the place of.
    static FOREIGN: OnceLock<Vec<u32>> = OnceLock::new();

    /// From now on orphans become children of this process.
    pub(super) fn adopt() {
        FOREIGN.get_or_init(|| children().into_keys().collect());
        // Without it they end with their group.
        let _ = set_child_subreaper(Some(getpid()));
    }

    /// Ends orphans until there are none and gives them; children that `is_own` tells are left alone.
    pub(super) fn end(patience: Duration, is_own: impl Fn(u32) -> bool) -> Vec<String> {
        let began = Instant::now();
        let mut found = BTreeMap::new();
        let foreign = FOREIGN.get().map_or(&[][..], Vec::as_slice);
        loop {
            let orphans: Vec<(u32, String)> = children()
                .into_iter()
                .filter(|(number, _)| !is_own(*number) && !foreign.contains(number))
                .collect();
            if orphans.is_empty() || began.elapsed() > patience {
                break;
            }
            for (number, name) in orphans {
                if let Some(pid) = i32::try_from(number).ok().and_then(Pid::from_raw) {
                    let _ = kill_process(pid, Signal::KILL);
                    let _ = waitpid(Some(pid), WaitOptions::NOHANG);
                }
                found.entry(number).or_insert(name);
            }
            thread::sleep(PAUSE);
        }
        found.into_iter().map(|(number, name)| format!("{number} ({name})")).collect()
    }

    /// The children of this process that run, by number, with their names.
    fn children() -> BTreeMap<u32, String> {
        let own = getpid().as_raw_nonzero().get().to_string();
        let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
        let child = |number: u32| {
            let stat = fs::read(format!("/proc/{number}/stat")).ok()?;
            let stat = String::from_utf8_lossy(&stat);
            // `number (name) state parent ...`; a name may hold anything.
            let (head, tail) = stat.rsplit_once(')')?;
            let (_, name) = head.split_once('(')?;
            let mut tail = tail.split_ascii_whitespace();
            let runs = !matches!(tail.next()?, "Z" | "X");
            (runs && tail.next()? == own).then(|| (number, name.to_owned()))
        };
        entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok()).filter_map(child).collect()
    }
}

/// Elsewhere what a child leaves behind ends with its group.
#[cfg(not(target_os = "linux"))]
mod orphans {
    use std::time::Duration;

    pub fn adopt() {}

    pub fn end(_patience: Duration, _is_own: impl Fn(u32) -> bool) -> Vec<String> {
        Vec::new()
    }
}

fn end_group(leader: u32) {
    if let Some(group) = i32::try_from(leader).ok().and_then(Pid::from_raw) {
        // Nobody of the group may be left.
        let _ = kill_process_group(group, Signal::KILL);
    }
}

/// Whether a child has ended; its number stays its own until [`end`].
pub(crate) fn has_ended(child: &mut Child) -> io::Result<bool> {
    let Some(pid) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) else { return Ok(true) };
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    Ok(waitid(WaitId::Pid(pid), options)?.is_some())
}

/// Takes the file that is the standard input; there is nothing to read then.
pub(crate) fn take_stdin() -> io::Result<File> {
    let file = File::from(io::stdin().as_fd().try_clone_to_owned()?);
    rustix::stdio::dup2_stdin(File::open("/dev/null")?)?;
    Ok(file)
}

/// Ends this process when its parent ends, however that happens.
pub(crate) fn end_with_parent(parent: u32) -> io::Result<()> {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{getppid, set_parent_process_death_signal};
        set_parent_process_death_signal(Some(Signal::KILL))?;
        let now = getppid().map(|pid| pid.as_raw_nonzero().get());
        if now.and_then(|pid| u32::try_from(pid).ok()) != Some(parent) {
            return Err(io::Error::other("the parent has ended"));
        }
    }
    let _ = parent;
    Ok(())
}

/// Limits what this process may allocate, and how many files it may keep open.
pub(crate) fn restrict(limits: ResourceLimits) -> io::Result<()> {
    let is_lower =
        |(resource, limit): &(Resource, u64)| getrlimit(*resource).maximum.is_none_or(|bound| *limit < bound);
    let bounds =
        [limits.memory.map(|it| (Resource::Data, it)), limits.files.map(|it| (Resource::Nofile, it))];
    for (resource, limit) in bounds.into_iter().flatten().filter(is_lower) {
        setrlimit(resource, Rlimit { current: Some(limit), maximum: Some(limit) })?;
    }
    if limits.memory.is_some() {
        // What is expected to crash leaves no image of its memory.
        setrlimit(Resource::Core, Rlimit { current: Some(0), maximum: Some(0) })?;
    }
    Ok(())
}

/// Memory of a child; not measured, as resource limits bound it.
pub(crate) fn committed_bytes(_child: &Child) -> Option<u64> {
    None
}

/// Output stream of a child; reading does not block.
pub(crate) struct Pipe(File);

impl Pipe {
    /// Takes a stream of a child.
    pub(crate) fn new(stream: impl Into<OwnedFd>) -> io::Result<Self> {
        let pipe = File::from(stream.into());
        rustix::io::ioctl_fionbio(&pipe, true)?;
        Ok(Self(pipe))
    }
}

impl Read for Pipe {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer)
    }
}

/// Waits until one of the pipes has something to read or is closed, at most this long.
pub(crate) fn wait_for<'p>(pipes: impl Iterator<Item = &'p Pipe>, longest: Duration) {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    let mut pipes: Vec<_> = pipes.map(|pipe| PollFd::new(&pipe.0, PollFlags::IN)).collect();
    // A signal ends the wait early, which does no harm.
    let _ = poll(&mut pipes, Timespec::try_from(longest).ok().as_ref());
}

/// How a process ended, for people.
pub(crate) fn describe_exit(status: ExitStatus) -> String {
    if let Some(signal) = status.signal() {
        let name = match signal {
            4 => " (illegal instruction)",
            6 => " (abort)",
            7 | 10 => " (bus error)",
            8 => " (arithmetic)",
            9 => " (killed)",
            11 => " (segmentation fault)",
            _ => "",
        };
        return format!("signal {signal}{name}");
    }
    match status.code() {
        Some(code) => format!("it exited with status {code}"),
        None => status.to_string(),
    }
}

/// Whether a process was ended by a signal that others send.
pub(crate) fn is_from_outside(status: ExitStatus) -> bool {
    let signals = [Signal::HUP, Signal::INT, Signal::KILL, Signal::TERM];
    status.signal().is_some_and(|found| signals.iter().any(|signal| signal.as_raw() == found))
}

/// Memory that is available, in bytes, within the bound of the process's group where it has one; `None` where no system says.
pub(crate) fn available_bytes() -> Option<u64> {
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let of_host = std::fs::read_to_string("/proc/meminfo").ok().and_then(|text| {
        let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
        number(line.trim().strip_suffix("kB")?)?.checked_mul(1024)
    })?;
    let of_group = |file: &str| number(&std::fs::read_to_string(format!("/sys/fs/cgroup/{file}")).ok()?);
    let left =
        of_group("memory.max").map(|most| most.saturating_sub(of_group("memory.current").unwrap_or(0)));
    Some(left.map_or(of_host, |left| left.min(of_host)))
}
