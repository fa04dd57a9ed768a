//! Windows: a Job Object for each child (Win32: Job Objects, Toolhelp, anonymous pipes).
//!
//! The child is started suspended and put into its job before its first instruction, so that the job holds the child and all
//! that it starts; none of them may leave it. The job bounds their memory. This process has the job's only handle: with it, however this process
//! ends, every process of the job ends (KILL_ON_JOB_CLOSE).
#![allow(
    unsafe_code,
    reason = "calls Win32, each function with handles that are open and buffers of the size given"
)]

use std::{
    fs::File,
    io::{self, Read},
    mem,
    os::windows::{
        io::{AsHandle, AsRawHandle, FromRawHandle, IntoRawHandle, OwnedHandle},
        process::CommandExt,
    },
    process::{Child, Command, ExitStatus},
    ptr,
    sync::{Mutex, MutexGuard, PoisonError},
    thread,
    time::{Duration, Instant},
};

use windows_sys::Win32::{
    Foundation::{ERROR_BROKEN_PIPE, FALSE, HANDLE, INVALID_HANDLE_VALUE},
    System::{
        Console::{STD_INPUT_HANDLE, SetStdHandle},
        Diagnostics::{
            Debug::{SEM_FAILCRITICALERRORS, SEM_NOGPFAULTERRORBOX, SEM_NOOPENFILEERRORBOX, SetErrorMode},
            ToolHelp::{
                CreateToolhelp32Snapshot, PROCESSENTRY32W, Process32FirstW, Process32NextW,
                TH32CS_SNAPPROCESS, TH32CS_SNAPTHREAD, THREADENTRY32, Thread32First, Thread32Next,
            },
        },
        JobObjects::{
            AssignProcessToJobObject, CreateJobObjectW, JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION,
            JOB_OBJECT_LIMIT_JOB_MEMORY, JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE, JOBOBJECT_BASIC_PROCESS_ID_LIST,
            JOBOBJECT_EXTENDED_LIMIT_INFORMATION, JobObjectBasicProcessIdList,
            JobObjectExtendedLimitInformation, QueryInformationJobObject, SetInformationJobObject,
            TerminateJobObject,
        },
        Pipes::PeekNamedPipe,
        ProcessStatus::{K32GetProcessMemoryInfo, PROCESS_MEMORY_COUNTERS},
        Threading::{
            CREATE_NEW_PROCESS_GROUP, CREATE_SUSPENDED, OpenThread, ResumeThread, THREAD_SUSPEND_RESUME,
        },
    },
};

use crate::limits::ResourceLimits;

/// How long the end of what a child left behind is waited for, and the time between two looks.
const PATIENCE: Duration = Duration::from_millis(500);
const PAUSE: Duration = Duration::from_millis(1);
/// Processes of a job that are looked at.
const MEMBERS: usize = 256;
/// The exit status of what is ended.
const ENDED: u32 = 1;

/// Jobs of children that run now, by the number of the child.
static JOBS: Mutex<Vec<(u32, Job)>> = Mutex::new(Vec::new());

fn jobs() -> MutexGuard<'static, Vec<(u32, Job)>> {
    JOBS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The answer of a function that gives 0 for a failure.
fn succeeded(answer: i32) -> io::Result<()> {
    if answer == FALSE { Err(io::Error::last_os_error()) } else { Ok(()) }
}

/// The handle of a function that gives none, or -1, for a failure.
fn owned(handle: HANDLE) -> io::Result<OwnedHandle> {
    if handle.is_null() || handle == INVALID_HANDLE_VALUE {
        return Err(io::Error::last_os_error());
    }
    // SAFETY: the handle is open and nobody else's.
    Ok(unsafe { OwnedHandle::from_raw_handle(handle) })
}

/// `size_of` as Win32 takes it.
fn size<T>() -> u32 {
    size_of::<T>() as u32
}

/// A Job Object.
struct Job(OwnedHandle);

impl Job {
    /// One that ends with its handle and bounds what all its processes may allocate, in bytes.
    fn new(memory: Option<u64>) -> io::Result<Self> {
        // SAFETY: no attributes, no name.
        let job = Self(owned(unsafe { CreateJobObjectW(ptr::null(), ptr::null()) })?);
        let mut limits = JOBOBJECT_EXTENDED_LIMIT_INFORMATION::default();
        limits.BasicLimitInformation.LimitFlags =
            JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
        if let Some(bytes) = memory {
            limits.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_JOB_MEMORY;
            limits.JobMemoryLimit = usize::try_from(bytes).unwrap_or(usize::MAX);
        }
        let size = size::<JOBOBJECT_EXTENDED_LIMIT_INFORMATION>();
        // SAFETY: a structure of this class and size.
        succeeded(unsafe {
            SetInformationJobObject(
                job.0.as_raw_handle(),
                JobObjectExtendedLimitInformation,
                (&raw const limits).cast(),
                size,
            )
        })?;
        Ok(job)
    }

    fn assign(&self, child: &Child) -> io::Result<()> {
        // SAFETY: both handles are open.
        succeeded(unsafe { AssignProcessToJobObject(self.0.as_raw_handle(), child.as_raw_handle()) })
    }

    /// Its processes that run, by number.
    fn members(&self) -> Vec<u32> {
        #[repr(C)]
        struct List {
            head: JOBOBJECT_BASIC_PROCESS_ID_LIST,
            _more: [usize; MEMBERS - 1],
        }
        let mut list = List { head: JOBOBJECT_BASIC_PROCESS_ID_LIST::default(), _more: [0; MEMBERS - 1] };
        // SAFETY: the list, whose numbers continue behind its head, is of this size. Of a longer one the first numbers are given.
        unsafe {
            QueryInformationJobObject(
                self.0.as_raw_handle(),
                JobObjectBasicProcessIdList,
                (&raw mut list).cast(),
                size::<List>(),
                ptr::null_mut(),
            );
        }
        let count = (list.head.NumberOfProcessIdsInList as usize).min(MEMBERS);
        let first = (&raw const list.head.ProcessIdList).cast::<usize>();
        // SAFETY: so many numbers stand there, within the list.
        (0..count).map(|index| unsafe { first.wrapping_add(index).read() } as u32).collect()
    }

    /// Ends its processes and gives those that ran, each with its name.
    fn end(&self) -> Vec<String> {
        let members = self.members();
        let names = if members.is_empty() { Vec::new() } else { names(&members) };
        // SAFETY: the handle is open.
        unsafe { TerminateJobObject(self.0.as_raw_handle(), ENDED) };
        let began = Instant::now();
        while !self.members().is_empty() && began.elapsed() < PATIENCE {
            thread::sleep(PAUSE);
        }
        names
    }
}

/// Processes by number, as `number (name)`.
fn names(numbers: &[u32]) -> Vec<String> {
    // SAFETY: of the whole system.
    let Ok(processes) = owned(unsafe { CreateToolhelp32Snapshot(TH32CS_SNAPPROCESS, 0) }) else {
        return numbers.iter().map(u32::to_string).collect();
    };
    let mut entry = PROCESSENTRY32W { dwSize: size::<PROCESSENTRY32W>(), ..Default::default() };
    let mut found = Vec::new();
    // SAFETY: the snapshot is open, the entry says its size.
    let mut more = unsafe { Process32FirstW(processes.as_raw_handle(), &raw mut entry) };
    while more != FALSE {
        if numbers.contains(&entry.th32ProcessID) {
            let name = entry.szExeFile.split(|unit| *unit == 0).next().unwrap_or_default();
            found.push(format!("{} ({})", entry.th32ProcessID, String::from_utf16_lossy(name)));
        }
        // SAFETY: as before.
        more = unsafe { Process32NextW(processes.as_raw_handle(), &raw mut entry) };
    }
    found
}

/// Lets the threads of a process that was started suspended run.
fn resume(process: u32) -> io::Result<()> {
    // SAFETY: of the whole system.
    let threads = owned(unsafe { CreateToolhelp32Snapshot(TH32CS_SNAPTHREAD, 0) })?;
    let mut entry = THREADENTRY32 { dwSize: size::<THREADENTRY32>(), ..Default::default() };
    // SAFETY: the snapshot is open, the entry says its size.
    let mut more = unsafe { Thread32First(threads.as_raw_handle(), &raw mut entry) };
    while more != FALSE {
        if entry.th32OwnerProcessID == process {
            // SAFETY: a thread of the child, which waits.
            let thread = owned(unsafe { OpenThread(THREAD_SUSPEND_RESUME, FALSE, entry.th32ThreadID) })?;
            // SAFETY: the handle is open.
            if unsafe { ResumeThread(thread.as_raw_handle()) } == u32::MAX {
                return Err(io::Error::last_os_error());
            }
        }
        // SAFETY: as before.
        more = unsafe { Thread32Next(threads.as_raw_handle(), &raw mut entry) };
    }
    Ok(())
}

/// Starts a child in a job of its own, which bounds its memory. Its process group keeps the console's Ctrl-C from it.
pub(crate) fn spawn(command: &mut Command, limits: ResourceLimits) -> io::Result<Child> {
    let job = Job::new(limits.memory)?;
    command.creation_flags(CREATE_NEW_PROCESS_GROUP | CREATE_SUSPENDED);
    // Held meanwhile, so that a signal finds every child.
    let mut jobs = jobs();
    let mut child = command.spawn()?;
    if let Err(error) = job.assign(&child).and_then(|()| resume(child.id())) {
        let _ = child.kill();
        return Err(error);
    }
    jobs.push((child.id(), job));
    Ok(child)
}

/// Ends a child with all that it started and takes its exit status; also gives the processes that it left behind.
pub(crate) fn end(child: &mut Child) -> io::Result<(ExitStatus, Vec<String>)> {
    let mut jobs = jobs();
    // It may have ended by itself. While its handle is open, its number is nobody else's.
    let _ = child.kill();
    let status = child.wait()?;
    let own = jobs.iter().position(|(number, _)| *number == child.id());
    let left = own.map(|index| jobs.swap_remove(index).1.end()).unwrap_or_default();
    Ok((status, left))
}

/// Ends every child with all that it started; the program ends next, and a thread that starts another one waits for that end.
pub fn end_all() {
    let mut jobs = jobs();
    jobs.drain(..).for_each(|(_, job)| drop(job.end()));
    mem::forget(jobs);
}

/// Whether a child has ended; its number stays its own until the child is dropped.
pub(crate) fn has_ended(child: &mut Child) -> io::Result<bool> {
    Ok(child.try_wait()?.is_some())
}

/// Takes the file that is the standard input; there is nothing to read then.
pub(crate) fn take_stdin() -> io::Result<File> {
    let file = File::from(io::stdin().as_handle().try_clone_to_owned()?);
    let nothing = File::open("NUL")?.into_raw_handle();
    // SAFETY: the handle stays open for the life of the process.
    succeeded(unsafe { SetStdHandle(STD_INPUT_HANDLE, nothing) })?;
    Ok(file)
}

/// This process ends with its parent, which has the only handle of its job.
pub(crate) fn end_with_parent(_parent: u32) -> io::Result<()> {
    Ok(())
}

/// The job bounds what this process may allocate. Windows has no bound on open files.
pub(crate) fn restrict(_limits: ResourceLimits) -> io::Result<()> {
    // What crashes or lacks a library opens no window that somebody has to close.
    // SAFETY: of this process alone.
    unsafe { SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX) };
    Ok(())
}

/// Committed memory of a child, in bytes.
///
/// Windows lets no allocation pass the job's limit; Wine takes the limit and does not enforce it.
pub(crate) fn committed_bytes(child: &Child) -> Option<u64> {
    let mut counters = PROCESS_MEMORY_COUNTERS::default();
    let size = size::<PROCESS_MEMORY_COUNTERS>();
    // SAFETY: the handle is open, the counters are of this size.
    let answer = unsafe { K32GetProcessMemoryInfo(child.as_raw_handle(), &raw mut counters, size) };
    succeeded(answer).ok().map(|()| counters.PagefileUsage as u64)
}

/// Output stream of a child; reading does not block.
pub(crate) struct Pipe(File);

impl Pipe {
    /// Takes a stream of a child.
    pub(crate) fn new(stream: impl Into<OwnedHandle>) -> io::Result<Self> {
        Ok(Self(File::from(stream.into())))
    }

    /// Bytes to read; an error once nobody writes any more and everything was read.
    fn available(&self) -> io::Result<usize> {
        let mut count = 0;
        let (none, pipe) = (ptr::null_mut(), self.0.as_raw_handle());
        // SAFETY: the handle is open; nothing is read, only counted.
        let answer = unsafe { PeekNamedPipe(pipe, ptr::null_mut(), 0, none, &raw mut count, none) };
        succeeded(answer).map(|()| count as usize)
    }
}

impl Read for Pipe {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self.available() {
            Ok(0) => Err(io::ErrorKind::WouldBlock.into()),
            Ok(count) => {
                let count = count.min(buffer.len());
                self.0.read(&mut buffer[..count])
            }
            Err(error) if error.raw_os_error() == Some(ERROR_BROKEN_PIPE as i32) => Ok(0),
            Err(error) => Err(error),
        }
    }
}

/// Waits until one of the pipes has something to read or is closed, at most this long.
pub(crate) fn wait_for<'p>(pipes: impl Iterator<Item = &'p Pipe>, longest: Duration) {
    let (pipes, began): (Vec<_>, _) = (pipes.collect(), Instant::now());
    // A pipe cannot be waited for without reading.
    while began.elapsed() < longest && pipes.iter().all(|pipe| matches!(pipe.available(), Ok(0))) {
        thread::sleep(PAUSE);
    }
}

/// How a process ended: exit status or the name of the exception (NTSTATUS).
pub(crate) fn describe_exit(status: ExitStatus) -> String {
    let Some(code) = status.code() else { return status.to_string() };
    let name = match code as u32 {
        0xc000_0005 => "segmentation fault",
        0xc000_0006 => "page cannot be read",
        0xc000_0017 => "out of memory",
        0xc000_001d => "illegal instruction",
        0xc000_008e..=0xc000_0095 => "arithmetic",
        0xc000_00fd => "stack overflow",
        0xc000_0409 => "abort",
        0xc000_0000.. => "see NTSTATUS",
        _ => return format!("it exited with status {code}"),
    };
    format!("exception {:#010x} ({name})", code as u32)
}

/// Whether a process was ended by others; its status does not say.
pub(crate) fn is_from_outside(_status: ExitStatus) -> bool {
    false
}

/// Memory that is available; not asked for, as [`committed_bytes`] is measured.
pub(crate) fn available_bytes() -> Option<u64> {
    None
}
