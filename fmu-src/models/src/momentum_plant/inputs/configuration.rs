//! From parameters, inputs and state to spacecraft, orbit and light of the simulation; refuses what cannot be simulated, by name.

use fmi_export::{Elements, Failure, Real};
use nalgebra::Vector3;
use physics::environment::time;
use physics::momentum::{DumpPolicy, Reinitialise, Settings};
use physics::plant::{Configuration, RadiationSettings, ThrusterEventSettings};
use physics::spacecraft::MassProperties;

use super::center::Center;
use super::orbit::OrbitReader;
use super::panels::{self, ActiveTimeline, MovingPanels};
use super::{air_and_field, ephemeris_source, guidance, n_body, orbit, wheels};
use crate::common::ephemeris;
use crate::common::spacecraft::inertia_body_kg_m2;
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::state::PlantState;
use crate::momentum_plant::variables::choices::{AttitudeSource, DumpReinitTo, EphemerisSource};

/// The configuration that parameters, inputs and state describe, about `center`.
pub(super) fn read(
    read: Read<'_>,
    state: &PlantState,
    center: &Center,
    moving: MovingPanels<'_>,
) -> Result<Configuration, Failure> {
    let variables = read.variables;
    let epoch_s = read.real(variables.start.epoch);
    let epoch_minus_time_s = time::epoch_minus_time_s(epoch_s, state.saved.start_s);
    let momentum = settings(read);
    if !matches!(read.choice(variables.ephemeris_source), EphemerisSource::Inputs) {
        ephemeris::check_start(epoch_s)?;
    }
    let inertia_body_kg_m2 = inertia_body_kg_m2(read.values, variables.spacecraft.inertia)?;
    center.check_density()?;
    let planet = air_and_field::read(read, center)?;
    let (gravity, encounter) = n_body::read(read, &planet.center)?;
    let ephemeris = ephemeris_source::read(read, center.data.body, state.saved.waiting)?;
    let frame = orbit::eme2000_from_frame(read, center, &ephemeris)?;
    let reader = OrbitReader { read, state, epoch_minus_time_s };
    let orbit = reader.orbit(center, &frame)?;
    let motion = reader.motion(&planet.center, gravity);
    let timeline = ActiveTimeline::read(read, epoch_minus_time_s);
    let panels = panels::read(read, moving, &timeline)?;
    let v = &variables.planet;
    let laws = [
        (v.gravitational_parameter, center.planet.gm_m3_s2),
        (v.j2, center.planet.j2),
        (v.j2_radius, center.planet.j2_radius_m),
    ];
    let of_planet = |real: Real| {
        laws.iter().find(|(own, _)| *own == real).map_or_else(|| read.real(real), |(_, value)| *value)
    };
    let attitudes = timeline
        .law
        .map(|_| guidance::timeline(read, &center.data, planet.rotation, timeline.clock_minus_time_s));
    Ok(Configuration {
        epoch_minus_time_s,
        center: center.data.body,
        center_radius_m: center.data.radius_m,
        eme2000_from_orbit_frame: frame,
        encounter,
        attitude: guidance::attitude(read, state, &orbit)?,
        timeline: attitudes.transpose()?,
        orbit,
        motion,
        ephemeris,
        air_and_field: planet.air_and_field,
        figure: planet.figure,
        light: variables.solar.read(read.values),
        shadow: variables.eclipse.read(
            read.values,
            center.planet.radius_m,
            read.real(variables.sun.radius),
        )?,
        light_and_heat: RadiationSettings {
            storage: read.boolean(variables.thermal_storage),
            shadowing: read.boolean(variables.shadowing.enabled),
            sun_disc: read.boolean(variables.shadowing.sun_disc),
            grid_s: read.real(variables.solver.disturbance_step),
            tolerance: read.real(variables.solver.disturbance_tolerance),
        },
        sunshade: read.choice(variables.sunshade.shape).0,
        panels,
        wet_mass: MassProperties {
            center_of_mass_body_m: read.vector(variables.spacecraft.center_of_mass),
            mass_kg: read.real(variables.spacecraft.mass),
            inertia_body_kg_m2,
        },
        effects: planet.effects,
        laws: variables.laws.read(read.values, laws.map(|(parameter, _)| parameter), of_planet),
        momentum,
        thruster_events: thruster_events(read, &timeline),
    })
}

/// Maneuvers and dumps of the timeline and by request.
fn thruster_events(read: Read<'_>, timeline: &ActiveTimeline<'_>) -> ThrusterEventSettings {
    let variables = read.variables;
    ThrusterEventSettings {
        schedule: timeline.law.map(|it| it.events.clone()).unwrap_or_default(),
        clock_minus_time_s: timeline.clock_minus_time_s,
        thrusters: read.choice(variables.maneuver.thrusters).0,
        dumps: read.boolean(variables.maneuver.dump),
        magnitude_error: read.real(variables.maneuver.magnitude_error),
        direction_error_rad: read.real(variables.maneuver.direction_error),
        center_of_mass_shift_m: read.vector(variables.spacecraft.center_of_mass_shift),
        seed: read.count(variables.noise_seed).into(),
        requested_body_n_m_s: read.vector(variables.dump.target),
    }
}

/// Whether dumps begin by the master alone: in free flight, unless thresholds are set.
fn is_left_to_master(read: Read<'_>) -> bool {
    let variables = read.variables;
    let is_free = matches!(read.choice(variables.attitude.source), AttitudeSource::Free);
    let dump = &variables.dump;
    let others = [dump.reinit_fraction, dump.required_spacing, dump.torque, dump.pulse_period];
    let [a, b, c, d] = others.map(Elements::from);
    let given = read.given(&[dump.threshold.into(), a, b, c, d]);
    is_free && !given.has(dump.threshold)
}

fn settings(read: Read<'_>) -> Settings {
    let variables = read.variables;
    let dump = &variables.dump;
    Settings {
        grid_s: read.real(variables.solver.step),
        tolerance: read.real(variables.solver.tolerance),
        convention: read.choice(variables.momentum.convention).0,
        policy: DumpPolicy {
            bias_body_n_m_s: wheels::bias_body_n_m_s(read),
            threshold_body_n_m_s: match is_left_to_master(read) {
                true => Vector3::repeat(f64::INFINITY),
                false => read.vector(dump.threshold),
            },
            reinitialise: match read.choice(dump.reinit_to) {
                DumpReinitTo::Target => {
                    Reinitialise::Target { momentum_body_n_m_s: read.vector(dump.target) }
                }
                DumpReinitTo::Opposite => {
                    Reinitialise::Opposite { fraction: read.real(dump.reinit_fraction) }
                }
            },
        },
    }
}
