//! `--json` of `heliotorque compare`.

use fmi::reference::{Cell, Difference};
use serde_json::{Value, json};

use tables::{
    compare::pairing::Pairing,
    table::{Sidecar, Table},
};

fn cell(cell: &Cell) -> Value {
    match cell {
        Cell::Real(number) => json!(number),
        other => json!(other.to_string()),
    }
}

/// Returns the object: what both tables have in common, every difference, and what one table has alone.
pub(super) fn object(
    tables: [&Table; 2],
    pairing: &Pairing,
    found: &[Difference],
    (sidecar, tolerance): (&Sidecar, f64),
) -> Value {
    let differences = found.iter().map(|it| {
        let (row, _) = pairing.rows[it.row];
        json!({
            "name": it.name,
            "unit": sidecar.unit(&it.name),
            "absolute": it.absolute,
            "fraction": it.fraction,
            "at": tables[0].keys[row],
            "first": cell(&it.expected),
            "second": cell(&it.found),
        })
    });
    let alone = |k: usize| {
        let keys = pairing.lone_rows[k].iter().map(|row| tables[k].keys[*row]);
        json!({ "rows": keys.collect::<Vec<_>>(), "columns": pairing.lone_names[k] })
    };
    json!({
        "first": tables[0].path,
        "second": tables[1].path,
        "key": tables[0].key,
        "rows": pairing.rows.len(),
        "variables": pairing.columns.len(),
        "tolerance": tolerance,
        "beyond": found.iter().filter(|it| it.fraction > tolerance).count(),
        "differences": differences.collect::<Vec<_>>(),
        "onlyFirst": alone(0),
        "onlySecond": alone(1),
    })
}
