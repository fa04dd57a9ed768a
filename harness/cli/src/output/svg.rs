//! The picture of `run --plot`: one panel per vector or variable, in display units.

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use files::Destination;
use loader::{Column, Recording};
use model_description::{Causality, Description};
use studies::chart::{COLOURS, Chart, Panel, Series};

use super::{exporter::Exporter, shown::find};

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

/// Whether a path promises this kind of picture, or is the standard output.
pub fn is_svg_path(path: &Path) -> bool {
    path == Path::new("-") || path.extension().is_some_and(|it| it.eq_ignore_ascii_case("svg"))
}

/// Refuses a path that promises another kind of picture.
pub fn check_path(path: &Path, option: &str) -> Result<(), String> {
    if is_svg_path(path) {
        return Ok(());
    }
    Err(format!(
        "{}: found no SVG file's name, allowed: one that ends in .svg, or -: see {option}",
        path.display()
    ))
}

/// The picture, drawn at the end.
pub struct Svg {
    file: Destination,
    /// The variables that it shows; `None`: everything recorded.
    names: Option<Vec<String>>,
}

impl Svg {
    /// Draws into a file of which nothing is written yet.
    pub fn new(file: Destination, names: Option<Vec<String>>) -> Self {
        Self { file, names }
    }

    fn draw(&self, described: &Description, recording: &Recording) -> Result<String, Box<dyn Error>> {
        Ok(match &self.names {
            Some(names) => chart(described, &recording.only(names)).to_svg()?,
            None => chart(described, recording).to_svg()?,
        })
    }
}

impl Exporter for Svg {
    fn finish(self: Box<Self>, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        let svg = self.draw(described, recording)?;
        Ok(self.file.fill(|file| file.write_all(svg.as_bytes()))?)
    }

    fn leave(self: Box<Self>, described: &Description, recording: &Recording) -> Option<PathBuf> {
        if recording.times_s.is_empty() {
            return None;
        }
        let svg = self.draw(described, recording).ok()?;
        let mut file = self.file.grow(&[]).ok()?;
        file.append(svg.as_bytes()).ok()?;
        file.leave()
    }
}

/// The chart of a recording.
fn chart(described: &Description, recording: &Recording) -> Chart {
    let span_s = match (recording.times_s.first(), recording.times_s.last()) {
        (Some(first_s), Some(last_s)) => last_s - first_s,
        _ => 0.0,
    };
    let (_, time_unit, seconds) =
        TIME_UNITS.into_iter().find(|(from_s, _, _)| span_s >= *from_s).unwrap_or((0.0, "s", 1.0));
    let mut panels: Vec<(String, Panel)> = Vec::new();
    let mut left_out = 0;
    for (name, column) in drawn(described, recording) {
        let vector = &group(name);
        let variable = find(described, name);
        let display = variable.and_then(|variable| loader::display_unit(described, variable));
        let own = variable.and_then(|variable| loader::unit(described, variable)).unwrap_or_default();
        let (unit, factor, offset) = display.unwrap_or((own, 1.0, 0.0));
        let points = recording.times_s.iter().zip(column.numbers());
        let points = points.map(|(time_s, value)| (time_s / seconds, factor * value + offset)).collect();
        let series = Series::line(name, points);
        let y_label =
            if unit.is_empty() || unit == "1" { vector.to_owned() } else { format!("{vector} [{unit}]") };
        let full = panels.len() == PANELS;
        // What belongs together may stand apart in the description: wheel[1].momentum, wheel[1].speed, wheel[2]...
        let with_space = panels.iter_mut().find(|(group, panel)| {
            group == vector && panel.y_label == y_label && panel.series.len() < COLOURS.len()
        });
        match with_space {
            Some((_, panel)) => panel.series.push(series),
            None if full => left_out += 1,
            None => {
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
        let limit = format!("the picture shows the first {PANELS} panels");
        terminal::note(&format!("{limit} and leaves out {left_out} variables: see --record"));
    }
    Chart {
        title: described.model_name.clone(),
        x_label: format!("time [{time_unit}]"),
        panels: panels.into_iter().map(|(_, panel)| panel).collect(),
        ..Chart::default()
    }
}

/// The columns worth drawing: no texts, and no inputs that nobody used, unless there is nothing else.
fn drawn<'a>(described: &Description, recording: &'a Recording) -> Vec<(&'a str, &'a Column)> {
    let columns = recording.names.iter().map(String::as_str).zip(&recording.columns);
    let numbers: Vec<_> = columns.filter(|(_, column)| !matches!(column, Column::Text(_))).collect();
    let unused = |name: &str, column: &Column| {
        find(described, name).is_some_and(|variable| variable.causality == Causality::Input)
            && column.numbers().iter().all(|value| *value == 0.0)
    };
    let used: Vec<_> = numbers.iter().copied().filter(|(name, column)| !unused(name, column)).collect();
    if used.is_empty() { numbers } else { used }
}

#[cfg(test)]
mod tests {
    //! What belongs together shares a panel.
    use super::*;

    const SHIP: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Ship" guid="{ship}">
  <CoSimulation modelIdentifier="Ship"/>
  <ModelVariables>
    <ScalarVariable name="push[1]" valueReference="0" causality="input"><Real start="0"/></ScalarVariable>
    <ScalarVariable name="push[2]" valueReference="1" causality="input"><Real start="0"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>"#;

    /// The labels of each panel of a recording of two points.
    fn panels(columns: &[(&str, f64)]) -> Vec<Vec<String>> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("modelDescription.xml"), SHIP).unwrap();
        let recording = Recording {
            times_s: vec![0.0, 1.0],
            names: columns.iter().map(|(name, _)| (*name).to_owned()).collect(),
            units: vec![String::new(); columns.len()],
            columns: columns.iter().map(|(_, last)| Column::Real(vec![0.0, *last])).collect(),
        };
        let fmu = loader::Fmu::open(folder.path()).unwrap();
        let chart = chart(fmu.description(), &recording);
        let labels = |panel: Panel| panel.series.into_iter().map(|series| series.label).collect();
        chart.panels.into_iter().map(labels).collect()
    }

    #[test]
    fn a_group_shares_a_panel_wherever_its_variables_stand() {
        let wheels = ["momentum", "speed", "torque"]
            .map(|quantity| ["wheel[1].", "wheel[2]."].map(|wheel| format!("{wheel}{quantity}")));
        let order: Vec<(&str, f64)> =
            (0..2).flat_map(|wheel| wheels.iter().map(move |names| (names[wheel].as_str(), 1.0))).collect();
        assert_eq!(order[1].0, "wheel[1].speed");
        assert_eq!(panels(&order), wheels.map(Vec::from));
        // An eighth line opens a panel of its own.
        let many: Vec<String> = (1..=8).map(|k| format!("plate[{k}].temperature")).collect();
        let many: Vec<(&str, f64)> = many.iter().map(|name| (name.as_str(), 1.0)).collect();
        let counts: Vec<usize> = panels(&many).iter().map(Vec::len).collect();
        assert_eq!(counts, [COLOURS.len(), 1]);
    }

    #[test]
    fn inputs_that_nobody_used_are_not_drawn() {
        let all = [("push[1]", 0.0), ("push[2]", 2.0), ("torque[1]", 0.0)];
        assert_eq!(panels(&all), [["push[2]"], ["torque[1]"]]);
        assert_eq!(panels(&all[..1]), [["push[1]"]], "nothing else is there");
    }

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
