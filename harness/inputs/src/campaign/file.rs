//! A campaign, from its file: what varies and what is kept, by the line that it stands in.

use std::path::{Path, PathBuf};

use physics::toml::Place;

use super::description::{CampaignDescription, KeepDescription, SamplingWord, VaryDescription};
use crate::{
    home,
    kind::FileKind,
    reading::{self, At, Builder, Written},
};

const ALLOWED_SPAN: &str = "a time above 0, a number of s or one with a unit: 600, \"10 d\"";
const ALLOWED_TIME: &str = "a number of s or one with a unit: 600, \"10 d\"";

/// A key of `vary.NAME`, how many numbers it takes, and what they are.
type DistributionKey = (&'static str, Option<usize>, &'static str);
const DISTRIBUTIONS: [DistributionKey; 6] = [
    ("normal", Some(2), "mean and standard deviation"),
    ("uniform", Some(2), "the smallest and the largest value"),
    ("logUniform", Some(2), "the smallest and the largest value, above 0"),
    ("triangular", Some(3), "the smallest value, the most likely one, the largest one"),
    ("values", None, "at least one value"),
    ("steps", Some(3), "from, to and how many"),
];

/// How a variable varies, as it is written.
#[derive(Clone, Debug)]
pub struct WrittenDistribution {
    /// The variable.
    pub name: String,
    /// The key.
    pub key: &'static str,
    /// Its values, as `--set` takes them.
    pub values: Vec<String>,
}

/// Results that are kept.
#[derive(Clone, Debug)]
pub struct WrittenKeep {
    /// The final values; `None` without `[keep]`: then of all outputs.
    pub finals: Option<Vec<At<String>>>,
    /// Extremes.
    pub extremes: Vec<At<String>>,
    /// Percentiles over time.
    pub percentiles: Vec<At<String>>,
    /// Time between their rows.
    pub every_s: Option<f64>,
    /// The folder of tables over time.
    pub histories: Option<At<PathBuf>>,
}

/// A campaign file.
#[derive(Clone, Debug)]
pub struct CampaignFile {
    /// As the caller named it.
    pub file: PathBuf,
    /// Its text.
    pub text: String,
    /// The mission or the FMU.
    pub simulated: PathBuf,
    /// Start time, in s.
    pub start_s: Option<f64>,
    /// Stop time, in s.
    pub stop_s: Option<f64>,
    /// Communication step, in s.
    pub step_s: Option<f64>,
    /// Number of runs, where it is written.
    pub runs: Option<At<u64>>,
    /// Seed of the draws.
    pub seed: u64,
    /// Kind of sampling.
    pub sampling: At<SamplingWord>,
    /// Table of values, for sampling from a file.
    pub table: Option<PathBuf>,
    /// Two names and the coefficient of correlation of their values.
    pub correlations: Vec<At<([String; 2], f64)>>,
    /// Variables that vary, with their distributions.
    pub vary: Vec<At<WrittenDistribution>>,
    /// Results that are kept of each run.
    pub keep: WrittenKeep,
}

impl CampaignFile {
    /// Reads a campaign.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, String> {
        let text = FileKind::Campaign.read(file)?;
        let campaign = reading::parse(file, &text, |builder, it| builder.campaign(file, it))?;
        Ok(Self { text, ..campaign })
    }

    /// A problem at a place of the file.
    pub fn problem<T>(&self, at: &At<T>, what: &str) -> String {
        at.problem(&self.file, what)
    }
}

impl Builder<'_> {
    fn campaign(&mut self, file: &Path, description: CampaignDescription) -> CampaignFile {
        let root = self.root.clone();
        let simulated = self.simulated(&description);
        let sampling = description.sampling.unwrap_or_default();
        let table = description.file.as_ref().map(|path| self.path(&root.key("file"), path, Path::exists));
        self.one_sampling(&description, sampling);
        let vary = description.vary.unwrap_or_default().into_iter();
        let vary =
            vary.filter_map(|(name, it)| self.varied(&root.key("vary").key(&name), name, &it)).collect();
        let correlations = description.correlation.unwrap_or_default();
        let correlations = correlations.iter().enumerate();
        let correlations = correlations
            .filter_map(|(k, it)| self.correlation(&root.key("correlation").item(k), it))
            .collect();
        let [start, stop, step, runs] = ["start", "stop", "step", "runs"].map(|key| root.key(key));
        let count = self.count(&runs, description.runs.as_deref(), 1);
        let seed = self.count(&root.key("seed"), description.seed.as_deref(), 0);
        CampaignFile {
            file: file.to_owned(),
            text: String::new(),
            simulated,
            start_s: self.read(&start, description.start.as_deref(), Written::duration_s, ALLOWED_TIME),
            stop_s: self.read(&stop, description.stop.as_deref(), Written::duration_s, ALLOWED_TIME),
            step_s: self.read(&step, description.step.as_deref(), Written::span_s, ALLOWED_SPAN),
            runs: count.map(|count| self.at(&runs, count)),
            seed: seed.unwrap_or(0),
            sampling: self.at(&root.key("sampling"), sampling),
            table,
            correlations,
            vary,
            keep: self.keep(description.keep),
        }
    }

    fn simulated(&mut self, description: &CampaignDescription) -> PathBuf {
        let root = self.root.clone();
        match (&description.mission, &description.fmu) {
            (Some(mission), None) => {
                for (key, it) in [("start", &description.start), ("stop", &description.stop)] {
                    if it.is_some() {
                        let found = format!("`{key}` beside `mission`");
                        root.key(key).report(found, "the mission's own");
                    }
                }
                self.path(&root.key("mission"), mission, Path::exists)
            }
            (None, Some(fmu)) => {
                // A shipped FMU, wherever the file is.
                let found = home::found(self.folder.join(fmu));
                if found.exists() { found } else { self.path(&root.key("fmu"), fmu, Path::exists) }
            }
            (None, None) => {
                let allowed = "mission = \"mission.toml\", or fmu = \"My.fmu\" with stop and step";
                root.report_lack("mission", allowed);
                PathBuf::new()
            }
            (Some(_), Some(_)) => {
                root.key("fmu").report("`fmu` beside `mission`", "one of them");
                PathBuf::new()
            }
        }
    }

    /// Values come from `vary` or from a file.
    fn one_sampling(&mut self, description: &CampaignDescription, sampling: SamplingWord) {
        let root = self.root.clone();
        if sampling == SamplingWord::File {
            if description.file.is_none() {
                root.report_lack("file", "file = \"table.csv\" with sampling file");
            }
            if description.vary.is_some() {
                root.key("vary").report("`vary` beside sampling file", "one of them");
            }
        } else {
            if description.file.is_some() {
                let found = "`file` with another sampling";
                root.key("file").report(found, "sampling = \"file\", or no `file`");
            }
            if description.vary.is_none() {
                root.report_lack("vary", "a table [vary] with at least one variable");
            }
        }
    }

    fn varied(
        &mut self,
        place: &Place<'_>,
        name: String,
        description: &VaryDescription,
    ) -> Option<At<WrittenDistribution>> {
        let VaryDescription { normal, uniform, log_uniform, triangular, values, steps } = description;
        let given = [normal, uniform, log_uniform, triangular, values, steps];
        let given: Vec<_> =
            DISTRIBUTIONS.iter().zip(given).filter_map(|(key, list)| Some((key, list.as_ref()?))).collect();
        let [((key, count, meaning), list)] = given[..] else {
            let found: Vec<&str> = given.iter().map(|((key, ..), _)| *key).collect();
            let found = if found.is_empty() { "no distribution".to_owned() } else { found.join(" and ") };
            let allowed = DISTRIBUTIONS.map(|(key, ..)| key).join(", ");
            place.report(found, format_args!("one of {allowed}"));
            return None;
        };
        if count.is_some_and(|count| count != list.len()) || list.is_empty() {
            let found = format!("a list of {}", list.len());
            place.key(key).report(found, format_args!("{meaning}"));
            return None;
        }
        let texts: Option<Vec<String>> =
            list.iter().map(|it| it.setting().filter(|_| !matches!(it, Written::List(_)))).collect();
        let Some(values) = texts else {
            place.key(key).report("a list in the list", meaning);
            return None;
        };
        Some(self.at(&place.key(key), WrittenDistribution { name, key, values }))
    }

    fn correlation(&mut self, place: &Place<'_>, written: &Written) -> Option<At<([String; 2], f64)>> {
        if let Written::List(items) = written
            && let [Written::Text(one), Written::Text(other), coefficient] = &items[..]
            && let Some(coefficient) = coefficient.number().filter(|it| it.abs() <= 1.0)
        {
            return Some(self.at(place, ([one.clone(), other.clone()], coefficient)));
        }
        let allowed = "two names and a coefficient from -1 to 1: [\"a\", \"b\", 0.5]";
        place.report(written, allowed);
        None
    }

    fn keep(&mut self, description: Option<KeepDescription>) -> WrittenKeep {
        let place = self.root.clone().key("keep");
        let is_given = description.is_some();
        let KeepDescription { r#final, extremes, percentiles, every, histories } =
            description.unwrap_or_default();
        if let (Some(written), None) = (every.as_deref(), &percentiles) {
            place.key("every").report(written, "`every` beside `percentiles`");
        }
        let names =
            |key: &str, names: Option<Vec<String>>| self.each(&place.key(key), names.unwrap_or_default());
        let finals = is_given.then(|| names("final", r#final));
        let (extremes, percentiles) = (names("extremes", extremes), names("percentiles", percentiles));
        WrittenKeep {
            finals,
            extremes,
            percentiles,
            every_s: self.read(&place.key("every"), every.as_deref(), Written::span_s, ALLOWED_SPAN),
            histories: histories.map(|path| self.at(&place.key("histories"), self.folder.join(path))),
        }
    }
}
