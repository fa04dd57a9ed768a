//! Partials of an encounter: B.T, B.R and time of closest approach by the state at any time before.
//!
//! Method: partials at the epoch of osculation are carried back along the recorded path by the adjoint equation, with the gradient of
//! all that attracts and of light, in cells of a day at most and of 0.3 of the distance over the speed near a planet.
//! Error: 1e-5 of each row's norm over 200 days with rows an hour apart, and where light turns over within that (tested).

use nalgebra::{Matrix3, Matrix3x6, Vector2, Vector3};
use physics::{
    bodies::Body,
    environment::orbit::{BodyEphemeris, OrbitMethod},
    numerics::Span,
};

use super::{
    encounter::Encounter,
    flight::{ForceModel, Path, Recorded},
    light::LightAlong,
};
use crate::momentum::{simulated::SimulatedFlight, torque::SunlitSpacecraft};
use crate::orbit::{Partials, partials_over};

/// Longest cell, in s.
const LONGEST_S: f64 = 86_400.0;
/// Shortest cell, in s: no gradient is as strong as to need less.
const SHORTEST_S: f64 = 10.0;
/// Length of a cell over the time to the nearest planet.
const SHARE: f64 = 0.3;

/// Partials of an encounter along a flight.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    /// The encounter.
    pub encounter: Encounter,
    /// In the order of time.
    cells: Vec<Partials<3>>,
}

impl Sensitivity {
    /// Computes the partials of a recorded flight of this spacecraft.
    ///
    /// # Errors
    /// See [`Encounter`]; a gradient that is not finite.
    pub fn new(
        flight: &SimulatedFlight,
        force_model: &ForceModel,
        sunlit: &SunlitSpacecraft,
    ) -> Result<Self, String> {
        let path = Path::new(flight)?;
        let encounter = Encounter::new(&path, force_model)?;
        let light = LightAlong::new(&path, sunlit);
        let gravity = force_model.gravity(Body::Sun);
        let planets = force_model.planets();
        let mut ephemeris = Recorded { path: &path, body: force_model.body, planets };
        let method = OrbitMethod::default();
        let mut flips = light.flips();
        let start_s = path.span_s()[0];
        let (mut end_s, mut partials) = (encounter.epoch_s, encounter.at_epoch_partials);
        let mut cells = Vec::new();
        while end_s > start_s {
            let long_s = longest_s(&path, &force_model.attracting, end_s, &mut ephemeris);
            while flips.last().is_some_and(|flip| flip.time_s > end_s) {
                flips.pop();
            }
            let flip = flips.last().copied();
            let flip_s = flip.map_or(f64::NEG_INFINITY, |flip| flip.time_s);
            let from_s = (end_s - long_s).max(start_s).max(flip_s);
            if from_s < end_s {
                let span = Span::new(from_s, end_s);
                // Within the cell: at its very end the nearest row may be one of the other side.
                let inside_s = |at_s: f64| at_s.clamp(from_s + 1e-3, end_s - 1e-3);
                let gradient = |at_s: f64| {
                    let position_m = path.at(at_s).from_sun.position_m;
                    gravity.model.gradient_per_s2(Body::Sun, at_s, &position_m, &mut ephemeris)
                        + light.gradient_per_s2(inside_s(at_s))
                };
                let cell =
                    partials_over(&method, span, &partials, gradient).map_err(|error| error.to_string())?;
                partials = cell.at_start;
                cells.push(cell);
            }
            if let Some(flip) = flip.filter(|flip| flip.time_s >= from_s) {
                partials *= flip.saltation;
                flips.pop();
            }
            end_s = from_s;
        }
        cells.reverse();
        Ok(Self { encounter, cells })
    }

    /// B.T (m), B.R (m) and the time of closest approach (s) by position (m) and velocity (m/s), EME2000, at a time of the flight;
    /// before its start as there, behind the epoch of osculation as at that.
    pub fn at(&self, time_s: f64) -> Matrix3x6<f64> {
        let index = self.cells.partition_point(|cell| cell.span.end_s <= time_s);
        match self.cells.get(index) {
            Some(cell) => cell.at(time_s),
            None => self.encounter.at_epoch_partials,
        }
    }

    /// The same by the velocity alone; from the epoch of osculation on nothing, as a change there has no part in it.
    pub fn by_velocity(&self, time_s: f64) -> Matrix3<f64> {
        if time_s > self.encounter.epoch_s {
            return Matrix3::zeros();
        }
        self.at(time_s).fixed_columns::<3>(3).into_owned()
    }

    /// The least change of the velocity at a time that takes a miss away, in m of B.T and B.R, whenever it arrives then; `None`
    /// where no velocity reaches both.
    pub fn desired(&self, time_s: f64, miss_m: [f64; 2]) -> Option<DesiredDeltaV> {
        let rows = self.by_velocity(time_s).fixed_rows::<2>(0).into_owned();
        let weights = (rows * rows.transpose()).try_inverse()? * Vector2::from(miss_m);
        Some(DesiredDeltaV { delta_v_m_s: -rows.tr_mul(&weights) })
    }

    /// The change of the velocity at a time that takes a miss away and arrives earlier by `late_s`.
    pub fn desired_in_time(&self, time_s: f64, miss_m: [f64; 2], late_s: f64) -> Option<DesiredDeltaV> {
        let miss = Vector3::new(miss_m[0], miss_m[1], late_s);
        Some(DesiredDeltaV { delta_v_m_s: -(self.by_velocity(time_s).try_inverse()? * miss) })
    }
}

/// A change of velocity that is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesiredDeltaV {
    /// EME2000, in m/s.
    pub delta_v_m_s: Vector3<f64>,
}

impl DesiredDeltaV {
    /// In m/s.
    pub fn size_m_s(&self) -> f64 {
        self.delta_v_m_s.norm()
    }

    /// Right ascension of its direction in EME2000, from 0 to 2 pi, in rad.
    pub fn right_ascension_rad(&self) -> f64 {
        self.delta_v_m_s.y.atan2(self.delta_v_m_s.x).rem_euclid(core::f64::consts::TAU)
    }

    /// Declination of its direction in EME2000, in rad.
    pub fn declination_rad(&self) -> f64 {
        self.delta_v_m_s.z.atan2(self.delta_v_m_s.x.hypot(self.delta_v_m_s.y))
    }
}

/// How long a cell that ends at a time may be, by the planets that are near, in s.
fn longest_s(path: &Path<'_>, attracting: &[Body], end_s: f64, ephemeris: &mut Recorded<'_>) -> f64 {
    let here = path.at(end_s).from_sun;
    let times_s = attracting.iter().map(|body| {
        let relative = here - ephemeris.heliocentric(*body, end_s);
        SHARE * relative.position_m.norm() / relative.velocity_m_s.norm()
    });
    times_s.fold(LONGEST_S, f64::min).max(SHORTEST_S)
}

#[cfg(test)]
mod tests;
