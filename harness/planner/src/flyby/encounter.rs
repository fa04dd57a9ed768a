//! Closest approach of a recorded flight, the hyperbola that osculates some time before it, and their partials by the state there.
//!
//! Equation: at closest approach r . v = 0, so that its time changes by dt = -(v dr + r dv) / (v^2 + r . a), dr and dv by the transition
//! matrix from the epoch of osculation. That epoch is a fixed time before: B changes by dB/dx dx + (dB/dt) dt, dB/dt along the path.
//! Method: from the last row before the epoch the path is propagated by n bodies with the light of that row, and partials along it.
//! Error: metres of the path in six hours, by light that stays; rows of partials 1e-5 of their norm (tested).

use nalgebra::{Matrix3x6, Matrix6, RowVector6, Vector3};
use physics::{
    environment::{
        CartesianState,
        orbit::{BPlane, DisturbedOrbit, NBodyGravity, OrbitMethod, TwoBodyOrbit},
    },
    numerics::{Span, roots},
};

use super::flight::{ForceModel, Path, Planets};
use crate::orbit::transition;

/// Before and after the epoch of osculation B is looked at, in s.
const AROUND_S: f64 = 60.0;
/// A closest approach farther away than this many spheres of influence is none.
const SPHERES: f64 = 3.0;

/// Closest approach of a flight to the planet of its encounter, also one that would come after its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Encounter {
    /// Time of closest approach, in s of the flight.
    pub time_s: f64,
    /// Time at which the hyperbola osculates, in s of the flight.
    pub epoch_s: f64,
    /// B-plane of the osculating hyperbola.
    pub plane: BPlane,
    /// The spacecraft from the planet then, EME2000.
    pub at_epoch: CartesianState,
    /// The spacecraft from the planet at closest approach, EME2000.
    pub closest: CartesianState,
    /// Acceleration by light there, EME2000, in m/s2.
    pub(super) light_m_s2: Vector3<f64>,
    /// B.T, B.R (m) and time of closest approach (s) by the state at the epoch (m, m/s).
    pub(super) at_epoch_partials: Matrix3x6<f64>,
}

impl Encounter {
    /// Finds the encounter of a recorded flight that comes to it, or comes near and would continue to it.
    ///
    /// # Errors
    /// A flight without motion, one that does not come near, an osculating orbit that is no hyperbola.
    pub(super) fn new(path: &Path<'_>, force_model: &ForceModel) -> Result<Self, String> {
        let about_s = first_guess_s(path, force_model)?;
        let lead_s = force_model.lead_s;
        if !(lead_s.is_finite() && lead_s >= 0.0) {
            return Err(format!("encounter.leadTime: found {lead_s} s, allowed: 0 s or more"));
        }
        let row = path.rows[path.index_before(about_s - lead_s - 2.0 * AROUND_S)];
        let light_m_s2 = row.motion.light_n / row.motion.mass_kg;
        let from =
            PredictedPath { force_model, start_s: row.row.time_s, state: row.motion.from_body(), light_m_s2 };
        let time_s = from.closest_s()?;
        let epoch_s = time_s - lead_s;
        let [before, at_epoch, after] =
            [-AROUND_S, 0.0, AROUND_S].map(|off_s| from.state_at(epoch_s + off_s));
        let at_epoch = at_epoch?;
        let of = |state: &CartesianState| {
            let plane = BPlane::from_state(state, force_model.gm_m3_s2);
            plane.ok_or_else(|| {
                format!("the orbit about {} at {epoch_s} s: found no hyperbola", name(force_model))
            })
        };
        let [before, plane, after] = [of(&before?)?, of(&at_epoch)?, of(&after?)?];
        let predicted_path = PredictedPath { start_s: epoch_s, state: at_epoch, ..from };
        let (matrix, closest) = predicted_path.over(time_s)?;
        let time_by_state = closest_by_state(&closest, force_model.gm_m3_s2) * matrix;
        let mut partials = BPlane::partials(&at_epoch, force_model.gm_m3_s2).unwrap_or_else(Matrix3x6::zeros);
        let rates = [after.b_t_m - before.b_t_m, after.b_r_m - before.b_r_m].map(|it| it / (2.0 * AROUND_S));
        for (row, rate_m_s) in rates.into_iter().enumerate() {
            let moved = partials.row(row) + time_by_state * rate_m_s;
            partials.set_row(row, &moved);
        }
        partials.set_row(2, &time_by_state);
        Ok(Self { time_s, epoch_s, plane, at_epoch, closest, light_m_s2, at_epoch_partials: partials })
    }

    /// Propagates on from the epoch of osculation.
    pub(super) fn predicted_path<'a>(&self, force_model: &'a ForceModel) -> PredictedPath<'a> {
        PredictedPath {
            force_model,
            start_s: self.epoch_s,
            state: self.at_epoch,
            light_m_s2: self.light_m_s2,
        }
    }
}

/// Time of closest approach by the state there: r . v = 0, and the planet alone attracts.
fn closest_by_state(closest: &CartesianState, gm_m3_s2: f64) -> RowVector6<f64> {
    let (r, v) = (closest.position_m, closest.velocity_m_s);
    let rate_m2_s2 = v.norm_squared() - gm_m3_s2 / r.norm();
    -RowVector6::new(v.x, v.y, v.z, r.x, r.y, r.z) / rate_m2_s2
}

fn name(force_model: &ForceModel) -> &'static str {
    force_model.body.data().name
}

/// About when the flight is nearest, by rows on both sides of it, or by the hyperbola of its last row.
fn first_guess_s(path: &Path<'_>, force_model: &ForceModel) -> Result<f64, String> {
    let near_m = SPHERES * force_model.gravity(force_model.body).model.sphere_m(force_model.body);
    let is_approaching = |state: &CartesianState| state.position_m.dot(&state.velocity_m_s) < 0.0;
    let passed = path.rows.windows(2).find(|pair| {
        let [from, to] = [pair[0], pair[1]].map(|it| it.motion.from_body());
        from.position_m.norm() < near_m && is_approaching(&from) && !is_approaching(&to)
    });
    let row = passed.map_or(path.rows[path.rows.len() - 1], |pair| pair[0]);
    let state = row.motion.from_body();
    let found = TwoBodyOrbit::from_state(&state, force_model.gm_m3_s2, row.row.time_s).ok();
    let found = found.filter(|orbit| is_approaching(&state) && orbit.period_s().is_infinite());
    let at_s = found.map(|orbit| (orbit.periapsis_epoch_s(0), orbit));
    let near = at_s.filter(|(at_s, orbit)| orbit.state_at(*at_s).position_m.norm() < near_m);
    near.map(|(at_s, _)| at_s).ok_or_else(|| {
        format!(
            "encounter.body: found no closest approach to {} up to {} s, allowed: a flight that comes within {:.0} km of it",
            name(force_model),
            path.span_s()[1],
            near_m / 1e3
        )
    })
}

/// A path predicted from a recorded one.
#[derive(Clone, Copy, Debug)]
pub(super) struct PredictedPath<'a> {
    pub force_model: &'a ForceModel,
    /// Begin, in s of the flight.
    pub start_s: f64,
    /// The spacecraft from the planet of the encounter there.
    pub state: CartesianState,
    /// Acceleration by light, EME2000, which stays.
    pub light_m_s2: Vector3<f64>,
}

/// One integrated segment of it.
pub(super) struct Cell<'a> {
    orbit: &'a DisturbedOrbit,
    method: &'a OrbitMethod,
    gravity: &'a NBodyGravity,
    planets: &'a mut Planets,
}

impl Cell<'_> {
    /// The transition matrix over it.
    pub(super) fn transition(&mut self) -> Result<Matrix6<f64>, String> {
        let Self { orbit, method, gravity, planets } = self;
        let found = transition(method, Span::new(orbit.start_s(), orbit.end_s()), |at_s| {
            let position_m = orbit.state_at(at_s).position_m;
            gravity.model.gradient_per_s2(gravity.model.center, at_s, &position_m, *planets)
        });
        found.map_err(|error| error.to_string())
    }
}

impl PredictedPath<'_> {
    /// Up to a time, cell by cell, as long as `visit` says so; the state at the end, from the planet.
    pub(super) fn propagate(
        &self,
        end_s: f64,
        visit: &mut dyn FnMut(&mut Cell<'_>) -> Result<bool, String>,
    ) -> Result<CartesianState, String> {
        let gravity = self.force_model.gravity(self.force_model.body);
        let method = OrbitMethod::default();
        let mut planets = self.force_model.planets();
        let mut orbit = DisturbedOrbit::between_bodies(&self.state, self.start_s, &gravity)
            .map_err(|error| error.to_string())?;
        while orbit.end_s() < end_s {
            orbit
                .advance_between_bodies(end_s, &method, &gravity, &mut planets, |_| self.light_m_s2)
                .map_err(|error| error.to_string())?;
            let mut cell = Cell { orbit: &orbit, method: &method, gravity: &gravity, planets: &mut planets };
            if !visit(&mut cell)? {
                break;
            }
        }
        Ok(orbit.state_at(orbit.end_s().min(end_s)))
    }

    /// The transition matrix to a time, and the state there from the planet.
    pub(super) fn over(&self, end_s: f64) -> Result<(Matrix6<f64>, CartesianState), String> {
        let mut matrix = Matrix6::identity();
        let state = self.propagate(end_s, &mut |cell| {
            matrix = cell.transition()? * matrix;
            Ok(true)
        })?;
        Ok((matrix, state))
    }

    /// The state at a time, from the planet.
    fn state_at(&self, time_s: f64) -> Result<CartesianState, String> {
        if time_s <= self.start_s {
            let back = TwoBodyOrbit::from_state(&self.state, self.force_model.gm_m3_s2, self.start_s);
            return Ok(back.map_err(|error| error.to_string())?.state_at(time_s));
        }
        self.propagate(time_s, &mut |_| Ok(true))
    }

    /// When it is nearest to the planet, in s.
    fn closest_s(&self) -> Result<f64, String> {
        let radial = |state: CartesianState| state.position_m.dot(&state.velocity_m_s);
        let mut found_s = None;
        // As long as the hyperbola would take, and as long again.
        let two_body = TwoBodyOrbit::from_state(&self.state, self.force_model.gm_m3_s2, self.start_s)
            .map_err(|error| error.to_string())?;
        let until_s = 2.0 * two_body.periapsis_epoch_s(0) - self.start_s + 3600.0;
        self.propagate(until_s, &mut |cell| {
            let orbit = cell.orbit;
            if radial(orbit.state_at(orbit.end_s())) < 0.0 {
                return Ok(true);
            }
            let radial_at = |at_s: f64| radial(orbit.state_at(at_s));
            found_s = roots::bracketed(orbit.start_s(), orbit.end_s(), radial_at);
            Ok(false)
        })?;
        found_s.ok_or_else(|| {
            format!("found no closest approach to {} up to {until_s} s", name(self.force_model))
        })
    }
}
