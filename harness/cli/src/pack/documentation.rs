//! `documentation/index.html`: the model description as a readable page.

use std::fmt::Write;

use model_description::call_table::{Access, Condition, Function, LENIENCIES, State, allowed};
use model_description::{Causality, Description, ScalarVariable, SimpleTypeKind, VariableKind, escape};

use crate::info;

const STYLE: &str = "
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1.25rem;
  color: light-dark(#262b33, #e2e6eb); background: light-dark(#fff, #181b20); }
h1 { font-size: 1.9rem; margin: 0 0 .25rem; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 .75rem; }
figure { margin: 0; }
figure svg { max-width: 100%; height: auto; border-radius: .5rem; }
table { border-collapse: collapse; width: 100%; font-size: .875rem; }
th { text-align: left; font-weight: 600; }
th, td { padding: .3rem .9rem .3rem 0; border-bottom: 1px solid light-dark(#e3e6ea, #31363f); vertical-align: top; }
td.n, td.v { white-space: nowrap; }
td.n, code { font-family: ui-monospace, 'Cascadia Code', Menlo, monospace; font-size: .92em; }
.wide { overflow-x: auto; clear: both; }
.calls td, .calls th { text-align: center; padding: .2rem .4rem; }
.calls td:first-child, .calls th:first-child { text-align: left; }
p.secondary, .secondary { color: light-dark(#5c6570, #9aa2ac); }
nav a { margin-right: 1rem; }
";

/// The sections that list variables, in reading order.
const SECTIONS: [(Causality, &str, &str); 6] = [
    (Causality::Parameter, "parameters", "Parameters"),
    (Causality::Input, "inputs", "Inputs"),
    (Causality::Output, "outputs", "Outputs"),
    (Causality::CalculatedParameter, "calculated", "Calculated parameters"),
    (Causality::Local, "locals", "Locals"),
    (Causality::Independent, "independent", "Independent variable"),
];

/// The page; `sources` are quantities and by what they are computed, `drawing` an SVG of the spacecraft.
pub fn html(description: &Description, sources: &[(String, String)], drawing: Option<&str>) -> String {
    let mut page = String::new();
    let title = escape(&description.model_name);
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n"
    );
    let _ = writeln!(page, "<h1>{title}</h1>");
    if let Some(text) = &description.description {
        let _ = writeln!(page, "<p>{}</p>", escape(text));
    }
    navigation(&mut page, description, sources, drawing.is_some());
    if let Some(svg) = drawing {
        let _ = writeln!(page, "<h2 id=\"spacecraft\">Spacecraft</h2>\n<figure>{svg}</figure>");
    }
    facts(&mut page, description);
    options(&mut page, description);
    for (causality, id, heading) in SECTIONS {
        variables(&mut page, description, causality, id, heading);
    }
    computation(&mut page, sources);
    stepping(&mut page, description);
    calls(&mut page);
    page.push_str("</body>\n</html>\n");
    page
}

fn navigation(page: &mut String, description: &Description, sources: &[(String, String)], is_drawn: bool) {
    page.push_str("<nav>");
    if is_drawn {
        page.push_str("<a href=\"#spacecraft\">Spacecraft</a>");
    }
    page.push_str("<a href=\"#facts\">Facts</a>");
    if has_options(description) {
        page.push_str("<a href=\"#options\">Options</a>");
    }
    for (causality, id, heading) in SECTIONS {
        if description.variables.iter().any(|variable| variable.causality == causality) {
            let _ = write!(page, "<a href=\"#{id}\">{heading}</a>");
        }
    }
    if !sources.is_empty() {
        page.push_str("<a href=\"#sources\">Sources</a>");
    }
    page.push_str("<a href=\"#stepping\">Stepping</a><a href=\"#calls\">Calls</a>");
    page.push_str("<a href=\"licenses/license.txt\">Licences</a></nav>\n");
}

fn facts(page: &mut String, description: &Description) {
    page.push_str("<h2 id=\"facts\">Facts</h2>\n<table>\n");
    let mut row = |name: &str, value: &str| {
        let _ = writeln!(page, "<tr><td class=\"n\">{name}</td><td>{}</td></tr>", escape(value));
    };
    if let Some(experiment) = description.default_experiment {
        let times = [
            ("default start", experiment.start_time, " s"),
            ("default stop", experiment.stop_time, " s"),
            ("default step", experiment.step_size, " s"),
            ("tolerance", experiment.tolerance, ""),
        ];
        for (name, value, unit) in times {
            if let Some(value) = value {
                row(name, &format!("{}{unit}", terminal::short(value)));
            }
        }
    }
    if let Some(flags) = &description.co_simulation {
        row("modelIdentifier", &flags.model_identifier);
        for (name, value) in info::flags(flags) {
            row(name, if value { "yes" } else { "no" });
        }
        row("maxOutputDerivativeOrder", &flags.max_output_derivative_order.to_string());
    }
    row("GUID", &description.guid);
    for category in &description.log_categories {
        row(
            &format!("log category {}", escape(&category.name)),
            category.description.as_deref().unwrap_or(""),
        );
    }
    page.push_str("</table>\n");
}

fn has_options(description: &Description) -> bool {
    description.types.iter().any(|it| matches!(it.kind, SimpleTypeKind::Enumeration { .. }))
}

fn options(page: &mut String, description: &Description) {
    if !has_options(description) {
        return;
    }
    page.push_str(
        "<h2 id=\"options\">Options</h2>\n<div class=\"wide\"><table>\n\
         <tr><th>Type</th><th>Number</th><th>Item</th><th>Meaning</th></tr>\n",
    );
    for simple_type in &description.types {
        let SimpleTypeKind::Enumeration { items, .. } = &simple_type.kind else { continue };
        for (index, item) in items.iter().enumerate() {
            let name = if index == 0 { escape(&simple_type.name) } else { String::new() };
            let _ = writeln!(
                page,
                "<tr><td class=\"n\">{name}</td><td>{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
                item.value,
                escape(&item.name),
                escape(item.description.as_deref().unwrap_or_default())
            );
        }
    }
    page.push_str("</table></div>\n");
}

fn variables(page: &mut String, description: &Description, causality: Causality, id: &str, heading: &str) {
    let mut listed =
        description.variables.iter().filter(|variable| variable.causality == causality).peekable();
    if listed.peek().is_none() {
        return;
    }
    let start = if causality == Causality::Output { "" } else { "<th>Start</th>" };
    let _ = writeln!(
        page,
        "<h2 id=\"{id}\">{heading}</h2>\n<div class=\"wide\"><table>\n\
         <tr><th>Name</th><th>Unit</th>{start}<th>Kind</th><th>Meaning</th></tr>"
    );
    for variable in listed {
        let start = if start.is_empty() {
            String::new()
        } else {
            format!("<td class=\"v\">{}</td>", escape(&info::start(description, variable)))
        };
        let _ = writeln!(
            page,
            "<tr><td class=\"n\">{}</td><td class=\"v\">{}</td>{start}<td>{}</td><td>{}</td></tr>",
            escape(&variable.name),
            escape(&unit(description, variable)),
            escape(&kind(variable)),
            escape(variable.description.as_deref().unwrap_or_default()),
        );
    }
    page.push_str("</table></div>\n");
}

fn unit(description: &Description, variable: &ScalarVariable) -> String {
    let unit = loader::unit(description, variable).unwrap_or_default();
    match loader::display_unit(description, variable) {
        Some((display, _, _)) if display != unit => format!("{unit} ({display})"),
        _ => unit.to_owned(),
    }
}

/// Variability, base type and limits.
fn kind(variable: &ScalarVariable) -> String {
    let variability = format!("{:?}", variable.variability).to_lowercase();
    let (base, low, high) = match &variable.kind {
        VariableKind::Real { attributes, .. } => {
            ("Real", attributes.min.map(terminal::short), attributes.max.map(terminal::short))
        }
        VariableKind::Integer { min, max, .. } => {
            ("Integer", min.map(|min| min.to_string()), max.map(|max| max.to_string()))
        }
        VariableKind::Boolean { .. } => ("Boolean", None, None),
        VariableKind::String { .. } => ("String", None, None),
        VariableKind::Enumeration { declared_type, .. } => (declared_type.as_str(), None, None),
    };
    let limits = match (low, high) {
        (Some(low), Some(high)) => format!(", {low} to {high}"),
        (Some(low), None) => format!(", from {low}"),
        (None, Some(high)) => format!(", up to {high}"),
        (None, None) => String::new(),
    };
    format!("{variability} {base}{limits}")
}

fn computation(page: &mut String, sources: &[(String, String)]) {
    if sources.is_empty() {
        return;
    }
    page.push_str(
        "<h2 id=\"sources\">Sources</h2>\n<div class=\"wide\"><table>\n<tr><th>What</th><th>By</th></tr>\n",
    );
    for (what, by) in sources {
        let _ = writeln!(page, "<tr><td>{}</td><td>{}</td></tr>", escape(what), escape(by));
    }
    page.push_str("</table></div>\n");
}

/// What an importer may count on between two communication points.
fn stepping(page: &mut String, description: &Description) {
    page.push_str(
        "<h2 id=\"stepping\">Stepping</h2>\n<p>Communication points may lie anywhere: while inputs and tunable parameters stay \
         as they are, results do not depend on where they lie, except as Sources states. Setting an input to another value takes effect at the \
         beginning of the next step; setting it to the same value does nothing.</p>\n",
    );
    let Some(flags) = &description.co_simulation else { return };
    if flags.can_interpolate_inputs {
        page.push_str(
            "<p>Input derivatives make an input a Taylor polynomial about the beginning of the next step; they hold for that \
             step alone and are then forgotten. Which inputs follow theirs stands under Sources.</p>\n",
        );
    }
    match flags.max_output_derivative_order {
        0 => {}
        1 => page.push_str(
            "<p>Output derivatives are those of the motion at the end of the last step, of order 1.</p>\n",
        ),
        order => {
            let _ = writeln!(
                page,
                "<p>Output derivatives are those at the end of the last step, up to order {order}.</p>"
            );
        }
    }
    if flags.can_get_and_set_fmu_state {
        page.push_str(
            "<p>A saved state goes on to the bit, in another instance and, serialised, in another process.</p>\n",
        );
    }
}

fn calls(page: &mut String) {
    page.push_str(
        "<h2 id=\"calls\">Calls</h2>\n<p>Which function may be called in which state (FMI 2.0.5, 4.2.4). A call \
         outside the table is logged and answered with <code>fmi2Error</code>.</p>\n\
         <div class=\"wide\"><table class=\"calls\">\n<tr><th>Function</th>",
    );
    for state in State::ALL {
        let _ = write!(page, "<th>{}</th>", state.name());
    }
    page.push_str("</tr>\n");
    let mut notes: Vec<Condition> = Vec::new();
    for &function in Function::ALL {
        let _ = write!(page, "<tr><td class=\"n\">{}</td>", function.symbol());
        for state in State::ALL {
            match allowed(function, state) {
                Access::Allowed => page.push_str("<td>yes</td>"),
                Access::Forbidden => page.push_str("<td class=\"secondary\">&ndash;</td>"),
                Access::Conditional(condition) => {
                    if !notes.contains(&condition) {
                        notes.push(condition);
                    }
                    let _ = write!(page, "<td>({})</td>", condition.number());
                }
            }
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</table></div>\n<p class=\"secondary\">");
    notes.sort_by_key(|condition| condition.number());
    for condition in notes {
        let _ = write!(page, "({}) {}. ", condition.number(), escape(condition.text()));
    }
    page.push_str("</p>\n");
    for leniency in LENIENCIES {
        let functions: Vec<&str> = leniency.functions.iter().map(|function| function.symbol()).collect();
        let _ = writeln!(
            page,
            "<p class=\"secondary\">Beyond the table: {} in state {} for {}, because {}.</p>",
            functions.join(", "),
            leniency.state.name(),
            leniency.variables,
            escape(leniency.reason)
        );
    }
}
