//! Summary of an ephemeris file, for `ephemeris`, `check` and `info`.

use std::path::Path;

use files::outcome::Refusal;
use inputs::reading::refusal;
use physics::{
    constants::DAY_S,
    environment::{
        dates,
        onboard::{FittedBody, OnboardEphemeris, OnboardTarget},
    },
    numerics::Span,
};

/// Its name in the resources.
pub const FILE: &str = "ephemeris.toml";

/// Reads the positions in an FMU's resources, or their fault.
pub fn read(resources: &Path) -> Result<String, Refusal> {
    let read = OnboardEphemeris::from_toml(FILE, &files::read_text(&resources.join(FILE))?);
    read.map(|ephemeris| summary(&ephemeris)).map_err(refusal)
}

/// Table of an ephemeris file that can be read.
///
/// # Errors
/// Everything wrong in the file.
pub fn checked(file: &str, text: &str) -> Result<String, Refusal> {
    let read = OnboardEphemeris::from_toml(file, text).map_err(refusal)?;
    Ok(table(&read, text.len()))
}

/// Names the bodies, in a line.
fn summary(ephemeris: &OnboardEphemeris) -> String {
    let precise = ephemeris.precise.iter().map(|body| {
        let Span { start_s, end_s } = body.motion.span();
        format!(
            "{} from {}, {} to {}, to {} m",
            body.target,
            OnboardTarget::from(body.center),
            dates::utc(start_s),
            dates::utc(end_s),
            terminal::short(body.error.position_m)
        )
    });
    let coarse = ephemeris.coarse.iter().map(|body| {
        format!("coarse {}, to {} km", body.target, terminal::short(body.error.position_m * 1e-3))
    });
    precise.chain(coarse).collect::<Vec<_>>().join("; ")
}

/// Bodies, spans and errors as a table.
pub fn table(ephemeris: &OnboardEphemeris, bytes: usize) -> String {
    let mut table =
        terminal::table(&["model", "body", "from", "begin", "end", "segments", "degree", "error", ""]);
    for body in &ephemeris.precise {
        let segments = body.motion.segments();
        let longest_s = segments.iter().map(|it| it.end_s - it.start_s).fold(0.0, f64::max);
        let degree = segments.first().map_or(0, |it| it.coefficients_m.len().saturating_sub(1));
        let segments = format!("{} of up to {} d", segments.len(), terminal::short(longest_s / DAY_S));
        table.add_row(row("precise", body, body.motion.span(), [segments, degree.to_string()]));
    }
    for body in &ephemeris.coarse {
        table.add_row(row("coarse", body, body.motion.span, ["1".to_owned(), "4".to_owned()]));
    }
    let source = ephemeris.source.as_deref().map_or_else(String::new, |source| format!(", {source}"));
    format!("{} kB{source}\n{table}", bytes.div_ceil(1000))
}

fn row<M>(model: &str, body: &FittedBody<M>, span: Span, [segments, degree]: [String; 2]) -> [String; 9] {
    [
        model.to_owned(),
        body.target.to_string(),
        OnboardTarget::from(body.center).to_string(),
        dates::utc(span.start_s),
        dates::utc(span.end_s),
        segments,
        degree,
        format!("{} m", terminal::short(body.error.position_m)),
        format!("{} m/s", terminal::short(body.error.velocity_m_s)),
    ]
}
