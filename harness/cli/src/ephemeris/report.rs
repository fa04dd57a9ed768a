//! What an ephemeris file holds, for `ephemeris`, `check` and `info`.

use std::path::Path;

use loader::Fmu;
use physics::{
    constants::DAY_S,
    environment::{
        dates,
        onboard::{FitError, OnboardEphemeris, OnboardTarget},
    },
};
use toml::de::DeTable;

use crate::home;

/// Its name in the resources.
pub const FILE: &str = "ephemeris.toml";

/// The ephemeris of an FMU, or what is wrong with it, a line for each problem; `None` where there is none.
pub fn of(fmu: &Fmu) -> Option<Result<OnboardEphemeris, String>> {
    // Other exporters' files of this name mean something else.
    let path = fmu.folder().join("resources").join(FILE);
    if !home::is_ours(fmu.description()) || !path.exists() {
        return None;
    }
    let read = |text: String| OnboardEphemeris::from_toml(FILE, &text).map_err(|error| error.to_string());
    Some(files::read_text(&path).and_then(read))
}

/// The text of a file and what it holds, or what is wrong with it; `None` where it is another kind of file.
pub type Read = Option<(usize, Result<OnboardEphemeris, String>)>;

/// A file that may be an ephemeris: one whose tables have its names.
pub fn read(path: &Path) -> Result<Read, String> {
    let text = files::read_text(path)?;
    // What can be read of a damaged file shows its kind too.
    let (root, _) = DeTable::parse_recoverable(&text);
    if !["frame", "body", "coarse"].into_iter().any(|key| root.get_ref().contains_key(key)) {
        return Ok(None);
    }
    let shown = path.display().to_string();
    let read = OnboardEphemeris::from_toml(&shown, &text).map_err(|error| error.to_string());
    Ok(Some((text.len(), read)))
}

/// Which bodies, in a line.
pub fn summary(ephemeris: &OnboardEphemeris) -> String {
    let precise = ephemeris.precise.iter().map(|body| {
        let [start_s, end_s] = body.motion.span_s();
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
    let errors = |error: &FitError| {
        [
            format!("{} m", terminal::short(error.position_m)),
            format!("{} m/s", terminal::short(error.velocity_m_s)),
        ]
    };
    for body in &ephemeris.precise {
        let ([start_s, end_s], segments) = (body.motion.span_s(), body.motion.segments());
        let longest_s = segments.iter().map(|it| it.end_s - it.start_s).fold(0.0, f64::max);
        let degree = segments.first().map_or(0, |it| it.coefficients_m.len().saturating_sub(1));
        let [position, velocity] = errors(&body.error);
        table.add_row([
            "precise".to_owned(),
            body.target.to_string(),
            OnboardTarget::from(body.center).to_string(),
            dates::utc(start_s),
            dates::utc(end_s),
            format!("{} of up to {} d", segments.len(), terminal::short(longest_s / DAY_S)),
            degree.to_string(),
            position,
            velocity,
        ]);
    }
    for body in &ephemeris.coarse {
        let [start_s, end_s] = body.motion.span_s;
        let [position, velocity] = errors(&body.error);
        table.add_row([
            "coarse".to_owned(),
            body.target.to_string(),
            OnboardTarget::from(body.center).to_string(),
            dates::utc(start_s),
            dates::utc(end_s),
            "1".to_owned(),
            "4".to_owned(),
            position,
            velocity,
        ]);
    }
    let source = ephemeris.source.as_deref().map_or_else(String::new, |source| format!(", {source}"));
    format!("{} kB{source}\n{table}", bytes.div_ceil(1000))
}
