//! Inputs that a component reads at some items of an option alone, as its FMU annotates them, and what is connected in vain.

use model_description::{Description, names, value};

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
    pub reading: Vec<String>,
    /// The item that wiring sets where nobody chose one.
    pub(crate) implied: Option<String>,
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

/// Returns the inputs of a component of this description that are connected in vain, by its options' numbers.
pub(crate) fn unread(
    component: &str,
    description: &Description,
    connected: &[&str],
    number: impl Fn(&str) -> Option<i32>,
) -> Vec<Unread> {
    let named = |name: &str| description.variables.iter().find(|it| it.name == name);
    let mut found: Vec<Unread> = Vec::new();
    for input in connected {
        let annotation = named(input).and_then(|it| it.annotation.as_ref());
        for reading in annotation.iter().flat_map(|it| &it.read_where) {
            let items = named(&reading.option).map_or(&[][..], |option| value::items(description, option));
            let number = number(&reading.option);
            let Some(item) = items.iter().find(|item| Some(item.value) == number) else { continue };
            // An annotation without an item of this option says nothing of it.
            let reads = items.iter().filter(|item| item.is_among(&reading.items));
            let reads: Vec<String> = reads.map(|item| item.name.clone()).collect();
            if reads.is_empty() || item.is_among(&reading.items) {
                continue;
            }
            let input = names::element(input).map_or(*input, |(vector, _)| vector).to_owned();
            let known = found.iter_mut().find(|it| it.option == reading.option && it.reading == reads);
            match known {
                Some(known) if known.inputs.contains(&input) => {}
                Some(known) => known.inputs.push(input),
                None => {
                    let set = reading.set.as_ref().and_then(|set| items.iter().find(|it| it.is_called(set)));
                    found.push(Unread {
                        component: component.to_owned(),
                        inputs: vec![input],
                        option: reading.option.clone(),
                        item: item.name.clone(),
                        reading: reads,
                        implied: set.map(|item| item.name.clone()),
                    });
                }
            }
        }
    }
    found
}
