//! `heliotorque compare`: how far two tables are from each other, variable by variable.

mod json;
mod options;

use files::{
    Destination,
    outcome::{Answer, Outcome},
};
use inputs::ending::{OPTION, check_ending};
pub(crate) use options::Compare;
use tables::{
    compare::pairing::Pairing,
    table::{Sidecar, Table},
};

/// Compares.
pub(crate) fn run(arguments: &Compare) -> Outcome {
    let inputs = [arguments.first.as_path(), arguments.second.as_path()];
    let plot = arguments.output.as_deref().map(|path| {
        check_ending(path, "svg")?;
        Destination::open(path, OPTION, &inputs)
    });
    let plot = plot.transpose()?;
    let [first, second] = inputs.map(Table::read);
    let (first, second) = (first?, second?);
    let sidecar = Sidecar::beside(&first.path)?;
    let pairing = Pairing::new(&first, &second)?;
    let mut found = fmi::reference::differences(&pairing.columns);
    found.sort_by(|a, b| b.fraction.total_cmp(&a.fraction));
    let tables = [&first, &second];
    let judged = (&sidecar, arguments.tolerance);
    let text = match arguments.json {
        true => serde_json::to_string_pretty(&json::object(tables, &pairing, &found, judged))?,
        false => tables::compare::report::text(tables, &pairing, &found, judged),
    };
    let takes_stdout = plot.as_ref().is_some_and(Destination::is_stdout);
    if let Some(destination) = plot {
        let svg = tables::compare::picture::svg(tables, &pairing, &found, &sidecar)?;
        destination.fill(|file| file.write_all(svg.as_bytes()))?;
    }
    if takes_stdout {
        terminal::note(&text);
    } else {
        terminal::print(&text)?;
    }
    let is_beyond = found.iter().any(|it| it.fraction > arguments.tolerance);
    Ok(Answer::from(!is_beyond))
}
