//! A flight as the FMU reports it: geometry, attitude, torque and momentum at its communication points.

use core::fmt;

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use physics::{environment::CartesianState, momentum::Convention};

use super::encountered::Encountered;

/// Measure of the size of a momentum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MomentumSize {
    /// Its length |H|.
    #[default]
    Length,
    /// Its largest component, by which dumps are triggered.
    LargestComponent,
}

impl From<Convention> for MomentumSize {
    fn from(convention: Convention) -> Self {
        match convention {
            Convention::Inertial => Self::Length,
            Convention::BodyIntegral => Self::LargestComponent,
        }
    }
}

/// Symbol of the size, as reports print it.
impl fmt::Display for MomentumSize {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Length => "|H|",
            Self::LargestComponent => "largest component of H",
        })
    }
}

impl MomentumSize {
    /// Returns the size of this momentum, in its unit.
    pub fn size(self, momentum: &Vector3<f64>) -> f64 {
        match self {
            Self::Length => momentum.norm(),
            Self::LargestComponent => momentum.amax(),
        }
    }
}

/// How the spacecraft moves between the Sun and the body of its encounter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The spacecraft from the Sun, EME2000.
    pub from_sun: CartesianState,
    /// The body of the encounter from the Sun, EME2000; the centre of the orbit where there is no encounter.
    pub body_from_sun: CartesianState,
    /// Mass of the spacecraft, in kg.
    pub mass_kg: f64,
    /// Force of sunlight and of the heat that it leaves, EME2000, in N.
    pub light_n: Vector3<f64>,
}

impl Motion {
    /// The spacecraft from the body of the encounter, EME2000.
    pub fn from_body(&self) -> CartesianState {
        self.from_sun - self.body_from_sun
    }

    /// Motion `share` of the `span_s` to `next`: paths by the cubics with both velocities, whose error is h^4 / 384 times the
    /// fourth derivative: 50 m for rows 6 h apart 0.3 AU from the Sun.
    pub fn toward(&self, next: &Self, share: f64, span_s: f64) -> Self {
        let path = |from: &CartesianState, to: &CartesianState| hermite(from, to, share, span_s);
        Self {
            from_sun: path(&self.from_sun, &next.from_sun),
            body_from_sun: path(&self.body_from_sun, &next.body_from_sun),
            mass_kg: self.mass_kg + share * (next.mass_kg - self.mass_kg),
            light_n: self.light_n.lerp(&next.light_n, share),
        }
    }
}

/// On the cubic through two states that are `span_s` apart.
fn hermite(from: &CartesianState, to: &CartesianState, share: f64, span_s: f64) -> CartesianState {
    let rest = 1.0 - share;
    let chord_m = to.position_m - from.position_m;
    let [first_m, last_m] = [from, to].map(|state| state.velocity_m_s * span_s);
    let bulge_m = (first_m - chord_m) * rest - (last_m - chord_m) * share;
    let slope_m = (first_m - chord_m) * (rest * (1.0 - 3.0 * share))
        + (last_m - chord_m) * (share * (3.0 * share - 2.0));
    CartesianState {
        position_m: from.position_m + chord_m * share + bulge_m * (share * rest),
        velocity_m_s: (chord_m + slope_m) / span_s,
    }
}

/// Geometry, torques and momentum at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightRow {
    /// In s of the flight.
    pub time_s: f64,
    /// To the Sun's centre, EME2000, in m.
    pub to_sun_m: Vector3<f64>,
    /// To the Earth's centre, EME2000, in m.
    pub to_earth_m: Vector3<f64>,
    /// Visible share of the Sun's disc.
    pub lit_fraction: f64,
    /// The attitude.
    pub inertial_from_body: Rotation3<f64>,
    /// How each panel stands about its axis, in rad.
    pub panel_angles_rad: Vec<f64>,
    /// Torque of everything but direct sunlight, EME2000 (where the body components are integrated: body frame), in N m.
    pub other_torque_n_m: Vector3<f64>,
    /// Angular momentum of the whole spacecraft, EME2000 (where the body components are integrated: body frame), in N m s.
    pub momentum_n_m_s: Vector3<f64>,
    /// Dumps so far.
    pub dumps: u32,
    /// Whether a downlink lasts.
    pub downlink: bool,
    /// Motion and light, where they were recorded.
    pub motion: Option<Motion>,
}

impl FlightRow {
    /// The row `share` of the way to `next`, with the dumps of this one.
    pub(crate) fn toward(&self, next: &Self, share: f64) -> Self {
        let mixed = |a: f64, b: f64| a + share * (b - a);
        let span_s = next.time_s - self.time_s;
        let [from, to] =
            [self, next].map(|row| UnitQuaternion::from_rotation_matrix(&row.inertial_from_body));
        let attitude = from.try_slerp(&to, share, 1e-12).unwrap_or(from);
        let angles = self.panel_angles_rad.iter().zip(&next.panel_angles_rad);
        Self {
            time_s: mixed(self.time_s, next.time_s),
            to_sun_m: self.to_sun_m.lerp(&next.to_sun_m, share),
            to_earth_m: self.to_earth_m.lerp(&next.to_earth_m, share),
            lit_fraction: mixed(self.lit_fraction, next.lit_fraction),
            inertial_from_body: attitude.to_rotation_matrix(),
            panel_angles_rad: angles.map(|(a, b)| mixed(*a, *b)).collect(),
            other_torque_n_m: self.other_torque_n_m.lerp(&next.other_torque_n_m, share),
            momentum_n_m_s: self.momentum_n_m_s.lerp(&next.momentum_n_m_s, share),
            dumps: self.dumps,
            downlink: self.downlink,
            motion: self.motion.zip(next.motion).map(|(from, to)| from.toward(&to, share, span_s)),
        }
    }
}

/// A flight; its times grow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SimulatedFlight {
    /// At least two.
    pub rows: Vec<FlightRow>,
    /// How it missed what it was aimed at; `None` where there is nothing.
    pub encountered: Option<Encountered>,
    /// Why it ended before the mission does: a path into a planet.
    pub ended: Option<String>,
}

impl SimulatedFlight {
    fn without_rows(&self) -> Self {
        Self { rows: Vec::new(), encountered: self.encountered.clone(), ended: self.ended.clone() }
    }

    /// The flight with a row at each of these times that lies within it, interpolated where it has none.
    pub fn with_rows_at(&self, times_s: &[f64]) -> Self {
        let mut rows = self.rows.clone();
        for &time_s in times_s {
            let after = rows.partition_point(|row| row.time_s < time_s);
            let Some(next) = rows.get(after) else { continue };
            if (next.time_s - time_s).abs() <= SAME_S || after == 0 {
                continue;
            }
            let before = &rows[after - 1];
            if time_s - before.time_s <= SAME_S {
                continue;
            }
            let share = (time_s - before.time_s) / (next.time_s - before.time_s);
            let row = before.toward(next, share);
            rows.insert(after, row);
        }
        Self { rows, ..self.without_rows() }
    }

    /// The flight with rows at least so far apart, in s, the first and the last among them.
    pub fn thinned(&self, step_s: f64) -> Self {
        let mut rows: Vec<FlightRow> = Vec::new();
        for (index, row) in self.rows.iter().enumerate() {
            let is_apart = rows.last().is_none_or(|last| row.time_s - last.time_s >= step_s - SAME_S);
            // Dumps stay between the same rows.
            let dumps = rows.last().is_some_and(|last| last.dumps != row.dumps);
            if is_apart || dumps || index + 1 == self.rows.len() {
                rows.push(row.clone());
            }
        }
        Self { rows, ..self.without_rows() }
    }

    /// The flight with what another one reports within a span.
    pub fn with_part_of(&self, other: &Self, [from_s, to_s]: [f64; 2]) -> Self {
        let is_inside = |row: &&FlightRow| row.time_s > from_s + SAME_S && row.time_s < to_s - SAME_S;
        let mut rows: Vec<FlightRow> =
            self.rows.iter().filter(|row| row.time_s <= from_s + SAME_S).cloned().collect();
        rows.extend(other.rows.iter().filter(is_inside).cloned());
        rows.extend(self.rows.iter().filter(|row| row.time_s >= to_s - SAME_S).cloned());
        Self { rows, ..self.without_rows() }
    }

    /// Rows within a span.
    pub fn within(&self, [from_s, to_s]: [f64; 2]) -> impl Iterator<Item = &FlightRow> {
        self.rows.iter().filter(move |row| (from_s - SAME_S..=to_s + SAME_S).contains(&row.time_s))
    }

    /// Interpolates the row at a time within the flight.
    pub fn at(&self, time_s: f64) -> Option<FlightRow> {
        let with = self.with_rows_at(&[time_s]);
        with.rows.into_iter().find(|row| (row.time_s - time_s).abs() <= SAME_S)
    }

    /// Momentum at a time, in N m s, interpolated; behind a dump that which it leaves.
    pub fn momentum_n_m_s(&self, time_s: f64) -> Vector3<f64> {
        let after = self.rows.partition_point(|row| row.time_s < time_s - SAME_S);
        match (after.checked_sub(1).and_then(|before| self.rows.get(before)), self.rows.get(after)) {
            (_, Some(next)) if next.time_s <= time_s + SAME_S => next.momentum_n_m_s,
            (Some(before), Some(next)) => {
                let share = (time_s - before.time_s) / (next.time_s - before.time_s);
                before.momentum_n_m_s.lerp(&next.momentum_n_m_s, share)
            }
            (None, Some(row)) | (Some(row), None) => row.momentum_n_m_s,
            (None, None) => Vector3::zeros(),
        }
    }

    /// Momentum gained over a span, in N m s.
    pub fn gained_n_m_s(&self, [from_s, to_s]: [f64; 2]) -> Vector3<f64> {
        self.momentum_n_m_s(to_s) - self.momentum_n_m_s(from_s)
    }

    /// Downlinks, from the first row in each to the first behind it, in s.
    pub fn downlinks_s(&self) -> Vec<[f64; 2]> {
        let mut found: Vec<[f64; 2]> = Vec::new();
        let mut lasts = false;
        for row in &self.rows {
            match found.last_mut() {
                Some(last) if lasts => last[1] = row.time_s,
                _ if row.downlink => found.push([row.time_s; 2]),
                _ => {}
            }
            lasts = row.downlink;
        }
        found
    }

    /// Greatest size of the momentum, in N m s, and when.
    pub fn greatest(&self, size: MomentumSize) -> (f64, f64) {
        self.rows.iter().fold((0.0, f64::NAN), |(greatest, at_s), row| {
            let momentum = size.size(&row.momentum_n_m_s);
            if momentum > greatest { (momentum, row.time_s) } else { (greatest, at_s) }
        })
    }
}

/// Times nearer than this are one.
pub const SAME_S: f64 = 1e-3;
