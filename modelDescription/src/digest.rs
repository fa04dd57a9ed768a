//! The canonical text of a description, from which the exporter computes the GUID.

use crate::document::{Sink, walk};
use crate::{DefaultExperiment, Description};

/// A text that changes exactly when the interface changes.
///
/// Left out, because the same binary serves all of them: `guid`, `modelName`, `modelIdentifier`,
/// `generationTool`, `generationDateAndTime`, and start, stop and step of the default experiment. Every
/// value carries its length, so no two descriptions share a text. The layout does not follow the XML
/// writer's white space or escapes.
pub fn canonical(description: &Description) -> String {
    let mut bare = description.clone();
    bare.guid.clear();
    bare.model_name.clear();
    bare.generation_tool = None;
    bare.generation_date_and_time = None;
    if let Some(co_simulation) = &mut bare.co_simulation {
        co_simulation.model_identifier.clear();
    }
    if let Some(model_exchange) = &mut bare.model_exchange {
        model_exchange.model_identifier.clear();
    }
    bare.default_experiment = bare.default_experiment.and_then(|experiment| {
        experiment
            .tolerance
            .map(|tolerance| DefaultExperiment { tolerance: Some(tolerance), ..DefaultExperiment::default() })
    });
    let mut sink = Canonical { text: "fmi2 description 1\n".to_owned() };
    walk(&bare, &mut sink);
    sink.text
}

struct Canonical {
    text: String,
}

impl Sink for Canonical {
    fn open(&mut self, element: &'static str) {
        self.text.push('(');
        self.text.push_str(element);
        self.text.push('\n');
    }

    fn attribute(&mut self, name: &'static str, text: &str) {
        self.text.push_str(name);
        self.text.push(' ');
        self.text.push_str(&text.len().to_string());
        self.text.push(':');
        self.text.push_str(text);
        self.text.push('\n');
    }

    fn close(&mut self) {
        self.text.push_str(")\n");
    }
}
