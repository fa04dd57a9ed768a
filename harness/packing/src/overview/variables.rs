//! Tables of variables, of the items of options, and of units.

use inputs::variables::{VariableRow, rows, start_text};
use model_description::{Description, ScalarVariable, SimpleTypeKind, VariableKind};

use super::causality::causality;

/// Tables of the variables at these positions and of the options that they take.
pub fn variables_and_options(description: &Description, positions: &[usize]) -> Vec<String> {
    [variables(description, positions)].into_iter().chain(enumerations(description, positions)).collect()
}

/// Table of units.
pub fn units(description: &Description) -> String {
    let mut table = terminal::table(&["unit", "also shown as"]);
    for unit in &description.units {
        let displays: Vec<&str> = unit.display_units.iter().map(|display| display.name.as_str()).collect();
        table.add_row([unit.name.clone(), displays.join(", ")]);
    }
    table.to_string()
}

/// The items of the options that these variables take.
fn enumerations(description: &Description, positions: &[usize]) -> Option<String> {
    let is_taken = |name: &str| {
        positions.iter().any(|&position| match &description.variables[position].kind {
            VariableKind::Enumeration { declared_type, .. } => declared_type == name,
            _ => false,
        })
    };
    let mut table = terminal::table(&["option", "item", "number", "meaning"]);
    for simple_type in description.types.iter().filter(|it| is_taken(&it.name)) {
        let SimpleTypeKind::Enumeration { items, .. } = &simple_type.kind else { continue };
        for (index, item) in items.iter().enumerate() {
            table.add_row([
                if index == 0 { simple_type.name.clone() } else { String::new() },
                item.name.clone(),
                item.value.to_string(),
                item.description.clone().unwrap_or_default(),
            ]);
        }
    }
    (!table.is_empty()).then(|| table.to_string())
}

/// Columns from which on a description stands beside its variable, and those before it on a narrower terminal.
const WIDE: u16 = 120;
const INDENT: usize = 4;

/// A vector is one row.
fn variables(description: &Description, positions: &[usize]) -> String {
    let chosen: Vec<&ScalarVariable> =
        positions.iter().map(|&position| &description.variables[position]).collect();
    let cells = |row: &VariableRow<'_>| {
        let unit = fmi::unit(description, row.first()).unwrap_or_default();
        [row.name(), causality(row.first()), row.joined(|it| start_text(description, it)), unit.to_owned()]
    };
    let says = |row: &VariableRow<'_>| row.first().description.clone().unwrap_or_default();
    if let Some(columns) = terminal::screen().output_columns.filter(|columns| *columns < WIDE) {
        let lines = rows(&chosen).map(|row| below(&cells(&row), &says(&row), usize::from(columns)));
        return lines.collect::<Vec<_>>().join("\n");
    }
    let mut table = terminal::table(&["variable", "causality", "start", "unit", "description"]);
    for row in rows(&chosen) {
        let [name, causality, start, unit] = cells(&row);
        table.add_row([name, causality, start, unit, says(&row)]);
    }
    table.to_string()
}

/// A variable with its description below it.
fn below([name, causality, start, unit]: &[String; 4], description: &str, columns: usize) -> String {
    let start = if start.is_empty() { String::new() } else { format!("start {start}") };
    let head: Vec<&str> =
        [name.as_str(), causality, &start, unit].into_iter().filter(|text| !text.is_empty()).collect();
    let mut lines = vec![head.join("  "), " ".repeat(INDENT)];
    for word in description.split_whitespace() {
        let last = lines.len() - 1;
        let is_begun = lines[last].len() > INDENT;
        if is_begun && lines[last].chars().count() + 1 + word.chars().count() > columns {
            lines.push(format!("{:INDENT$}{word}", ""));
        } else {
            lines[last].push_str(if is_begun { " " } else { "" });
            lines[last].push_str(word);
        }
    }
    lines.retain(|line| !line.trim().is_empty());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_terminal_has_the_description_below() {
        let cells = ["a[1..3]", "output", "", "N.m"].map(str::to_owned);
        assert_eq!(
            below(&cells, "Torque about the centre of mass.", 20),
            "a[1..3]  output  N.m\n    Torque about the\n    centre of mass."
        );
        assert_eq!(
            below(&["b".to_owned(), "input".to_owned(), "4".to_owned(), String::new()], "", 20),
            "b  input  start 4"
        );
    }
}
