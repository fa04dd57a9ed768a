//! `heliotorque info --coefficients`: what an FMU computes from its parameters, before any step.

mod spacecraft;
mod wheels;

use fmi::{Error, Fmu, Instance, Times, Value};
use inputs::variables::assigned;
use model_description::{Causality, ScalarVariable, names};

use crate::instance::started;

/// One row of a table: the elements of a vector, or of one row of a matrix.
struct CoefficientRow {
    name: String,
    unit: String,
    values: Vec<String>,
}

/// The tables for these settings: those of a spacecraft where it is one, then the other calculated parameters.
///
/// # Errors
/// Calls of the FMU that fail.
pub fn text(fmu: &Fmu, settings: &[String]) -> Result<String, Error> {
    let start_s = Times::from_fmu(fmu, None, None, None)?.start_s;
    let mut instance = started(fmu, "info", start_s, &assigned(fmu.description(), settings)?)?;
    let mut parts = spacecraft::tables(fmu, &mut instance)?;
    parts.extend(others(fmu, &mut instance)?);
    if parts.is_empty() {
        return Ok(format!("{} has no calculated parameters.", fmu.name()));
    }
    Ok(parts.join("\n\n"))
}

/// The calculated parameters that no table of a spacecraft shows; `None` if there are none.
fn others(fmu: &Fmu, instance: &mut Instance) -> Result<Option<String>, Error> {
    let calculated: Vec<&ScalarVariable> = fmu
        .description()
        .variables
        .iter()
        .filter(|it| it.causality == Causality::CalculatedParameter && !spacecraft::shows(&it.name))
        .collect();
    if calculated.is_empty() {
        return Ok(None);
    }
    let mut rows: Vec<CoefficientRow> = Vec::new();
    for variable in calculated {
        let value = match instance.get_variable(variable)? {
            Value::Real(value) => terminal::short(value),
            other => other.to_string(),
        };
        let name = row_name(&variable.name);
        let unit = fmi::unit(fmu.description(), variable).unwrap_or_default();
        match rows.last_mut() {
            Some(row) if row.name == name => row.values.push(value),
            _ => rows.push(CoefficientRow { name, unit: unit.to_owned(), values: vec![value] }),
        }
    }
    let mut table = terminal::table(&["calculated parameter", "unit", "value"]);
    for row in rows {
        let mut cells = vec![row.name, row.unit];
        cells.extend(row.values);
        table.add_row(cells);
    }
    Ok(Some(table.to_string()))
}

/// `a[2]` belongs to the row `a`, `a[3,7]` to the row `a[3]`.
fn row_name(name: &str) -> String {
    let Some((base, index)) = names::element(name) else { return name.to_owned() };
    match index.rsplit_once(',') {
        Some((rows, _)) => format!("{base}[{rows}]"),
        None => base.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_and_matrices_become_rows() {
        assert_eq!(row_name("a.b"), "a.b");
        assert_eq!(row_name("a[2]"), "a");
        assert_eq!(row_name("panel[2].c[3,7]"), "panel[2].c[3]");
        assert_eq!(row_name("panel[2].area"), "panel[2].area");
    }
}
