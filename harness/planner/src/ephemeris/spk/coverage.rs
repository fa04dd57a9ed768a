//! Whether kernels place a body from another over a whole span, and what is missing otherwise.

use anise::prelude::{Epoch, TimeScale};

use super::{
    chain::{ancestors, common},
    naif::{Center, named},
    spk_file::SpkFile,
};

/// Looks whether a body can be placed at every epoch of a span.
///
/// # Errors
///
/// The body that no kernel holds, or the span over which they place one that is needed.
pub(super) fn check(files: &[SpkFile], id: i32, center: Center, span_s: [f64; 2]) -> Result<(), String> {
    let gap = probes(files, span_s).into_iter().find_map(|at_s| {
        let chains = [id, center.id].map(|id| ancestors(files, id, at_s));
        common(&chains[0], &chains[1]).is_none().then_some(chains)
    });
    let Some(chains) = gap else { return Ok(()) };
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let names = names.join(", ");
    let held = held(files);
    if let Some(absent) = [id, center.id].into_iter().find(|id| !held.contains(id)) {
        let held: Vec<String> = held.into_iter().map(named).collect();
        let held = if held.is_empty() { "nothing".to_owned() } else { held.join(", ") };
        return Err(format!("--kernel: found no {} in {names}, allowed: {held}", named(absent)));
    }
    // What ends a chain there has segments at other times, or none at all.
    let end = chains.iter().filter_map(|chain| chain.last()).find(|id| !spans(files, **id).is_empty());
    Err(match end {
        Some(end) => {
            let covered: Vec<String> = spans(files, *end).into_iter().map(shown).collect();
            format!(
                "--start, --stop: found {}, allowed: from {}, the span over which {names} places {}",
                shown(span_s),
                covered.join(" or from "),
                named(*end)
            )
        }
        None => format!("--kernel: {names} does not place {} from {}", named(id), named(center.id)),
    })
}

/// Epochs between which nothing changes: edges of segments within the span, and what lies midway between them.
fn probes(files: &[SpkFile], [start_s, stop_s]: [f64; 2]) -> Vec<f64> {
    let edges = files.iter().flat_map(|file| &file.segments).flat_map(|segment| segment.span_s());
    let mut edges_s: Vec<f64> = edges.filter(|at_s| start_s < *at_s && *at_s < stop_s).collect();
    edges_s.extend([start_s, stop_s]);
    edges_s.sort_by(f64::total_cmp);
    edges_s.dedup();
    let midway: Vec<f64> = edges_s.windows(2).map(|edge| 0.5 * (edge[0] + edge[1])).collect();
    edges_s.extend(midway);
    edges_s
}

/// Spans over which a body is placed from anywhere, joined where they meet.
fn spans(files: &[SpkFile], id: i32) -> Vec<[f64; 2]> {
    let segments = files.iter().flat_map(|file| &file.segments).filter(|segment| segment.target() == id);
    let mut spans_s: Vec<[f64; 2]> = segments.map(|segment| segment.span_s()).collect();
    spans_s.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut joined: Vec<[f64; 2]> = Vec::new();
    for span_s in spans_s {
        match joined.last_mut() {
            Some(last) if span_s[0] <= last[1] => last[1] = last[1].max(span_s[1]),
            _ => joined.push(span_s),
        }
    }
    joined
}

/// Bodies that are placed, or from which others are.
fn held(files: &[SpkFile]) -> Vec<i32> {
    let segments = files.iter().flat_map(|file| &file.segments);
    let mut ids: Vec<i32> = segments.flat_map(|segment| [segment.center(), segment.target()]).collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

/// A span as dates.
fn shown([start_s, stop_s]: [f64; 2]) -> String {
    format!("{} to {}", date(start_s), date(stop_s))
}

/// The UTC date of an epoch; of one before UTC had leap seconds the TDB date.
fn date(epoch_s: f64) -> String {
    inputs::epoch::date(epoch_s).unwrap_or_else(|| {
        let (year, month, day, hour, minute, second, _) =
            Epoch::from_tdb_seconds(epoch_s).to_gregorian(TimeScale::TDB);
        format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02} TDB")
    })
}
