//! A point mass that burns under guidance: thrust off its nominal direction, attitude that follows with a lag, accelerometers.
//!
//! Guidance and spacecraft exchange as a master does that calls both over the same step: each sees the other's last results.

use crate::guidance::tests::geometry::nearest_zone;
use nalgebra::{UnitQuaternion, Vector3};

use crate::attitude::Attitude;
use crate::attitude::control::{AccelerometerSettings, AccelerometerState};
use crate::bodies::Body;
use crate::constants::DEG_RAD;
use crate::guidance::burn::delta_v::{BurnPhase, BurnSettings, GAIN, LOOK_AHEAD_S};
use crate::guidance::burn::nominal_thrust::NominalThrust;
use crate::guidance::burn::velocity_path::VelocityPath;
use crate::guidance::constraints::constrained::Constraints;
use crate::guidance::downlink::sun_direction::{LinkLimits, SunRequest};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::modes::body_positions::BodyPositions;
use crate::guidance::modes::sample_inputs::{GuidanceSettings, SampleInputs, TimedEntries};
use crate::guidance::modes::system::GuidanceState;
use crate::guidance::modes::transitions::{ModeSettings, Sensed};
use crate::guidance::orbit_phase::attitudes::ScienceRule;
use crate::guidance::pointing::command::{PointingCommand, Scenario};
use crate::guidance::scenario::scenario_tests::no_instruments;
use crate::guidance::tests::orbit::{about_mercury, guided};
use crate::numerics::noise::{Channel, normal_vector};

/// Control samples a second.
const RATE_HZ: u32 = 50;

/// The thrust as it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrueThrust {
    /// In N.
    pub force_n: f64,
    /// At the start, in kg.
    pub mass_kg: f64,
    /// In m/s.
    pub exhaust_m_s: f64,
    /// Angle off the nominal direction, in rad; where to comes from the seed.
    pub misalignment_rad: f64,
    /// Angle it moves by in 100 s, in rad.
    pub drift_rad: f64,
    /// Standard deviation about each axis, drawn once a second, in rad.
    pub jitter_rad: f64,
}

/// A burn to simulate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BurnFlight {
    pub settings: BurnSettings,
    pub thrust: TrueThrust,
    pub accelerometers: AccelerometerSettings,
    pub seed: u64,
    /// Control samples from one exchange to the next.
    pub samples_per_exchange: u32,
    /// Whether thrust.stop counts: otherwise thrust ends where its command does.
    pub stops_between: bool,
    /// Time constant of the attitude, in s.
    pub lag_s: f64,
}

/// What a flight came to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simulated {
    /// True velocity added, EME2000, in m/s.
    pub velocity_m_s: Vector3<f64>,
    /// True thrust direction at the end, body frame.
    pub thrust_body: Vector3<f64>,
    /// Guidance after it.
    pub guidance: GuidanceState,
    /// Greatest distance of the true velocity from the path, in m/s.
    pub farthest_m_s: f64,
    /// Greatest commanded rate while thrust was commanded, in rad/s.
    pub fastest_rad_s: f64,
}

/// The Sun to the side of burns along x.
pub(crate) fn ephemeris() -> EphemerisAtTime {
    let position = Vector3::x() * Body::Mercury.data().radius_m * 2.0;
    about_mercury(position, Vector3::new(1e10, 5e10, 2e10), Vector3::new(4e10, 8e10, 1e10))
}

/// 10 m/s by 88 N on 1000 kg along +Z.
pub(crate) fn settings(delta_v_m_s: Vector3<f64>) -> BurnSettings {
    BurnSettings {
        path: VelocityPath::linear(delta_v_m_s),
        thrusters: None,
        start_s: 5.0,
        awaits_attitude: false,
        look_ahead_s: LOOK_AHEAD_S,
        gain: GAIN,
        predictive: true,
        reactive: true,
        nominal: NominalThrust { direction_body: Vector3::z(), acceleration_m_s2: 0.088 },
        timeout_s: 3600.0,
        wait_s: 3600.0,
    }
}

/// Without constraints.
pub(crate) fn guidance_settings(burn: BurnSettings) -> GuidanceSettings<'static> {
    let keep_in = nearest_zone(0.3, 0.3);
    GuidanceSettings {
        hardware: no_instruments(),
        modes: ModeSettings {
            operational: Constraints::default(),
            safe_hold: Constraints::default(),
            monitor: None,
            ephemeris_check: None,
            watches_hot_pole: true,
            boresight_body: -Vector3::y(),
            earth_acquisition_rate_rad_s: 1e-3,
            sun_search_rate_rad_s: 1e-3,
            sun_search_duration_s: 600.0,
        },
        keep_in,
        link: LinkLimits { sun_separation_rad: 0.05, coverage_rad: Some(0.05) },
        orbit_phase: guided(ScienceRule::Nadir, f64::INFINITY, [0.0, 0.0], 0),
        burn,
    }
}

/// What a sample reads while a burn is commanded.
pub(crate) fn sample_inputs(attitude: Attitude, delta_v_body_m_s: Vector3<f64>) -> SampleInputs {
    SampleInputs {
        command: PointingCommand { scenario: Some(Scenario::Burn), ..PointingCommand::default() },
        requested_sun: SunRequest::default(),
        sun_is_placed: false,
        is_commanded: false,
        entries: TimedEntries::default(),
        positions: BodyPositions::in_every_mode(Some(ephemeris())),
        sensed: Sensed {
            time_s: 0.0,
            request: None,
            is_of_timeline: false,
            estimate: Some(attitude),
            sun_body: None,
        },
        delta_v_body_m_s,
    }
}

/// The same at rest.
pub(crate) fn still_inputs() -> SampleInputs {
    sample_inputs(Attitude::default(), Vector3::zeros())
}

impl BurnFlight {
    /// The case.
    pub(crate) fn new(seed: u64) -> Self {
        Self {
            settings: settings(Vector3::x() * 10.0),
            thrust: TrueThrust {
                force_n: 88.0,
                mass_kg: 1000.0,
                exhaust_m_s: 2260.0,
                misalignment_rad: 0.75 * DEG_RAD,
                drift_rad: 0.1 * DEG_RAD,
                jitter_rad: 0.1 * DEG_RAD,
            },
            accelerometers: AccelerometerSettings {
                bias_m_s2: 1.5e-5,
                scale: 1e-4,
                noise_m_s2: 1e-4,
                drift_m_s2_sqrt_s: 0.0,
                seed,
            },
            seed,
            samples_per_exchange: RATE_HZ,
            stops_between: true,
            lag_s: 3.0,
        }
    }

    /// Thrust direction `elapsed_s` after it began.
    fn thrust_body(&self, elapsed_s: f64) -> Vector3<f64> {
        let off = |event: u64, angle_rad: f64| {
            let drawn = normal_vector(self.seed, Channel::GyroAngle, event);
            let across = Vector3::new(drawn.x, drawn.y, 0.0).normalize();
            across * angle_rad
        };
        let jitter = normal_vector(self.seed, Channel::GyroBias, elapsed_s as u64) * self.thrust.jitter_rad;
        let steady = off(0, self.thrust.misalignment_rad) + off(1, self.thrust.drift_rad * elapsed_s / 100.0);
        let turn = steady + Vector3::new(jitter.x, jitter.y, 0.0);
        UnitQuaternion::from_scaled_axis(turn) * self.settings.nominal.direction_body
    }

    /// Simulates it for `duration_s`.
    pub(crate) fn simulated(&self, duration_s: u32) -> Simulated {
        let settings = guidance_settings(self.settings);
        let path = self.settings.path.unwrap();
        let dt = 1.0 / f64::from(RATE_HZ);
        let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
        guidance.sample(&settings, &still_inputs(), |_| None);
        // The turn to the burn is done.
        let mut attitude = guidance.command.attitude_at(0.0);
        let mut accelerometers = AccelerometerState::new(&self.accelerometers);
        let (mut velocity_m_s, mut mass_kg) = (Vector3::zeros(), self.thrust.mass_kg);
        let (mut magnitude_m_s, mut farthest_m_s, mut fastest_rad_s) = (0.0, 0.0_f64, 0.0_f64);
        let (mut began_s, mut ended_s) = (None, 0.0);
        let mut seen = guidance;
        for number in 0..duration_s * RATE_HZ {
            let time_s = f64::from(number) / f64::from(RATE_HZ);
            if number % self.samples_per_exchange == 0 {
                // Guidance over the coming step, with what the spacecraft says now; the spacecraft has what it said before.
                seen = guidance;
                let to_s = time_s + dt * f64::from(self.samples_per_exchange);
                while guidance.due_before(to_s).is_some() {
                    let inputs = sample_inputs(attitude, *accelerometers.delta_v_body_m_s());
                    guidance.sample(&settings, &inputs, |_| None);
                    let rate = guidance.command.rate_body_rad_s;
                    if guidance.burn.stop_s().is_some() {
                        fastest_rad_s = fastest_rad_s.max(rate.norm());
                    }
                }
            }
            let command = &seen.command;
            let stop_s = seen.burn.stop_s().unwrap_or(f64::NEG_INFINITY);
            let until_s = if self.stops_between || stop_s.is_infinite() { stop_s } else { f64::INFINITY };
            let on_s = (until_s - time_s).clamp(0.0, dt);
            let mut increment_body = Vector3::zeros();
            if on_s > 0.0 {
                let since_s = *began_s.get_or_insert(time_s);
                ended_s = time_s + on_s;
                let flow_kg_s = self.thrust.force_n / self.thrust.exhaust_m_s;
                let grown_m_s = self.thrust.exhaust_m_s * (mass_kg / (mass_kg - flow_kg_s * on_s)).ln();
                mass_kg -= flow_kg_s * on_s;
                increment_body = self.thrust_body(time_s - since_s) * grown_m_s;
                magnitude_m_s += grown_m_s;
            }
            let error = attitude.rotation_vector_to(&command.attitude_at(time_s));
            let rate = command.rate_body_rad_s + error / self.lag_s;
            velocity_m_s += attitude.propagated(rate, 0.5 * dt).to_inertial(&increment_body);
            attitude = attitude.propagated(rate, dt).normalized();
            accelerometers.sample(&self.accelerometers, &increment_body, dt, u64::from(number));
            farthest_m_s = farthest_m_s.max((velocity_m_s - path.point(magnitude_m_s).velocity_m_s).norm());
        }
        assert!(matches!(guidance.burn.phase, BurnPhase::Ended { .. }), "{:?}", guidance.burn);
        Simulated {
            velocity_m_s,
            thrust_body: self.thrust_body(ended_s - began_s.unwrap_or(0.0)),
            guidance,
            farthest_m_s,
            fastest_rad_s,
        }
    }
}
