//! Distributions of the values of a variable.

use statrs::distribution::{ContinuousCDF, Normal};

/// A variable and how it varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// Its name.
    pub name: String,
    /// Distribution of its values, in the variable's unit.
    pub distribution: Distribution,
}

/// A distribution, or a list of values.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, above 0.
        sigma: f64,
    },
    /// The same density between two numbers.
    Uniform {
        /// The smaller number.
        from: f64,
        /// The larger one.
        to: f64,
    },
    /// Whose logarithm is uniform; both numbers are above 0.
    LogUniform {
        /// The smaller number.
        from: f64,
        /// The larger one.
        to: f64,
    },
    /// A density that rises linearly to its mode and falls linearly from there.
    Triangular {
        /// The smallest number.
        from: f64,
        /// The most likely one, between the others.
        mode: f64,
        /// The largest one.
        to: f64,
    },
    /// Each value as likely as any other.
    Values(Vec<f64>),
    /// The same, evenly spaced.
    Steps(Vec<f64>),
}

impl Distribution {
    /// Evenly spaced values, both ends among them; the middle where there is one.
    pub fn steps(from: f64, to: f64, count: usize) -> Self {
        let last = count.saturating_sub(1);
        let value = |k: usize| match k {
            0 if last == 0 => 0.5 * (from + to),
            // The end to the bit.
            _ if k == last => to,
            _ => from + (to - from) * k as f64 / last as f64,
        };
        Self::Steps((0..count).map(value).collect())
    }

    /// Its key in a campaign.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Normal { .. } => "normal",
            Self::Uniform { .. } => "uniform",
            Self::LogUniform { .. } => "logUniform",
            Self::Triangular { .. } => "triangular",
            Self::Values(_) => "values",
            Self::Steps(_) => "steps",
        }
    }

    /// Its values, where it is a list.
    pub fn listed(&self) -> Option<&[f64]> {
        match self {
            Self::Values(list) | Self::Steps(list) => Some(list),
            _ => None,
        }
    }

    /// The value below which this share of the values lies.
    pub fn quantile(&self, share: f64) -> f64 {
        match *self {
            Self::Normal { mean, sigma } => mean + sigma * standard_normal(share),
            Self::Uniform { from, to } => from + share * (to - from),
            Self::LogUniform { from, to } => from * (share * (to / from).ln()).exp(),
            Self::Triangular { from, mode, to } => {
                let below = (mode - from) / (to - from);
                if share < below {
                    from + (share * (to - from) * (mode - from)).sqrt()
                } else {
                    to - ((1.0 - share) * (to - from) * (to - mode)).sqrt()
                }
            }
            Self::Values(ref list) | Self::Steps(ref list) => {
                list[((share * list.len() as f64) as usize).min(list.len().saturating_sub(1))]
            }
        }
    }

    /// Mean and standard deviation.
    pub fn moments(&self) -> (f64, f64) {
        match *self {
            Self::Normal { mean, sigma } => (mean, sigma),
            Self::Uniform { from, to } => (0.5 * (from + to), (to - from) / 12.0_f64.sqrt()),
            Self::LogUniform { from, to } => {
                let width = (to / from).ln();
                let mean = (to - from) / width;
                (mean, ((to * to - from * from) / (2.0 * width) - mean * mean).max(0.0).sqrt())
            }
            Self::Triangular { from, mode, to } => {
                let squares = from * from + mode * mode + to * to;
                let products = from * mode + mode * to + from * to;
                ((from + mode + to) / 3.0, ((squares - products) / 18.0).max(0.0).sqrt())
            }
            Self::Values(ref list) | Self::Steps(ref list) => {
                let count = list.len() as f64;
                let mean = list.iter().sum::<f64>() / count;
                let variance = list.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
                (mean, variance.sqrt())
            }
        }
    }
}

/// The value below which this share of a standard normal distribution lies.
pub(super) fn standard_normal(share: f64) -> f64 {
    Normal::standard().inverse_cdf(share)
}
