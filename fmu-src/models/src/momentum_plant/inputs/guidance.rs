//! Guidance that the plant follows by itself, from parameters and inputs; refuses what cannot be simulated, by name.

use fmi_export::Failure;
use nalgebra::Vector3;
use physics::bodies::BodyData;
use physics::environment::orbit::TwoBodyOrbit;
use physics::environment::orientation::Orientation;
use physics::guidance::constraints::keep_in::{KeepIn, KeepInMethod};
use physics::guidance::downlink::sun_direction::SunRequest;
use physics::guidance::pointing::boresight::Gimbal;
use physics::guidance::timeline::TimelineSettings;
use physics::guidance::{Guided, TargetPlanet};
use physics::management::Strategy;
use physics::plant::{self, Configuration, ReachedState, StartMotion, StartPointing};

use super::wheels;
use crate::common::downlink::ZERO_KEEP_IN_AXIS;
use crate::common::management::{check_strategy_has_antenna, check_windows, check_windows_have_antenna};
use crate::common::pointing::RuleContext;
use crate::common::spacecraft::start_attitude;
use crate::momentum_plant::setup::{Plan, Read};
use crate::momentum_plant::state::PlantState;
use crate::momentum_plant::variables::choices::StartAttitude;

/// The keep-in zone of commands.
fn zone(read: Read<'_>) -> Result<KeepIn, Failure> {
    let variables = read.variables;
    let v = &variables.keep_in;
    let axis_body = read.vector(v.axis);
    if axis_body == Vector3::zeros() {
        return Err(Failure::new(ZERO_KEEP_IN_AXIS));
    }
    Ok(KeepIn {
        axis_body,
        azimuth_rad: read.real(v.azimuth).min(core::f64::consts::FRAC_PI_2),
        elevation_rad: read.real(v.elevation),
        method: read.choice(v.method).0,
        distance_m: read.real(v.distance),
    })
}

/// The same where it is in force.
fn zone_in_force(read: Read<'_>) -> Result<Option<KeepIn>, Failure> {
    let zone = zone(read)?;
    Ok(read.boolean(read.variables.keep_in.enabled).then_some(zone))
}

/// Settings of the timeline about a centre of this rotation.
pub(super) fn timeline(
    read: Read<'_>,
    center: &BodyData,
    rotation: Option<Orientation>,
    clock_minus_time_s: f64,
) -> Result<TimelineSettings, Failure> {
    let variables = read.variables;
    let v = &variables.keep_in;
    let own = TargetPlanet::from_body(center);
    Ok(TimelineSettings {
        keep_in: zone(read)?,
        keep_in_is_enabled: read.boolean(v.enabled),
        planet: TargetPlanet { orientation: rotation.unwrap_or(own.orientation), ..own },
        clock_minus_time_s,
    })
}

/// The orbit phase's own guidance on this orbit, unmanaged.
fn law(read: Read<'_>, orbit: &TwoBodyOrbit) -> Result<Guided, Failure> {
    let variables = read.variables;
    let is_planet = read.choice(variables.orbit.center).0.is_planet();
    let period_s = if is_planet { orbit.period_s() } else { f64::INFINITY };
    let keep_in = KeepIn {
        axis_body: Vector3::new(0.0, -1.0, 0.0),
        azimuth_rad: read.real(variables.keep_in.azimuth),
        elevation_rad: read.real(variables.keep_in.elevation),
        method: KeepInMethod::Nearest,
        distance_m: f64::INFINITY,
    };
    let (periapsis_s, start_s) = (orbit.periapsis_epoch_s(0), read.real(variables.start.epoch));
    let gimbal = Gimbal::from_instruments(&read.setup.spacecraft.instruments);
    let law = variables.guided.read(read.values, [periapsis_s, period_s, start_s], keep_in, gimbal)?;
    let about = RuleContext {
        is_about_sun: !is_planet,
        panels: &read.setup.spacecraft.panels,
        zone: zone_in_force(read)?,
    };
    variables.guided.in_phase(read, &read.setup.guided, law, &about)
}

/// The attitude's source: commands, the orbit phase's own guidance, or the dynamics that follow one of them.
pub(super) fn attitude(
    read: Read<'_>,
    state: &PlantState,
    orbit: &TwoBodyOrbit,
) -> Result<plant::AttitudeSource, Failure> {
    let source = state.inputs.source;
    let guided = if source.guides_itself { Some(managed_law(read, state, orbit)?) } else { None };
    Ok(match guided {
        guided if source.is_dynamic => plant::AttitudeSource::Dynamic(guided),
        Some(guided) => plant::AttitudeSource::Guided(guided),
        None => plant::AttitudeSource::Commanded(state.saved.command),
    })
}

/// The orbit phase's own guidance, with the places of the Sun that management chose or inputs request.
fn managed_law(read: Read<'_>, state: &PlantState, orbit: &TwoBodyOrbit) -> Result<Guided, Failure> {
    let variables = read.variables;
    let law = law(read, orbit)?;
    let antennas = &read.setup.antennas.all;
    let strategy = read.choice(variables.momentum.strategy).0;
    let managed = strategy != Strategy::DumpsOnly;
    if !state.saved.waiting {
        check_windows_have_antenna(&law.schedule, antennas)?;
    }
    variables.guided.check_unload(read.values, managed)?;
    check_strategy_has_antenna(strategy, antennas)?;
    if managed && !state.saved.waiting {
        check_windows(&law.schedule)?;
    }
    let requested = if managed {
        SunRequest::default()
    } else {
        SunRequest { zone: zone_in_force(read)?, ..variables.downlink.request(read.values) }
    };
    Ok(Guided { managed, requested, ..law })
}

/// Warns once of targets on one line.
pub(crate) fn warn_degenerate(context: &Plan<'_>, reached: &ReachedState, warned: &mut bool, time_s: f64) {
    if reached.is_degenerate && !*warned {
        *warned = true;
        context.log.warning(&format!(
            "guided.degenerate: at {:?} s both targets of the attitude lie on one line; the north of EME2000, or along that its \
             equinox, stands in for the second one. Another second target (guided.constrain.target) or another guided.scienceRule \
             avoids it",
            time_s
        ));
    }
}

/// Whether start.q gives the attitude of a start by torque, and whether start.rate gives its rate where that does not.
fn given_at_start(read: Read<'_>) -> [bool; 2] {
    let start = &read.variables.start;
    let given = read.given_deliberately(&[start.q.into(), start.rate.into()]);
    let has_rate = given.has(start.rate);
    let is_given = match read.choice(start.attitude) {
        StartAttitude::Automatic => has_rate || given.has(start.q),
        StartAttitude::Guided => false,
        StartAttitude::Given => true,
    };
    [is_given, has_rate]
}

/// Reports by what a flight by torque starts where it does.
pub(crate) fn report_start(read: Read<'_>, state: &PlantState, start_s: f64) {
    let start = &read.variables.start;
    let ([is_given, has_rate], source) = (given_at_start(read), state.inputs.source);
    let pointed = match state.attitude_command() {
        _ if is_given => "in start.q at start.rate",
        Some(_) => "in the commanded attitude",
        None if source.is_commanded => "in start.q, as there is no command yet",
        None => "as the internal guidance points",
    };
    let by = match read.choice(start.attitude) {
        StartAttitude::Automatic if is_given => "automatic, and start.q or start.rate is set",
        StartAttitude::Automatic if read.values.is_set(start.q) && read.values.is_set(start.rate) => {
            read.log.warning(&format!(
                "the flight starts {pointed}: every parameter of the FMU was set, start.q and start.rate to their start values, \
                 which counts as not set; start.attitude given (3) starts in them"
            ));
            return;
        }
        StartAttitude::Automatic => "automatic, and neither start.q nor start.rate is set",
        StartAttitude::Guided if has_rate => "guided, the rate by start.rate",
        StartAttitude::Guided => "guided",
        StartAttitude::Given => "given",
    };
    if read.log.events_enabled() {
        read.log.event(start_s, &format!("the flight starts {pointed}: start.attitude is {by}"));
    }
}

/// Initial motion by start.attitude, start.q, start.rate and wheel[k].startMomentum.
pub(super) fn start_motion(
    read: Read<'_>,
    configuration: &Configuration,
    state: &PlantState,
) -> Result<StartMotion, Failure> {
    let start = &read.variables.start;
    let attitude = start_attitude(read.values, start.q)?;
    let [is_given, has_rate] = given_at_start(read);
    let pointing = match configuration.attitude.guided() {
        _ if is_given => None,
        Some(law) => Some(StartPointing::Guidance(Box::new(*law))),
        None if state.inputs.source.is_commanded => state.attitude_command().map(StartPointing::Command),
        None => Some(StartPointing::Guidance(Box::new(law(read, &configuration.orbit)?))),
    };
    Ok(StartMotion {
        attitude,
        rate_body_rad_s: read.vector(start.rate),
        pointing,
        rate_is_pointed: !has_rate,
        wheels_n_m_s: read.variables.wheel.iter().map(|it| wheels::start_n_m_s(read, it)).collect(),
    })
}
