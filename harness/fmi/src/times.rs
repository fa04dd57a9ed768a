//! Communication points of a run.

use model_description::Description;

use crate::{Error, Fmu};

/// Start, stop and step of a run, in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// First communication point.
    pub start_s: f64,
    /// Last communication point.
    pub stop_s: f64,
    /// Distance of communication points; the last step is shortened to reach `stop_s`.
    pub step_s: f64,
}

impl Times {
    /// The times of a run: what is given, else the default experiment's, else something that just runs.
    pub fn from_fmu(
        fmu: &Fmu,
        start_s: Option<f64>,
        stop_s: Option<f64>,
        step_s: Option<f64>,
    ) -> Result<Self, Error> {
        let times = Self::of_default(fmu.description(), start_s, stop_s, step_s)?;
        times.fit(fmu)?;
        Ok(times)
    }

    /// The same of a description alone, whatever steps its FMUs take.
    pub fn of_default(
        description: &Description,
        start_s: Option<f64>,
        stop_s: Option<f64>,
        step_s: Option<f64>,
    ) -> Result<Self, Error> {
        let default = description.default_experiment.unwrap_or_default();
        let start_s = start_s.or(default.start_time).unwrap_or(0.0);
        let stop_s = stop_s.or(default.stop_time).unwrap_or(start_s + 1.0);
        let step_s = step_s.or(default.step_size).unwrap_or((stop_s - start_s) / 100.0);
        Self::new(start_s, stop_s, step_s)
    }

    /// Times of a run from its start, stop and step in s.
    pub fn new(start_s: f64, stop_s: f64, step_s: f64) -> Result<Self, Error> {
        if !start_s.is_finite() || !stop_s.is_finite() || stop_s <= start_s {
            return Err(Error::Times(format!(
                "the stop time {stop_s} s must be later than the start time {start_s} s: see --start and --stop"
            )));
        }
        if !(step_s.is_finite() && step_s > 0.0) {
            return Err(Error::Times(format!("the step {step_s} s must be positive: see --step")));
        }
        let reachable = (stop_s - start_s) / step_s;
        if reachable > 1e12 || start_s + step_s == start_s || stop_s - step_s == stop_s {
            return Err(Error::Times(format!(
                "a step of {step_s} s is too small for a run from {start_s} s to {stop_s} s: see --step"
            )));
        }
        Ok(Self { start_s, stop_s, step_s })
    }

    /// Refuses steps of two sizes for an FMU that takes one.
    pub fn fit(&self, fmu: &Fmu) -> Result<(), Error> {
        let Self { start_s, stop_s, step_s } = *self;
        let steps = (stop_s - start_s) / step_s;
        let fixed = !fmu.co_simulation()?.can_handle_variable_communication_step_size;
        if fixed && (steps - steps.round()).abs() > 1e-9 * steps.max(1.0) {
            return Err(Error::Times(format!(
                "the FMU takes steps of one size only, and {step_s} s does not divide the run from {start_s} s \
                 to {stop_s} s: see --step and --stop"
            )));
        }
        Ok(())
    }

    /// Number of steps.
    pub fn steps(&self) -> u64 {
        let steps = (self.stop_s - self.start_s) / self.step_s;
        let whole = steps.round();
        // A remainder below rounding is no step of its own.
        let count = if (steps - whole).abs() <= 1e-9 * whole.max(1.0) { whole } else { steps.ceil() };
        count.max(1.0) as u64
    }

    /// Communication point `k`, from a product and not a sum, so that it carries no accumulated error.
    pub fn point_s(&self, k: u64) -> f64 {
        if k >= self.steps() { self.stop_s } else { self.start_s + k as f64 * self.step_s }
    }
}

/// Communication points that are recorded: the start, the point nearest to every whole multiple of a time after it, and the last
/// one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedPoints {
    /// Time between two of them, in steps; at least one.
    spacing: f64,
    steps: u64,
}

impl RecordedPoints {
    /// Points of a run: all where no time is given.
    ///
    /// # Errors
    /// A time below 0.
    pub fn new(times: &Times, every_s: Option<f64>) -> Result<Self, Error> {
        let spacing = match every_s {
            None => 1.0,
            Some(every_s) if every_s >= 0.0 => (every_s / times.step_s).max(1.0),
            Some(every_s) => {
                return Err(Error::Times(format!(
                    "recording every {every_s} s is not possible, allowed: 0 s (at every step) or longer: see --every"
                )));
            }
        };
        Ok(Self { spacing, steps: times.steps() })
    }

    /// Whether communication point `k` is one.
    pub fn contain(&self, k: u64) -> bool {
        let multiple = (k as f64 / self.spacing).round();
        k == self.steps || (multiple * self.spacing).round() == k as f64
    }

    /// Number of these points.
    pub fn count(&self) -> u64 {
        // A multiple half a step after a point belongs to the next one.
        let multiples = ((self.steps as f64 + 0.5) / self.spacing).ceil() as u64;
        multiples + u64::from(((multiples - 1) as f64 * self.spacing).round() != self.steps as f64)
    }
}
