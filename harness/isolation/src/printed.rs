//! Output of an FMU: read without waiting, counted, and kept only as far as it is shown.

use std::{
    collections::VecDeque,
    io::{self, Read},
    process::Child,
    time::Duration,
};

use super::system::{Pipe, wait_for};

/// How much of what an FMU prints is shown.
const BYTES_SHOWN: u64 = 1 << 20;
/// Longest line that is handed on; the rest of it is a line of its own.
const LINE: usize = 4096;
/// Lines kept for the report of a crash.
const LINES_KEPT: usize = 3;
/// Read at a time, so that the parent reads the other channels too.
const AT_ONCE: usize = 1 << 20;

/// Shows what an FMU prints, up to a bound.
pub struct Shown<'a> {
    name: &'a str,
    bytes: u64,
}

impl<'a> Shown<'a> {
    /// Starts without output; what is left out is reported for `name`.
    pub fn new(name: &'a str) -> Self {
        Self { name, bytes: 0 }
    }

    /// Shows one more line on stderr.
    pub fn line(&mut self, line: &str) {
        let before = self.bytes;
        self.bytes += line.len() as u64 + 1;
        if self.bytes <= BYTES_SHOWN {
            terminal::note(line);
        } else if before <= BYTES_SHOWN {
            terminal::note(&format!("{}: what else it prints is left out", self.name));
        }
    }
}

/// Both streams of a child.
pub(super) struct Printed {
    streams: Vec<Stream>,
    buffer: Box<[u8]>,
    last: VecDeque<String>,
    bytes: u64,
}

struct Stream {
    pipe: Pipe,
    line: Vec<u8>,
}

impl Printed {
    /// Takes the streams of a child.
    pub(super) fn from_child(child: &mut Child) -> io::Result<Self> {
        let pipes = [child.stdout.take().map(Pipe::new), child.stderr.take().map(Pipe::new)];
        let streams = pipes.into_iter().flatten().map(|pipe| Ok(Stream { pipe: pipe?, line: Vec::new() }));
        let streams = streams.collect::<io::Result<_>>()?;
        Ok(Self { streams, buffer: vec![0; 1 << 14].into(), last: VecDeque::new(), bytes: 0 })
    }

    /// Waits until the child prints or ends, at most this long.
    pub(super) fn wait(&self, longest: Duration) {
        wait_for(self.streams.iter().map(|stream| &stream.pipe), longest);
    }

    /// Reads what is there and hands each line on; gives whether there was anything, the end of a stream too.
    pub(super) fn read(&mut self, line: &mut dyn FnMut(&str)) -> bool {
        let mut some = false;
        let Self { streams, buffer, last, bytes } = self;
        streams.retain_mut(|stream| {
            let mut left = AT_ONCE;
            while left > 0 {
                match stream.pipe.read(buffer) {
                    Ok(0) => {
                        some = true;
                        return false;
                    }
                    Ok(count) => {
                        (some, left) = (true, left.saturating_sub(count));
                        *bytes += count as u64;
                        for byte in &buffer[..count] {
                            if *byte != b'\n' {
                                stream.line.push(*byte);
                            }
                            // A line of Windows ends with CR LF.
                            if *byte == b'\n' {
                                stream.line.pop_if(|last| *last == b'\r');
                            }
                            if *byte == b'\n' || stream.line.len() >= LINE {
                                keep(last, &mut stream.line, line);
                            }
                        }
                    }
                    Err(error) if error.kind() == io::ErrorKind::WouldBlock => return true,
                    Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                    Err(_) => return false,
                }
            }
            true
        });
        some
    }

    /// Hands the last lines on, which nothing ended.
    pub(super) fn finish(&mut self, line: &mut dyn FnMut(&str)) {
        self.read(line);
        for stream in &mut self.streams {
            if !stream.line.is_empty() {
                keep(&mut self.last, &mut stream.line, line);
            }
        }
    }

    /// Bytes printed so far.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The last lines, marked as what they are.
    pub(super) fn last(&self) -> String {
        self.last.iter().map(|line| format!("\n| {line}")).collect()
    }
}

fn keep(last: &mut VecDeque<String>, bytes: &mut Vec<u8>, line: &mut dyn FnMut(&str)) {
    let text = String::from_utf8_lossy(bytes).into_owned();
    bytes.clear();
    line(&text);
    if last.len() == LINES_KEPT {
        last.pop_front();
    }
    last.push_back(text);
}
