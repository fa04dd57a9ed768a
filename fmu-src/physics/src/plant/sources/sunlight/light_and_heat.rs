//! Light and heat of the plant: its radiation segments, built as the flight reaches them, and reports by face.

use nalgebra::{SVector, Vector3};

use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::loads::{ByEffect, Effect, ForceTorque};
use crate::numerics::adaptive::{AdaptiveInterval, Attempt};
use crate::numerics::chebyshev::Segment;
use crate::radiation::disturbance::PlanetGeometry;
use crate::refusal::Refusal;
use crate::spacecraft::Panel;

use super::radiation_node::RadiationNode;
use super::radiation_segment::{HOTTEST_K, LoadSeries, NODES, RadiationSegment};
use super::radiation_solver::RadiationSolver;
use crate::momentum::WorkKind;
use crate::plant::instant::path_ahead::PathAhead;
use crate::plant::motion::kinematics::Kinematics;
use crate::plant::settings::digest::Digest;
use crate::plant::settings::error::PlantError;

/// No segment is shortened below this, in s: kinks where a face turns dark end here.
const SHORTEST_S: f64 = 1.0;
/// Torque is resolved as if the largest force had at least this arm, in m: on a symmetric body there is none.
pub(crate) const LEAST_ARM_M: f64 = 0.01;
/// By how much the body turns within a segment at most, in rad: its nodes see every side of it.
const LONGEST_TURN_RAD: f64 = 3.0;
/// A segment in which the body turns by more, in rad, may be shorter than [`SHORTEST_S`].
const SHORTEST_TURN_RAD: f64 = 0.1;

/// Builds the radiation segments of a flight whose spacecraft has these panels.
pub(crate) struct RadiationBuilder<'r, 'a> {
    panels: &'a [Panel],
    digest: Digest,
    kinematics: &'r mut Kinematics<'a>,
}

impl<'r, 'a> RadiationBuilder<'r, 'a> {
    /// Builder of segments along a path.
    pub(crate) fn along(path: &'r mut PathAhead<'_, 'a>) -> Self {
        Self { panels: path.spacecraft.panels, digest: path.digest, kinematics: &mut *path.kinematics }
    }

    /// Turns everything at `time_s` into the body frame for `node`.
    fn view(&mut self, time_s: f64, light_panels: &[usize], node: &mut RadiationNode) {
        let configuration = self.kinematics.configuration;
        let instant = self.kinematics.instant(time_s);
        let viewing = &mut node.viewing;
        viewing.sun_direction_body = instant.sun_body;
        let light = &configuration.light;
        let flux_w_m2 = |distance_m: f64| light.source.pressure_pa(distance_m) * SPEED_OF_LIGHT_M_S;
        viewing.sun_sine = configuration.shadow.sun_radius_m() / instant.sun_distance_m;
        viewing.sun_flux_w_m2 = flux_w_m2(instant.sun_distance_m);
        // Segments are those of the light, whatever its factor; who reads them scales.
        viewing.solar_scale = 1.0;
        // Inside the planet there is no fraction; what is wrong there is the place.
        viewing.lit_fraction = if instant.lit_fraction.is_nan() { 0.0 } else { instant.lit_fraction };
        viewing.center_of_mass_body_m =
            self.kinematics.mass_properties(self.panels, &instant.sun_at(time_s)).center_of_mass_body_m;
        viewing.planet = instant.planet_body_m.map(|position_body_m| {
            let sun_from_planet_body_m = instant.sun_position_body_m() - position_body_m;
            let sun_flux_w_m2 = flux_w_m2(sun_from_planet_body_m.norm());
            PlanetGeometry {
                position_body_m,
                sun_from_planet_body_m,
                sun_flux_w_m2,
                pole_body: -Vector3::z(),
            }
        });
        let angles_rad = &mut node.panel_angles_rad;
        configuration.panel_angles_rad(self.panels, light_panels, &instant.sun_at(time_s), angles_rad);
    }

    /// Makes sure that light and heat are known from `start_s` on, and tells up to where, at most `limit_s`.
    pub(crate) fn extend(
        &mut self,
        light: &mut RadiationSolver,
        segment: &mut Option<RadiationSegment>,
        start_s: f64,
        limit_s: f64,
    ) -> Result<f64, PlantError> {
        let segment = segment.get_or_insert_default();
        if segment.made_for != self.digest {
            segment.cut(start_s);
        }
        if segment.span.contains(start_s) {
            return Ok(segment.span.end_s.min(limit_s));
        }
        self.build(light, segment, start_s, limit_s)?;
        Ok(segment.span.end_s)
    }

    /// Builds the segment that begins at `start_s`. It ends at the next multiple of the grid or sooner: at `limit_s`, where
    /// the branch changes, or where the last Chebyshev terms would exceed the tolerance.
    fn build(
        &mut self,
        light: &mut RadiationSolver,
        segment: &mut RadiationSegment,
        start_s: f64,
        limit_s: f64,
    ) -> Result<(), PlantError> {
        let effects = self.kinematics.configuration.light_and_heat;
        let stores = self.stores_heat(light);
        if stores {
            self.store_heat(light, segment, start_s)?;
        } else {
            segment.end_k.clear();
        }
        // Written so that a NaN from restored bytes is the shortest.
        let rate_rad_s = self.kinematics.instant(start_s).frame.rate_body_rad_s.norm();
        let shortest_s = SHORTEST_S.min(SHORTEST_TURN_RAD / rate_rad_s);
        let longest_s = segment.span.next_longest_s.min(LONGEST_TURN_RAD / rate_rad_s).max(shortest_s);
        let mut interval = AdaptiveInterval::new(start_s, effects.grid_s, longest_s, limit_s, shortest_s);
        interval.end_at(self.kinematics.smooth_until(start_s, interval.end_s()));
        let (series, span) = interval.fit(NODES, |interval| {
            self.kinematics.spend_units(WorkKind::Light, light.segment_units(stores), start_s)?;
            let lit = self.light_between(light, stores, &segment.end_k, start_s, interval.end_s());
            let shadows: usize = light.nodes.iter().map(|node| node.workspace.shadows_cut()).sum();
            let shadow_units = u32::try_from(shadows).unwrap_or(u32::MAX);
            self.kinematics.spend_units(WorkKind::Light, shadow_units, start_s)?;
            Ok(match lit {
                Ok(fit) => {
                    let unresolved = unresolved(&fit, effects.shadowing);
                    Attempt::Fitted { fit, unresolved, tolerance: effects.tolerance }
                }
                // The flight may be over before it comes to where light has no meaning.
                Err(error) => Attempt::Undefined(self.no_light(start_s, error)),
            })
        })?;
        (segment.span, segment.made_for, segment.loads) = (span, self.digest, series);
        segment.temperatures_k.clear();
        if stores || self.needs_wall_temperatures() {
            segment.temperatures_k.extend((0..light.face_count()).map(|face| {
                let samples = core::array::from_fn(|j| SVector::from([light.nodes[j].temperatures_k[face]]));
                Segment::from_samples(start_s, span.end_s, &samples)
            }));
        }
        if stores {
            segment.end_k.copy_from_slice(light.heat_rule.end_k());
        }
        Ok(())
    }

    /// The heat stored at `start_s`: that at the end of the segment before, at the start of a flight that of balance.
    fn store_heat(
        &mut self,
        light: &mut RadiationSolver,
        segment: &mut RadiationSegment,
        start_s: f64,
    ) -> Result<(), PlantError> {
        if segment.span.is_before() && segment.end_k.is_empty() {
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
    ) -> Result<ByEffect<Option<LoadSeries>>, Refusal> {
        let RadiationSolver { model, panels, nodes, heat_rule } = light;
        let times_s = LoadSeries::nodes(start_s, end_s);
        for (node, time_s) in nodes.iter_mut().zip(times_s) {
            self.view(time_s, panels, node);
            node.balance(model)?;
        }
        if stores {
            heat_rule.integrate(model, nodes, start_k, end_s - start_s);
            for node in nodes.iter_mut() {
                node.radiate_stored(model)?;
            }
        } else if self.needs_wall_temperatures() {
            nodes.iter_mut().for_each(RadiationNode::store_balance);
        }
        let mut series = ByEffect::default();
        for effect in self.kinematics.configuration.effects.light() {
            let sample = |j: usize| {
                let ForceTorque { force_body_n, torque_body_n_m } = &nodes[j].found[effect];
                SVector::from_iterator(force_body_n.iter().chain(torque_body_n_m).copied())
            };
            series[effect] = Some(LoadSeries::from_samples(start_s, end_s, &core::array::from_fn(sample)));
        }
        Ok(series)
    }

    /// Reports temperature in K and force in N, body frame, of every face of the light model at `time_s`, in its order; the
    /// force of the effects that act.
    ///
    /// # Errors
    /// A geometry without meaning.
    pub(crate) fn faces(
        &mut self,
        light: &mut RadiationSolver,
        segment: Option<&RadiationSegment>,
        time_s: f64,
        mut report: impl FnMut(f64, Vector3<f64>),
    ) -> Result<(), PlantError> {
        self.light_at(light, segment, time_s)?;
        if let Some(node) = light.nodes.first() {
            for face in node.workspace.faces() {
                report(face.temperature_k, face.force_body_n(self.kinematics.configuration.effects));
            }
        }
        Ok(())
    }

    /// Light and heat at one time, in the first of the nodes.
    fn light_at(
        &mut self,
        light: &mut RadiationSolver,
        segment: Option<&RadiationSegment>,
        time_s: f64,
    ) -> Result<(), PlantError> {
        let stores = self.stores_heat(light);
        let RadiationSolver { model, panels, nodes, .. } = light;
        let Some(node) = nodes.first_mut() else { return Ok(()) };
        self.view(time_s, panels, node);
        node.viewing.solar_scale = self.kinematics.configuration.light.scale;
        node.balance(model).map_err(|error| self.no_light(time_s, error))?;
        if let Some(segment) = segment.filter(|_| stores) {
            segment.temperatures_at(time_s, &mut node.temperatures_k);
            node.radiate_stored(model).map_err(|error| self.no_light(time_s, error))?;
        }
        Ok(())
    }

    /// Whether surfaces store heat.
    fn stores_heat(&self, light: &RadiationSolver) -> bool {
        let configuration = self.kinematics.configuration;
        let acts = configuration.light_and_heat.storage && configuration.effects.has(Effect::Thermal);
        acts && light.model.stores_heat()
    }

    /// Whether air meets the surfaces at the temperatures that light gives them.
    fn needs_wall_temperatures(&self) -> bool {
        let effects = self.kinematics.configuration.effects;
        effects.has(Effect::Aerodynamic) && effects.has(Effect::Thermal)
    }

    fn no_light(&self, time_s: f64, source: Refusal) -> PlantError {
        let Kinematics { configuration, trajectory, .. } = &*self.kinematics;
        let position_m = trajectory.state_at(configuration, time_s).position_m.into();
        PlantError::Light { time_s, position_m, source }
    }
}

/// Largest of the last two terms of force and torque, relative to the largest force and torque of all; sunlight that nothing
/// shadows counts as a measure only, for it comes from the closed form.
fn unresolved(series: &ByEffect<Option<LoadSeries>>, shadowing: bool) -> f64 {
    let (mut scale, mut last) = ([0.0_f64; 2], [0.0_f64; 2]);
    for (effect, series) in series.present() {
        let terms = series.coefficients();
        for row in 0..6 {
            let kind = row / 3;
            scale[kind] = scale[kind].max(terms.row(row).amax());
            if shadowing || effect != Effect::Solar {
                last[kind] = last[kind].max(terms[(row, NODES - 1)].abs()).max(terms[(row, NODES - 2)].abs());
            }
        }
    }
    let [force, torque] = scale;
    let torque = torque.max(force * LEAST_ARM_M);
    if force > 0.0 { (last[0] / force).max(last[1] / torque) } else { last[0] }
}
