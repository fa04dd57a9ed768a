//! Valves of the spinner: impulse, momentum, timing, scatter, minimum on-time.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Vector3};

use super::{ACE, ace, assert_same_attitude, directions, launch, paper_start, pulses, request, tensor};
use crate::numerics::noise::{Channel, normal};
use crate::spacecraft::ValveTiming;
use crate::spin::{
    burn_request::BurnRequest,
    forecast::Timing,
    nutation::{LinearNutation, Spin},
    plant::{Commands, Outputs, Plant, Predictions, PulseExecution, Start},
    spinner::Spinner,
    train::Shape,
};

const FORCE_N: f64 = 4.448;
const EXHAUST_M_S: f64 = 220.0 * 9.806_65;
const TIMING: ValveTiming = ValveTiming { min_on_s: 0.02, rise_s: 0.06, tail_off_s: 0.15 };

fn start(valve: ValveTiming, scatter: f64) -> Start {
    Start { execution: [PulseExecution { valve, scatter }; 24], ..paper_start(1.483) }
}

/// One pulse after a delay of half a second, and what is left of it.
fn pulsed(spinner: &Spinner, start: &Start, thrusters: &[usize], on_s: f64) -> Plant {
    let mut plant = launch(spinner, start);
    plant.command(pulses(thrusters, 0.5, on_s), directions());
    plant.advance(spinner, 0.5 + on_s).unwrap();
    plant.command(Commands::default(), directions());
    plant.advance(spinner, 3.0 + on_s).unwrap();
    plant
}

/// Area of the thrust over the full one: a trapezoid, or what a rise that is cut short leaves.
fn area_s(on_s: f64) -> f64 {
    let ValveTiming { rise_s, tail_off_s, .. } = TIMING;
    let reached = (on_s / rise_s).min(1.0);
    let rising_s = on_s.min(rise_s);
    0.5 * reached * rising_s + (on_s - rising_s) + 0.5 * reached * reached * tail_off_s
}

#[test]
fn the_impulse_is_the_nominal_thrust_times_the_area_of_the_valve_law() {
    let spinner = ace();
    for on_s in [0.02, 0.045, 0.06, 0.5, 1.1, 40.0] {
        // Along the axis without torque: propellant and the rocket equation.
        let seen = Outputs::from_plant(&pulsed(&spinner, &start(TIMING, 0.0), &[7, 9], on_s), &spinner);
        let burnt_kg = 2.0 * FORCE_N / EXHAUST_M_S * area_s(on_s);
        assert_relative_eq!(seen.propellant_used_kg, burnt_kg, max_relative = 1e-12);
        let delta_v = -EXHAUST_M_S * (-burnt_kg / (562.0 + 97.5)).ln_1p();
        assert_relative_eq!(seen.delta_v_inertial_m_s.z, delta_v, max_relative = 1e-12);
        // A couple about the axis: force times lever times time.
        let plant = pulsed(&spinner, &start(TIMING, 0.0), &[2, 5], on_s);
        let seen = Outputs::from_plant(&plant, &spinner);
        let lever_m = 0.78 * core::f64::consts::FRAC_1_SQRT_2;
        let spun_up = 353.82 * core::f64::consts::PI / 6.0 + 2.0 * FORCE_N * lever_m * area_s(on_s);
        assert_relative_eq!(seen.state.momentum_inertial.z, spun_up, max_relative = 1e-13);
        let open_mask = plant.propulsion.valves.open_mask();
        assert!(seen.state.momentum_inertial.xy().norm() < 1e-13 && open_mask == 0);
    }
}

/// The momentum that pulses leave is the integral of their torque over the turning body: Runge-Kutta on the full tensor,
/// from corner to corner of the thrust, which is typed anew.
#[test]
fn a_train_of_pulses_leaves_the_integral_of_its_torque_over_the_turning_body() {
    let spinner = ace();
    let mut start = start(TIMING, 0.0);
    start.damper_time_constant_s = 0.0;
    (start.inertia_kg_m2, start.products_kg_m2) = ([225.0, 250.0, 353.82], [6.0, -9.0, 4.0]);
    let mut plant = launch(&spinner, &start);
    let body = tensor(start.inertia_kg_m2, start.products_kg_m2);
    let inverse = body.try_inverse().unwrap();
    let torque = spinner.thrusters[7].position_body_m.cross(&spinner.thrusters[7].force_body_n)
        + spinner.thrusters[0].position_body_m.cross(&spinner.thrusters[0].force_body_n);
    let force = spinner.thrusters[7].force_body_n + spinner.thrusters[0].force_body_n;
    let flow_kg_s = 2.0 * FORCE_N / EXHAUST_M_S;
    let mut w = Outputs::from_plant(&plant, &spinner).rate_rad_s;
    let mut m = Matrix3::identity();
    let (mut delta_v, mut used_kg) = (Vector3::zeros(), 0.0);
    // Opened each second for a while from 0.5 s on: rising 0.06 s, falling 0.15 s.
    for on_s in [0.3, 0.04, 0.2, 0.35] {
        let full = (on_s / 0.06_f64).min(1.0);
        let corners = [0.0, 0.5, 0.5 + f64::min(on_s, 0.06), 0.5 + on_s, 0.5 + on_s + full * 0.15, 1.0];
        let shares = [0.0, 0.0, full, full, 0.0, 0.0];
        for k in 0..5 {
            let length_s = corners[k + 1] - corners[k];
            let steps = (length_s * 4000.0).ceil().max(1.0);
            let dt = length_s / steps;
            for i in 0..steps as u32 {
                let share = |x: f64| shares[k] + (shares[k + 1] - shares[k]) * (f64::from(i) + x) / steps;
                let slope = |x: f64, w: &Vector3<f64>, m: &Matrix3<f64>, used_kg: f64| {
                    (
                        inverse * (torque * share(x) - w.cross(&(body * w))),
                        m * w.cross_matrix(),
                        m * force * (share(x) / (562.0 + 97.5 - used_kg)),
                        flow_kg_s * share(x),
                    )
                };
                let k1 = slope(0.0, &w, &m, used_kg);
                let h = 0.5 * dt;
                let k2 = slope(0.5, &(w + k1.0 * h), &(m + k1.1 * h), used_kg + k1.3 * h);
                let k3 = slope(0.5, &(w + k2.0 * h), &(m + k2.1 * h), used_kg + k2.3 * h);
                let k4 = slope(1.0, &(w + k3.0 * dt), &(m + k3.1 * dt), used_kg + k3.3 * dt);
                w += (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) * (dt / 6.0);
                m += (k1.1 + (k2.1 + k3.1) * 2.0 + k4.1) * (dt / 6.0);
                delta_v += (k1.2 + (k2.2 + k3.2) * 2.0 + k4.2) * (dt / 6.0);
                used_kg += (k1.3 + (k2.3 + k3.3) * 2.0 + k4.3) * (dt / 6.0);
            }
        }
        plant.command(pulses(&[8, 1], 0.5, on_s), directions());
        plant.advance(&spinner, plant.time_s + 1.0).unwrap();
    }
    let seen = Outputs::from_plant(&plant, &spinner);
    let expected = m * (body * w);
    let moved = (expected - plant.initial.momentum_inertial).norm();
    assert!(moved > 1.0);
    assert!((seen.state.momentum_inertial - expected).norm() < 1e-11 * moved);
    assert!((seen.rate_rad_s - w).norm() < 1e-13);
    assert!((seen.delta_v_inertial_m_s - delta_v).norm() < 1e-11 * delta_v.norm());
    assert_relative_eq!(seen.propellant_used_kg, used_kg, max_relative = 1e-12);
    assert_same_attitude(seen.state.attitude, &m, 1e-11);
}

#[test]
fn the_predicted_nutation_takes_ramps_exactly() {
    // h' = i lambda h + T(t) by the midpoint rule with extrapolation.
    let spin = Spin { rate_rad_s: 0.5, ratio: 1.483, inertia_kg_m2: 353.82 };
    let lambda = 0.483 * 0.5;
    let (start, slope) = ([0.4, -0.2], [0.3, 0.5]);
    for width_s in [1e-3, 3.0, 9.0] {
        let run = |steps: u32| {
            let dt = width_s / f64::from(steps);
            let (mut x, mut y) = (0.0, 0.0);
            for i in 0..steps {
                let torque =
                    |share: f64, axis: usize| start[axis] + slope[axis] * dt * (f64::from(i) + share);
                let mx = x + 0.5 * dt * (torque(0.0, 0) - lambda * y);
                let my = y + 0.5 * dt * (torque(0.0, 1) + lambda * x);
                x += dt * (torque(0.5, 0) - lambda * my);
                y += dt * (torque(0.5, 1) + lambda * mx);
            }
            [x, y]
        };
        let (coarse, fine) = (run(10_000), run(20_000));
        let exact: [f64; 2] = std::array::from_fn(|i| (4.0 * fine[i] - coarse[i]) / 3.0);
        let mut linear = LinearNutation::default();
        linear.pulse(&spin, [start, slope], 7.0, 7.0 + width_s);
        let expected = (exact[0].hypot(exact[1]) / (353.82 * 0.5)).atan();
        assert_relative_eq!(linear.angle_rad(), expected, max_relative = 1e-9);
        // And its phase: what undoes it leaves nothing.
        let back = [exact[0] * -1e9, exact[1] * -1e9];
        linear.pulse(&spin, [back, [0.0; 2]], 7.0 + width_s, 7.0 + width_s + 1e-9);
        assert!(linear.angle_rad() < 1e-7 * expected, "{width_s}");
    }
}

#[test]
fn burns_with_slow_valves_move_by_what_they_plan() {
    let spinner = ace();
    for timing in [Timing::Clock, Timing::SunCrossing, Timing::TruePhase] {
        for (shape, turns) in
            [(Shape::Uniform, 1.0), (Shape::Uniform, 0.5), (Shape::Tapered { order: 1 }, 1.0)]
        {
            let simulate = |valve: ValveTiming| {
                let mut start = start(valve, 0.0);
                start.damper_time_constant_s = 0.0;
                start.burn = Some(BurnRequest {
                    shape,
                    timing,
                    pulse_width_s: 0.32,
                    count: 12,
                    turns_per_pulse: turns,
                    ..request()
                });
                let mut plant = launch(&spinner, &start);
                plant.advance(&spinner, 170.0).unwrap();
                plant
            };
            let plant = simulate(TIMING);
            let seen = Outputs::from_plant(&plant, &spinner);
            assert!(seen.burn_done, "{timing:?} {shape:?}");
            let burn = plant.sequencer.as_ref().unwrap().burn;
            let needed_kg = burn.train.on_time_s() * FORCE_N / EXHAUST_M_S;
            assert_relative_eq!(seen.propellant_used_kg, needed_kg, max_relative = 1e-12);
            assert_relative_eq!(burn.propellant_kg(&spinner), needed_kg, max_relative = 1e-12);
            let moved = Predictions::from_plant(&plant).manoeuvre_rad;
            assert_relative_eq!(seen.momentum_displacement_rad, moved, max_relative = 1e-3);
            // The thrust, not the valve, is centred on the instant that points at the target: else 0.03 of it goes aside. Sun
            // pulses are seen from the nutating axis, and nutation turns a little otherwise under slow pulses.
            let aside = |plant: &Plant| {
                let end = plant.state().momentum_inertial.normalize();
                end.dot(&Vector3::new(-0.6, 0.8, 0.0)) / moved
            };
            let [slow, quick] = [&plant, &simulate(ValveTiming::default())].map(aside);
            assert!((slow - quick).abs() < 3e-3, "{timing:?} {shape:?} {turns}: {slow} {quick}");
            assert_relative_eq!(seen.nutation_rad, seen.predicted_nutation_rad, epsilon = 2e-4 * moved);
        }
    }
}

#[test]
fn thrust_scatters_by_seed_thruster_and_number_alone() {
    let spinner = ace();
    let mut start = start(TIMING, 0.05);
    for seed in [1, 2] {
        start.seed = seed;
        let mut plant = launch(&spinner, &start);
        for i in 0..20_u32 {
            plant.command(pulses(&[8], 0.1, 0.4), directions());
            let before_kg = Outputs::from_plant(&plant, &spinner).propellant_used_kg;
            plant.advance(&spinner, f64::from(i + 1)).unwrap();
            let used_kg = Outputs::from_plant(&plant, &spinner).propellant_used_kg - before_kg;
            let drawn = 1.0 + 0.05 * normal(seed, Channel::Thruster(7), i.into());
            let expected = FORCE_N / EXHAUST_M_S * area_s(0.4) * drawn;
            assert_relative_eq!(used_kg, expected, max_relative = 1e-10);
        }
    }
}

#[test]
fn pulses_too_short_for_their_valve_do_not_fire() {
    let spinner = ace();
    let mut plant = launch(&spinner, &start(TIMING, 0.0));
    let mut commands = pulses(&[8], 0.1, 0.0199);
    commands.pulses[9].on_s = 0.02;
    plant.command(commands, directions());
    plant.advance(&spinner, 0.01).unwrap();
    let valves = &plant.propulsion.valves;
    assert_eq!((valves.open_mask(), valves.too_short_mask()), (1 << 9, 1 << 7));
    plant.command(Commands::default(), directions());
    plant.advance(&spinner, 1.0).unwrap();
    let seen = Outputs::from_plant(&plant, &spinner);
    assert_eq!(plant.propulsion.valves.too_short_mask(), 0);
    // Its step ends at 0.01 s, and the valve does not close before 0.02 s.
    assert_relative_eq!(seen.propellant_used_kg, FORCE_N / EXHAUST_M_S * area_s(0.02), max_relative = 1e-12);
}

#[test]
fn burns_that_valves_cannot_do_are_refused_by_name() {
    let spinner = ace();
    let refusal = |valve: ValveTiming, request: BurnRequest, change: &dyn Fn(&mut Start)| {
        let mut start = start(valve, 0.0);
        start.burn = Some(request);
        change(&mut start);
        Plant::start(&spinner, &start, directions(), Commands::default(), 0.0).unwrap_err().to_string()
    };
    let slow = |rise_s, tail_off_s| ValveTiming { min_on_s: 0.0, rise_s, tail_off_s };
    for (valve, width_s) in [
        (ValveTiming { min_on_s: 0.033, ..slow(0.0, 0.0) }, 0.032),
        (slow(0.04, 0.0), 0.0199),
        (slow(0.0, 0.07), 0.032),
        (slow(0.5, 0.5), 5.5),
    ] {
        let text = refusal(valve, BurnRequest { pulse_width_s: width_s, ..request() }, &|_| {});
        for part in ["burn.pulseWidth", "thruster[k].minOnTime", "half a turn"] {
            assert!(text.contains(part), "{text}");
        }
    }
    let group = BurnRequest { group: "upper radial I".into(), ..request() };
    let text = refusal(slow(0.0, 0.0), group, &|start| start.execution[2].valve.rise_s = 0.01);
    for part in ["burn.group", "IR+", "IR-", "riseTime"] {
        assert!(text.contains(part), "{text}");
    }
    let text = refusal(slow(0.0, 0.0), request(), &|start| start.execution[4].scatter = 1.5);
    assert!(text.contains("scatter") && text.contains("k = 5"), "{text}");
    let text = refusal(slow(-1.0, 0.0), request(), &|_| {});
    assert!(text.contains("riseTime"), "{text}");
}

#[test]
fn an_empty_tank_shuts_a_rising_valve() {
    let spinner = ace();
    let slow = ValveTiming { min_on_s: 0.0, rise_s: 4.0, tail_off_s: 3.0 };
    // Half of what the rise takes: empty when t^2 / 8 s is 1 s.
    let loaded_kg = FORCE_N / EXHAUST_M_S;
    let mut start = start(slow, 0.0);
    start.propellant_kg = loaded_kg;
    let fire = Commands { fire: 1 << 7, ..Commands::default() };
    let mut ends = Vec::new();
    for step_s in [0.01, 0.7, 5.0] {
        let mut plant = Plant::start(&spinner, &start, directions(), fire.clone(), 0.0).unwrap();
        for i in 1..=(5.0_f64 / step_s).round() as u32 {
            plant.advance(&spinner, (f64::from(i) * step_s).min(5.0)).unwrap();
            let valves = &plant.propulsion.valves;
            assert_eq!(valves.open_mask() == 0, plant.time_s > 8f64.sqrt());
            let share = if valves.open_mask() == 0 { 0.0 } else { plant.time_s / 4.0 };
            let force_n = valves.law.force_at_n(plant.time_s).norm();
            assert_relative_eq!(force_n, FORCE_N * share, max_relative = 1e-12);
        }
        plant.advance(&spinner, 5.0).unwrap();
        ends.push(Outputs::from_plant(&plant, &spinner));
    }
    let mut plant = Plant::start(&spinner, &start, directions(), fire, 0.0).unwrap();
    for (time_s, on) in [(8f64.sqrt() - 1e-7, true), (8f64.sqrt() + 1e-7, false)] {
        plant.advance(&spinner, time_s).unwrap();
        assert_eq!(plant.propulsion.valves.open_mask() != 0, on, "{time_s}");
    }
    assert_eq!(ends[0].propellant_remaining_kg, 0.0);
    assert!(ends.iter().all(|end| *end == ends[0]));
}

#[test]
fn the_file_says_how_thrusters_execute_pulses() {
    let keys =
        "name = \"IIIR\"\nmin_on_time_s = 0.02\nrise_time_s = 0.01\ntail_off_time_s = 0.03\nscatter = 0.05";
    let spinner = Spinner::parse("my.toml", &ACE.replacen("name = \"IIIR\"", keys, 1)).unwrap();
    let execution = spinner.execution();
    let valve = ValveTiming { min_on_s: 0.02, rise_s: 0.01, tail_off_s: 0.03 };
    assert_eq!(execution[7], PulseExecution { valve, scatter: 0.05 });
    assert_eq!(execution[6], PulseExecution::default());
    let error =
        Spinner::parse("my.toml", &ACE.replacen("name = \"IIIR\"", "name = \"IIIR\"\nscatter = -1", 1));
    assert!(error.unwrap_err().to_string().contains("scatter"));
}
