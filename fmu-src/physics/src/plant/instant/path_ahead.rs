//! The spacecraft's path ahead: motion, air and magnetic field as far as they are known.

use super::air_and_field_builder::AirAndFieldBuilder;
use super::air_and_field_segment::{AirAndField, AirAndFieldSegment};
use crate::numerics::Span;
use crate::plant::motion::kinematics::Kinematics;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::digest::Digest;
use crate::plant::settings::error::PlantError;

/// Motion of a spacecraft with air and field along it, from which sources are computed ahead.
pub(crate) struct PathAhead<'a> {
    /// Digest of the settings on which loads depend: a fit made for another one is cut.
    pub digest: Digest,
    /// Orbit and attitude.
    pub kinematics: Kinematics<'a>,
    /// Air and field along them.
    pub air_and_field: &'a mut AirAndFieldSegment,
}

impl PathAhead<'_> {
    /// Extends air and field over a span; returns up to where they are valid, at most to its end.
    ///
    /// # Errors
    /// Where a model does not reach; work.
    pub(crate) fn extend(&mut self, span: Span, orbit_has_moved: bool) -> Result<f64, PlantError> {
        let Configuration { air_and_field, figure, .. } = self.kinematics.configuration;
        let Some((settings, figure)) = air_and_field.zip(*figure) else { return Ok(span.end_s) };
        let mut builder =
            AirAndFieldBuilder { settings, figure, kinematics: &mut self.kinematics, orbit_has_moved };
        builder.extend(self.air_and_field, span)
    }

    /// Air and magnetic field at `time_s`, up to which they are known.
    pub(crate) fn air_and_field(&self, time_s: f64) -> AirAndField {
        self.air_and_field.at(self.kinematics.configuration.air_and_field.as_ref(), time_s)
    }
}
