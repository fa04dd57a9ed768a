//! Flight between planets, from parameters; refuses what cannot be simulated, by name.

use fmi_export::{Failure, Values};
use physics::bodies::{Body, BodyData};
use physics::environment::onboard::{OnboardEphemeris, OnboardTarget};
use physics::environment::orbit::{NBodyGravity, NBodySettings};
use physics::plant::Encounter;

use super::center::Center;
use crate::common::ephemeris::{EPHEMERIS_FILE, check_epoch};
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::EphemerisSource;

/// What to say of an encounter that has no effect.
pub(super) fn unused_encounter(variables: &PlantVariables, values: &Values) -> Option<String> {
    let body = values.choice(variables.encounter.body).0.filter(|_| !variables.orbit.is_n_body(values))?;
    Some(format!(
        "encounter.body is {} and has no effect: orbit.dynamics nBody (3) has encounters",
        OnboardTarget::from(body)
    ))
}

/// The bodies that attract beside the Sun and the centre.
fn attracting<'a>(variables: &PlantVariables, values: &'a Values) -> impl Iterator<Item = Body> + 'a {
    let planets = variables.orbit.attraction.planets().into_iter();
    planets.filter(|(_, attracts)| values.boolean(*attracts)).map(|(body, _)| body)
}

/// Gravity of Sun, centre and all that attracts.
pub(super) fn gravity(variables: &PlantVariables, values: &Values, center: &Center) -> NBodyGravity {
    let orbit = &variables.orbit;
    let settings = NBodySettings {
        relativity: values.boolean(orbit.relativity),
        changes_center: values.boolean(orbit.change_center),
        moon: values.boolean(orbit.attraction.moon),
        cell_s: values.real(orbit.n_body_step),
        tolerance_m: values.real(orbit.n_body_tolerance),
    };
    let planet = &center.planet;
    let data = |body: Body| if body == planet.body { *planet } else { *body.data() };
    let encounter = Some(*planet).filter(|planet| planet.body != center.data.body);
    let bodies: [Option<BodyData>; Body::COUNT] = {
        let mut all = attracting(variables, values).map(data).chain(encounter);
        core::array::from_fn(|_| all.next())
    };
    NBodyGravity::new(settings, &center.data, bodies.into_iter().flatten(), Some(planet))
}

/// The encounter.
///
/// # Errors
/// Ephemerides without planets, or an encounter with the centre.
pub(super) fn check(
    context: &Plan<'_>,
    values: &Values,
    center: &Center,
) -> Result<Option<Encounter>, Failure> {
    let variables = context.variables;
    let encounter = variables.encounter.body(&variables.orbit, values);
    if !variables.orbit.is_n_body(values) {
        return Ok(None);
    }
    let source = match values.choice(variables.ephemeris.source) {
        EphemerisSource::Kepler => Some("kepler (2)"),
        EphemerisSource::Inputs => Some("inputs (3)"),
        EphemerisSource::Vsop87 | EphemerisSource::Chebyshev => None,
    };
    if let Some(source) = source {
        return Err(Failure::new(format!(
            "ephemeris.source: found {source}, allowed with orbit.dynamics nBody (3): vsop87 (1) and chebyshev (4), which place \
             every planet"
        )));
    }
    if encounter == Some(center.data.body) {
        return Err(Failure::new(format!(
            "encounter.body: found {}, which orbit.center is, allowed: another planet, or none (0)",
            center.data.name
        )));
    }
    Ok(encounter.map(|body| Encounter {
        body,
        gm_m3_s2: center.planet.gm_m3_s2,
        radius_m: center.planet.radius_m,
    }))
}

/// Refuses onboard ephemerides that do not place all that attracts, or not at `epoch_s`, which `what` gives.
pub(super) fn check_onboard(
    variables: &PlantVariables,
    values: &Values,
    carried: &OnboardEphemeris,
    what: &str,
    epoch_s: f64,
) -> Result<(), Failure> {
    if !variables.orbit.is_n_body(values) {
        return Ok(());
    }
    let planets = attracting(variables, values).map(|body| (OnboardTarget::from(body), Body::Sun));
    let encounter = variables.encounter.body(&variables.orbit, values).map(|body| (body.into(), Body::Sun));
    let has_moon = values.boolean(variables.orbit.attraction.moon);
    let moon = has_moon.then_some((OnboardTarget::Moon, Body::Earth));
    for (target, from) in planets.chain(encounter).chain(moon) {
        let span_s = carried.span_s(target, from).ok_or_else(|| {
            Failure::new(format!(
                "{EPHEMERIS_FILE}: found no [[body]] that joins {target} with {}, allowed with orbit.dynamics nBody (3): one of \
                 each that attracts (heliotorque ephemeris --bodies ...,{target}), or orbit.attraction.{target} = false",
                OnboardTarget::from(from)
            ))
        })?;
        check_epoch(target, span_s, what, epoch_s)?;
    }
    Ok(())
}
