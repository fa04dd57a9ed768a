//! Files of `--output`, told apart by the endings of their names.

use std::path::{Path, PathBuf};

use files::is_stdout;

/// Option that names the files.
pub const OPTION: &str = "--output";

/// Returns the file of each ending; `-`, the standard output, has the first one.
///
/// # Errors
/// Another ending, and two files of one.
pub fn by_ending<'a, const N: usize>(
    given: &'a [PathBuf],
    endings: [&str; N],
) -> Result<[Option<&'a Path>; N], String> {
    let mut files = [None; N];
    for path in given {
        let shown = path.display();
        let has = |ending: &&str| path.extension().is_some_and(|it| it.eq_ignore_ascii_case(ending));
        let Some(k) = endings.iter().position(has).or_else(|| is_stdout(path).then_some(0)) else {
            let listed = endings.iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ");
            let first = endings.first().map(|first| first.to_uppercase()).unwrap_or_default();
            return Err(format!(
                "{shown}: found another ending, allowed: {listed}, or - for {first} on the standard output: see {OPTION}"
            ));
        };
        if files[k].replace(path.as_path()).is_some() {
            return Err(format!("{shown}: found two files of .{}, allowed: one: see {OPTION}", endings[k]));
        }
    }
    Ok(files)
}

/// Refuses a file of another ending than the only one of a command.
///
/// # Errors
/// Another ending.
pub fn check_ending(path: &Path, ending: &str) -> Result<(), String> {
    by_ending(&[path.to_owned()], [ending]).map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_picks_the_format() {
        let paths = |names: &[&str]| names.iter().map(PathBuf::from).collect::<Vec<_>>();
        let given = paths(&["b.SVG", "-"]);
        assert_eq!(by_ending(&given, ["csv", "svg"]), Ok([Some(Path::new("-")), Some(Path::new("b.SVG"))]));
        for (names, expected) in [
            (&["a.png"][..], "a.png: found another ending, allowed: .csv, .svg, or - for CSV on"),
            (&["csv"], "csv: found another ending"),
            (&["a.csv", "-"], "-: found two files of .csv"),
        ] {
            let refused = by_ending(&paths(names), ["csv", "svg"]).unwrap_err();
            assert!(refused.starts_with(expected), "{refused}");
        }
    }
}
