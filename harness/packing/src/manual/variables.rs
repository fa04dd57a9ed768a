//! Options and variables.

use inputs::variables::{self, VariableRow, start_text};
use model_description::{Causality, Description, ScalarVariable, SimpleTypeKind, VariableKind, escape};

use super::section::{Section, list};

/// The sections that list variables, in reading order.
const SECTIONS: [(Causality, &str, &str); 6] = [
    (Causality::Input, "inputs", "Inputs"),
    (Causality::Output, "outputs", "Outputs"),
    (Causality::Parameter, "parameters", "Parameters"),
    (Causality::CalculatedParameter, "calculated", "Calculated parameters"),
    (Causality::Local, "locals", "Locals"),
    (Causality::Independent, "independent", "Independent variable"),
];

/// Every section that has something to list.
pub(super) fn sections(description: &Description) -> Vec<Section> {
    let listed = SECTIONS.into_iter().filter_map(|(causality, id, heading)| {
        let of_causality = description.variables.iter().filter(|it| it.causality == causality);
        let of_causality: Vec<&ScalarVariable> = of_causality.collect();
        let rows: Vec<String> = variables::rows(&of_causality).map(|it| row(description, &it)).collect();
        let header: &[&str] = match causality {
            Causality::Output => &["Name", "Unit", "Kind", "Meaning"],
            _ => &["Name", "Unit", "Start", "Kind", "Meaning"],
        };
        (!rows.is_empty()).then(|| (id, heading, list(header, rows)))
    });
    listed.chain(options(description)).collect()
}

fn row(description: &Description, row: &VariableRow<'_>) -> String {
    let variable = row.first();
    let start = match variable.causality {
        Causality::Output => String::new(),
        _ => format!("<td class=\"v\">{}</td>", escape(&row.joined(|it| start_text(description, it)))),
    };
    format!(
        "<tr><td class=\"n\">{}</td><td class=\"v\">{}</td>{start}<td>{}</td><td class=\"m\">{}</td></tr>\n",
        escape(&row.name()),
        escape(&unit(description, variable)),
        escape(&kind(description, variable)),
        escape(variable.description.as_deref().unwrap_or_default()),
    )
}

fn unit(description: &Description, variable: &ScalarVariable) -> String {
    let unit = fmi::unit(description, variable).unwrap_or_default();
    match fmi::display_unit(description, variable) {
        Some((display, _, _)) if display != unit => format!("{unit} ({display})"),
        _ => unit.to_owned(),
    }
}

/// Variability, base type and limits, in the display unit too.
fn kind(description: &Description, variable: &ScalarVariable) -> String {
    let variability = format!("{:?}", variable.variability).to_lowercase();
    let (base, limits) = match &variable.kind {
        VariableKind::Real { attributes, .. } => {
            let (min, max) = (attributes.min, attributes.max);
            let own = limits(min.map(terminal::short), max.map(terminal::short));
            let display = fmi::display_unit(description, variable);
            let shown = display.map_or(String::new(), |(name, factor, offset)| {
                let number = |limit: f64| terminal::short(factor * limit + offset);
                let shown = limits(min.map(number), max.map(number));
                if shown == own { String::new() } else { format!(" ({shown} {name})") }
            });
            ("Real", own + &shown)
        }
        VariableKind::Integer { min, max, .. } => {
            ("Integer", limits(min.map(|min| min.to_string()), max.map(|max| max.to_string())))
        }
        VariableKind::Boolean { .. } => ("Boolean", String::new()),
        VariableKind::String { .. } => ("String", String::new()),
        VariableKind::Enumeration { declared_type, .. } => (declared_type.as_str(), String::new()),
    };
    let separator = if limits.is_empty() { "" } else { ", " };
    format!("{variability} {base}{separator}{limits}")
}

fn limits(low: Option<String>, high: Option<String>) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!("{low} to {high}"),
        (Some(low), None) => format!("from {low}"),
        (None, Some(high)) => format!("up to {high}"),
        (None, None) => String::new(),
    }
}

fn options(description: &Description) -> Option<Section> {
    let mut rows = Vec::new();
    for simple_type in &description.types {
        let SimpleTypeKind::Enumeration { items, .. } = &simple_type.kind else { continue };
        for (index, item) in items.iter().enumerate() {
            let name = if index == 0 { escape(&simple_type.name) } else { String::new() };
            rows.push(format!(
                "<tr><td class=\"n\">{name}</td><td>{}</td><td class=\"v\"><code>{}</code></td><td class=\"m\">{}</td></tr>\n",
                item.value,
                escape(&item.name),
                escape(item.description.as_deref().unwrap_or_default())
            ));
        }
    }
    (!rows.is_empty()).then(|| ("options", "Options", list(&["Type", "Number", "Item", "Meaning"], rows)))
}
