//! The summary of a run on the terminal, where no file is named.

use std::{collections::BTreeMap, error::Error};

use loader::Recording;
use model_description::Description;

use super::{
    exporter::Exporter,
    shown::{ROUNDING, Shown},
};
use crate::variables::vector;

/// Rows of the table of last values at most.
const LAST_ROWS: usize = 24;

/// The summary, printed at the end.
pub struct Summary;

impl Exporter for Summary {
    fn finish(self: Box<Self>, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        Ok(terminal::print(&summary(described, recording))?)
    }
}

/// First, smallest, largest and last value of everything recorded.
fn summary(described: &Description, recording: &Recording) -> String {
    let mut table = terminal::table(&["variable", "unit", "first", "smallest", "largest", "last"]);
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        if let loader::Column::Text(texts) = column {
            let [first, last] = [texts.first(), texts.last()].map(|text| text.map_or("", String::as_str));
            table.add_row([name, "", first, "", "", last]);
            continue;
        }
        let shown = Shown::of(described, name);
        let values: Vec<Option<f64>> = column.numbers().into_iter().map(|value| shown.value(value)).collect();
        let text = |value: Option<&Option<f64>>| shown.text(value.copied().unwrap_or(Some(f64::NAN)));
        table.add_row([
            name.clone(),
            shown.unit.to_owned(),
            text(values.first()),
            shown.text(values.iter().flatten().copied().reduce(f64::min)),
            shown.text(values.iter().flatten().copied().reduce(f64::max)),
            text(values.last()),
        ]);
    }
    table.to_string()
}

/// The last value of everything recorded, a vector in a row.
pub fn last_values(described: &Description, recording: &Recording) -> String {
    let mut rows: Vec<(&str, &str, Vec<String>)> = Vec::new();
    let sizes = last_sizes(recording);
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        let shown = Shown::of(described, name);
        let text = match column {
            loader::Column::Text(texts) => texts.last().cloned().unwrap_or_default(),
            column => {
                let last = column.numbers().last().copied().unwrap_or(f64::NAN);
                // A component of nothing but rounding.
                let least = vector(name).and_then(|of| sizes.get(of)).map_or(0.0, |size| ROUNDING * size);
                shown.text(shown.value(if last.abs() < least { 0.0 } else { last }))
            }
        };
        match (rows.last_mut(), vector(name)) {
            (Some((of, _, values)), Some(vector)) if *of == vector => values.push(text),
            (_, vector) => rows.push((vector.unwrap_or(name), shown.unit, vec![text])),
        }
    }
    let mut table = terminal::table(&["variable", "unit", "last"]);
    for (name, unit, values) in rows.iter().take(LAST_ROWS) {
        table.add_row([*name, *unit, &values.join(", ")]);
    }
    match rows.len().saturating_sub(LAST_ROWS) {
        0 => table.to_string(),
        more => format!("{table}\n{more} more"),
    }
}

/// The greatest component of every vector at the end.
fn last_sizes(recording: &Recording) -> BTreeMap<&str, f64> {
    let mut sizes = BTreeMap::new();
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        if let (Some(of), loader::Column::Real(values)) = (vector(name), column) {
            let size: &mut f64 = sizes.entry(of).or_default();
            *size = values.last().map_or(*size, |value| size.max(value.abs()));
        }
    }
    sizes
}

#[cfg(test)]
mod tests {
    //! Rounding is shown as 0, whatever else is small is not.
    use super::*;

    const SHIP: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Ship" guid="{ship}">
  <CoSimulation modelIdentifier="Ship"/>
  <UnitDefinitions><Unit name="rad"><DisplayUnit name="deg" factor="57.3"/></Unit></UnitDefinitions>
  <ModelVariables>
    <ScalarVariable name="angle" valueReference="0"><Real unit="rad" displayUnit="deg"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>"#;

    /// The last values of these columns.
    fn reported(columns: &[(&str, f64)]) -> String {
        let description = model_description::parse(SHIP.as_bytes()).unwrap().description;
        let recording = Recording {
            times_s: vec![0.0],
            names: columns.iter().map(|(name, _)| (*name).to_owned()).collect(),
            units: vec![String::new(); columns.len()],
            columns: columns.iter().map(|(_, value)| loader::Column::Real(vec![*value])).collect(),
        };
        last_values(&description, &recording) + &summary(&description, &recording)
    }

    #[test]
    fn rounding_is_shown_as_nothing() {
        assert!(!reported(&[("angle", 2.8e-17)]).contains("e-"));
        assert!(reported(&[("angle", 1e-9)]).contains("5.73e-8"));
        assert!(reported(&[("lone", 1.5e-17)]).contains("1.5e-17"));
        let vector = reported(&[("torque[1]", -3e-18), ("torque[2]", 2e-5), ("torque[3]", 4e-16)]);
        assert!(vector.contains("0, 2e-5, 4e-16"), "{vector}");
        let small = reported(&[("torque[1]", 3e-18), ("torque[2]", 2e-18)]);
        assert!(small.contains("3e-18, 2e-18"), "{small}");
    }
}
