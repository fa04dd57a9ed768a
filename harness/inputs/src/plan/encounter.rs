//! Values of a plan about a flyby: its arrival, approach manoeuvres, the covariance of a state.

use std::path::Path;

use nalgebra::{Matrix6, SymmetricEigen};
use physics::toml::{Place, Written as _};
use serde::Deserialize;

use crate::reading::{At, Checked, InputFile, quantities::BeforeArrival, words};

/// Whether the time of an arrival is a goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase")]
pub enum Arrives {
    /// At any time.
    Free,
    /// At its time.
    Fixed,
}

words!(Arrives);

/// Times of approach manoeuvres, in order.
#[derive(Clone, Debug, Deserialize, schemars::JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub struct ApproachKey(Vec<At<BeforeArrival>>);

impl From<[&'static str; 1]> for ApproachKey {
    fn from(times: [&'static str; 1]) -> Self {
        Self(times.map(At::from).into())
    }
}

impl Checked for ApproachKey {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        self.0.check(at, folder);
        for (index, pair) in self.0.windows(2).enumerate() {
            let place = at.item(index + 1);
            if pair[1].it.value() <= pair[0].it.value() && !place.has_reported() {
                place.report(&pair[1].it, BeforeArrival::allowed());
            }
        }
    }
}

impl physics::toml::Written for ApproachKey {
    type Value = Vec<At<f64>>;

    fn value(&self) -> Self::Value {
        self.0.value()
    }
}

/// File with the covariance of a state.
#[derive(Clone, Debug, Deserialize, schemars::JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub struct CovarianceFile(InputFile, #[serde(skip)] Matrix6<f64>);

impl Checked for CovarianceFile {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        self.0.check(at, folder);
        if at.has_reported() {
            return;
        }
        match covariance(&self.0.value()) {
            Ok(found) => self.1 = found,
            Err((found, allowed)) => at.report(found, allowed),
        }
    }
}

impl physics::toml::Written for CovarianceFile {
    type Value = Matrix6<f64>;

    fn value(&self) -> Self::Value {
        self.1
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
