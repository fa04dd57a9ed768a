//! Constraints in force on a Mercury orbit: the rate stays the derivative of the attitude, for every aimpoint and scenario.

use super::constrained::Constraints;
use super::hot_pole::HotPole;
use super::keep_in::{KeepIn, KeepInMethod};
use crate::attitude::SunAngles;
use crate::guidance::geometry::moving::{unit, value};
use crate::guidance::pointing::command::{ExternalRollOption, PointingCommand, Scenario};
use crate::guidance::scenario::scenario_tests::{
    FLOOR_RAD_S, SCENARIOS, STEP_S, aimpoint, command, every, hardware,
};
use crate::guidance::scenario::{PointingProgress, pointing_solution};
use crate::guidance::tests::orbit::{TestOrbit, rate_error};
use crate::guidance::{EphemerisAtTime, Pointing, PointingVectors};
use nalgebra::Vector3;

/// Steps over which the constrained law has to keep its form, in both directions.
const STENCIL: [f64; 6] = [-4.0, -2.0, -1.0, 1.0, 2.0, 4.0];

fn zone(method: KeepInMethod) -> Constraints {
    Constraints {
        keep_in: Some(KeepIn {
            axis_body: Vector3::new(0.1, -1.0, 0.05),
            azimuth_rad: 0.05,
            elevation_rad: 0.03,
            method,
            distance_m: f64::INFINITY,
        }),
        hot_pole: None,
    }
}

fn hot_pole() -> Constraints {
    Constraints { keep_in: None, hot_pole: Some(HotPole { altitude_m: 1e9, angle_rad: 4.0, cone_rad: 1.9 }) }
}

/// Which form the constrained law has: what is in force, and at which corner or edge of the zone the Sun stands.
fn form(
    constraints: &Constraints,
    vectors: &PointingVectors,
    ephemeris: &EphemerisAtTime,
) -> Option<(Pointing, [i8; 4])> {
    let found = constraints.applied(vectors, ephemeris, None)?;
    let sun_body = found.pointing.to_body(&unit(&ephemeris.to_sun())?);
    let edge = constraints.keep_in.filter(|_| found.sun_keep_in).map_or([0; 2], |zone| {
        let SunAngles { azimuth_rad, elevation_rad } = zone.angles(&value(&sun_body)).unwrap();
        let side = |angle_rad: f64, limit_rad: f64| {
            if angle_rad.abs() > limit_rad - 1e-9 { angle_rad.signum() as i8 } else { 0 }
        };
        [side(azimuth_rad, zone.azimuth_rad), side(elevation_rad, zone.elevation_rad)]
    });
    let [azimuth, elevation] = edge;
    Some((
        found.pointing,
        [
            i8::from(found.sun_keep_in),
            i8::from(found.hot_pole.is_some()) + 2 * i8::from(found.hot_pole_reached),
            azimuth,
            elevation,
        ],
    ))
}

/// Largest ratio of rate error to rate where the form stays, and how many instants were compared with the constraint in
/// force.
fn worst(
    constraints: &Constraints,
    vectors: impl Fn(&EphemerisAtTime, f64) -> Option<PointingVectors>,
    orbit: &TestOrbit,
) -> (f64, usize) {
    let (mut worst, mut compared) = (0.0_f64, 0);
    for time_s in orbit.times_s() {
        let at = |at_s: f64| {
            let ephemeris = orbit.ephemeris(at_s);
            form(constraints, &vectors(&ephemeris, at_s - time_s)?, &ephemeris)
        };
        let Some((_, here)) = at(time_s) else { continue };
        let in_force = here[0] != 0 || here[1] == 1;
        let stays = |step: &f64| at(time_s + step * STEP_S).is_some_and(|(_, other)| other == here);
        if !in_force || !STENCIL.iter().all(stays) {
            continue;
        }
        let rate = |at_s: f64| at(at_s).map(|(pointing, _)| pointing.frame().rate_body_rad_s);
        let ends = rate(time_s - 2.0 * STEP_S).zip(rate(time_s + 2.0 * STEP_S));
        // Near a tangent of the boundary the rate has no bound, and no difference over a quarter of a second follows it.
        let Some((before, after)) = ends else { continue };
        if (after - before).norm() > 2e-2 * after.norm().max(FLOOR_RAD_S) {
            continue;
        }
        let axes = |at_s: f64| at(at_s).map(|(pointing, _)| pointing.inertial_from_body);
        worst = worst.max(rate_error(axes, time_s, STEP_S, FLOOR_RAD_S).unwrap());
        compared += 1;
    }
    (worst, compared)
}

/// The vectors of a command, its limb scan `elapsed_s` after an instant.
fn vectors_of(
    command: &PointingCommand,
    ephemeris: &EphemerisAtTime,
    elapsed_s: f64,
) -> Option<PointingVectors> {
    let progress = PointingProgress { limb_elapsed_s: 30.0 + elapsed_s, ..PointingProgress::default() };
    pointing_solution(command, &hardware(), ephemeris, &progress).map(|solution| solution.vectors)
}

#[test]
fn the_rate_is_the_derivative_with_a_constraint_in_force() {
    let orbit = TestOrbit::new(12.0);
    // The hot pole is far from attitudes that look at the planet; in force it is where the aimpoint is elsewhere.
    let rows =
        [(zone(KeepInMethod::Nearest), 40, 10), (zone(KeepInMethod::Clamp), 40, 10), (hot_pole(), 10, 4)];
    for (constraints, least, aims) in rows {
        let mut compared_by_aim = Vec::new();
        for option in every() {
            let mut command = command(Scenario::Generic);
            command.aimpoint = aimpoint(option);
            // The Sun as reference would span no plane with itself.
            command.external_roll.option = Some(ExternalRollOption::Vector);
            let (worst, compared) =
                worst(&constraints, |s, elapsed_s| vectors_of(&command, s, elapsed_s), &orbit);
            assert!(worst < 1e-7, "{worst:e} {option:?} {constraints:?}");
            compared_by_aim.push((option, compared));
        }
        let enough = compared_by_aim.iter().filter(|(_, compared)| *compared >= least).count();
        assert!(enough >= aims, "{constraints:?}: {compared_by_aim:?}");
    }
}

#[test]
fn the_rate_is_the_derivative_for_every_scenario_in_a_narrow_zone() {
    let orbit = TestOrbit::new(12.0);
    let constraints = zone(KeepInMethod::Nearest);
    for scenario in SCENARIOS.into_iter().filter(|it| *it != Scenario::Generic) {
        let command = command(scenario);
        let (worst, compared) =
            worst(&constraints, |s, elapsed_s| vectors_of(&command, s, elapsed_s), &orbit);
        assert!(worst < 1e-7 && compared >= 20, "{worst:e} {compared} {scenario:?}");
    }
}
