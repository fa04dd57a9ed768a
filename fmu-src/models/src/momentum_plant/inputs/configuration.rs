//! From parameters, inputs and state to spacecraft, orbit and light of the simulation; refuses what cannot be simulated, by name.

use fmi_export::{Elements, Failure, InputsOverTime, Real, Values};
use nalgebra::Vector3;
use physics::bodies::{Body, BodyData};
use physics::constants;
use physics::environment::CartesianState;
use physics::environment::orbit::{Flattening, Gravity, TwoBodyOrbit};
use physics::environment::time;
use physics::guidance::constraints::keep_in::{KeepIn, KeepInMethod};
use physics::guidance::downlink::sun_place::{SunRequest, SunZone};
use physics::guidance::pointing::boresight::Gimbal;
use physics::guidance::timeline::TimelineSettings;
use physics::guidance::{Guided, TargetPlanet};
use physics::management::Strategy;
use physics::momentum::{DumpPolicy, Reinitialise, Settings};
use physics::plant::{
    self, Configuration, DynamicAttitude, Motion, PanelSetting, RadiationSettings, Ramp,
    ThrusterEventSettings,
};
use physics::spacecraft::PanelControl;

use super::air_and_field;
use super::center::Center;
use super::n_body;
use crate::common::center::CenterBody;
use crate::common::downlink::ZERO_KEEP_IN_AXIS;
use crate::common::ephemeris;
use crate::common::management::{check_strategy_has_antenna, check_windows, check_windows_have_antenna};
use crate::common::spacecraft::inertia_body_kg_m2;
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::state::PlantState;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::{
    AttitudeSource, DumpReinitTo, EphemerisSource, OrbitDynamics, OrbitSource,
};

/// The configuration that parameters, inputs and state describe, about `center` and in the memory of `panels`; angles of panels
/// move as the inputs do.
pub(super) fn read(
    context: &Plan<'_>,
    values: &Values,
    state: &PlantState,
    center: &Center,
    (over_time, mut panels): (InputsOverTime<'_>, Vec<PanelSetting>),
) -> Result<Configuration, Failure> {
    let variables = context.variables;
    let epoch_minus_time_s = time::epoch_minus_time_s(values.real(variables.start.epoch), state.start_s);
    let data = &center.data;
    let encounter = n_body::check(context, values, center)?;
    let switches = [variables.planet_light.enabled, variables.thermal.enabled];
    let inertia_body_kg_m2 = inertia_body_kg_m2(values, variables.spacecraft.inertia)?;
    let orbit = orbit(center, variables, values, state, epoch_minus_time_s)?;
    let limit_m = data.radius_m;
    let lowest_m = orbit.elements().periapsis_distance_m();
    if !state.inputs.orbit_is_given && lowest_m <= limit_m {
        return Err(Failure::new(format!(
            "orbit.semiMajorAxis, orbit.eccentricity: the periapsis at {lowest_m:.0} m lies inside {}, whose \
             planet.radius is {limit_m:.0} m",
            data.name
        )));
    }
    let epoch_s = values.real(variables.start.epoch);
    if !matches!(values.choice(variables.ephemeris_source), EphemerisSource::Inputs) {
        ephemeris::check_start(epoch_s)?;
    }
    let corridor = variables.articulation.read(values)?;
    let followed = context.setup.timeline.as_ref().filter(|_| values.boolean(variables.timeline.enabled));
    let clock_minus_time_s = followed.map_or(0.0, |it| it.clock_minus_time_s(epoch_minus_time_s));
    panels.clear();
    panels.extend(variables.panel.iter().enumerate().map(|(k, panel)| {
        if !values.boolean(panel.enabled) {
            return PanelSetting::Disabled;
        }
        let ramp = |input: Real| Ramp {
            angle_rad: values.real(input),
            rate_rad_s: over_time.rate(input, over_time.start_s()),
            since_s: over_time.start_s(),
        };
        let tilt_sign = values.choice(panel.tilt).sign();
        let offset = |offset| PanelSetting::SunOffset { offset, tilt_sign };
        match values.choice(panel.control).0 {
            PanelControl::Angle => PanelSetting::Angle(ramp(panel.angle)),
            PanelControl::SunOffset => offset(Ramp::held(values.real(panel.sun_offset))),
            PanelControl::Timeline => PanelSetting::Timeline {
                steps: followed.and_then(|_| context.setup.panel_steps.get(k).cloned()).unwrap_or_default(),
                clock_minus_time_s,
                before_rad: values.real(panel.sun_offset),
                tilt_sign,
            },
            PanelControl::Command => offset(ramp(panel.sun_offset_command)),
            PanelControl::Distance => PanelSetting::Distance { suns: corridor.target_suns, tilt_sign },
        }
    }));
    let by_planet = air_and_field::Followed::read(context, values, center.planet.body);
    let effects = variables.laws.active(switches, |switch| by_planet.is_on(values, switch));
    let figure = air_and_field::figure(context, values, &center.planet)?;
    let planet = &variables.planet;
    let laws = [
        (planet.gravitational_parameter, center.planet.gm_m3_s2),
        (planet.j2, center.planet.j2),
        (planet.j2_radius, center.planet.j2_radius_m),
    ];
    let of_planet = |real: Real| {
        laws.iter().find(|(own, _)| *own == real).map_or_else(|| values.real(real), |(_, value)| *value)
    };
    Ok(Configuration {
        epoch_minus_time_s,
        center: data.body,
        encounter,
        attitude: attitude(context, values, state, &orbit)?,
        timeline: followed.map(|_| timeline(context, values, data, clock_minus_time_s)).transpose()?,
        orbit,
        motion: motion(
            variables,
            values,
            &Center {
                data: air_and_field::at_start(context, values, data)?,
                planet: air_and_field::at_start(context, values, &center.planet)?,
                ..*center
            },
            time::epoch_at_s(state.orbit_since_s(), epoch_minus_time_s),
        ),
        ephemeris: ephemeris_source(&context.setup.bodies.body(data.body), context, values, state.waiting)?,
        air_and_field: air_and_field::read(context, values, center, effects)?,
        figure,
        light: variables.solar.read(values),
        shadow: variables.eclipse.read(values, center.planet.radius_m, values.real(variables.sun.radius))?,
        light_and_heat: RadiationSettings {
            storage: values.boolean(variables.thermal_storage),
            shadowing: values.boolean(variables.shadowing.enabled),
            sun_disc: values.boolean(variables.shadowing.sun_disc),
            grid_s: values.real(variables.solver.disturbance_step),
            tolerance: values.real(variables.solver.disturbance_tolerance),
        },
        sunshade: values.choice(variables.sunshade.shape).0,
        panels,
        center_of_mass_body_m: Vector3::from(values.vector(variables.spacecraft.center_of_mass)),
        mass_kg: values.real(variables.spacecraft.mass),
        inertia_body_kg_m2,
        effects,
        laws: variables.laws.read(values, laws.map(|(parameter, _)| parameter), of_planet),
        momentum: settings(context, values),
        thruster_events: ThrusterEventSettings {
            schedule: followed.map(|it| it.events().clone()).unwrap_or_default(),
            clock_minus_time_s,
            thrusters: values.choice(variables.maneuver.thrusters).0,
            dumps: values.boolean(variables.maneuver.dump),
            magnitude_error: values.real(variables.maneuver.magnitude_error),
            direction_error_rad: values.real(variables.maneuver.direction_error),
            center_of_mass_shift_m: Vector3::from(values.vector(variables.spacecraft.center_of_mass_shift)),
            seed: values.integer(variables.noise_seed).unsigned_abs().into(),
            requested_body_n_m_s: Vector3::from(values.vector(variables.dump.target)),
        },
    })
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

fn motion(variables: &PlantVariables, values: &Values, center: &Center, given_epoch_s: f64) -> Motion {
    let orbit = &variables.orbit;
    if matches!(values.choice(orbit.source), OrbitSource::Held) {
        return Motion::Held { state: given_state(variables, values), since_epoch_s: given_epoch_s };
    }
    let feedback = values.boolean(orbit.radiation_feedback);
    match values.choice(orbit.dynamics) {
        OrbitDynamics::TwoBody => return Motion::TwoBody,
        OrbitDynamics::NBody => {
            return Motion::NBody { gravity: n_body::gravity(variables, values, center), feedback };
        }
        OrbitDynamics::Disturbed => {}
    }
    let center = &center.data;
    let flattening = Flattening::of(center);
    let tide = center.body.is_planet() && values.boolean(orbit.sun_tide);
    let gravity = Gravity {
        mu_m3_s2: center.gm_m3_s2,
        flattening: (flattening.j2 != 0.0).then_some(flattening),
        tide_mu_m3_s2: tide.then_some(constants::GM_SUN_M3_S2),
    };
    Motion::Disturbed {
        gravity,
        segment_length_s: values.real(orbit.step),
        radius_m: center.radius_m,
        feedback,
    }
}

fn ephemeris_source(
    center: &CenterBody,
    context: &Plan<'_>,
    values: &Values,
    waiting: bool,
) -> Result<plant::EphemerisSource, Failure> {
    let variables = context.variables;
    let epoch_s = values.real(variables.start.epoch);
    Ok(match values.choice(variables.ephemeris_source) {
        EphemerisSource::Inputs => {
            let sun_m = Vector3::from(values.vector(variables.sun.position));
            let at_the_planet = center.data.body.is_planet() && sun_m == Vector3::from([0.0; 3]);
            if at_the_planet && !waiting {
                return Err(Failure::new(
                    "sun.position is not set: found (0, 0, 0) m, allowed: the Sun's position from the orbit's centre, which \
                     ephemeris.source = inputs asks for",
                ));
            }
            let given = |position, velocity| CartesianState {
                position_m: Vector3::from(values.vector(position)),
                velocity_m_s: Vector3::from(values.vector(velocity)),
            };
            plant::EphemerisSource::Given {
                sun: given(variables.sun.position, variables.sun.velocity),
                earth: given(variables.earth.position, variables.earth.velocity),
            }
        }
        EphemerisSource::Kepler => {
            let ellipse = &variables.ephemeris;
            plant::EphemerisSource::Kepler(ellipse.planet(context, values, center, epoch_s)?)
        }
        EphemerisSource::Chebyshev => match ephemeris::precise(context.setup.ephemeris.as_ref()) {
            Some(carried) => {
                ephemeris::check_onboard(carried, center.data.body, "start.epoch", epoch_s)?;
                n_body::check_onboard(variables, values, carried, "start.epoch", epoch_s)?;
                plant::EphemerisSource::Simulated(carried.clone())
            }
            None => without_table(center, "chebyshev")?,
        },
        EphemerisSource::Vsop87 => without_table(center, "vsop87")?,
    })
}

/// VSOP87, or the orbit of the body of the spacecraft's file.
fn without_table(center: &CenterBody, source: &str) -> Result<plant::EphemerisSource, Failure> {
    if center.data.body != Body::Custom {
        return Ok(plant::EphemerisSource::Vsop87);
    }
    ephemeris::custom(center, source).map(plant::EphemerisSource::Kepler)
}

/// The orbit phase's own guidance on this orbit, unmanaged.
pub(super) fn guidance_law(
    context: &Plan<'_>,
    values: &Values,
    orbit: &TwoBodyOrbit,
) -> Result<Guided, Failure> {
    let variables = context.variables;
    let is_planet = values.choice(variables.orbit.center).0.is_planet();
    let period_s = if is_planet { orbit.period_s() } else { f64::INFINITY };
    let keep_in = KeepIn {
        axis_body: Vector3::new(0.0, -1.0, 0.0),
        azimuth_rad: values.real(variables.keep_in.azimuth),
        elevation_rad: values.real(variables.keep_in.elevation),
        method: KeepInMethod::Nearest,
    };
    let (periapsis_s, start_s) = (orbit.periapsis_epoch_s(0), values.real(variables.start.epoch));
    let gimbal = Gimbal::of(&context.setup.spacecraft.instruments);
    let law = variables.guided.read(values, periapsis_s, period_s, start_s, keep_in, gimbal)?;
    Ok(variables.guided.in_phase(context, values, &context.setup.windows, (law, !is_planet)))
}

/// The keep-in zone of commands.
fn zone(variables: &PlantVariables, values: &Values) -> Result<KeepIn, Failure> {
    let v = &variables.keep_in;
    let axis_body = Vector3::from(values.vector(v.axis));
    if axis_body == Vector3::zeros() {
        return Err(Failure::new(ZERO_KEEP_IN_AXIS));
    }
    Ok(KeepIn {
        axis_body,
        azimuth_rad: values.real(v.azimuth).min(core::f64::consts::FRAC_PI_2),
        elevation_rad: values.real(v.elevation),
        method: values.choice(v.method).0,
    })
}

/// What the timeline goes by.
fn timeline(
    context: &Plan<'_>,
    values: &Values,
    center: &BodyData,
    clock_minus_time_s: f64,
) -> Result<TimelineSettings, Failure> {
    let variables = context.variables;
    let v = &variables.keep_in;
    let own = TargetPlanet::of(center);
    let turned = air_and_field::orientation(context, values, center)?;
    Ok(TimelineSettings {
        keep_in: zone(variables, values)?,
        keep_in_is_enabled: values.boolean(v.enabled),
        keep_in_distance_m: values.real(v.distance),
        planet: TargetPlanet { orientation: turned.unwrap_or(own.orientation), ..own },
        clock_minus_time_s,
    })
}

fn attitude(
    context: &Plan<'_>,
    values: &Values,
    state: &PlantState,
    orbit: &TwoBodyOrbit,
) -> Result<plant::AttitudeSource, Failure> {
    let variables = context.variables;
    let guided = || {
        let law = guidance_law(context, values, orbit)?;
        if !state.waiting {
            check_windows_have_antenna(&law.schedule, &context.setup.antennas.all)?;
        }
        let (strategy, choice) = (values.choice(variables.momentum.strategy).0, state.flight.sun_choice());
        let managed = strategy != Strategy::DumpsOnly;
        variables.guided.check_unload(values, managed)?;
        check_strategy_has_antenna(strategy, &context.setup.antennas.all)?;
        if managed && !state.waiting {
            check_windows(&law.schedule)?;
        }
        let law = law.with_sun_places(choice.place(), choice.in_science());
        let zone = SunZone {
            keep_in: zone(variables, values)?,
            distance_m: values.real(variables.keep_in.distance),
        };
        let zone = values.boolean(variables.keep_in.enabled).then_some(zone);
        let inputs = SunRequest { zone, ..variables.downlink.request(values) };
        let requested = if managed { SunRequest::default() } else { inputs };
        Ok::<_, Failure>(Guided { managed, requested, ..law })
    };
    let source = state.inputs.source;
    let guided = if source.guides_itself { Some(guided()?) } else { None };
    Ok(match guided {
        _ if source.is_dynamic => {
            let (motion, rate_terms_body) = (state.command, [Vector3::from([0.0; 3]); 2]);
            plant::AttitudeSource::Dynamic(DynamicAttitude { motion, rate_terms_body, guided })
        }
        Some(guided) => plant::AttitudeSource::Guided(guided),
        None => plant::AttitudeSource::Commanded(state.command),
    })
}

/// Whether no dump begins by itself: in free flight, where the master controls, unless thresholds are set.
fn is_left_to_master(context: &Plan<'_>, values: &Values) -> bool {
    let variables = context.variables;
    let is_free = matches!(values.choice(variables.attitude.source), AttitudeSource::Free);
    let dump = &variables.dump;
    let others = [dump.reinit_fraction, dump.required_spacing, dump.torque, dump.pulse_period];
    let [a, b, c, d] = others.map(Elements::from);
    let given = context.given(values, &[dump.threshold.into(), a, b, c, d]);
    is_free && !given.has(dump.threshold)
}

fn settings(context: &Plan<'_>, values: &Values) -> Settings {
    let variables = context.variables;
    let dump = &variables.dump;
    Settings {
        grid_s: values.real(variables.solver.step),
        tolerance: values.real(variables.solver.tolerance),
        convention: values.choice(variables.momentum.convention).0,
        policy: DumpPolicy {
            threshold_body_n_m_s: match is_left_to_master(context, values) {
                true => Vector3::repeat(f64::INFINITY),
                false => Vector3::from(values.vector(dump.threshold)),
            },
            reinitialise: match values.choice(dump.reinit_to) {
                DumpReinitTo::Target => {
                    Reinitialise::Target { momentum_body_n_m_s: Vector3::from(values.vector(dump.target)) }
                }
                DumpReinitTo::Opposite => {
                    Reinitialise::Opposite { fraction: values.real(dump.reinit_fraction) }
                }
            },
        },
    }
}
