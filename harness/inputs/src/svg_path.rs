//! Paths of pictures: files that end in .svg, or the standard output.

use std::path::Path;

/// Whether a path promises this kind of picture, or is the standard output.
pub fn is_svg_path(path: &Path) -> bool {
    path == Path::new("-") || path.extension().is_some_and(|it| it.eq_ignore_ascii_case("svg"))
}

/// Refuses a path that promises another kind of picture.
pub fn check_svg_path(path: &Path, option: &str) -> Result<(), String> {
    if is_svg_path(path) {
        return Ok(());
    }
    Err(format!(
        "{}: found no SVG file's name, allowed: one that ends in .svg, or -: see {option}",
        path.display()
    ))
}
