//! A disturbed orbit in flight is what Newton's law makes of it, and its periapses are the nearest points it really
//! passes.

use approx::assert_relative_eq;
use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::bodies::Body;
use physics::constants::{GM_MERCURY_M3_S2 as MU, RADIUS_MERCURY_M};
use physics::environment::CartesianState;
use physics::environment::orbit::{Attractor, Flattening, Gravity, GravityModel};
use physics::loads::ForceTorque;
use physics::momentum::{MomentumIntegrator, Totals};
use physics::plant::{AttitudeSource, Command, Configuration, Instant, Motion, Plant, PropagatorState};

use super::plant_flight::{EPOCH_S, Rig, configuration, guided, integrate, orbit};

fn disturbed(gravity: Gravity, attitude: AttitudeSource) -> Configuration {
    // With a flattening the Sun's tide acts too.
    let sun = gravity.flattening.map(|_| Attractor::point_mass(Body::Sun.data()));
    let planet = Attractor::point_mass(Body::Mercury.data()).with_gravity(gravity);
    let gravity = GravityModel::new(Body::Mercury, [planet].into_iter().chain(sun), false);
    let motion =
        Motion::Disturbed { gravity, segment_length_s: 300.0, radius_m: RADIUS_MERCURY_M, feedback: true };
    Configuration { motion, ..configuration(orbit(), attitude) }
}

fn at_rest() -> AttitudeSource {
    AttitudeSource::Commanded(Command {
        attitude: Attitude::default(),
        rate_body_rad_s: Vector3::zeros(),
        since_s: 0.0,
    })
}

/// Simulates to rising times and gives what `look` sees there.
fn simulate<T>(
    configuration: &Configuration,
    force_n: Vector3<f64>,
    times_s: impl Iterator<Item = f64>,
    mut look: impl FnMut(&mut Plant<'_>, f64) -> T,
) -> Vec<T> {
    let mut rig = Rig::new();
    rig.propagator = PropagatorState::new(configuration, 0.0).unwrap();
    let load = ForceTorque { force_body_n: force_n, ..ForceTorque::zero() };
    let load = move |_: f64| [load, ForceTorque::zero()];
    let mut plant = rig.plant_with(configuration, &load);
    let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
    times_s
        .map(|time_s| {
            integrate(&mut integrator, &mut plant, &configuration.momentum, time_s);
            look(&mut plant, time_s)
        })
        .collect()
}

#[test]
fn without_disturbances_it_is_the_closed_form() {
    let still = Configuration {
        light: physics::plant::SunLight {
            source: physics::plant::LightSource::Fixed { pressure_pa: 0.0 },
            scale: 1.0,
        },
        ..disturbed(Gravity::point_mass(MU), guided(&orbit()))
    };
    let two_body = Configuration { motion: Motion::TwoBody, ..still.clone() };
    let times = || (0..400).map(|i| f64::from(i) * 731.0);
    let look = |plant: &mut Plant<'_>, time_s: f64| plant.evaluate(time_s);
    let (found, expected) = (
        simulate(&still, Vector3::zeros(), times(), look),
        simulate(&two_body, Vector3::zeros(), times(), look),
    );
    for (found, expected) in found.iter().zip(&expected) {
        let (found, expected) = (found.instant, expected.instant);
        let off_m = (found.geometry.spacecraft.position_m - expected.geometry.spacecraft.position_m).norm();
        assert!(off_m < 0.02, "{off_m}");
        // Downlink windows, slews and science fall together.
        let (one, other) = (found.law.frame.inertial_from_body, expected.law.frame.inertial_from_body);
        let turn = (one.matrix() - other.matrix()).norm();
        assert!(turn < 1e-5, "{turn}");
        let form = |it: Instant| (it.is_in_downlink(), it.law.slewing, it.events[0] <= 0.0);
        assert_eq!(form(found), form(expected));
    }
}

/// Classical Runge-Kutta on gravity and a constant acceleration; nothing of the plant in it.
fn runge_kutta(
    mut state: CartesianState,
    extra: Vector3<f64>,
    duration_s: f64,
    steps: u32,
) -> CartesianState {
    let rate = |r: Vector3<f64>| extra - r * (MU / r.norm().powi(3));
    let h = duration_s / f64::from(steps);
    for _ in 0..steps {
        let (r, v) = (state.position_m, state.velocity_m_s);
        let (k1r, k1v) = (v, rate(r));
        let (k2r, k2v) = (v + k1v * (h / 2.0), rate(r + k1r * (h / 2.0)));
        let (k3r, k3v) = (v + k2v * (h / 2.0), rate(r + k2r * (h / 2.0)));
        let (k4r, k4v) = (v + k3v * h, rate(r + k3r * h));
        state.position_m += (k1r + k2r * 2.0 + k3r * 2.0 + k4r) * (h / 6.0);
        state.velocity_m_s += (k1v + k2v * 2.0 + k3v * 2.0 + k4v) * (h / 6.0);
    }
    state
}

#[test]
fn a_force_moves_the_spacecraft_as_newton_says() {
    let configuration = Configuration {
        light: physics::plant::SunLight {
            source: physics::plant::LightSource::Fixed { pressure_pa: 0.0 },
            scale: 1.0,
        },
        ..disturbed(Gravity::point_mass(MU), at_rest())
    };
    let force_n = Vector3::new(0.02, -0.01, 0.03);
    let end_s = 40_000.0;
    let found =
        simulate(&configuration, force_n, [end_s].into_iter(), |plant, time_s| plant.evaluate(time_s));
    let start = orbit().state_at(EPOCH_S);
    let pushed = runge_kutta(start, force_n / configuration.wet_mass.mass_kg, end_s, 200_000);
    let free = runge_kutta(start, Vector3::zeros(), end_s, 200_000);
    let found_m = found[0].instant.geometry.spacecraft.position_m;
    assert!((pushed.position_m - free.position_m).norm() > 10_000.0);
    assert_relative_eq!(found_m, pushed.position_m, epsilon = 0.1);
}

#[test]
fn periapses_are_counted_where_they_are_passed() {
    // Flattened a hundred times more than Mercury, so that the start's period is soon of no use.
    let flattening = Flattening { j2: 5e-3, ..Flattening::from_body(Body::Mercury.data()) };
    let gravity = Gravity { flattening: Some(flattening), ..Gravity::from_body(Body::Mercury.data()) };
    let configuration = disturbed(gravity, guided(&orbit()));
    let times = (1..=7200).map(|i| f64::from(i) * 60.0);
    let seen = simulate(&configuration, Vector3::zeros(), times, |plant, time_s| {
        let state = plant.evaluate(time_s).instant.geometry.spacecraft;
        (
            time_s,
            state.position_m.norm(),
            plant.time_since_periapsis_s(time_s),
            plant.evaluate(time_s).instant.is_in_downlink(),
        )
    });
    // By the distance alone: local minima on the minute.
    let minima: Vec<f64> =
        seen.windows(3).filter(|w| w[1].1 < w[0].1 && w[1].1 < w[2].1).map(|w| w[1].0).collect();
    assert!(minima.len() >= 9);
    let drift_s = minima[8] - 9.0 * orbit().period_s();
    assert!(drift_s.abs() > 600.0, "{drift_s}");
    for (time_s, _, since_s, downlink) in seen {
        let mut passed = minima.iter().filter(|&&at_s| at_s <= time_s - 60.0);
        let (count, last_s) = (passed.clone().count(), passed.next_back().copied().unwrap_or(0.0));
        if minima.iter().any(|&at_s| (at_s - time_s).abs() <= 60.0) {
            continue;
        }
        assert!((time_s - since_s - last_s).abs() < 60.0, "{time_s} {since_s} {last_s}");
        // Downlink from 2 h to 10 h after every second one.
        let expected = count % 2 == 0 && (7_300.0..35_900.0).contains(&since_s);
        let quiet = count % 2 == 1 || !(7_100.0..37_000.0).contains(&since_s);
        assert!(!expected || downlink, "{time_s}");
        assert!(!quiet || !downlink, "{time_s}");
    }
}

fn undisturbed() -> Configuration {
    Configuration {
        light: physics::plant::SunLight {
            source: physics::plant::LightSource::Fixed { pressure_pa: 0.0 },
            scale: 1.0,
        },
        ..disturbed(Gravity::point_mass(MU), guided(&orbit()))
    }
}

/// An input that changes just before a periapsis ends the cell that had seen it already.
#[test]
fn a_flight_cut_before_its_periapses_counts_them_once() {
    let configuration = undisturbed();
    let mut rig = Rig::new();
    rig.propagator = PropagatorState::new(&configuration, 0.0).unwrap();
    let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
    let orbit = orbit();
    for k in 1..2700 {
        let time_s = 97.0 * f64::from(k);
        let mut plant = rig.plant_with(&configuration, &|_| [ForceTorque::zero(); 2]);
        integrate(&mut integrator, &mut plant, &configuration.momentum, time_s);
        let epoch_s = time_s + EPOCH_S;
        let expected_s = orbit.time_since_periapsis_s(epoch_s);
        if expected_s > 1.0 && expected_s < orbit.period_s() - 1.0 {
            let found_s = plant.time_since_periapsis_s(time_s);
            assert!((found_s - expected_s).abs() < 0.01, "{time_s} {found_s} {expected_s}");
            // Downlink from 2 h to 10 h after every second one.
            let even = orbit.orbit_number(epoch_s) % 2 == 0;
            let down = even && (7200.0..36_000.0).contains(&expected_s);
            assert_eq!(plant.evaluate(time_s).instant.is_in_downlink(), down, "{time_s} {expected_s}");
        }
        rig.propagator.cut_with_jump(&configuration, time_s, &Vector3::zeros());
        integrator.cut(time_s);
    }
}

#[test]
fn downlinks_begin_and_end_to_the_second_after_a_periapsis_that_was_met() {
    let configuration = undisturbed();
    let edges_s = [0, 2, 4].map(|number| {
        let periapsis_s = orbit().periapsis_epoch_s(number) - EPOCH_S;
        [periapsis_s + 7200.0, periapsis_s + 36_000.0]
    });
    let times = edges_s.into_iter().flatten().flat_map(|at_s| [at_s - 0.2, at_s + 0.2]);
    let down = simulate(&configuration, Vector3::zeros(), times, |plant, time_s| {
        plant.evaluate(time_s).instant.is_in_downlink()
    });
    assert_eq!(down, [false, true, true, false].repeat(3));
}

/// A slew that lasts longer than the cells of the orbit continues from where it began.
#[test]
fn a_long_slew_turns_as_its_rate_says() {
    let flattening = Flattening { j2: 5e-3, ..Flattening::from_body(Body::Mercury.data()) };
    let gravity = Gravity { flattening: Some(flattening), ..Gravity::from_body(Body::Mercury.data()) };
    let mut configuration = disturbed(gravity, guided(&orbit()));
    if let AttitudeSource::Guided(guided) = &mut configuration.attitude {
        guided.slew_rate_rad_s = 3e-4;
    }
    let step_s = 10.0;
    let times = (1..26_000).map(|i| f64::from(i) * step_s);
    let seen = simulate(&configuration, Vector3::zeros(), times, |plant, time_s| {
        let Instant { law, events, .. } = plant.evaluate(time_s).instant;
        (law.frame, (law.window, law.row, law.slewing, law.corner_s, events[0] <= 0.0))
    });
    let mut compared = 0;
    for pair in seen.windows(2) {
        let [(before, one), (after, other)] = pair else { continue };
        let (_, _, is_slewing, ..) = one;
        if !is_slewing || one != other {
            continue;
        }
        let turn = (before.inertial_from_body.inverse() * after.inertial_from_body).scaled_axis();
        let expected = (before.rate_body_rad_s + after.rate_body_rad_s) * (0.5 * step_s);
        assert!((turn - expected).norm() < 1e-6, "{turn} {expected}");
        compared += 1;
    }
    assert!(compared > 500, "{compared}");
}
