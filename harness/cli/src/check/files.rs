//! `heliotorque check FILE.toml`: a spacecraft, a mission, a timeline, an ephemeris, a plan, a leg or a campaign, by what it is meant as.

use std::error::Error;

use campaign::sweep;
use inputs::{
    kind::{FileKind, is_blank},
    library::Library,
};
use packing::{
    carried::{ephemeris, timeline},
    check::Judged,
};
use planner::plans::{leg, momentum};

use super::{mission, options::Check};

/// Judges the file.
pub(super) fn judged(arguments: &Check, file: &str) -> Result<Judged, Box<dyn Error>> {
    let text = files::read_text(&arguments.subject)?;
    if is_blank(&text) {
        let allowed = "a spacecraft, a spinner, a mission, a timeline, an ephemeris, a plan, a leg or a campaign: see `heliotorque new`";
        return Err(format!("{file}: found an empty file, allowed: {allowed}").into());
    }
    let kind = FileKind::recognize(&text).unwrap_or(FileKind::Spacecraft);
    let library = Library::new(arguments.template.as_deref());
    let chain = |error: Box<dyn Error>| fmi::Error::chain(error.as_ref());
    let read = match kind {
        FileKind::Spacecraft => {
            return packing::check::judged(&arguments.subject, arguments.template.as_deref(), &text);
        }
        FileKind::Mission => return Ok(mission::judged(arguments, file)),
        FileKind::Timeline => timeline::checked(file, &text),
        FileKind::Plan => momentum::checked(&arguments.subject, library).map_err(chain),
        FileKind::Leg => leg::checked(&arguments.subject, library).map_err(chain),
        FileKind::Campaign => sweep::checked(&arguments.subject, library).map_err(chain),
        FileKind::Ephemeris => ephemeris::checked(file, &text),
    };
    Ok(match read {
        Ok(summary) => Judged::Taken { summary: format!("{file}: ok: {summary}"), warnings: Vec::new() },
        Err(problems) => Judged::Refused { problems, kind: kind.to_string() },
    })
}
