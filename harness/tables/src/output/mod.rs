//! The outputs of `heliotorque run`: one file a format, behind one trait.

pub mod csv;
pub mod date_axis;
pub mod display_context;
pub mod display_form;
pub mod exporter;
pub mod file;
pub mod limits;
pub mod origin;
pub mod overwrite;
pub mod scales;
pub mod summary;
pub mod svg;
pub mod time_axis;

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use files::{Destination, sidecar_of};
use fmi::Recording;
use model_description::Description;

use csv::Csv;
use exporter::Exporter;
use summary::Summary;
use svg::Svg;

pub use display_context::DisplayContext;
pub use file::OutputFile;
pub use limits::LimitChecks;
pub use origin::{EPOCH_KEY, Origin, set_identity, set_times};
pub use overwrite::{OutputKind, check as check_standing, open_beside};
pub use svg::{chart, leave_out, panel, shade_eclipses};
pub use time_axis::TimeAxis;

/// A picture of a run.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The SVG file.
    pub file: OutputFile,
    /// The variables that it shows; `None`: everything recorded.
    pub names: Option<Vec<String>>,
}

/// Requested outputs of a run.
#[derive(Clone, Debug)]
pub struct Requested {
    /// The CSV file.
    pub table: Option<OutputFile>,
    /// Pictures.
    pub plots: Vec<Plot>,
    /// How many of the recording's columns were requested, the first ones; more is for the pictures.
    pub columns: usize,
    /// Whether no summary is requested.
    pub is_quiet: bool,
}

/// Every output of a run.
pub struct Outputs {
    exporters: Vec<Box<dyn Exporter>>,
    /// Files that will be written.
    files: Vec<PathBuf>,
    /// Whether the summary is printed beside the files: without one it is printed.
    sums_up: bool,
    /// How many of the recording's columns were requested, the first ones; more is for the pictures.
    columns: usize,
}

impl Outputs {
    /// Everything requested, its files opened; without any, a summary on the terminal. `empty` is the recording before its first row,
    /// `origin` what stands beside a table; `inputs` are not written over.
    pub fn open(
        requested: &Requested,
        empty: &Recording,
        context: &DisplayContext,
        (origin, inputs): (&Origin<'_>, &[&Path]),
    ) -> Result<Self, String> {
        let Requested { table, plots, columns, is_quiet } = requested;
        let open = |file: &OutputFile, kind: OutputKind<'_>| {
            let destination = Destination::open(&file.path, file.option, inputs)?;
            overwrite::check(file, &destination, kind)?;
            Ok::<_, String>(destination)
        };
        let mut header = Vec::new();
        fmi::csv::write_header(empty, *columns, &mut header).map_err(|error| error.to_string())?;
        let csv = table.as_ref().map(|file| open(file, OutputKind::Table(&header))).transpose()?;
        // Nothing stands beside the standard output.
        let beside = table.as_ref().zip(csv.as_ref().filter(|csv| !csv.is_stdout())).map(|(table, _)| {
            let file = OutputFile { path: sidecar_of(&table.path), ..table.clone() };
            let names = &empty.names[..(*columns).min(empty.names.len())];
            Ok::<_, String>((open(&file, OutputKind::Origin)?, origin.to_toml(names)))
        });
        let beside = beside.transpose()?;
        let mut pictures: Vec<Destination> = Vec::new();
        for Plot { file, .. } in plots {
            let svg = open(file, OutputKind::Picture)?;
            if csv.as_ref().is_some_and(|csv| csv.is_same(&svg)) {
                return Err(format!(
                    "{}: one file cannot take table and picture: see {}",
                    file.path.display(),
                    file.option
                ));
            }
            if pictures.iter().any(|other| other.is_same(&svg)) {
                let path = file.path.display();
                return Err(format!("{path}: one file cannot take two pictures: see {}", file.option));
            }
            pictures.push(svg);
        }
        let named = plots.iter().map(|plot| &plot.file).zip(&pictures);
        let named = table.iter().zip(&csv).chain(named);
        let files =
            named.filter(|(_, opened)| !opened.is_stdout()).map(|(file, _)| file.path.clone()).collect();
        let sums_up = !is_quiet && (csv.is_some() || !pictures.is_empty());
        let mut exporters: Vec<Box<dyn Exporter>> = Vec::new();
        if let Some(csv) = csv {
            exporters.push(Box::new(Csv::new(csv.grow(inputs)?, *columns, beside)));
        }
        for (svg, plot) in pictures.into_iter().zip(plots) {
            exporters.push(Box::new(Svg { file: svg, names: plot.names.clone(), context: context.clone() }));
        }
        if exporters.is_empty() && !is_quiet {
            exporters.push(Box::new(Summary));
        }
        Ok(Self { exporters, files, sums_up, columns: *columns })
    }

    /// Shows every output the recording so far.
    pub fn update(&mut self, recording: &Recording) -> Result<(), String> {
        self.exporters.iter_mut().try_for_each(|output| output.update(recording))
    }

    /// Whether the reader of the standard output went away.
    pub fn has_lost_reader(&self) -> bool {
        self.exporters.iter().any(|output| output.has_lost_reader())
    }

    /// Completes every output, sums up and says what was written.
    pub fn finish(self, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        self.exporters.into_iter().try_for_each(|output| output.finish(described, recording))?;
        if self.sums_up {
            terminal::note(&summary::beside_files(described, &recording.leading(self.columns)));
            for file in &self.files {
                terminal::note(&format!("wrote {}", file.display()));
            }
        }
        Ok(())
    }

    /// After a run that ended before its stop: what would replace a file is kept beside it instead, whose names are given, the
    /// rest completed.
    pub fn stop(
        self,
        described: &Description,
        recording: &Recording,
    ) -> Result<Vec<PathBuf>, Box<dyn Error>> {
        let Self { exporters, mut files, sums_up, columns } = self;
        let (beside, complete): (Vec<_>, Vec<_>) =
            exporters.into_iter().partition(|output| output.existing().is_some());
        let kept = beside.into_iter().filter_map(|output| output.leave(described, recording)).collect();
        files.retain(|file| !file.exists());
        Self { exporters: complete, files, sums_up, columns }.finish(described, recording)?;
        Ok(kept)
    }

    /// Keeps what there is after a simulation that failed; the names of the files in progress.
    pub fn leave(self, described: &Description, recording: &Recording) -> Vec<PathBuf> {
        self.exporters.into_iter().filter_map(|output| output.leave(described, recording)).collect()
    }
}
