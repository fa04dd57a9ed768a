//! Air and magnetic field over a segment of the orbit. They do not depend on the attitude, and a model of them costs more than
//! what they do to the spacecraft.
//!
//! Equation: logarithm of the density, temperature, molar mass, velocity of the air and field in EME2000 as functions of time.
//! Method: interpolation at [`NODES`] Chebyshev nodes, the segment shortened until its last terms are below the tolerance
//! ([`crate::numerics::adaptive`]); it ends where a model is not smooth.
//! Order: [`NODES`] in the length.
//! Error measure: the last two terms: of the logarithm of the density, and of temperature, molar mass, velocity and field relative
//! to the largest value in the segment.
//! Reference: see [`crate::numerics::adaptive`].

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::aerodynamics::AirFlow;
use crate::environment::atmosphere::Air;
use crate::math;
use crate::numerics::Span;
use crate::numerics::adaptive::SegmentSpan;
use crate::numerics::chebyshev::Segment;
use crate::plant::instant::at_time::Instant;
use crate::plant::settings::air_and_field_settings::{
    AirAndFieldSettings, AirSettings, AirSource, FieldSource, PlanetFigure,
};

/// Chebyshev nodes a segment.
pub(crate) const NODES: usize = 10;
/// Three functions of time.
pub(crate) type Series = Segment<3, NODES>;
/// No air is denser than the exponential of this, in kg/m3.
const LARGEST_LOGARITHM: f64 = 20.0;

/// Air and field at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AirAndField {
    /// Density, temperature and molar mass; all zero where there is no air.
    pub air: Air,
    /// Velocity of the air about the planet's centre, EME2000, in m/s.
    pub air_velocity_m_s: Vector3<f64>,
    /// Magnetic field, EME2000, in T.
    pub field_inertial_t: Vector3<f64>,
}

impl AirAndField {
    /// Velocity relative to the air, body frame, in m/s; `None` without a planet.
    pub(crate) fn velocity_body_m_s(&self, instant: &Instant) -> Option<Vector3<f64>> {
        let from_planet = instant.geometry.from_planet()?;
        Some(instant.to_body * (from_planet.velocity_m_s - self.air_velocity_m_s))
    }

    /// The air's flow about the spacecraft; `None` where there is no air.
    pub(crate) fn flow(&self, instant: &Instant) -> Option<AirFlow<f64>> {
        let velocity = self.velocity_body_m_s(instant).filter(|_| self.air.density_kg_m3 > 0.0);
        velocity.map(|velocity_body_m_s| AirFlow {
            density_kg_m3: self.air.density_kg_m3,
            temperature_k: self.air.temperature_k,
            molar_mass_kg_mol: self.air.molar_mass_kg_mol,
            velocity_body_m_s,
        })
    }
}

/// Air and field over one interval; what is given needs no series. The default stands before the first segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AirAndFieldSegment {
    pub(crate) span: SegmentSpan,
    /// Settings and planet that the fit was made for; with others it is void.
    pub(crate) made_for: Option<(AirAndFieldSettings, PlanetFigure)>,
    /// Position relative to the planet on which the segment was fitted, EME2000, in m; absent before the first segment.
    pub(crate) position: Option<Series>,
    /// Logarithm of the density in kg/m3, temperature in K, molar mass in kg/mol; absent where a model has no air.
    pub(crate) air: Option<Series>,
    /// Velocity of the air, EME2000, in m/s.
    pub(crate) air_velocity: Option<Series>,
    /// Field, EME2000, in T.
    pub(crate) field: Option<Series>,
}

impl AirAndFieldSegment {
    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        let Span { start_s, end_s } = self.span.span();
        let series = [&self.position, &self.air, &self.air_velocity, &self.field];
        let largest = |it: &Series| it.coefficients().row(0).iter().map(|c| c.abs()).sum::<f64>();
        self.span.is_valid()
            && series.into_iter().flatten().all(|it| it.is_valid() && it.spans(start_s, end_s))
            && self.air.as_ref().is_none_or(|it| largest(it) < 1e6)
    }

    /// Whether it reaches `time_s`, if there is one: decoded states of a simulation do, others may not.
    pub(crate) fn covers(&self, time_s: f64) -> bool {
        self.span.is_before() || self.span.covers(time_s)
    }

    /// Air and field at `time_s` by these settings; none without settings.
    pub(crate) fn at(&self, settings: Option<&AirAndFieldSettings>, time_s: f64) -> AirAndField {
        let Some(settings) = settings else { return AirAndField::default() };
        let vector =
            |series: &Option<Series>| series.as_ref().map_or(Vector3::zeros(), |it| it.value(time_s));
        AirAndField {
            air: settings.air.as_ref().map_or(Air::default(), |air| self.air_at(air, time_s)),
            air_velocity_m_s: vector(&self.air_velocity),
            field_inertial_t: match settings.field {
                Some(FieldSource::Given(field_inertial_t)) => field_inertial_t,
                _ => vector(&self.field),
            },
        }
    }

    fn air_at(&self, settings: &AirSettings, time_s: f64) -> Air {
        if let AirSource::Given(air) = settings.source {
            return air;
        }
        let Some(series) = &self.air else { return Air::default() };
        let values = series.value(time_s);
        Air {
            density_kg_m3: math::exp(values[0].min(LARGEST_LOGARITHM)) * settings.density_factor,
            temperature_k: values[1],
            molar_mass_kg_mol: values[2],
        }
    }
}
