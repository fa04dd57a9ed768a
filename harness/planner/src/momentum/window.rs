//! A window of a flight: its kind, the bounds of its controls, and their present values.

use nalgebra::{Rotation3, Unit};

use super::{
    controls::{ALTERNATE_PLACE, CONTROLS, Control, Controls, PLACE},
    linear_torque::LinearTorque,
    places::PlaceSide,
    simulated::{FlightRow, SAME_S},
    torque::{Attitude, SunlitSpacecraft},
};

/// Kind of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WindowKind {
    /// Settings of the mission, arrays included.
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

    /// Whether it has arrays that a plan turns.
    pub(crate) fn has_arrays(&self) -> bool {
        self.kind != WindowKind::Frozen && !self.sides.is_empty()
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

    /// Whether the bounds of a control leave a choice.
    pub(super) fn moves(&self, control: Control) -> bool {
        let [low, high] = self.bounds[control as usize];
        low < high
    }

    /// Whether the alternate attitude has a place of the Sun of its own.
    pub(super) fn is_apart(&self) -> bool {
        ALTERNATE_PLACE.iter().any(|control| self.moves(*control))
    }

    /// Azimuth and elevation of the Sun in the normal or the alternate attitude, in rad.
    pub fn sun_place_rad(&self, is_alternate: bool) -> [f64; 2] {
        let controls =
            if is_alternate && self.is_apart() { self.controls.alternate() } else { self.controls };
        controls.each(PLACE)
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
        let controls = self.controls.with_place(self.sun_place_rad(is_alternate));
        let inertial_from_body = sunlit.inertial_from_body(row, self.attitude(), &controls);
        if !is_alternate {
            return inertial_from_body;
        }
        let sun_line = Unit::new_normalize(row.to_sun_m);
        Rotation3::from_axis_angle(&sun_line, core::f64::consts::PI) * inertial_from_body
    }

    /// Time outside of contacts, in s.
    pub(super) fn free_s(&self) -> f64 {
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

    /// Returns the spans of the alternate attitude: in the middle of every piece of a day at most, so that the drift of the Sun's
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
