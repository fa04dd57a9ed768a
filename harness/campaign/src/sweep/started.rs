//! Campaign whose arguments were accepted, and how its runs ended.

use std::{ops::Range, path::Path};

use files::outcome::Answer;
use inputs::campaign::file::CampaignFile;
use model_description::Description;

use super::{options::Sweep, resolved::Campaign, worker::RunStatus};

/// Option that names the table.
pub(super) const OPTION: &str = "--output";

/// A campaign whose arguments were accepted.
pub(super) struct Started<'a> {
    pub arguments: &'a Sweep,
    pub file: &'a CampaignFile,
    pub campaign: &'a Campaign,
    pub described: &'a Description,
    pub runs: Range<u64>,
}

/// How many runs ended how.
#[derive(Default)]
pub(super) struct Counts([u64; RunStatus::ALL.len()]);

impl Started<'_> {
    /// Files that are read, so not written over.
    pub(super) fn inputs(&self) -> Vec<&Path> {
        let mut inputs = self.campaign.simulated.reads();
        inputs.push(&self.arguments.campaign);
        inputs.extend(self.file.table.as_deref());
        inputs
    }
}

impl Counts {
    pub(super) fn add(&mut self, status: RunStatus) {
        self.0[status as usize] += 1;
    }

    pub(super) fn status(&self) -> Answer {
        Answer::from(
            [RunStatus::Failed, RunStatus::Killed].iter().all(|status| self.0[*status as usize] == 0),
        )
    }

    pub(super) fn text(&self) -> String {
        let counts = RunStatus::ALL.iter().zip(self.0).filter(|(_, count)| *count > 0);
        counts.map(|(status, count)| format!("{count} {}", status.word())).collect::<Vec<_>>().join(", ")
    }
}
