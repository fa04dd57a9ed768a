//! Start of a flight, checked.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::directions::{has_directions, is_unit};
use crate::attitude::{Inertia, InertiaError, Quaternion, angle_between_rad};
use crate::enumeration::enumeration;
use crate::math;
use crate::spacecraft::{MOST_THRUSTERS, ValveTiming};
use crate::spin::{
    burn_error::{BurnError, ParameterError},
    burn_request::BurnRequest,
    damper::SHORTEST_TIME_CONSTANT_S,
    forecast::Timing,
    geometry::L1Ephemeris,
    nutation::Spin,
    sequencer::{FASTEST_RAD_S, SLOWEST_RAD_S},
    spinner::{PulseExecution, Spinner},
    work::WorkExceeded,
};

/// Least work of a step that may be allowed, in units of about a microsecond.
pub const LEAST_WORK: u32 = 1000;
/// Greatest work of a step that may be allowed.
pub const MOST_WORK: u32 = 1_000_000_000;

enumeration! {
    /// Source of the inertia.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum MassSource {
        /// The parameters inertia and productsOfInertia, unchanged by propellant use; no jet damping.
        1 => Fixed,
        /// The setup's table over propellant, at the end of each pulse; jet damping while thrusters fire.
        2 => Propellant,
    }
}

enumeration! {
    /// When the star tracker samples its star.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Sampling {
        /// When it passes the boresight, on the turns that search its picket.
        1 => Spins,
        /// Every 8 turns of the nominal rate by the clock, as paper 002 assumes in eqs 16 to 20.
        2 => Clock,
    }
}

/// Start of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Moments about the body axes, in kg m2; used with [`MassSource::Fixed`].
    pub inertia_kg_m2: [f64; 3],
    /// Products of inertia 12, 13, 23, in kg m2: elements of the tensor; used with [`MassSource::Fixed`].
    pub products_kg_m2: [f64; 3],
    /// Source of the inertia.
    pub mass_source: MassSource,
    /// Propellant on board, in kg.
    pub propellant_kg: f64,
    /// How thrusters execute their pulses.
    pub execution: [PulseExecution; MOST_THRUSTERS],
    /// Rate about the third principal axis, in rad/s.
    pub spin_rate_rad_s: f64,
    /// EME2000 to body, scalar last.
    pub attitude: [f64; 4],
    /// Angle between momentum and third principal axis, in rad.
    pub nutation_rad: f64,
    /// Azimuth of the transverse momentum in the body about that axis, in rad.
    pub nutation_phase_rad: f64,
    /// 1/e time of the nutation angle, in s; 0 without a damper.
    pub damper_time_constant_s: f64,
    /// The burn; `None` if only outside commands fire thrusters.
    pub burn: Option<BurnRequest>,
    /// The L1 orbit; `None` takes Sun and Earth as given.
    pub l1: Option<L1Ephemeris>,
    /// Star tracker sampling.
    pub sampling: Sampling,
    /// Nominal spin rate, in rad/s: sets the clock of the star tracker.
    pub nominal_rate_rad_s: f64,
    /// Seed of all random draws.
    pub seed: u64,
    /// Greatest work of a step, [`LEAST_WORK`] to [`MOST_WORK`].
    pub work_limit: u32,
}

/// Reason why a flight cannot start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StartError {
    /// Inertia.
    #[error(transparent)]
    Inertia(#[from] InertiaError),
    /// Burn.
    #[error(transparent)]
    Burn(#[from] BurnError),
    /// Effort.
    #[error(transparent)]
    Work(#[from] WorkExceeded),
    /// Another parameter.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// Conditions at the start of a flight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InitialConditions {
    /// Momentum, inertial, in N m s.
    pub momentum_inertial: Vector3<f64>,
    /// Spin axis, inertial.
    pub spin_axis_inertial: Vector3<f64>,
    /// Spin, ratio and inertia, as planners know them.
    pub theory: Spin,
}

impl InitialConditions {
    /// Rejects decoded conditions that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        let theory = self.theory;
        is_unit(&self.spin_axis_inertial)
            && (SLOWEST_RAD_S..=FASTEST_RAD_S).contains(&theory.rate_rad_s)
            && [theory.ratio, theory.inertia_kg_m2].iter().all(|x| *x >= 1e-100)
    }
}

impl Start {
    /// Inertia at the start.
    ///
    /// # Errors
    /// Moments that no body has.
    pub(super) fn inertia(&self, spinner: &Spinner) -> Result<Inertia, InertiaError> {
        match self.mass_source {
            MassSource::Fixed => Inertia::with_products(self.inertia_kg_m2, self.products_kg_m2),
            MassSource::Propellant => spinner.mass_properties.inertia(self.propellant_kg),
        }
    }

    /// Angular momentum in the frame of the spin axis, in N m s.
    pub(super) fn momentum_spin_frame_n_m_s(&self, inertia: &Inertia) -> Vector3<f64> {
        let spin_n_m_s = inertia.spin_kg_m2() * self.spin_rate_rad_s;
        let across = spin_n_m_s * math::tan(self.nutation_rad);
        let (sine, cosine) = math::sin_cos(self.nutation_phase_rad);
        Vector3::new(across * cosine, across * sine, spin_n_m_s)
    }

    /// Checks the numbers and returns the attitude that they give.
    ///
    /// # Errors
    /// The first parameter that is refused.
    pub(super) fn check(&self, spinner: &Spinner) -> Result<Quaternion, StartError> {
        let refuse =
            |name, found: String, allowed: &str| Err(ParameterError::new(name, found, allowed).into());
        let check_rate = |name, rate: f64| match (SLOWEST_RAD_S..=FASTEST_RAD_S).contains(&rate) {
            true => Ok(()),
            false => Err(ParameterError::new(name, format!("{rate} rad/s"), "allowed is 1e-4 to 1e4 rad/s")),
        };
        check_rate("spin.initialRate", self.spin_rate_rad_s)?;
        let nutation = self.nutation_rad;
        if !(0.0..1.5).contains(&nutation) || !self.nutation_phase_rad.is_finite() {
            return refuse("start.nutation", format!("{nutation} rad"), "allowed is 0 to below 1.5 rad");
        }
        if let Some(k) = self.execution.iter().position(|it| !it.is_valid()) {
            let PulseExecution { valve: ValveTiming { min_on_s, rise_s, tail_off_s }, scatter } =
                self.execution[k];
            let found = format!("{min_on_s}, {rise_s}, {tail_off_s} s, {scatter} with k = {}", k + 1);
            let allowed = "allowed are times of 0 s and more, and a scatter from 0 to 1";
            return refuse("thruster[k].minOnTime, riseTime, tailOffTime, scatter", found, allowed);
        }
        let tau = self.damper_time_constant_s;
        if !(tau == 0.0 || (tau.is_finite() && tau >= SHORTEST_TIME_CONSTANT_S)) {
            let allowed = "allowed is 0 (no damper) or 1 s and more";
            return refuse("damper.timeConstant", format!("{tau} s"), allowed);
        }
        check_rate("limit.spinRate", self.nominal_rate_rad_s)?;
        if !(LEAST_WORK..=MOST_WORK).contains(&self.work_limit) {
            let allowed = format!("allowed is {LEAST_WORK} to {MOST_WORK}");
            return refuse("solver.workLimit", self.work_limit.to_string(), &allowed);
        }
        let most_kg = spinner.mass_properties.most_propellant_kg();
        if !(0.0..=most_kg).contains(&self.propellant_kg) {
            let allowed = format!("allowed is 0 to {most_kg} kg, where the setup's mass properties end");
            return refuse("propellant.loaded", format!("{} kg", self.propellant_kg), &allowed);
        }
        if let Some(l1) = &self.l1
            && !has_directions(l1)
        {
            let found = format!("{:?} m", l1.orbit.amplitude_m);
            return refuse("geometry.amplitude", found, "the first below the distance from Earth to L1");
        }
        match Quaternion::from_components(self.attitude) {
            Some(attitude) => Ok(attitude),
            None => refuse("start.q", format!("{:?}", self.attitude), "its norm must be 1 within 1e-3"),
        }
    }

    /// Sun pulses need a Sun off the axis; one that is not known yet may still come.
    pub(super) fn refuse_blind_timing(
        &self,
        momentum_inertial: &Vector3<f64>,
        sun_inertial: &Vector3<f64>,
    ) -> Result<(), StartError> {
        let by_sun = self.burn.as_ref().is_some_and(|b| b.timing == Timing::SunCrossing);
        let angle = angle_between_rad(momentum_inertial, sun_inertial);
        let least = self.nutation_rad.max(1e-3);
        if by_sun && *sun_inertial != Vector3::zeros() && math::sin(angle) <= least {
            let found = format!("Sun crossing with the Sun {:.4} deg off the spin axis", angle.to_degrees());
            let allowed = "a Sun crossing needs the Sun farther off the axis than nutation takes it";
            return Err(ParameterError::new("burn.timing", found, allowed).into());
        }
        Ok(())
    }
}
