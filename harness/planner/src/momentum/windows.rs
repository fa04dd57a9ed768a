//! The windows of a flight: what its mission holds fixed, and the free time between in pieces of one length.

use nalgebra::{Rotation3, Unit};
use physics::spacecraft::Articulation;

use super::{
    baseline::{NoOffset, OffsetStep, baseline, shared_rad},
    in_force::{ActiveControls, mean},
    places::{PlaceSide, places},
    simulated::{FlightRow, SAME_S, SimulatedFlight},
    torque::{ALL, Attitude, CONTROLS, Control, Controls, LinearTorque, SunlitSpacecraft},
};

/// Kind of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WindowKind {
    /// As the mission has it, arrays included.
    Frozen,
    /// A command of the mission that stays.
    Fixed,
    /// A command of the mission that stays and whose price is reported.
    Planned,
    /// A downlink whose controls are sought.
    Free,
}

impl WindowKind {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Frozen => "frozen",
            Self::Fixed => "fixed",
            Self::Planned => "planned",
            Self::Free => "free",
        }
    }
}

/// A window.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// In s of the flight.
    pub start_s: f64,
    /// In s of the flight.
    pub stop_s: f64,
    /// Kind.
    pub kind: WindowKind,
    /// Row of the mission's command, from 0.
    pub command: Option<usize>,
    /// Its parts outside of contacts, where the alternate attitude may be.
    pub free_of_contact: Vec<[f64; 2]>,
    /// Least and greatest value of each control.
    pub bounds: [[f64; 2]; CONTROLS],
    /// Places of the Sun that antennas and Earth allow throughout, within those bounds; all of them where there is none.
    pub places: Vec<PlaceSide>,
    /// Offsets that keep the corridor throughout, with their sign, in rad.
    pub offsets_rad: [f64; 2],
    /// Offset of the baseline, with its sign, in rad.
    pub baseline_rad: f64,
    /// Senses in which a windmill angle turns panels.
    pub sides: Vec<f64>,
    /// Present controls.
    pub controls: Controls,
}

impl Window {
    /// Its ends and those of its times without contact, in s.
    pub(crate) fn edges_s(&self) -> impl Iterator<Item = f64> {
        self.free_of_contact.iter().flatten().copied().chain([self.start_s, self.stop_s])
    }

    /// In s.
    pub fn length_s(&self) -> f64 {
        self.stop_s - self.start_s
    }

    /// Sunlight at a row of the window about its present controls.
    pub fn linearised(&self, sunlit: &SunlitSpacecraft, row: &FlightRow) -> LinearTorque {
        match self.kind {
            WindowKind::Frozen => sunlit.simulated(row),
            WindowKind::Free if self.is_apart() => sunlit.linearised_apart(row, &self.controls),
            _ => sunlit.linearised(row, self.attitude(), &self.controls),
        }
    }

    /// Whether the alternate attitude has a place of the Sun of its own.
    pub(super) fn is_apart(&self) -> bool {
        let own = [Control::AlternateAzimuth, Control::AlternateElevation].map(|it| self.bounds[it as usize]);
        own.iter().any(|[low, high]| low < high)
    }

    /// Azimuth and elevation of the Sun in the normal or the alternate attitude, in rad.
    pub fn sun_place_rad(&self, is_alternate: bool) -> [f64; 2] {
        let controls =
            if is_alternate && self.is_apart() { self.controls.alternate() } else { self.controls };
        [Control::Azimuth, Control::Elevation].map(|it| controls.get(it))
    }

    /// Its attitude.
    pub(super) fn attitude(&self) -> Attitude {
        if self.kind == WindowKind::Free { Attitude::Downlink } else { Attitude::SimulatedFlight }
    }

    /// The attitude at a time where the geometry is a row's: that row's own where the window is not free.
    pub fn inertial_from_body(
        &self,
        sunlit: &SunlitSpacecraft,
        row: &FlightRow,
        at_s: f64,
    ) -> Rotation3<f64> {
        let is_inside = |[from_s, to_s]: &[f64; 2]| (*from_s..*to_s).contains(&at_s);
        let is_alternate = self.kind == WindowKind::Free && self.alternate_spans_s().iter().any(is_inside);
        let [azimuth_rad, elevation_rad] = self.sun_place_rad(is_alternate);
        let controls =
            self.controls.with(Control::Azimuth, azimuth_rad).with(Control::Elevation, elevation_rad);
        let inertial_from_body = sunlit.inertial_from_body(row, self.attitude(), &controls);
        if !is_alternate {
            return inertial_from_body;
        }
        let sun_line = Unit::new_normalize(row.to_sun_m);
        Rotation3::from_axis_angle(&sun_line, core::f64::consts::PI) * inertial_from_body
    }

    fn free_s(&self) -> f64 {
        self.free_of_contact.iter().map(|[from, to]| to - from).sum()
    }

    /// Share of the alternate attitude around a time, and that by unit of the share of the window.
    pub fn alternate_at(&self, time_s: f64) -> (f64, f64) {
        let is_free = self.free_of_contact.iter().any(|[from, to]| (*from..=*to).contains(&time_s));
        let free_s = self.free_s();
        if !is_free || free_s <= 0.0 {
            return (0.0, 0.0);
        }
        let by_share = self.length_s() / free_s;
        (self.controls.get(Control::Alternate) * by_share, by_share)
    }

    /// When the alternate attitude begins and ends: in the middle of every piece of a day at most, so that the drift of the Sun's
    /// direction within it cancels to the first order (+--+ in halves of 6 h for a share of one half).
    pub fn alternate_spans_s(&self) -> Vec<[f64; 2]> {
        let share = self.controls.get(Control::Alternate);
        let free_s = self.free_s();
        if share * self.length_s() < SHORTEST_S || free_s <= 0.0 {
            return Vec::new();
        }
        let part = (share * self.length_s() / free_s).min(1.0);
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for [from_s, to_s] in &self.free_of_contact {
            let pieces = ((to_s - from_s) / CYCLE_S - 1e-9).ceil().max(1.0);
            let long_s = (to_s - from_s) / pieces;
            for piece in 0..pieces as usize {
                let middle_s = from_s + (piece as f64 + 0.5) * long_s;
                let half_s = 0.5 * part * long_s;
                let span = [middle_s - half_s, middle_s + half_s];
                match spans.last_mut() {
                    Some(last) if span[0] - last[1] < SAME_S => last[1] = span[1],
                    _ => spans.push(span),
                }
            }
        }
        spans
    }
}

/// Longest cycle of normal and alternate attitude, in s.
const CYCLE_S: f64 = 86_400.0;
/// Less of the alternate attitude in a window is none, in s.
const SHORTEST_S: f64 = 60.0;

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

    pub(super) fn window(
        &self,
        [start_s, stop_s]: [f64; 2],
        (kind, command): (WindowKind, Option<usize>),
        (sunlit, simulated): (&SunlitSpacecraft, &SimulatedFlight),
        steps: &[OffsetStep],
    ) -> Window {
        let rows = || {
            simulated
                .rows
                .iter()
                .filter(move |row| (start_s - SAME_S..=stop_s + SAME_S).contains(&row.time_s))
        };
        let mut offsets_rad = shared_rad(&self.corridor, rows().map(|row| row.to_sun_m.norm()));
        let begun = steps.iter().rev().find(|step| step.at_s <= start_s + SAME_S);
        let offset_rad = match kind {
            WindowKind::Frozen => self.frozen_offset_rad,
            _ => begun.map_or(self.frozen_offset_rad, |step| self.offset_sign * step.offset_rad),
        };
        if self.offset_sign < 0.0 {
            offsets_rad = [-offsets_rad[1], -offsets_rad[0]];
        }
        let separation_rad = rows()
            .map(|row| row.to_sun_m.angle(&row.to_earth_m))
            .map(|angle_rad| angle_rad.min(core::f64::consts::PI - angle_rad))
            .fold(f64::INFINITY, f64::min);
        let free_of_contact = self.free_of_contact(start_s, stop_s);
        let free_s: f64 = free_of_contact.iter().map(|[from, to]| to - from).sum();
        let mut share = (free_s / (stop_s - start_s)).min(1.0);
        if self.contacts_s.is_empty() {
            share = share.min(1.0 - self.contact_share);
        }
        let mut bounds = [[0.0; 2]; CONTROLS];
        bounds[Control::Offset as usize] = [offset_rad; 2];
        if kind != WindowKind::Frozen && self.sides.iter().any(|side| *side != 0.0) {
            bounds[Control::Windmill as usize] =
                [-self.control_bounds.windmill_rad, self.control_bounds.windmill_rad];
        }
        if kind == WindowKind::Free {
            let change_rad = self.control_bounds.offset_rad;
            if !self.sides.is_empty() {
                bounds[Control::Offset as usize] = [
                    (offset_rad - change_rad).max(offsets_rad[0].min(offset_rad)),
                    (offset_rad + change_rad).min(offsets_rad[1].max(offset_rad)),
                ];
            }
            let azimuth_rad = self.control_bounds.azimuth_rad;
            let elevation_rad = self.control_bounds.elevation_rad.min((separation_rad - LEFT_RAD).max(0.0));
            bounds[Control::Azimuth as usize] = [-azimuth_rad, azimuth_rad];
            bounds[Control::Elevation as usize] = [-elevation_rad, elevation_rad];
            bounds[Control::Alternate as usize] = [0.0, self.control_bounds.alternate.min(share)];
            if self.control_bounds.alternate_apart && self.control_bounds.alternate.min(share) > 0.0 {
                bounds[Control::AlternateAzimuth as usize] = bounds[Control::Azimuth as usize];
                bounds[Control::AlternateElevation as usize] = bounds[Control::Elevation as usize];
            }
        }
        let mut controls = Controls::default().with(Control::Offset, offset_rad);
        let in_force = (kind == WindowKind::Free).then(|| mean(&self.in_force, [start_s, stop_s])).flatten();
        if let Some(in_force) = in_force {
            // Off the baseline or as it is: that of a shorter flight may be another one.
            if self.control_bounds.offset_rad > 0.0 {
                let present_rad = in_force.get(Control::Offset).min(offsets_rad[1]).max(offsets_rad[0]);
                let [low, high] = &mut bounds[Control::Offset as usize];
                (*low, *high) = (low.min(present_rad), high.max(present_rad));
            }
            for control in ALL {
                let [low, high] = bounds[control as usize];
                controls = controls.with(control, in_force.get(control).min(high).max(low));
            }
        }
        let mut allowed = Vec::new();
        if kind == WindowKind::Free && self.downlinks_s.is_some() {
            let all: Vec<&FlightRow> = rows().collect();
            let sun_bounds = [self.control_bounds.azimuth_rad, self.control_bounds.elevation_rad];
            allowed = places(sunlit, &all, sun_bounds);
            bounds[Control::Azimuth as usize] = [-sun_bounds[0], sun_bounds[0]];
            bounds[Control::Elevation as usize] = [-sun_bounds[1], sun_bounds[1]];
        }
        Window {
            start_s,
            stop_s,
            kind,
            command,
            free_of_contact: if kind == WindowKind::Free { free_of_contact } else { Vec::new() },
            bounds,
            places: allowed,
            offsets_rad: [offsets_rad[0].min(offset_rad), offsets_rad[1].max(offset_rad)],
            baseline_rad: offset_rad,
            sides: self.sides.clone(),
            controls,
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
