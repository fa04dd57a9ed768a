//! Orbit and motion of the spacecraft, from parameters, inputs and state; refuses what cannot be simulated, by name.

use fmi_export::Failure;
use nalgebra::Matrix3;
use physics::bodies::Body;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::frames::Frame;
use physics::environment::orbit::{Attractor, GravityModel, NBodyGravity, OrbitError, TwoBodyOrbit};
use physics::environment::{CartesianState, time};
use physics::plant::{self, Motion};

use super::center::Center;
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::state::PlantState;
use crate::momentum_plant::variables::choices::{OrbitDynamics, OrbitSource};

/// Components in the frame of the elements to components in EME2000.
///
/// # Errors
/// A Sun line that nothing gives at the start.
pub(super) fn eme2000_from_frame(
    read: Read<'_>,
    center: &Center,
    source: &plant::EphemerisSource,
) -> Result<Matrix3<f64>, Failure> {
    let (variables, body) = (read.variables, &center.data);
    let is_of_sun = center.frame == Frame::SunLine;
    if is_of_sun && (body.body == Body::Sun || matches!(source, plant::EphemerisSource::Given { .. })) {
        return Err(Failure::new(
            "orbit.frame: found sunLine (5), allowed: with orbit.center sun (2) and with ephemeris.source inputs (3), which gives no \
             Sun at the start, another frame",
        ));
    }
    let sun = || {
        let mut ephemeris = Ephemeris::with_cache(&read.setup.ephemeris_cache);
        plant::sun_and_earth(body.body, source, &mut ephemeris, read.real(variables.start.epoch)).0
    };
    center.frame.dcm_eme2000_from_frame(body, sun).ok_or_else(|| {
        Failure::new(format!(
            "orbit.frame: found sunLine (5) about {}, which does not move about the Sun, allowed: another frame",
            body.name
        ))
    })
}

/// Parameters, inputs and state that orbit and motion are read from.
#[derive(Clone, Copy)]
pub(super) struct OrbitReader<'a> {
    pub read: Read<'a>,
    pub state: &'a PlantState,
    pub epoch_minus_time_s: f64,
}

impl OrbitReader<'_> {
    /// The orbit by its elements in `frame` about `center`, or by position and velocity that are set.
    pub(super) fn orbit(&self, center: &Center, frame: &Matrix3<f64>) -> Result<TwoBodyOrbit, Failure> {
        let orbit = self.unchecked_orbit(center, frame)?;
        let (limit_m, lowest_m) = (center.data.radius_m, orbit.periapsis_distance_m());
        if !self.state.inputs.orbit_is_given && lowest_m <= limit_m {
            return Err(Failure::new(format!(
                "orbit.semiMajorAxis, orbit.eccentricity: the periapsis at {lowest_m:.0} m lies inside {}, whose \
                 planet.radius is {limit_m:.0} m",
                center.data.name
            )));
        }
        Ok(orbit)
    }

    fn unchecked_orbit(&self, center: &Center, frame: &Matrix3<f64>) -> Result<TwoBodyOrbit, Failure> {
        let Self { read, state, epoch_minus_time_s } = *self;
        let (orbit, data) = (&read.variables.orbit, &center.data);
        match read.choice(orbit.source) {
            // Nothing is computed on it before position and velocity are set.
            OrbitSource::Inputs | OrbitSource::Held if state.saved.waiting => {
                circle(1e10, data.gm_m3_s2, epoch_minus_time_s)
            }
            source @ (OrbitSource::Inputs | OrbitSource::Held) => {
                let start = given_state(read);
                let epoch_s = self.given_epoch_s();
                let found = TwoBodyOrbit::from_state(&start, data.gm_m3_s2, epoch_s);
                if source == OrbitSource::Held && found.is_err() {
                    // It counts the downlinks alone.
                    return circle(start.position_m.norm(), data.gm_m3_s2, epoch_s);
                }
                found.map_err(|error| Failure::new(format!("orbit.position, orbit.velocity: {error}")))
            }
            OrbitSource::Elements => {
                let epoch_s = read.real(read.variables.start.epoch);
                let orbit = TwoBodyOrbit::from_elements(center.elements, data.gm_m3_s2, epoch_s);
                orbit.map(|orbit| orbit.along(frame)).map_err(|error| refused(&error))
            }
        }
    }

    /// The motion about `center`, whose pole is that of the start epoch, by `gravity` of all bodies where that is given.
    pub(super) fn motion(&self, center: &Center, gravity: Option<NBodyGravity>) -> Motion {
        let read = self.read;
        let orbit = &read.variables.orbit;
        if matches!(read.choice(orbit.source), OrbitSource::Held) {
            return Motion::Held { state: given_state(read), since_epoch_s: self.given_epoch_s() };
        }
        let feedback = read.boolean(orbit.radiation_feedback);
        if let Some(gravity) = gravity {
            return Motion::NBody { gravity, feedback };
        }
        if !matches!(read.choice(orbit.dynamics), OrbitDynamics::Disturbed) {
            return Motion::TwoBody;
        }
        let center = &center.data;
        let parent = center.parent.filter(|_| read.boolean(orbit.sun_tide));
        let has_moon = center.body == Attractor::MOON_PARENT && read.boolean(orbit.moon_tide);
        let tides = parent.map(|parent| Attractor::point_mass(parent.data())).into_iter();
        let tides = tides.chain(has_moon.then_some(Attractor::MOON));
        let attractors = [Attractor::flattened(center)].into_iter().chain(tides);
        Motion::Disturbed {
            gravity: GravityModel::new(center.body, attractors, false),
            segment_length_s: read.real(orbit.step),
            radius_m: center.radius_m,
            feedback,
        }
    }

    /// Epoch at which position and velocity were set, in s past J2000 TDB.
    fn given_epoch_s(&self) -> f64 {
        time::epoch_at_s(self.state.orbit_since_s(), self.epoch_minus_time_s)
    }
}

/// Position and velocity that are set.
fn given_state(read: Read<'_>) -> CartesianState {
    let variables = read.variables;
    CartesianState {
        position_m: read.vector(variables.orbit.position),
        velocity_m_s: read.vector(variables.orbit.velocity),
    }
}

/// Elements that are no orbit, by their parameters.
fn refused(error: &OrbitError) -> Failure {
    let instead = match error {
        OrbitError::Parabolic { .. } => {
            "; or orbit.source inputs (2), which takes orbit.position and orbit.velocity"
        }
        _ => "",
    };
    let named = "orbit.semiMajorAxis, orbit.eccentricity, orbit.trueAnomaly";
    Failure::new(format!("{named}: {error}{instead}"))
}

fn circle(radius_m: f64, gm_m3_s2: f64, epoch_s: f64) -> Result<TwoBodyOrbit, Failure> {
    TwoBodyOrbit::from_state(&CartesianState::on_circle(radius_m, gm_m3_s2), gm_m3_s2, epoch_s)
        .map_err(|error| Failure::new(format!("planet.gravitationalParameter, orbit.position: {error}")))
}
