//! A mission, from its file: times, paths, values and names by the line that they stand in.

use std::path::{Path, PathBuf};

use physics::{
    environment::dates::{self, ALLOWED_DATE},
    toml::{Checker, Document, Place},
};

use super::{
    description::{Description, LimitDescription, PlotDescription},
    written::Written,
};
use crate::{kind::FileKind, output::is_svg_path, values};

/// What a duration looks like, for messages.
const ALLOWED_TIME: &str = "a number of s or one with a unit: 600, \"10 min\", \"0.5 h\", \"90 d\"";

/// Something with the key and line that it stands in.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct At<T> {
    /// What it is.
    pub it: T,
    /// The key with its tables.
    pub key: String,
    /// Line from 1.
    pub line: usize,
}

/// The FMU or spacecraft.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SpacecraftSource {
    /// An FMU or system that is packed already.
    Fmu(PathBuf),
    /// Files that are packed for the run.
    Files {
        /// The spacecraft or spinner.
        spacecraft: Option<PathBuf>,
        /// The model, if it is named.
        model: Option<At<String>>,
        /// Commands over time.
        timeline: Option<PathBuf>,
        /// Positions over time.
        ephemeris: Option<PathBuf>,
    },
}

/// An input over time: times in s, and values as `--set` takes them.
pub(super) type InputRows = Vec<(f64, String)>;

/// Inputs over time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Inputs {
    /// A CSV file.
    File(PathBuf),
    /// By name.
    Rows(Vec<At<(String, InputRows)>>),
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plot {
    /// The SVG file.
    pub file: PathBuf,
    /// What it shows; `None`: everything recorded.
    pub names: Option<Vec<At<String>>>,
}

/// Bounds of a variable, as they are written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bounds {
    /// The variable or vector.
    pub name: String,
    /// The smallest value that is kept.
    pub min: Option<String>,
    /// The largest.
    pub max: Option<String>,
}

/// A mission.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mission {
    /// The file as the caller named it.
    pub file: PathBuf,
    /// The FMU or spacecraft.
    pub spacecraft_source: SpacecraftSource,
    /// The epoch of simulation time 0, where `start` is a date; in s past J2000 TDB.
    pub epoch_s: Option<At<f64>>,
    /// When it begins.
    pub start_s: Option<f64>,
    /// When it ends.
    pub stop_s: Option<f64>,
    /// Communication step.
    pub step_s: Option<f64>,
    /// Time between rows.
    pub every_s: Option<f64>,
    /// What is recorded; `None`: every output.
    pub record: Option<Vec<At<String>>>,
    /// The CSV file.
    pub output: Option<PathBuf>,
    /// Pictures.
    pub plots: Vec<Plot>,
    /// Values by name, as `--set` takes them.
    pub sets: Vec<At<(String, String)>>,
    /// Inputs over time.
    pub inputs: Option<Inputs>,
    /// What the run is judged by.
    pub limits: Vec<At<Bounds>>,
}

impl Mission {
    /// Reads a mission.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub(crate) fn read(file: &Path) -> Result<Self, String> {
        let text = FileKind::Mission.read(file)?;
        if FileKind::of(&text).is_none() {
            return Err(format!(
                "{}: found a file without any key of a mission, allowed: spacecraft = \"my.toml\" or fmu = \"My.fmu\", stop, step, \
                 record: see `heliotorque new mission`",
                file.display()
            ));
        }
        Self::parse(file, &text)
    }

    fn parse(file: &Path, text: &str) -> Result<Self, String> {
        let shown = file.display().to_string();
        let document = Document::parse(&shown, text).map_err(|error| error.to_string())?;
        let (description, findings) = document.read::<Description>().map_err(|error| error.to_string())?;
        let folder = file.parent().unwrap_or(Path::new(""));
        let mut builder = Builder { check: Checker::new(&document, findings), folder, epoch_s: None };
        let mission = builder.mission(file, description);
        builder.check.finish(mission).map_err(|error| error.to_string())
    }

    /// The files that it names and reads.
    pub(crate) fn reads(&self) -> Vec<&Path> {
        let spacecraft_source = match &self.spacecraft_source {
            SpacecraftSource::Fmu(path) => [Some(path), None, None],
            SpacecraftSource::Files { spacecraft, timeline, ephemeris, .. } => {
                [spacecraft.as_ref(), timeline.as_ref(), ephemeris.as_ref()]
            }
        };
        let table = if let Some(Inputs::File(path)) = &self.inputs { Some(path) } else { None };
        spacecraft_source
            .into_iter()
            .flatten()
            .chain(table)
            .map(PathBuf::as_path)
            .chain([self.file.as_path()])
            .collect()
    }

    /// A problem at a place of the file.
    pub(crate) fn problem<T>(&self, at: &At<T>, what: &str) -> String {
        format!("{}: {what}", self.place(at))
    }

    /// A place of the file.
    pub(crate) fn place<T>(&self, at: &At<T>) -> String {
        format!("{}:{}: {}", self.file.display(), at.line, at.key)
    }
}

struct Builder<'d> {
    check: Checker<'d>,
    folder: &'d Path,
    /// Of time 0, where `start` is a date.
    epoch_s: Option<f64>,
}

impl Builder<'_> {
    fn mission(&mut self, file: &Path, description: Description) -> Mission {
        let root = Place::root();
        let spacecraft_source = self.spacecraft_source(&description);
        let (start, stop) = (root.key("start"), root.key("stop"));
        let mut epoch_s = None;
        let mut start_s = None;
        if let Some(written) = &description.start {
            match date(written) {
                Some(read) => {
                    self.epoch_s = self.checked_date(&start, written, read);
                    epoch_s = self.epoch_s.map(|epoch_s| self.at(&start, epoch_s));
                    start_s = Some(0.0);
                }
                None => start_s = self.time(&start, written),
            }
        }
        let stop_s = description.stop.as_ref().and_then(|written| self.time(&stop, written));
        if let (Some(begin_s), Some(end_s), Some(written)) = (start_s, stop_s, &description.stop)
            && end_s <= begin_s
        {
            let begin = description.start.as_ref().map(Written::to_string).unwrap_or_default();
            self.check.report(
                &stop,
                format_args!("{written}, not after `start`"),
                format_args!("a time after {begin}"),
            );
        }
        let plots = description.plot.unwrap_or_default().into_iter().enumerate();
        let sets = description.set.unwrap_or_default().into_iter();
        let limits = description.limits.unwrap_or_default().into_iter();
        Mission {
            file: file.to_owned(),
            spacecraft_source,
            epoch_s,
            start_s,
            stop_s,
            step_s: self.span(&root.key("step"), description.step.as_ref()),
            every_s: self.span(&root.key("every"), description.every.as_ref()),
            record: description.record.map(|names| self.names(&root.key("record"), names)),
            output: description.output.map(|path| self.path(&root.key("output"), path)),
            plots: plots.map(|(i, plot)| self.plot(&root.key("plot").item(i), plot)).collect(),
            sets: sets
                .filter_map(|(name, written)| self.set(&root.key("set").key(&name), name, &written))
                .collect(),
            inputs: description.inputs.and_then(|written| self.inputs(&root.key("inputs"), written)),
            limits: limits
                .map(|(name, limit)| self.limit(&root.key("limits").key(&name), name, limit))
                .collect(),
        }
    }

    fn at<T>(&self, place: &Place, it: T) -> At<T> {
        At { it, key: place.to_string(), line: self.check.line(place) }
    }

    fn spacecraft_source(&mut self, description: &Description) -> SpacecraftSource {
        let root = Place::root();
        let Description { fmu, spacecraft, model, timeline, ephemeris, .. } = description;
        let Some(fmu) = fmu else {
            if spacecraft.is_none() && model.is_none() {
                self.check.report_lack(
                    &root,
                    "spacecraft",
                    "spacecraft = \"my.toml\", or fmu = \"My.fmu\", or model = \"MomentumPlant\" for the model's own spacecraft",
                );
            }
            let model = model.clone().map(|model| self.at(&root.key("model"), model));
            let mut file = |key: &str, path: &Option<String>| {
                path.as_ref().map(|path| self.input_file(&root.key(key), path))
            };
            return SpacecraftSource::Files {
                spacecraft: file("spacecraft", spacecraft),
                model,
                timeline: file("timeline", timeline),
                ephemeris: file("ephemeris", ephemeris),
            };
        };
        let others =
            [("spacecraft", spacecraft), ("model", model), ("timeline", timeline), ("ephemeris", ephemeris)];
        for (key, _) in others.into_iter().filter(|(_, other)| other.is_some()) {
            let allowed = "one of them: the FMU has its own, packed with it";
            self.check.report(&root.key(key), format_args!("`{key}` beside `fmu`"), allowed);
        }
        SpacecraftSource::Fmu(self.input_file(&root.key("fmu"), fmu))
    }

    fn input_file(&mut self, place: &Place, path: &str) -> PathBuf {
        let path = self.path(place, path.to_owned());
        if !path.as_os_str().is_empty() && std::fs::metadata(&path).is_err() {
            self.check.report(
                place,
                format_args!("{}, which is not there", path.display()),
                "a file; paths are relative to this one's folder",
            );
        }
        path
    }

    fn path(&mut self, place: &Place, path: String) -> PathBuf {
        if path.is_empty() {
            self.check.report(place, "an empty string", "the path of a file");
        }
        // The standard output.
        if path == "-" { PathBuf::from(path) } else { self.folder.join(path) }
    }

    fn names(&mut self, place: &Place, names: Vec<String>) -> Vec<At<String>> {
        if names.is_empty() {
            self.check.report(place, "an empty list", "at least one name, or no such key: then every output");
        }
        names.into_iter().enumerate().map(|(i, name)| self.at(&place.item(i), name)).collect()
    }

    fn plot(&mut self, place: &Place, plot: PlotDescription) -> Plot {
        let key = place.key("file");
        let file = self.path(&key, plot.file);
        if !self.check.has_stand_in(&key) && !is_svg_path(&file) {
            let found = format!("{}, no SVG file's name", file.display());
            self.check.report(&key, found, "one that ends in .svg, or -");
        }
        Plot { file, names: plot.names.map(|names| self.names(&place.key("names"), names)) }
    }

    fn set(&mut self, place: &Place, name: String, written: &Written) -> Option<At<(String, String)>> {
        if name.eq_ignore_ascii_case("start.epoch") && self.epoch_s.is_some() {
            self.check.report(place, "start.epoch beside a date in `start`", "one of them");
        }
        let value = self.value(place, written)?;
        Some(self.at(place, (name, value)))
    }

    /// What `--set` would take.
    fn value(&mut self, place: &Place, written: &Written) -> Option<String> {
        let value = written.setting();
        if value.is_none() {
            let allowed = "a number, a string, true or false, a list; the name of a variable stands in quotes as a whole";
            self.check.report(place, "a table", allowed);
        }
        value
    }

    fn inputs(&mut self, place: &Place, written: Written) -> Option<Inputs> {
        let table = match written {
            Written::Text(path) => return Some(Inputs::File(self.input_file(place, &path))),
            Written::Table(table) => table,
            other => {
                self.check.report(place, other, "a CSV file, or a table of inputs by name");
                return None;
            }
        };
        let mut inputs = Vec::new();
        for (name, written) in table {
            let at = place.key(&name);
            let rows = match &written {
                Written::List(rows) if rows.iter().any(|row| matches!(row, Written::List(_))) => {
                    self.rows(&at, rows)
                }
                constant => vec![(0.0, self.value(&at, constant).unwrap_or_default())],
            };
            inputs.push(self.at(&at, (name, rows)));
        }
        Some(Inputs::Rows(inputs))
    }

    fn rows(&mut self, place: &Place, written: &[Written]) -> InputRows {
        let mut rows = InputRows::new();
        for (i, row) in written.iter().enumerate() {
            let at = place.item(i);
            let Written::List(row) = row else {
                self.check.report(&at, row, "a list of a time and a value: [\"10 min\", 0.5]");
                continue;
            };
            let [time, values @ ..] = row.as_slice() else {
                self.check.report(&at, "an empty list", "a list of a time and a value: [\"10 min\", 0.5]");
                continue;
            };
            let Some(time_s) = self.time(&at.item(0), time) else { continue };
            if rows.last().is_some_and(|(before_s, _)| time_s < *before_s) {
                self.check.report(
                    &at.item(0),
                    format_args!("{time}, before the row above"),
                    "a time that does not fall",
                );
            }
            let values = Written::List(values.to_vec());
            if let Some(value) = self.value(&at, &values) {
                rows.push((time_s, value));
            }
        }
        rows
    }

    fn limit(&mut self, place: &Place, name: String, limit: LimitDescription) -> At<Bounds> {
        if limit.min.is_none() && limit.max.is_none() && !self.check.has_stand_in(place) {
            self.check.report(place, "no bound", "min, max or both");
        }
        let mut bound = |key: &str, written: &Option<Written>| match written.as_ref()? {
            number @ (Written::Number(_) | Written::Integer(_) | Written::Text(_)) => number.setting(),
            other => {
                self.check.report(&place.key(key), other, "a number in SI, or a string with a unit");
                None
            }
        };
        let (min, max) = (bound("min", &limit.min), bound("max", &limit.max));
        self.at(place, Bounds { name, min, max })
    }

    /// A time that passes.
    fn span(&mut self, place: &Place, written: Option<&Written>) -> Option<f64> {
        let written = written?;
        let span_s = written.setting().and_then(|text| values::span(&text).ok());
        if span_s.is_none() {
            self.check.report(place, written, format_args!("a time above 0: {ALLOWED_TIME}"));
        }
        span_s
    }

    /// Simulation time, or a date where `start` is one.
    fn time(&mut self, place: &Place, written: &Written) -> Option<f64> {
        if let Some(read) = date(written) {
            let epoch_s = self.checked_date(place, written, read)?;
            if self.epoch_s.is_none() {
                let allowed = format!("simulation time, {ALLOWED_TIME}; or a date, where `start` is one");
                self.check.report_across(
                    &Place::root().key("start"),
                    place,
                    format_args!("the date {written}"),
                    allowed,
                );
            }
            return self.epoch_s.map(|zero_s| dates::span_s(zero_s, epoch_s));
        }
        let number = matches!(written, Written::Number(_) | Written::Integer(_) | Written::Text(_));
        let time_s = written.setting().filter(|_| number).and_then(|text| values::duration(&text).ok());
        if time_s.is_none() {
            self.check.report(
                place,
                written,
                format_args!("{ALLOWED_DATE}; or simulation time, {ALLOWED_TIME}"),
            );
        }
        time_s
    }

    fn checked_date(
        &mut self,
        place: &Place,
        written: &Written,
        read: Result<f64, dates::DateError>,
    ) -> Option<f64> {
        read.map_err(|error| self.check.report(place, format_args!("{written}, {error}"), ALLOWED_DATE)).ok()
    }
}

/// The epoch, if it looks like a date.
fn date(written: &Written) -> Option<Result<f64, dates::DateError>> {
    let Written::Text(text) = written else { return None };
    let ends = ["UTC", "TDB"].iter().any(|scale| text.trim_end().ends_with(scale));
    (ends || dates::looks_like_date(text)).then(|| dates::epoch_s(text))
}
