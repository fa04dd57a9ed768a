//! Positions of Sun and planets by parameters and the file of onboard ephemerides, checked by name.

use std::sync::Arc;

use fmi_export::{Failure, SetupError};
use physics::bodies::Body;
use physics::environment::ephemeris::VALID_EPOCH_S;
use physics::environment::kepler_planet::KeplerPlanet;
use physics::environment::onboard::{OnboardEphemeris, OnboardTarget};
use physics::environment::orbit::Elements;
use physics::numerics::Span;

use super::center::CenterBody;

/// The file of onboard ephemerides in the resources.
pub(crate) const EPHEMERIS_FILE: &str = "ephemeris.toml";

/// Reads onboard ephemerides; `file` names the text in errors.
pub(crate) fn read(file: &str, text: &str) -> Result<Arc<OnboardEphemeris>, SetupError> {
    OnboardEphemeris::from_toml(file, text).map(Arc::new).map_err(|error| SetupError(error.to_string()))
}

/// The file's ephemerides if it has precise models.
pub(crate) fn precise(carried: Option<&Arc<OnboardEphemeris>>) -> Option<&Arc<OnboardEphemeris>> {
    carried.filter(|carried| !carried.precise.is_empty())
}

/// Refuses a start that VSOP87 is not made for.
pub(crate) fn check_start(epoch_s: f64) -> Result<(), Failure> {
    if epoch_s.abs() <= VALID_EPOCH_S {
        return Ok(());
    }
    Err(Failure::new(format!(
        "start.epoch: found {epoch_s:?} s, allowed: within {VALID_EPOCH_S:e} s (4000 years) of J2000, for which VSOP87 \
         is made"
    )))
}

/// The planet on the ellipse of `ephemeris.source` kepler.
pub(crate) fn kepler(ellipse: Elements, epoch_s: f64) -> Result<KeplerPlanet, Failure> {
    KeplerPlanet::new(ellipse, epoch_s).map_err(|error| Failure::new(format!("ephemeris elements: {error}")))
}

/// Returns the orbit about the Sun that the spacecraft's file gives its own body, for sources that do not place it.
pub(crate) fn custom(body: &CenterBody, source: &str) -> Result<KeplerPlanet, Failure> {
    body.motion.ok_or_else(|| {
        Failure::new(format!(
            "ephemeris.source: found {source} with a `[body]` that has neither `elements` nor `position_m`, allowed: one of them in \
             the spacecraft's file, ephemeris.source inputs or kepler, or chebyshev with {EPHEMERIS_FILE} that places custom"
        ))
    })
}

/// Epoch, and what gives it.
#[derive(Clone, Copy)]
pub(crate) struct NamedEpoch {
    pub name: &'static str,
    pub epoch_s: f64,
}

impl NamedEpoch {
    /// Refuses onboard ephemerides that do not place Sun and Earth from a centre, or not at this epoch.
    pub(crate) fn check_onboard(self, carried: &OnboardEphemeris, center: Body) -> Result<(), Failure> {
        let from = OnboardTarget::from(center);
        let targets = [OnboardTarget::Sun, OnboardTarget::Earth].into_iter().filter(|target| *target != from);
        for target in targets {
            let found = carried.span(target, center).ok_or_else(|| {
                Failure::new(format!(
                    "{EPHEMERIS_FILE}: found no [[body]] that joins {target} with {from}, allowed: positions of sun and earth \
                     that lead to {from}, from whose centre this model counts"
                ))
            })?;
            self.check(target, found)?;
        }
        Ok(())
    }

    /// Refuses an epoch outside the span over which the onboard ephemerides place a target.
    pub(crate) fn check(self, target: OnboardTarget, span: Span) -> Result<(), Failure> {
        let (Self { name, epoch_s }, Span { start_s, end_s }) = (self, span);
        if span.contains(epoch_s) {
            return Ok(());
        }
        Err(Failure::new(format!(
            "{name}: found {epoch_s:?} s, allowed: from {start_s:?} to {end_s:?} s past J2000, where {EPHEMERIS_FILE} \
             places {target}"
        )))
    }
}
