//! Summary of a run on the terminal: min, max and final value of everything recorded, a vector in a row.

use std::error::Error;

use fmi::{Column, Recording};
use inputs::variables::vector;
use model_description::Description;

use super::{
    display_form::DisplayForm,
    exporter::Exporter,
    scales::{ROUNDING, Scales},
};

/// Rows of the table beside files at most.
const ROWS_BESIDE_FILES: usize = 24;

/// The summary, printed at the end where no file is named.
pub(super) struct Summary;

impl Exporter for Summary {
    fn finish(self: Box<Self>, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        Ok(terminal::print(&table(described, recording, usize::MAX))?)
    }
}

/// The first rows of the same, for a run that writes files.
pub(super) fn beside_files(described: &Description, recording: &Recording) -> String {
    table(described, recording, ROWS_BESIDE_FILES)
}

/// A row: name, unit, and the texts of each component's min, max and final value.
struct SummaryRow<'a> {
    name: &'a str,
    unit: &'a str,
    components: Vec<[String; 3]>,
}

fn table(described: &Description, recording: &Recording, most: usize) -> String {
    let rows = rows(described, recording);
    let mut table = terminal::table(&["variable", "unit", "min", "max", "final"]);
    for SummaryRow { name, unit, components } in rows.iter().take(most) {
        let joined =
            |k: usize| components.iter().map(|texts| texts[k].as_str()).collect::<Vec<_>>().join(", ");
        table.add_row([*name, *unit, &joined(0), &joined(1), &joined(2)]);
    }
    match rows.len().saturating_sub(most) {
        0 => table.to_string(),
        more => format!("{table}\n{more} more"),
    }
}

fn rows<'a>(described: &'a Description, recording: &'a Recording) -> Vec<SummaryRow<'a>> {
    let mut rows: Vec<SummaryRow<'a>> = Vec::new();
    let scales = Scales::new(described, recording);
    let columns: Vec<(&String, &Column)> = recording.names.iter().zip(&recording.columns).collect();
    for group in columns.chunk_by(|one, other| vector(one.0).is_some() && vector(one.0) == vector(other.0)) {
        let Some((first, _)) = group.first() else { continue };
        let name = vector(first).filter(|_| group.len() > 1).unwrap_or(first);
        let unit = DisplayForm::new(described, first).unit;
        let size = scales.size(first);
        let components =
            group.iter().map(|(name, column)| texts(&DisplayForm::new(described, name), column, size));
        rows.push(SummaryRow { name, unit, components: components.collect() });
    }
    rows
}

/// Min, max and final value.
fn texts(shown: &DisplayForm<'_>, column: &Column, size: f64) -> [String; 3] {
    if let Column::Text(texts) = column {
        return [String::new(), String::new(), texts.last().cloned().unwrap_or_default()];
    }
    let rounded = |value: f64| if value.abs() < ROUNDING * size { 0.0 } else { value };
    let values: Vec<Option<f64>> =
        column.numbers().into_iter().map(|value| shown.value(rounded(value))).collect();
    let known = || values.iter().flatten().copied();
    [
        shown.text(known().reduce(f64::min)),
        shown.text(known().reduce(f64::max)),
        shown.text(values.last().copied().unwrap_or(Some(f64::NAN))),
    ]
}

#[cfg(test)]
mod tests {
    //! Rounding is shown as 0, whatever else is small is not; vectors stand in a row.
    use super::*;

    const SHIP: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Ship" guid="{ship}">
  <CoSimulation modelIdentifier="Ship"/>
  <UnitDefinitions><Unit name="rad"><DisplayUnit name="deg" factor="57.3"/></Unit></UnitDefinitions>
  <TypeDefinitions><SimpleType name="Mode"><Enumeration><Item name="nadir" value="1"/><Item name="safe" value="4"/></Enumeration></SimpleType></TypeDefinitions>
  <ModelVariables>
    <ScalarVariable name="angle" valueReference="0"><Real unit="rad" displayUnit="deg"/></ScalarVariable>
    <ScalarVariable name="load.light[1]" valueReference="2" causality="output"><Real unit="N"/></ScalarVariable>
    <ScalarVariable name="load.air[1]" valueReference="3" causality="output"><Real unit="N"/></ScalarVariable>
    <ScalarVariable name="mixed.far" valueReference="4" causality="output"><Real unit="m"/></ScalarVariable>
    <ScalarVariable name="mixed.slow" valueReference="5" causality="output"><Real unit="m/s"/></ScalarVariable>
    <ScalarVariable name="mode" valueReference="1" causality="output" variability="discrete"><Enumeration declaredType="Mode"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>"#;

    fn reported(columns: &[(&str, Column)]) -> String {
        let description = model_description::parse(SHIP.as_bytes()).unwrap().description;
        let recording = Recording {
            times_s: columns[0].1.numbers(),
            names: columns.iter().map(|(name, _)| (*name).to_owned()).collect(),
            units: vec![String::new(); columns.len()],
            columns: columns.iter().map(|(_, column)| column.clone()).collect(),
        };
        table(&description, &recording, 2)
    }

    fn real(values: &[f64]) -> Column {
        Column::Real(values.to_vec())
    }

    #[test]
    fn rounding_is_shown_as_nothing() {
        let last = |columns: &[(&str, f64)]| {
            reported(&columns.iter().map(|(name, value)| (*name, real(&[*value]))).collect::<Vec<_>>())
        };
        assert!(!last(&[("angle", 2.8e-17)]).contains("e-"));
        assert!(last(&[("angle", 1e-9)]).contains("5.73e-8"));
        assert!(last(&[("lone", 1.5e-17)]).contains("1.5e-17"));
        let vector = last(&[("torque[1]", -3e-18), ("torque[2]", 2e-5), ("torque[3]", 4e-16)]);
        assert!(vector.contains("0, 2e-5, 4e-16"), "{vector}");
        let small = last(&[("torque[1]", 3e-18), ("torque[2]", 2e-18)]);
        assert!(small.contains("3e-18, 2e-18"), "{small}");
        // Loads of one unit are small against each other, whatever is of several units is not.
        let loads = last(&[("load.light[1]", 3e-6), ("load.air[1]", 2e-19)]);
        assert!(!loads.contains("e-19"), "{loads}");
        assert!(last(&[("load.light[1]", 3e-6), ("load.air[1]", 4e-18)]).contains("4e-18"));
        assert!(last(&[("mixed.far", 3e11), ("mixed.slow", 2e-3)]).contains("0.002"));
        // Against what it was at any time.
        assert!(!reported(&[("lone", real(&[4.0, 1e-15]))]).contains("e-15"));
    }

    #[test]
    fn a_vector_has_one_row_with_min_max_and_final() {
        let columns = [
            ("torque[1]", real(&[1.0, 7.0, 3.0])),
            ("torque[2]", real(&[-1.0, -2.0, 5.0])),
            ("mode", Column::Integer(vec![1, 4, 4])),
            ("more", real(&[0.0; 3])),
        ];
        let text = reported(&columns);
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert!(rows.contains(&vec!["variable", "unit", "min", "max", "final"]), "{text}");
        assert!(rows.contains(&vec!["torque", "1,", "-2", "7,", "5", "3,", "5"]), "{text}");
        assert!(rows.contains(&vec!["mode", "nadir", "safe", "safe"]) && text.ends_with("1 more"), "{text}");
    }
}
