//! Which simulations each of paper 000's tables has.

use super::cases::{Case, Choice, Convention, DumpsTo, Shade, Strategy};

/// Tables 2 and 3: nothing, one and two inches along -Z.
pub const ALONG_Z: [[i8; 3]; 3] = [[0, 0, 0], [0, 0, -1], [0, 0, -2]];
/// Tables 4 and 5: those, both along +Z, and an inch along all axes.
pub const ALL_OFFSETS: [[i8; 3]; 7] =
    [[0, 0, 0], [0, 0, -1], [0, 0, -2], [0, 0, 1], [0, 0, 2], [1, 1, 1], [-1, -1, -1]];

/// Tables 2 and 3: the paper's own dumps first, then the FMU's default ones and those to zero; then what the paper does not
/// have: the plates, the physical momentum, and for small wheels dumps to one side of X.
pub fn cylinder() -> Vec<Case> {
    use Convention::{BodyIntegral, Inertial};
    let groups = [
        (DumpsTo::PAPER, Shade::Cylinder, BodyIntegral),
        (DumpsTo::OWN, Shade::Cylinder, BodyIntegral),
        (DumpsTo::ZERO, Shade::Cylinder, BodyIntegral),
        (DumpsTo::OWN, Shade::Plates, BodyIntegral),
        (DumpsTo::OWN, Shade::Cylinder, Inertial),
    ];
    let mut cases = with_every_strategy(&groups, &[4.0, 7.0], &ALONG_Z);
    let biased = [0.9, -0.9].map(|share| (DumpsTo::AlongX(share), Shade::Cylinder, BodyIntegral));
    cases.extend(with_every_strategy(&biased, &[4.0], &ALONG_Z));
    cases
}

/// Tables 4 and 5.
pub fn panels() -> Vec<Case> {
    use Convention::{BodyIntegral, Inertial};
    let shade = Shade::PlatesAndPanels;
    let groups = [
        (DumpsTo::PAPER, shade, BodyIntegral),
        (DumpsTo::OWN, shade, BodyIntegral),
        (DumpsTo::ZERO, shade, BodyIntegral),
        (DumpsTo::OWN, shade, Inertial),
    ];
    with_every_strategy(&groups, &[5.5], &ALL_OFFSETS)
}

/// Figures 4 and 5: small wheels.
pub fn figure(strategies: &[Strategy]) -> Vec<Case> {
    let mut cases = with_every_strategy(
        &[(DumpsTo::PAPER, Shade::Cylinder, Convention::BodyIntegral)],
        &[4.0],
        &ALONG_Z,
    );
    cases.retain(|case| strategies.contains(&case.strategy));
    cases
}

/// Simulations over what the paper leaves open: start date and orbit frame, and the senses of the panels' tilts.
pub fn open() -> Vec<Case> {
    let mut cases = Vec::new();
    for dumps_to in [DumpsTo::PAPER, DumpsTo::OWN] {
        let mut extend = |threshold_n_m_s, shade, choice| {
            let convention = Convention::BodyIntegral;
            cases.extend(ALONG_Z.map(|offset_in| Case {
                strategy: Strategy::DumpsOnly,
                threshold_n_m_s,
                dumps_to,
                shade,
                convention,
                offset_in,
                choice,
            }));
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
pub fn with_every_strategy(
    groups: &[(DumpsTo, Shade, Convention)],
    thresholds_n_m_s: &[f64],
    offsets_in: &[[i8; 3]],
) -> Vec<Case> {
    let mut cases = Vec::new();
    for &(dumps_to, shade, convention) in groups {
        for &threshold_n_m_s in thresholds_n_m_s {
            for strategy in Strategy::ALL {
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
