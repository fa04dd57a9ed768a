//! The fit: expansions by flights until a flight with the result agrees, and what is written of it.

use std::ops::Range;

use nalgebra::{Matrix4, Vector3};
use serde::Serialize;

use super::{
    directions::Direction,
    estimate::{Requested, residuals_n_m_s},
    expansion::{Expansion, FLIGHTS},
    flights::Flights,
    parameters::{Deviations, FITTED, Parameters},
    telemetry::{MIN_ROWS, arcs},
};
use crate::Failure;

/// Expansions at most.
const MAX_ROUNDS: u64 = 5;
/// Part of the noise by which a flight may depart from the expansion that it is fitted by.
const AGREES: f64 = 0.05;
/// Standard deviations of chi square above its mean beyond which the noise or the flight is not what it was said to be.
const FAR: f64 = 5.0;
/// Deviations of its prior that an estimate may be off.
const MAX_PRIOR_DEVIATIONS: f64 = 6.0;
/// Flights of one round: an expansion, and one with its result.
const FLIGHTS_OF_ROUND: u64 = FLIGHTS + 1;

/// A result.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The values that fit best.
    pub parameters: Parameters,
    /// Covariance of centre of mass X, Y, Z (m), and `solar.scale`.
    pub covariance: Matrix4<f64>,
    /// The best determined first.
    pub directions: [Direction; 4],
    /// Sum of the squares of the residuals by the noise.
    pub chi_square: f64,
    /// Numbers less start momenta and determined directions.
    pub degrees_of_freedom: usize,
    /// Rows of each arc.
    pub arcs: Vec<Range<usize>>,
    /// Telemetry less flight by row, EME2000, in N m s.
    pub residuals_n_m_s: Vec<Vector3<f64>>,
    /// Flights that were simulated.
    pub flights: u64,
}

/// Fits; `progress` receives the flights so far and the most that the present round may come to.
///
/// # Errors
/// A flight that fails, too few rows, a flight that no expansion describes, an estimate that its prior excludes.
pub fn fit(
    flights: &dyn Flights,
    requested: &Requested<'_>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Fitted, Failure> {
    let Requested { telemetry, prior, deviations } = requested;
    let mut center = *prior;
    let (mut count, mut round) = (0, 0);
    loop {
        round += 1;
        let expected = round * FLIGHTS_OF_ROUND;
        progress(count, expected);
        let mut counted = || {
            count += 1;
            progress(count, expected);
        };
        let expansion = Expansion::about(flights, &center, &telemetry.times_s, &mut counted)?;
        let arcs = arcs(&[&telemetry.dumps, &expansion.dumps]);
        if telemetry.times_s.len() < arcs.len() + MIN_ROWS {
            return Err(format!(
                "found {} rows in {} arcs between dumps, those of the mission's timeline and inputs among them, allowed: at \
                 least {MIN_ROWS} rows more than arcs",
                telemetry.times_s.len(),
                arcs.len()
            )
            .into());
        }
        let estimate = requested.solve(&arcs, &expansion, &center)?;
        let simulated = flights.simulate(&estimate.parameters, &telemetry.times_s)?.momentum_inertial_n_m_s;
        counted();
        let residuals = residuals_n_m_s(telemetry, &arcs, &simulated);
        let expanded: Vec<_> = expansion.at(&estimate.parameters).map(|(momentum, _)| momentum).collect();
        let departures = residuals_n_m_s(telemetry, &arcs, &expanded)
            .into_iter()
            .zip(&residuals)
            .map(|(a, b)| (a - b).amax());
        let departure_n_m_s = departures.fold(0.0, f64::max);
        let noise_n_m_s = deviations.noise_n_m_s;
        if departure_n_m_s <= AGREES * noise_n_m_s {
            let determined = estimate.directions.iter().filter(|it| it.observable).count();
            check_prior(&estimate.parameters, requested)?;
            return Ok(Fitted {
                parameters: estimate.parameters,
                covariance: covariance(&estimate.directions, deviations),
                directions: estimate.directions,
                chi_square: residuals.iter().map(|residual| (residual / noise_n_m_s).norm_squared()).sum(),
                degrees_of_freedom: (3 * (telemetry.times_s.len() - arcs.len())).saturating_sub(determined),
                arcs,
                residuals_n_m_s: residuals,
                flights: count,
            });
        }
        if round == MAX_ROUNDS {
            return Err(format!(
                "after {count} flights one departs by {} N m s from what it was expanded to, allowed: {} of --noise, {}",
                terminal::short(departure_n_m_s),
                terminal::short(AGREES),
                terminal::short(AGREES * noise_n_m_s)
            )
            .into());
        }
        center = estimate.parameters;
    }
}

/// Refuses estimates that their prior excludes: the history is of something else.
fn check_prior(found: &Parameters, requested: &Requested<'_>) -> Result<(), String> {
    let (prior, deviations) = (requested.prior.values(), requested.deviations.of_parameters());
    let off = (found.values() - prior).component_div(&deviations);
    let at = off.icamax();
    if off[at].abs() <= MAX_PRIOR_DEVIATIONS {
        return Ok(());
    }
    Err(format!(
        "{}: the fit found {}, {} deviations of its prior off the mission's {}, allowed: {MAX_PRIOR_DEVIATIONS}: a history of this \
         mission's flight with every dump in dump.count, or a wider --prior-center, --prior-scale",
        FITTED[at],
        terminal::short(found.values()[at]),
        terminal::short(off[at].abs()),
        terminal::short(prior[at]),
    ))
}

/// Whether residuals are no more than the noise: deviations and covariance hold then alone.
pub fn is_trusted(chi_square: f64, degrees_of_freedom: f64) -> bool {
    chi_square - degrees_of_freedom <= FAR * (2.0 * degrees_of_freedom).sqrt()
}

/// Covariance of the parameters in their own units.
fn covariance(directions: &[Direction; 4], deviations: &Deviations) -> Matrix4<f64> {
    let scales = Matrix4::from_diagonal(&deviations.of_parameters());
    let scaled: Matrix4<f64> =
        directions.iter().map(|it| it.vector * it.vector.transpose() * it.sigma.powi(2)).sum();
    scales * scaled * scales
}

/// The JSON file, in SI.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Written<'a> {
    spacecraft: &'a str,
    #[serde(rename = "centerOfMass_m")]
    center_of_mass_m: [f64; 3],
    scale: f64,
    covariance: [[f64; 4]; 4],
    directions: &'a [Direction; 4],
    chi_square: f64,
    degrees_of_freedom: usize,
    trusted: bool,
}

impl Fitted {
    /// As JSON, of the spacecraft of this name: covariance in the order centre of mass X, Y, Z (m), scale; directions in units of the priors.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn to_json(&self, spacecraft: &str) -> Result<String, serde_json::Error> {
        let written = Written {
            spacecraft,
            center_of_mass_m: self.parameters.center_of_mass_body_m.into(),
            scale: self.parameters.solar_scale,
            // Symmetric, so that rows are columns.
            covariance: self.covariance.into(),
            directions: &self.directions,
            chi_square: self.chi_square,
            degrees_of_freedom: self.degrees_of_freedom,
            trusted: self.is_trusted(),
        };
        serde_json::to_string_pretty(&written).map(|text| text + "\n")
    }

    /// Whether residuals are no more than the noise.
    pub fn is_trusted(&self) -> bool {
        is_trusted(self.chi_square, self.degrees_of_freedom as f64)
    }

    /// Whether residuals are far less than the noise.
    pub fn is_overcautious(&self) -> bool {
        let freedom = self.degrees_of_freedom as f64;
        freedom - self.chi_square > FAR * (2.0 * freedom).sqrt()
    }

    /// Row whose residual is the longest, and that, in N m s.
    pub fn worst_row(&self) -> (usize, f64) {
        let lengths = self.residuals_n_m_s.iter().map(Vector3::norm).enumerate();
        lengths.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst })
    }

    /// Standard deviations of centre of mass X, Y, Z (m), and `solar.scale`.
    pub fn deviations(&self) -> [f64; 4] {
        self.covariance.diagonal().map(f64::sqrt).into()
    }

    /// Directions that the history does not determine.
    pub fn undetermined(&self) -> impl Iterator<Item = &Direction> {
        self.directions.iter().filter(|it| !it.observable)
    }
}
