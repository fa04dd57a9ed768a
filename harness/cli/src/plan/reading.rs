//! Reading of the TOML files that are planned by: numbers, times and paths with what is reported of those that cannot be.

use std::path::{Path, PathBuf};

use physics::{
    environment::dates,
    toml::{Checker, Document, Place},
};
use serde::de::DeserializeOwned;

use crate::{
    kind::FileKind,
    mission::{At, Written},
    values,
};

pub(super) const DAY_S: f64 = 86_400.0;
pub(super) const ALLOWED_LENGTH: &str = "a number of m or one with a unit: 2e5, \"200 km\", \"0.5 AU\"";
pub(super) const ALLOWED_SPAN: &str = "a number of s or one with a unit: 600, \"12 h\", \"3 d\"";
pub(super) const ALLOWED_ANGLE: &str = "a number of rad or one with a unit: \"2 deg\"";
pub(super) const ALLOWED_MOMENTUM: &str =
    "a number of N.m.s above 0, or one with that unit: 5.5, \"5.5 N.m.s\"";

/// A file of a kind, its tables read by `build`.
///
/// # Errors
/// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
pub(super) fn read<D: DeserializeOwned, T>(
    kind: FileKind,
    file: &Path,
    build: impl FnOnce(&mut Builder<'_>, D) -> T,
) -> Result<T, String> {
    parse(file, &kind.read(file)?, build)
}

/// The same of its text.
pub(super) fn parse<D: DeserializeOwned, T>(
    file: &Path,
    text: &str,
    build: impl FnOnce(&mut Builder<'_>, D) -> T,
) -> Result<T, String> {
    let shown = file.display().to_string();
    let document = Document::parse(&shown, text).map_err(|error| error.to_string())?;
    let (description, findings) = document.read::<D>().map_err(|error| error.to_string())?;
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut builder = Builder { check: Checker::new(&document, findings), folder };
    let built = build(&mut builder, description);
    builder.check.finish(built).map_err(|error| error.to_string())
}

/// A problem at a place of a file.
pub(super) fn problem<T>(file: &Path, at: &At<T>, what: &str) -> String {
    format!("{}:{}: {}: {what}", file.display(), at.line, at.key)
}

/// A number in the SI unit of this name, or a text with a unit.
pub(super) fn quantity(written: &Written, unit: &str) -> Option<f64> {
    let number = match written {
        Written::Text(text) => values::quantity(text, unit),
        _ => number(written),
    };
    number.filter(|number| number.is_finite())
}

/// A number without a unit.
pub(super) fn number(written: &Written) -> Option<f64> {
    match written {
        Written::Integer(number) => Some(*number as f64),
        Written::Number(number) => Some(*number),
        _ => None,
    }
}

/// Reads the tables of a file.
pub(super) struct Builder<'d> {
    pub check: Checker<'d>,
    /// That of the file.
    pub folder: &'d Path,
}

impl Builder<'_> {
    pub(super) fn at<T>(&self, place: &Place, it: T) -> At<T> {
        At { it, key: place.to_string(), line: self.check.line(place) }
    }

    pub(super) fn path(&mut self, place: &Place, path: &str) -> PathBuf {
        let found = self.folder.join(path);
        if !self.check.has_stand_in(place) && !found.is_file() {
            let shown = format!("{}, which is not there", found.display());
            self.check.report(place, shown, "a file; paths are relative to this one's folder");
        }
        found
    }

    pub(super) fn span(
        &mut self,
        place: &Place,
        written: Option<&Written>,
        default_s: f64,
        least_s: f64,
    ) -> f64 {
        let Some(written) = written else { return default_s };
        let span_s = written.setting().and_then(|text| values::duration(&text).ok());
        match span_s.filter(|span_s| *span_s >= least_s) {
            Some(span_s) => span_s,
            None => {
                let least = if least_s > 0.0 { "from 1 h on" } else { "from 0 on" };
                self.check.report(place, written, format_args!("a time {least}: {ALLOWED_SPAN}"));
                default_s
            }
        }
    }

    /// An angle from 0 to 90 deg.
    pub(super) fn angle(&mut self, place: &Place, written: Option<&Written>) -> Option<f64> {
        let written = written?;
        let angle_rad = match written {
            Written::Number(angle_rad) => Some(*angle_rad),
            Written::Integer(0) => Some(0.0),
            Written::Text(text) => values::angle(text).ok(),
            _ => None,
        };
        let angle_rad = angle_rad.filter(|it| (0.0..=core::f64::consts::FRAC_PI_2).contains(it));
        if angle_rad.is_none() {
            self.check.report(place, written, format_args!("an angle from 0 to 90 deg: {ALLOWED_ANGLE}"));
        }
        angle_rad
    }

    pub(super) fn momentum(&mut self, place: &Place, written: Option<&Written>) -> Option<f64> {
        let written = written?;
        let number = match written {
            Written::Text(text) => {
                let text = text.trim();
                text.strip_suffix("N.m.s").unwrap_or(text).trim_end().parse().ok()
            }
            _ => number(written),
        };
        let momentum = number.filter(|number: &f64| *number > 0.0 && number.is_finite());
        if momentum.is_none() {
            self.check.report(place, written, ALLOWED_MOMENTUM);
        }
        momentum
    }

    pub(super) fn share(&mut self, place: &Place, written: Option<&Written>, default: f64, most: f64) -> f64 {
        let Some(written) = written else { return default };
        number(written).filter(|number| (0.0..=most).contains(number)).unwrap_or_else(|| {
            self.check.report(place, written, format_args!("a share from 0 to {most}"));
            default
        })
    }

    pub(super) fn count(&mut self, place: &Place, written: Option<&Written>) -> usize {
        let Some(written) = written else { return 0 };
        let number =
            if let Written::Integer(number) = written { usize::try_from(*number).ok() } else { None };
        number.unwrap_or_else(|| {
            self.check.report(place, written, "a whole number from 0 on");
            0
        })
    }

    pub(super) fn instant(&mut self, place: &Place, written: &Written) -> Option<values::Instant> {
        let number = matches!(written, Written::Number(_) | Written::Integer(_) | Written::Text(_));
        let instant = written.setting().filter(|_| number).and_then(|text| values::instant(&text).ok());
        if instant.is_none() && !self.check.has_stand_in(place) {
            let allowed = format!("{}; or simulation time, {ALLOWED_SPAN}", dates::ALLOWED_DATE);
            self.check.report(place, written, allowed);
        }
        instant
    }

    pub(super) fn spanned(
        &mut self,
        place: &Place,
        start: &Written,
        stop: &Written,
    ) -> Option<[values::Instant; 2]> {
        let span = [self.instant(&place.key("start"), start)?, self.instant(&place.key("stop"), stop)?];
        let is_ordered = match span {
            [values::Instant::Time(a), values::Instant::Time(b)]
            | [values::Instant::Epoch(a), values::Instant::Epoch(b)] => a < b,
            _ => {
                self.check.report(
                    &place.key("stop"),
                    stop,
                    "a date as start is one, or both simulation times",
                );
                return None;
            }
        };
        if !is_ordered {
            let found = format!("{stop}, not after `start`");
            self.check.report(&place.key("stop"), found, format_args!("a time after {start}"));
        }
        Some(span)
    }
}
