//! Light and heat of the plant: its radiation segments, built as the flight reaches them, and reports by face.

use nalgebra::{SVector, Vector3};

use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::loads::{ByEffect, Effect, ForceTorque};
use crate::numerics::Span;
use crate::numerics::adaptive::{AdaptiveInterval, Attempt};
use crate::numerics::chebyshev::Segment;
use crate::radiation::disturbance::PlanetGeometry;
use crate::refusal::Refusal;

use super::radiation_node::RadiationNode;
use super::radiation_segment::{HOTTEST_K, LoadSeries, NODES, RadiationSegment};
use super::radiation_solver::RadiationSolver;
use crate::momentum::WorkKind;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;

/// No segment is shortened below this, in s: kinks where a face turns dark end here.
const SHORTEST_S: f64 = 1.0;
/// Torque is resolved as if the largest force had at least this arm, in m: on a symmetric body there is none.
pub(crate) const LEAST_ARM_M: f64 = 0.01;
/// By how much the body turns within a segment at most, in rad: its nodes see every side of it.
const LONGEST_TURN_RAD: f64 = 3.0;
/// A segment in which the body turns by more, in rad, may be shorter than [`SHORTEST_S`].
const SHORTEST_TURN_RAD: f64 = 0.1;

/// Builds the radiation segments of a flight with its solver along a path.
pub(crate) struct RadiationBuilder<'r, 'a> {
    pub solver: &'r mut RadiationSolver,
    pub path: &'r mut Kinematics<'a>,
}

/// Turns everything at `time_s` into the body frame for `node`, whose light falls on these panels.
fn view(kinematics: &mut Kinematics<'_>, time_s: f64, light_panels: &[usize], node: &mut RadiationNode) {
    let configuration = kinematics.configuration;
    let instant = kinematics.instant(time_s);
    let sun = instant.sun();
    let viewing = &mut node.viewing;
    viewing.sun_direction_body = instant.sun_body;
    let flux_w_m2 = |distance_m: f64| configuration.light.source.pressure_pa(distance_m) * SPEED_OF_LIGHT_M_S;
    viewing.sun_sine = configuration.shadow.sun_radius_m() / instant.sun_distance_m;
    viewing.sun_flux_w_m2 = flux_w_m2(instant.sun_distance_m);
    // Segments are those of the light, whatever its factor; who reads them scales.
    viewing.solar_scale = 1.0;
    // Inside the planet there is no fraction; what is wrong there is the place.
    viewing.lit_fraction = if instant.lit_fraction.is_nan() { 0.0 } else { instant.lit_fraction };
    viewing.center_of_mass_body_m = kinematics.mass_properties(&sun).center_of_mass_body_m;
    viewing.planet = instant.planet_body_m.map(|position_body_m| {
        let sun_from_planet_body_m = instant.sun_position_body_m() - position_body_m;
        let sun_flux_w_m2 = flux_w_m2(sun_from_planet_body_m.norm());
        PlanetGeometry { position_body_m, sun_from_planet_body_m, sun_flux_w_m2, pole_body: None }
    });
    let panels = kinematics.spacecraft.panels;
    configuration.panel_angles_rad(panels, light_panels, &sun, &mut node.panel_angles_rad);
}

impl RadiationBuilder<'_, '_> {
    /// Makes sure that light and heat are known from the start of a span on, and tells up to where, at most to its end.
    pub(crate) fn extend(&mut self, segment: &mut RadiationSegment, span: Span) -> Result<f64, PlantError> {
        if segment.made_for != self.path.digest {
            segment.cut(span.start_s);
        }
        if segment.span.contains(span.start_s) {
            return Ok(segment.span.end_s.min(span.end_s));
        }
        self.build(segment, span)?;
        Ok(segment.span.end_s)
    }

    /// Builds the segment that begins with a span. It ends at the next multiple of the grid or sooner: with the span, where
    /// the branch changes, or where the last Chebyshev terms would exceed the tolerance.
    fn build(&mut self, segment: &mut RadiationSegment, span: Span) -> Result<(), PlantError> {
        let Span { start_s, end_s: limit_s } = span;
        let effects = self.path.configuration.light_and_heat;
        let stores = self.stores_heat();
        if stores {
            self.store_heat(segment, start_s)?;
        } else {
            segment.end_k.clear();
        }
        // Written so that a NaN from restored bytes is the shortest.
        let rate_rad_s = self.path.instant(start_s).law.frame.rate_body_rad_s.norm();
        let shortest_s = SHORTEST_S.min(SHORTEST_TURN_RAD / rate_rad_s);
        let longest_s = segment.span.next_longest_s.min(LONGEST_TURN_RAD / rate_rad_s).max(shortest_s);
        let mut interval = AdaptiveInterval::new(start_s, effects.grid_s, longest_s, limit_s, shortest_s);
        interval.end_at(self.path.smooth_until(start_s, interval.end_s()));
        let (series, span) = interval.fit(NODES, |interval| {
            let units = self.solver.segment_units(stores);
            self.path.spend_units(WorkKind::Light, units, start_s)?;
            let lit = self.light_between(stores, &segment.end_k, Span::new(start_s, interval.end_s()));
            let shadows: usize = self.solver.nodes.iter().map(|node| node.workspace.shadows_cut()).sum();
            let shadow_units = u32::try_from(shadows).unwrap_or(u32::MAX);
            self.path.spend_units(WorkKind::Light, shadow_units, start_s)?;
            Ok(match lit {
                Ok(fit) => {
                    let unresolved = unresolved(&fit, effects.shadowing);
                    Attempt::Fitted { fit, unresolved, tolerance: effects.tolerance }
                }
                // The flight may be over before it comes to where light has no meaning.
                Err(error) => Attempt::Undefined(no_light(self.path, start_s, error)),
            })
        })?;
        (segment.span, segment.made_for, segment.loads) = (span, self.path.digest, series);
        segment.temperatures_k.clear();
        if stores || self.needs_wall_temperatures() {
            let RadiationSolver { model, nodes, .. } = &*self.solver;
            segment.temperatures_k.extend((0..model.face_count()).map(|face| {
                let samples = core::array::from_fn(|j| SVector::from([nodes[j].temperatures_k[face]]));
                Segment::from_samples(start_s, span.end_s, &samples)
            }));
        }
        if stores {
            segment.end_k.copy_from_slice(&self.solver.heat_rule.temperatures_k);
        }
        Ok(())
    }

    /// The heat stored at `start_s`: that at the end of the segment before, at the start of a flight that of balance.
    fn store_heat(&mut self, segment: &mut RadiationSegment, start_s: f64) -> Result<(), PlantError> {
        if segment.span.is_before() && segment.end_k.is_empty() {
            self.balance(start_s, 1.0)?;
            let faces = self.solver.nodes[0].workspace.faces();
            segment.end_k.extend(faces.iter().map(|face| face.temperature_k));
        }
        let (found, allowed) = (segment.end_k.len(), self.solver.model.face_count());
        if found != allowed {
            return Err(PlantError::Temperatures { found, allowed });
        }
        match segment.end_k.iter().find(|kelvin| !(0.0..=HOTTEST_K).contains(*kelvin)) {
            Some(&found_k) => Err(PlantError::Temperature { found_k }),
            None => Ok(()),
        }
    }

    /// Light and heat over a span.
    fn light_between(
        &mut self,
        stores: bool,
        start_k: &[f64],
        span: Span,
    ) -> Result<ByEffect<Option<LoadSeries>>, Refusal> {
        let needs_wall_temperatures = self.needs_wall_temperatures();
        let RadiationSolver { model, panels, nodes, heat_rule } = &mut *self.solver;
        let Span { start_s, end_s } = span;
        for (node, time_s) in nodes.iter_mut().zip(LoadSeries::nodes(start_s, end_s)) {
            view(self.path, time_s, panels, node);
            node.balance(model)?;
        }
        if stores {
            heat_rule.integrate(model, nodes, start_k, span.length_s());
            for node in nodes.iter_mut() {
                node.radiate_stored(model)?;
            }
        } else if needs_wall_temperatures {
            nodes.iter_mut().for_each(RadiationNode::store_balance);
        }
        let mut series = ByEffect::default();
        for effect in self.path.configuration.effects.light() {
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
        segment: Option<&RadiationSegment>,
        time_s: f64,
        mut report: impl FnMut(f64, Vector3<f64>),
    ) -> Result<(), PlantError> {
        let Configuration { light, effects, .. } = self.path.configuration;
        self.balance(time_s, light.scale)?;
        let stores = self.stores_heat();
        let RadiationSolver { model, nodes, .. } = &mut *self.solver;
        if let Some(segment) = segment.filter(|_| stores) {
            segment.temperatures_at(time_s, &mut nodes[0].temperatures_k);
            nodes[0].radiate_stored(model).map_err(|error| no_light(self.path, time_s, error))?;
        }
        for face in nodes[0].workspace.faces() {
            report(face.temperature_k, face.force_body_n(*effects));
        }
        Ok(())
    }

    /// Light and heat at one time in the first of the nodes, every surface in balance; `solar_scale` is the factor of sunlight's force.
    fn balance(&mut self, time_s: f64, solar_scale: f64) -> Result<(), PlantError> {
        let RadiationSolver { model, panels, nodes, .. } = &mut *self.solver;
        view(self.path, time_s, panels, &mut nodes[0]);
        nodes[0].viewing.solar_scale = solar_scale;
        nodes[0].balance(model).map_err(|error| no_light(self.path, time_s, error))
    }

    /// Whether surfaces store heat.
    fn stores_heat(&self) -> bool {
        let Configuration { light_and_heat, effects, .. } = self.path.configuration;
        light_and_heat.storage && effects.has(Effect::Thermal) && self.solver.model.stores_heat()
    }

    /// Whether air meets the surfaces at the temperatures that light gives them.
    fn needs_wall_temperatures(&self) -> bool {
        let effects = self.path.configuration.effects;
        effects.has(Effect::Aerodynamic) && effects.has(Effect::Thermal)
    }
}

fn no_light(kinematics: &Kinematics<'_>, time_s: f64, source: Refusal) -> PlantError {
    let Kinematics { configuration, trajectory, .. } = kinematics;
    let position_m = trajectory.state_at(configuration, time_s).position_m.into();
    PlantError::Light { time_s, position_m, source }
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
