//! What can be known where a downlink begins, or science that unloads: Sun and Earth, torque by the Sun's place, and momentum ahead.
//!
//! A forecast flies the same spacecraft on a copy of its state, guided ideally in default attitudes (the Sun on -Y in downlinks and in
//! science that unloads), without dumps,
//! what is applied from outside being held: nothing of the flight itself changes.

use nalgebra::{Rotation3, Vector3};

use super::propagator_state::PropagatorState;
use crate::guidance::{ChosenPlace, Guided, ScienceCourse};
use crate::loads::ForceTorque;
use crate::momentum::{Convention, DumpPolicy, MomentumIntegrator, Totals};
use crate::plant::disturbances::evaluation::{Plant, PreparedSpacecraft, World};
use crate::plant::light::sunlit::SunlitCraft;
use crate::plant::settings::configuration::AttitudeSource;
use crate::plant::settings::error::PlantError;

/// Greatest last Chebyshev term of a forecast's totals, in N m s and m/s: far below any threshold.
const FORECAST_TOLERANCE: f64 = 1e-6;

/// Momentum where a downlink begins, in N m s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartMomentum {
    /// EME2000; it stays there while the body turns.
    Inertial(Vector3<f64>),
    /// Body components, whatever the attitude: the integral of each component of torque, or a start that is given in them.
    Body(Vector3<f64>),
}

impl StartMomentum {
    /// What a choice of attitude makes of totals under a convention.
    pub fn of(totals: &Totals, convention: Convention) -> Self {
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

/// Momentum at a time ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastMomentum {
    /// When, in s.
    pub time_s: f64,
    /// Whether a downlink lasts then.
    pub downlink: bool,
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Vector3<f64>,
    /// Unit vector to the Earth, EME2000; `None` where its place is not known.
    pub to_earth: Option<Vector3<f64>>,
    /// Pressure of sunlight, in Pa, without a shadow.
    pub pressure_pa: f64,
    /// By the flight's convention, body frame, in N m s.
    pub momentum_body_n_m_s: Vector3<f64>,
    /// The whole, EME2000, in N m s.
    pub momentum_inertial_n_m_s: Vector3<f64>,
    /// Components in the body frame of a vector in EME2000.
    pub body_from_inertial: Rotation3<f64>,
}

/// Who chooses the Sun's place; asked once a downlink or science that unloads, and again after a dump at its very beginning.
pub trait SunPlanner {
    /// The place, and whether limits keep the momentum from its target; no place where the default attitude is to be simulated.
    ///
    /// # Errors
    /// What ends a flight.
    fn choose(&self, downlink_forecast: &mut DownlinkForecast<'_>)
    -> Result<Option<ChosenPlace>, PlantError>;
}

/// Where a downlink begins, or science that unloads.
pub struct DownlinkForecast<'o> {
    pub(crate) prepared: PreparedSpacecraft<'o>,
    pub(crate) world: &'o mut World,
    pub(crate) propagator: &'o PropagatorState,
    pub(crate) applied: ForceTorque,
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
    /// Pressure of sunlight, in Pa, without a shadow.
    pub pressure_pa: f64,
    /// Least and greatest angle between Sun and Earth while the downlink lasts, in rad.
    pub separations_rad: [f64; 2],
    /// The science that begins; `None`: a downlink does.
    pub science: Option<ScienceCourse>,
}

impl DownlinkForecast<'_> {
    fn sunlit(&self) -> SunlitCraft<'_> {
        let World { configuration, mass_at_zero, .. } = &*self.world;
        self.prepared.sunlit(configuration, mass_at_zero, self.time_s)
    }

    /// Torque of direct sunlight without shadows in N m, body frame, the Sun being there in the body frame.
    pub fn torque_body_n_m(&self, sun_body: &Vector3<f64>) -> Vector3<f64> {
        self.sunlit().torque_body_n_m(sun_body, self.pressure_pa)
    }

    /// Centre of mass with the panels as they stand to a Sun on -Y, body frame, in m.
    pub fn center_of_mass_body_m(&self) -> Vector3<f64> {
        self.sunlit().center_of_mass_body_m()
    }

    /// Length of a cycle of science and downlink, in s; infinite where none follows, and where nothing may be forecast.
    pub fn cycle_s(&self) -> f64 {
        if self.forecasts { self.law.schedule.cycle_s() } else { f64::INFINITY }
    }

    /// Length of a downlink, in s.
    pub fn downlink_s(&self) -> f64 {
        self.law.schedule.downlink_s()
    }

    /// Momentum from here on at `times_s`, which do not descend; about `step_s` apart.
    ///
    /// # Errors
    /// What ends a flight.
    pub fn forecast(
        &mut self,
        times_s: impl Iterator<Item = f64>,
        step_s: f64,
        mut visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), PlantError> {
        let Self { world, law, totals, time_s, applied, .. } = self;
        let configuration = &mut world.configuration;
        let guided = Guided { managed: false, ..law.with_sun_places(None, None) };
        let attitude = core::mem::replace(&mut configuration.attitude, AttitudeSource::Guided(guided));
        let (momentum, light_and_heat) = (configuration.momentum, configuration.light_and_heat);
        // Tolerances shorten what is too coarse.
        configuration.momentum.grid_s = momentum.grid_s.max(step_s);
        configuration.light_and_heat.grid_s = light_and_heat.grid_s.max(step_s);
        configuration.momentum.tolerance = momentum.tolerance.max(FORECAST_TOLERANCE);
        configuration.momentum.policy.threshold_body_n_m_s = Vector3::repeat(f64::INFINITY);
        let settings = configuration.momentum;
        let mut propagator = self.propagator.clone();
        propagator.cut(configuration, *time_s, true);
        let applied = [*applied, ForceTorque::zero()];
        let external = |_: f64| applied;
        let mut integrator = MomentumIntegrator::new(*time_s, *totals);
        let mut simulated = Ok(());
        for at_s in times_s {
            let mut plant = Plant::new(self.prepared, world, &mut propagator, &external);
            simulated = integrator.advance(&mut plant, &settings, at_s, |_| {});
            if simulated.is_err() {
                break;
            }
            let instant = plant.instant(at_s);
            let (totals, inertial_from_body) = (integrator.totals(at_s), instant.frame.inertial_from_body);
            visit(ForecastMomentum {
                time_s: at_s,
                downlink: instant.regime.downlink,
                to_sun: instant.geometry.to_sun.position_m.normalize(),
                to_earth: instant.geometry.to_earth.position_m.try_normalize(0.0),
                pressure_pa: plant.kinematics.configuration.light.pressure_pa(instant.sun_distance_m),
                momentum_body_n_m_s: totals.momentum_body_n_m_s(settings.convention, &inertial_from_body),
                momentum_inertial_n_m_s: totals.momentum_inertial_n_m_s,
                body_from_inertial: inertial_from_body.inverse(),
            });
        }
        let configuration = &mut world.configuration;
        configuration.attitude = attitude;
        (configuration.momentum, configuration.light_and_heat) = (momentum, light_and_heat);
        simulated
    }

    /// Which momentum the flight's convention watches.
    pub fn convention(&self) -> Convention {
        self.world.configuration.momentum.convention
    }

    /// When thrusters dump, and what they leave.
    pub fn dump_policy(&self) -> DumpPolicy {
        self.world.configuration.momentum.policy
    }
}
