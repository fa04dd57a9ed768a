//! The summary of a run on the terminal, where no file is named.

use std::{error::Error, path::PathBuf};

use loader::Recording;
use model_description::Description;

use super::{exporter::Exporter, shown::Shown};

/// Rows of the table of last values at most.
const LAST_ROWS: usize = 24;

/// The summary, printed at the end.
pub struct Summary;

impl Exporter for Summary {
    fn finish(self: Box<Self>, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        Ok(terminal::print(&summary(described, recording))?)
    }

    fn leave(self: Box<Self>, _described: &Description, _recording: &Recording) -> Option<PathBuf> {
        None
    }
}

/// First, smallest, largest and last value of everything recorded.
fn summary(described: &Description, recording: &Recording) -> String {
    let mut table = terminal::table(&["variable", "unit", "first", "smallest", "largest", "last"]);
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        if let loader::Column::Text(texts) = column {
            let at = |text: Option<&String>| text.cloned().unwrap_or_default();
            table.add_row([
                name.clone(),
                String::new(),
                at(texts.first()),
                String::new(),
                String::new(),
                at(texts.last()),
            ]);
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
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        let shown = Shown::of(described, name);
        let text = match column {
            loader::Column::Text(texts) => texts.last().cloned().unwrap_or_default(),
            column => shown.text(column.numbers().last().map_or(Some(f64::NAN), |value| shown.value(*value))),
        };
        let vector = name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
        let name = vector.map_or(name.as_str(), |(vector, _)| vector);
        match rows.last_mut() {
            Some((of, _, values)) if vector.is_some() && *of == name => values.push(text),
            _ => rows.push((name, shown.unit, vec![text])),
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
