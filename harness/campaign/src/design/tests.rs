//! Designs against closed forms and what SciPy gives.

use approx::{assert_abs_diff_eq, assert_relative_eq};

use super::*;

fn varied(name: &str, distribution: Distribution) -> Varied {
    Varied { name: name.to_owned(), distribution }
}

fn design(varied: Vec<Varied>, sampling: Sampling, runs: u64) -> Design {
    Design::new(varied, (sampling, Some(runs)), &[], 1).unwrap()
}

const UNIT: Distribution = Distribution::Uniform { from: 0.0, to: 1.0 };

#[test]
fn sobol_points_are_those_of_scipy() {
    // scipy.stats.qmc.Sobol(d=4, scramble=False).random(8)
    let scipy = [
        [0.0, 0.0, 0.0, 0.0],
        [0.5, 0.5, 0.5, 0.5],
        [0.75, 0.25, 0.25, 0.25],
        [0.25, 0.75, 0.75, 0.75],
        [0.375, 0.375, 0.625, 0.875],
        [0.875, 0.875, 0.125, 0.375],
        [0.625, 0.125, 0.875, 0.625],
        [0.125, 0.625, 0.375, 0.125],
    ];
    let design = design(["a", "b", "c", "d"].map(|name| varied(name, UNIT)).to_vec(), Sampling::Sobol, 8);
    for (run, point) in scipy.iter().enumerate() {
        assert_eq!(design.values(run as u64), point);
    }
}

#[test]
fn random_draws_have_the_moments_of_their_distributions() {
    const RUNS: u64 = 40_000;
    let distributions = [
        Distribution::Normal { mean: -2.0, sigma: 0.5 },
        Distribution::Uniform { from: -1.0, to: 5.0 },
        Distribution::LogUniform { from: 0.1, to: 10.0 },
        Distribution::Triangular { from: -1.0, mode: 2.0, to: 3.0 },
        Distribution::Values(vec![1.0, 2.0, 7.0]),
        Distribution::steps(0.0, 3.0, 4),
    ];
    let all = distributions.iter().map(|it| varied(it.key(), it.clone())).collect();
    let design = design(all, Sampling::Random, RUNS);
    let rows: Vec<Vec<f64>> = (0..RUNS).map(|run| design.values(run)).collect();
    let count = RUNS as f64;
    for (k, distribution) in distributions.iter().enumerate() {
        // Mean and deviation by quadrature over the quantiles, not by their closed forms.
        let shares = (0..200_000).map(|it| (f64::from(it) + 0.5) / 200_000.0);
        let values: Vec<f64> = shares.map(|share| distribution.quantile(share)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let sigma = (values.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
        let (closed_mean, closed_sigma) = distribution.moments();
        assert_relative_eq!(mean, closed_mean, max_relative = 1e-4);
        assert_relative_eq!(sigma, closed_sigma, max_relative = 1e-4);
        let drawn = rows.iter().map(|row| row[k]).sum::<f64>() / count;
        assert_abs_diff_eq!(drawn, mean, epsilon = 4.0 * sigma / count.sqrt());
    }
    // Two variables have nothing in common, nor have two seeds.
    let covariance =
        rows.iter().map(|row| (row[0] + 2.0) / 0.5 * ((row[1] - 2.0) / 3.0_f64.sqrt())).sum::<f64>();
    assert!((covariance / count).abs() < 4.0 / count.sqrt());
}

#[test]
fn correlated_variables_have_their_coefficient() {
    const RUNS: u64 = 20_000;
    let normal = |name: &str| varied(name, Distribution::Normal { mean: 3.0, sigma: 2.0 });
    let correlation =
        |names: [&str; 2], coefficient| Correlation { names: names.map(str::to_owned), coefficient };
    let all = vec![normal("a"), varied("u", UNIT), normal("b")];
    let pair = [correlation(["a", "b"], 0.5)];
    for sampling in [Sampling::Random, Sampling::LatinHypercube, Sampling::Sobol] {
        let design = Design::new(all.clone(), (sampling, Some(RUNS)), &pair, 7).unwrap();
        let rows: Vec<Vec<f64>> = (0..RUNS).map(|run| design.values(run)).collect();
        let product = |j: usize, k: usize| {
            rows.iter().map(|row| (row[j] - 3.0) * (row[k] - 3.0) / 4.0).sum::<f64>() / RUNS as f64
        };
        // The variance of a product of two standard normal numbers is 1 + r^2, of a square 2.
        let error = 4.0 / (RUNS as f64).sqrt();
        assert_abs_diff_eq!(product(0, 2), 0.5, epsilon = error * 1.25_f64.sqrt());
        assert_abs_diff_eq!(product(0, 0), 1.0, epsilon = error * 2.0_f64.sqrt());
        assert_abs_diff_eq!(product(2, 2), 1.0, epsilon = error * 2.0_f64.sqrt());
    }
    let refused =
        |pairs: &[Correlation]| Design::new(all.clone(), (Sampling::Random, Some(9)), pairs, 7).unwrap_err();
    assert!(refused(&[correlation(["a", "u"], 0.5)]).to_string().contains("\"u\""));
    assert!(refused(&[correlation(["a", "b"], 1.0)]).to_string().contains("positive definite"));
    assert!(refused(&[correlation(["a", "a"], 0.2)]).to_string().contains("itself"));
}

#[test]
fn a_latin_hypercube_has_one_run_in_each_stratum() {
    const RUNS: u64 = 100;
    let design = design(vec![varied("a", UNIT), varied("b", UNIT)], Sampling::LatinHypercube, RUNS);
    for variable in 0..2 {
        let mut strata: Vec<u64> =
            (0..RUNS).map(|run| (design.values(run)[variable] * RUNS as f64) as u64).collect();
        assert!(!strata.is_sorted());
        strata.sort_unstable();
        assert!(strata.into_iter().eq(0..RUNS));
    }
}

#[test]
fn the_mean_of_a_latin_hypercube_varies_less() {
    let all = [varied("a", Distribution::Normal { mean: 0.0, sigma: 1.0 }), varied("b", UNIT)];
    let variance = |sampling: &Sampling| {
        let mean = |seed: u64| {
            let design = Design::new(all.to_vec(), (sampling.clone(), Some(50)), &[], seed).unwrap();
            (0..50).map(|run| design.values(run).iter().sum::<f64>()).sum::<f64>() / 50.0
        };
        let means: Vec<f64> = (0..100).map(mean).collect();
        means.iter().map(|mean| (mean - 0.5).powi(2)).sum::<f64>() / 100.0
    };
    // Of random draws (1 + 1/12) / 50.
    let random = variance(&Sampling::Random);
    assert_relative_eq!(random, 13.0 / 600.0, max_relative = 4.0 * (2.0_f64 / 100.0).sqrt());
    assert!(variance(&Sampling::LatinHypercube) < 0.05 * random);
}

#[test]
fn grids_have_every_combination_and_one_at_a_time_its_own() {
    let all = vec![
        varied("a", Distribution::Values(vec![1.0, 2.0])),
        varied("b", Distribution::steps(0.0, 0.3, 3)),
    ];
    let grid = Design::new(all.clone(), (Sampling::Grid, None), &[], 0).unwrap();
    let rows: Vec<Vec<f64>> = (0..grid.runs()).map(|run| grid.values(run)).collect();
    assert_eq!(rows, [[1.0, 0.0], [1.0, 0.15], [1.0, 0.3], [2.0, 0.0], [2.0, 0.15], [2.0, 0.3]]);
    let normal = |name: &str, mean| varied(name, Distribution::Normal { mean, sigma: 0.5 });
    let both = vec![normal("a", 1.0), normal("b", 2.0)];
    let single = Design::new(both.clone(), (Sampling::OneAtATime, None), &[], 0).unwrap();
    let rows: Vec<Vec<f64>> = (0..single.runs()).map(|run| single.values(run)).collect();
    assert_eq!(rows, [[1.0, 2.0], [0.5, 2.0], [1.5, 2.0], [1.0, 1.5], [1.0, 2.5]]);
    let refused = Design::new(both, (Sampling::Grid, None), &[], 0).unwrap_err();
    assert_eq!(refused.to_string(), "found a as normal with sampling grid, allowed: values and steps");
    let refused = Design::new(all, (Sampling::Grid, Some(7)), &[], 0).unwrap_err();
    assert!(refused.to_string().contains("found 7 runs, allowed: 6"), "{refused}");
    let large = ["a", "b", "c"].map(|name| varied(name, Distribution::steps(0.0, 1.0, 1001)));
    let refused = Design::new(large.to_vec(), (Sampling::Grid, None), &[], 0).unwrap_err();
    assert!(refused.to_string().starts_with("found 1003003001 runs, allowed: 1 to"), "{refused}");
    let empty = vec![varied("a", Distribution::Values(Vec::new()))];
    assert!(
        Design::new(empty, (Sampling::Grid, None), &[], 0)
            .unwrap_err()
            .to_string()
            .contains("a without a value")
    );
}

#[test]
fn a_run_depends_on_its_number_alone() {
    let all = vec![varied("a", Distribution::Normal { mean: 0.0, sigma: 1.0 })];
    let more = vec![all[0].clone(), varied("b", UNIT)];
    let of = |varied: Vec<Varied>, runs: u64| design(varied, Sampling::Random, runs).values(17)[0];
    assert_eq!(of(all.clone(), 20), of(all.clone(), 2000));
    assert_eq!(of(all.clone(), 20), of(more, 20));
    let other = Design::new(all.clone(), (Sampling::Random, Some(20)), &[], 2).unwrap();
    assert_ne!(of(all, 20), other.values(17)[0]);
}
