//! The departure velocity of a leg, by shooting.
//!
//! Equation: q(v) = (B.T, B.R, w (t* - t)) = q*, with t the time of the closest approach, t* the one requested, w the speed far from the
//! body; v the velocity at the start.
//! Method: Lambert's arc to the body's centre and B. Without the body's gravity its end is moved by what the flight misses it by.
//! With it, Newton's method; the first matrix is that of two bodies, d(r)/d(v) along T, R and the asymptote S, each later one has
//! what the last flight was different by (Broyden's rank one).
//! Error measure: B and w (t* - t) of a flight against the aimpoint.
//! Reference: Battin, Introduction to the Mathematics and Methods of Astrodynamics, 1999, ch. 9; Broyden, Mathematics of Computation 19,
//! 1965.

use inputs::leg::{ArcBranch, FlybyAimpoint};
use nalgebra::{Matrix3, Vector3};
use physics::{
    constants::{DAY_S, GM_SUN_M3_S2},
    environment::{
        CartesianState,
        frames::dcm_eme2000_from_ecliptic,
        orbit::{OrbitError, TwoBodyOrbit},
    },
};

use super::{
    aimpoint::{b_m, impact_parameter_m},
    approach::{Approach, Encounter},
};
use crate::{
    Failure,
    orbit::{LambertArc, LambertError},
};

/// Most flights without the body's gravity; they end where they are this near to their place, as a share of B.
const UNATTRACTED_ROUNDS: u32 = 12;
const UNATTRACTED_SHARE: f64 = 0.02;
/// Most flights with it.
const ROUNDS: u32 = 25;
/// Largest change of velocity of a round, as a share of it.
const LARGEST_CHANGE: f64 = 0.02;
/// Longest leg, in s: ten years, for flights take time in proportion.
pub const MAX_LEG_S: f64 = 10.0 * 365.25 * 86_400.0;
/// Greatest speed at either end of an arc, in m/s: a thousandth of that of light, and more than any fall into the Sun from rest gives.
const MAX_SPEED_M_S: f64 = 3e5;
/// Share of the velocity by which it is varied for the first matrix.
const VARIATION: f64 = 1e-6;

/// Departure, aim and limits of a leg.
#[derive(Clone, Debug, PartialEq)]
pub struct LegTask {
    /// Position at the departure, from the Sun, EME2000, m.
    pub position_m: Vector3<f64>,
    /// When, s of the flight.
    pub start_s: f64,
    /// When the closest approach shall be, s of the flight.
    pub arrival_s: f64,
    /// Aimpoint at the body.
    pub aimpoint: FlybyAimpoint,
    /// How long before the closest approach the hyperbola of B osculates, s.
    pub lead_s: f64,
    /// Whole revolutions about the Sun, and which of both arcs where there are any.
    pub revolutions: Option<(u32, ArcBranch)>,
    /// Velocity before the departure, which says in which sense the leg goes around; otherwise as planets do. EME2000, m/s.
    pub velocity_before_m_s: Option<Vector3<f64>>,
    /// The body at the arrival, from the Sun, EME2000.
    pub body: CartesianState,
    /// Gravitational parameter of the body, m3/s2.
    pub mu_m3_s2: f64,
    /// Its radius, m.
    pub radius_m: f64,
    /// How near B comes to the aimpoint, m; the time of arrival comes so near in the way of that time.
    pub tolerance_m: f64,
}

/// Flights of a mission from the leg's place with any velocity.
pub trait SimulatesLeg {
    /// The place at the time of arrival, from the Sun, EME2000, in m, of a flight that the body does not attract.
    ///
    /// # Errors
    /// A flight that is refused.
    fn unattracted_m(&mut self, velocity_m_s: &Vector3<f64>) -> Result<Vector3<f64>, Failure>;

    /// A flight to the body.
    ///
    /// # Errors
    /// A flight that is refused.
    fn approach(&mut self, velocity_m_s: &Vector3<f64>) -> Result<Approach, Failure>;

    /// Reports what is done.
    fn progress(&mut self, doing: &str);
}

/// A leg that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Velocity at the start, EME2000, m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Velocity of Lambert's arc to the body's centre.
    pub lambert_m_s: Vector3<f64>,
    /// Encounter of the last flight.
    pub encounter: Encounter,
    /// Miss of the aimpoint by that flight, along T and R, m.
    pub miss_m: [f64; 2],
    /// Flights, those without the body's gravity first.
    pub rounds: [u32; 2],
}

/// Why there is no leg.
#[derive(Debug, thiserror::Error)]
pub enum LegError {
    /// No arc.
    #[error(transparent)]
    Lambert(#[from] LambertError),
    /// An arc that takes too great a speed.
    #[error(
        "found an arc of {days:.3} d with {speed_km_s:.1} km/s at an end, allowed: up to {} km/s, an arrival later",
        1e-3 * MAX_SPEED_M_S
    )]
    Fast {
        /// Its time, in d.
        days: f64,
        /// Greatest speed at an end of it, in km/s.
        speed_km_s: f64,
    },
    /// An aimpoint inside the body.
    #[error(
        "found |B| of {found_km:.1} km, with {excess_speed_m_s:.1} m/s far from the body: the path ends in it, allowed: above {least_km:.1} km"
    )]
    Inside {
        /// Length of B, km.
        found_km: f64,
        /// Length of B of a path that touches the body, km.
        least_km: f64,
        /// Speed far from the body, m/s.
        excess_speed_m_s: f64,
    },
    /// Flights that do not come near.
    #[error(
        "found no flight nearer to the aim than {miss_km:.3} km, of {rounds}, allowed: an encounter that can be reached from this place"
    )]
    Lost {
        /// How many.
        rounds: u32,
        /// Least that one missed it by, km.
        miss_km: f64,
    },
    /// An orbit about Sun or body that is none.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
    /// A flight that was refused.
    #[error("{0}")]
    Flight(Failure),
}

/// Axes T, R and S of the B-plane by the velocity far from the body, as rows.
fn axes(excess_m_s: &Vector3<f64>) -> Matrix3<f64> {
    let s = excess_m_s.normalize();
    let t = s.cross(&(dcm_eme2000_from_ecliptic() * Vector3::z())).normalize();
    Matrix3::from_rows(&[t.transpose(), s.cross(&t).transpose(), s.transpose()])
}

impl LegTask {
    fn arc(&self, to_m: Vector3<f64>) -> LambertArc {
        let north = self.velocity_before_m_s.map_or_else(
            || dcm_eme2000_from_ecliptic() * Vector3::z(),
            |velocity_m_s| self.position_m.cross(&velocity_m_s),
        );
        let time_s = self.arrival_s - self.start_s;
        LambertArc { from_m: self.position_m, to_m, time_s, north, mu_m3_s2: GM_SUN_M3_S2 }
    }

    /// Velocities at both ends of the arc to a place.
    fn lambert_m_s(&self, to_m: Vector3<f64>) -> Result<[Vector3<f64>; 2], LambertError> {
        let arc = self.arc(to_m);
        let found = match self.revolutions {
            Some((revolutions, branch)) if revolutions > 0 => arc.revolving(revolutions, branch)?,
            _ => arc.direct()?,
        };
        Ok([found.from_m_s, found.to_m_s])
    }

    /// Refuses an aimpoint whose path ends in the body.
    fn check_aimpoint(&self, excess_speed_m_s: f64) -> Result<(), LegError> {
        let found_m = b_m(&self.aimpoint, excess_speed_m_s, self.mu_m3_s2, self.radius_m).norm();
        let least_m = impact_parameter_m(self.radius_m, excess_speed_m_s, self.mu_m3_s2);
        let [found_km, least_km] = [found_m, least_m].map(|size_m| 1e-3 * size_m);
        // Not a number is no aim either.
        if found_m > least_m {
            Ok(())
        } else {
            Err(LegError::Inside { found_km, least_km, excess_speed_m_s })
        }
    }

    /// Returns the distance of an encounter from the aimpoint along T and R, and along S by its time, m.
    fn lacks_m(&self, found: &Encounter) -> Vector3<f64> {
        let lacks = match self.aimpoint {
            FlybyAimpoint::Plane { .. } => {
                b_m(&self.aimpoint, found.excess_speed_m_s, self.mu_m3_s2, self.radius_m) - found.b_m
            }
            FlybyAimpoint::Altitude { altitude_m, angle_rad } => {
                // The altitude is that of the flight, which is not the hyperbola's of the lead time.
                let size_m = found.b_m.norm();
                let speed_m_s = found.excess_speed_m_s;
                let size_of = |altitude_m: f64| {
                    impact_parameter_m((self.radius_m + altitude_m).max(0.0), speed_m_s, self.mu_m3_s2)
                };
                let needed_m = size_m + size_of(altitude_m) - size_of(found.altitude_m);
                let (sine, cosine) = angle_rad.sin_cos();
                nalgebra::Vector2::new(cosine, sine) * needed_m - found.b_m
            }
        };
        let late_s = found.arrival_s - self.arrival_s;
        Vector3::new(lacks.x, lacks.y, late_s * found.excess_speed_m_s)
    }

    /// How the place at arrival changes with the velocity at the start between two bodies, s.
    fn transition_s(&self, velocity_m_s: &Vector3<f64>) -> Result<Matrix3<f64>, OrbitError> {
        let step_m_s = VARIATION * velocity_m_s.norm();
        let end_m = |velocity_m_s: Vector3<f64>| -> Result<Vector3<f64>, OrbitError> {
            let state = CartesianState { position_m: self.position_m, velocity_m_s };
            let orbit = TwoBodyOrbit::from_state(&state, GM_SUN_M3_S2, self.start_s)?;
            Ok(orbit.state_at(self.arrival_s).position_m)
        };
        let column = |axis: usize| -> Result<Vector3<f64>, OrbitError> {
            let change = Vector3::ith(axis, step_m_s);
            Ok((end_m(velocity_m_s + change)? - end_m(velocity_m_s - change)?) / (2.0 * step_m_s))
        };
        Ok(Matrix3::from_columns(&[column(0)?, column(1)?, column(2)?]))
    }
}

/// Finds the velocity at the start with which the flight meets the aimpoint.
///
/// # Errors
/// No arc, an aimpoint inside the body, flights that are refused or do not come near.
pub fn shoot(task: &LegTask, flights: &mut dyn SimulatesLeg) -> Result<Leg, LegError> {
    flights.progress("Lambert's arc");
    let body = &task.body;
    let [lambert_m_s, end_m_s] = task.lambert_m_s(body.position_m)?;
    let speed_m_s = lambert_m_s.norm().max(end_m_s.norm());
    if speed_m_s > MAX_SPEED_M_S {
        let days = (task.arrival_s - task.start_s) / DAY_S;
        return Err(LegError::Fast { days, speed_km_s: 1e-3 * speed_m_s });
    }
    let mut excess_m_s = end_m_s - body.velocity_m_s;
    task.check_aimpoint(excess_m_s.norm())?;

    let mut velocity_m_s = lambert_m_s;
    let mut offset_m = Vector3::zeros();
    let mut unattracted = 0;
    while unattracted < UNATTRACTED_ROUNDS {
        let b_m = b_m(&task.aimpoint, excess_m_s.norm(), task.mu_m3_s2, task.radius_m);
        let place_m = body.position_m + axes(&excess_m_s).transpose() * b_m.push(0.0);
        let [from_m_s, to_m_s] = task.lambert_m_s(place_m + offset_m)?;
        (velocity_m_s, excess_m_s) = (from_m_s, to_m_s - body.velocity_m_s);
        flights.progress("without the body's gravity");
        let missed_m = place_m - flights.unattracted_m(&velocity_m_s).map_err(LegError::Flight)?;
        unattracted += 1;
        if missed_m.norm() < UNATTRACTED_SHARE * b_m.norm() {
            break;
        }
        offset_m += missed_m;
    }

    let mut matrix_s = axes(&excess_m_s) * task.transition_s(&velocity_m_s)?;
    let mut last: Option<(Vector3<f64>, Vector3<f64>)> = None;
    let mut least_m = f64::INFINITY;
    for round in 1..=ROUNDS {
        flights.progress("to the body");
        let approach = flights.approach(&velocity_m_s).map_err(LegError::Flight)?;
        let encounter = approach.encounter(task.lead_s)?;
        let lacks_m = task.lacks_m(&encounter);
        least_m = least_m.min(lacks_m.norm());
        if lacks_m.norm() <= task.tolerance_m {
            let miss_m = [-lacks_m.x, -lacks_m.y];
            let rounds = [unattracted, round];
            return Ok(Leg { velocity_m_s, lambert_m_s, encounter, miss_m, rounds });
        }
        if let Some((before_m, change_m_s)) = last {
            let different_m = before_m - lacks_m - matrix_s * change_m_s;
            matrix_s += different_m * change_m_s.transpose() / change_m_s.norm_squared();
        }
        let change_m_s = matrix_s.lu().solve(&lacks_m).filter(|change| change.norm().is_finite());
        let Some(mut change_m_s) = change_m_s else { break };
        let most_m_s = LARGEST_CHANGE * velocity_m_s.norm();
        change_m_s *= (most_m_s / change_m_s.norm()).min(1.0);
        last = Some((lacks_m, change_m_s));
        velocity_m_s += change_m_s;
    }
    Err(LegError::Lost { rounds: ROUNDS, miss_km: 1e-3 * least_m })
}
