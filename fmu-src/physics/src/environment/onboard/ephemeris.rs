//! The onboard ephemeris, from its file; every problem is reported by file, line, key, what was found and what is allowed.

use nalgebra::SMatrix;

use super::coarse::{COARSE_TERMS, CoarseElements};
use super::description::{
    BodyDescription, CoarseDescription, EphemerisDescription, Frame, SegmentDescription,
};
use super::fit::{FitError, GREATEST_DEGREE};
use super::table::{EphemerisSegment, SegmentTable};
use super::target::OnboardTarget;
use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;
use crate::toml::{Checker, Document, FileError, Finite, Place, Written};

/// A model of a body's motion with the error it was made with.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedBody<M> {
    /// Body that moves, or the spacecraft.
    pub target: OnboardTarget,
    /// Body about which it moves.
    pub center: Body,
    /// Its motion.
    pub motion: M,
    /// Greatest error against the source of the fit.
    pub error: FitError,
}

/// Ephemerides that a spacecraft carries. No body stands in it twice, and no body is, by way of others, its own centre.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OnboardEphemeris {
    /// Source of the positions, for people.
    pub source: Option<String>,
    /// The precise models.
    pub precise: Vec<FittedBody<SegmentTable>>,
    /// The coarse models.
    pub coarse: Vec<FittedBody<CoarseElements>>,
}

impl OnboardEphemeris {
    /// Reads an ephemeris from TOML text; `file` only names it in errors.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys, numbers out of range, gaps and overlaps, and
    /// bodies that have no place, each with line, key, what was found and what is allowed.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, FileError> {
        let document = Document::parse(file, text)?;
        let (description, check) = Checker::read::<EphemerisDescription>(&document)?;
        let Frame::Eme2000 = description.frame;
        let root = Place::root(&check);
        let bodies = description.body.as_deref().unwrap_or_default();
        let coarse_bodies = description.coarse.as_deref().unwrap_or_default();
        if bodies.is_empty() && coarse_bodies.is_empty() {
            root.report("no body", "at least one [[body]] or [[coarse]]");
        }
        let mut found = Self { source: description.source.clone(), ..Self::default() };
        for (at, body) in root.key("body").items(bodies) {
            let (target, center) = (body.body, OnboardTarget::from(body.center));
            let is_new = check_target(&at, [target, center], &found.precise);
            if is_new && target != center && found.leads_to(center, target) {
                let text = format!("{center}, whose own position counts from {target}");
                at.key("center").report(text, "a body that does not count from this one");
            }
            let error = FitError { position_m: body.error_m.0, velocity_m_s: body.error_m_s.0 };
            if let Some(motion) = table(&at, body) {
                found.precise.push(FittedBody { target, center: body.center, motion, error });
            }
        }
        for (at, body) in root.key("coarse").items(coarse_bodies) {
            let (target, center) = (body.body, OnboardTarget::from(body.center));
            check_target(&at, [target, center], &found.coarse);
            if ![OnboardTarget::Spacecraft, center].contains(&target) && body.center != Body::Sun {
                at.key("center").report(center, "sun, which planets move about");
            }
            if body.center == Body::Custom {
                let allowed = "a body of known gravity: [[body]] places what moves about another";
                at.key("center").report("custom", allowed);
            }
            let error = FitError { position_m: body.error_m.0, velocity_m_s: body.error_m_s.0 };
            let motion = coarse(&at, body);
            found.coarse.push(FittedBody { target, center: body.center, motion, error });
        }
        check.finish(found)
    }

    /// Whether `target` is `from`, or `from` counts from it by way of others or not.
    fn leads_to(&self, from: OnboardTarget, target: OnboardTarget) -> bool {
        let mut at = from;
        // While the file is read it may lead in a circle.
        for _ in 0..=self.precise.len() {
            if at == target {
                return true;
            }
            let Some(body) = self.entry(at) else { return false };
            at = body.center.into();
        }
        false
    }

    fn entry(&self, target: OnboardTarget) -> Option<&FittedBody<SegmentTable>> {
        self.precise.iter().find(|body| body.target == target)
    }

    /// Epochs at which the precise models place `target` from `center`; `None` where nothing joins them.
    pub fn span(&self, target: OnboardTarget, center: Body) -> Option<Span> {
        let mut span = Span::new(f64::NEG_INFINITY, f64::INFINITY);
        let center = center.into();
        for (from, other) in [(target, center), (center, target)] {
            self.climb(from, other, |body| {
                let Span { start_s, end_s } = body.motion.span();
                span = Span::new(span.start_s.max(start_s), span.end_s.min(end_s));
                Some(())
            })?;
        }
        Some(span)
    }

    /// The first end of a segment of a precise model after an epoch, in s past J2000 TDB; within a microsecond of one, the one behind
    /// it; infinite where none is.
    pub fn smooth_until_s(&self, epoch_s: f64) -> f64 {
        let ends = self.precise.iter().map(|body| body.motion.smooth_until_s(epoch_s + 1e-6));
        ends.fold(f64::INFINITY, f64::min)
    }

    /// Position and velocity of `target` from `center` by the precise models, in EME2000; `None` outside their span and
    /// where nothing joins them.
    pub fn state(&self, target: OnboardTarget, center: Body, epoch_s: f64) -> Option<CartesianState> {
        let [mut up, mut down] = [CartesianState::default(); 2];
        let center = center.into();
        for (from, other, sum) in [(target, center, &mut up), (center, target, &mut down)] {
            self.climb(from, other, |body| {
                *sum = *sum + body.motion.state(epoch_s)?;
                Some(())
            })?;
        }
        Some(up - down)
    }

    /// The same, beyond the span of the models as their last state would move on evenly: for integrators, which look
    /// ahead of the time they are requested. `None` where nothing joins both.
    pub fn state_carried_on(
        &self,
        target: OnboardTarget,
        center: Body,
        epoch_s: f64,
    ) -> Option<CartesianState> {
        let span = self.span(target, center)?;
        let inside_s = epoch_s.clamp(span.start_s, span.end_s);
        let state = self.state(target, center, inside_s)?;
        let position_m = state.position_m + state.velocity_m_s * (epoch_s - inside_s);
        Some(CartesianState { position_m, ..state })
    }

    /// Position and velocity by the coarse model of a target about its own centre; `None` without one or outside its span.
    pub fn coarse_state(&self, target: OnboardTarget, epoch_s: f64) -> Option<CartesianState> {
        self.coarse.iter().find(|body| body.target == target)?.motion.state(epoch_s)
    }

    /// The same of the spacecraft, if its model is about `center`.
    pub fn coarse_spacecraft(&self, center: Body, epoch_s: f64) -> Option<CartesianState> {
        let is_it = |it: &&FittedBody<_>| it.target == OnboardTarget::Spacecraft && it.center == center;
        self.coarse.iter().find(is_it)?.motion.state(epoch_s)
    }

    /// Visits the models from `from` up to the first centre that `other` counts from as well, or is; `None` where the chain
    /// ends before, or the visit does.
    fn climb<'a>(
        &'a self,
        from: OnboardTarget,
        other: OnboardTarget,
        mut visit: impl FnMut(&'a FittedBody<SegmentTable>) -> Option<()>,
    ) -> Option<()> {
        let mut at = from;
        while !self.leads_to(other, at) {
            let body = self.entry(at)?;
            visit(body)?;
            at = body.center.into();
        }
        Some(())
    }
}

/// Reports a target that is its own centre, and one that stands among the `known` already; tells whether it is new.
fn check_target<M>(at: &Place<'_>, [target, center]: [OnboardTarget; 2], known: &[FittedBody<M>]) -> bool {
    let is_new = known.iter().all(|other| other.target != target);
    if target == center {
        at.key("center").report_across(target, "another body than the one that is placed");
    }
    if !is_new {
        at.key("body").report(format_args!("{target} for the second time"), "each body once");
    }
    is_new
}

/// The epochs of a span, one after the other.
fn span(at: &Place<'_>, [start_s, end_s]: [f64; 2]) -> Span {
    if end_s <= start_s {
        at.key("end_s").report(format_args!("{end_s:e}"), format!("more than start_s, {start_s:e}"));
    }
    Span::new(start_s, end_s)
}

/// The polynomials of a body; `None` where they leave a gap or something was reported.
fn table(at: &Place<'_>, body: &BodyDescription) -> Option<SegmentTable> {
    let place = at.key("segment");
    if body.segment.is_empty() {
        place.report("an empty list", "at least one segment");
    }
    let degree = body.degree as usize;
    if degree > GREATEST_DEGREE {
        let allowed = format!("a degree from 0 to {GREATEST_DEGREE}");
        at.key("degree").report(body.degree, allowed);
    }
    let segments = place.items(&body.segment).map(|(at, described)| segment(&at, described, degree));
    let segments: Vec<EphemerisSegment> = segments.collect();
    for (index, pair) in segments.windows(2).enumerate() {
        let (end_s, start_s) = (pair[0].end_s, pair[1].start_s);
        if end_s != start_s {
            let (word, by_s) =
                if start_s > end_s { ("a gap", start_s - end_s) } else { ("an overlap", end_s - start_s) };
            let here = place.item(index + 1).key("start_s");
            let found = format!("{start_s:e}, {word} of {by_s:e} s");
            here.report(found, format!("{end_s:e}, where {} ends", place.item(index)));
        }
    }
    SegmentTable::new(segments)
}

fn segment(at: &Place<'_>, described: &SegmentDescription, degree: usize) -> EphemerisSegment {
    let Span { start_s, end_s } = span(at, [described.start_s, described.end_s].value());
    let lists = [("x_m", &described.x_m), ("y_m", &described.y_m), ("z_m", &described.z_m)];
    for (key, list) in lists.into_iter().filter(|(_, list)| list.len() != degree + 1) {
        let allowed = format!("{}, one more than the degree", degree + 1);
        at.key(key).report(format!("{} coefficients", list.len()), allowed);
    }
    let coefficient = |list: &[Finite], k: usize| list.get(k).map_or(0.0, Finite::value);
    let terms = lists.iter().map(|(_, list)| list.len()).max().unwrap_or(0);
    let coefficients_m = (0..terms).map(|k| lists.map(|(_, list)| coefficient(list, k))).collect();
    EphemerisSegment { start_s, end_s, coefficients_m }
}

/// Epochs at which elements are looked at.
const LOOKS: u32 = 400;

fn coarse(at: &Place<'_>, body: &CoarseDescription) -> CoarseElements {
    let span @ Span { start_s, end_s } = span(at, [body.start_s, body.end_s].value());
    let rows = [
        body.semi_major_axis_m,
        body.eccentricity,
        body.inclination_rad,
        body.ascending_node_rad,
        body.periapsis_argument_rad,
        body.mean_anomaly_rad,
    ];
    let coefficients = SMatrix::<f64, 6, COARSE_TERMS>::from_fn(|row, k| rows[row][k].0);
    let elements = Segment::from_coefficients(start_s, end_s, coefficients);
    if !at.has_reported() {
        let epochs = (0..=LOOKS).map(|k| start_s + (end_s - start_s) * (f64::from(k) / f64::from(LOOKS)));
        let bad = |row: usize, is_good: fn(f64) -> bool| {
            epochs.clone().map(|at_s| elements.value(at_s)[row]).find(|value| !is_good(*value))
        };
        if let Some(a_m) = bad(0, |a_m| a_m > 0.0) {
            at.key("semi_major_axis_m").report(format_args!("{a_m:e} m"), "above 0 all over the span");
        }
        if let Some(e) = bad(1, |e| (0.0..1.0).contains(&e)) {
            at.key("eccentricity").report(e, "from 0 to less than 1 all over the span");
        }
    }
    CoarseElements { center: body.center, span, elements }
}
