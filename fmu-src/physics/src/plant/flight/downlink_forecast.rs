//! Forecast where a downlink begins, or science that unloads: Sun and Earth, torque by the Sun's direction, and momentum ahead.
//!
//! A forecast is a fork of the flight in default attitudes (the Sun on -Y in downlinks and in science that unloads), without
//! dumps, what is applied from outside being held.

use nalgebra::Vector3;

use super::configured::ConfiguredFlight;
use super::fork::{ForecastMomentum, Fork};
use crate::guidance::{Guided, ScienceArc, SelectedSunDirection, SelectedSunDirections};
use crate::loads::ForceTorque;
use crate::momentum::{Convention, Totals};
use crate::plant::events::Eventful;
use crate::plant::settings::attitude_source::AttitudeSource;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::plant::sources::sunlight::sunlit::SunlitConfiguration;

/// Momentum where a downlink begins, in N m s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartMomentum {
    /// EME2000; it stays there while the body turns.
    Inertial(Vector3<f64>),
    /// Body components, whatever the attitude: the integral of each component of torque, or a start that is given in them.
    Body(Vector3<f64>),
}

impl StartMomentum {
    /// Momentum from which a choice of attitude counts, from totals under a convention.
    pub fn from_totals(totals: &Totals, convention: Convention) -> Self {
        match convention {
            Convention::Inertial => Self::Inertial(totals.momentum_inertial_n_m_s),
            Convention::BodyIntegral => Self::Body(totals.torque_integral_body_n_m_s),
        }
    }

    /// Magnitude, in N m s.
    pub fn magnitude_n_m_s(&self) -> f64 {
        match self {
            Self::Inertial(momentum) | Self::Body(momentum) => momentum.norm(),
        }
    }
}

/// Chooses the Sun's place, and tells whether limits keep the momentum from its target; no place where the default attitude is to be
/// simulated. Called once a downlink or science that unloads, and again after a dump at its very beginning.
pub type SunPlanner<'a> =
    dyn Fn(&mut DownlinkForecast<'_, '_>) -> Result<Option<SelectedSunDirection>, PlantError> + 'a;

/// Start of a downlink, or of science that unloads, from which it is forecast.
pub struct DownlinkForecast<'o, 'f> {
    pub(super) flight: &'o mut ConfiguredFlight<'f>,
    pub(crate) law: Guided,
    pub(crate) totals: Totals,
    pub(crate) forecasts: bool,
    /// When, in s.
    pub time_s: f64,
    /// How long it lasts, in s.
    pub span_s: f64,
    /// Momentum here.
    pub momentum: StartMomentum,
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Vector3<f64>,
    /// Unit vector to the Earth, EME2000; `None` where its place is not known.
    pub to_earth: Option<Vector3<f64>>,
    /// Distance from the Sun's centre, in m.
    pub sun_distance_m: f64,
    /// Pressure of sunlight, in Pa, without a shadow.
    pub pressure_pa: f64,
    /// Least and greatest angle between Sun and Earth while the downlink lasts, in rad.
    pub separations_rad: [f64; 2],
    /// The science that begins; `None`: a downlink does.
    pub science: Option<ScienceArc>,
}

impl DownlinkForecast<'_, '_> {
    /// The spacecraft in direct sunlight without shadows.
    pub(crate) fn sunlit(&self) -> SunlitConfiguration<'_> {
        let prepared = &self.flight.given.prepared;
        SunlitConfiguration {
            solar: self.flight.models.solar.as_ref().unwrap_or(prepared.solar),
            panels: prepared.panels,
            settings: &self.flight.configuration.panels,
            current_mass_panels_stowed: *self.flight.current_mass_panels_stowed,
            time_s: self.time_s,
            sun_distance_m: self.sun_distance_m,
        }
    }

    /// Settings of the flight.
    pub(crate) fn configuration(&self) -> &Configuration {
        self.flight.configuration
    }

    /// Momentum from here on at `times_s`, which do not descend; about `step_s` apart.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn forecast(
        &mut self,
        mut times_s: impl Iterator<Item = f64>,
        step_s: f64,
        mut visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), PlantError> {
        let attitude = AttitudeSource::Guided(Guided { managed: false, ..self.law });
        let [applied, _] = (self.flight.given.external)(self.time_s);
        let held = |_: f64| [applied, ForceTorque::zero()];
        let mut fork = Fork::new(self.flight, &held, attitude, self.totals, self.time_s)?;
        // No direction of the Sun was selected.
        fork.ideal.flight.propagator.sun_choice.selected = SelectedSunDirections::default();
        fork.coarsen(self.time_s, step_s);
        times_s.try_for_each(|at_s| {
            fork.ideal.advance(at_s)?;
            visit(fork.momentum_at(at_s));
            Ok(())
        })
    }
}
