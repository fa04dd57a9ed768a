//! What only the operating system does: process groups, limits, ends of processes.

use std::{
    fs::File,
    io, mem,
    process::{Child, Command, ExitStatus},
    sync::{Mutex, MutexGuard, PoisonError},
};

/// Groups of children that run now.
static GROUPS: Mutex<Vec<u32>> = Mutex::new(Vec::new());

fn groups() -> MutexGuard<'static, Vec<u32>> {
    GROUPS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Starts a child as the first of a process group of its own.
pub fn spawn(command: &mut Command) -> io::Result<Child> {
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;
        command.process_group(0);
    }
    // Held meanwhile, so that a signal finds every child.
    let mut groups = groups();
    let child = command.spawn()?;
    groups.push(child.id());
    Ok(child)
}

/// Ends a child with its whole group and takes its exit status.
pub fn end(child: &mut Child) -> io::Result<ExitStatus> {
    let mut groups = groups();
    // While it is not waited for, its number is nobody else's.
    end_group(child.id());
    groups.retain(|group| *group != child.id());
    // It may have ended by itself.
    let _ = child.kill();
    child.wait()
}

/// Ends every child with its group; the program ends next, and whoever starts another one waits for that end.
pub fn end_all() {
    let mut groups = groups();
    for group in groups.drain(..) {
        end_group(group);
    }
    mem::forget(groups);
}

#[cfg(unix)]
fn end_group(leader: u32) {
    use rustix::process::{Pid, Signal, kill_process_group};
    if let Some(group) = i32::try_from(leader).ok().and_then(Pid::from_raw) {
        // Nobody of the group may be left.
        let _ = kill_process_group(group, Signal::KILL);
    }
}

#[cfg(not(unix))]
fn end_group(_leader: u32) {}

/// Whether a child has ended; its number stays its own until [`end`].
#[cfg(unix)]
pub fn has_ended(child: &mut Child) -> io::Result<bool> {
    use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
    let Some(pid) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) else { return Ok(true) };
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    Ok(waitid(WaitId::Pid(pid), options)?.is_some())
}

/// Whether a child has ended.
#[cfg(not(unix))]
pub fn has_ended(child: &mut Child) -> io::Result<bool> {
    Ok(child.try_wait()?.is_some())
}

/// Takes the file that is the standard input; there is nothing to read then.
pub fn take_stdin() -> io::Result<File> {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        let file = File::from(io::stdin().as_fd().try_clone_to_owned()?);
        rustix::stdio::dup2_stdin(File::open("/dev/null")?)?;
        Ok(file)
    }
    #[cfg(not(unix))]
    {
        use std::os::windows::io::AsHandle;
        Ok(File::from(io::stdin().as_handle().try_clone_to_owned()?))
    }
}

/// Ends this process when its parent ends, however that happens.
pub fn end_with_parent(parent: u64) -> io::Result<()> {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{Signal, getppid, set_parent_process_death_signal};
        set_parent_process_death_signal(Some(Signal::KILL))?;
        let now = getppid().map(|pid| pid.as_raw_nonzero().get());
        if now.and_then(|pid| u64::try_from(pid).ok()) != Some(parent) {
            return Err(io::Error::other("the parent has ended"));
        }
    }
    let _ = parent;
    Ok(())
}

/// Limits what this process may allocate, in bytes, and how many files it may keep open; 0 is no limit.
pub fn restrict(memory: u64, files: u64) -> io::Result<()> {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
        for (resource, limit) in [(Resource::Data, memory), (Resource::Nofile, files)] {
            let before = getrlimit(resource);
            let within = |bound: Option<u64>| bound.is_none_or(|bound| limit < bound);
            if limit > 0 && within(before.maximum) {
                setrlimit(resource, Rlimit { current: Some(limit), maximum: Some(limit) })?;
            }
        }
        if memory > 0 {
            // What is expected to crash leaves no image of its memory.
            setrlimit(Resource::Core, Rlimit { current: Some(0), maximum: Some(0) })?;
        }
    }
    let _ = (memory, files);
    Ok(())
}

/// Makes reading from a child's pipe return at once when there is nothing.
#[cfg(unix)]
pub fn never_wait(pipe: &impl std::os::fd::AsFd) -> io::Result<()> {
    Ok(rustix::io::ioctl_fionbio(pipe, true)?)
}

/// How a process ended, for people.
pub fn how(status: ExitStatus) -> String {
    #[cfg(unix)]
    {
        use std::os::unix::process::ExitStatusExt;
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
    }
    match status.code() {
        Some(code) => format!("it exited with status {code}"),
        None => status.to_string(),
    }
}
