//! Files at the destination of a mission's output: only those that a run wrote are replaced without a message.

use std::{io::Read, path::Path};

use files::Destination;

use super::{file::OutputFile, origin};

/// How much of a file is looked at.
const HEAD: u64 = 1 << 16;

/// A kind of output.
#[derive(Clone, Copy, Debug)]
pub enum OutputKind<'a> {
    /// A table that begins with this line.
    Table(&'a [u8]),
    /// A table of a campaign's run, likewise.
    History(&'a [u8]),
    /// A picture.
    Picture,
    /// Origin of a table.
    Origin,
}

/// Refuses what a mission's own file may not name: a place outside the mission's folder, and a file that no run wrote. What is
/// given on the command line may be anywhere.
///
/// # Errors
/// What was found, and what is allowed.
pub fn check(file: &OutputFile, destination: &Destination, kind: OutputKind<'_>) -> Result<(), String> {
    let OutputFile { path, option, home } = file;
    let Some(home) = home else { return Ok(()) };
    let path = path.display();
    let (owner, anywhere, any) = match kind.option() {
        Some(instead) => {
            ("mission", format!("; {instead} may lead anywhere"), format!("; {instead} replaces any"))
        }
        None => ("campaign", String::new(), String::new()),
    };
    if !destination.is_within(home) {
        return Err(format!(
            "{path}: found a file outside the {owner}'s folder, allowed: one in it or below{anywhere}: see {option}"
        ));
    }
    let Some(existing) = destination.existing() else { return Ok(()) };
    match kind.standing_of(&head(existing)) {
        Standing::Same => Ok(()),
        Standing::Alike => {
            terminal::note(&format!(
                "{path}: found a table with other columns, which this run replaces: see {option}"
            ));
            Ok(())
        }
        Standing::Other => Err(format!(
            "{path}: found a file that no run wrote, allowed: none, or what a run wrote{any}: see {option}"
        )),
    }
}

/// Opens a further table beside a table: NAME-SUFFIX.csv for NAME.csv, with this header; nothing stands beside the standard output.
///
/// # Errors
/// A file that is none, an input, or none of a run where a mission names the table.
pub fn open_beside(
    table: &OutputFile,
    (suffix, header): (&str, &str),
    inputs: &[&Path],
) -> Result<Option<Destination>, String> {
    if table.path == Path::new("-") {
        return Ok(None);
    }
    let stem = table.path.file_stem().unwrap_or_default().to_string_lossy();
    let file =
        OutputFile { path: table.path.with_file_name(format!("{stem}-{suffix}.csv")), ..table.clone() };
    let destination = Destination::open(&file.path, file.option, inputs)?;
    check(&file, &destination, OutputKind::Table(header.as_bytes()))?;
    Ok(Some(destination))
}

/// Relation of a file to the output that would replace it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    /// An earlier one.
    Same,
    /// A table over time, which may be a run's.
    Alike,
    /// Anything else.
    Other,
}

impl OutputKind<'_> {
    /// The option that gives it a place instead, if one does.
    fn option(self) -> Option<&'static str> {
        match self {
            Self::Table(_) | Self::Origin | Self::Picture => Some("--output"),
            Self::History(_) => None,
        }
    }

    fn standing_of(self, head: &[u8]) -> Standing {
        let text = String::from_utf8_lossy(head);
        match self {
            // An empty file holds nothing to lose.
            _ if head.is_empty() => Standing::Same,
            Self::Table(header) | Self::History(header) if head.starts_with(header) => Standing::Same,
            Self::Table(_) | Self::History(_) if is_over_time(&text) => Standing::Alike,
            Self::Origin if text.starts_with(origin::HEAD) => Standing::Same,
            Self::Picture if drawing::is_chart(&text) => Standing::Same,
            _ => Standing::Other,
        }
    }
}

/// Whether its first column has the name and the numbers of times.
fn is_over_time(text: &str) -> bool {
    let mut first = text.lines().map(|line| line.split(',').next().unwrap_or_default().trim());
    first.next() == Some("time")
        && first.next().is_some_and(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite))
}

/// The beginning of a file; nothing of one that cannot be read is known, so it counts as no run's.
fn head(path: &Path) -> Vec<u8> {
    let mut head = Vec::new();
    let read = files::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    if read.is_ok() { head } else { b"?".to_vec() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_and_pictures_of_runs_are_reported_from_other_files() {
        let table = OutputKind::Table(b"time,a,b\n");
        for (text, expected) in [
            ("", Standing::Same),
            ("time,a,b\n", Standing::Same),
            ("time,a,b\n0,1,2\n", Standing::Same),
            ("time,a,c\n0,1,2\n", Standing::Alike),
            ("time,a,c\n", Standing::Other),
            ("time flies\nlike an arrow\n", Standing::Other),
            ("mass = 1\n", Standing::Other),
            ("\u{0}\u{1}", Standing::Other),
        ] {
            assert_eq!(table.standing_of(text.as_bytes()), expected, "{text:?}");
        }
        let panel = drawing::Panel {
            series: vec![drawing::Series::line("", vec![(0.0, 0.0)])],
            ..drawing::Panel::default()
        };
        let chart = drawing::Chart { panels: vec![panel], ..drawing::Chart::default() };
        let svg = drawing::svg(&[&chart]).unwrap();
        assert!(OutputKind::Picture.standing_of(svg.as_bytes()) == Standing::Same, "{svg}");
        for text in ["<svg xmlns=\"http://www.w3.org/2000/svg\"><path/></svg>", "time,a,b\n0,1,2\n"] {
            assert_eq!(OutputKind::Picture.standing_of(text.as_bytes()), Standing::Other, "{text:?}");
        }
    }
}
