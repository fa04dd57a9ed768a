//! Cruise flights of the plant's physics, with noise: what was changed comes back, and the covariance is the errors'.

mod closed_form;
mod cruise;
mod rows;

use nalgebra::{Vector3, Vector4};
use physics::constants::DAY_S;
use physics::numerics::noise::{Channel, normal, normal_vector};

use super::{Deviations, Direction, Fitted, Flights, History, Parameters, Requested, Telemetry, fit};
use cruise::Cruise;

/// A row each 10 min for 10 days.
const ROWS: u32 = 1441;
const SEEDS: u64 = 200;
const DEVIATIONS: Deviations = Deviations { noise_n_m_s: 0.01, center_of_mass_m: 0.05, solar_scale: 0.05 };
/// Of `messenger.toml`, about.
const PRIOR: Parameters =
    Parameters { center_of_mass_body_m: Vector3::new(0.0, 0.0, -0.0254), solar_scale: 1.0 };

/// From a day on the offset, and the windmill angle, in deg.
const TWO_OFFSETS: [(f64, f64, f64); 2] = [(0.0, 60.0, 0.0), (5.0, 40.0, 0.0)];
const WITH_WINDMILL: [(f64, f64, f64); 3] = [(0.0, 60.0, 0.0), (3.0, 40.0, 2.0), (6.0, 40.0, -2.0)];

fn times_s() -> Vec<f64> {
    (0..ROWS).map(|row| f64::from(row) * 600.0).collect()
}

/// A history of flights with these values, noise by a seed, each start of an arc anywhere.
fn telemetry(flights: &dyn Flights, truth: &Parameters, seed: u64, dumps: &[i32]) -> Telemetry {
    let times_s = times_s();
    let simulated = flights.simulate(truth, &times_s).unwrap().momentum_inertial_n_m_s;
    let noisy = simulated.iter().enumerate().map(|(row, momentum)| {
        let start = 3.0 * normal_vector(seed, Channel::SunSensor, dumps[row] as u64);
        momentum + start + DEVIATIONS.noise_n_m_s * normal_vector(seed, Channel::StarTracker, row as u64)
    });
    Telemetry {
        momentum_inertial_n_m_s: noisy.collect(),
        dumps: dumps.to_vec(),
        lines: (0..u64::from(ROWS)).map(|row| row + 2).collect(),
        times_s,
    }
}

fn fitted(flights: &dyn Flights, telemetry: &Telemetry) -> Fitted {
    let requested = Requested { telemetry, prior: PRIOR, deviations: DEVIATIONS };
    fit(flights, &requested, &mut |_, _| {}).unwrap()
}

fn no_dumps() -> Vec<i32> {
    vec![0; ROWS as usize]
}

/// Error of what was fitted.
fn error(fitted: &Fitted, truth: &Parameters) -> Vector4<f64> {
    fitted.parameters.values() - truth.values()
}

#[test]
fn a_shift_of_one_centimetre_comes_back_at_two_offsets() {
    let flights = Cruise::new(&TWO_OFFSETS);
    for (seed, direction) in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::repeat(-1.0 / 3f64.sqrt())]
        .into_iter()
        .enumerate()
    {
        let center_of_mass_body_m = PRIOR.center_of_mass_body_m + 0.01 * direction;
        let truth = Parameters { center_of_mass_body_m, ..PRIOR };
        let fitted = fitted(&flights, &telemetry(&flights, &truth, seed as u64, &no_dumps()));
        let error_mm = 1e3 * error(&fitted, &truth).xyz();
        assert!(
            error_mm.x.abs() < 0.5 && error_mm.y.abs() < 2.0 && error_mm.z.abs() < 0.5,
            "{error_mm:?} mm"
        );
        let freedom = fitted.degrees_of_freedom as f64;
        assert!((fitted.chi_square - freedom).abs() < 5.0 * (2.0 * freedom).sqrt(), "{}", fitted.chi_square);
    }
}

#[test]
fn at_one_offset_the_direction_of_the_force_of_light_stays_at_its_prior() {
    let flights = Cruise::new(&[(0.0, 60.0, 0.0)]);
    let shift_m = Vector3::new(0.004, -0.01, 0.006);
    let truth = Parameters { center_of_mass_body_m: PRIOR.center_of_mass_body_m + shift_m, ..PRIOR };
    let fitted = fitted(&flights, &telemetry(&flights, &truth, 1, &no_dumps()));
    let undetermined: Vec<&Direction> = fitted.undetermined().collect();
    let of_center: Vec<_> = undetermined.iter().filter(|it| it.vector.w.abs() < 1e-9).collect();
    assert_eq!(of_center.len(), 1, "{undetermined:?}");
    let along = of_center[0].vector.xyz();
    let published = Vector3::new(0.0, 0.987, 0.160);
    assert!(along.angle(&published).to_degrees() < 1.0, "{along:?}");
    assert_eq!(of_center[0].sigma, 1.0);
    let found_m = fitted.parameters.center_of_mass_body_m - PRIOR.center_of_mass_body_m;
    assert!(found_m.dot(&along).abs() < 1e-9, "{found_m:?}");
}

#[test]
fn normalised_errors_are_those_of_the_covariance() {
    // Offsets and windmilling determine all four. The expansion about the prior is the same for all seeds and simulated once; what is fitted and
    // what is compared with it is simulated for each.
    let flights = Remembered::new(Cruise::new(&WITH_WINDMILL));
    let mut sum = 0.0;
    for seed in 1..=SEEDS {
        let center_of_mass_body_m = PRIOR.center_of_mass_body_m
            + DEVIATIONS.center_of_mass_m * normal_vector(seed, Channel::AccelerometerBias, 0);
        let solar_scale =
            PRIOR.solar_scale + DEVIATIONS.solar_scale * normal(seed, Channel::AccelerometerScale, 0);
        let truth = Parameters { center_of_mass_body_m, solar_scale };
        let fitted = fitted(&flights, &telemetry(&flights, &truth, seed, &no_dumps()));
        assert_eq!(fitted.undetermined().count(), 0, "{:?}", fitted.directions);
        let error = error(&fitted, &truth);
        sum += error.dot(&(fitted.covariance.try_inverse().unwrap() * error));
    }
    let mean = sum / (4 * SEEDS) as f64;
    assert!((mean - 1.0).abs() < 0.2, "{mean}");
}

#[test]
fn normalised_errors_are_those_of_the_determined_directions() {
    // Two offsets determine three of four; the expansion about the prior is simulated once.
    let flights = Remembered::new(Cruise::new(&TWO_OFFSETS));
    let (mut sum, mut count) = (0.0, 0);
    for seed in 1..=SEEDS {
        let shift_m = 0.01 * normal_vector(seed, Channel::AccelerometerBias, 0).normalize();
        let center_of_mass_body_m = PRIOR.center_of_mass_body_m + shift_m;
        let truth = Parameters { center_of_mass_body_m, ..PRIOR };
        let fitted = fitted(&flights, &telemetry(&flights, &truth, seed, &no_dumps()));
        let error = error(&fitted, &truth).component_div(&DEVIATIONS.of_parameters());
        for it in fitted.directions.iter().filter(|it| it.observable) {
            sum += (it.vector.dot(&error) / it.sigma).powi(2);
            count += 1;
        }
    }
    let mean = sum / f64::from(count);
    assert_eq!(u64::from(count as u32), 3 * SEEDS);
    assert!((mean - 1.0).abs() < 0.2, "{mean}");
}

#[test]
fn arcs_have_starts_of_their_own() {
    let flights = Cruise::new(&WITH_WINDMILL);
    let truth = Parameters { center_of_mass_body_m: Vector3::new(0.01, 0.02, -0.04), solar_scale: 1.07 };
    let dumps: Vec<i32> = (0..ROWS as i32).map(|row| i32::from(row > 300) + i32::from(row > 1000)).collect();
    let fitted = fitted(&flights, &telemetry(&flights, &truth, 7, &dumps));
    assert_eq!(fitted.arcs.iter().map(std::ops::Range::len).collect::<Vec<_>>(), [301, 700, 440]);
    let error = error(&fitted, &truth);
    assert!(error.dot(&(fitted.covariance.try_inverse().unwrap() * error)) < 20.0, "{error:?}");
    // Far from the prior one expansion still describes every flight: eight, and one with the result.
    assert_eq!(fitted.flights, 9);
    let freedom = fitted.degrees_of_freedom;
    assert_eq!(freedom, 3 * (ROWS as usize - 3) - 4);
}

/// Flights that are simulated once for each set of values.
struct Remembered {
    flights: Cruise,
    simulated: std::cell::RefCell<Vec<(Parameters, History)>>,
}

impl Remembered {
    fn new(flights: Cruise) -> Self {
        Self { flights, simulated: std::cell::RefCell::default() }
    }
}

impl Flights for Remembered {
    fn simulate(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, crate::Failure> {
        // Those of the first expansion come again.
        const KEPT: usize = 12;
        if let Some((_, history)) =
            self.simulated.borrow().iter().find(|(simulated, _)| simulated == parameters)
        {
            return Ok(history.clone());
        }
        let history = self.flights.simulate(parameters, times_s)?;
        let mut simulated = self.simulated.borrow_mut();
        if simulated.len() < KEPT {
            simulated.push((*parameters, history.clone()));
        }
        Ok(history)
    }
}
