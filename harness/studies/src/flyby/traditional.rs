//! What a flyby costs by manoeuvres: errors of the departure, of its clean-up, of an approach manoeuvre, drawn; linear in them.

use loader::Fmu;
use nalgebra::{Matrix6, Vector2};
use planner::flyby::{
    Sensitivity,
    dispersion::{Dispersions, Draw},
};

use super::leg::{Failure, Leg};
use super::mission::{DAY_S, FLYBY_2};
use super::plane::{POSITION_M, Target, VELOCITY_M_S};
use crate::attitude::Vector;

/// Errors of execution, about each axis across in rad and as a share of the size: printed.
const DIRECTION_RAD: f64 = 0.2 * core::f64::consts::PI / 180.0;
const MAGNITUDE: f64 = 1e-3;
/// The departure, in m/s, printed; when it is cleaned up, behind it, and the approach manoeuvre, before the flyby, in s.
const DEPARTURE_M_S: f64 = 72.3;
const CLEAN_UP_S: f64 = 30.0 * DAY_S;
const APPROACH_S: f64 = 42.0 * DAY_S;
/// Standard deviation of the scale of sunlight, assumed.
const SCALE: f64 = 0.01;
const RUNS: u64 = 1000;
const SEED: u64 = 1;

/// Approach, departure and both (m/s), miss and size of the altitude offset (km), by run.
pub(super) struct Costs {
    pub label: &'static str,
    pub columns: [Vec<f64>; 5],
}

/// What runs are drawn from.
struct Drawn<'a> {
    sensitivity: &'a Sensitivity,
    /// Independent, of deviation 1.
    unit: Dispersions,
    run: u64,
}

impl Drawn<'_> {
    fn draw(&self, of: u64) -> Draw {
        self.unit.draw(SEED + of, self.run)
    }

    /// What a manoeuvre's execution moves the intercept by.
    fn execution_m(&self, of: u64, at_s: f64, delta_v_m_s: &Vector) -> Vector2<f64> {
        let along = delta_v_m_s.try_normalize(0.0).unwrap_or_default();
        let unit = self.draw(of).position_m;
        let part = along * unit.dot(&along);
        let error_m_s = (part * MAGNITUDE + (unit - part) * DIRECTION_RAD) * delta_v_m_s.norm();
        self.sensitivity.by_velocity(at_s).fixed_rows::<2>(0) * error_m_s
    }

    /// The manoeuvre that takes away what a miss seems to be.
    fn maneuver_m_s(&self, at_s: f64, miss_m: Vector2<f64>) -> Result<Vector, Failure> {
        let found = self.sensitivity.desired(at_s, miss_m.into());
        Ok(found.ok_or("found no velocity that moves the intercept")?.delta_v_m_s)
    }

    /// What the state seems to be off by moves the intercept by.
    fn estimate_m(&self, of: u64, at_s: f64) -> Vector2<f64> {
        let draw = self.draw(of);
        let partials = self.sensitivity.at(at_s);
        partials.fixed_view::<2, 3>(0, 0) * draw.position_m * POSITION_M
            + partials.fixed_view::<2, 3>(0, 3) * draw.velocity_m_s * VELOCITY_M_S
    }
}

impl Costs {
    /// With the departure cleaned up, and without.
    pub(super) fn of(fmu: &Fmu) -> Result<[Self; 2], Failure> {
        let leg = Leg::of(fmu, &FLYBY_2)?;
        let met = leg.met(&[])?;
        let target = Target::of(&leg, &met, &FLYBY_2)?;
        let brighter = leg.brighter(1.0 + SCALE).met(&[])?.sensitivity.encounter.plane;
        let by_scale_m =
            Vector2::new(brighter.b_t_m - target.aimpoint_m[0], brighter.b_r_m - target.aimpoint_m[1]);
        let motion = met.flight.rows.first().and_then(|row| row.motion).ok_or("found no motion")?;
        let departure_m_s = motion.from_sun.velocity_m_s.normalize() * DEPARTURE_M_S;
        let sensitivity = &met.sensitivity;
        let approach_s = sensitivity.encounter.time_s - APPROACH_S;
        let unit = Dispersions::default().with_state(&Matrix6::identity()).ok_or("found no root")?;
        let run = |run: u64, is_cleaned_up: bool| -> Result<[f64; 5], Failure> {
            let drawn = Drawn { sensitivity, unit, run };
            let mut miss_m = drawn.execution_m(0, 0.0, &departure_m_s);
            if is_cleaned_up {
                let clean_up_m_s =
                    drawn.maneuver_m_s(CLEAN_UP_S, miss_m + drawn.estimate_m(1, CLEAN_UP_S))?;
                miss_m = drawn.execution_m(2, CLEAN_UP_S, &clean_up_m_s) - drawn.estimate_m(1, CLEAN_UP_S);
            }
            miss_m += by_scale_m * drawn.draw(3).position_m.x;
            let estimate_m = drawn.estimate_m(4, approach_s);
            let approach_m_s = drawn.maneuver_m_s(approach_s, miss_m + estimate_m)?;
            let left_m = drawn.execution_m(5, approach_s, &approach_m_s) - estimate_m;
            let [approach, departure] = [approach_m_s.norm(), target.cost.cost_m_s(left_m.into())];
            let altitude_km = target.altitude_offset_m(left_m.into()).abs() / 1e3;
            Ok([approach, departure, approach + departure, left_m.norm() / 1e3, altitude_km])
        };
        let all = |is_cleaned_up: bool| -> Result<[Vec<f64>; 5], Failure> {
            let runs = (0..RUNS).map(|number| run(number, is_cleaned_up)).collect::<Result<Vec<_>, _>>()?;
            Ok(core::array::from_fn(|column| runs.iter().map(|run| run[column]).collect()))
        };
        Ok([
            Self { label: "departure cleaned up after 30 d", columns: all(true)? },
            Self { label: "departure not cleaned up", columns: all(false)? },
        ])
    }
}
