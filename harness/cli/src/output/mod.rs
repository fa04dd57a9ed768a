//! The outputs of `heliotorque run`: one file a format, behind one trait.

mod csv;
mod exporter;
mod summary;
mod svg;

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use files::Destination;
use loader::{Fmu, Recording};

use crate::args::Run;
use csv::Csv;
use exporter::Exporter;
use summary::Summary;
use svg::Svg;

pub use svg::check_path as check_svg_path;

/// Every output of a run.
pub struct Outputs(Vec<Box<dyn Exporter>>);

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
        let mut outputs: Vec<Box<dyn Exporter>> = Vec::new();
        if let Some(csv) = csv {
            outputs.push(Box::new(Csv::new(csv.grow(&inputs)?)));
        }
        if let Some(svg) = svg {
            outputs.push(Box::new(Svg::new(svg)));
        }
        if outputs.is_empty() && !arguments.quiet {
            outputs.push(Box::new(Summary));
        }
        Ok(Self(outputs))
    }

    /// Shows every output the recording so far.
    pub fn update(&mut self, recording: &Recording) -> Result<(), String> {
        self.0.iter_mut().try_for_each(|output| output.update(recording))
    }

    /// Completes every output.
    pub fn finish(self, fmu: &Fmu, recording: &Recording) -> Result<(), Box<dyn Error>> {
        self.0.into_iter().try_for_each(|output| output.finish(fmu, recording))
    }

    /// Keeps what there is after a simulation that failed; the names of the files in progress.
    pub fn leave(self, fmu: &Fmu, recording: &Recording) -> Vec<PathBuf> {
        self.0.into_iter().filter_map(|output| output.leave(fmu, recording)).collect()
    }
}
