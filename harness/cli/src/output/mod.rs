//! The outputs of `heliotorque run`: one file a format, behind one trait.

mod csv;
mod exporter;
mod known;
mod shown;
mod summary;
mod svg;
mod svg_path;

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

pub use known::Known;
pub use shown::Shown;
pub use svg::is_lit_fraction;
pub use svg_path::{check_path as check_svg_path, is_svg_path};

/// A picture of a run.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The SVG file.
    pub path: PathBuf,
    /// The variables that it shows; `None`: everything recorded.
    pub names: Option<Vec<String>>,
    /// What gave it.
    pub option: &'static str,
}

/// Every output of a run.
pub struct Outputs {
    exporters: Vec<Box<dyn Exporter>>,
    /// Files that will be written.
    files: Vec<PathBuf>,
    /// Whether the last values are told: without a file the summary has them.
    says_last: bool,
    /// How many of the recording's columns were asked for, the first ones; more is for the pictures.
    columns: usize,
}

impl Outputs {
    /// The outputs that the arguments name, and pictures, their files opened; without any, a summary on the terminal.
    /// Tables have the first `columns` of what is recorded; `inputs` are not written over.
    pub fn open(
        arguments: &Run,
        plots: &[Plot],
        columns: usize,
        known: &Known,
        inputs: &[&Path],
    ) -> Result<Self, String> {
        let csv = arguments.output.as_deref().map(|path| Destination::open(path, "--output", inputs));
        let csv = csv.transpose()?;
        let mut pictures: Vec<Destination> = Vec::new();
        for plot in plots {
            let svg = Destination::open(&plot.path, plot.option, inputs)?;
            if csv.as_ref().is_some_and(|csv| csv.is_same(&svg)) {
                return Err(format!("one file cannot take both: see --output and {}", plot.option));
            }
            if pictures.iter().any(|other| other.is_same(&svg)) {
                return Err(format!(
                    "{}: one file cannot take two pictures: see {}",
                    plot.path.display(),
                    plot.option
                ));
            }
            pictures.push(svg);
        }
        let named = plots.iter().map(|plot| &plot.path).zip(&pictures);
        let named = arguments.output.iter().zip(&csv).chain(named);
        let files = named.filter(|(_, file)| !file.is_stdout()).map(|(path, _)| path.clone()).collect();
        let says_last = !arguments.quiet && (csv.is_some() || !pictures.is_empty());
        let mut exporters: Vec<Box<dyn Exporter>> = Vec::new();
        if let Some(csv) = csv {
            exporters.push(Box::new(Csv::new(csv.grow(inputs)?, columns)));
        }
        for (svg, plot) in pictures.into_iter().zip(plots) {
            exporters.push(Box::new(Svg::new(svg, plot.names.clone(), known.clone())));
        }
        if exporters.is_empty() && !arguments.quiet {
            exporters.push(Box::new(Summary));
        }
        Ok(Self { exporters, files, says_last, columns })
    }

    /// Shows every output the recording so far.
    pub fn update(&mut self, recording: &Recording) -> Result<(), String> {
        self.exporters.iter_mut().try_for_each(|output| output.update(recording))
    }

    /// Whether the reader of the standard output went away.
    pub fn has_lost_reader(&self) -> bool {
        self.exporters.iter().any(|output| output.has_lost_reader())
    }

    /// Completes every output and says what was written and the last values.
    pub fn finish(self, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        self.exporters.into_iter().try_for_each(|output| output.finish(described, recording))?;
        if self.says_last {
            terminal::note(&last_values(described, &recording.leading(self.columns)));
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
