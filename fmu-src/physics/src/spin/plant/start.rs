//! How a flight starts, checked.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::commands::{Commands, Directions};
use super::sound::orbit_is_sound;
use super::state::{
    DIRECTION_INTERVAL_S, LEAST_WORK, MOST_WORK, MassSource, Plant, Sampling, SensorAzimuths, StarSample,
};
use crate::attitude::{Inertia, InertiaError, Quaternion, angle_between_rad};
use crate::spin::{
    burn::{Burn, BurnError, BurnInitialConditions, BurnRequest},
    crossing_detector::CrossingDetector,
    damper::{Damper, SHORTEST_TIME_CONSTANT_S},
    forecast::Timing,
    geometry::L1Ephemeris,
    motion::Motion,
    nutation::{LinearNutation, Spin},
    sequencer::{FASTEST_RAD_S, SLOWEST_RAD_S, Sequencer},
    series::BodyTorque,
    spinner::Spinner,
    tracker::NutationEstimator,
    work::{Work, WorkExceeded},
};

/// How a flight starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Principal moments, in kg m2; used with [`MassSource::Fixed`].
    pub inertia_kg_m2: [f64; 3],
    /// What the inertia follows.
    pub mass_source: MassSource,
    /// On board, in kg.
    pub propellant_kg: f64,
    /// Rate about the third axis, in rad/s.
    pub spin_rate_rad_s: f64,
    /// EME2000 to body, scalar last.
    pub attitude: [f64; 4],
    /// Angle between momentum and spin axis, in rad.
    pub nutation_rad: f64,
    /// Azimuth of the transverse momentum in the body, in rad.
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
    /// Of all random draws.
    pub seed: u64,
    /// What a step may cost, [`LEAST_WORK`] to [`MOST_WORK`].
    pub work_limit: u32,
}

/// Why a flight cannot start.
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
    #[error("{name} is {found}; {allowed}")]
    Parameter {
        /// FMI name.
        name: &'static str,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
}

impl Plant {
    /// Starts a flight at `start_s`.
    pub fn start(
        spinner: &Spinner,
        start: &Start,
        directions: Directions,
        commands: Commands,
        start_s: f64,
    ) -> Result<Self, StartError> {
        let inertia = match start.mass_source {
            MassSource::Fixed => Inertia::new(start.inertia_kg_m2)?,
            MassSource::Propellant => spinner.mass_properties.inertia(start.propellant_kg)?,
        };
        let attitude = check(spinner, start)?;
        let spin_n_m_s = inertia.spin_kg_m2() * start.spin_rate_rad_s;
        let across = spin_n_m_s * start.nutation_rad.tan();
        let (sine, cosine) = start.nutation_phase_rad.sin_cos();
        let momentum_inertial =
            attitude.inertial_from_body(&Vector3::new(across * cosine, across * sine, spin_n_m_s));
        let theory = Spin {
            rate_rad_s: start.spin_rate_rad_s,
            ratio: inertia.inertial_nutation_ratio().unwrap_or(inertia.ratio()),
            inertia_kg_m2: inertia.spin_kg_m2(),
        };
        let slit = |azimuth_deg: f64| {
            let (sine, cosine) = azimuth_deg.to_radians().sin_cos();
            Vector3::new(cosine, sine, 0.0)
        };
        let sequencer = match &start.burn {
            None => None,
            Some(request) => {
                let initial = BurnInitialConditions {
                    spin: theory,
                    momentum_inertial,
                    propellant_kg: start.propellant_kg,
                };
                let burn = Burn::new(spinner, request, &initial)?;
                Some(Sequencer::new(burn, spinner.sun_sensor.azimuth_deg.to_radians()))
            }
        };
        let damper = Damper::new(start.damper_time_constant_s, &inertia);
        let quiet = BodyTorque::constant(Vector3::zeros());
        let motion = Motion::new(inertia, damper, quiet, start_s, attitude, momentum_inertial, f64::INFINITY);
        let mut plant = Self {
            motion,
            time_s: start_s,
            mass_source: start.mass_source,
            initial_propellant_kg: start.propellant_kg,
            initial_momentum_inertial: momentum_inertial,
            initial_spin_axis_inertial: attitude.spin_axis_inertial(),
            theory,
            sequencer,
            commands: Commands::none(),
            directions,
            mask: 0,
            mask_since_s: start_s,
            used_kg: 0.0,
            delta_v_inertial_m_s: Vector3::zeros(),
            delta_v_until_s: start_s,
            predicted: LinearNutation::default(),
            sun: CrossingDetector::new(start_s),
            star: CrossingDetector::new(start_s),
            sun_sample_rad: 0.0,
            sampling: start.sampling,
            clock_period_s: f64::from(spinner.star_tracker.every) * 2.0 * PI / start.nominal_rate_rad_s,
            clock_start_s: start_s,
            clock_count: 0,
            every: spinner.star_tracker.every,
            sample: StarSample { time_s: -1.0, ..StarSample::default() },
            estimator: NutationEstimator::default(),
            estimator_since_s: start_s,
            sensor_azimuths: SensorAzimuths {
                sun: slit(spinner.sun_sensor.azimuth_deg),
                star: slit(spinner.star_tracker.azimuth_deg),
            },
            seed: start.seed,
            commanded: true,
            l1: start.l1,
            refresh_count: 0,
            refresh_s: f64::INFINITY,
            work_limit: start.work_limit,
        };
        if start.l1.is_some() {
            plant.refresh_count = (start_s / DIRECTION_INTERVAL_S).floor() as i64;
            plant.refresh_s = plant.refresh_count as f64 * DIRECTION_INTERVAL_S;
            plant.refresh_directions();
            plant.sun = CrossingDetector::new(start_s);
        }
        plant.refuse_blind_timing(start)?;
        let mut work = Work::new(start.work_limit);
        plant.schedule(start_s, &mut work);
        work.check(start_s)?;
        plant.command(commands, directions);
        Ok(plant)
    }

    /// Sun pulses need a Sun off the axis; one that is not known yet may still come.
    pub(super) fn refuse_blind_timing(&self, start: &Start) -> Result<(), StartError> {
        let by_sun = start.burn.as_ref().is_some_and(|b| b.timing == Timing::SunCrossing);
        let state = self.motion.at(self.time_s);
        let angle = angle_between_rad(&state.momentum_inertial, &self.directions.sun_inertial);
        let least = start.nutation_rad.max(1e-3);
        if by_sun && self.directions.sun_inertial != Vector3::zeros() && angle.sin() <= least {
            return Err(StartError::Parameter {
                name: "burn.timing",
                found: format!("Sun crossing with the Sun {:.4} deg off the spin axis", angle.to_degrees()),
                allowed: "a Sun crossing needs the Sun farther off the axis than nutation takes it"
                    .to_owned(),
            });
        }
        Ok(())
    }
}

/// What can be wrong with the numbers of a start, and the attitude they give.
fn check(spinner: &Spinner, start: &Start) -> Result<Quaternion, StartError> {
    let refuse = |name, found: String, allowed: &str| {
        Err(StartError::Parameter { name, found, allowed: allowed.to_owned() })
    };
    let rate = start.spin_rate_rad_s;
    if !(SLOWEST_RAD_S..=FASTEST_RAD_S).contains(&rate) {
        return refuse("spin.initialRate", format!("{rate} rad/s"), "allowed is 1e-4 to 1e4 rad/s");
    }
    let nutation = start.nutation_rad;
    if !(0.0..1.5).contains(&nutation) || !start.nutation_phase_rad.is_finite() {
        return refuse("start.nutation", format!("{nutation} rad"), "allowed is 0 to below 1.5 rad");
    }
    let tau = start.damper_time_constant_s;
    if !(tau == 0.0 || (tau.is_finite() && tau >= SHORTEST_TIME_CONSTANT_S)) {
        return refuse("damper.timeConstant", format!("{tau} s"), "allowed is 0 (no damper) or 1 s and more");
    }
    let nominal = start.nominal_rate_rad_s;
    if !(SLOWEST_RAD_S..=FASTEST_RAD_S).contains(&nominal) {
        return refuse("limit.spinRate", format!("{nominal} rad/s"), "allowed is 1e-4 to 1e4 rad/s");
    }
    if !(LEAST_WORK..=MOST_WORK).contains(&start.work_limit) {
        let allowed = format!("allowed is {LEAST_WORK} to {MOST_WORK}");
        return refuse("solver.workLimit", start.work_limit.to_string(), &allowed);
    }
    let most_kg = spinner.mass_properties.most_propellant_kg();
    if !(0.0..=most_kg).contains(&start.propellant_kg) {
        let allowed = format!("allowed is 0 to {most_kg} kg, where the setup's mass properties end");
        return refuse("propellant.loaded", format!("{} kg", start.propellant_kg), &allowed);
    }
    if let Some(l1) = &start.l1
        && !orbit_is_sound(l1)
    {
        let found = format!("{:?} m", l1.orbit.amplitude_m);
        return refuse("geometry.amplitude", found, "finite, the first below the distance from Earth to L1");
    }
    match Quaternion::from_components(start.attitude) {
        Some(attitude) => Ok(attitude),
        None => refuse("start.q", format!("{:?}", start.attitude), "its norm must be 1 within 1e-3"),
    }
}
