//! Tables of a plan about a flyby, in SI: aim, state from orbit determination, manoeuvres compared, flights with errors.

use std::path::Path;

use nalgebra::{Matrix6, SymmetricEigen, Vector3};
use physics::{constants::DAY_S, toml::Place};

use crate::{
    leg::FlybyAimpoint,
    plan::description::{CompareDescription, FlybyDescription, MonteCarloDescription, UpdateDescription},
    reading::{ALLOWED_ANGLE, ALLOWED_LENGTH, At, Builder, Written},
    values,
};

/// Least miss that can be a tolerance, in m.
const MIN_TOLERANCE_M: f64 = 1.0;
/// Most flights with errors.
const MAX_RUNS: usize = 100_000;
/// The approach manoeuvre where none is given, before the arrival.
const APPROACH_S: f64 = -42.0 * DAY_S;

/// `[flyby]`.
#[derive(Clone, Debug)]
pub struct Flyby {
    /// Name of the planet.
    pub body: At<String>,
    /// Aim; without one the encounter of the mission as it is is described, and nothing is planned.
    pub aimpoint: Option<At<FlybyAimpoint>>,
    /// When the spacecraft arrives, where that is a goal.
    pub time: Option<At<values::Instant>>,
    /// Time from which the plan may change the mission.
    pub from: Option<At<values::Instant>>,
    /// Greatest miss.
    pub tolerance_m: f64,
}

/// `[update]`.
#[derive(Clone, Debug)]
pub struct Update {
    /// Time at which the state holds.
    pub at: At<values::Instant>,
    /// Position from the centre, EME2000.
    pub position_m: Option<Vector3<f64>>,
    /// Velocity, EME2000.
    pub velocity_m_s: Option<Vector3<f64>>,
    /// Covariance of position and velocity.
    pub covariance: Option<Matrix6<f64>>,
}

/// `[compare]`.
#[derive(Clone, Debug)]
pub struct Compare {
    /// Standard deviation of the direction.
    pub direction_error_rad: f64,
    /// Standard deviation of the magnitude, as a fraction.
    pub magnitude_error: f64,
    /// Times before the arrival, in s, in order.
    pub approach_s: Vec<At<f64>>,
    /// Time of the departure manoeuvre after the arrival.
    pub departure_s: f64,
    /// Time at which both paths meet again.
    pub next: At<values::Instant>,
}

/// `[montecarlo]`.
#[derive(Clone, Copy, Debug)]
pub struct MonteCarlo {
    /// Number of flights.
    pub runs: usize,
    /// Seed of the draws.
    pub seed: u64,
    /// Standard deviation of each coordinate of the centre of mass.
    pub center_of_mass_m: f64,
    /// Standard deviation of `solar.scale`.
    pub scale: f64,
}

impl Builder<'_> {
    pub(super) fn flyby(&mut self, place: &Place<'_>, flyby: FlybyDescription) -> Option<Flyby> {
        let [b_t_m, b_r_m, altitude_m] =
            [("bT", &flyby.b_t), ("bR", &flyby.b_r), ("altitude", &flyby.altitude)]
                .map(|(key, written)| self.length(&place.key(key), written.as_deref()));
        let allowed = format_args!("an angle {ALLOWED_ANGLE}");
        let angle_rad = self.read(&place.key("angle"), flyby.angle.as_deref(), Written::angle_rad, allowed);
        let aimpoint = match (b_t_m, b_r_m, altitude_m, angle_rad) {
            (Some(b_t_m), Some(b_r_m), None, None) => Some((FlybyAimpoint::Plane { b_t_m, b_r_m }, "bT")),
            (None, None, Some(altitude_m), Some(angle_rad)) => {
                if altitude_m < 0.0 {
                    let found = format!("{altitude_m} m, inside of the planet");
                    place.key("altitude").report(found, "an altitude from 0 on");
                }
                Some((FlybyAimpoint::Altitude { altitude_m, angle_rad }, "altitude"))
            }
            (None, None, None, None) => None,
            _ => {
                place.report("no whole aim, or two", "either bT and bR, or altitude and angle");
                None
            }
        };
        let arrival = place.key("arrival");
        let is_fixed = match flyby.arrival.as_deref() {
            None | Some("free") => false,
            Some("fixed") => true,
            Some(found) => {
                arrival.report(format_args!("{found:?}"), "free or fixed");
                false
            }
        };
        let time = match (&flyby.time, is_fixed) {
            (Some(written), true) => self.instant_at(&place.key("time"), written),
            (None, true) => {
                arrival.report("fixed without time", "time = a date, beside it");
                None
            }
            (Some(_), false) => {
                place.key("time").report("it", "arrival = \"fixed\" beside it");
                None
            }
            (None, false) => None,
        };
        let from = flyby.from.as_ref().and_then(|written| self.instant_at(&place.key("from"), written));
        let tolerance = place.key("tolerance");
        let tolerance_m = self.length(&tolerance, flyby.tolerance.as_deref()).unwrap_or(1e3);
        if let Some(written) = flyby.tolerance.as_deref().filter(|_| tolerance_m < MIN_TOLERANCE_M) {
            tolerance.report(written, "a length from 1 m on");
        }
        if aimpoint.is_none() && is_fixed {
            arrival.report("fixed without an aim", "bT and bR, or altitude and angle, beside it");
        }
        Some(Flyby {
            body: self.at(&place.key("body"), flyby.body),
            aimpoint: aimpoint.map(|(aimpoint, key)| self.at(&place.key(key), aimpoint)),
            time,
            from,
            tolerance_m,
        })
    }

    pub(super) fn update(&mut self, place: &Place<'_>, update: UpdateDescription) -> Option<Update> {
        let at = self.instant_at(&place.key("at"), &update.at);
        let [position_m, velocity_m_s] =
            [("position", update.position), ("velocity", update.velocity)].map(|(key, vector)| {
                let vector = vector?;
                let is_finite = vector.iter().all(|component| component.is_finite());
                if !is_finite {
                    place.key(key).report(format_args!("{vector:?}"), "three finite numbers");
                }
                Some(Vector3::from(vector))
            });
        let covariance = update.covariance.and_then(|path| {
            let key = place.key("covariance");
            let file = self.path(&key, &path, Path::is_file);
            let found = file.is_file().then(|| covariance(&file))?;
            found.map_err(|(found, allowed)| key.report(found, allowed)).ok()
        });
        Some(Update { at: at?, position_m, velocity_m_s, covariance })
    }

    pub(super) fn compare(&mut self, place: &Place<'_>, compare: CompareDescription) -> Option<Compare> {
        let direction = place.key("directionError");
        let direction_error_rad = self.angle(&direction, compare.direction_error.as_deref());
        let magnitude = place.key("magnitudeError");
        let magnitude_error = self.share(&magnitude, compare.magnitude_error.as_deref(), 1e-3, 1.0);
        let list = place.key("approach");
        let mut approach_s: Vec<At<f64>> = Vec::new();
        if compare.approach.is_none() {
            approach_s.push(self.at(&list.item(0), APPROACH_S));
        }
        for (index, written) in compare.approach.iter().flatten().enumerate() {
            let place = list.item(index);
            let last_s = approach_s.last().map_or(f64::NEG_INFINITY, |last| last.it);
            let before_s = |written: &Written| written.duration_s().filter(|it| *it < 0.0 && *it > last_s);
            let allowed = "times before the arrival, less than 0, in order: [\"-42 d\", \"-10 d\"]";
            let before_s = self.read(&place, Some(written), before_s, allowed);
            approach_s.extend(before_s.map(|before_s| self.at(&place, before_s)));
        }
        let departure = place.key("departure");
        let departure_s = self.span(&departure, compare.departure.as_deref(), 30.0 * DAY_S, 3600.0);
        let next = self.instant_at(&place.key("next"), &compare.next);
        Some(Compare {
            direction_error_rad: direction_error_rad.unwrap_or(0.2_f64.to_radians()),
            magnitude_error,
            approach_s,
            departure_s,
            next: next?,
        })
    }

    pub(super) fn monte_carlo(&mut self, place: &Place<'_>, table: MonteCarloDescription) -> MonteCarlo {
        let runs = place.key("runs");
        let count = match table.runs.as_deref() {
            None => 200,
            written => self.count(&runs, written, 0).unwrap_or(0) as usize,
        };
        if !(2..=MAX_RUNS).contains(&count) {
            runs.report(count, format_args!("from 2 to {MAX_RUNS}"));
        }
        let seed = self.count(&place.key("seed"), table.seed.as_deref(), 0).unwrap_or(1);
        let deviation_m = |written: &Written| written.quantity("m").filter(|it| *it >= 0.0);
        let deviation = |written: &Written| written.number().filter(|it| *it >= 0.0 && it.is_finite());
        let [center, scale] = ["centerOfMass", "scale"].map(|key| place.key(key));
        let center_of_mass_m =
            self.read(&center, table.center_of_mass.as_deref(), deviation_m, ALLOWED_LENGTH).unwrap_or(0.0);
        let scale = self.read(&scale, table.scale.as_deref(), deviation, "a number from 0 on").unwrap_or(0.0);
        MonteCarlo { runs: count, seed, center_of_mass_m, scale }
    }
}

/// Six rows of six numbers; what was found and what is allowed where they are none, or no covariance.
fn covariance(file: &Path) -> Result<Matrix6<f64>, (String, &'static str)> {
    let shown = file.display();
    let text = files::read_text(file).map_err(|error| (error, "a file that can be read"))?;
    let rows = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let rows = rows.map(|line| line.split(',').map(|cell| cell.trim().parse::<f64>()).collect());
    let rows: Vec<Vec<f64>> = rows.collect::<Result<_, _>>().unwrap_or_default();
    let is_whole =
        rows.len() == 6 && rows.iter().all(|row| row.len() == 6 && row.iter().all(|it| it.is_finite()));
    if !is_whole {
        return Err((
            format!("{shown}, not six rows of six numbers"),
            "six rows of six finite numbers, with commas",
        ));
    }
    let found = Matrix6::from_fn(|row, column| rows[row][column]);
    // In units of the deviations: positions and velocities differ by orders of magnitude.
    let unit = found.diagonal().map(|variance| if variance > 0.0 { variance.sqrt().recip() } else { 0.0 });
    let scaled = Matrix6::from_fn(|row, column| found[(row, column)] * unit[row] * unit[column]);
    if (scaled - scaled.transpose()).amax() > 1e-6 {
        return Err((format!("{shown}, not symmetric"), "a covariance, which is symmetric"));
    }
    let least = SymmetricEigen::new(scaled).eigenvalues.min();
    if found.diagonal().min() <= 0.0 || least <= 0.0 {
        return Err((
            format!("{shown}, with the least eigenvalue {least:.3e} in units of the deviations"),
            "a covariance, which is positive",
        ));
    }
    Ok(0.5 * (found + found.transpose()))
}
