//! The orbit ahead of a sample: the spacecraft on its present orbit, Sun and Earth by the planet's and the Earth's orbits about
//! the Sun.
//!
//! Equation: two-body motion through position and velocity at the sample, about the target planet and about the Sun. What is
//! on no ellipse about the Sun, such as a Sun that is given without a velocity, moves evenly.
//! Error measure: the planets' pull on one another is left out; Sun and Earth stand off by less than 3e-5 rad after four days
//! about Mercury, Venus and Mars (tested).

use nalgebra::Vector3;

use super::attitudes::LinesOfSight;
use crate::attitude::MovingUnit;
use crate::constants::GM_SUN_M3_S2;
use crate::environment::CartesianState;
use crate::environment::orbit::TwoBodyOrbit;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{MovingVector, rate, value};

/// Everything about the planet at other epochs than the sample's.
#[derive(Clone, Copy, Debug)]
pub struct OrbitAhead<'a> {
    now: &'a EphemerisAtTime,
    spacecraft: TwoBodyOrbit,
    planet_from_sun: BodyAhead,
    earth_from_sun: BodyAhead,
}

/// Motion of a body about the Sun.
#[derive(Clone, Copy, Debug)]
struct BodyAhead {
    epoch_s: f64,
    state: CartesianState,
    ellipse: Option<TwoBodyOrbit>,
}

impl<'a> OrbitAhead<'a> {
    /// From where everything is now; `None` where the spacecraft is on no ellipse about the planet.
    pub fn of(now: &'a EphemerisAtTime) -> Option<Self> {
        let state = |position: MovingVector| CartesianState {
            position_m: value(&position),
            velocity_m_s: rate(&position),
        };
        Some(Self {
            now,
            spacecraft: ellipse_of(now)?,
            planet_from_sun: BodyAhead::of(state(-now.sun), now.epoch_s),
            earth_from_sun: BodyAhead::of(state(now.earth - now.sun), now.epoch_s),
        })
    }

    /// Period of the spacecraft's orbit, in s.
    pub fn period_s(&self) -> f64 {
        self.spacecraft.period_s()
    }

    /// Spacecraft, Sun and Earth at an epoch.
    pub fn at(&self, epoch_s: f64) -> EphemerisAtTime {
        let spacecraft = self.spacecraft.state_at(epoch_s);
        let planet = self.planet_from_sun.at(epoch_s);
        let earth = self.earth_from_sun.at(epoch_s) - planet;
        let sun = CartesianState::default() - planet;
        EphemerisAtTime::new(epoch_s, self.now.planet, &spacecraft, &sun, &earth)
    }
}

impl BodyAhead {
    fn of(state: CartesianState, epoch_s: f64) -> Self {
        let ellipse = TwoBodyOrbit::from_state(&state, GM_SUN_M3_S2, epoch_s).ok();
        Self { epoch_s, state, ellipse: ellipse.filter(|orbit| orbit.period_s().is_finite()) }
    }

    fn at(&self, epoch_s: f64) -> CartesianState {
        let evenly = || CartesianState {
            position_m: self.state.position_m + self.state.velocity_m_s * (epoch_s - self.epoch_s),
            ..self.state
        };
        self.ellipse.map_or_else(evenly, |ellipse| ellipse.state_at(epoch_s))
    }
}

/// The present orbit about the planet, if it is an ellipse.
pub fn ellipse_of(surroundings: &EphemerisAtTime) -> Option<TwoBodyOrbit> {
    let state = CartesianState {
        position_m: value(&surroundings.position),
        velocity_m_s: value(&surroundings.velocity),
    };
    let orbit = TwoBodyOrbit::from_state(&state, surroundings.planet.gm_m3_s2, surroundings.epoch_s).ok();
    orbit.filter(|orbit| orbit.period_s().is_finite())
}

/// Directions from the spacecraft with their rates; a body at zero distance counts as lying toward +X.
pub fn lines_of_sight(surroundings: &EphemerisAtTime) -> LinesOfSight {
    let unit = |vector: &MovingVector| {
        MovingUnit::of(value(vector), rate(vector))
            .unwrap_or(MovingUnit { direction: Vector3::x(), rate_1_s: Vector3::zeros() })
    };
    LinesOfSight {
        sun: unit(&surroundings.to_sun()),
        planet: Some(unit(&surroundings.to_planet())),
        earth: unit(&surroundings.to_earth()),
        sun_from_planet: Some(CartesianState {
            position_m: value(&surroundings.sun),
            velocity_m_s: rate(&surroundings.sun),
        }),
    }
}

#[cfg(test)]
mod tests {
    //! Sun and Earth against VSOP87, the spacecraft against its motion integrated step by step.
    use super::*;
    use crate::attitude::angle_between_rad;
    use crate::bodies::Body;
    use crate::environment::bodies_from_center::{BodiesFromCenter, fixed};
    use crate::environment::ephemeris::Ephemeris;
    use crate::guidance::TargetPlanet;

    const EPOCH_S: f64 = 2.9e8;
    const DAY_S: f64 = 86_400.0;

    fn start() -> CartesianState {
        CartesianState {
            position_m: Vector3::new(3.0e6, -1.0e6, 2.0e6),
            velocity_m_s: Vector3::new(900.0, 2_400.0, 500.0),
        }
    }

    fn surroundings(center: Body, sun: &CartesianState, earth: &CartesianState) -> EphemerisAtTime {
        EphemerisAtTime::new(EPOCH_S, TargetPlanet::of(center.data()), &start(), sun, earth)
    }

    #[test]
    fn sun_and_earth_stand_where_the_theory_has_them() {
        let (mut ephemeris, mut worst_rad) = (Ephemeris::default(), 0.0_f64);
        for center in [Body::Mercury, Body::Venus, Body::Mars] {
            let bodies = BodiesFromCenter { center, ellipse: None };
            let (sun, earth) = bodies.sun_and_earth(&mut ephemeris, EPOCH_S);
            let now = surroundings(center, &sun, &earth);
            let ahead = OrbitAhead::of(&now).unwrap();
            for days in [0.5, 1.0, 4.0] {
                let epoch_s = EPOCH_S + days * DAY_S;
                let (sun, earth) = bodies.sun_and_earth(&mut ephemeris, epoch_s);
                let then = ahead.at(epoch_s);
                for (found, expected) in [(then.sun, sun), (then.earth, earth)] {
                    let off_rad = angle_between_rad(&value(&found), &expected.position_m);
                    worst_rad = worst_rad.max(off_rad);
                    // The Moon swings the Earth by 13 m/s.
                    let speed_m_s = (rate(&found) - expected.velocity_m_s).norm();
                    assert!(speed_m_s < 26.0, "{center:?} {days}: {speed_m_s}");
                }
            }
        }
        assert!((1e-6..3e-5).contains(&worst_rad), "{worst_rad:e}");
    }

    #[test]
    fn the_spacecraft_falls_about_its_planet() {
        let still = fixed(Vector3::new(6e10, 0.0, 0.0));
        let now = surroundings(Body::Mercury, &still, &still);
        let (mut r, mut v) = (start().position_m, start().velocity_m_s);
        // Leapfrog, of second order.
        let (step_s, steps) = (0.5, 8_000);
        let pull = |r: &Vector3<f64>| r * (-now.planet.gm_m3_s2 / r.norm().powi(3));
        for _ in 0..steps {
            v += pull(&r) * (0.5 * step_s);
            r += v * step_s;
            v += pull(&r) * (0.5 * step_s);
        }
        let ahead = OrbitAhead::of(&now).unwrap();
        let then = ahead.at(EPOCH_S + step_s * f64::from(steps));
        assert!((value(&then.position) - r).norm() < 1.0, "{:?} {r:?}", then.position);
        // What is given without a velocity stands still.
        assert_eq!(value(&then.sun), still.position_m);
        assert_eq!(value(&then.earth), still.position_m);
    }

    #[test]
    fn what_escapes_has_no_orbit_ahead() {
        let still = fixed(Vector3::new(6e10, 0.0, 0.0));
        let mut now = surroundings(Body::Mercury, &still, &still);
        now.velocity *= crate::guidance::geometry::moving::Moving::from_re(10.0);
        assert!(OrbitAhead::of(&now).is_none());
    }
}
