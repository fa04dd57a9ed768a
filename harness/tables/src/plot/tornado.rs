//! Change of a column by each varied quantity alone: runs at its mean and at plus and minus its standard deviation.

use drawing::TornadoChart;

use crate::table::{Sidecar, Table};

/// The sampling that its runs have.
const SAMPLING: &str = "oneAtATime";
/// Rows drawn at most; more would not be readable.
const ROWS: usize = 30;

/// The chart.
///
/// # Errors
/// Another table than that of such a campaign, a name that is no column, and a run 0 that is missing or failed.
pub fn chart(table: &Table, sidecar: &Sidecar, name: &str) -> Result<TornadoChart, String> {
    let file = table.path.display();
    match sidecar.sampling.as_deref() {
        Some(SAMPLING) => {}
        Some(other) => {
            return Err(format!(
                "{file}.toml: sampling: found {other:?}, allowed: {SAMPLING:?}: see --tornado"
            ));
        }
        None => {
            return Err(format!(
                "{file}: found no sampling beside it, allowed: {file}.toml with sampling = {SAMPLING:?}: see --tornado"
            ));
        }
    }
    let name = table.one(name)?;
    let varied: Vec<&String> = table.names.iter().filter(|name| sidecar.varied.contains(name)).collect();
    if let Some(missing) = sidecar.varied.iter().find(|name| !varied.contains(name)) {
        return Err(format!(
            "{file}: found no column {missing:?}, allowed: every one that {file}.toml varies"
        ));
    }
    let of_run = |column: &str, run: usize| {
        let row = table.keys.iter().position(|key| *key == run as f64)?;
        table.numbers(column)?.get(row).copied().filter(|value| drawing::is_drawable(*value))
    };
    let at_means = of_run(&name, 0).ok_or_else(|| {
        format!("{file}: {name}: found no number in run 0, allowed: the run with all at their means")
    })?;
    let mut rows: Vec<(String, [f64; 2])> = Vec::new();
    for (at, quantity) in varied.iter().enumerate() {
        let runs = [2 * at + 1, 2 * at + 2];
        let changes = runs.map(|run| of_run(&name, run).map_or(f64::NAN, |value| value - at_means));
        let sigma = of_run(quantity, runs[1]).zip(of_run(quantity, 0)).map(|(above, mean)| above - mean);
        let unit = sidecar.unit(quantity).map_or(String::new(), |unit| format!(" {unit}"));
        let sigma = sigma.map_or(String::new(), |sigma| format!(" ± {}{unit}", terminal::short(sigma)));
        rows.push((format!("{quantity}{sigma}"), changes));
    }
    let missing = rows.iter().flat_map(|(_, changes)| changes).filter(|change| change.is_nan()).count();
    if missing > 0 {
        terminal::note(&format!("{missing} of {} runs have no number in {name}, so no bar", 2 * rows.len()));
    }
    let size = |changes: &[f64; 2]| changes.iter().fold(0.0_f64, |most, change| most.max(change.abs()));
    rows.sort_by(|a, b| size(&b.1).total_cmp(&size(&a.1)));
    if let Some(beyond) = rows.len().checked_sub(ROWS).filter(|beyond| *beyond > 0) {
        terminal::note(&format!("the picture shows the largest {ROWS} and leaves out {beyond}"));
        rows.truncate(ROWS);
    }
    Ok(TornadoChart {
        title: format!("{name}: {} with all at their means", terminal::short(at_means)),
        x_label: format!("change of {}", sidecar.labelled(&name)),
        bars: ["- 1 sigma", "+ 1 sigma"].map(str::to_owned),
        rows,
    })
}
