//! Sources, and what FMI has a standard for: stepping, calls, capability flags.

use std::fmt::Write;

use model_description::call_table::{Access, Condition, Function, LENIENCIES, State, allowed};
use model_description::{CoSimulation, Description, escape};

use super::section::{Section, table};

/// By what the FMU computes.
pub(super) fn sources(sources: &[(String, String)]) -> Option<Section> {
    let row = |(what, by): &(String, String)| {
        format!("<tr><td>{}</td><td>{}</td></tr>\n", escape(what), escape(by))
    };
    let rows = sources.iter().map(row);
    (!sources.is_empty()).then(|| ("sources", "Sources", table(&["What", "By"], rows)))
}

/// Default experiment, GUID, log categories, capability flags.
pub(super) fn facts(description: &Description) -> Section {
    let mut rows = Vec::new();
    let mut row = |name: &str, value: &str| {
        rows.push(format!("<tr><td class=\"n\">{}</td><td>{}</td></tr>\n", escape(name), escape(value)));
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
    row("GUID", &description.guid);
    for category in &description.log_categories {
        row(&format!("log category {}", category.name), category.description.as_deref().unwrap_or(""));
    }
    if let Some(flags) = &description.co_simulation {
        capability_rows(flags).for_each(|(name, value)| row(name, &value));
    }
    ("facts", "Facts and capabilities", format!("<table>\n{}</table>\n", rows.concat()))
}

/// Guarantees for an importer between two communication points.
pub(super) fn stepping(description: &Description) -> Section {
    let mut page = String::from(
        "<p>Communication points may lie anywhere: while inputs and tunable parameters stay \
         as they are, results do not depend on where they lie, except as Sources states. Setting an input to another value takes effect at the \
         beginning of the next step; setting it to the same value does nothing.</p>\n",
    );
    let Some(flags) = &description.co_simulation else { return ("stepping", "Stepping", page) };
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
    ("stepping", "Stepping", page)
}

/// Table of the functions that may be called in each state.
pub(super) fn calls() -> Section {
    let mut page = String::from(
        "<p>Which function may be called in which state (FMI 2.0.5, 4.2.4). A call \
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
            "<p class=\"secondary\">Beyond the table: {} in state {} for {}, answered with <code>{}</code>, because {}.</p>",
            functions.join(", "),
            leniency.state.name(),
            leniency.variables,
            leniency.answer,
            escape(leniency.reason)
        );
    }
    ("calls", "Calls", page)
}

/// The capabilities by the standard's names.
pub fn capability_rows(flags: &CoSimulation) -> impl Iterator<Item = (&'static str, String)> {
    let switches = [
        ("canHandleVariableCommunicationStepSize", flags.can_handle_variable_communication_step_size),
        ("canInterpolateInputs", flags.can_interpolate_inputs),
        ("canGetAndSetFMUstate", flags.can_get_and_set_fmu_state),
        ("canSerializeFMUstate", flags.can_serialize_fmu_state),
        ("providesDirectionalDerivative", flags.provides_directional_derivative),
        ("canRunAsynchronuously", flags.can_run_asynchronuously),
        ("canBeInstantiatedOnlyOncePerProcess", flags.can_be_instantiated_only_once_per_process),
        ("canNotUseMemoryManagementFunctions", flags.can_not_use_memory_management_functions),
        ("needsExecutionTool", flags.needs_execution_tool),
    ];
    let switches = switches.map(|(name, is_on)| (name, if is_on { "yes" } else { "no" }.to_owned()));
    let order = ("maxOutputDerivativeOrder", flags.max_output_derivative_order.to_string());
    [("modelIdentifier", flags.model_identifier.clone())].into_iter().chain(switches).chain([order])
}
