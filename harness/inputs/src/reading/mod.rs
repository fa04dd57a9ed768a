//! Reading of the TOML files that people write: values and paths with what is reported of those that cannot be.

pub mod written;

use core::f64::consts::FRAC_PI_2;
use std::{
    fmt::Display,
    path::{Path, PathBuf},
};

use physics::{
    environment::dates,
    toml::{Checker, Document, Place},
};
use serde::de::DeserializeOwned;

use crate::{
    kind::FileKind,
    values::{self, Instant},
};
pub use written::{Written, WrittenAs};

/// Form of a length, for messages.
pub const ALLOWED_LENGTH: &str = "a number of m or one with a unit: 2e5, \"200 km\", \"0.5 AU\"";
pub(crate) const ALLOWED_SPAN: &str = "a number of s or one with a unit: 600, \"12 h\", \"3 d\"";
/// Form of an angle, for messages.
pub const ALLOWED_ANGLE: &str = "with its unit: \"2 deg\", \"0.035 rad\"";
const ALLOWED_MOMENTUM: &str = "a number of N.m.s above 0, or one with that unit: 5.5, \"5.5 N.m.s\"";

/// A value with its key and line.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    /// Value.
    pub it: T,
    /// The key with its tables.
    pub key: String,
    /// Line from 1.
    pub line: usize,
}

impl<T> At<T> {
    /// Its place in a file.
    pub fn place(&self, file: &Path) -> String {
        format!("{}:{}: {}", file.display(), self.line, self.key)
    }

    /// A problem at its place.
    pub fn problem(&self, file: &Path, what: &str) -> String {
        format!("{}: {what}", self.place(file))
    }
}

/// A file of a kind, its tables read by `build`.
///
/// # Errors
/// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
pub fn read<D: DeserializeOwned, T>(
    kind: FileKind,
    file: &Path,
    build: impl FnOnce(&mut Builder<'_>, D) -> T,
) -> Result<T, String> {
    parse(file, &kind.read(file)?, build)
}

/// The same of its text.
pub fn parse<D: DeserializeOwned, T>(
    file: &Path,
    text: &str,
    build: impl FnOnce(&mut Builder<'_>, D) -> T,
) -> Result<T, String> {
    let shown = file.display().to_string();
    let document = Document::parse(&shown, text).map_err(|error| error.to_string())?;
    let (description, check) = Checker::read::<D>(&document).map_err(|error| error.to_string())?;
    let folder = file.parent().unwrap_or(Path::new(""));
    let built = build(&mut Builder { root: Place::root(&check), folder }, description);
    check.finish(built).map_err(|error| error.to_string())
}

/// Reads the tables of a file.
pub struct Builder<'d> {
    /// The whole file.
    pub root: Place<'d>,
    /// Folder of the file.
    pub folder: &'d Path,
}

impl Builder<'_> {
    /// A value with its key and line.
    pub fn at<T>(&self, place: &Place<'_>, it: T) -> At<T> {
        At { it, key: place.to_string(), line: place.line() }
    }

    /// Values with their places in a list.
    pub fn each<T>(&self, list: &Place<'_>, values: Vec<T>) -> Vec<At<T>> {
        values.into_iter().enumerate().map(|(index, it)| self.at(&list.item(index), it)).collect()
    }

    /// Converts a written value by `read`; reports a value that `read` rejects.
    pub fn read<T>(
        &mut self,
        place: &Place<'_>,
        written: Option<&Written>,
        read: impl FnOnce(&Written) -> Option<T>,
        allowed: impl Display,
    ) -> Option<T> {
        let written = written?;
        let read = read(written);
        if read.is_none() {
            place.report(written, allowed);
        }
        read
    }

    /// A file that is read; reported unless it `is_there`.
    pub fn path(&mut self, place: &Place<'_>, path: &str, is_there: fn(&Path) -> bool) -> PathBuf {
        let found = self.folder.join(path);
        if !is_there(&found) {
            self.report_missing(place, &found);
        }
        found
    }

    /// Reports a file that is missing.
    pub fn report_missing(&mut self, place: &Place<'_>, path: &Path) {
        let found = format_args!("{}, which is not there", path.display());
        place.report(found, "a file; paths are relative to this one's folder");
    }

    /// A time in s from `least_s` on; the default where none is written.
    pub fn span(
        &mut self,
        place: &Place<'_>,
        written: Option<&Written>,
        default_s: f64,
        least_s: f64,
    ) -> f64 {
        let least = if least_s > 0.0 { "from 1 h on" } else { "from 0 on" };
        let span_s = |written: &Written| written.duration_s().filter(|span_s| *span_s >= least_s);
        let allowed = format_args!("a time {least}: {ALLOWED_SPAN}");
        self.read(place, written, span_s, allowed).unwrap_or(default_s)
    }

    /// A length in m.
    pub fn length(&mut self, place: &Place<'_>, written: Option<&Written>) -> Option<f64> {
        self.read(place, written, |written| written.quantity("m"), ALLOWED_LENGTH)
    }

    /// An angle from 0 to 90 deg.
    pub fn angle(&mut self, place: &Place<'_>, written: Option<&Written>) -> Option<f64> {
        let angle_rad = |written: &Written| written.angle_rad().filter(|it| (0.0..=FRAC_PI_2).contains(it));
        self.read(place, written, angle_rad, format_args!("an angle from 0 to 90 deg {ALLOWED_ANGLE}"))
    }

    /// A momentum above 0, in N m s.
    pub fn momentum(&mut self, place: &Place<'_>, written: Option<&Written>) -> Option<f64> {
        let momentum_n_m_s =
            |written: &Written| written.quantity("N.m.s").filter(|momentum_n_m_s| *momentum_n_m_s > 0.0);
        self.read(place, written, momentum_n_m_s, ALLOWED_MOMENTUM)
    }

    /// A fraction from 0 to `most`; the default where none is written.
    pub fn share(&mut self, place: &Place<'_>, written: Option<&Written>, default: f64, most: f64) -> f64 {
        let share = |written: &Written| written.number().filter(|number| (0.0..=most).contains(number));
        self.read(place, written, share, format_args!("a share from 0 to {most}")).unwrap_or(default)
    }

    /// A whole number from `least` on.
    pub fn count(&mut self, place: &Place<'_>, written: Option<&Written>, least: u64) -> Option<u64> {
        let count = |written: &Written| {
            let Written::Integer(number) = written else { return None };
            u64::try_from(*number).ok().filter(|number| *number >= least)
        };
        self.read(place, written, count, format_args!("a whole number from {least} on"))
    }

    /// A date or a simulation time.
    pub fn instant(&mut self, place: &Place<'_>, written: &Written) -> Option<Instant> {
        let instant = |written: &Written| values::instant(&written.scalar()?).ok();
        let allowed = format_args!("{}; or simulation time, {ALLOWED_SPAN}", dates::ALLOWED_DATE);
        self.read(place, Some(written), instant, allowed)
    }

    /// The same with its place.
    pub fn instant_at(&mut self, place: &Place<'_>, written: &Written) -> Option<At<Instant>> {
        let instant = self.instant(place, written)?;
        Some(self.at(place, instant))
    }

    /// Start and stop, in order; both dates or both simulation times.
    pub fn spanned(&mut self, place: &Place<'_>, start: &Written, stop: &Written) -> Option<[Instant; 2]> {
        let span = [self.instant(&place.key("start"), start)?, self.instant(&place.key("stop"), stop)?];
        let is_ordered = match span {
            [Instant::Time(a), Instant::Time(b)] | [Instant::Epoch(a), Instant::Epoch(b)] => a < b,
            _ => {
                let allowed = "a date as start is one, or both simulation times";
                place.key("stop").report(stop, allowed);
                return None;
            }
        };
        if !is_ordered {
            let found = format!("{stop}, not after `start`");
            place.key("stop").report(found, format_args!("a time after {start}"));
        }
        Some(span)
    }
}
