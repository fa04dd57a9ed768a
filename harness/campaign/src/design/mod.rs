//! The values of every run.

mod distribution;
mod error;
mod sampling;
#[cfg(test)]
mod tests;

use nalgebra::{DMatrix, DVector};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};
use sobol_burley::parts::sobol_rev;

pub use distribution::{Distribution, Varied};
pub use error::{DesignError, DesignPart};
pub use sampling::{MAX_RUNS, Sampling};

/// 2^-32 and 2^-53.
const PER_32_BITS: f64 = 1.0 / 4_294_967_296.0;
const PER_53_BITS: f64 = 1.0 / 9_007_199_254_740_992.0;
/// Streams of the generator for permutations; below are those of the draws, by variable.
const PERMUTATIONS: u64 = 1 << 32;

/// A correlation of two normally distributed variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation {
    /// Their names.
    pub names: [String; 2],
    /// From -1 to 1.
    pub coefficient: f64,
}

/// The values of every run of a campaign.
#[derive(Clone, Debug)]
pub struct Design {
    varied: Vec<Varied>,
    sampling: Sampling,
    runs: u64,
    seed: u64,
    /// Lower triangular root of the correlation matrix of all variables, where any are correlated.
    root: Option<DMatrix<f64>>,
    /// Permutations of a Latin hypercube's strata, by variable.
    strata: Vec<Vec<u32>>,
}

impl Design {
    /// Design of a campaign; grids and one-at-a-time designs have a number of runs of their own, which `runs` equals where it is given.
    ///
    /// # Errors
    /// What cannot be drawn from.
    pub fn new(
        varied: Vec<Varied>,
        (sampling, runs): (Sampling, Option<u64>),
        correlations: &[Correlation],
        seed: u64,
    ) -> Result<Self, DesignError> {
        if varied.is_empty() {
            let what =
                "found nothing that varies, allowed: at least one variable in `vary`, or a file with values";
            return Err(DesignError::new(DesignPart::Campaign, what));
        }
        sampling.check(&varied)?;
        let runs = sampling.runs(&varied, runs)?;
        let root = root(&varied, &sampling, correlations)?;
        let mut design = Self { varied, sampling, runs, seed, root, strata: Vec::new() };
        if design.sampling == Sampling::LatinHypercube {
            design.strata = (0..design.varied.len()).map(|variable| design.permutation(variable)).collect();
        }
        Ok(design)
    }

    /// The variables in the order of their values.
    pub fn varied(&self) -> &[Varied] {
        &self.varied
    }

    /// How their values are chosen.
    pub fn sampling(&self) -> &Sampling {
        &self.sampling
    }

    /// How many runs there are.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// The values of a run, in the variables' units.
    pub fn values(&self, run: u64) -> Vec<f64> {
        let variables = 0..self.varied.len();
        match &self.sampling {
            Sampling::File(rows) => rows[run as usize].clone(),
            Sampling::Grid => self.grid(run),
            Sampling::OneAtATime => variables.map(|variable| self.one_at_a_time(variable, run)).collect(),
            _ => self.drawn(run, variables.map(|variable| self.uniform(variable, run)).collect()),
        }
    }

    /// A number between 0 and 1 for a variable in a run.
    fn uniform(&self, variable: usize, run: u64) -> f64 {
        match &self.sampling {
            Sampling::Sobol => {
                // The order of Gray's code, which SciPy and most others take.
                let index = (run ^ (run >> 1)) as u32;
                f64::from(sobol_rev(index.reverse_bits(), variable as u32).reverse_bits()) * PER_32_BITS
            }
            Sampling::LatinHypercube => {
                let stratum = f64::from(self.strata[variable][run as usize]);
                (stratum + self.random(variable, run)) / self.runs as f64
            }
            _ => self.random(variable, run),
        }
    }

    fn random(&self, variable: usize, run: u64) -> f64 {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(variable as u64);
        generator.set_word_pos(2 * u128::from(run));
        // 53 random bits, shifted off 0 and 1.
        ((generator.next_u64() >> 11) as f64 + 0.5) * PER_53_BITS
    }

    /// The strata of a Latin hypercube in the order of runs, by Fisher and Yates.
    fn permutation(&self, variable: usize) -> Vec<u32> {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(PERMUTATIONS + variable as u64);
        let mut strata: Vec<u32> = (0..self.runs as u32).collect();
        for last in (1..strata.len()).rev() {
            let share = (generator.next_u64() >> 11) as f64 * PER_53_BITS;
            strata.swap(last, (share * (last + 1) as f64) as usize);
        }
        strata
    }

    /// Values at numbers between 0 and 1.
    fn drawn(&self, run: u64, uniform: Vec<f64>) -> Vec<f64> {
        let is_normal =
            |variable: usize| matches!(self.varied[variable].distribution, Distribution::Normal { .. });
        // The first Sobol point is 0, at which a normal distribution has no value: half a cell away from it and from 1.
        let inside = |share: f64| match self.sampling {
            Sampling::Sobol => share + 0.5 / self.runs.next_power_of_two() as f64,
            _ => share,
        };
        let standard = |variable: usize| match is_normal(variable) {
            true => distribution::standard_normal(inside(uniform[variable])),
            false => 0.0,
        };
        let independent = DVector::from_iterator(uniform.len(), (0..uniform.len()).map(standard));
        let normal = match &self.root {
            Some(root) => root * independent,
            None => independent,
        };
        debug_assert!(run < self.runs);
        let value = |(variable, varied): (usize, &Varied)| match varied.distribution {
            Distribution::Normal { mean, sigma } => mean + sigma * normal[variable],
            ref other => other.quantile(uniform[variable]),
        };
        self.varied.iter().enumerate().map(value).collect()
    }

    /// The last variable changes first.
    fn grid(&self, run: u64) -> Vec<f64> {
        let mut left = run;
        let mut values: Vec<f64> = Vec::with_capacity(self.varied.len());
        for varied in self.varied.iter().rev() {
            let list = varied.distribution.listed().unwrap_or_default();
            values.push(list[(left % list.len() as u64) as usize]);
            left /= list.len() as u64;
        }
        values.reverse();
        values
    }

    /// Run 0 has every mean, runs 2k+1 and 2k+2 variable k a standard deviation below and above it.
    fn one_at_a_time(&self, variable: usize, run: u64) -> f64 {
        let distribution = &self.varied[variable].distribution;
        let (mean, sigma) = distribution.moments();
        match run.checked_sub(2 * variable as u64 + 1) {
            Some(0) => mean - sigma,
            Some(1) => mean + sigma,
            _ => mean,
        }
    }
}

/// The lower triangular root of the correlation matrix.
fn root(
    varied: &[Varied],
    sampling: &Sampling,
    correlations: &[Correlation],
) -> Result<Option<DMatrix<f64>>, DesignError> {
    if correlations.is_empty() {
        return Ok(None);
    }
    let refused = |what: String| DesignError::new(DesignPart::Correlations, what);
    if !matches!(sampling, Sampling::Random | Sampling::LatinHypercube | Sampling::Sobol) {
        let found = format!("found a correlation with sampling {}", sampling.key());
        return Err(refused(format!("{found}, allowed: random, latinHypercube, sobol")));
    }
    let mut matrix = DMatrix::identity(varied.len(), varied.len());
    for Correlation { names, coefficient } in correlations {
        let [one, other] = names.each_ref().map(|name| {
            let variable = varied.iter().position(|varied| varied.name == *name);
            let normal =
                variable.filter(|it| matches!(varied[*it].distribution, Distribution::Normal { .. }));
            let what = || format!("found {name:?}, allowed: a variable in `vary` that is normal");
            normal.ok_or_else(|| refused(what()))
        });
        let (one, other) = (one?, other?);
        if one == other {
            return Err(refused(format!("found {:?} with itself, allowed: two variables", names[0])));
        }
        matrix[(one, other)] = *coefficient;
        matrix[(other, one)] = *coefficient;
    }
    let root = matrix.cholesky().map(|cholesky| cholesky.l());
    let what =
        "found correlations that no variables can have together, allowed: a matrix that is positive definite";
    root.map(Some).ok_or_else(|| refused(what.to_owned()))
}
