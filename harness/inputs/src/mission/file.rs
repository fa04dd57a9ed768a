//! A mission, from its file.

use std::path::{Path, PathBuf};

use files::outcome::Refusal;
use physics::toml::Place;

use super::{
    inputs::{Inputs, InputsKey, check_time},
    keys::{MissionKeys, MissionValues},
};
use crate::{
    ending::check_ending,
    kind::FileKind,
    reading::{self, At, InFile},
    values::Instant,
};

/// A mission file.
pub type Mission = InFile<MissionValues>;

impl Mission {
    /// Reads a mission.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, Refusal> {
        Self::read_as(file, file)
    }

    /// Reads a mission that messages name by another file.
    ///
    /// # Errors
    /// The same.
    pub fn read_as(path: &Path, file: &Path) -> Result<Self, Refusal> {
        let text = files::read_text(path)?;
        FileKind::Mission.check(&file.display().to_string(), &text)?;
        if FileKind::recognize(&text).is_none() {
            return Err(format!(
                "{}: found a file without any key of a mission, allowed: spacecraft = \"my.toml\" or fmu = \"My.fmu\", stop, step, \
                 record: see `heliotorque new mission`",
                file.display()
            )
            .into());
        }
        reading::parse([file, path], text, judge)
    }

    /// The files that it names and reads.
    pub fn reads(&self) -> Vec<&Path> {
        let table = if let Some(Inputs::File(path)) = &self.inputs { Some(path) } else { None };
        let files =
            [self.fmu.as_ref(), self.spacecraft.as_ref(), self.timeline.as_ref(), self.ephemeris.as_ref()];
        files.into_iter().flatten().chain(table).map(PathBuf::as_path).chain([self.path.as_path()]).collect()
    }
}

impl MissionValues {
    /// The epoch of simulation time 0, where `start` is a date; in s past J2000 TDB.
    pub fn epoch_s(&self) -> Option<At<f64>> {
        let start = self.start.as_ref()?;
        if let Instant::Epoch(epoch_s) = start.it { Some(start.with(epoch_s)) } else { None }
    }

    /// Start, in s.
    pub fn start_s(&self) -> Option<f64> {
        match self.start.as_ref()?.it {
            Instant::Epoch(_) => Some(0.0),
            Instant::Time(time_s) => Some(time_s),
        }
    }

    /// Stop, in s.
    pub fn stop_s(&self) -> Option<f64> {
        self.stop.as_ref()?.it.time_s(self.epoch_s().map(|epoch| epoch.it))
    }
}

/// Reports times and inputs that do not fit the start, lists without names, and pictures of another kind than SVG.
fn judge(keys: &MissionKeys, mission: &MissionValues, root: &Place<'_>) {
    let zero_epoch_s = mission.epoch_s().map(|epoch| epoch.it);
    let end = root.key("stop");
    if let Some(stop) = &keys.stop {
        check_time(&stop.it, &end, zero_epoch_s);
    }
    if let (Some(start_s), Some(stop_s), Some(start), Some(stop)) =
        (mission.start_s(), mission.stop_s(), &keys.start, &keys.stop)
        && stop_s <= start_s
        && !end.has_reported()
    {
        end.report(format_args!("{}, not after `start`", stop.it), format_args!("a time after {}", start.it));
    }
    let check_names = |names: &Option<Vec<At<String>>>, at: Place<'_>| {
        if names.as_ref().is_some_and(Vec::is_empty) {
            at.report("an empty list", "at least one name, or no such key: then every output");
        }
    };
    check_names(&mission.record, root.key("record"));
    for (index, plot) in mission.plots.iter().enumerate() {
        let at = root.key("plot").item(index);
        check_names(&plot.names, at.key("names"));
        if check_ending(&plot.file, "svg").is_err() && !at.key("file").has_reported() {
            let found = format_args!("{}, no SVG file's name", plot.file.display());
            at.key("file").report(found, "one that ends in .svg, or -");
        }
    }
    if let Some(InputsKey::Columns(columns)) = &keys.inputs {
        for (name, column) in &columns.0 {
            column.it.read(zero_epoch_s, Some(&root.key("inputs").key(name)));
        }
    }
}
