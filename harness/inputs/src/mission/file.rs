//! A mission, from its file: times, paths, values and names by the line that they stand in.

use std::path::{Path, PathBuf};

use physics::{
    environment::dates::{self, ALLOWED_DATE},
    toml::Place,
};

use super::description::{LimitDescription, MissionDescription, PlotDescription};
use crate::{
    ending::check_ending,
    kind::FileKind,
    reading::{self, At, Builder, Written},
    values,
};

/// Form of a duration, for messages.
const ALLOWED_TIME: &str = "a number of s or one with a unit: 600, \"10 min\", \"0.5 h\", \"90 d\"";

/// The FMU or spacecraft.
#[derive(Clone, Debug, PartialEq)]
pub enum SpacecraftSource {
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
pub type InputRows = Vec<(f64, String)>;

/// Inputs over time.
#[derive(Clone, Debug, PartialEq)]
pub enum Inputs {
    /// A CSV file.
    File(PathBuf),
    /// By name.
    Rows(Vec<At<(String, InputRows)>>),
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// The SVG file.
    pub file: PathBuf,
    /// Variables that it shows; `None`: everything recorded.
    pub names: Option<Vec<At<String>>>,
}

/// Bounds of a variable, as they are written.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// The variable or vector.
    pub name: String,
    /// The smallest value that is kept.
    pub min: Option<String>,
    /// The largest.
    pub max: Option<String>,
}

/// A mission.
#[derive(Clone, Debug, PartialEq)]
pub struct Mission {
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
    /// Variables that are recorded; `None`: every output.
    pub record: Option<Vec<At<String>>>,
    /// The CSV file.
    pub output: Option<PathBuf>,
    /// Pictures.
    pub plots: Vec<Plot>,
    /// Values by name, as `--set` takes them.
    pub sets: Vec<At<(String, String)>>,
    /// Inputs over time.
    pub inputs: Option<Inputs>,
    /// Limits by which the run is judged.
    pub limits: Vec<At<Bounds>>,
}

impl Mission {
    /// Reads a mission.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, String> {
        let text = FileKind::Mission.read(file)?;
        if FileKind::recognize(&text).is_none() {
            return Err(format!(
                "{}: found a file without any key of a mission, allowed: spacecraft = \"my.toml\" or fmu = \"My.fmu\", stop, step, \
                 record: see `heliotorque new mission`",
                file.display()
            ));
        }
        reading::parse(file, &text, |builder, it| builder.mission(file, it))
    }

    /// The files that it names and reads.
    pub fn reads(&self) -> Vec<&Path> {
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
}

impl Builder<'_> {
    fn mission(&mut self, file: &Path, description: MissionDescription) -> Mission {
        let root = self.root.clone();
        let spacecraft_source = self.spacecraft_source(&description);
        let [start, stop, step, every] = ["start", "stop", "step", "every"].map(|key| root.key(key));
        let (begin, end) = (description.start.as_deref(), description.stop.as_deref());
        let (epoch_s, start_s) = match begin.and_then(Written::date) {
            Some(date) => (self.checked_date(&start, date), Some(0.0)),
            None => (None, begin.and_then(|written| self.time(&start, written, None))),
        };
        let stop_s = end.and_then(|written| self.time(&stop, written, epoch_s));
        if let (Some(begin_s), Some(end_s), Some(begin), Some(end)) = (start_s, stop_s, begin, end)
            && end_s <= begin_s
        {
            let found = format_args!("{end}, not after `start`");
            stop.report(found, format_args!("a time after {begin}"));
        }
        let allowed_span = format!("a time above 0: {ALLOWED_TIME}");
        let plots = description.plot.unwrap_or_default().into_iter().enumerate();
        let sets = description.set.unwrap_or_default().into_iter();
        let limits = description.limits.unwrap_or_default().into_iter();
        Mission {
            file: file.to_owned(),
            spacecraft_source,
            epoch_s: epoch_s.map(|epoch_s| self.at(&start, epoch_s)),
            start_s,
            stop_s,
            step_s: self.read(&step, description.step.as_deref(), Written::span_s, &allowed_span),
            every_s: self.read(&every, description.every.as_deref(), Written::span_s, &allowed_span),
            record: description.record.map(|names| self.names(&root.key("record"), names)),
            output: description.output.map(|path| self.written_path(&root.key("output"), path)),
            plots: plots.map(|(i, plot)| self.plot(&root.key("plot").item(i), plot)).collect(),
            sets: sets
                .filter_map(|(name, written)| self.set(&root.key("set").key(&name), name, &written))
                .collect(),
            inputs: description.inputs.and_then(|it| self.inputs(&root.key("inputs"), it.0, epoch_s)),
            limits: limits
                .map(|(name, limit)| self.limit(&root.key("limits").key(&name), name, limit))
                .collect(),
        }
    }

    fn spacecraft_source(&mut self, description: &MissionDescription) -> SpacecraftSource {
        let root = self.root.clone();
        let MissionDescription { fmu, spacecraft, model, timeline, ephemeris, .. } = description;
        let Some(fmu) = fmu else {
            if spacecraft.is_none() && model.is_none() {
                root.report_lack("spacecraft",
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
            root.key(key).report(format_args!("`{key}` beside `fmu`"), allowed);
        }
        SpacecraftSource::Fmu(self.input_file(&root.key("fmu"), fmu))
    }

    fn input_file(&mut self, place: &Place<'_>, path: &str) -> PathBuf {
        let path = self.written_path(place, path.to_owned());
        if !path.as_os_str().is_empty() && !path.exists() {
            self.report_missing(place, &path);
        }
        path
    }

    fn written_path(&mut self, place: &Place<'_>, path: String) -> PathBuf {
        if path.is_empty() {
            place.report("an empty string", "the path of a file");
        }
        // The standard output.
        if path == "-" { PathBuf::from(path) } else { self.folder.join(path) }
    }

    fn names(&mut self, place: &Place<'_>, names: Vec<String>) -> Vec<At<String>> {
        if names.is_empty() {
            place.report("an empty list", "at least one name, or no such key: then every output");
        }
        self.each(place, names)
    }

    fn plot(&mut self, place: &Place<'_>, plot: PlotDescription) -> Plot {
        let key = place.key("file");
        let file = self.written_path(&key, plot.file);
        if check_ending(&file, "svg").is_err() {
            let found = format!("{}, no SVG file's name", file.display());
            key.report(found, "one that ends in .svg, or -");
        }
        Plot { file, names: plot.names.map(|names| self.names(&place.key("names"), names)) }
    }

    fn set(&mut self, place: &Place<'_>, name: String, written: &Written) -> Option<At<(String, String)>> {
        let value = self.value(place, written)?;
        Some(self.at(place, (name, value)))
    }

    /// Returns the text for `--set`.
    fn value(&mut self, place: &Place<'_>, written: &Written) -> Option<String> {
        let value = written.setting();
        if value.is_none() {
            let allowed = "a number, a string, true or false, a list; the name of a variable stands in quotes as a whole";
            place.report("a table", allowed);
        }
        value
    }

    fn inputs(&mut self, place: &Place<'_>, written: Written, zero_epoch_s: Option<f64>) -> Option<Inputs> {
        let table = match written {
            Written::Text(path) => return Some(Inputs::File(self.input_file(place, &path))),
            Written::Table(table) => table,
            other => {
                place.report(other, "a CSV file, or a table of inputs by name");
                return None;
            }
        };
        let mut inputs = Vec::new();
        for (name, written) in table {
            let at = place.key(&name);
            let rows = match &written {
                Written::List(rows) if rows.iter().any(|row| matches!(row, Written::List(_))) => {
                    self.rows(&at, rows, zero_epoch_s)
                }
                constant => vec![(0.0, self.value(&at, constant).unwrap_or_default())],
            };
            inputs.push(self.at(&at, (name, rows)));
        }
        Some(Inputs::Rows(inputs))
    }

    fn rows(&mut self, place: &Place<'_>, written: &[Written], zero_epoch_s: Option<f64>) -> InputRows {
        let mut rows = InputRows::new();
        for (i, row) in written.iter().enumerate() {
            let at = place.item(i);
            let Written::List(row) = row else {
                at.report(row, "a list of a time and a value: [\"10 min\", 0.5]");
                continue;
            };
            let [time, values @ ..] = row.as_slice() else {
                at.report("an empty list", "a list of a time and a value: [\"10 min\", 0.5]");
                continue;
            };
            let Some(time_s) = self.time(&at.item(0), time, zero_epoch_s) else { continue };
            if rows.last().is_some_and(|(before_s, _)| time_s < *before_s) {
                let found = format_args!("{time}, before the row above");
                at.item(0).report(found, "a time that does not fall");
            }
            let values = Written::List(values.to_vec());
            if let Some(value) = self.value(&at, &values) {
                rows.push((time_s, value));
            }
        }
        rows
    }

    fn limit(&mut self, place: &Place<'_>, name: String, limit: LimitDescription) -> At<Bounds> {
        if limit.min.is_none() && limit.max.is_none() {
            place.report("no bound", "min, max or both");
        }
        let mut bound = |key: &str, written: Option<&Written>| {
            let allowed = "a number in SI, or a string with a unit";
            self.read(&place.key(key), written, Written::scalar, allowed)
        };
        let (min, max) = (bound("min", limit.min.as_deref()), bound("max", limit.max.as_deref()));
        self.at(place, Bounds { name, min, max })
    }

    /// Simulation time; or a date, where `start` is one, the epoch of time 0.
    fn time(&mut self, place: &Place<'_>, written: &Written, zero_epoch_s: Option<f64>) -> Option<f64> {
        if let Some(date) = written.date() {
            let epoch_s = self.checked_date(place, date)?;
            if zero_epoch_s.is_none() && !self.root.key("start").has_stand_in() {
                let found = format_args!("the date {written}");
                let allowed = format!("simulation time, {ALLOWED_TIME}; or a date, where `start` is one");
                place.report(found, allowed);
            }
            return zero_epoch_s.map(|zero_s| dates::span_s(zero_s, epoch_s));
        }
        let time_s = |written: &Written| values::duration(&written.scalar()?).ok();
        let allowed = format_args!("{ALLOWED_DATE}; or simulation time, {ALLOWED_TIME}");
        self.read(place, Some(written), time_s, allowed)
    }

    fn checked_date(&mut self, place: &Place<'_>, date: &str) -> Option<f64> {
        let read = dates::epoch_s(date);
        read.map_err(|error| place.report(format_args!("{date:?}, {error}"), ALLOWED_DATE)).ok()
    }
}
