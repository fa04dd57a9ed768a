//! Ephemeris files for tests: Sun and Earth from Mercury by VSOP87, the Sun turned aside where a test wants it wrong; planets from
//! the Sun.

use nalgebra::{Rotation3, Vector3};
use physics::bodies::Body;
use physics::environment::CartesianState;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::onboard::{FitPlan, FittedBody, OnboardEphemeris, OnboardTarget, to_toml};
use physics::environment::time::MOMENTUM_STUDY_START_S;
use physics::numerics::Span;

/// The file's name in the resources.
pub(crate) const FILE: &str = "ephemeris.toml";

/// Epoch at which flights start.
pub(crate) const START_S: f64 = MOMENTUM_STUDY_START_S;

/// A body from Mercury by VSOP87.
pub(crate) fn from_mercury(body: Body, epoch_s: f64) -> CartesianState {
    let mut ephemeris = Ephemeris::default();
    let [body, mercury] = [body, Body::Mercury].map(|body| ephemeris.state(body, epoch_s));
    CartesianState {
        position_m: body.position_m - mercury.position_m,
        velocity_m_s: body.velocity_m_s - mercury.velocity_m_s,
    }
}

/// A file over a span after [`START_S`], with the Sun turned about the north of EME2000, and its stated error in m.
pub(crate) fn file(span_s: f64, turned_rad: f64) -> (String, f64) {
    let plan = FitPlan::new(Span::new(START_S, START_S + span_s), 2.0 * 86_400.0);
    let mut ephemeris = Ephemeris::default();
    let mut precise = Vec::new();
    for (target, body) in [(OnboardTarget::Sun, Body::Sun), (OnboardTarget::Earth, Body::Earth)] {
        let angle_rad = if body == Body::Sun { turned_rad } else { 0.0 };
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle_rad);
        let state = |epoch_s: f64| {
            let [body, mercury] = [body, Body::Mercury].map(|body| ephemeris.state(body, epoch_s));
            CartesianState {
                position_m: turn * (body.position_m - mercury.position_m),
                velocity_m_s: turn * (body.velocity_m_s - mercury.velocity_m_s),
            }
        };
        let states: Vec<_> = plan.epochs_s().into_iter().map(state).collect();
        let (motion, error) = plan.fit(&states, 6);
        precise.push(FittedBody { target, center: Body::Mercury, motion, error });
    }
    let worst_m = precise.iter().map(|body| body.error.position_m).fold(0.0, f64::max);
    (to_toml(&OnboardEphemeris { source: None, precise, coarse: Vec::new() }), worst_m)
}

/// A file of planets from the Sun, and of the Moon from the Earth, by VSOP87 over a span of epochs.
pub(crate) fn from_sun_file(targets: &[OnboardTarget], span: Span, ephemeris: &mut Ephemeris) -> String {
    let plan = FitPlan::new(span, 2.0 * 86_400.0);
    let body =
        |target: OnboardTarget| Body::ALL.into_iter().find(|body| OnboardTarget::from(*body) == target);
    let fitted = targets.iter().map(|target| {
        let mut state = |epoch_s: f64| match body(*target) {
            Some(body) => ephemeris.state(body, epoch_s),
            None => ephemeris.moon_from_earth(epoch_s),
        };
        let states: Vec<_> = plan.epochs_s().into_iter().map(&mut state).collect();
        let (motion, error) = plan.fit(&states, 10);
        let center = if *target == OnboardTarget::Moon { Body::Earth } else { Body::Sun };
        FittedBody { target: *target, center, motion, error }
    });
    to_toml(&OnboardEphemeris { source: None, precise: fitted.collect(), coarse: Vec::new() })
}
