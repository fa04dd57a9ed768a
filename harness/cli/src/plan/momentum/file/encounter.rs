//! Tables of a plan about a flyby, in SI: aim, state from orbit determination, manoeuvres compared, flights with errors.

use nalgebra::{Matrix6, SymmetricEigen, Vector3};
use physics::toml::Place;

use crate::{
    mission::{At, Written},
    plan::{
        momentum::description::{
            CompareDescription, FlybyDescription, MonteCarloDescription, UpdateDescription,
        },
        reading::{ALLOWED_ANGLE, ALLOWED_LENGTH, Builder, DAY_S, number, quantity},
    },
    values,
};

/// Least miss that can be a tolerance, in m.
const LEAST_TOLERANCE_M: f64 = 1.0;
/// Most flights with errors.
const MOST_RUNS: usize = 100_000;

/// Where the B-plane is to be met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plan) enum GivenAimpoint {
    /// B along T and R, in m.
    BPlane([f64; 2]),
    /// Altitude of the closest approach in m, angle of B from T toward R in rad.
    Altitude([f64; 2]),
}

/// `[flyby]`.
#[derive(Clone, Debug)]
pub(in crate::plan) struct Flyby {
    pub body: At<String>,
    pub aimpoint: At<GivenAimpoint>,
    /// When the spacecraft arrives, where that is a goal.
    pub time: Option<At<values::Instant>>,
    pub from: Option<At<values::Instant>>,
    pub tolerance_m: f64,
}

/// `[update]`.
#[derive(Clone, Debug)]
pub(in crate::plan) struct Update {
    pub at: At<values::Instant>,
    pub position_m: Option<Vector3<f64>>,
    pub velocity_m_s: Option<Vector3<f64>>,
    pub covariance: Option<Matrix6<f64>>,
}

/// `[compare]`.
#[derive(Clone, Debug)]
pub(in crate::plan) struct Compare {
    pub direction_error_rad: f64,
    pub magnitude_error: f64,
    /// Times before the arrival, in s, in order.
    pub approach_s: Vec<At<f64>>,
    pub departure_s: f64,
    pub next: At<values::Instant>,
}

/// `[montecarlo]`.
#[derive(Clone, Copy, Debug)]
pub(in crate::plan) struct MonteCarlo {
    pub runs: usize,
    pub seed: u64,
    pub center_of_mass_m: f64,
    pub scale: f64,
}

impl Builder<'_> {
    fn length(&mut self, place: &Place, written: Option<&Written>) -> Option<f64> {
        let written = written?;
        let length_m = quantity(written, "m");
        if length_m.is_none() && !self.check.has_stand_in(place) {
            self.check.report(place, written, ALLOWED_LENGTH);
        }
        length_m
    }

    /// A number from 0 on.
    fn least_zero(&mut self, place: &Place, written: Option<&Written>, default: f64, unit: &str) -> f64 {
        let Some(written) = written else { return default };
        let (value, allowed) = match unit {
            "m" => (quantity(written, "m"), ALLOWED_LENGTH),
            _ => (number(written), "a number from 0 on"),
        };
        value.filter(|value| *value >= 0.0 && value.is_finite()).unwrap_or_else(|| {
            self.check.report(place, written, allowed);
            default
        })
    }

    pub(super) fn flyby(&mut self, place: &Place, flyby: FlybyDescription) -> Option<Flyby> {
        let [b_t_m, b_r_m, altitude_m] =
            [("bT", &flyby.b_t), ("bR", &flyby.b_r), ("altitude", &flyby.altitude)]
                .map(|(key, written)| self.length(&place.key(key), written.as_ref()));
        let angle_place = place.key("angle");
        let angle_rad = flyby.angle.as_ref().and_then(|written| {
            let angle_rad = match written {
                Written::Text(text) => values::angle(text).ok(),
                _ => number(written),
            };
            if angle_rad.is_none() {
                self.check.report(&angle_place, written, ALLOWED_ANGLE.trim_start());
            }
            angle_rad
        });
        let aimpoint = match (b_t_m, b_r_m, altitude_m, angle_rad) {
            (Some(b_t_m), Some(b_r_m), None, None) => Some((GivenAimpoint::BPlane([b_t_m, b_r_m]), "bT")),
            (None, None, Some(altitude_m), Some(angle_rad)) => {
                if altitude_m < 0.0 {
                    let found = format!("{altitude_m} m, inside of the planet");
                    self.check.report(&place.key("altitude"), found, "an altitude from 0 on");
                }
                Some((GivenAimpoint::Altitude([altitude_m, angle_rad]), "altitude"))
            }
            _ => {
                self.check.report(place, "no whole aim, or two", "either bT and bR, or altitude and angle");
                None
            }
        };
        let arrival = place.key("arrival");
        let is_fixed = match flyby.arrival.as_deref() {
            None | Some("free") => false,
            Some("fixed") => true,
            Some(found) => {
                self.check.report(&arrival, format_args!("{found:?}"), "free or fixed");
                false
            }
        };
        let time = match (&flyby.time, is_fixed) {
            (Some(written), true) => {
                let key = place.key("time");
                let instant = self.instant(&key, written);
                instant.map(|instant| self.at(&key, instant))
            }
            (None, true) => {
                self.check.report(&arrival, "fixed without time", "time = a date, beside it");
                None
            }
            (Some(_), false) => {
                self.check.report(&place.key("time"), "it", "arrival = \"fixed\" beside it");
                None
            }
            (None, false) => None,
        };
        let from = flyby.from.as_ref().and_then(|written| {
            let key = place.key("from");
            let instant = self.instant(&key, written);
            instant.map(|instant| self.at(&key, instant))
        });
        let tolerance = place.key("tolerance");
        let tolerance_m = self.length(&tolerance, flyby.tolerance.as_ref()).unwrap_or(1e3);
        if let Some(written) = flyby.tolerance.as_ref().filter(|_| tolerance_m < LEAST_TOLERANCE_M) {
            self.check.report(&tolerance, written, "a length from 1 m on");
        }
        let (aimpoint, key) = aimpoint?;
        Some(Flyby {
            body: self.at(&place.key("body"), flyby.body),
            aimpoint: self.at(&place.key(key), aimpoint),
            time,
            from,
            tolerance_m,
        })
    }

    pub(super) fn update(&mut self, place: &Place, update: UpdateDescription) -> Option<Update> {
        let at = place.key("at");
        let instant = self.instant(&at, &update.at);
        let [position_m, velocity_m_s] =
            [("position", update.position), ("velocity", update.velocity)].map(|(key, vector)| {
                let vector = vector?;
                let is_finite = vector.iter().all(|component| component.is_finite());
                if !is_finite {
                    self.check.report(&place.key(key), format_args!("{vector:?}"), "three finite numbers");
                }
                Some(Vector3::from(vector))
            });
        let covariance = update.covariance.and_then(|path| {
            let key = place.key("covariance");
            let file = self.path(&key, &path);
            let found = file.is_file().then(|| covariance(&file))?;
            found.map_err(|(found, allowed)| self.check.report(&key, found, allowed)).ok()
        });
        Some(Update { at: self.at(&at, instant?), position_m, velocity_m_s, covariance })
    }

    pub(super) fn compare(&mut self, place: &Place, compare: CompareDescription) -> Option<Compare> {
        let direction = place.key("directionError");
        let direction_error_rad = self.angle(&direction, compare.direction_error.as_ref());
        let magnitude = place.key("magnitudeError");
        let magnitude_error = self.share(&magnitude, compare.magnitude_error.as_ref(), 1e-3, 1.0);
        let list = place.key("approach");
        let mut approach_s: Vec<At<f64>> = Vec::new();
        let written = compare.approach.unwrap_or_else(|| vec![Written::Text("-42 d".to_owned())]);
        for (index, written) in written.iter().enumerate() {
            let place = list.item(index);
            let before = written.setting().and_then(|text| values::duration(&text).ok());
            let last_s = approach_s.last().map_or(f64::NEG_INFINITY, |last| last.it);
            match before.filter(|before_s| *before_s < 0.0 && *before_s > last_s) {
                Some(before_s) => approach_s.push(self.at(&place, before_s)),
                None => {
                    let allowed = "times before the arrival, less than 0, in order: [\"-42 d\", \"-10 d\"]";
                    self.check.report(&place, written, allowed);
                }
            }
        }
        let departure = place.key("departure");
        let departure_s = self.span(&departure, compare.departure.as_ref(), 30.0 * DAY_S, 3600.0);
        let next = place.key("next");
        let instant = self.instant(&next, &compare.next);
        Some(Compare {
            direction_error_rad: direction_error_rad.unwrap_or(0.2_f64.to_radians()),
            magnitude_error,
            approach_s,
            departure_s,
            next: self.at(&next, instant?),
        })
    }

    pub(super) fn monte_carlo(&mut self, place: &Place, table: MonteCarloDescription) -> MonteCarlo {
        let runs = place.key("runs");
        let count = table.runs.as_ref().map_or(200, |written| self.count(&runs, Some(written)));
        if !(2..=MOST_RUNS).contains(&count) {
            self.check.report(&runs, count, format_args!("from 2 to {MOST_RUNS}"));
        }
        let seed = place.key("seed");
        let seed = table.seed.as_ref().map_or(1, |written| self.count(&seed, Some(written)) as u64);
        MonteCarlo {
            runs: count,
            seed,
            center_of_mass_m: self.least_zero(
                &place.key("centerOfMass"),
                table.center_of_mass.as_ref(),
                0.0,
                "m",
            ),
            scale: self.least_zero(&place.key("scale"), table.scale.as_ref(), 0.0, "1"),
        }
    }
}

/// Six rows of six numbers; what was found and what is allowed where they are none, or no covariance.
fn covariance(file: &std::path::Path) -> Result<Matrix6<f64>, (String, &'static str)> {
    let shown = file.display();
    let text = files::read_text(file).map_err(|error| (error, "a file that can be read"))?;
    let rows = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let cells: Vec<Vec<Option<f64>>> = rows
        .map(|line| {
            line.split(',').map(|cell| cell.trim().parse().ok().filter(|it: &f64| it.is_finite())).collect()
        })
        .collect();
    let is_whole =
        cells.len() == 6 && cells.iter().all(|row| row.len() == 6 && row.iter().all(Option::is_some));
    if !is_whole {
        return Err((
            format!("{shown}, not six rows of six numbers"),
            "six rows of six finite numbers, with commas",
        ));
    }
    let found = Matrix6::from_fn(|row, column| cells[row][column].unwrap_or(f64::NAN));
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
