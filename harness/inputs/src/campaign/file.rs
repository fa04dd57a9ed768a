//! A campaign, from its file.

use std::path::{Path, PathBuf};

use files::outcome::Refusal;
use physics::toml::Place;

use super::keys::{CampaignKeys, CampaignValues, SamplingWord, Vary};
use crate::{
    kind::FileKind,
    reading::{self, At, InFile},
};

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
#[derive(Clone, Copy, Debug)]
pub struct WrittenDistribution<'a> {
    /// The variable.
    pub name: &'a str,
    /// The key.
    pub key: &'static str,
    /// Its values, as `--set` takes them.
    pub values: &'a [String],
}

/// A campaign file.
pub type CampaignFile = InFile<CampaignValues>;

impl CampaignFile {
    /// Reads a campaign.
    ///
    /// # Errors
    /// A file that cannot be read; everything wrong in it with line, key, what was found and what is allowed.
    pub fn read(file: &Path) -> Result<Self, Refusal> {
        reading::read(FileKind::Campaign, file, judge)
    }
}

impl CampaignValues {
    /// The mission or the FMU.
    pub fn simulated(&self) -> &Path {
        self.mission.as_deref().or(self.fmu.as_deref()).unwrap_or(Path::new(""))
    }

    /// The folder of tables over time.
    pub fn histories(&self) -> Option<&At<PathBuf>> {
        self.keep.as_ref()?.histories.as_ref()
    }

    /// Variables that vary, with their distributions.
    pub fn distributions(&self) -> impl Iterator<Item = At<WrittenDistribution<'_>>> {
        self.vary.iter().filter_map(|at| {
            let (name, vary) = &at.it;
            let ((key, ..), values) = vary.given().next()?;
            Some(values.with(WrittenDistribution { name, key, values: &values.it }))
        })
    }
}

impl Vary {
    /// Distributions that the file gives.
    fn given(&self) -> impl Iterator<Item = (DistributionKey, &At<Vec<String>>)> {
        let Self { normal, uniform, log_uniform, triangular, values, steps } = self;
        let given = [normal, uniform, log_uniform, triangular, values, steps];
        DISTRIBUTIONS.into_iter().zip(given).filter_map(|(key, values)| Some((key, values.as_ref()?)))
    }
}

/// Reports values that come from several sources or none, and distributions with another count of numbers.
fn judge(keys: &CampaignKeys, campaign: &CampaignValues, root: &Place<'_>) {
    if campaign.sampling == SamplingWord::File {
        if keys.file.is_none() {
            root.report_lack("file", "file = \"table.csv\" with sampling file");
        }
        if keys.vary.is_some() {
            root.key("vary").report("`vary` beside sampling file", "one of them");
        }
    } else {
        if keys.file.is_some() {
            root.key("file").report("`file` with another sampling", "sampling = \"file\", or no `file`");
        }
        if keys.vary.is_none() {
            root.report_lack("vary", "a table [vary] with at least one variable");
        }
    }
    for at in &campaign.vary {
        let (name, vary) = &at.it;
        let place = root.key("vary").key(name);
        let given: Vec<_> = vary.given().collect();
        let [((key, count, meaning), values)] = given[..] else {
            let found: Vec<&str> = given.iter().map(|((key, ..), _)| *key).collect();
            let found = if found.is_empty() { "no distribution".to_owned() } else { found.join(" and ") };
            place.report(found, format_args!("one of {}", DISTRIBUTIONS.map(|(key, ..)| key).join(", ")));
            continue;
        };
        let key = place.key(key);
        let is_wrong = count.map_or(values.it.is_empty(), |count| count != values.it.len());
        if is_wrong && !key.has_reported() {
            key.report(format_args!("a list of {}", values.it.len()), meaning);
        }
    }
}
