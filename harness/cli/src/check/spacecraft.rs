//! `heliotorque check my.toml`: whether a spacecraft can be packed.
//!
//! The library itself reads the file, so that what passes here passes in every FMU made from it.

use std::{path::Path, process::ExitCode};

use loader::Described;
use toml::{Table, Value, de::DeTable};

use crate::{
    app::Outcome,
    args::{Check, DEFAULT_TEMPLATE},
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
    let mut taken = None;
    for model in binary.models()?.into_iter().filter(|model| model.setup_file.is_some()) {
        match binary.describe(&model.model, Some(&file), Some(&text)) {
            Ok(described) => taken = taken.or(Some(described)),
            Err(reason) => refusals.push((model, reason)),
        }
    }
    // A model that takes the rest of the file is one that its start values are for.
    let rest = without_start_values(&text);
    let of_start = |model: &Described| {
        rest.as_ref().is_some_and(|rest| binary.describe(&model.model, None, Some(rest)).is_ok())
    };
    if let Some((model, problems)) = refusals.iter().find(|(model, _)| of_start(model)) {
        return refused(&file, model, problems);
    }
    // Each model takes its own kind of file; one that takes this one is enough.
    if let Some(described) = taken {
        let description = model_description::parse(described.xml.as_bytes())?.description;
        let variables = description.variables.len();
        let model = &described.model;
        terminal::print(&format!(
            "{file}: ok for {model}: {}; the FMU will have {variables} variables",
            contents(&text)
        ))?;
        return Ok(ExitCode::SUCCESS);
    }
    // The kinds of file are far apart: what the other models miss in it would hide what is wrong.
    let is_own = |model: &Described| Some(&model.model) == own.as_ref();
    let rank = |model: &Described| (common_keys(&text, &model.default_setup), is_own(model));
    let Some(fittest) = refusals.iter().max_by_key(|(model, _)| rank(model)) else {
        return Err(format!("{}: none of its models reads a file", template_path.display()).into());
    };
    let takes_the_same =
        |model: &Described| binary.describe(&model.model, None, Some(&fittest.0.default_setup)).is_ok();
    let judge = refusals.iter().find(|(model, _)| is_own(model) && takes_the_same(model));
    let (model, problems) = judge.unwrap_or(fittest);
    refused(&file, model, problems)
}

/// Tells the problems that a model finds in the file.
fn refused(file: &str, model: &Described, problems: &str) -> Outcome {
    terminal::print(problems)?;
    let count = problems.lines().filter(|line| line.starts_with(file)).count().max(1);
    let plural = if count == 1 { "problem" } else { "problems" };
    let model = &model.model;
    terminal::note(&format!(
        "{file}: {count} {plural}, judged as a file of {model}, which cannot be packed with it"
    ));
    Ok(ExitCode::FAILURE)
}

/// The file without its start values, if it has any.
fn without_start_values(text: &str) -> Option<String> {
    let mut file: Table = text.parse().ok()?;
    file.remove("start")?;
    Some(file.to_string())
}

/// EndReason many keys two files have in common, tables inside of tables left out.
fn common_keys(one: &str, other: &str) -> usize {
    // What can be read of a torn file tells its kind too.
    let (one, other) = (DeTable::parse_recoverable(one).0, DeTable::parse_recoverable(other).0);
    one.get_ref().keys().filter(|key| other.get_ref().contains_key(*key)).count()
}

/// EndReason many of each part the file describes: its lists of tables, and what its sunshade is given as.
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
    fn keys_in_common_are_counted_even_of_a_torn_file() {
        let file = "name = 1\n[mass]\nkg = 2\n[[wheels]]\nkg = 3\n";
        assert_eq!(common_keys(file, "kg = 1\n[mass]\n[[wheels]]\n[[wheels]]\n"), 2);
        assert_eq!(common_keys("name = 'A\n[mass]\n[[wheels]]\n", file), 3);
        assert_eq!(common_keys("", file), 0);
    }

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
