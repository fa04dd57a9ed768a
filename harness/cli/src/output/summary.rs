//! The summary of a run on the terminal, where no file is named.

use std::{error::Error, path::PathBuf};

use loader::{Fmu, Recording};

use super::exporter::Exporter;

/// The summary, printed at the end.
pub struct Summary;

impl Exporter for Summary {
    fn finish(self: Box<Self>, fmu: &Fmu, recording: &Recording) -> Result<(), Box<dyn Error>> {
        Ok(terminal::print(&summary(fmu, recording))?)
    }

    fn leave(self: Box<Self>, _fmu: &Fmu, _recording: &Recording) -> Option<PathBuf> {
        None
    }
}

/// First, smallest, largest and last value of everything recorded.
fn summary(fmu: &Fmu, recording: &Recording) -> String {
    let mut table = terminal::table(&["variable", "unit", "first", "smallest", "largest", "last"]);
    for (name, column) in recording.names.iter().zip(&recording.columns) {
        let variable = fmu.find(name);
        let display = variable.and_then(|variable| loader::display_unit(fmu.description(), variable));
        let own = variable.and_then(|variable| loader::unit(fmu.description(), variable)).unwrap_or_default();
        let (unit, factor, offset) = display.unwrap_or((own, 1.0, 0.0));
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
        let values: Vec<f64> = column.numbers().into_iter().map(|value| factor * value + offset).collect();
        let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = values.first().copied().unwrap_or(f64::NAN);
        let last = values.last().copied().unwrap_or(f64::NAN);
        table.add_row([
            name.clone(),
            unit.to_owned(),
            terminal::short(first),
            terminal::short(smallest),
            terminal::short(largest),
            terminal::short(last),
        ]);
    }
    table.to_string()
}
