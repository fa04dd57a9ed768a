//! Baseline of the arrays: offsets with the fewest steps that keep the light on the cells within its corridor.
//!
//! At the distance D (AU) light of cos(offset)/D^2 suns lies between min and max for offsets from acos(min(1, max D^2)) to
//! acos(min D^2). A span can share one offset if the greatest of its lower bounds is below the least of its upper ones. The fewest
//! spans come of continuing as long as that holds. Where the same number does with steps at the edges of windows alone, those are taken,
//! and of all such choices the one whose narrowest span is widest: that is the room windmilling has. The offset of a span is in the middle.
//! A corridor that every offset keeps throughout forces none: then the mission's own offsets are the baseline.

use physics::{constants::ASTRONOMICAL_UNIT_M, spacecraft::Articulation};

/// A span's offset, without its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetStep {
    /// When it begins, in s.
    pub at_s: f64,
    /// In rad.
    pub offset_rad: f64,
}

/// A distance that no offset suits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoOffset {
    /// When, in s.
    pub at_s: f64,
    /// In AU.
    pub distance_au: f64,
    /// Light with the cells at the Sun, in suns.
    pub suns: f64,
}

/// Least and greatest offset in rad that keep the corridor at a distance in m; `None`: none does.
pub fn allowed_rad(corridor: &Articulation, distance_m: f64) -> Option<[f64; 2]> {
    let square = (distance_m / ASTRONOMICAL_UNIT_M).powi(2);
    let [least_cosine, greatest_cosine] = [corridor.min_suns * square, (corridor.max_suns * square).min(1.0)];
    // Cells turned away get nothing, which a corridor from 0 on allows; the baseline keeps them lit.
    (least_cosine <= 1.0 && least_cosine <= greatest_cosine)
        .then(|| [greatest_cosine, least_cosine.max(0.0)].map(f64::acos))
}

/// Whether the corridor excludes any offset of lit cells at a distance in m.
fn forces(corridor: &Articulation, distance_m: f64) -> bool {
    corridor.min_suns > 0.0 || corridor.max_suns * (distance_m / ASTRONOMICAL_UNIT_M).powi(2) < 1.0
}

/// Offsets in rad, without their sign, that keep the corridor at every one of the distances in m; either way where it forces none.
pub(super) fn shared_rad(corridor: &Articulation, distances_m: impl Iterator<Item = f64>) -> [f64; 2] {
    let forced = distances_m.filter(|distance_m| forces(corridor, *distance_m));
    let bounds = forced.filter_map(|distance_m| allowed_rad(corridor, distance_m));
    bounds.fold([-core::f64::consts::PI, core::f64::consts::PI], meet)
}

/// Bounds at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bound {
    at_s: f64,
    rad: [f64; 2],
}

/// Values within both bounds.
pub(super) fn meet(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].min(b[1])]
}

const ALL: [f64; 2] = [0.0, core::f64::consts::PI];

/// The baseline over `places`, times in s with the distances from the Sun in m; `edges_s` are the edges of windows between, `own` what the
/// mission has.
///
/// # Errors
/// The first time at which no offset suits.
pub fn baseline(
    corridor: &Articulation,
    places: &[(f64, f64)],
    edges_s: &[f64],
    own: &[OffsetStep],
) -> Result<Vec<OffsetStep>, NoOffset> {
    if !own.is_empty() && !places.iter().any(|(_, distance_m)| forces(corridor, *distance_m)) {
        return Ok(own.to_vec());
    }
    let mut bounds = Vec::with_capacity(places.len());
    for &(at_s, distance_m) in places {
        let Some(rad) = allowed_rad(corridor, distance_m) else {
            let distance_au = distance_m / ASTRONOMICAL_UNIT_M;
            return Err(NoOffset { at_s, distance_au, suns: distance_au.powi(-2) });
        };
        bounds.push(Bound { at_s, rad });
    }
    let Some(first) = bounds.first() else { return Ok(Vec::new()) };
    let anywhere = fewest(&bounds);
    let mut starts_s = vec![first.at_s];
    starts_s.extend(
        edges_s
            .iter()
            .copied()
            .filter(|at_s| *at_s > first.at_s && bounds.last().is_some_and(|last| *at_s < last.at_s)),
    );
    Ok(at_edges(&bounds, &starts_s, anywhere.len()).unwrap_or(anywhere))
}

/// Steps at any of the times.
fn fewest(bounds: &[Bound]) -> Vec<OffsetStep> {
    let mut steps = Vec::new();
    let mut since = 0;
    let mut shared = ALL;
    for (index, bound) in bounds.iter().enumerate() {
        let next = meet(shared, bound.rad);
        if next[0] <= next[1] {
            shared = next;
            continue;
        }
        steps.push(step(bounds[since].at_s, shared));
        // From the time before on, at which both offsets suit if distances are close: between the two the earlier one leaves the corridor.
        let overlap = meet(bounds[index - 1].rad, bound.rad);
        let is_close = overlap[0] <= overlap[1];
        (since, shared) = if is_close { (index - 1, overlap) } else { (index, bound.rad) };
    }
    steps.push(step(bounds.get(since).map_or(0.0, |bound| bound.at_s), shared));
    steps
}

fn step(at_s: f64, [low, high]: [f64; 2]) -> OffsetStep {
    OffsetStep { at_s, offset_rad: 0.5 * (low + high) }
}

/// Places `count` steps at these times, the narrowest as wide as possible; `None` where they do not suffice.
fn at_edges(bounds: &[Bound], starts_s: &[f64], count: usize) -> Option<Vec<OffsetStep>> {
    let cells: Vec<[f64; 2]> = (0..starts_s.len())
        .map(|cell| {
            let until_s = starts_s.get(cell + 1).copied().unwrap_or(f64::INFINITY);
            let inside = bounds.iter().filter(|it| (starts_s[cell]..=until_s).contains(&it.at_s));
            inside.fold(ALL, |shared, it| meet(shared, it.rad))
        })
        .collect();
    // widest[steps][end]: of the cells before `end` in so many steps the narrowest width, and where the last step begins.
    let cells_count = cells.len();
    let mut widest = vec![vec![(f64::NEG_INFINITY, 0); cells_count + 1]; count + 1];
    widest[0][0] = (f64::INFINITY, 0);
    for steps in 1..=count {
        for end in 1..=cells_count {
            let mut shared = ALL;
            for begin in (0..end).rev() {
                shared = meet(shared, cells[begin]);
                if shared[0] > shared[1] {
                    break;
                }
                let width = widest[steps - 1][begin].0.min(shared[1] - shared[0]);
                if width > widest[steps][end].0 {
                    widest[steps][end] = (width, begin);
                }
            }
        }
    }
    if widest[count][cells_count].0 < 0.0 {
        return None;
    }
    let mut found = Vec::with_capacity(count);
    let mut end = cells_count;
    for steps in (1..=count).rev() {
        let begin = widest[steps][end].1;
        let shared = cells[begin..end].iter().fold(ALL, |shared, cell| meet(shared, *cell));
        found.push(step(starts_s[begin], shared));
        end = begin;
    }
    found.reverse();
    Some(found)
}

#[cfg(test)]
mod tests;
