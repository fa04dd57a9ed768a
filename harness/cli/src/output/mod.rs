//! The outputs of `heliotorque run`: one file a format, behind one trait.

mod csv;
mod exporter;
mod shown;
mod summary;
mod svg;

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use files::Destination;
use loader::Recording;
use model_description::Description;

use crate::args::Run;
use csv::Csv;
use exporter::Exporter;
use summary::{Summary, last_values};
use svg::Svg;

pub use svg::check_path as check_svg_path;

/// Every output of a run.
pub struct Outputs {
    exporters: Vec<Box<dyn Exporter>>,
    /// Files that will be written.
    files: Vec<PathBuf>,
    /// Whether the last values are told: without a file the summary has them.
    says_last: bool,
}

impl Outputs {
    /// The outputs that the arguments name, their files opened; without any, a summary on the terminal.
    pub fn open(arguments: &Run) -> Result<Self, String> {
        let inputs: Vec<&Path> =
            [arguments.fmu.as_path()].into_iter().chain(arguments.input.as_deref()).collect();
        let open = |path: &Option<PathBuf>, option| {
            path.as_deref().map(|path| Destination::open(path, option, &inputs)).transpose()
        };
        let (csv, svg) = (open(&arguments.output, "--output")?, open(&arguments.plot, "--plot")?);
        if let (Some(csv), Some(svg)) = (&csv, &svg)
            && csv.is_same(svg)
        {
            return Err("one file cannot take both: see --output and --plot".to_owned());
        }
        let named = arguments.output.iter().zip(&csv).chain(arguments.plot.iter().zip(&svg));
        let files = named.filter(|(_, file)| !file.is_stdout()).map(|(path, _)| path.clone()).collect();
        let says_last = !arguments.quiet && (csv.is_some() || svg.is_some());
        let mut exporters: Vec<Box<dyn Exporter>> = Vec::new();
        if let Some(csv) = csv {
            exporters.push(Box::new(Csv::new(csv.grow(&inputs)?)));
        }
        if let Some(svg) = svg {
            exporters.push(Box::new(Svg::new(svg)));
        }
        if exporters.is_empty() && !arguments.quiet {
            exporters.push(Box::new(Summary));
        }
        Ok(Self { exporters, files, says_last })
    }

    /// Shows every output the recording so far.
    pub fn update(&mut self, recording: &Recording) -> Result<(), String> {
        self.exporters.iter_mut().try_for_each(|output| output.update(recording))
    }

    /// Completes every output and says what was written and the last values.
    pub fn finish(self, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        self.exporters.into_iter().try_for_each(|output| output.finish(described, recording))?;
        if self.says_last {
            terminal::note(&last_values(described, recording));
            for file in &self.files {
                terminal::note(&format!("wrote {}", file.display()));
            }
        }
        Ok(())
    }

    /// Keeps what there is after a simulation that failed; the names of the files in progress.
    pub fn leave(self, described: &Description, recording: &Recording) -> Vec<PathBuf> {
        self.exporters.into_iter().filter_map(|output| output.leave(described, recording)).collect()
    }
}
