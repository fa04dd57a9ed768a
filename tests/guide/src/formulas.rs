//! Formulas between lines `$$`, from LaTeX to MathML, which browsers set without a script.

use mdbook_driver::book::{Book, BookItem};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

/// Line that begins and ends a formula.
const FENCE: &str = "$$";

/// Sets the formulas of all chapters; an error names the chapter.
pub fn set_formulas(book: &mut Book) -> Result<(), String> {
    let mut outcome = Ok(());
    book.for_each_mut(|item| {
        let BookItem::Chapter(chapter) = item else { return };
        match with_mathml(&chapter.content) {
            Ok(content) => chapter.content = content,
            Err(problem) => outcome = Err(format!("{}: {problem}", chapter.name)),
        }
    });
    outcome
}

/// Returns a Markdown text with its formulas in MathML, each a block of HTML.
pub fn with_mathml(text: &str) -> Result<String, String> {
    let mut written = String::with_capacity(text.len());
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.trim() != FENCE {
            written.push_str(line);
            written.push('\n');
            continue;
        }
        let indent = &line[..line.len() - line.trim_start().len()];
        let mut formula = String::new();
        let is_closed = lines.by_ref().any(|line| {
            formula.push_str(line.trim_start());
            formula.push('\n');
            line.trim() == FENCE
        });
        let formula = formula.trim_end().strip_suffix(FENCE).filter(|_| is_closed);
        let formula = formula.ok_or_else(|| format!("`{FENCE}` without a second one"))?;
        written.push_str(&format!("{indent}<div class=\"formula\">{}</div>\n", mathml(formula)?));
    }
    Ok(written)
}

/// The MathML of a formula, in one line.
fn mathml(formula: &str) -> Result<String, String> {
    let storage = Storage::new();
    if let Some(problem) = Parser::new(formula, &storage).find_map(Result::err) {
        return Err(format!("{formula}: {problem}"));
    }
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    let mut written = String::new();
    push_mathml(&mut written, Parser::new(formula, &storage), config).map_err(|error| error.to_string())?;
    // The crate writes operators as they are, also those that HTML reserves.
    Ok(written
        .replace('\n', " ")
        .replace("<mo><</mo>", "<mo>&lt;</mo>")
        .replace("<mo>></mo>", "<mo>&gt;</mo>"))
}
