//! The windows of a flight: what its mission holds fixed, and the free time between in pieces of one length.

use physics::spacecraft::Articulation;

pub use super::window::{Window, WindowKind};
use super::{
    baseline::{NoOffset, OffsetStep, baseline, shared_rad},
    controls::{ALL, CONTROLS, Control, Controls},
    in_force::{ActiveControls, mean},
    places::places,
    simulated::{FlightRow, SAME_S, SimulatedFlight},
    torque::SunlitSpacecraft,
};

/// Bounds of the controls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlBounds {
    /// Largest change of the offset off the baseline, in rad; 0 where it is kept.
    pub offset_rad: f64,
    /// Largest windmill angle, in rad.
    pub windmill_rad: f64,
    /// Largest azimuth of the Sun, in rad.
    pub azimuth_rad: f64,
    /// Largest elevation of the Sun, in rad.
    pub elevation_rad: f64,
    /// Largest share of a window in the alternate attitude.
    pub alternate: f64,
    /// Whether the alternate attitude has a place of the Sun of its own, within the same bounds.
    pub alternate_apart: bool,
}

/// A command of the mission's timeline that the plan does not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BusySpan {
    /// In s of the flight.
    pub start_s: f64,
    /// In s of the flight.
    pub stop_s: f64,
    /// Whether its price is reported.
    pub planned: bool,
    /// Row in the timeline, from 0.
    pub command: usize,
}

/// Layout of windows: kinds, spans, bounds of the controls.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Until when the mission stays as it is, in s.
    pub frozen_until_s: f64,
    /// Whether the arrays do too.
    pub arrays_are_frozen: bool,
    /// Length of a window, in s.
    pub window_s: f64,
    /// Commands that stay, in order.
    pub occupied: Vec<BusySpan>,
    /// Downlinks of an orbit phase, in order: they alone are free, everything else stays as it is; `None`: all time is.
    pub downlinks_s: Option<Vec<[f64; 2]>>,
    /// Ground contacts, in order; none overlap.
    pub contacts_s: Vec<[f64; 2]>,
    /// Share of each window that contacts take where none is listed.
    pub contact_share: f64,
    /// Bounds of the controls.
    pub control_bounds: ControlBounds,
    /// The plan that the mission has so far, in order: windows begin with its controls, those before it on the baseline without tilt.
    pub in_force: Vec<ActiveControls>,
    /// Controls of the mission itself, in order; empty where its arrays are no offset and windmill angle.
    pub own: Vec<ActiveControls>,
    /// Corridor of the light on the cells.
    pub corridor: Articulation,
    /// Sign of the offsets.
    pub offset_sign: f64,
    /// Offset at the start of the mission as it is, in rad, which is reported of the frozen time.
    pub frozen_offset_rad: f64,
    /// Senses in which a windmill angle turns the panels.
    pub sides: Vec<f64>,
}

impl Layout {
    /// Layout of an orbit phase: downlinks are free as far as `control_bounds` lets the Sun off -Y, everything else stays, the arrays at this offset from the Sun.
    pub fn of_downlinks(
        downlinks_s: Vec<[f64; 2]>,
        control_bounds: ControlBounds,
        sun_offset_rad: f64,
    ) -> Self {
        Self {
            frozen_until_s: f64::NEG_INFINITY,
            arrays_are_frozen: true,
            window_s: f64::INFINITY,
            occupied: Vec::new(),
            downlinks_s: Some(downlinks_s),
            contacts_s: Vec::new(),
            contact_share: 0.0,
            control_bounds,
            in_force: Vec::new(),
            own: Vec::new(),
            corridor: Articulation { min_suns: 0.0, max_suns: f64::INFINITY, target_suns: 1.0 },
            offset_sign: 1.0,
            frozen_offset_rad: sun_offset_rad,
            sides: Vec::new(),
        }
    }

    /// The windows of a flight on the baseline, and that.
    ///
    /// # Errors
    /// The first time at which no offset keeps the corridor.
    pub fn windows(
        &self,
        sunlit: &SunlitSpacecraft,
        simulated: &SimulatedFlight,
    ) -> Result<(Vec<Window>, Vec<OffsetStep>), NoOffset> {
        let spans = self.spans(simulated);
        let edges: Vec<f64> = spans.iter().map(|(span_s, ..)| span_s[0]).collect();
        // The corridor holds up to an edge and from it on, rows there or not.
        let simulated = &simulated.with_rows_at(&edges);
        let Some(begin_s) = simulated.rows.first().map(|row| row.time_s) else {
            return Ok((Vec::new(), Vec::new()));
        };
        let arrays_from_s = if self.arrays_are_frozen { self.frozen_until_s.max(begin_s) } else { begin_s };
        let places: Vec<(f64, f64)> = simulated
            .rows
            .iter()
            .filter(|row| row.time_s >= arrays_from_s - SAME_S)
            .map(|row| (row.time_s, row.to_sun_m.norm()))
            .collect();
        let steps = match self.sides.is_empty() {
            true => Vec::new(),
            false => baseline(&self.corridor, &places, &edges, &self.own_offsets(arrays_from_s))?,
        };
        // A step inside a window splits it.
        let mut windows = Vec::new();
        for ([start_s, stop_s], kind, command) in spans {
            let inside = steps.iter().map(|step| step.at_s);
            let mut cuts: Vec<f64> =
                inside.filter(|at_s| *at_s > start_s + SAME_S && *at_s < stop_s - SAME_S).collect();
            cuts.push(stop_s);
            let mut from_s = start_s;
            for to_s in cuts {
                windows.push(self.window([from_s, to_s], (kind, command), (sunlit, simulated), &steps));
                from_s = to_s;
            }
        }
        Ok((windows, steps))
    }

    /// Spans that the mission holds fixed, and the free time between in pieces.
    pub(super) fn spans(&self, simulated: &SimulatedFlight) -> Vec<Span> {
        let (Some(first), Some(last)) = (simulated.rows.first(), simulated.rows.last()) else {
            return Vec::new();
        };
        let [begin_s, end_s] = [first.time_s, last.time_s];
        let frozen_s = self.frozen_until_s.clamp(begin_s, end_s);
        let mut spans = Vec::new();
        if frozen_s > begin_s + SAME_S {
            let kind = if self.arrays_are_frozen { WindowKind::Frozen } else { WindowKind::Fixed };
            spans.push(([begin_s, frozen_s], kind, None));
        }
        let occupied = self.occupied.iter().map(|it| {
            let kind = if it.planned { WindowKind::Planned } else { WindowKind::Fixed };
            ([it.start_s, it.stop_s], kind, Some(it.command))
        });
        fill(&mut spans, [frozen_s, end_s], occupied, |spans, gap_s| self.cut(spans, gap_s));
        spans
    }

    /// Offsets of the mission's own arrays from a time on, without their sign.
    fn own_offsets(&self, from_s: f64) -> Vec<OffsetStep> {
        let mut steps: Vec<OffsetStep> = Vec::new();
        for (index, it) in self.own.iter().enumerate() {
            if self.own.get(index + 1).is_some_and(|next| next.at_s <= from_s + SAME_S) {
                continue;
            }
            let offset_rad = self.offset_sign * it.controls.get(Control::Offset);
            if steps.last().is_none_or(|last| last.offset_rad != offset_rad) {
                steps.push(OffsetStep { at_s: it.at_s.max(from_s), offset_rad });
            }
        }
        steps
    }

    /// Free time in pieces; a last one of less than half a window joins the one before. In an orbit phase each downlink is one.
    fn cut(&self, spans: &mut Vec<Span>, [from_s, to_s]: [f64; 2]) {
        if let Some(downlinks_s) = &self.downlinks_s {
            let free = downlinks_s.iter().map(|span_s| (*span_s, WindowKind::Free, None));
            let freeze = |spans: &mut Vec<Span>, gap_s| spans.push((gap_s, WindowKind::Frozen, None));
            return fill(spans, [from_s, to_s], free, freeze);
        }
        let pieces = ((to_s - from_s) / self.window_s + 0.5).floor().max(1.0) as usize;
        for piece in 0..pieces {
            let start_s = from_s + piece as f64 * self.window_s;
            let stop_s = if piece + 1 == pieces { to_s } else { start_s + self.window_s };
            spans.push(([start_s, stop_s], WindowKind::Free, None));
        }
    }

    /// A window of this kind, by the mission's command of this row, on a baseline.
    pub(super) fn window(
        &self,
        [start_s, stop_s]: [f64; 2],
        (kind, command): (WindowKind, Option<usize>),
        (sunlit, simulated): (&SunlitSpacecraft, &SimulatedFlight),
        steps: &[OffsetStep],
    ) -> Window {
        let rows: Vec<&FlightRow> = simulated.within([start_s, stop_s]).collect();
        let corridor_rad = self.corridor_rad(&rows);
        let begun = steps.iter().rev().find(|step| step.at_s <= start_s + SAME_S);
        let begun = begun.filter(|_| kind != WindowKind::Frozen);
        let offset_rad = begun.map_or(self.frozen_offset_rad, |step| self.offset_sign * step.offset_rad);
        let mut window = Window {
            start_s,
            stop_s,
            kind,
            command,
            free_of_contact: Vec::new(),
            bounds: [[0.0; 2]; CONTROLS],
            places: Vec::new(),
            offsets_rad: [corridor_rad[0].min(offset_rad), corridor_rad[1].max(offset_rad)],
            baseline_rad: offset_rad,
            sides: self.sides.clone(),
            controls: Controls::default().with(Control::Offset, offset_rad),
        };
        window.bounds[Control::Offset as usize] = [offset_rad; 2];
        if kind != WindowKind::Frozen && self.sides.iter().any(|side| *side != 0.0) {
            window.bounds[Control::Windmill as usize] = either_way(self.control_bounds.windmill_rad);
        }
        if kind == WindowKind::Free {
            self.open(&mut window, &rows);
            self.begin(&mut window, corridor_rad);
            if self.downlinks_s.is_some() {
                let [azimuth_rad, elevation_rad] =
                    [self.control_bounds.azimuth_rad, self.control_bounds.elevation_rad];
                window.places = places(sunlit, &rows, [azimuth_rad, elevation_rad]);
                window.bounds[Control::Azimuth as usize] = either_way(azimuth_rad);
                window.bounds[Control::Elevation as usize] = either_way(elevation_rad);
            }
        }
        window
    }

    /// Offsets that keep the corridor at all of these rows, with their sign, in rad.
    pub(super) fn corridor_rad(&self, rows: &[&FlightRow]) -> [f64; 2] {
        let [low, high] = shared_rad(&self.corridor, rows.iter().map(|row| row.to_sun_m.norm()));
        if self.offset_sign < 0.0 { [-high, -low] } else { [low, high] }
    }

    /// Gives a free window the bounds of its controls.
    fn open(&self, window: &mut Window, rows: &[&FlightRow]) {
        let within = &self.control_bounds;
        window.free_of_contact = self.free_of_contact(window.start_s, window.stop_s);
        let mut share = (window.free_s() / window.length_s()).min(1.0);
        if self.contacts_s.is_empty() {
            share = share.min(1.0 - self.contact_share);
        }
        let separations_rad = rows.iter().map(|row| row.to_sun_m.angle(&row.to_earth_m));
        let separation_rad = separations_rad
            .map(|angle_rad| angle_rad.min(core::f64::consts::PI - angle_rad))
            .fold(f64::INFINITY, f64::min);
        let elevation_rad = within.elevation_rad.min((separation_rad - LEFT_RAD).max(0.0));
        let share = within.alternate.min(share);
        let bounds = &mut window.bounds;
        if !self.sides.is_empty() {
            let ([low, high], offset_rad) = (window.offsets_rad, window.baseline_rad);
            bounds[Control::Offset as usize] =
                [(offset_rad - within.offset_rad).max(low), (offset_rad + within.offset_rad).min(high)];
        }
        bounds[Control::Azimuth as usize] = either_way(within.azimuth_rad);
        bounds[Control::Elevation as usize] = either_way(elevation_rad);
        bounds[Control::Alternate as usize] = [0.0, share];
        if within.alternate_apart && share > 0.0 {
            bounds[Control::AlternateAzimuth as usize] = bounds[Control::Azimuth as usize];
            bounds[Control::AlternateElevation as usize] = bounds[Control::Elevation as usize];
        }
    }

    /// Gives a free window the controls of the plan in force, where there is one.
    fn begin(&self, window: &mut Window, [low_rad, high_rad]: [f64; 2]) {
        let Some(in_force) = mean(&self.in_force, [window.start_s, window.stop_s]) else { return };
        // Off the baseline or as it is: that of a shorter flight may be another one.
        if self.control_bounds.offset_rad > 0.0 {
            let present_rad = in_force.get(Control::Offset).min(high_rad).max(low_rad);
            let [low, high] = &mut window.bounds[Control::Offset as usize];
            (*low, *high) = (low.min(present_rad), high.max(present_rad));
        }
        for control in ALL {
            let [low, high] = window.bounds[control as usize];
            window.controls = window.controls.with(control, in_force.get(control).min(high).max(low));
        }
    }

    fn free_of_contact(&self, start_s: f64, stop_s: f64) -> Vec<[f64; 2]> {
        let mut free = Vec::new();
        let mut at_s = start_s;
        for [from_s, to_s] in &self.contacts_s {
            if *from_s >= stop_s || *to_s <= start_s {
                continue;
            }
            if *from_s > at_s + SAME_S {
                free.push([at_s, *from_s]);
            }
            at_s = at_s.max(*to_s);
        }
        if stop_s > at_s + SAME_S {
            free.push([at_s, stop_s]);
        }
        free
    }
}

/// Range of the same size to either side of zero.
fn either_way(most: f64) -> [f64; 2] {
    [-most, most]
}

/// Times, kind and command of a window.
pub(super) type Span = ([f64; 2], WindowKind, Option<usize>);

/// Adds what of `own` is within an interval, in its order, and what `between` makes of the gaps.
fn fill(
    spans: &mut Vec<Span>,
    [from_s, to_s]: [f64; 2],
    own: impl Iterator<Item = Span>,
    between: impl Fn(&mut Vec<Span>, [f64; 2]),
) {
    let mut at_s = from_s;
    for ([start_s, stop_s], kind, command) in own {
        let [start_s, stop_s] = [start_s.max(at_s), stop_s.min(to_s)];
        if stop_s <= start_s + SAME_S {
            continue;
        }
        if start_s > at_s + SAME_S {
            between(spans, [at_s, start_s]);
        }
        spans.push(([start_s, stop_s], kind, command));
        at_s = stop_s;
    }
    if to_s > at_s + SAME_S {
        between(spans, [at_s, to_s]);
    }
}

/// The elevation stays so far within the angle between Sun and Earth, in rad: at it the attitude has no derivative.
const LEFT_RAD: f64 = 1e-3;

#[cfg(test)]
mod tests;
