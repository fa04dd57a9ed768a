//! Fits of a flight: segments as short and polynomials as high as a tolerance asks, and coarse elements.

use physics::{
    bodies::Body,
    constants::DAY_S,
    environment::{
        CartesianState,
        onboard::{
            CoarseElements, FitError, FitPlan, FittedBody, GREATEST_DEGREE, OnboardTarget, SegmentTable,
        },
    },
    numerics::{Span, chebyshev::Segment},
};

use super::{
    coarse::{COARSE_SAMPLES, coarse_elements},
    request::EphemerisRequest,
    source::{Source, states},
};
use crate::Failure;

/// Length of the segments to begin with: of planets, and of the spacecraft.
const LONGEST_S: [f64; 2] = [16.0 * DAY_S, 0.25 * DAY_S];

/// Length of the segments of a given degree.
const SEGMENT_S: f64 = 8.0 * DAY_S;

/// Degrees that a tolerance may lead to; beyond them shorter segments take fewer coefficients.
const DEGREES: core::ops::RangeInclusive<usize> = 4..=16;

/// How often the segments are halved.
const HALVINGS: u32 = 12;

/// Epochs, evenly spaced, at which coarse elements are checked.
const COARSE_CHECKS: u32 = 2_000;

/// The precise model of a target.
///
/// # Errors
/// What the source cannot place, and a tolerance that no fit keeps.
pub fn precise(
    source: &dyn Source,
    target: OnboardTarget,
    request: &EphemerisRequest,
) -> Result<FittedBody<SegmentTable>, Failure> {
    let ([start_s, stop_s], center) = (request.span_s, source.center());
    if target == OnboardTarget::from(center) {
        return Err(format!("--bodies: {target} is the center, from where positions count").into());
    }
    let sampled = |segment_s: f64| -> Result<(FitPlan, Vec<CartesianState>), Failure> {
        let plan = FitPlan::new(Span::new(start_s, stop_s), segment_s);
        let states = states(source, &[target], &plan.epochs_s(), request.is_quiet)?.pop();
        Ok((plan, states.unwrap_or_default()))
    };
    if let Some(degree) = request.degree {
        let (plan, states) = sampled(request.segment_s.unwrap_or(SEGMENT_S))?;
        let (motion, error) = plan.fit(&states, degree.min(GREATEST_DEGREE));
        return Ok(FittedBody { target, center, motion, error });
    }
    let is_spacecraft = usize::from(target == OnboardTarget::Spacecraft);
    let mut segment_s = request.segment_s.unwrap_or(LONGEST_S[is_spacecraft]);
    let halvings = if request.segment_s.is_some() { 0 } else { HALVINGS };
    let mut best: Option<(FitError, f64)> = None;
    for _ in 0..=halvings {
        let (plan, states) = sampled(segment_s)?;
        for degree in DEGREES {
            let (motion, error) = plan.fit(&states, degree);
            if error.position_m <= request.tolerance_m {
                return Ok(FittedBody { target, center, motion, error });
            }
            if best.is_none_or(|(best, _)| error.position_m < best.position_m) {
                best = Some((error, segment_s));
            }
        }
        // Where shorter segments bring nothing, the source itself is no smoother.
        if best.is_some_and(|(_, best_s)| segment_s < 0.1 * best_s) {
            break;
        }
        segment_s *= 0.5;
    }
    let (error, best_s) = best.unwrap_or_default();
    Err(format!(
        "--tolerance: no fit of {target} up to degree {} keeps {} m; the best found errs by {} m, with segments of {} d",
        DEGREES.end(),
        terminal::short(request.tolerance_m),
        terminal::short(error.position_m),
        terminal::short(best_s / DAY_S)
    )
    .into())
}

/// The coarse models: of the planet in the centre, of the Earth, and of the spacecraft if it is among the targets.
///
/// # Errors
/// What the source cannot place, and a target on no ellipse.
pub fn coarse(
    source: &dyn Source,
    targets: &[OnboardTarget],
    span: Span,
    is_quiet: bool,
) -> Result<Vec<FittedBody<CoarseElements>>, Failure> {
    let nodes_s = Segment::<6, COARSE_SAMPLES>::nodes(span.start_s, span.end_s);
    let length_s = span.length_s();
    let checks =
        (0..=COARSE_CHECKS).map(|k| span.start_s + length_s * (f64::from(k) / f64::from(COARSE_CHECKS)));
    let mut epochs: Vec<(f64, Option<usize>)> = checks.map(|at_s| (at_s.min(span.end_s), None)).collect();
    epochs.extend(nodes_s.into_iter().enumerate().map(|(node, at_s)| (at_s, Some(node))));
    epochs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let epochs_s: Vec<f64> = epochs.iter().map(|(at_s, _)| *at_s).collect();
    let center = source.center();
    let mut models = Vec::new();
    let mut add = |target: OnboardTarget, about: Body, states: &[CartesianState]| -> Result<(), Failure> {
        let mut samples = [CartesianState::default(); COARSE_SAMPLES];
        for ((_, node), state) in epochs.iter().zip(states) {
            if let Some(node) = node {
                samples[*node] = *state;
            }
        }
        let motion = coarse_elements(about, span, &samples).ok_or_else(|| {
            format!("--coarse: {target} is on no ellipse about {}", OnboardTarget::from(about))
        })?;
        let mut error = FitError::default();
        for ((at_s, node), state) in epochs.iter().zip(states) {
            if node.is_none()
                && let Some(found) = motion.state(*at_s)
            {
                error = error.worst(FitError::from_states(&found, state));
            }
        }
        models.push(FittedBody { target, center: about, motion, error });
        Ok(())
    };
    let from_sun = |states: &[CartesianState], sun: &[CartesianState]| -> Vec<CartesianState> {
        states.iter().zip(sun).map(|(state, sun)| *state - *sun).collect()
    };
    // One flight for all.
    let mut requested = vec![OnboardTarget::Sun, OnboardTarget::Earth];
    requested.extend(targets.contains(&OnboardTarget::Spacecraft).then_some(OnboardTarget::Spacecraft));
    let mut states = states(source, &requested, &epochs_s, is_quiet)?.into_iter();
    let [sun, earth] = [(); 2].map(|()| states.next().unwrap_or_default());
    let origin = vec![CartesianState::default(); epochs_s.len()];
    if center != Body::Sun {
        add(center.into(), Body::Sun, &from_sun(&origin, &sun))?;
    }
    if center != Body::Earth {
        add(OnboardTarget::Earth, Body::Sun, &from_sun(&earth, &sun))?;
    }
    if let Some(spacecraft) = states.next() {
        add(OnboardTarget::Spacecraft, center, &spacecraft)?;
    }
    Ok(models)
}
