//! Warnings of file, settings and flight for the log, and the default of the orbit's dynamics.

use fmi_export::{SetupValue, StartValue, Values};
use nalgebra::Vector3;
use physics::bodies::Body;
use physics::environment::CartesianState;
use physics::environment::orbit::{Elements, TwoBodyOrbit};
use physics::guidance::scenario::is_rolled_about_boresight;
use physics::guidance::timeline::TimelineLaw;
use physics::plant::{Flight, StepContext};
use physics::plausibility::{
    Figures, FlightSettings, FlightSurvey, WheelSettings, air_moves_orbit, warnings,
};

use crate::common::downlink::roll_warning;
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::air_and_field::AtmosphereMethod;
use crate::momentum_plant::variables::choices::OrbitSource;

/// The parameter whose default follows from the orbit.
const DYNAMICS: &str = "orbit.dynamics";

/// Whether the orbit of these values is one that more than the centre's gravity moves: about the file's own body, or in air.
fn is_disturbed(variables: &PlantVariables, values: &Values) -> bool {
    let (orbit, planet) = (&variables.orbit, &variables.planet);
    let center = values.choice(orbit.center).0;
    let periapsis_m = match values.choice(orbit.source) {
        OrbitSource::Held => return false,
        OrbitSource::Inputs => {
            let state = CartesianState {
                position_m: Vector3::from(values.vector(orbit.position)),
                velocity_m_s: Vector3::from(values.vector(orbit.velocity)),
            };
            let gm_m3_s2 = values.real(planet.gravitational_parameter);
            TwoBodyOrbit::from_state(&state, gm_m3_s2, 0.0).ok().map(|it| it.periapsis_distance_m())
        }
        OrbitSource::Elements => {
            let shape = Elements {
                eccentricity: values.real(orbit.eccentricity),
                ..Elements::circle(values.real(orbit.semi_major_axis), 0.0)
            };
            Some(shape.periapsis_distance_m())
        }
    };
    let has_air = match values.choice(variables.atmosphere.method) {
        AtmosphereMethod::Exponential => values.real(variables.atmosphere.reference_density) > 0.0,
        AtmosphereMethod::Nrlmsise00 | AtmosphereMethod::Given => true,
    };
    let acts = has_air && center.is_planet() && values.boolean(variables.laws.aerodynamics.enabled);
    let radius_m = values.real(planet.radius);
    center == Body::Custom || periapsis_m.is_some_and(|it_m| air_moves_orbit(acts, it_m, radius_m))
}

/// Declares `orbit.dynamics` disturbed where the file's orbit is, unless the file gives it.
pub(crate) fn following_dynamics(variables: &PlantVariables, start: &Values) -> Option<StartValue> {
    let is_open = !start.is_set(variables.orbit.dynamics);
    (is_open && is_disturbed(variables, start)).then(|| StartValue {
        key: DYNAMICS.to_owned(),
        line: None,
        model: None,
        is_fixed: false,
        name: DYNAMICS.to_owned(),
        value: SetupValue::Text("disturbed".to_owned()),
    })
}

/// Warns of settings that are hardly meant where the flight begins at `time_s`.
pub(crate) fn report(read: Read<'_>, flight: &Flight, given: StepContext<'_>, time_s: f64) {
    let Some(configuration) = flight.configuration() else { return };
    let (v, spacecraft) = (read.variables, &read.setup.spacecraft);
    let figures = Figures::new(spacecraft);
    let wheels: Vec<WheelSettings> = v
        .wheel
        .iter()
        .map(|it| WheelSettings {
            capacity_n_m_s: read.real(it.capacity),
            inertia_kg_m2: read.real(it.inertia),
            axis_body: read.vector(it.axis),
        })
        .collect();
    let (orbit, method, dynamics) = (&v.orbit, v.atmosphere.method, v.orbit.dynamics);
    let angles = [
        ("orbit.ascendingNode", orbit.ascending_node),
        ("orbit.periapsisArgument", orbit.periapsis_argument),
        ("orbit.trueAnomaly", orbit.true_anomaly),
        ("ephemeris.ascendingNode", v.ephemeris.ascending_node),
        ("ephemeris.periapsisArgument", v.ephemeris.periapsis_argument),
        ("ephemeris.trueAnomaly", v.ephemeris.true_anomaly),
    ];
    let weather = &v.space_weather;
    let settings = FlightSettings {
        figures: &figures,
        configuration,
        epoch_s: read.real(v.start.epoch),
        wheels: &wheels,
        angles_rad: &angles.map(|(name, angle)| (name, read.real(angle))),
        f107: [("spaceWeather.f107", weather.f107), ("spaceWeather.f107Average", weather.f107_average)]
            .map(|(name, flux)| (name, read.real(flux))),
        chooses_air: read.given_deliberately(&[method.into()]).has(method),
        has_default_dynamics: !read.given_deliberately(&[dynamics.into()]).has(dynamics),
    };
    let survey = FlightSurvey::new(flight, given, spacecraft, time_s);
    let timeline = given.prepared.timeline.filter(|_| configuration.timeline.is_some());
    let rolled = timeline.and_then(|TimelineLaw { timeline, hardware }| {
        timeline.entries.iter().find(|entry| is_rolled_about_boresight(&entry.command, &hardware))
    });
    let rolled =
        rolled.map(|entry| roll_warning(&format!("the command in line {} of the timeline", entry.line)));
    let found = warnings(spacecraft, &figures).into_iter();
    let found = found.chain(settings.warnings()).chain(survey.warnings(spacecraft)).chain(rolled);
    found.for_each(|text| read.log.warning(&text));
}
