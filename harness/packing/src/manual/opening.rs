//! Opening of the manual: model, examples, frames.

use fmi::Described;
use model_description::{Description, escape};

use super::section::Section;

/// Stands for the FMU's file in an example.
const FMU: &str = "{fmu}";

/// The sections that the library has texts for.
pub(super) fn sections(description: &Description, described: &Described) -> Vec<Section> {
    let identifier = description.co_simulation.as_ref().map_or("", |it| it.model_identifier.as_str());
    let code = |text: &str| {
        let own = text.replace(FMU, &format!("{identifier}.fmu"));
        format!("<pre><code>{}</code></pre>\n", escape(&own))
    };
    let with_code = |before: &str, text: &str| match text {
        "" => String::new(),
        text => format!("<p>{before}</p>\n{}", code(text)),
    };
    let sections = [
        ("about", "What it is", described.about.clone()),
        ("example", "First example", with_code("In Python with FMPy:", &described.example)),
        (
            "loop",
            "Closed loop",
            with_code(
                "A master of your own calls the FMU's functions itself; here with a small loop around it:",
                &described.closed_loop,
            ),
        ),
        ("frames", "Frames and units", described.frames.clone()),
    ];
    sections.into_iter().filter(|(.., content)| !content.is_empty()).collect()
}
