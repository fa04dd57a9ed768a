//! Times of a test run: processor time of every command, the slowest tests of Rust and Python.

use std::process::Child;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Time of one step: commands of the same first words count together.
struct Step {
    name: String,
    /// Processor time with that of all child processes, where the system has it.
    processor: Option<Duration>,
    wall: Duration,
}

static STEPS: Mutex<Vec<Step>> = Mutex::new(Vec::new());
static TESTS: Mutex<Vec<(f64, String)>> = Mutex::new(Vec::new());

/// Number of tests that are printed.
const SLOWEST: usize = 10;
/// Interval at which a child is asked whether it ended.
const POLL: Duration = Duration::from_millis(10);
/// Clock ticks of `/proc` in a second.
const TICKS_PER_S: u64 = 100;

/// Waits until a child ends; returns its processor time and that of its own children. The child is still to be waited for, as a
/// process keeps its times only until then.
pub(crate) fn processor_time(child: &Child) -> Option<Duration> {
    let stat = format!("/proc/{}/stat", child.id());
    loop {
        let text = std::fs::read_to_string(&stat).ok()?;
        // Behind the program's name, which may hold anything: state, 10 numbers, then user and system time of process and children.
        let (_, fields) = text.rsplit_once(')')?;
        let fields: Vec<&str> = fields.split_whitespace().collect();
        if fields.first() == Some(&"Z") {
            let ticks: Option<u64> = fields.get(11..15)?.iter().map(|field| field.parse::<u64>().ok()).sum();
            return Some(Duration::from_millis(ticks? * 1000 / TICKS_PER_S));
        }
        std::thread::sleep(POLL);
    }
}

/// Adds the time of a command, as it is shown, to that of its step.
pub(crate) fn add_command(shown: &str, processor: Option<Duration>, wall: Duration) {
    let name = step_name(shown);
    let mut steps = STEPS.lock().unwrap_or_else(PoisonError::into_inner);
    match steps.iter_mut().find(|step| step.name == name) {
        Some(step) => {
            step.processor = step.processor.zip(processor).map(|(sum, more)| sum + more);
            step.wall += wall;
        }
        None => steps.push(Step { name, processor, wall }),
    }
}

/// The program and at most two words behind it, up to the first path.
fn step_name(shown: &str) -> String {
    let mut words = shown.split(' ');
    let program = words.next().unwrap_or_default();
    let further = words.take(2).take_while(|word| !word.contains(['/', '\\', '=']));
    std::iter::once(program).chain(further).collect::<Vec<_>>().join(" ")
}

/// Adds the tests that a line of libtest's or pytest's output names with their time.
pub(crate) fn add_tests(output: &str) {
    let found = output.lines().filter_map(|line| in_rust(line).or_else(|| in_python(line)));
    TESTS.lock().unwrap_or_else(PoisonError::into_inner).extend(found);
}

/// `test models::runs ... ok <1.234s>` of `--report-time`.
fn in_rust(line: &str) -> Option<(f64, String)> {
    let (name, outcome) = line.strip_prefix("test ")?.split_once(" ... ")?;
    let (_, seconds) = outcome.strip_suffix("s>")?.rsplit_once('<')?;
    Some((seconds.parse().ok()?, name.to_owned()))
}

/// `1.23s call tests/python/test_a.py::test_b` of `--durations`; a fixture that many tests use is `setup` of the first.
fn in_python(line: &str) -> Option<(f64, String)> {
    let mut words = line.split_whitespace();
    let seconds = words.next()?.strip_suffix('s')?.parse().ok()?;
    let phase = words.next().filter(|word| ["call", "setup", "teardown"].contains(word))?;
    let test = words.next().filter(|word| word.contains("::"))?;
    Some((seconds, if phase == "call" { test.to_owned() } else { format!("{test} ({phase})") }))
}

/// Prints the times of all steps and the slowest tests.
pub(crate) fn print() {
    let steps = STEPS.lock().unwrap_or_else(PoisonError::into_inner);
    eprintln!("\nprocessor time, duration, step:");
    for step in steps.iter() {
        let processor = step.processor.map_or("-".to_owned(), |time| format!("{:.1} s", time.as_secs_f64()));
        eprintln!("{processor:>10} {:>9.1} s  {}", step.wall.as_secs_f64(), step.name);
    }
    let processor: Duration = steps.iter().filter_map(|step| step.processor).sum();
    eprintln!("{:>8.1} s  together", processor.as_secs_f64());
    let mut tests = TESTS.lock().unwrap_or_else(PoisonError::into_inner);
    tests.sort_by(|a, b| b.0.total_cmp(&a.0));
    eprintln!("\nslowest tests:");
    for (seconds, name) in tests.iter().take(SLOWEST) {
        eprintln!("{seconds:>8.1} s  {name}");
    }
}

#[cfg(test)]
mod tests {
    //! Steps are told apart by their first words; tests are found in what libtest and pytest print; a child's time is its own.

    use super::*;

    #[test]
    fn commands_of_the_same_first_words_are_one_step() {
        assert_eq!(step_name("cargo test --no-run --tests --locked"), "cargo test --no-run");
        assert_eq!(step_name("heliotorque pack --name A --model B"), "heliotorque pack --name");
        assert_eq!(step_name("client target/lib.so --short"), "client");
        assert_eq!(step_name("python -m pytest -q"), "python -m pytest");
    }

    #[test]
    fn tests_are_found_with_their_times() {
        assert_eq!(in_rust("test a::b ... ok <1.250s>"), Some((1.25, "a::b".to_owned())));
        assert_eq!(
            in_rust("test a::b - should panic ... FAILED <0.5s>"),
            Some((0.5, "a::b - should panic".to_owned()))
        );
        assert_eq!(in_rust("test a::b ... ignored"), None);
        assert_eq!(in_rust("running 3 tests"), None);
        let name = || "tests/python/test_a.py::test_b".to_owned();
        assert_eq!(in_python("2.50s call     tests/python/test_a.py::test_b"), Some((2.5, name())));
        assert_eq!(
            in_python("0.50s setup    tests/python/test_a.py::test_b"),
            Some((0.5, name() + " (setup)"))
        );
        assert_eq!(in_python("8 passed in 3.00s"), None);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn processor_time_counts_work_of_grandchildren_and_no_sleep() {
        let time = |script: &str| {
            let mut child = std::process::Command::new("sh").args(["-c", script]).spawn().unwrap();
            let time = processor_time(&child).unwrap();
            assert!(child.wait().unwrap().success());
            time
        };
        let work = "sh -c 'i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done'; true";
        let (working, sleeping) = (time(work), time("sleep 0.2"));
        assert!(working >= Duration::from_millis(50), "{working:?}");
        assert!(sleeping <= Duration::from_millis(20), "{sleeping:?}");
    }
}
