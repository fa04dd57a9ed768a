//! Builds the guide with mdBook and sets its formulas; a warning of mdBook is an error here.

pub mod formulas;
mod warnings;

use std::path::{Path, PathBuf};

use mdbook_driver::MDBook;

use crate::warnings::Warnings;

/// The folder of the project.
pub fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).map(Path::to_owned).unwrap_or_default()
}

/// Builds the book in `docs` into `output`, and gives its first page.
pub fn build(docs: &Path, output: &Path) -> Result<PathBuf, String> {
    let warnings = Warnings::default();
    let built = tracing::subscriber::with_default(warnings.clone(), || {
        let mut book = MDBook::load(docs).map_err(|error| format!("{error:#}"))?;
        book.config.build.build_dir = output.to_owned();
        formulas::set_formulas(&mut book.book)?;
        book.build().map_err(|error| format!("{error:#}"))
    });
    built?;
    let seen = warnings.seen();
    if seen.is_empty() { Ok(output.join("index.html")) } else { Err(seen.join("\n")) }
}
