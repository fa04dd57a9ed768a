//! Report of a comparison: the largest difference of every variable, and what only one table has.

use std::fmt::Write;

use fmi::reference::Difference;

use super::pairing::Pairing;
use crate::table::{Sidecar, TIME, Table};

/// Lone times and columns that are named; more are counted.
const NAMED: usize = 5;

/// As text; `found` is sorted, the largest fraction first.
pub fn text(
    tables: [&Table; 2],
    pairing: &Pairing,
    found: &[Difference],
    (sidecar, tolerance): (&Sidecar, f64),
) -> String {
    let [first, second] = tables.map(|table| table.path.display().to_string());
    let key = &tables[0].key;
    let is_time = key == TIME;
    let rows = if is_time { "times" } else { "rows" };
    let mut text = format!(
        "{first} and {second}: {} {rows} and {} variables in common",
        pairing.rows.len(),
        pairing.columns.len()
    );
    for (table, (lone_rows, lone_names)) in
        tables.iter().zip(pairing.lone_rows.iter().zip(&pairing.lone_names))
    {
        let file = table.path.display();
        let keys: Vec<String> = lone_rows.iter().map(|row| table.keys[*row].to_string()).collect();
        if !keys.is_empty() {
            let unit = if is_time { " s" } else { "" };
            let _ = write!(text, "\nonly {file} has {key} {}", listed(&keys, unit));
        }
        if !lone_names.is_empty() {
            let _ = write!(text, "\nonly {file} has {}", listed(lone_names, ""));
        }
    }
    if found.is_empty() {
        return text + "\nno difference";
    }
    let at = if is_time { "at [s]".to_owned() } else { format!("at {key}") };
    let mut table =
        terminal::table(&["variable", "unit", "largest difference", "of largest", &at, &first, &second]);
    for it in found {
        let (row, _) = pairing.rows[it.row];
        table.add_row([
            it.name.clone(),
            sidecar.unit(&it.name).unwrap_or_default().to_owned(),
            shown(it.absolute),
            shown(it.fraction),
            tables[0].keys[row].to_string(),
            it.expected.to_string(),
            it.found.to_string(),
        ]);
    }
    let _ = write!(text, "\n{table}");
    let beyond = found.iter().filter(|it| it.fraction > tolerance).count();
    let same = pairing.columns.len() - found.len();
    let verdict = match beyond {
        0 => "none".to_owned(),
        count => format!("{count} of {}", pairing.columns.len()),
    };
    let _ = write!(
        text,
        "\n{verdict} beyond {tolerance:e} of the largest magnitude of its vector; {same} without any difference"
    );
    text
}

/// A difference; infinite where one of both is no number, or where the first table has zeros alone.
fn shown(value: f64) -> String {
    if value.is_finite() { format!("{value:.3e}") } else { "infinite".to_owned() }
}

/// The first ones, the last one with a unit, and how many there are.
fn listed(all: &[String], unit: &str) -> String {
    match all {
        [first @ .., last] if all.len() > NAMED => {
            format!("{}, ... {last}{unit} ({})", first[..NAMED - 1].join(", "), all.len())
        }
        _ => all.join(", ") + unit,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_are_shortened() {
        let numbers = |count: usize| -> Vec<String> { (1..=count).map(|k| k.to_string()).collect() };
        assert_eq!(listed(&numbers(5), " s"), "1, 2, 3, 4, 5 s");
        assert_eq!(listed(&numbers(9), " s"), "1, 2, 3, 4, ... 9 s (9)");
    }
}
