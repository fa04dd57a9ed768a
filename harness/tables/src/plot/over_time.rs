//! Tables over time: the picture of a run, or several runs overlaid.

use std::collections::BTreeSet;

use drawing::{Chart, Panel, Series};
use fmi::Column;

use crate::{
    output::{DisplayContext, TimeAxis, chart, leave_out, panel, shade_eclipses},
    table::{Described, Sidecar, Table},
};

/// The chart of a table; of these variables, otherwise of all.
///
/// # Errors
/// A name that is no column.
pub fn single(table: &Table, sidecar: &Sidecar, patterns: &[String]) -> Result<Chart, String> {
    let names = table.selected(patterns)?;
    let Described { description, recording } = Described::new(table, sidecar);
    let known = DisplayContext::default().dated(sidecar.zero_epoch_s);
    let (mut chart, seconds) = chart(&description, &recording.only(&names), &known, "--names");
    shade_eclipses(&mut chart, (&description, &recording), seconds);
    Ok(chart)
}

/// Several tables in one chart: a panel for each variable, lines by table.
///
/// # Errors
/// A name that no table has, and a variable of different units.
pub fn overlaid(tables: &[(Table, Sidecar)], patterns: &[String]) -> Result<Chart, String> {
    let each: Vec<&[String]> =
        if patterns.is_empty() { vec![patterns] } else { patterns.chunks(1).collect() };
    let (mut names, mut known) = (Vec::new(), BTreeSet::new());
    for pattern in each {
        let found: Vec<_> = tables.iter().map(|(table, _)| table.selected(pattern)).collect();
        // One of the tables may lack a variable, but not all.
        if found.iter().all(Result::is_err) {
            return Err(found.into_iter().find_map(Result::err).unwrap_or_default());
        }
        for name in found.into_iter().flatten().flatten() {
            if known.insert(name.clone()) {
                names.push(name);
            }
        }
    }
    let axis = axis(tables);
    let described: Vec<Described> =
        tables.iter().map(|(table, sidecar)| Described::new(table, sidecar)).collect();
    let numbers = described.iter().flat_map(|it| it.recording.names.iter().zip(&it.recording.columns));
    let numbers = numbers.filter(|(_, column)| !matches!(column, Column::Text(_)));
    let numbers: BTreeSet<&String> = numbers.map(|(name, _)| name).collect();
    names.retain(|name| numbers.contains(name));
    leave_out(&mut names, "variables", ": see --names");
    let mut panels = Vec::new();
    for name in &names {
        check_units(tables, name)?;
        panels.extend(of_variable(tables, &described, (name, axis.seconds)));
    }
    let legend = legend(tables);
    let title = tables.iter().find_map(|(_, sidecar)| sidecar.title.clone()).unwrap_or_default();
    Ok(Chart { title, x_label: axis.label, panels, legend, x_names: axis.names })
}

/// Over all times, with dates where all tables that know their epoch have the same.
fn axis(tables: &[(Table, Sidecar)]) -> TimeAxis {
    let times =
        || tables.iter().flat_map(|(table, _)| table.keys.first().into_iter().chain(table.keys.last()));
    let (first_s, last_s) = times().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), time_s| {
        (low.min(*time_s), high.max(*time_s))
    });
    let epochs_s: Vec<f64> = tables.iter().filter_map(|(_, sidecar)| sidecar.zero_epoch_s).collect();
    let is_common = epochs_s.windows(2).all(|pair| pair[0] == pair[1]);
    let epoch_s = epochs_s.first().copied();
    TimeAxis::over([first_s, last_s], epoch_s.filter(|_| is_common))
}

/// The panel of a variable with a line for each table; a table without it has an empty one, so that colours stay.
fn of_variable(
    tables: &[(Table, Sidecar)],
    described: &[Described],
    (name, seconds): (&str, f64),
) -> Option<Panel> {
    // What one table has of it holds for all.
    let knows = |at: &usize| tables[*at].1.columns.contains_key(name);
    let has = |at: &usize| tables[*at].0.column(name).is_some();
    let all = || 0..tables.len();
    let knowing = all().find(|at| knows(at) && has(at)).or_else(|| all().find(has))?;
    let of_table = |it: &Described| panel(&described[knowing].description, &it.recording, name, seconds);
    let drawn: Vec<Option<Panel>> = described.iter().map(of_table).collect();
    let lines = drawn.iter().map(|panel| {
        let series = panel.as_ref().and_then(|panel| panel.series.first().cloned()).unwrap_or_default();
        Series { label: String::new(), ..series }
    });
    let series: Vec<Series> = lines.collect();
    let names = drawn.iter().flatten().flat_map(|panel| panel.names.clone());
    let mut names: Vec<(f64, String)> = names.collect();
    names.sort_by(|a, b| a.0.total_cmp(&b.0));
    names.dedup();
    let first = drawn.iter().flatten().next()?.clone();
    let is_whole = drawn.iter().flatten().all(|panel| panel.is_whole);
    Some(Panel { series, names, is_whole, ..first })
}

fn check_units(tables: &[(Table, Sidecar)], name: &str) -> Result<(), String> {
    let known = tables
        .iter()
        .filter(|(table, sidecar)| table.column(name).is_some() && sidecar.columns.contains_key(name));
    let units: Vec<(&Table, Option<&str>)> =
        known.map(|(table, sidecar)| (table, sidecar.unit(name))).collect();
    let Some((first, unit)) = units.first() else { return Ok(()) };
    match units.iter().find(|(_, other)| other != unit) {
        None => Ok(()),
        Some((table, other)) => Err(format!(
            "{}: {name}: found the unit {:?}, allowed: {:?}, as in {}",
            table.path.display(),
            other.unwrap_or_default(),
            unit.unwrap_or_default(),
            first.path.display()
        )),
    }
}

/// The names of the files, whole paths where two are alike.
fn legend(tables: &[(Table, Sidecar)]) -> Vec<String> {
    let name = |table: &Table| table.path.file_name().map(|name| name.to_string_lossy().into_owned());
    let names: Vec<Option<String>> = tables.iter().map(|(table, _)| name(table)).collect();
    let is_alone = |name: &Option<String>| names.iter().filter(|other| *other == name).count() == 1;
    let all = tables.iter().zip(&names);
    let label = |(table, name): (&(Table, Sidecar), &Option<String>)| {
        let whole = || table.0.path.display().to_string();
        name.clone().filter(|_| is_alone(name)).unwrap_or_else(whole)
    };
    all.map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Quantity;

    fn table(file: &str, names: &[&str], keys: &[f64]) -> Table {
        Table {
            path: file.into(),
            key: "time".to_owned(),
            keys: keys.to_vec(),
            names: names.iter().map(|name| (*name).to_owned()).collect(),
            columns: names
                .iter()
                .map(|_| keys.iter().map(|key| fmi::reference::Cell::Real(*key)).collect())
                .collect(),
        }
    }

    fn known(unit: &str) -> Sidecar {
        let quantity = Quantity { unit: Some(unit.to_owned()), ..Quantity::default() };
        Sidecar { columns: [("x[1]".to_owned(), quantity)].into(), ..Sidecar::default() }
    }

    #[test]
    fn a_variable_has_a_line_of_its_own_colour_for_each_table() {
        let tables = [
            (table("a/run.csv", &["x[1]", "x[2]"], &[0.0, 100.0]), known("N")),
            (table("b/run.csv", &["x[1]"], &[0.0, 50.0, 1000.0]), Sidecar::default()),
        ];
        let chart = overlaid(&tables, &[]).unwrap();
        assert_eq!(chart.legend, ["a/run.csv", "b/run.csv"]);
        assert_eq!(chart.x_label, "time [min]");
        let panels: Vec<(&str, Vec<usize>)> = chart
            .panels
            .iter()
            .map(|panel| (panel.y_label.as_str(), panel.series.iter().map(|it| it.points.len()).collect()))
            .collect();
        assert_eq!(panels, [("x[1] [N]", vec![2, 3]), ("x[2]", vec![2, 0])]);
        assert_eq!(overlaid(&tables, &["x[2]".to_owned()]).unwrap().panels.len(), 1);
        assert!(overlaid(&tables, &["y".to_owned()]).unwrap_err().contains("a/run.csv"));
    }

    #[test]
    fn one_variable_has_one_unit() {
        let tables = ["N", "m"].map(|unit| (table(unit, &["x[1]"], &[0.0, 1.0]), known(unit)));
        let refused = overlaid(&tables, &[]).unwrap_err();
        assert!(refused.contains("x[1]: found the unit \"m\", allowed: \"N\""), "{refused}");
    }
}
