//! Builds segments of air and magnetic field along the orbit.

use nalgebra::{SVector, Vector3};

use super::air_and_field_segment::{AirAndFieldSegment, NODES, Series};
use crate::environment::CartesianState;
use crate::environment::atmosphere::{Air, BREAKS};
use crate::environment::orientation::Equator;
use crate::environment::utc::next_midnight_s;
use crate::math;
use crate::momentum::{WorkKind, after_event_s};
use crate::numerics::Span;
use crate::numerics::adaptive::{AdaptiveInterval, Attempt};
use crate::numerics::events::first_event;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::settings::air_and_field_settings::{
    AirAndFieldSettings, AirSource, FieldSource, PlanetFigure,
};
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;

/// Longest segment, in s.
const LONGEST_S: f64 = 3600.0;
/// No segment is shortened below this, in s.
const SHORTEST_S: f64 = 1.0;
/// Units of work of a node, by what is computed there.
const AIR_UNITS: u32 = 15;
const FIELD_UNITS: u32 = 3;

/// Least scale height of the air, in m: the fit is valid within `atmosphere.tolerance` times this of the orbit on which it was made.
const SCALE_HEIGHT_M: f64 = 5e3;
/// Least horizontal scale of air and field, in m, likewise.
const SCALE_M: f64 = 5e5;

/// Fitted quantities: position, air, its velocity, field.
#[derive(Clone, Copy)]
struct Node {
    position_m: Vector3<f64>,
    air: Vector3<f64>,
    air_velocity_m_s: Vector3<f64>,
    field_t: Vector3<f64>,
}

/// Extends air and field over a span, on an orbit that may have moved since it was fitted; returns up to where they are valid, at most to
/// its end.
///
/// # Errors
/// Where a model does not reach; work.
pub(crate) fn extend(
    kinematics: &mut Kinematics<'_>,
    span: Span,
    orbit_has_moved: bool,
) -> Result<f64, PlantError> {
    let Configuration { air_and_field, figure, .. } = kinematics.configuration;
    let Some((settings, figure)) = air_and_field.zip(*figure) else { return Ok(span.end_s) };
    let AirAndFieldSegment { span: fitted, made_for, .. } = &*kinematics.air_and_field;
    let is_made = fitted.contains(span.start_s) && *made_for == Some((settings, figure));
    let mut builder = AirAndFieldBuilder { settings, figure, kinematics };
    if !is_made || (orbit_has_moved && builder.orbit_differs(span.end_s)) {
        builder.build(span)?;
    }
    Ok(builder.kinematics.air_and_field.span.end_s.min(span.end_s))
}

/// Builds the segments of a flight about a planet of this figure.
struct AirAndFieldBuilder<'r, 'a> {
    settings: AirAndFieldSettings,
    figure: PlanetFigure,
    kinematics: &'r mut Kinematics<'a>,
}

impl AirAndFieldBuilder<'_, '_> {
    /// Whether the orbit, valid up to `limit_s`, differs from the one on which the segment was fitted.
    fn orbit_differs(&mut self, limit_s: f64) -> bool {
        let AirAndFieldSegment { span, position, .. } = &*self.kinematics.air_and_field;
        let last_s = span.end_s.min(limit_s);
        let Some(fitted_m) = position.as_ref().map(|it| it.value(last_s)) else { return true };
        let position_m = self.kinematics.about_planet(last_s).position_m;
        let off_m = position_m - fitted_m;
        let radial_m = off_m.dot(&position_m) / position_m.norm();
        let tolerance = self.settings.tolerance;
        radial_m.abs() > tolerance * SCALE_HEIGHT_M || off_m.norm() > tolerance * SCALE_M
    }

    fn build(&mut self, Span { start_s, end_s: limit_s }: Span) -> Result<(), PlantError> {
        let longest_s = self.kinematics.air_and_field.span.next_longest_s.min(LONGEST_S);
        let mut interval = AdaptiveInterval::new(start_s, f64::INFINITY, longest_s, limit_s, SHORTEST_S);
        // Within a segment the equator moves by 1e-3 arcsec.
        let equator =
            self.figure.orientation.equator(start_s + self.kinematics.configuration.epoch_minus_time_s);
        interval.end_at(self.smooth_until(&equator, start_s, interval.end_s()));
        let (series, span) = interval.fit(NODES, |interval| {
            self.spend(start_s)?;
            Ok(match self.fit(&equator, Span::new(start_s, interval.end_s())) {
                Ok((fit, unresolved)) => {
                    Attempt::Fitted { fit, unresolved, tolerance: self.settings.tolerance }
                }
                // The simulation may end before the spacecraft leaves the model's range.
                Err(error) => Attempt::Undefined(error),
            })
        })?;
        let made_for = Some((self.settings, self.figure));
        *self.kinematics.air_and_field = AirAndFieldSegment { span, made_for, ..series };
        Ok(())
    }

    fn spend(&mut self, start_s: f64) -> Result<(), PlantError> {
        let AirAndFieldSettings { field, .. } = &self.settings;
        let by_model = self.settings.atmosphere().is_some();
        let units = u32::from(by_model) * AIR_UNITS + u32::from(field.is_some()) * FIELD_UNITS;
        self.kinematics.spend_units(WorkKind::Air, NODES as u32 * (units + 1), start_s)
    }

    /// The latest time up to `limit_s` until which the model of the air is smooth from `start_s` on: midnight, and the heights at
    /// which its form changes.
    fn smooth_until(&mut self, equator: &Equator, start_s: f64, limit_s: f64) -> f64 {
        let Some(model) = self.settings.atmosphere() else { return limit_s };
        let epoch_minus_time_s = self.kinematics.configuration.epoch_minus_time_s;
        let after_s = after_event_s(start_s).min(limit_s);
        let mut limit_s = limit_s;
        if model.changes_at_midnight() {
            let midnight_s = next_midnight_s(after_s + epoch_minus_time_s) - epoch_minus_time_s;
            limit_s = limit_s.min(midnight_s.max(after_s.next_up()));
        }
        let breaks_m = model.breaks_m();
        let rounding_s = self.kinematics.time_rounding_s(limit_s);
        let mut over = |at_s: f64| {
            let position_m = self.kinematics.about_planet(at_s).position_m;
            let position_fixed_m = equator.fixed_from_eme2000_after(at_s - start_s) * position_m;
            let height_m = self.figure.ellipsoid.geodetic(&position_fixed_m).height_m;
            SVector::<f64, BREAKS>::from(breaks_m.map(|edge_m| height_m - edge_m))
        };
        let samples = Series::nodes(start_s, limit_s).map(&mut over);
        first_event([after_s, start_s, limit_s], rounding_s, &samples, over).unwrap_or(limit_s)
    }

    /// The series over an interval, and their greatest last term relative to the tolerance's measure.
    fn fit(&mut self, equator: &Equator, span: Span) -> Result<(AirAndFieldSegment, f64), PlantError> {
        let Span { start_s, end_s } = span;
        let [position_m, air, air_velocity_m_s, field_t] = [Vector3::zeros(); 4];
        let mut nodes = [Node { position_m, air, air_velocity_m_s, field_t }; NODES];
        let mut has_air = true;
        for (node, at_s) in nodes.iter_mut().zip(Series::nodes(start_s, end_s)) {
            *node = self.node(equator, at_s - start_s, at_s)?;
            has_air &= node.air[0].is_finite();
        }
        let series = |of: fn(&Node) -> Vector3<f64>| {
            Series::from_samples(start_s, end_s, &nodes.map(|node| of(&node)))
        };
        let AirAndFieldSettings { air, field, .. } = &self.settings;
        let by_model = self.settings.atmosphere().is_some();
        let fitted = AirAndFieldSegment {
            position: Some(series(|node| node.position_m)),
            air: (by_model && has_air).then(|| series(|node| node.air)),
            air_velocity: air.is_some().then(|| series(|node| node.air_velocity_m_s)),
            field: matches!(field, Some(FieldSource::Model(_))).then(|| series(|node| node.field_t)),
            ..AirAndFieldSegment::default()
        };
        let of_air = fitted.air.as_ref().map_or(0.0, |it| {
            let last = last_terms(it);
            let mean = it.coefficients().column(0).abs();
            last[0].max(last[1] / mean[1]).max(last[2] / mean[2])
        });
        let of_vector = |series: &Option<Series>, of: fn(&Node) -> Vector3<f64>| {
            let largest = nodes.iter().map(|node| of(node).amax()).fold(0.0, f64::max);
            series.as_ref().filter(|_| largest > 0.0).map_or(0.0, |it| last_terms(it).amax() / largest)
        };
        let of_velocity = of_vector(&fitted.air_velocity, |node| node.air_velocity_m_s);
        let of_field = of_vector(&fitted.field, |node| node.field_t);
        Ok((fitted, of_air.max(of_velocity).max(of_field)))
    }

    fn node(&mut self, equator: &Equator, elapsed_s: f64, time_s: f64) -> Result<Node, PlantError> {
        let epoch_s = time_s + self.kinematics.configuration.epoch_minus_time_s;
        let CartesianState { position_m, .. } = self.kinematics.about_planet(time_s);
        let fixed_from_inertial = equator.fixed_from_eme2000_after(elapsed_s);
        let position_fixed_m = fixed_from_inertial * position_m;
        let (mut air, mut air_velocity_m_s) = (Vector3::zeros(), Vector3::zeros());
        if let Some(settings) = &self.settings.air {
            let geodetic = self.figure.ellipsoid.geodetic(&position_fixed_m);
            if let AirSource::Model(model) = &settings.source {
                let found = model.air_at(epoch_s, &geodetic, &settings.weather);
                let Air { density_kg_m3, temperature_k, molar_mass_kg_mol } =
                    found.map_err(|source| PlantError::Air { time_s, source })?;
                let logarithm = if density_kg_m3 > 0.0 { math::ln(density_kg_m3) } else { f64::NEG_INFINITY };
                air = Vector3::new(logarithm, temperature_k, molar_mass_kg_mol);
            }
            air_velocity_m_s = equator.rotation_rad_s_eme2000().cross(&position_m);
            if settings.wind_m_s != Vector3::zeros() {
                air_velocity_m_s +=
                    fixed_from_inertial.inverse() * (geodetic.east_north_up() * settings.wind_m_s);
            }
        }
        let field_t = match &self.settings.field {
            Some(FieldSource::Model(model)) => {
                let found = model.field_fixed_t(epoch_s, &position_fixed_m);
                fixed_from_inertial.inverse()
                    * found.map_err(|source| PlantError::Field { time_s, source })?
            }
            _ => Vector3::zeros(),
        };
        Ok(Node { position_m, air, air_velocity_m_s, field_t })
    }
}

/// Greatest magnitude among the last two terms of each row.
fn last_terms(series: &Series) -> Vector3<f64> {
    let terms = series.coefficients();
    terms.column(NODES - 1).abs().sup(&terms.column(NODES - 2).abs())
}
