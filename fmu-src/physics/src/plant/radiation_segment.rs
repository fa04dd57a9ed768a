//! Segments of light and heat: they change slowly and cost more than everything else, so they are computed at a few nodes of
//! a segment of their own and read from a polynomial in between. How the flight is stepped does not matter to them.
//!
//! Equation: force and torque of each effect as functions of time; temperatures of surfaces that store heat.
//! Method: interpolation at 6 Chebyshev nodes, the segment shortened until its last terms are below the tolerance
//! ([`crate::numerics::adaptive`]); it ends at an event. Stored heat is integrated along the segment between the nodes
//! (`stored_heat`).
//! Order: 6 in the length.
//! Error measure: the last two terms of force and torque, relative to the largest force and torque of all effects in the
//! segment; a torque counts against the largest force at an arm of 1 cm at least.
//! Reference: see [`crate::numerics::adaptive`].

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::numerics::adaptive::AdaptiveInterval;
use crate::numerics::chebyshev::{GREATEST_IN_STATE, Segment};
use crate::radiation::disturbance::{Disturbance, FaceResult, GeometryError};
use crate::radiation::{Effect, ForceTorque, Loads};

use super::evaluation::{ExternalLoad, Plant};
use super::propagator::PlantError;
use super::radiation::{RadiationSettings, RadiationSolver};
use super::work::Cost;

/// Chebyshev nodes a segment.
pub(super) const NODES: usize = 6;
/// Force and torque of every effect of light and heat.
const ROWS: usize = 6 * Effect::RADIATION.len();
/// No segment is shortened below this, in s: kinks where a face turns dark end here.
const SHORTEST_S: f64 = 1.0;
/// Torque is resolved as if the largest force had at least this arm, in m: on a symmetric body there is none.
const LEAST_ARM_M: f64 = 0.01;
/// No surface is hotter, in K.
const HOTTEST_K: f64 = 1e5;

/// Light and heat over one interval, and the heat stored at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RadiationSegment {
    start_s: f64,
    end_s: f64,
    /// Length the tolerance will probably allow the next segment, in s.
    next_longest_s: f64,
    /// Absent before the first segment.
    loads: Option<Segment<ROWS, NODES>>,
    /// Temperature of every face in K; empty where no heat is stored.
    temperatures_k: Vec<Segment<1, NODES>>,
    /// The same at the end.
    end_k: Vec<f64>,
}

impl RadiationSegment {
    /// Before the first segment.
    pub(super) fn before() -> Self {
        Self {
            start_s: f64::INFINITY,
            end_s: f64::NEG_INFINITY,
            next_longest_s: f64::INFINITY,
            loads: None,
            temperatures_k: Vec::new(),
            end_k: Vec::new(),
        }
    }

    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        let hot = |kelvin: &f64| (0.0..=HOTTEST_K).contains(kelvin);
        let ordered = self.loads.is_none() || (self.start_s.abs().max(self.end_s.abs()) <= GREATEST_IN_STATE);
        ordered
            && !self.start_s.is_nan()
            && !self.end_s.is_nan()
            && self.next_longest_s > 0.0
            && self
                .loads
                .as_ref()
                .is_none_or(|it| it.is_sound() && it.spans(self.start_s, self.end_s.max(self.start_s)))
            && self.temperatures_k.iter().all(|it| {
                let most_k: f64 = it.coefficients().iter().map(|c| c.abs()).sum();
                it.is_sound()
                    && it.spans(self.start_s, self.end_s.max(self.start_s))
                    && most_k <= 10.0 * HOTTEST_K
            })
            && self.end_k.iter().all(hot)
    }

    /// Whether it has come to `time_s` and no segment further; so in every flight, not in every sequence of bytes.
    pub fn covers(&self, time_s: f64) -> bool {
        self.start_s <= time_s + 8.0 * f64::EPSILON * time_s.abs() && time_s <= self.end_s
    }

    /// Force and torque at `time_s`.
    pub(super) fn loads(&self, time_s: f64, loads: &mut Loads) {
        let Some(series) = &self.loads else { return };
        let values = series.value(time_s);
        for (index, effect) in Effect::RADIATION.into_iter().enumerate() {
            loads[effect] = ForceTorque {
                force_body_n: values.fixed_rows::<3>(6 * index).into_owned(),
                torque_body_n_m: values.fixed_rows::<3>(6 * index + 3).into_owned(),
            };
        }
    }

    /// Temperatures in K of the faces at `time_s`; leaves `temperatures_k` alone where no heat is stored.
    fn temperatures_at(&self, time_s: f64, temperatures_k: &mut [f64]) {
        for (face, kelvin) in temperatures_k.iter_mut().enumerate() {
            let inside = self.temperatures_k.get(face).filter(|_| time_s < self.end_s);
            if let Some(known_k) =
                inside.map(|series| series.value(time_s)[0]).or(self.end_k.get(face).copied())
            {
                *kelvin = known_k;
            }
        }
    }

    /// Ends at `time_s`: the flight changes there.
    pub(super) fn cut(&mut self, time_s: f64) {
        if time_s > self.start_s && time_s < self.end_s {
            for (kelvin, series) in self.end_k.iter_mut().zip(&self.temperatures_k) {
                *kelvin = series.value(time_s)[0];
            }
        }
        self.end_s = self.end_s.min(time_s);
    }
}

impl<L: Fn(f64) -> ExternalLoad> Plant<'_, L> {
    /// Makes sure that light and heat are known from `start_s` on, and tells up to where, at most `limit_s`.
    pub(super) fn extend_radiation(&mut self, start_s: f64, limit_s: f64) -> Result<f64, PlantError> {
        if !self.configuration.light_and_heat.any() {
            return Ok(limit_s);
        }
        if let Some(segment) = &self.propagator.light
            && segment.start_s <= start_s
            && start_s < segment.end_s
        {
            return Ok(segment.end_s.min(limit_s));
        }
        let Some(light) = self.light.take() else { return Ok(limit_s) };
        let mut segment = self.propagator.light.take().unwrap_or_else(RadiationSegment::before);
        let built = self.build_radiation_segment(light, &mut segment, start_s, limit_s);
        let end_s = segment.end_s;
        self.propagator.light = Some(segment);
        self.light = Some(light);
        built.map(|()| end_s)
    }

    /// Builds the segment that begins at `start_s`. It ends at the next multiple of the grid or sooner: at `limit_s`, where
    /// the branch changes, or where the last Chebyshev terms would exceed the tolerance.
    fn build_radiation_segment(
        &mut self,
        light: &mut RadiationSolver,
        segment: &mut RadiationSegment,
        start_s: f64,
        limit_s: f64,
    ) -> Result<(), PlantError> {
        let effects = self.configuration.light_and_heat;
        let stores = effects.storage && effects.recoil && light.model.stores_heat();
        if stores {
            self.take_heat(light, segment, start_s)?;
        } else {
            segment.end_k.clear();
        }
        // Written so that a NaN from restored bytes is the shortest.
        let longest_s = segment.next_longest_s.max(SHORTEST_S);
        let mut interval = AdaptiveInterval::new(start_s, effects.grid_s, longest_s, limit_s, SHORTEST_S);
        interval.end_at(self.smooth_until(start_s, interval.end_s()));
        let series = loop {
            self.spend_units(Cost::Light, light.segment_units(stores), start_s)?;
            let lit = self.light_between(light, stores, &segment.end_k, start_s, interval.end_s());
            let shadows: usize = light.nodes.iter().map(|node| node.workspace.shadows_cut()).sum();
            self.spend_units(Cost::Light, u32::try_from(shadows).unwrap_or(u32::MAX), start_s)?;
            match lit {
                Ok(series) => {
                    let unresolved = unresolved(&series, &effects);
                    if let Some(next_s) = interval.accept(unresolved, effects.tolerance, NODES) {
                        segment.next_longest_s = next_s;
                        break series;
                    }
                }
                // The flight may be over before it comes to where light has no meaning.
                Err(error) if !interval.halve() => return Err(self.no_light(start_s, error)),
                Err(_) => {}
            }
        };
        let end_s = interval.end_s();
        (segment.start_s, segment.end_s, segment.loads) = (start_s, end_s, Some(series));
        segment.temperatures_k.clear();
        if stores {
            segment.temperatures_k.extend((0..light.face_count()).map(|face| {
                let samples = core::array::from_fn(|j| SVector::from([light.nodes[j].temperatures_k[face]]));
                Segment::from_samples(start_s, end_s, &samples)
            }));
            segment.end_k.copy_from_slice(light.heat_rule.end_k());
        }
        Ok(())
    }

    /// The heat stored at `start_s`: that at the end of the segment before, at the start of a flight that of balance.
    fn take_heat(
        &mut self,
        light: &mut RadiationSolver,
        segment: &mut RadiationSegment,
        start_s: f64,
    ) -> Result<(), PlantError> {
        if segment.loads.is_none() && segment.end_k.is_empty() {
            let RadiationSolver { model, panels, nodes, .. } = light;
            if let Some(node) = nodes.first_mut() {
                self.view(start_s, panels, node);
                node.balance(model).map_err(|error| self.no_light(start_s, error))?;
                segment.end_k.extend(node.workspace.faces().iter().map(|face| face.temperature_k));
            }
        }
        let (found, allowed) = (segment.end_k.len(), light.face_count());
        if found != allowed {
            return Err(PlantError::Temperatures { found, allowed });
        }
        match segment.end_k.iter().find(|kelvin| !(0.0..=HOTTEST_K).contains(*kelvin)) {
            Some(&found_k) => Err(PlantError::Temperature { found_k }),
            None => Ok(()),
        }
    }

    /// Light and heat from `start_s` to `end_s`.
    fn light_between(
        &mut self,
        light: &mut RadiationSolver,
        stores: bool,
        start_k: &[f64],
        start_s: f64,
        end_s: f64,
    ) -> Result<Segment<ROWS, NODES>, GeometryError> {
        let RadiationSolver { model, panels, nodes, heat_rule } = light;
        let times_s = Segment::<ROWS, NODES>::nodes(start_s, end_s);
        for (node, time_s) in nodes.iter_mut().zip(times_s) {
            self.view(time_s, panels, node);
            node.balance(model)?;
        }
        if stores {
            heat_rule.integrate(model, nodes, start_k, end_s - start_s);
            for node in nodes.iter_mut() {
                node.radiate_stored(model)?;
            }
        }
        let effects = &self.configuration.light_and_heat;
        let samples = core::array::from_fn(|j| rows(&nodes[j].found, effects));
        Ok(Segment::from_samples(start_s, end_s, &samples))
    }

    /// Reports temperature in K and force in N, body frame, of every face of the light model at `time_s`, in its order; the
    /// force of the effects that act.
    ///
    /// # Errors
    /// A geometry without meaning.
    pub fn faces(
        &mut self,
        time_s: f64,
        mut report: impl FnMut(f64, Vector3<f64>),
    ) -> Result<(), PlantError> {
        let Some(light) = self.light.take() else { return Ok(()) };
        let outcome = self.light_at(light, time_s);
        if outcome.is_ok()
            && let Some(node) = light.nodes.first()
        {
            let effects = &self.configuration.light_and_heat;
            for face in node.workspace.faces() {
                report(face.temperature_k, force_of(face, effects));
            }
        }
        self.light = Some(light);
        outcome
    }

    /// Light and heat at one time, in the first of the nodes.
    fn light_at(&mut self, light: &mut RadiationSolver, time_s: f64) -> Result<(), PlantError> {
        let RadiationSolver { model, panels, nodes, .. } = light;
        let Some(node) = nodes.first_mut() else { return Ok(()) };
        self.view(time_s, panels, node);
        node.balance(model).map_err(|error| self.no_light(time_s, error))?;
        let effects = &self.configuration.light_and_heat;
        if let Some(segment) = &self.propagator.light
            && effects.recoil
            && effects.storage
            && model.stores_heat()
        {
            segment.temperatures_at(time_s, &mut node.temperatures_k);
            node.radiate_stored(model).map_err(|error| self.no_light(time_s, error))?;
        }
        Ok(())
    }

    fn no_light(&self, time_s: f64, source: GeometryError) -> PlantError {
        let position_m = self.propagator.trajectory.state_at(self.configuration, time_s).position_m.into();
        PlantError::Light { time_s, position_m, source }
    }
}

/// The effects that act, row by row; sunlight always, as a measure for the others.
fn rows(found: &Disturbance<f64>, effects: &RadiationSettings) -> SVector<f64, ROWS> {
    let mut rows = SVector::<f64, ROWS>::zeros();
    let planet_light = effects.planet_light;
    for (index, (load, acts)) in [
        (&found.solar, true),
        (&found.albedo, planet_light),
        (&found.infrared, planet_light),
        (&found.thermal, effects.recoil),
    ]
    .into_iter()
    .enumerate()
    {
        if acts {
            rows.fixed_rows_mut::<3>(6 * index).copy_from(&load.force_body_n);
            rows.fixed_rows_mut::<3>(6 * index + 3).copy_from(&load.torque_body_n_m);
        }
    }
    rows
}

fn force_of(face: &FaceResult<f64>, effects: &RadiationSettings) -> Vector3<f64> {
    let [solar, albedo, infrared, thermal] = face.forces_body_n;
    let planet = if effects.planet_light { albedo + infrared } else { Vector3::zeros() };
    solar + planet + if effects.recoil { thermal } else { Vector3::zeros() }
}

/// Largest of the last two terms of force and torque, relative to the largest force and torque of all.
fn unresolved(series: &Segment<ROWS, NODES>, effects: &RadiationSettings) -> f64 {
    let terms = series.coefficients();
    // Sunlight comes from the closed form unless it is shadowed.
    let first = if effects.shadowing { 0 } else { 6 };
    let (mut scale, mut last) = ([0.0_f64; 2], [0.0_f64; 2]);
    for row in 0..ROWS {
        let kind = row / 3 % 2;
        scale[kind] = scale[kind].max(terms.row(row).amax());
        if row >= first {
            last[kind] = last[kind].max(terms[(row, NODES - 1)].abs()).max(terms[(row, NODES - 2)].abs());
        }
    }
    let [force, torque] = scale;
    let torque = torque.max(force * LEAST_ARM_M);
    if force > 0.0 { (last[0] / force).max(last[1] / torque) } else { last[0] }
}
