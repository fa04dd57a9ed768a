//! Tables as text: on the terminal, and as CSV whose cells have neither comma nor quote.

use std::fmt::Display;

use terminal::Table;

/// A table for the terminal whose header is written with ` | ` between its columns.
pub(crate) fn headed(header: &str) -> Table {
    terminal::table(&header.split(" | ").collect::<Vec<_>>())
}

/// Rows below a header.
pub(crate) fn csv<R: IntoIterator<Item: Display>>(header: &str, rows: impl IntoIterator<Item = R>) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        let cells: Vec<String> = row.into_iter().map(|cell| cell.to_string()).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}
