//! How runs are spread over what varies.

use sobol_burley::NUM_DIMENSIONS;

use super::{
    distribution::Varied,
    error::{DesignError, DesignPart},
};

/// Runs of a campaign at most.
pub const MAX_RUNS: u64 = 1_000_000_000;
/// Number of points of the Sobol sequence that the crate has.
const MAX_SOBOL_RUNS: u64 = 1 << 16;
/// Strata of a Latin hypercube, of all variables together: every process holds them in 4 bytes each.
const MAX_STRATA: u64 = 1 << 25;

/// Sampling of the values of runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Sampling {
    /// Independent draws.
    Random,
    /// One run in each of as many strata as there are runs, of every variable.
    LatinHypercube,
    /// The points of the Sobol sequence, not scrambled.
    Sobol,
    /// Every combination of listed values.
    Grid,
    /// All at their means, then each a standard deviation below and above.
    OneAtATime,
    /// The rows of a table.
    File(Vec<Vec<f64>>),
}

impl Sampling {
    /// Its word in a campaign.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::LatinHypercube => "latinHypercube",
            Self::Sobol => "sobol",
            Self::Grid => "grid",
            Self::OneAtATime => "oneAtATime",
            Self::File(_) => "file",
        }
    }

    /// Refuses distributions that it does not take.
    pub(super) fn check(&self, varied: &[Varied]) -> Result<(), DesignError> {
        for Varied { name, distribution } in varied {
            let refused = |what: String| Err(DesignError::new(DesignPart::Variable(name.clone()), what));
            if distribution.listed().is_some_and(<[f64]>::is_empty) {
                return refused(format!("found {name} without a value, allowed: at least one value"));
            }
            if *self == Self::Grid && distribution.listed().is_none() {
                let found = format!("found {name} as {} with sampling {}", distribution.key(), self.key());
                return refused(format!("{found}, allowed: values and steps"));
            }
        }
        let count = varied.len();
        if *self == Self::Sobol && count > NUM_DIMENSIONS as usize {
            let what =
                format!("found {count} variables with sampling sobol, allowed: up to {NUM_DIMENSIONS}");
            return Err(DesignError::new(DesignPart::Campaign, what));
        }
        Ok(())
    }

    /// How many runs there are.
    pub(super) fn runs(&self, varied: &[Varied], given: Option<u64>) -> Result<u64, DesignError> {
        let own = match self {
            Self::Grid => {
                let counts =
                    varied.iter().filter_map(|it| it.distribution.listed()).map(|list| list.len() as u64);
                Some(counts.fold(1_u64, u64::saturating_mul))
            }
            Self::OneAtATime => Some(2 * varied.len() as u64 + 1),
            Self::File(rows) => Some(rows.len() as u64),
            Self::Random | Self::LatinHypercube | Self::Sobol => None,
        };
        let most = match self {
            Self::Sobol => MAX_SOBOL_RUNS,
            Self::LatinHypercube => MAX_STRATA / (varied.len() as u64).max(1),
            _ => MAX_RUNS,
        };
        let count = given.or(own);
        let refused = |allowed: String| {
            let found = count.map_or_else(|| "no `runs`".to_owned(), |found| format!("{found} runs"));
            Err(DesignError::new(DesignPart::Runs, format!("found {found}, allowed: {allowed}")))
        };
        if let Some(own) = own.filter(|own| given.is_some_and(|given| given != *own)) {
            return refused(format!("{own}, which sampling {} has, or no `runs`", self.key()));
        }
        let runs = count.unwrap_or(0);
        if !(1..=most).contains(&runs) {
            return refused(format!("1 to {most} with sampling {}", self.key()));
        }
        Ok(runs)
    }
}
