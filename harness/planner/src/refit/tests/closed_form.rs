//! Momentum in closed form: a body that turns about Z in two pushes of light. What no expansion describes is expanded anew or refused.

use nalgebra::Vector3;

use crate::{
    Failure,
    refit::{Deviations, Fitted, Flights, History, Parameters, Requested, Telemetry, fit},
};

const RATE_RAD_S: f64 = 1e-6;
const HALF_S: f64 = 4e5;
const PRIOR: Parameters = Parameters { center_of_mass_body_m: Vector3::new(0.0, 0.0, 0.0), solar_scale: 1.0 };
const DEVIATIONS: Deviations = Deviations { noise_n_m_s: 1e-3, center_of_mass_m: 0.05, solar_scale: 0.05 };

/// Torque s (T - c x F), with a part that grows with the square of the centre of mass, and dumps that may follow it.
#[derive(Clone, Copy, Default)]
struct Pushed {
    square_n_m: f64,
    dumps_beyond_m: Option<f64>,
}

impl Pushed {
    fn torque_body_n_m(&self, parameters: &Parameters, is_later: bool) -> Vector3<f64> {
        let center_m = parameters.center_of_mass_body_m;
        let force_n = if is_later { Vector3::new(0.0, 3e-5, 2e-5) } else { Vector3::new(0.0, 4e-5, -1e-5) };
        let own_n_m = if is_later { Vector3::new(1e-6, 4e-6, 0.0) } else { Vector3::new(1e-6, 0.0, 3e-6) };
        (own_n_m - center_m.cross(&force_n)) * parameters.solar_scale
            + Vector3::x() * (self.square_n_m * center_m.norm_squared())
    }
}

/// Integral of a vector that turns about Z, from one time to another.
fn turned(vector: &Vector3<f64>, from_s: f64, to_s: f64) -> Vector3<f64> {
    let ([from_sine, from_cosine], [to_sine, to_cosine]) =
        ([from_s, to_s].map(|time_s| (RATE_RAD_S * time_s).sin_cos()).map(|(a, b)| [a, b])).into();
    let (sines, cosines) = ((to_sine - from_sine) / RATE_RAD_S, (from_cosine - to_cosine) / RATE_RAD_S);
    Vector3::new(
        sines * vector.x - cosines * vector.y,
        cosines * vector.x + sines * vector.y,
        (to_s - from_s) * vector.z,
    )
}

impl Flights for Pushed {
    fn simulate(&self, parameters: &Parameters, times_s: &[f64]) -> Result<History, Failure> {
        let [early, late] = [false, true].map(|is_later| self.torque_body_n_m(parameters, is_later));
        let momentum = |time_s: &f64| {
            turned(&early, 0.0, time_s.min(HALF_S)) + turned(&late, HALF_S, time_s.max(HALF_S))
        };
        let beyond = self.dumps_beyond_m.is_some_and(|most_m| parameters.center_of_mass_body_m.x > most_m);
        Ok(History {
            momentum_inertial_n_m_s: times_s.iter().map(momentum).collect(),
            dumps: times_s.iter().map(|time_s| i32::from(beyond && *time_s > HALF_S)).collect(),
        })
    }
}

fn fitted(flights: &Pushed, truth: &Parameters) -> Result<Fitted, Failure> {
    let times_s: Vec<f64> = (0..=200).map(|row| f64::from(row) * 4e3).collect();
    let history = flights.simulate(truth, &times_s)?;
    let telemetry = Telemetry {
        momentum_inertial_n_m_s: history.momentum_inertial_n_m_s,
        dumps: vec![0; times_s.len()],
        lines: (2..).take(times_s.len()).collect(),
        times_s,
    };
    fit(flights, &Requested { telemetry: &telemetry, prior: PRIOR, deviations: DEVIATIONS }, &mut |_, _| {})
}

/// Errors by their deviations, the priors' pull among them.
fn worst_error(fitted: &Fitted, truth: &Parameters) -> f64 {
    let error = fitted.parameters.values() - truth.values();
    error.component_div(&nalgebra::Vector4::from(fitted.deviations())).amax()
}

#[test]
fn what_is_linear_takes_nine_flights_and_what_bends_more() {
    let truth = Parameters { center_of_mass_body_m: Vector3::new(0.08, -0.06, 0.05), solar_scale: 1.12 };
    let linear = fitted(&Pushed::default(), &truth).unwrap();
    assert_eq!(linear.flights, 9);
    assert!(worst_error(&linear, &truth) < 0.1, "{linear:?}");
    assert!(linear.chi_square < 1e-2, "{}", linear.chi_square);
    let bends = Pushed { square_n_m: 1e-5, ..Pushed::default() };
    let bent = fitted(&bends, &truth).unwrap();
    assert!(bent.flights > 9, "{}", bent.flights);
    assert!(worst_error(&bent, &truth) < 0.1, "{bent:?}");
}

#[test]
fn what_no_expansion_describes_is_refused() {
    // In every round the expansion about the last result leads far off the next.
    let wild = Pushed { square_n_m: -1e-3, ..Pushed::default() };
    let truth = Parameters { center_of_mass_body_m: Vector3::new(0.08, -0.06, 0.05), solar_scale: 1.12 };
    let refused = fitted(&wild, &truth).unwrap_err().to_string();
    assert!(refused.contains("after 45 flights one departs by"), "{refused}");
    let wilder = Pushed { square_n_m: -0.5, ..Pushed::default() };
    let refused = fitted(&wilder, &truth).unwrap_err().to_string();
    assert!(refused.contains("the fit did not converge in 50 steps, allowed: a history"), "{refused}");
    let dumping = Pushed { dumps_beyond_m: Some(0.01), ..Pushed::default() };
    let refused = fitted(&dumping, &PRIOR).unwrap_err().to_string();
    assert!(refused.contains("dumps fall at times that depend on what is fitted"), "{refused}");
}
