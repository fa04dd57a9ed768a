//! The picture of `run --plot`: one panel per vector or variable, in display units.

use std::path::Path;

use loader::{Fmu, Recording};
use studies::chart::{COLOURS, Chart, Panel, Series};

/// Panels drawn at most; more would not be readable.
const PANELS: usize = 10;

/// Time units for the horizontal axis: from how long a run on, name, seconds.
const TIME_UNITS: [(f64, &str, f64); 4] =
    [(3.0 * 86_400.0, "d", 86_400.0), (3.0 * 3600.0, "h", 3600.0), (600.0, "min", 60.0), (0.0, "s", 1.0)];

/// What is drawn together: the elements of a vector, or the same quantity of everything that is counted.
fn group(name: &str) -> String {
    match name.rsplit_once('[') {
        Some((vector, index)) if index.ends_with(']') => vector.to_owned(),
        Some((counted, rest)) => {
            let (_, quantity) = rest.split_once(']').unwrap_or(("", rest));
            format!("{counted}{quantity}")
        }
        None => name.to_owned(),
    }
}

/// Refuses a path that promises another kind of picture.
pub fn check_path(path: &Path) -> Result<(), String> {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("svg") => Ok(()),
        _ => Err(format!(
            "{}: found no SVG file's name, allowed: one that ends in .svg: see --plot",
            path.display()
        )),
    }
}

/// The chart of a recording.
pub fn chart(fmu: &Fmu, recording: &Recording) -> Chart {
    let span_s = match (recording.times_s.first(), recording.times_s.last()) {
        (Some(first_s), Some(last_s)) => last_s - first_s,
        _ => 0.0,
    };
    let (_, time_unit, seconds) =
        TIME_UNITS.into_iter().find(|(from_s, _, _)| span_s >= *from_s).unwrap_or((0.0, "s", 1.0));
    let mut panels: Vec<(String, Panel)> = Vec::new();
    let mut left_out = 0;
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        if matches!(column, loader::Column::Text(_)) {
            continue;
        }
        let vector = &group(name);
        let variable = fmu.find(name);
        let display = variable.and_then(|variable| loader::display_unit(fmu.description(), variable));
        let own = variable.and_then(|variable| loader::unit(fmu.description(), variable)).unwrap_or_default();
        let (unit, factor, offset) = display.unwrap_or((own, 1.0, 0.0));
        let points = recording.times_s.iter().zip(column.numbers());
        let points = points.map(|(time_s, value)| (time_s / seconds, factor * value + offset)).collect();
        let series = Series::line(name.clone(), points);
        let y_label =
            if unit.is_empty() || unit == "1" { vector.to_owned() } else { format!("{vector} [{unit}]") };
        let full = panels.len() == PANELS;
        match panels.last_mut() {
            Some((last, panel))
                if last == vector && panel.y_label == y_label && panel.series.len() < COLOURS.len() =>
            {
                panel.series.push(series);
            }
            _ if full => left_out += 1,
            _ => {
                panels.push((vector.to_owned(), Panel { y_label, series: vec![series], ..Panel::default() }))
            }
        }
    }
    for (name, panel) in &mut panels {
        // A lone variable is named by its axis.
        if let [only] = panel.series.as_mut_slice()
            && only.label == *name
        {
            only.label.clear();
        }
    }
    if left_out > 0 {
        eprintln!(
            "the picture shows the first {PANELS} panels and leaves out {left_out} variables: see --record"
        );
    }
    Chart {
        title: fmu.name().to_owned(),
        x_label: format!("time [{time_unit}]"),
        panels: panels.into_iter().map(|(_, panel)| panel).collect(),
    }
}

#[cfg(test)]
mod tests {
    //! What belongs together shares a panel.
    use super::*;

    #[test]
    fn vectors_and_counted_quantities_are_groups() {
        for (name, expected) in [
            ("torque.solar[2]", "torque.solar"),
            ("plate[12].temperature", "plate.temperature"),
            ("plate[12].force[3]", "plate[12].force"),
            ("sun.litFraction", "sun.litFraction"),
        ] {
            assert_eq!(group(name), expected);
        }
    }
}
