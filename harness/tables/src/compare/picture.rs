//! The picture of a comparison: the second table less the first, a panel for each vector that differs.

use std::collections::{BTreeMap, BTreeSet};

use drawing::{COLOURS, Chart, DrawingError, Panel, Series};
use fmi::reference::{Cell, Difference};
use inputs::variables::vector;

use super::pairing::Pairing;
use crate::{
    output::{TimeAxis, leave_out},
    table::{Sidecar, TIME, Table},
};

/// As SVG text; `found` is what differs, `sidecar` that of the first table.
///
/// # Errors
/// Nothing to draw.
pub fn svg(
    tables: [&Table; 2],
    pairing: &Pairing,
    found: &[Difference],
    sidecar: &Sidecar,
) -> Result<String, DrawingError> {
    let [first, second] = tables;
    let keys: Vec<f64> = pairing.rows.iter().map(|(row, _)| first.keys[*row]).collect();
    let is_time = first.key == TIME;
    let axis = match (is_time, &keys[..]) {
        (true, [from_s, .., to_s]) => TimeAxis::over([*from_s, *to_s], sidecar.zero_epoch_s),
        (true, _) => TimeAxis::over([0.0; 2], None),
        _ => TimeAxis { seconds: 1.0, label: sidecar.labelled(&first.key), names: Vec::new() },
    };
    let different: BTreeSet<&str> = found.iter().map(|it| it.name.as_str()).collect();
    let differs = |name: &str| different.is_empty() || different.contains(name);
    let mut panels: Vec<Panel> = Vec::new();
    // The panel of a vector that has room for another line.
    let mut with_room: BTreeMap<String, usize> = BTreeMap::new();
    for column in pairing.columns.iter().filter(|column| differs(&column.name)) {
        let display = sidecar.columns.get(&column.name).and_then(|it| it.display.as_ref());
        let (unit, factor) = match display {
            Some((unit, factor, _)) => (Some(unit.as_str()), *factor),
            None => (sidecar.unit(&column.name), 1.0),
        };
        let pairs = column.expected.iter().zip(&column.found);
        let points = keys.iter().zip(pairs).map(|(key, pair)| {
            let difference = match pair {
                (Cell::Real(expected), Cell::Real(found)) => factor * (found - expected),
                _ => f64::NAN,
            };
            (key / axis.seconds, difference)
        });
        let points: Vec<(f64, f64)> = points.collect();
        if points.iter().all(|(_, difference)| !difference.is_finite()) {
            continue;
        }
        let name = vector(&column.name).unwrap_or(&column.name).to_owned();
        let y_label = unit.map_or_else(|| name.clone(), |unit| format!("{name} [{unit}]"));
        let series = match is_time {
            true => Series::line(column.name.clone(), points),
            false => Series::dots(column.name.clone(), points),
        };
        match with_room.get(&name).filter(|at| panels[**at].series.len() < COLOURS.len()) {
            Some(at) => panels[*at].series.push(series),
            None => {
                with_room.insert(name, panels.len());
                panels.push(Panel::new(y_label).with([series]));
            }
        }
    }
    leave_out(&mut panels, "panels", "");
    let [one, other] = [first, second].map(|table| table.path.display());
    let chart =
        Chart { x_names: axis.names, ..Chart::new(format!("{other} less {one}"), axis.label).with(panels) };
    drawing::svg(&[&chart])
}
