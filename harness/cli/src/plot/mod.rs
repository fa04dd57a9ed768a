//! `heliotorque plot`: pictures of tables, as `run` and campaigns write them.

mod options;

use std::path::{Path, PathBuf};

use drawing::Picture;
use files::{
    Destination,
    outcome::{self, Outcome},
};
use inputs::{ending::check_ending, values};
pub(crate) use options::Plot;
use tables::table::{Sidecar, TIME, Table};

/// Name of the picture of a table without a name.
const DEFAULT_NAME: &str = "plot";

/// Draws.
pub(crate) fn run(arguments: &Plot) -> Outcome {
    let first = arguments.files.first().map_or(Path::new(DEFAULT_NAME), PathBuf::as_path);
    let stem = first.file_stem().map_or(DEFAULT_NAME.into(), |stem| stem.to_string_lossy());
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}.svg")));
    check_ending(&path, "svg")?;
    let inputs: Vec<&Path> = arguments.files.iter().map(PathBuf::as_path).collect();
    let destination = Destination::open(&path, "--output", &inputs)?;
    let read = |path: &PathBuf| -> Result<(Table, Sidecar), String> {
        Ok((Table::read(path)?, Sidecar::beside(path)?))
    };
    let tables = arguments.files.iter().map(read).collect::<Result<Vec<_>, String>>()?;
    let pictures = pictures(arguments, &tables)?;
    let drawn: Vec<&dyn Picture> = pictures.iter().map(AsRef::as_ref).collect();
    let svg = drawing::svg(&drawn)?;
    let rows: usize = tables.iter().map(|(table, _)| table.keys.len()).sum();
    outcome::written(destination, svg.as_bytes(), &format!("{}: of {rows} rows", path.display()))
}

/// Requested pictures.
fn pictures(arguments: &Plot, tables: &[(Table, Sidecar)]) -> Result<Vec<Box<dyn Picture>>, String> {
    let one = |option: &str| match tables {
        [(table, sidecar)] => Ok((table, sidecar)),
        [_, (second, _), ..] => {
            Err(format!("{}: found a second table, allowed: one: see {option}", second.path.display()))
        }
        [] => Err(format!("found no table, allowed: one: see {option}")),
    };
    if !arguments.histogram.is_empty() {
        let (table, sidecar) = one("--histogram")?;
        let charts = tables::plot::runs::histograms(table, sidecar, &arguments.histogram)?;
        return Ok(charts.into_iter().map(|chart| Box::new(chart) as Box<dyn Picture>).collect());
    }
    if let Some(names) = &arguments.scatter {
        let (table, sidecar) = one("--scatter")?;
        return Ok(vec![Box::new(tables::plot::runs::scatter(table, sidecar, names)?)]);
    }
    if let Some(names) = &arguments.heat {
        let (table, sidecar) = one("--heat")?;
        return Ok(vec![Box::new(tables::plot::heat::chart(table, sidecar, names)?)]);
    }
    if let Some(name) = &arguments.tornado {
        let (table, sidecar) = one("--tornado")?;
        return Ok(vec![Box::new(tables::plot::tornado::chart(table, sidecar, name)?)]);
    }
    if let Some((table, _)) = tables.iter().find(|(table, _)| table.key != TIME) {
        return Err(format!(
            "{}:1: found the first column {:?}, allowed: {TIME:?}, or one of --histogram, --scatter, --heat, --tornado",
            table.path.display(),
            table.key
        ));
    }
    let names = &values::all_names(&arguments.names);
    match tables {
        [(table, sidecar)] if tables::plot::bands::is_of_percentiles(table) => {
            let of_runs =
                tables::plot::bands::runs_of(&table.path).map(|runs| Sidecar::beside(&runs)).transpose()?;
            let sidecar =
                of_runs.filter(|_| *sidecar == Sidecar::default()).unwrap_or_else(|| sidecar.clone());
            Ok(vec![Box::new(tables::plot::bands::chart(table, &sidecar, names)?)])
        }
        [(table, sidecar)] => Ok(vec![Box::new(tables::plot::over_time::single(table, sidecar, names)?)]),
        _ => Ok(vec![Box::new(tables::plot::over_time::overlaid(tables, names)?)]),
    }
}
