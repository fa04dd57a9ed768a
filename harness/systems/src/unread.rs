//! Inputs that a component reads at some items of an option alone: which items, and what is connected in vain.

use model_description::{Description, value};

/// Options by which inputs are read.
struct Reading {
    /// The inputs: names, vectors by their bare names, beginnings that end in a point; `[k]` for any index.
    inputs: &'static [&'static str],
    /// The option, of the same index.
    option: &'static str,
    /// The items at which it reads them.
    items: &'static [&'static str],
    /// The item that is set where they are connected and it stands at the other one, which nobody chose.
    implied: Option<(&'static str, &'static str)>,
}

/// A reading without an implied item.
const fn reading(
    inputs: &'static [&'static str],
    option: &'static str,
    items: &'static [&'static str],
) -> Reading {
    Reading { inputs, option, items, implied: None }
}

const READINGS: [Reading; 7] = [
    Reading {
        implied: Some(("commanded", "guided")),
        ..reading(&["command."], "attitude.source", &["commanded", "controlled"])
    },
    Reading {
        implied: Some(("inputs", "guidance")),
        ..reading(&["command."], "command.source", &["inputs"])
    },
    reading(&["wheel[k].torqueCommand"], "attitude.source", &["free"]),
    reading(&["orbit.position", "orbit.velocity"], "orbit.source", &["inputs", "held"]),
    reading(
        &["sun.position", "sun.velocity", "earth.position", "earth.velocity"],
        "ephemeris.source",
        &["inputs"],
    ),
    reading(&["panel[k].angle"], "panel[k].control", &["angle"]),
    reading(&["panel[k].sunOffsetCommand"], "panel[k].control", &["command"]),
];

/// Inputs of a component that are connected and not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unread {
    /// The component; empty of an FMU by itself.
    pub component: String,
    /// The inputs, vectors by their bare names.
    pub inputs: Vec<String>,
    /// The option.
    pub option: String,
    /// The item that it stands at.
    pub item: String,
    /// The items at which they would be read.
    pub reading: &'static [&'static str],
    /// Item that the wiring sets instead.
    pub(crate) implied: Option<&'static str>,
}

impl std::fmt::Display for Unread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { component, inputs, option, item, reading, .. } = self;
        write!(
            f,
            "{component}: connected and not read: {}: found {option} at {item}, allowed: {}",
            inputs.join(", "),
            reading.join(", ")
        )
    }
}

/// Returns the inputs of a component of this description that are connected in vain, by its options' numbers; those that a component does not have it
/// does not read by.
pub(crate) fn unread(
    component: &str,
    description: &Description,
    connected: &[&str],
    number: impl Fn(&str) -> Option<i32>,
) -> Vec<Unread> {
    let mut found: Vec<Unread> = Vec::new();
    for reading in &READINGS {
        for input in connected {
            let Some(index) = reading.inputs.iter().find_map(|pattern| index(pattern, input)) else {
                continue;
            };
            let option = reading.option.replace("[k]", &format!("[{index}]"));
            let Some(variable) = description.variables.iter().find(|it| it.name == option) else { continue };
            let number = number(&option);
            let items = value::items(description, variable);
            let Some(item) = items.iter().find(|item| Some(item.value) == number) else { continue };
            // Another component's option of the same name.
            let is_known = items.iter().any(|item| reading.items.contains(&item.name.as_str()));
            if reading.items.contains(&item.name.as_str()) || !is_known {
                continue;
            }
            let vector =
                input.strip_suffix(']').and_then(|name| name.rsplit_once('[')).map_or(*input, |(of, _)| of);
            let of_option = found.iter_mut().find(|it| it.option == option && it.reading == reading.items);
            match of_option {
                Some(known) if known.inputs.iter().any(|it| it == vector) => {}
                Some(known) => known.inputs.push(vector.to_owned()),
                None => found.push(Unread {
                    component: component.to_owned(),
                    inputs: vec![vector.to_owned()],
                    option,
                    item: item.name.clone(),
                    reading: reading.items,
                    implied: reading
                        .implied
                        .filter(|(_, instead_of)| item.name == *instead_of)
                        .map(|it| it.0),
                }),
            }
        }
    }
    found
}

/// The index that stands for `[k]` where an input is what a pattern names; empty where there is none.
fn index<'a>(pattern: &str, input: &'a str) -> Option<&'a str> {
    let is = |name: &str, rest: &str| {
        rest.strip_prefix(name)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('[') || name.ends_with('.'))
    };
    match pattern.split_once("[k]") {
        Some((before, after)) => {
            let (index, rest) = input.strip_prefix(before)?.strip_prefix('[')?.split_once(']')?;
            is(after, rest).then_some(index)
        }
        None => is(pattern, input).then_some(""),
    }
}
