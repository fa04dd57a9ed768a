//! From parameters, inputs and state to spacecraft, orbit and light of the simulation; refuses what cannot be simulated, by name.

use fmi_export::{Elements, Failure, Real, Values};
use nalgebra::Vector3;
use physics::environment::time;
use physics::momentum::{DumpPolicy, Reinitialise, Settings};
use physics::plant::{Configuration, RadiationSettings, ThrusterEventSettings};

use super::center::Center;
use super::orbit::OrbitReader;
use super::panels::{self, ActiveTimeline, MovingPanels};
use super::{air_and_field, ephemeris_source, guidance, n_body, orbit, wheels};
use crate::common::ephemeris;
use crate::common::spacecraft::inertia_body_kg_m2;
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::state::PlantState;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::{AttitudeSource, DumpReinitTo, EphemerisSource};

/// The configuration that parameters, inputs and state describe, about `center`.
pub(super) fn read(
    context: &Plan<'_>,
    values: &Values,
    state: &PlantState,
    center: &Center,
    moving: MovingPanels<'_>,
) -> Result<Configuration, Failure> {
    let variables = context.variables;
    let epoch_s = values.real(variables.start.epoch);
    let epoch_minus_time_s = time::epoch_minus_time_s(epoch_s, state.saved.start_s);
    let momentum = settings(context, values);
    if !matches!(values.choice(variables.ephemeris_source), EphemerisSource::Inputs) {
        ephemeris::check_start(epoch_s)?;
    }
    let inertia_body_kg_m2 = inertia_body_kg_m2(values, variables.spacecraft.inertia)?;
    center.check_density()?;
    let planet = air_and_field::read(context, values, center)?;
    let (gravity, encounter) = n_body::read(context, values, &planet.center)?;
    let ephemeris = ephemeris_source::read(context, values, center.data.body, state.saved.waiting)?;
    let frame = orbit::eme2000_from_frame(context, values, center, &ephemeris)?;
    let reader = OrbitReader { variables, values, state, epoch_minus_time_s };
    let orbit = reader.orbit(center, &frame)?;
    let motion = reader.motion(&planet.center, gravity);
    let timeline = ActiveTimeline::read(context, values, epoch_minus_time_s);
    let panels = panels::read(context, values, moving, &timeline)?;
    let v = &variables.planet;
    let laws = [
        (v.gravitational_parameter, center.planet.gm_m3_s2),
        (v.j2, center.planet.j2),
        (v.j2_radius, center.planet.j2_radius_m),
    ];
    let of_planet = |real: Real| {
        laws.iter().find(|(own, _)| *own == real).map_or_else(|| values.real(real), |(_, value)| *value)
    };
    let attitudes = timeline.law.map(|_| {
        guidance::timeline(variables, values, &center.data, planet.rotation, timeline.clock_minus_time_s)
    });
    Ok(Configuration {
        epoch_minus_time_s,
        center: center.data.body,
        center_radius_m: center.data.radius_m,
        eme2000_from_orbit_frame: frame,
        encounter,
        attitude: guidance::attitude(context, values, state, &orbit)?,
        timeline: attitudes.transpose()?,
        orbit,
        motion,
        ephemeris,
        air_and_field: planet.air_and_field,
        figure: planet.figure,
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
        effects: planet.effects,
        laws: variables.laws.read(values, laws.map(|(parameter, _)| parameter), of_planet),
        momentum,
        thruster_events: thruster_events(variables, values, &timeline),
    })
}

/// Maneuvers and dumps of the timeline and by request.
fn thruster_events(
    variables: &PlantVariables,
    values: &Values,
    timeline: &ActiveTimeline<'_>,
) -> ThrusterEventSettings {
    ThrusterEventSettings {
        schedule: timeline.law.map(|it| it.events().clone()).unwrap_or_default(),
        clock_minus_time_s: timeline.clock_minus_time_s,
        thrusters: values.choice(variables.maneuver.thrusters).0,
        dumps: values.boolean(variables.maneuver.dump),
        magnitude_error: values.real(variables.maneuver.magnitude_error),
        direction_error_rad: values.real(variables.maneuver.direction_error),
        center_of_mass_shift_m: Vector3::from(values.vector(variables.spacecraft.center_of_mass_shift)),
        seed: values.integer(variables.noise_seed).unsigned_abs().into(),
        requested_body_n_m_s: Vector3::from(values.vector(variables.dump.target)),
    }
}

/// Whether dumps begin by the master alone: in free flight, unless thresholds are set.
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
            bias_body_n_m_s: wheels::bias_body_n_m_s(context, values),
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
