//! Variables that are recorded of every run of a campaign.

use inputs::{
    campaign::file::CampaignFile,
    mission::{Limit, in_file},
    reading::At,
};
use model_description::{BaseType, Description};

use crate::run::{Settings, Simulated};

/// Recorded variables of a run. Columns are positions in `positions`.
#[derive(Default)]
pub(super) struct RecordedColumns {
    /// Recorded variables, those of histories first.
    pub positions: Vec<usize>,
    /// Number of them in histories.
    pub histories: usize,
    /// Columns of final values.
    pub finals: Vec<usize>,
    /// Columns of extremes.
    pub extremes: Vec<usize>,
    /// Columns of percentiles.
    pub percentiles: Vec<usize>,
    /// Columns and their limits.
    pub limits: Vec<(usize, Limit)>,
}

impl RecordedColumns {
    /// Finds the variables of a campaign's `keep`, of its histories and limits.
    ///
    /// # Errors
    /// A name that the FMU does not have, or that of a text, by its line.
    pub(super) fn new(
        file: &CampaignFile,
        described: &Description,
        (simulated, settings): (&Simulated, &Settings),
    ) -> Result<Self, String> {
        let find = |names: &[At<String>]| positions(file, described, names);
        let histories = match (file.histories(), &simulated.mission) {
            (None, _) => Vec::new(),
            // What the mission records, its pictures and limits among it.
            (Some(_), Some(_)) => settings.positions.clone(),
            (Some(_), None) => fmi::outputs(described),
        };
        let mut kept = Self { histories: histories.len(), positions: histories, ..Self::default() };
        let is_number =
            |position: &usize| described.variables[*position].kind.base_type() != BaseType::String;
        let finals = match &file.keep {
            Some(keep) => find(&keep.finals)?,
            None => fmi::outputs(described).into_iter().filter(is_number).collect(),
        };
        kept.finals = finals.into_iter().map(|position| kept.column(position)).collect();
        if let Some(keep) = &file.keep {
            kept.extremes = find(&keep.extremes)?.into_iter().map(|it| kept.column(it)).collect();
            kept.percentiles = find(&keep.percentiles)?.into_iter().map(|it| kept.column(it)).collect();
        }
        for limit in &settings.limits {
            if let Some(position) = described.variables.iter().position(|it| it.name == limit.name) {
                let column = kept.column(position);
                kept.limits.push((column, limit.clone()));
            }
        }
        Ok(kept)
    }

    /// Whether every communication point counts.
    pub(super) fn needs_all_points(&self) -> bool {
        self.histories > 0
            || !(self.extremes.is_empty() && self.percentiles.is_empty() && self.limits.is_empty())
    }

    /// Names of the numbers that are kept of a run.
    pub(super) fn columns(&self, described: &Description) -> Vec<(String, usize)> {
        let name = |column: &usize| described.variables[self.positions[*column]].name.as_str();
        let finals = self.finals.iter().map(|it| (format!("{}.final", name(it)), *it));
        let extremes = self.extremes.iter().flat_map(|it| {
            ["min", "max", "largest", "timeOfLargest"].map(|what| (format!("{}.{what}", name(it)), *it))
        });
        finals.chain(extremes).collect()
    }

    /// Number of values recorded of a run.
    pub(super) fn count(&self) -> usize {
        self.finals.len() + 4 * self.extremes.len()
    }

    fn column(&mut self, position: usize) -> usize {
        self.positions.iter().position(|it| *it == position).unwrap_or_else(|| {
            self.positions.push(position);
            self.positions.len() - 1
        })
    }
}

/// Positions of everything that these names mean, each once.
fn positions(
    file: &CampaignFile,
    described: &Description,
    names: &[At<String>],
) -> Result<Vec<usize>, String> {
    let mut positions: Vec<usize> = Vec::new();
    for at in names {
        let found = fmi::select_outputs(described, &at.it)
            .map_err(|error| file.problem(at, &in_file(&at.key, error)))?;
        for position in found.into_iter().filter(|it| !positions.contains(it)).collect::<Vec<_>>() {
            let variable = &described.variables[position];
            if variable.kind.base_type() == BaseType::String {
                let found =
                    format!("found the text {:?}, allowed: numbers, options, Booleans", variable.name);
                return Err(file.problem(at, &found));
            }
            positions.push(position);
        }
    }
    Ok(positions)
}
