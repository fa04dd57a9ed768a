//! `documentation/index.html`: what the FMU is, how it is used, and all that its description says, as a readable page.

pub mod opening;
pub mod reference_flight;
pub mod section;
pub mod spacecraft;
pub mod standard;
pub mod variables;

use fmi::Described;
use model_description::{Description, escape};

const STYLE: &str = include_str!("manual.css");

/// The page of an FMU of this description, with the setup it is packed with and a picture of that, an SVG.
pub fn html(description: &Description, described: &Described, setup: &str, drawing: Option<&str>) -> String {
    let mut sections = opening::sections(description, described);
    sections.extend(spacecraft::section(setup, drawing));
    sections.extend(variables::sections(description));
    sections.extend(standard::sources(&described.sources));
    sections.push(standard::stepping(description));
    sections.extend(reference_flight::section(description));
    sections.push(standard::calls());
    sections.push(standard::facts(description));

    let title = escape(&description.model_name);
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    if let Some(text) = &description.description {
        page.push_str(&format!("<p>{}</p>\n", escape(text)));
    }
    page.push_str("<nav>");
    for (id, heading, _) in &sections {
        page.push_str(&format!("<a href=\"#{id}\">{heading}</a> "));
    }
    page.push_str("<a href=\"licenses/license.txt\">Licences</a></nav>\n");
    for (id, heading, content) in &sections {
        page.push_str(&format!("<h2 id=\"{id}\">{heading}</h2>\n{content}"));
    }
    page.push_str("</body>\n</html>\n");
    page
}
