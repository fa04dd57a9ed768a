//! Settings of a flight that can be, but are hardly meant: a table with a row for each.

use nalgebra::Vector3;

use super::figures::Figures;
use crate::bodies::{Body, sphere_of_influence_m};
use crate::environment::atmosphere::CEILING_M;
use crate::loads::Effect;
use crate::plant::{Configuration, EphemerisSource, Motion};
use crate::toml::dates;

/// Least part by which shadows change force or torque of sunlight where it is odd to leave them out.
const SHADOWED: f64 = 0.2;
/// Least change of the torque, as a part of the force times the largest dimension.
const SHADOWED_ARM: f64 = 0.01;
/// Greatest dipole of a spacecraft over its mass, in A.m2/kg.
const DIPOLE_A_M2_KG: f64 = 0.1;
/// Greatest momentum of a wheel over the spacecraft's mass, in N.m.s/kg.
const WHEEL_N_M_S_KG: f64 = 1.0;
/// Greatest part of the body's inertia about its axis that a rotor has.
const ROTOR: f64 = 0.1;
/// The Sun's flux at 10.7 cm was never below 60, in 1e-22 W/(m2 Hz).
const LEAST_F107: f64 = 40.0;
/// Julian dates of 1858 to 2132.
const JULIAN_DATES: [f64; 2] = [2.4e6, 2.5e6];

/// One wheel as it is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSettings {
    /// Greatest momentum, in N m s.
    pub capacity_n_m_s: f64,
    /// Inertia of the rotor about its axis, in kg m2.
    pub inertia_kg_m2: f64,
    /// Its axis in the body frame, of any length.
    pub axis_body: Vector3<f64>,
}

/// Settings of a flight where it begins.
#[derive(Clone, Copy, Debug)]
pub struct FlightSettings<'a> {
    /// Figures of the file.
    pub figures: &'a Figures,
    /// Configuration of the flight.
    pub configuration: &'a Configuration,
    /// Epoch of the start, in s past J2000 TDB.
    pub epoch_s: f64,
    /// Wheels as they are set.
    pub wheels: &'a [WheelSettings],
    /// Angles that are set, by name, in rad.
    pub angles_rad: &'a [(&'static str, f64)],
    /// Solar fluxes at 10.7 cm by name, in 1e-22 W/(m2 Hz).
    pub f107: [(&'static str, f64); 2],
    /// Whether a model of the air was chosen.
    pub chooses_air: bool,
    /// Whether nobody gave the dynamics of the orbit.
    pub has_default_dynamics: bool,
}

type Row = fn(&FlightSettings<'_>, &mut Vec<String>);

/// Each warning.
const ROWS: [Row; 10] = [
    angles,
    julian_date,
    beyond_influence,
    unmoved_by_air,
    air_without_effect,
    solar_flux,
    shadows,
    dipole,
    wheels,
    rotors,
];

impl FlightSettings<'_> {
    /// One sentence each; none where everything looks right.
    pub fn warnings(&self) -> Vec<String> {
        let mut found = Vec::new();
        ROWS.iter().for_each(|row| row(self, &mut found));
        found
    }
}

/// Whether air, where it acts, moves an orbit of this periapsis about a body of this radius, both in m.
pub fn air_moves_orbit(acts: bool, periapsis_distance_m: f64, radius_m: f64) -> bool {
    acts && periapsis_distance_m - radius_m < CEILING_M
}

fn angles(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let beyond = of.angles_rad.iter().filter(|(_, angle_rad)| angle_rad.abs() > core::f64::consts::TAU);
    found.extend(beyond.map(|(name, angle_rad)| {
        let meant_rad = angle_rad.to_radians();
        format!(
            "{name} is {angle_rad} rad, more than a turn: is it in deg? {angle_rad} deg are {meant_rad:.6} rad"
        )
    }));
}

fn julian_date(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let [from, to] = JULIAN_DATES;
    if (from..to).contains(&of.epoch_s) {
        found.push(format!(
            "start.epoch is {} s past J2000 TDB, which is {}: is it a Julian date? Write the date, or seconds past J2000",
            of.epoch_s,
            dates::utc(of.epoch_s)
        ));
    }
}

fn beyond_influence(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let Configuration { center, orbit, motion, ephemeris, .. } = of.configuration;
    let elements = orbit.elements();
    let is_alone = matches!(motion, Motion::TwoBody | Motion::Disturbed { .. });
    let Some(parent) = center.data().parent.filter(|_| is_alone && elements.eccentricity < 1.0) else {
        return;
    };
    let axis_m = match ephemeris {
        EphemerisSource::Kepler(planet) => planet.elements().semi_major_axis_m,
        _ => center.data().orbit_semi_major_axis_m,
    };
    let sphere_m = sphere_of_influence_m(orbit.mu_m3_s2(), axis_m, parent);
    let apoapsis_m = elements.semi_major_axis_m * (1.0 + elements.eccentricity);
    if axis_m > 0.0 && apoapsis_m > sphere_m {
        found.push(format!(
            "the orbit reaches {:.0} km from {}, whose sphere of influence ends at {:.0} km: beyond, the Sun moves the \
             spacecraft; set orbit.center = sun, or orbit.dynamics = nBody, or check orbit.semiMajorAxis (m, not km)",
            apoapsis_m / 1e3,
            center.data().name,
            sphere_m / 1e3
        ));
    }
}

fn unmoved_by_air(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let Configuration { center, motion, orbit, effects, shadow, .. } = of.configuration;
    let acts = effects.has(Effect::Aerodynamic);
    let is_in_air = air_moves_orbit(acts, orbit.periapsis_distance_m(), shadow.planet_radius_m());
    let is_moved = *center == Body::Custom || is_in_air;
    if of.has_default_dynamics && is_moved && matches!(motion, Motion::TwoBody) {
        let why = if is_in_air { "lies in air that moves it" } else { "is about the body of the file" };
        found.push(format!(
            "orbit.dynamics is twoBody, the default of this FMU, and the orbit as set {why}: orbit.* set later changes no default; \
             set orbit.dynamics = disturbed, or the orbit in the file or with pack --set"
        ));
    }
}

fn air_without_effect(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    if of.chooses_air && !of.configuration.effects.has(Effect::Aerodynamic) {
        found.push(
            "atmosphere.method is set and without effect, as no air acts: set aerodynamics.enabled = true"
                .to_owned(),
        );
    }
}

fn solar_flux(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let low = of.f107.iter().filter(|(_, flux)| *flux < LEAST_F107);
    found.extend(low.map(|(name, flux)| {
        format!(
            "{name} is {flux}, and the Sun's flux is 65 to 300: set it in solar flux units, 1e-22 W/(m2 Hz)"
        )
    }));
}

fn shadows(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let figures = of.figures;
    if of.configuration.light_and_heat.shadowing {
        return;
    }
    let Some(([force, torque], [shadowed_force, shadowed_torque])) =
        figures.solar.zip(figures.shadowed_solar).map(|(a, b)| (<[_; 2]>::from(a), <[_; 2]>::from(b)))
    else {
        return;
    };
    let size_m = (figures.greatest_body_m - figures.least_body_m).max();
    let [force_n, force_changes_n] = [force.norm(), (shadowed_force - force).norm()];
    let [torque_n_m, torque_changes_n_m] = [torque.norm(), (shadowed_torque - torque).norm()];
    let force_share = force_changes_n / force_n;
    let torque_share = torque_changes_n_m / torque_n_m;
    let arm_share = torque_changes_n_m / (force_n * size_m);
    let what = if force_share >= SHADOWED {
        format!("force of sunlight by {:.0} %", 100.0 * force_share)
    } else if torque_share >= SHADOWED && arm_share > SHADOWED_ARM {
        format!(
            "torque of sunlight by {:.0} %, {:.1} % of force times largest dimension",
            100.0 * torque_share,
            100.0 * arm_share
        )
    } else {
        return;
    };
    found.push(format!(
        "shadows of the surfaces on one another are off, and change the {what}, the Sun on -Y: set shadowing.enabled = true"
    ));
}

fn dipole(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let (laws, mass_kg) = (&of.configuration.laws, of.configuration.wet_mass.mass_kg);
    let dipole_a_m2 = laws.dipole_body_a_m2.norm();
    if dipole_a_m2 > DIPOLE_A_M2_KG * mass_kg {
        found.push(format!(
            "dipole.residual of {dipole_a_m2} A.m2 is {:.3} A.m2/kg, and spacecraft have 1e-4 to 0.01: set it in A.m2, not in mA.m2",
            dipole_a_m2 / mass_kg
        ));
    }
}

fn wheels(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let mass_kg = of.configuration.wet_mass.mass_kg;
    let heavy = of.wheels.iter().enumerate().filter(|(_, it)| it.capacity_n_m_s > WHEEL_N_M_S_KG * mass_kg);
    found.extend(heavy.map(|(k, it)| {
        format!(
            "wheel[{}].capacity of {} N.m.s is {:.3} N.m.s for each kg of the spacecraft, and wheels have 0.001 to 0.1: set it in \
             N.m.s, not in mN.m.s",
            k + 1,
            it.capacity_n_m_s,
            it.capacity_n_m_s / mass_kg
        )
    }));
}

fn rotors(of: &FlightSettings<'_>, found: &mut Vec<String>) {
    let inertia_kg_m2 = of.configuration.wet_mass.inertia_body_kg_m2;
    for (k, wheel) in of.wheels.iter().enumerate() {
        let Some(axis) = wheel.axis_body.try_normalize(0.0) else { continue };
        let own_kg_m2 = axis.dot(&(inertia_kg_m2 * axis));
        if wheel.inertia_kg_m2 > ROTOR * own_kg_m2 {
            found.push(format!(
                "wheel[{}].inertia of {} kg.m2 is {:.2} of the spacecraft's {own_kg_m2:.3} kg.m2 about its axis: set that of the \
                 rotor alone",
                k + 1,
                wheel.inertia_kg_m2,
                wheel.inertia_kg_m2 / own_kg_m2
            ));
        }
    }
}
