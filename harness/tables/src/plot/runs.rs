//! Runs of a campaign, or rows of any table: histograms and scatter.

use drawing::{Chart, Panel, Series};
use fmi::reference::Cell;

use super::cells::edges;
use crate::{
    output::leave_out,
    percentiles,
    table::{Sidecar, Table},
};

/// Percentiles that are marked.
const MARKED: [f64; 3] = [5.0, 50.0, 95.0];
/// How runs end.
const STATUS: &str = "status";

/// Word for a table's rows.
pub fn rows(table: &Table) -> &'static str {
    if table.key == "run" { "runs" } else { "rows" }
}

/// How often columns take which values.
///
/// # Errors
/// A name that is no column, and a column without numbers.
pub fn histograms(table: &Table, sidecar: &Sidecar, patterns: &[String]) -> Result<Vec<Chart>, String> {
    let mut names = table.selected(patterns)?;
    leave_out(&mut names, "columns", ": see --histogram");
    names.iter().map(|name| histogram(table, sidecar, name)).collect()
}

fn histogram(table: &Table, sidecar: &Sidecar, name: &str) -> Result<Chart, String> {
    let [mut values] = together(table, [name])?;
    values.sort_by(f64::total_cmp);
    let edges = edges(&values, (2.0 * (values.len() as f64).cbrt()).ceil() as usize);
    let mut counts = vec![0.0_f64; edges.len() - 1];
    let last = counts.len() - 1;
    for value in &values {
        // An inner edge belongs to the bar above it.
        let bar = edges.partition_point(|edge| edge <= value).saturating_sub(1).min(last);
        counts[bar] += 1.0;
    }
    let most = counts.iter().copied().fold(0.0, f64::max);
    let mut points: Vec<(f64, f64)> = edges.iter().copied().zip(counts).collect();
    points.extend(edges.last().map(|edge| (*edge, 0.0)));
    let top = 1.08 * most;
    let marks = percentiles(&mut values, MARKED);
    let marks = marks.into_iter().flat_map(|value| [(value, 0.0), (value, top), (f64::NAN, f64::NAN)]);
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    // In parts of the largest, whose square may be beyond all numbers.
    let largest = values.iter().fold(f64::MIN_POSITIVE, |largest, value| largest.max(value.abs()));
    let squares = values.iter().map(|value| ((value - mean) / largest).powi(2)).sum::<f64>();
    let deviation = if count > 1.0 { largest * (squares / (count - 1.0)).sqrt() } else { 0.0 };
    let title = format!(
        "{name}: {} {}, mean {}, standard deviation {}",
        values.len(),
        rows(table),
        terminal::short(mean),
        terminal::short(deviation)
    );
    let panel = Panel::new(rows(table))
        .whole()
        .range(0.0, top)
        .with([Series::bars("", points), Series::dashed("5, 50 and 95 %", marks.collect())]);
    Ok(Chart::new(title, sidecar.labelled(name)).with([panel]))
}

/// A column over another.
///
/// # Errors
/// A name that is no column or several, and columns without numbers in one row.
pub fn scatter(table: &Table, sidecar: &Sidecar, names: &[String; 2]) -> Result<Chart, String> {
    let [x_name, y_name] = [table.one(&names[0])?, table.one(&names[1])?];
    let [x, y] = together(table, [&x_name, &y_name])?;
    let statuses = table.column(STATUS).map(|cells| {
        let is_drawn = numbered(table, &[&x_name, &y_name]);
        cells.iter().zip(is_drawn).filter(|(_, is)| *is).map(|(cell, _)| cell.clone()).collect::<Vec<Cell>>()
    });
    let points = || x.iter().copied().zip(y.iter().copied());
    let mut series = Vec::new();
    match &statuses {
        None => series.push(Series::dots("", points().collect())),
        Some(statuses) => {
            let mut kinds: Vec<&Cell> = Vec::new();
            statuses.iter().for_each(|status| {
                if !kinds.contains(&status) {
                    kinds.push(status);
                }
            });
            // Those that are as they should be first, in the first colour.
            kinds.sort_by_key(|status| **status != Cell::Exact("ok".to_owned()));
            for kind in &kinds {
                let own = points().zip(statuses).filter(|(_, status)| status == kind).map(|(point, _)| point);
                let label = if kinds.len() > 1 { kind.to_string() } else { String::new() };
                series.push(Series::dots(label, own.collect()));
            }
        }
    }
    let title = format!("{}: {} {}", table.path.display(), x.len(), rows(table));
    Ok(Chart::new(title, sidecar.labelled(&x_name))
        .with([Panel::new(sidecar.labelled(&y_name)).with(series)]))
}

/// The numbers of columns in the rows where each has one; the others are counted in a note.
///
/// # Errors
/// No such row.
pub fn together<const N: usize>(table: &Table, names: [&str; N]) -> Result<[Vec<f64>; N], String> {
    let is_drawn = numbered(table, &names);
    let found = names.map(|name| {
        let values = table.numbers(name).unwrap_or_default().into_iter().zip(&is_drawn);
        values.filter(|(_, is)| **is).map(|(value, _)| value).collect::<Vec<f64>>()
    });
    let (all, drawn) = (table.keys.len(), is_drawn.iter().filter(|is| **is).count());
    if drawn == 0 {
        let names = names.join(", ");
        return Err(format!(
            "{}: {names}: found no number, allowed: at least one row of numbers",
            table.path.display()
        ));
    }
    if drawn < all {
        let (left, rows) = (all - drawn, rows(table));
        terminal::note(&format!(
            "{left} of {all} {rows} have no number in {}, so not drawn",
            names.join(", ")
        ));
    }
    Ok(found)
}

/// Rows in which every column has a finite number.
fn numbered(table: &Table, names: &[&str]) -> Vec<bool> {
    let columns: Vec<Vec<f64>> = names.iter().filter_map(|name| table.numbers(name)).collect();
    (0..table.keys.len()).map(|row| columns.iter().all(|column| drawing::is_drawable(column[row]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(cells: &[[&str; 3]]) -> Table {
        let column = |at: usize| cells.iter().map(|row| Cell::of_text(row[at])).collect();
        Table {
            path: "runs.csv".into(),
            key: "run".to_owned(),
            keys: (0..cells.len()).map(|run| run as f64).collect(),
            names: ["x", "y", "status"].map(str::to_owned).to_vec(),
            columns: (0..3).map(column).collect(),
        }
    }

    #[test]
    fn every_value_is_counted_once() {
        let rows: Vec<[String; 3]> =
            (0..1000).map(|k| [(f64::from(k) / 999.0).to_string(), String::new(), "ok".to_owned()]).collect();
        let rows: Vec<[&str; 3]> = rows.iter().map(|row| [row[0].as_str(), &row[1], &row[2]]).collect();
        let chart = &histograms(&table(&rows), &Sidecar::default(), &["x".to_owned()]).unwrap()[0];
        let bars = &chart.panels[0].series[0].points;
        assert_eq!(bars.iter().map(|(_, count)| count).sum::<f64>(), 1000.0);
        assert!(bars[..bars.len() - 1].iter().all(|(_, count)| (45.0..=55.0).contains(count)), "{bars:?}");
        assert!(chart.title.contains("mean 0.5, standard deviation 0.289109"), "{}", chart.title);
        let marks: Vec<f64> = chart.panels[0].series[1].points.iter().step_by(3).map(|(x, _)| *x).collect();
        for (mark, expected) in marks.iter().zip([0.05, 0.5, 0.95]) {
            assert!((mark - expected).abs() < 1e-12, "{marks:?}");
        }
        let refused = histograms(&table(&rows), &Sidecar::default(), &["y".to_owned()]).unwrap_err();
        assert!(refused.contains("runs.csv: y: found no number"), "{refused}");
    }

    #[test]
    fn dots_are_coloured_by_status_and_failed_runs_left_out() {
        let table = table(&[["1", "2", "limit"], ["2", "3", "ok"], ["", "", "failed"], ["3", "5", "ok"]]);
        let chart = scatter(&table, &Sidecar::default(), &["x", "y"].map(str::to_owned)).unwrap();
        let series: Vec<_> =
            chart.panels[0].series.iter().map(|it| (it.label.as_str(), &it.points[..])).collect();
        assert_eq!(series, [("ok", &[(2.0, 3.0), (3.0, 5.0)][..]), ("limit", &[(1.0, 2.0)][..])]);
        assert!(chart.title.contains("3 runs"), "{}", chart.title);
    }
}
