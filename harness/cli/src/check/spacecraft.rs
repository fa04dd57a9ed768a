//! `heliotorque check my.toml`: whether a spacecraft can be packed.
//!
//! The library itself reads the file, so that what passes here passes in every FMU made from it.

use std::{path::Path, process::ExitCode};

use toml::{Table, Value};

use crate::{
    app::Outcome,
    args::{Check, DEFAULT_TEMPLATE},
    output,
    pack::{read_text, source},
};

/// Has the models of the template's library read the file, the template's own first.
pub fn run(arguments: &Check) -> Outcome {
    let file = arguments.subject.display().to_string();
    let text = read_text(&arguments.subject)?;
    let template_path = arguments.template.as_deref().unwrap_or(Path::new(DEFAULT_TEMPLATE));
    let template = source::open_template(template_path)?;
    let binary = template.binary()?;
    let own = source::model_of(&template, &binary).ok();
    let mut refusals = Vec::new();
    for model in binary.models()?.iter().filter(|model| model.setup_file.is_some()) {
        match binary.describe(&model.model, Some(&file), Some(&text)) {
            // Each model takes its own kind of file; one that takes this one is enough.
            Ok(described) => {
                let description = model_description::parse(described.xml.as_bytes())?.description;
                let variables = description.variables.len();
                let model = &described.model;
                output::print(&format!(
                    "{file}: ok for {model}: {}; the FMU will have {variables} variables",
                    contents(&text)
                ))?;
                return Ok(ExitCode::SUCCESS);
            }
            Err(reason) => refusals.push((model.model.clone(), reason)),
        }
    }
    // The kinds of file are far apart: what the other models miss in it would bury what is wrong.
    let meant = refusals.iter().find(|(model, _)| Some(model) == own.as_ref()).or(refusals.first());
    let Some((model, problems)) = meant else {
        return Err(format!("{}: none of its models reads a file", template_path.display()).into());
    };
    output::print(problems)?;
    let count = problems.lines().count();
    let plural = if count == 1 { "problem" } else { "problems" };
    output::note(&format!("{file}: {count} {plural}; {model} cannot be packed with it"));
    Ok(ExitCode::FAILURE)
}

/// How many of each part the file describes: its lists of tables, and what its sunshade is given as.
fn contents(text: &str) -> String {
    let Ok(file) = text.parse::<Table>() else { return String::new() };
    let mut parts = lists(&file);
    if let Some(shade) = file.get("sunshade").and_then(Value::as_table) {
        let cylinder = shade.contains_key("cylinder").then(|| "a cylinder".to_owned());
        let given = lists(shade).into_iter().chain(cylinder).collect::<Vec<_>>().join(" and ");
        parts.push(format!("a sunshade of {given}"));
    }
    parts.join(", ")
}

fn lists(table: &Table) -> Vec<String> {
    let tables =
        |value: &Value| value.as_array().filter(|list| list.iter().all(Value::is_table)).map(Vec::len);
    let counted = table.iter().filter_map(|(key, value)| tables(value).map(|count| (key, count)));
    counted.map(|(key, count)| format!("{count} {}", counted_word(key, count))).collect()
}

/// A list's key as a word; some keys are singular, as in `[[thruster]]`.
fn counted_word(key: &str, count: usize) -> String {
    let singular = key.trim_end_matches('s').replace('_', " ");
    if count == 1 { singular } else { singular + "s" }
}

#[cfg(test)]
mod tests {
    //! Parts are counted wherever they stand, and only parts.

    use super::*;

    #[test]
    fn lists_of_tables_are_counted() {
        let text =
            "center = [1, 2]\n[[panels]]\n[[panels]]\n[[wheels]]\n[[sunshade.plates]]\n[optics.foil]\n";
        assert_eq!(contents(text), "2 panels, 1 wheel, a sunshade of 1 plate");
        let keys_in_singular = "[[group]]\n[[group]]\n[[thruster]]\n";
        assert_eq!(contents(keys_in_singular), "2 groups, 1 thruster");
        assert_eq!(contents("[sunshade.cylinder]"), "a sunshade of a cylinder");
        assert_eq!(contents("no toml"), "");
    }
}
