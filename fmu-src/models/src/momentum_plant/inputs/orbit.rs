//! Orbit and motion of the spacecraft, from parameters, inputs and state; refuses what cannot be simulated, by name.

use fmi_export::{Failure, Values};
use nalgebra::Vector3;
use physics::bodies::Body;
use physics::environment::CartesianState;
use physics::environment::orbit::{Flattening, Gravity, NBodyGravity, Tides, TwoBodyOrbit};
use physics::environment::time;
use physics::plant::{self, Motion};

use super::center::Center;
use crate::momentum_plant::state::PlantState;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::{OrbitDynamics, OrbitSource};

/// The orbit by its elements about `center`, and the motion on it about the same centre with the pole of the start epoch, by
/// `gravity` of all bodies where that is given.
pub(super) fn read(
    variables: &PlantVariables,
    values: &Values,
    state: &PlantState,
    [center, turned]: [&Center; 2],
    (gravity, epoch_minus_time_s): (Option<NBodyGravity>, f64),
) -> Result<(TwoBodyOrbit, Motion), Failure> {
    let orbit = orbit(center, variables, values, state, epoch_minus_time_s)?;
    let (limit_m, lowest_m) = (center.data.radius_m, orbit.periapsis_distance_m());
    if !state.inputs.orbit_is_given && lowest_m <= limit_m {
        return Err(Failure::new(format!(
            "orbit.semiMajorAxis, orbit.eccentricity: the periapsis at {lowest_m:.0} m lies inside {}, whose \
             planet.radius is {limit_m:.0} m",
            center.data.name
        )));
    }
    let given_epoch_s = time::epoch_at_s(state.orbit_since_s(), epoch_minus_time_s);
    Ok((orbit, motion(variables, values, turned, (gravity, given_epoch_s))))
}

/// Position and velocity that are set.
fn given_state(variables: &PlantVariables, values: &Values) -> CartesianState {
    CartesianState {
        position_m: Vector3::from(values.vector(variables.orbit.position)),
        velocity_m_s: Vector3::from(values.vector(variables.orbit.velocity)),
    }
}

fn orbit(
    center: &Center,
    variables: &PlantVariables,
    values: &Values,
    state: &PlantState,
    epoch_minus_time_s: f64,
) -> Result<TwoBodyOrbit, Failure> {
    let (orbit, data) = (&variables.orbit, &center.data);
    match values.choice(orbit.source) {
        // Nothing is computed on it before position and velocity are set.
        OrbitSource::Inputs | OrbitSource::Held if state.waiting => {
            circle(1e10, data.gm_m3_s2, epoch_minus_time_s)
        }
        source @ (OrbitSource::Inputs | OrbitSource::Held) => {
            let start = given_state(variables, values);
            let epoch_s = time::epoch_at_s(state.orbit_since_s(), epoch_minus_time_s);
            let found = TwoBodyOrbit::from_state(&start, data.gm_m3_s2, epoch_s);
            if source == OrbitSource::Held && found.is_err() {
                // It counts the downlinks alone.
                return circle(start.position_m.norm(), data.gm_m3_s2, epoch_s);
            }
            found.map_err(|error| Failure::new(format!("orbit.position, orbit.velocity: {error}")))
        }
        OrbitSource::Elements => {
            let epoch_s = values.real(variables.start.epoch);
            plant::orbit_from_elements(center.elements, center.frame, data, data.gm_m3_s2, epoch_s)
                .map_err(|error| Failure::new(format!("orbit elements: {error}")))
        }
    }
}

fn circle(radius_m: f64, gm_m3_s2: f64, epoch_s: f64) -> Result<TwoBodyOrbit, Failure> {
    TwoBodyOrbit::from_state(&CartesianState::on_circle(radius_m, gm_m3_s2), gm_m3_s2, epoch_s)
        .map_err(|error| Failure::new(format!("planet.gravitationalParameter, orbit.position: {error}")))
}

fn motion(
    variables: &PlantVariables,
    values: &Values,
    center: &Center,
    (gravity, given_epoch_s): (Option<NBodyGravity>, f64),
) -> Motion {
    let orbit = &variables.orbit;
    if matches!(values.choice(orbit.source), OrbitSource::Held) {
        return Motion::Held { state: given_state(variables, values), since_epoch_s: given_epoch_s };
    }
    let feedback = values.boolean(orbit.radiation_feedback);
    if let Some(gravity) = gravity {
        return Motion::NBody { gravity, feedback };
    }
    if !matches!(values.choice(orbit.dynamics), OrbitDynamics::Disturbed) {
        return Motion::TwoBody;
    }
    let center = &center.data;
    let flattening = Flattening::of(center);
    Motion::Disturbed {
        gravity: Gravity {
            mu_m3_s2: center.gm_m3_s2,
            flattening: (flattening.j2 != 0.0).then_some(flattening),
        },
        tides: Tides {
            sun: center.body.is_planet() && values.boolean(orbit.sun_tide),
            moon: center.body == Body::Earth && values.boolean(orbit.moon_tide),
        },
        segment_length_s: values.real(orbit.step),
        radius_m: center.radius_m,
        feedback,
    }
}
