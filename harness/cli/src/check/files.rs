//! `heliotorque check FILE.toml`: a spacecraft, a mission, a timeline, an ephemeris, a plan, a leg or a campaign, by what it is meant as.

use std::error::Error;

use campaign::{run, sweep};
use files::outcome::Refusal;
use inputs::{
    kind::{FileKind, is_blank},
    library::Library,
};
use packing::{
    carried::{ephemeris, timeline},
    check::Judged,
};
use planner::plans::{leg, momentum};

use super::options::Check;

/// Judges the file.
pub(super) fn judged(arguments: &Check, file: &str) -> Result<Judged, Box<dyn Error>> {
    let text = files::read_text(&arguments.subject)?;
    if is_blank(&text) {
        let allowed = "a spacecraft, a spinner, a mission, a timeline, an ephemeris, a plan, a leg or a campaign: see `heliotorque new`";
        return Err(format!("{file}: found an empty file, allowed: {allowed}").into());
    }
    let kind = FileKind::recognize(&text).unwrap_or(FileKind::Spacecraft);
    let library = Library::new(arguments.template.as_deref());
    let unwarned = |summary: String| (summary, Vec::new());
    let read = match kind {
        FileKind::Spacecraft => {
            return packing::check::judged(&arguments.subject, arguments.template.as_deref(), &text);
        }
        FileKind::Mission => run::checked::checked(&arguments.subject, library.template()),
        FileKind::Timeline => timeline::checked(file, &text).map(unwarned).map_err(Into::into),
        FileKind::Plan => momentum::checked(&arguments.subject, library).map(unwarned),
        FileKind::Leg => leg::checked(&arguments.subject, library).map(unwarned),
        FileKind::Campaign => sweep::checked(&arguments.subject, library).map(unwarned),
        FileKind::Ephemeris => ephemeris::checked(file, &text).map(unwarned).map_err(Into::into),
    };
    Ok(match read {
        Ok((summary, warnings)) => Judged::Taken { summary: format!("{file}: ok: {summary}"), warnings },
        Err(error) => {
            let error = error.as_ref();
            Judged::Refused {
                problems: Refusal::new(error, fmi::Error::chain(error)),
                kind: kind.to_string(),
            }
        }
    })
}
