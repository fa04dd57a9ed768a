//! Sections and tables of the page.

/// A section: its id, its heading and its content in HTML.
pub(super) type Section = (&'static str, &'static str, String);

/// A table of what stands for itself without its header: on a narrow screen each row is a block.
pub(super) fn list(header: &[&str], rows: impl IntoIterator<Item = String>) -> String {
    table(header, rows).replacen("<table>", "<table class=\"list\">", 1)
}

/// A table with a header.
pub(super) fn table(header: &[&str], rows: impl IntoIterator<Item = String>) -> String {
    let header: String = header.iter().map(|name| format!("<th>{name}</th>")).collect();
    let rows: String = rows.into_iter().collect();
    format!("<div class=\"wide\"><table>\n<tr>{header}</tr>\n{rows}</table></div>\n")
}
