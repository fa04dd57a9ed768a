//! Runs a probe in a process of its own and reads its findings.

use std::{
    io::{BufRead, BufReader, Read},
    process::{Child, Command, ExitStatus, Stdio},
    sync::mpsc,
    time::{Duration, Instant},
};

use loader::Fmu;

use super::{Finding, Verdict};

/// Last line of a probe that came to its end.
pub const FINISHED: &str = "finished";
/// How often a waiting parent looks.
const POLL: Duration = Duration::from_millis(5);

/// Runs the probe; a crash, a hang or an early end is a finding.
pub fn run(fmu: &Fmu, probe: &str, patience_s: f64) -> Vec<Finding> {
    match start(fmu, probe) {
        Ok(child) => watch(child, patience_s),
        Err(error) => vec![Finding::bad(format!("the probe cannot be started: {error}"))],
    }
}

/// A finding as one line.
pub fn encode(finding: &Finding) -> String {
    let text = finding.text.replace('\\', "\\\\").replace('\n', "\\n").replace('\r', "\\r");
    format!("{} {text}", finding.verdict.word())
}

fn decode(line: &str) -> Option<Finding> {
    let (word, text) = line.split_once(' ')?;
    let verdict = Verdict::ALL.into_iter().find(|verdict| verdict.word() == word)?;
    let mut plain = String::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        plain.push(match letter {
            '\\' => match letters.next() {
                Some('n') => '\n',
                Some('r') => '\r',
                other => other.unwrap_or('\\'),
            },
            other => other,
        });
    }
    Some(Finding::new(verdict, plain))
}

fn start(fmu: &Fmu, probe: &str) -> std::io::Result<Child> {
    Command::new(std::env::current_exe()?)
        .arg("probe-in-child")
        .arg(fmu.folder())
        .arg(probe)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
}

fn watch(mut child: Child, patience_s: f64) -> Vec<Finding> {
    let lines = read_lines(child.stdout.take());
    let complaints = read_lines(child.stderr.take());
    let began = Instant::now();
    let status = loop {
        match child.try_wait() {
            Ok(Some(status)) => break Some(status),
            Ok(None) if began.elapsed().as_secs_f64() > patience_s => break None,
            Ok(None) => std::thread::sleep(POLL),
            Err(_) => break None,
        }
    };
    if status.is_none() {
        // It may have ended by itself just now.
        let _ = child.kill();
        let _ = child.wait();
    }
    let mut findings = Vec::new();
    let mut finished = false;
    for line in lines.iter() {
        finished |= line == FINISHED;
        // An FMU may print too: what is no finding is left out.
        findings.extend(decode(&line));
    }
    match status {
        None => {
            findings.push(Finding::bad(format!("hangs: still busy after {patience_s} s (see --patience)")))
        }
        Some(status) if !finished || !status.success() => {
            let last: Vec<String> = complaints.iter().collect();
            let last = last.iter().rev().take(3).rev().map(|line| format!("\n{line}")).collect::<String>();
            findings.push(Finding::bad(format!("the process died: {}{last}", how(status))));
        }
        Some(_) => {}
    }
    findings
}

/// Reads a stream's lines on a thread of its own, so that a full pipe stops nobody.
fn read_lines(stream: Option<impl Read + Send + 'static>) -> mpsc::Receiver<String> {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let Some(stream) = stream else { return };
        for line in BufReader::new(stream).split(b'\n').map_while(Result::ok) {
            if sender.send(String::from_utf8_lossy(&line).into_owned()).is_err() {
                return;
            }
        }
    });
    receiver
}

fn how(status: ExitStatus) -> String {
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
    status.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_travel_as_lines() {
        for text in ["plain", "two\nlines", "a \\n that is none", "\r\n\\", ""] {
            for verdict in Verdict::ALL {
                let finding = Finding::new(verdict, text);
                let line = encode(&finding);
                assert!(!line.contains('\n'));
                assert_eq!(decode(&line), Some(finding));
            }
        }
        assert_eq!(decode("printf of the FMU"), None);
        assert_eq!(decode(FINISHED), None);
    }

    #[cfg(unix)]
    fn shell(script: &str, patience_s: f64) -> Vec<Finding> {
        shell_reading(script, Stdio::null(), patience_s)
    }

    #[cfg(unix)]
    fn shell_reading(script: &str, input: Stdio, patience_s: f64) -> Vec<Finding> {
        let child = Command::new("sh")
            .args(["-c", script])
            .stdin(input)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        watch(child, patience_s)
    }

    #[cfg(unix)]
    #[test]
    fn a_crash_a_hang_and_an_early_end_are_findings() {
        let whole = shell("echo 'ok one'; echo 'noise'; echo 'note two'; echo finished", 10.0);
        assert_eq!(whole, [Finding::good("one"), Finding::note("two")]);

        let crash = shell("echo 'ok one'; echo oops >&2; kill -SEGV $$", 10.0);
        assert_eq!(crash[0], Finding::good("one"));
        assert!(
            crash[1].verdict == Verdict::Bad && crash[1].text.contains("segmentation fault"),
            "{crash:?}"
        );
        assert!(crash[1].text.contains("oops"), "{crash:?}");

        let early = shell("echo 'ok one'; exit 0", 10.0);
        assert_eq!(early[1].verdict, Verdict::Bad, "{early:?}");

        // It reads what nobody writes, and ends only because it is killed.
        let (nothing, _writer) = std::io::pipe().unwrap();
        let hang = shell_reading("exec cat", nothing.into(), 0.0);
        assert!(hang[0].verdict == Verdict::Bad && hang[0].text.contains("hangs"), "{hang:?}");
    }
}
