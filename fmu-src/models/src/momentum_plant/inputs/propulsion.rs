//! From parameters and inputs to thrusters, tanks and delta-v; refuses what cannot be simulated, by name.

use fmi_export::{Failure, Step};
use nalgebra::Vector3;
use physics::plant::{
    DynamicsInputs, Flight, Purpose, ReactionControlSettings, SimulationContext, UnservedDumps,
};
use physics::propulsion::{PulseCommand, ThrustErrors};
use physics::spacecraft::{Tank, Thruster};

use crate::momentum_plant::setup::{Plan, Read};
use crate::momentum_plant::state::ThrusterWarnings;

/// Thrusters and tanks as parameters set them.
pub(crate) fn reaction_control(read: Read<'_>) -> Result<ReactionControlSettings, Failure> {
    let v = read.variables;
    let spacecraft = &read.setup.spacecraft;
    let thrusters = spacecraft.thrusters.iter().zip(&v.thruster).map(|(thruster, variables)| Thruster {
        valve: variables.valve.read(read.values),
        scatter: read.real(variables.scatter),
        ..thruster.clone()
    });
    let tanks = spacecraft.tanks.iter().zip(&v.tank).map(|(tank, variables)| Tank {
        propellant_kg: read.real(variables.propellant),
        pressure_pa: read.real(variables.pressure),
        ..tank.clone()
    });
    let settings = ReactionControlSettings {
        thrusters: thrusters.collect(),
        tanks: tanks.collect(),
        errors: ThrustErrors {
            misalignment_rad: read.real(v.thrust.misalignment),
            drift_rad_s: read.real(v.thrust.drift),
            jitter_rad: read.real(v.thrust.jitter),
            seed: read.count(v.noise_seed).into(),
        },
        dump_torque_n_m: read.real(v.dump.torque),
        dump_period_s: read.real(v.dump.pulse_period),
    };
    for (k, tank) in settings.tanks.iter().enumerate() {
        let [least_pa, greatest_pa] = tank.allowed_pa;
        if !(least_pa..=greatest_pa).contains(&tank.pressure_pa) {
            return Err(Failure::new(format!(
                "tank[{}].pressure: found {:?} Pa, allowed: {least_pa:?} to {greatest_pa:?} Pa, the range of tank {}",
                k.saturating_add(1),
                tank.pressure_pa,
                tank.name
            )));
        }
    }
    Ok(settings)
}

/// Refuses tanks that hold more than there is.
pub(crate) fn check(flight: &Flight) -> Result<(), Failure> {
    let Some(SimulationContext { configuration, allocator, .. }) = flight.context() else { return Ok(()) };
    let mass_kg = &configuration.wet_mass.mass_kg;
    let held_kg: f64 = allocator.settings.tanks.iter().map(|tank| tank.propellant_kg).sum();
    if held_kg >= *mass_kg {
        return Err(Failure::new(format!(
            "tank[k].propellant: found {held_kg:?} kg in all tanks, allowed: less than spacecraft.mass = {mass_kg:?} kg, of which \
             it is a part"
        )));
    }
    Ok(())
}

/// Reports once that a dump found no thrusters, and once that those it found were not fed.
pub(crate) fn warn_unserved(context: &Plan<'_>, flight: &Flight, warned: &mut ThrusterWarnings, time_s: f64) {
    let thrusters = flight.thrusters();
    let UnservedDumps { unfed, one_sided } = thrusters.unserved;
    if unfed == 0 && one_sided == 0 {
        return;
    }
    let Some((flown, evaluation)) = flight.context().zip(flight.evaluation()) else { return };
    let settings = &flown.allocator.settings;
    if unfed > 0 && !warned.unfed {
        warned.unfed = true;
        let (tanks, propellant) = (settings.tanks.iter().enumerate(), &thrusters.propellant);
        let dry = tanks.filter(|(k, it)| !it.feeds(propellant.used_kg(*k, time_s)));
        let names: Vec<&str> = dry.map(|(_, tank)| tank.name.as_str()).collect();
        context.log.warning(&format!(
            "dump.count: nothing feeds the thrusters that give torque about every axis both ways (tank[k].feeds is false of {}); a \
             dump goes as far as there is propellant for it, and without any it is not carried out and does not count",
            names.join(", ")
        ));
    }
    if warned.unserved || one_sided == 0 {
        return;
    }
    let center_of_mass_body_m = evaluation.mass.center_of_mass_body_m;
    if let Err(error) = settings.selection(Purpose::Dump, &|_| true, &center_of_mass_body_m) {
        warned.unserved = true;
        context.log.warning(&format!(
            "dump.count: {error} (centerOfMass = {:?} m); dumps are as those of a file without [[thrusters]]: at once in guided \
             and commanded flight, by dump.torque in controlled and free flight, without propellant",
            center_of_mass_body_m.as_slice()
        ));
    }
}

/// Warns once each of a step's commands to thrusters that are not carried out.
pub(crate) fn warn(
    context: &Plan<'_>,
    inputs: &DynamicsInputs,
    settings: &ReactionControlSettings,
    warned: &mut ThrusterWarnings,
    step: &Step<'_>,
) {
    if !warned.cut {
        let is_cut = |pulse: &PulseCommand| pulse.is_cut(step.start_s, step.end_s);
        if let Some(k) = inputs.pulses.iter().position(is_cut) {
            warned.cut = true;
            context.log.warning(&format!(
                "thruster[{}].onDelay and onTime reach beyond the step from {} to {} s: the pulse is cut there, and others \
                 like it",
                k.saturating_add(1),
                step.start_s,
                step.end_s
            ));
        }
    }
    if let Some(set) = inputs.thrust.set
        && !warned.no_set
        && settings.thrusters.iter().all(|thruster| thruster.set != Some(set))
    {
        warned.no_set = true;
        let sets = &context.setup.spacecraft.thruster_sets;
        let name = sets.get(usize::from(set.0)).map_or("an unknown set", String::as_str);
        context.log.warning(&format!(
            "thrust.request asks for {name}, which no thruster of {} belongs to (key set of [[thrusters]]): nothing fires",
            context.setup.spacecraft.name
        ));
    }
}

/// A maneuver that adds no velocity is none, and is reported.
pub(crate) fn drop_empty_maneuver(context: &Plan<'_>, inputs: &mut DynamicsInputs, time_s: f64) {
    let is_empty = inputs.maneuver.is_some_and(|it| it.delta_v_inertial_m_s == Vector3::from([0.0; 3]));
    if is_empty {
        inputs.maneuver = None;
        context.log.warning(&format!(
            "maneuver.request rose at {time_s:?} s with maneuver.deltaV = (0, 0, 0) m/s: nothing is executed, and no dump with it"
        ));
    }
}
