//! A Mercury orbiter with the Sun, Earth and planets where they are, for tests of the pointing laws.

use core::cell::RefCell;

use nalgebra::{Matrix3, Vector3};

use crate::bodies::Body;
use crate::constants::DEG_RAD;
use crate::environment::CartesianState;
use crate::environment::ephemeris::Ephemeris;
use crate::environment::orbit::{Elements, TwoBodyOrbit, semi_major_axis_m};
use crate::guidance::geometry::ephemeris_at_time::{EphemerisAtTime, TargetPlanet};
use crate::guidance::geometry::moving::{MovingMatrix, fixed, matrix_value, moving};
use crate::guidance::{Guided, Schedule, ScienceRule};

/// 2011-04-06, a whole number of seconds past J2000: times in steps of powers of two are exact.
const EPOCH_S: f64 = 355_363_200.0;

/// Science by a rule between downlinks of these windows, from `start_s` to `end_s` after every `every`-th periapsis.
pub(crate) fn guided(science: ScienceRule, period_s: f64, [start_s, end_s]: [f64; 2], every: u32) -> Guided {
    let schedule = Schedule {
        periapsis_s: 0.0,
        period_s,
        downlink_start_s: start_s,
        downlink_end_s: end_s,
        period_shares: [None; 2],
        every,
        once: false,
        throughout: false,
    };
    Guided {
        schedule,
        science,
        elevation_limit_rad: 0.2,
        slew_rate_rad_s: 0.0,
        keep_in: None,
        sun_direction: None,
        requested: Default::default(),
        managed: false,
    }
}

/// At epoch 0 about Mercury, with Sun and Earth that stand still.
pub(crate) fn about_mercury(
    position: Vector3<f64>,
    sun: Vector3<f64>,
    earth: Vector3<f64>,
) -> EphemerisAtTime {
    EphemerisAtTime {
        epoch_s: 0.0,
        planet: TargetPlanet::from_body(Body::Mercury.data()),
        position: fixed(position),
        velocity: fixed(Vector3::y() * 3e3),
        sun: fixed(sun),
        earth: fixed(earth),
        bodies: [None; Body::COUNT],
    }
}

/// The orbit of paper 001: periapsis at 200 km, 60 deg north, inclined by 80 deg, about a triaxial Mercury.
pub(crate) struct TestOrbit {
    pub orbit: TwoBodyOrbit,
    ephemeris: RefCell<Ephemeris>,
    planet: TargetPlanet,
}

impl TestOrbit {
    /// Of a period in hours.
    pub(crate) fn new(period_h: f64) -> Self {
        let data = Body::Mercury.data();
        let a_m = semi_major_axis_m(data.gm_m3_s2, period_h * 3600.0);
        let elements = Elements {
            semi_major_axis_m: a_m,
            eccentricity: 1.0 - (data.radius_m + 2e5) / a_m,
            inclination_rad: 80.0 * DEG_RAD,
            ascending_node_rad: 0.7,
            periapsis_argument_rad: 118.0 * DEG_RAD,
            true_anomaly_rad: 0.0,
        };
        let orbit = TwoBodyOrbit::from_elements(elements, data.gm_m3_s2, EPOCH_S).unwrap();
        let planet = TargetPlanet {
            radii_m: Vector3::new(2_445_000.0, 2_440_000.0, 2_431_000.0),
            ..TargetPlanet::from_body(data)
        };
        Self { orbit, ephemeris: RefCell::default(), planet }
    }

    /// At a time after periapsis.
    pub(crate) fn ephemeris(&self, time_s: f64) -> EphemerisAtTime {
        let epoch_s = EPOCH_S + time_s;
        let mut ephemeris = self.ephemeris.borrow_mut();
        let mercury = ephemeris.state(Body::Mercury, epoch_s);
        let mut from_planet = |body| {
            let state = ephemeris.state(body, epoch_s);
            CartesianState {
                position_m: state.position_m - mercury.position_m,
                velocity_m_s: state.velocity_m_s - mercury.velocity_m_s,
            }
        };
        let (sun, earth) = (from_planet(Body::Sun), from_planet(Body::Earth));
        let spacecraft = self.orbit.state_at(epoch_s);
        let mut at_time = EphemerisAtTime::new(epoch_s, self.planet, &spacecraft, &sun, &earth);
        for body in [Body::Venus, Body::Mars, Body::Jupiter] {
            let state = from_planet(body);
            at_time.bodies[body as usize] = Some(moving(state.position_m, state.velocity_m_s));
        }
        at_time
    }

    /// 1 Hz instants over one orbit, densest about periapsis, in s.
    pub(crate) fn times_s(&self) -> [f64; 48] {
        core::array::from_fn(|at| {
            let part = (at as f64 - 24.0) / 24.0;
            (0.5 * self.orbit.period_s() * part * part.abs()).round()
        })
    }
}

/// Largest component of the difference between the body rate of `axes` and the fourth-order difference of its values over
/// `step_s`, over the larger of the rate and `floor_rad_s`; `None` where a value is missing.
pub(crate) fn rate_error(
    axes: impl Fn(f64) -> Option<MovingMatrix>,
    time_s: f64,
    step_s: f64,
    floor_rad_s: f64,
) -> Option<f64> {
    let at = |steps: f64| Some(matrix_value(&axes(time_s + steps * step_s)?));
    let slope: Matrix3<f64> = (at(-2.0)? - at(2.0)? + (at(1.0)? - at(-1.0)?) * 8.0) / (12.0 * step_s);
    let here = axes(time_s)?;
    let skew = matrix_value(&here).transpose() * slope;
    let expected =
        Vector3::new(skew[(2, 1)] - skew[(1, 2)], skew[(0, 2)] - skew[(2, 0)], skew[(1, 0)] - skew[(0, 1)])
            * 0.5;
    let found = crate::guidance::geometry::moving::angular_rate_rad_s(&here);
    Some((found - expected).norm() / found.norm().max(floor_rad_s))
}
