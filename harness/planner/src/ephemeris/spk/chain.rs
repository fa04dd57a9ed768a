//! From a body up its centers: which segment places it at an epoch, as SPICE chooses.
//!
//! Of two segments that hold the epoch that of the later file counts, in one file the later segment (NAIF, SPK Required
//! Reading).

use physics::environment::CartesianState;

use super::spk_file::{Segment, SpkFile};

/// More centers than any body has above it; kernels that place bodies about each other are left there.
const HIGHEST: usize = 16;

/// The segment that places a body at an epoch, and its file.
pub(super) fn segment(files: &[SpkFile], id: i32, at_s: f64) -> Option<(&SpkFile, &Segment)> {
    let mut all = files.iter().rev().flat_map(|file| file.segments.iter().rev().map(move |it| (file, it)));
    all.find(|(_, it)| {
        let [start_s, end_s] = it.span_s();
        it.target() == id && start_s <= at_s && at_s <= end_s
    })
}

/// A body, the center it is placed from, that one's center and so on.
pub(super) fn ancestors(files: &[SpkFile], id: i32, at_s: f64) -> Vec<i32> {
    let mut ids = vec![id];
    let mut last = id;
    while let Some((_, segment)) = segment(files, last, at_s)
        && ids.len() < HIGHEST
    {
        last = segment.center();
        ids.push(last);
    }
    ids
}

/// The nearest center that two bodies have in common.
pub(super) fn common(one: &[i32], other: &[i32]) -> Option<i32> {
    one.iter().find(|id| other.contains(id)).copied()
}

/// The state of a body from one of its ancestors.
///
/// # Errors
///
/// A segment that cannot be read.
pub(super) fn state_from(
    files: &[SpkFile],
    id: i32,
    ancestor: i32,
    at_s: f64,
) -> Result<CartesianState, String> {
    let mut sum = CartesianState::default();
    let mut last = id;
    while last != ancestor
        && let Some((file, segment)) = segment(files, last, at_s)
    {
        sum = sum + file.state(segment, at_s)?;
        last = segment.center();
    }
    Ok(sum)
}
