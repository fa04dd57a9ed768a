//! Running SpinPlant by the names of its variables.

use loader::{Fmu, Value};

use crate::{Options, StudyError};

/// The paper's thruster force, in N (after eq 2).
pub const FORCE_N: f64 = 4.448;
/// Arm of a lower-deck radial thruster, in m (Table 1).
pub const RADIAL_ARM_M: f64 = 0.40;
/// Arm of an upper-deck axial thruster, in m (Table 1).
pub const AXIAL_ARM_M: f64 = 0.78;
/// The paper's average spin inertia, in kg m2 (after eq 3).
pub const SPIN_INERTIA_KG_M2: f64 = 353.82;
/// Nominal spin rate, in rad/s (after eq 2).
pub const RATE_RAD_S: f64 = core::f64::consts::PI / 6.0;
/// Nominal spin period, in s.
pub const PERIOD_S: f64 = 12.0;
/// The ratio of the paper's figures.
pub const RATIO: f64 = 1.483;

/// One simulation: what is set, how long and how finely.
#[derive(Clone, Debug)]
pub struct Case {
    /// For messages and tables.
    pub label: String,
    sets: Vec<(String, Value)>,
    stop_s: f64,
    step_s: f64,
}

/// Recorded columns, in the order asked for, and the communication points.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// Communication points, in s.
    pub times_s: Vec<f64>,
    /// Columns.
    pub columns: Vec<Vec<f64>>,
}

impl Simulated {
    /// Last value of a column.
    pub fn last(&self, column: usize) -> f64 {
        self.columns[column].last().copied().unwrap_or(f64::NAN)
    }

    /// Greatest value of a column.
    pub fn most(&self, column: usize) -> f64 {
        self.columns[column].iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Case {
    /// The paper's body, undamped, for `stop_s`.
    pub fn new(label: impl Into<String>, stop_s: f64, step_s: f64) -> Self {
        Self { label: label.into(), sets: Vec::new(), stop_s, step_s }
            .ratio(RATIO)
            .real("damper.timeConstant", 0.0)
    }

    /// For `stop_s` in steps of `step_s` instead.
    pub fn grid(mut self, stop_s: f64, step_s: f64) -> Self {
        (self.stop_s, self.step_s) = (stop_s, step_s);
        self
    }

    /// Sets a Real.
    pub fn real(mut self, name: &str, value: f64) -> Self {
        self.sets.retain(|(known, _)| known != name);
        self.sets.push((name.to_owned(), Value::Real(value)));
        self
    }

    /// Sets an Integer or the number of an option.
    pub fn integer(mut self, name: &str, value: i32) -> Self {
        self.sets.push((name.to_owned(), Value::Integer(value)));
        self
    }

    /// An axisymmetric body of this ratio.
    pub fn ratio(self, ratio: f64) -> Self {
        self.triaxial(ratio, 1.0)
    }

    /// A body of I3/sqrt(I1 I2) = `ratio` and I1/I2 = `quotient`.
    pub fn triaxial(self, ratio: f64, quotient: f64) -> Self {
        let transverse = SPIN_INERTIA_KG_M2 / ratio;
        self.real("inertia[1]", transverse * quotient.sqrt())
            .real("inertia[2]", transverse / quotient.sqrt())
            .real("inertia[3]", SPIN_INERTIA_KG_M2)
    }

    /// Runs it and returns the columns of `names`.
    pub fn simulate(&self, fmu: &Fmu, names: &[&str]) -> Result<Simulated, StudyError> {
        let failed = |source: Box<dyn std::error::Error + Send + Sync>| StudyError::Simulation {
            case: self.label.clone(),
            source,
        };
        let record = names
            .iter()
            .map(|name| fmu.position(name).ok_or_else(|| failed(format!("no variable {name}").into())))
            .collect::<Result<Vec<_>, _>>()?;
        let options = loader::Options {
            stop_s: Some(self.stop_s),
            step_s: Some(self.step_s),
            sets: self.sets.clone(),
            record: Some(record),
            ..loader::Options::default()
        };
        let recording =
            loader::simulate(fmu, options).map_err(|stopped| failed(Box::new(*stopped)))?.recording;
        let columns = names
            .iter()
            .map(|name| {
                let column = recording.column(name).map(loader::Column::numbers);
                column.ok_or_else(|| failed(format!("{name} was not recorded").into()))
            })
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Simulated { times_s: recording.times_s, columns })
    }
}

/// Eq 8 with `kick` for Gamma/n.
pub fn eq8(kick: f64, phase_rad: f64, count: f64) -> f64 {
    kick * ((1.0 - (count * phase_rad).cos()) / (1.0 - phase_rad.cos())).sqrt()
}

/// Pulse width whose manoeuvre by eq 3 is `angle_rad`, in s; `None` beyond half a turn.
pub fn width_s(angle_rad: f64, arm_m: f64) -> Option<f64> {
    let sine = angle_rad * SPIN_INERTIA_KG_M2 * RATE_RAD_S * RATE_RAD_S / (2.0 * FORCE_N * arm_m);
    (sine <= 1.0).then(|| 2.0 * sine.asin() / RATE_RAD_S)
}

/// Those of `labels` that the options leave; an error if none.
pub fn left<'a>(
    study: &'static str,
    options: &Options,
    labels: impl Iterator<Item = &'a str> + Clone,
) -> Result<Vec<&'a str>, StudyError> {
    let only = options.only.as_deref().unwrap_or_default();
    let left: Vec<&str> = labels.clone().filter(|label| label.contains(only)).collect();
    if left.is_empty() {
        let known = listed(&labels.collect::<Vec<_>>());
        return Err(StudyError::NothingLeft { study, only: only.to_owned(), known });
    }
    Ok(left)
}

/// Most labels that are listed one by one.
const MOST_LISTED: usize = 12;

/// The labels one below the other; of many the first and the last.
fn listed(labels: &[&str]) -> String {
    if labels.len() <= MOST_LISTED {
        return labels.join("\n  ");
    }
    let ends = [&labels[..2], &["..."], &labels[labels.len() - 1..]].concat();
    format!("{} ({} of them)", ends.join(", "), labels.len())
}

#[cfg(test)]
mod tests {
    //! A filter that leaves nothing says what there is, in a few lines.
    use super::*;

    #[test]
    fn many_cases_are_not_listed_one_by_one() {
        assert_eq!(listed(&["a", "b"]), "a\n  b");
        let labels: Vec<String> = (1..=120).map(|n| format!("n = {n}")).collect();
        let text = listed(&labels.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(text, "n = 1, n = 2, ..., n = 120 (120 of them)");
    }
}
