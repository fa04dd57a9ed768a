//! Which simulations each of paper 000's tables has.

use super::cases::{Case, Choice, Convention, DumpsTo, Shade, Strategy};

/// Tables 2 and 3: nothing, one and two inches along -Z.
pub(super) const ALONG_Z: [[i8; 3]; 3] = [[0, 0, 0], [0, 0, -1], [0, 0, -2]];
/// Tables 4 and 5: those, both along +Z, and an inch along all axes.
pub(super) const ALL_OFFSETS: [[i8; 3]; 7] =
    [[0, 0, 0], [0, 0, -1], [0, 0, -2], [0, 0, 1], [0, 0, 2], [1, 1, 1], [-1, -1, -1]];

const RULES: [(DumpsTo, Convention); 3] = [
    (DumpsTo::PAPER, Convention::BodyIntegral),
    (DumpsTo::OWN, Convention::BodyIntegral),
    (DumpsTo::OWN, Convention::Inertial),
];

/// Table 2: the paper's own dumps first, then the FMU's default ones, then these under the physical momentum.
pub(super) fn cylinder() -> Vec<Case> {
    by_rules(Shade::Cylinder, &[4.0, 7.0], &ALONG_Z)
}

/// Table 4, in the same order.
pub(super) fn panels() -> Vec<Case> {
    by_rules(Shade::PlatesAndPanels, &[5.5], &ALL_OFFSETS)
}

/// Every strategy by every rule, then the optimum of each threshold and offset under both momenta.
fn by_rules(shade: Shade, thresholds_n_m_s: &[f64], offsets_in: &[[i8; 3]]) -> Vec<Case> {
    let groups = RULES.map(|(dumps_to, convention)| (dumps_to, shade, convention));
    let mut cases = with_strategies(&Strategy::ALL, &groups, thresholds_n_m_s, offsets_in);
    let groups = [Convention::BodyIntegral, Convention::Inertial];
    let groups = groups.map(|convention| (DumpsTo::Planned, shade, convention));
    cases.extend(with_strategies(&[Strategy::Optimum], &groups, thresholds_n_m_s, offsets_in));
    cases
}

/// Tables 3 and 5: what the paper's momentum gives of Tables 2 and 4.
pub(super) fn in_papers_convention(mut cases: Vec<Case>) -> Vec<Case> {
    cases.retain(is_in_papers_convention);
    cases
}

/// Whether a case is one that the paper's tables have.
pub(super) fn is_in_papers_convention(case: &Case) -> bool {
    case.convention == Convention::BodyIntegral && case.strategy != Strategy::Optimum
}

/// Dumps that the paper's tables do not have: the plates alone, dumps to zero, and for small wheels dumps to one side of X.
pub(super) fn other_dumps() -> Vec<Case> {
    let (cylinder, plates) = (Shade::Cylinder, Shade::Plates);
    let both = [(DumpsTo::OWN, plates), (DumpsTo::ZERO, cylinder)];
    let small = [(DumpsTo::AlongX(0.9), cylinder), (DumpsTo::AlongX(-0.9), cylinder)];
    let group = |(dumps_to, shade)| (dumps_to, shade, Convention::BodyIntegral);
    let mut cases = with_strategies(&Strategy::ALL, &both.map(group), &[4.0, 7.0], &ALONG_Z);
    cases.extend(with_strategies(&Strategy::ALL, &small.map(group), &[4.0], &ALONG_Z));
    cases
}

/// Figures 4 and 5: small wheels.
pub(super) fn figure(strategies: &[Strategy]) -> Vec<Case> {
    let group = (DumpsTo::PAPER, Shade::Cylinder, Convention::BodyIntegral);
    with_strategies(strategies, &[group], &[4.0], &ALONG_Z)
}

/// Simulations over what the paper leaves open: start date and orbit frame, and the senses of the panels' tilts.
pub(super) fn open() -> Vec<Case> {
    let mut cases = Vec::new();
    for dumps_to in [DumpsTo::PAPER, DumpsTo::OWN] {
        let mut extend = |threshold_n_m_s, shade, choice| {
            let group = (dumps_to, shade, Convention::BodyIntegral);
            let own = with_strategies(&[Strategy::DumpsOnly], &[group], &[threshold_n_m_s], &ALONG_Z);
            cases.extend(own.into_iter().map(|case| Case { choice, ..case }));
        };
        for threshold_n_m_s in [4.0, 7.0] {
            for choice in [Choice::Study, Choice::Later, Choice::OrbitPlane, Choice::Ecliptic] {
                extend(threshold_n_m_s, Shade::Cylinder, choice);
            }
        }
        for (plus_x, minus_x) in [(true, true), (false, false), (true, false), (false, true)] {
            extend(5.5, Shade::PlatesAndPanels, Choice::Tilts(plus_x, minus_x));
        }
    }
    cases
}

/// Every group with every threshold, strategy and offset, in this order.
pub(super) fn with_strategies(
    strategies: &[Strategy],
    groups: &[(DumpsTo, Shade, Convention)],
    thresholds_n_m_s: &[f64],
    offsets_in: &[[i8; 3]],
) -> Vec<Case> {
    let mut cases = Vec::new();
    for &(dumps_to, shade, convention) in groups {
        for &threshold_n_m_s in thresholds_n_m_s {
            for &strategy in strategies {
                cases.extend(offsets_in.iter().map(|&offset_in| Case {
                    strategy,
                    threshold_n_m_s,
                    dumps_to,
                    shade,
                    convention,
                    offset_in,
                    choice: Choice::Study,
                }));
            }
        }
    }
    cases
}
