//! Percentiles over time: the median with bands, a panel for each variable.

use std::path::{Path, PathBuf};

use drawing::{Band, Chart, Envelope, Panel, Series};

use crate::{
    output::{TimeAxis, leave_out},
    table::{Sidecar, Table},
};

const MEDIAN: &str = ".p50";
/// Pairs of percentiles, the widest first.
const BANDS: [(u32, u32); 3] = [(1, 99), (5, 95), (25, 75)];
/// Suffix of a campaign's table of percentiles, after the name of the campaign's runs.
const BEHIND: &str = "-percentiles";

/// Whether a table has percentiles.
pub fn is_of_percentiles(table: &Table) -> bool {
    table.names.iter().any(|name| name.ends_with(MEDIAN))
}

/// The table of the runs that percentiles are of: `runs.csv` for `runs-percentiles.csv`.
pub fn runs_of(path: &Path) -> Option<PathBuf> {
    let stem = path.file_stem()?.to_str()?.strip_suffix(BEHIND)?;
    Some(path.with_file_name(format!("{stem}.csv")))
}

/// The chart; of these variables, otherwise of all.
///
/// # Errors
/// A name that has no percentiles.
pub fn chart(table: &Table, sidecar: &Sidecar, patterns: &[String]) -> Result<Chart, String> {
    let medians = Table {
        names: table.names.iter().filter_map(|name| name.strip_suffix(MEDIAN)).map(str::to_owned).collect(),
        path: table.path.clone(),
        ..Table::default()
    };
    let mut names = medians.selected(patterns)?;
    leave_out(&mut names, "variables", ": see --names");
    let ends = [table.keys.first(), table.keys.last()].map(|time_s| time_s.copied().unwrap_or_default());
    let axis = TimeAxis::over(ends, sidecar.zero_epoch_s);
    let edge = |name: &str, percent: u32| -> Option<Vec<(f64, f64)>> {
        let values = table.numbers(&format!("{name}.p{percent}"))?;
        Some(table.keys.iter().map(|time_s| time_s / axis.seconds).zip(values).collect())
    };
    let panel = |(at, name): (usize, &String)| {
        // The legend names bands once.
        let label = |text: String| if at == 0 { text } else { String::new() };
        let bands = BANDS.into_iter().filter_map(|(low, high)| {
            let range = Envelope { lowest: edge(name, low)?, greatest: edge(name, high)? };
            Some(Band { label: label(format!("{low} to {high} %")), range })
        });
        let median = Series::curve(label("median".to_owned()), edge(name, 50).unwrap_or_default());
        Panel::new(labelled(sidecar, name)).with([median.with_bands(bands)])
    };
    let panels: Vec<Panel> = names.iter().enumerate().map(panel).collect();
    let title = sidecar.title.clone().unwrap_or_else(|| table.path.display().to_string());
    Ok(Chart { title, x_label: axis.label, panels, x_names: axis.names, ..Chart::default() })
}

/// A variable with its unit, by what is known of any column of it.
fn labelled(sidecar: &Sidecar, name: &str) -> String {
    let unit = ["", MEDIAN, ".final"].iter().find_map(|kept| sidecar.unit(&format!("{name}{kept}")));
    unit.map_or_else(|| name.to_owned(), |unit| format!("{name} [{unit}]"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fmi::reference::Cell;

    #[test]
    fn bands_join_the_percentiles_of_a_variable() {
        assert_eq!(runs_of(Path::new("out/runs-percentiles.csv")), Some("out/runs.csv".into()));
        assert_eq!(runs_of(Path::new("out/runs.csv")), None);
        let names = ["h[1].p1", "h[1].p25", "h[1].p50", "h[1].p75", "h[1].p99", "g.p50"];
        let table = Table {
            path: "p.csv".into(),
            key: "time".to_owned(),
            keys: vec![0.0, 86_400.0 * 4.0],
            names: names.map(str::to_owned).to_vec(),
            columns: (0..6).map(|k| vec![Cell::Real(f64::from(k)); 2]).collect(),
        };
        assert!(is_of_percentiles(&table));
        let chart = chart(&table, &Sidecar::default(), &["h".to_owned()]).unwrap();
        assert_eq!((chart.panels.len(), chart.x_label.as_str()), (1, "time [d]"));
        let series = &chart.panels[0].series[0];
        assert_eq!(series.points, [(0.0, 2.0), (4.0, 2.0)]);
        let bands: Vec<_> = series
            .bands
            .iter()
            .map(|it| (it.label.as_str(), it.range.lowest[1].1, it.range.greatest[1].1))
            .collect();
        assert_eq!(bands, [("1 to 99 %", 0.0, 4.0), ("25 to 75 %", 1.0, 3.0)]);
    }
}
