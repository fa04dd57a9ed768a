//! An FMU of a shipped spacecraft with a few lines of its file changed.

use std::fs;

use files::Scratch;
use loader::{Fmu, copy_folder};

use crate::options::Cause;

/// Names in an FMU's resources.
const FILE: &str = "spacecraft.toml";
const TIMELINE: &str = "timeline.toml";

/// A change of the file's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edit {
    /// Text after which the change stands; empty for the beginning.
    pub after: &'static str,
    /// What stands there.
    pub from: &'static str,
    /// What is to stand there.
    pub to: &'static str,
}

/// The text with every edit made at the first place it fits.
///
/// # Errors
/// An edit that does not apply.
pub(super) fn edited(text: &str, edits: &[Edit]) -> Result<String, String> {
    edits.iter().try_fold(text.to_owned(), |text, edit| {
        let place = text.find(edit.after).and_then(|at| {
            let from = at + edit.after.len();
            Some(from + text.get(from..)?.find(edit.from)?)
        });
        let at =
            place.ok_or_else(|| format!("spacecraft.toml has no `{}` after `{}`", edit.from, edit.after))?;
        let (before, rest) = text.split_at(at);
        Ok([before, edit.to, rest.strip_prefix(edit.from).unwrap_or(rest)].concat())
    })
}

/// An FMU unpacked into a temporary folder.
pub(super) struct Variant {
    /// The FMU.
    pub fmu: Fmu,
    _folder: Scratch,
}

impl Variant {
    /// The template with its spacecraft file edited, described by its own library.
    ///
    /// # Errors
    /// An edit that does not apply, a file that the model refuses, a folder that cannot be written.
    pub(super) fn of(template: &Fmu, edits: &[Edit]) -> Result<Self, Cause> {
        Self::of_text(template, FILE, &edited(&Self::text_of(template)?, edits)?, None)
    }

    /// The template's spacecraft file.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(super) fn text_of(template: &Fmu) -> Result<String, Cause> {
        Ok(files::read_text(&template.folder().join("resources").join(FILE))?)
    }

    /// The template with another spacecraft file, `file` in errors, and a timeline, described by its own library.
    ///
    /// # Errors
    /// A file or a timeline that the model refuses, a folder that cannot be written.
    pub(super) fn of_text(
        template: &Fmu,
        file: &str,
        text: &str,
        timeline: Option<&str>,
    ) -> Result<Self, Cause> {
        let model = template.co_simulation()?.model_identifier.clone();
        let described = template.binary()?.describe(&model, Some(file), Some(text))?;
        let folder = Scratch::new()?;
        let resources = folder.path().join("resources");
        copy_folder(&template.folder().join("binaries"), &folder.path().join("binaries"))?;
        fs::create_dir(&resources)?;
        folder.write(&format!("resources/{FILE}"), text)?;
        if let Some(timeline) = timeline {
            check_timeline(template, text, timeline)?;
            folder.write(&format!("resources/{TIMELINE}"), timeline)?;
        }
        folder.write("modelDescription.xml", described.xml)?;
        Ok(Self { fmu: Fmu::open(folder.path())?, _folder: folder })
    }

    /// Whether the template's model takes a timeline with a spacecraft file.
    pub(super) fn takes(template: &Fmu, text: &str, timeline: &str) -> bool {
        check_timeline(template, text, timeline).is_ok()
    }
}

fn check_timeline(template: &Fmu, text: &str, timeline: &str) -> Result<(), Cause> {
    let model = &template.co_simulation()?.model_identifier;
    Ok(template.binary()?.check_schedule(model, Some(FILE), Some(text), TIMELINE, (TIMELINE, timeline))?)
}

#[cfg(test)]
mod tests {
    //! Edits of a text of three lines.
    use super::*;

    const TEXT: &str = "name = \"a\"\nx = 1\nname = \"b\"\nx = 1\n";

    #[test]
    fn an_edit_stands_after_its_marker_alone() {
        let second = Edit { after: "name = \"b\"", from: "x = 1", to: "x = 2" };
        assert_eq!(edited(TEXT, &[second]).unwrap(), "name = \"a\"\nx = 1\nname = \"b\"\nx = 2\n");
        let first = Edit { after: "", ..second };
        assert_eq!(edited(TEXT, &[first, second]).unwrap(), "name = \"a\"\nx = 2\nname = \"b\"\nx = 2\n");
    }

    #[test]
    fn an_edit_that_fits_nowhere_is_refused() {
        let lost = Edit { after: "name = \"c\"", from: "x = 1", to: "" };
        assert!(edited(TEXT, &[lost]).unwrap_err().contains("name = \"c\""));
        assert!(edited(TEXT, &[Edit { after: "", from: "y", to: "" }]).is_err());
    }
}
