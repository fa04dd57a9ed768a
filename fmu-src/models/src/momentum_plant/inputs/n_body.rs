//! Flight between planets, from parameters; refuses what cannot be simulated, by name.

use fmi_export::Failure;
use physics::bodies::{Body, BodyData};
use physics::environment::ephemeris::VALID_EPOCH_S;
use physics::environment::onboard::{OnboardEphemeris, OnboardTarget};
use physics::environment::orbit::{Attractor, GravityModel, NBodyGravity, NBodySettings};
use physics::plant::{Encounter, PredictionSettings};

use super::center::Center;
use crate::common::ephemeris::{EPHEMERIS_FILE, NamedEpoch, precise};
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::variables::choices::EphemerisSource;

/// Returns a warning of an encounter that has no effect.
pub(super) fn unused_encounter(read: Read<'_>) -> Option<String> {
    let variables = read.variables;
    let body = read.choice(variables.encounter.body).0.filter(|_| !variables.orbit.is_n_body(read.values))?;
    Some(format!(
        "encounter.body is {} and has no effect: orbit.dynamics nBody (3) has encounters",
        OnboardTarget::from(body)
    ))
}

/// Returns a warning of predictions without an encounter.
pub(super) fn unused_prediction(read: Read<'_>) -> Option<String> {
    let variables = read.variables;
    let refresh_s = read.real(variables.prediction.refresh);
    let has_encounter = variables.encounter.body(&variables.orbit, read.values).is_some();
    (refresh_s > 0.0 && !has_encounter).then(|| {
        format!(
            "prediction.refresh is {refresh_s} s and has no effect: what is predicted is the encounter with encounter.body in \
             orbit.dynamics nBody (3)"
        )
    })
}

/// The bodies that attract, apart from the Sun and the centre.
fn attracting<'a>(read: Read<'a>) -> impl Iterator<Item = Body> + 'a {
    let variables = read.variables;
    let planets = variables.orbit.attraction.planets().into_iter();
    planets.filter(move |(_, attracts)| read.boolean(*attracts)).map(|(body, _)| body)
}

/// Gravity of all bodies in orbit.dynamics nBody (3), and the encounter.
///
/// # Errors
/// Ephemerides without planets, or an encounter with the centre.
pub(super) fn read(
    read: Read<'_>,
    center: &Center,
) -> Result<(Option<NBodyGravity>, Option<Encounter>), Failure> {
    let variables = read.variables;
    let encounter = variables.encounter.body(&variables.orbit, read.values);
    if !variables.orbit.is_n_body(read.values) {
        return Ok((None, None));
    }
    let source = match read.choice(variables.ephemeris_source) {
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
    let encounter = encounter.map(|body| Encounter {
        body,
        gm_m3_s2: center.planet.gm_m3_s2,
        radius_m: center.planet.radius_m,
        prediction: PredictionSettings {
            refresh_s: read.real(variables.prediction.refresh),
            horizon_s: read.real(variables.prediction.horizon),
            last_epoch_s: last_epoch_s(read),
            lead_s: read.real(variables.encounter.lead_time),
        },
    });
    Ok((Some(gravity(read, center)), encounter))
}

/// Gravity of Sun, centre and all that attracts.
fn gravity(read: Read<'_>, center: &Center) -> NBodyGravity {
    let variables = read.variables;
    let orbit = &variables.orbit;
    let settings = NBodySettings {
        changes_center: read.boolean(orbit.change_center),
        cell_s: read.real(orbit.n_body_step),
        tolerance_m: read.real(orbit.n_body_tolerance),
    };
    let planet = &center.planet;
    let data = |body: Body| if body == planet.body { *planet } else { *body.data() };
    let row = |data: &BodyData| match data.body == planet.body {
        true => Attractor::flattened(data),
        false => Attractor::point_mass(data),
    };
    let bodies = [Body::Sun].into_iter().chain(attracting(read)).map(data);
    let bodies = bodies.chain([*planet, center.data]);
    let moon = read.boolean(orbit.attraction.moon).then_some(Attractor::MOON);
    let rows = bodies.map(|data| row(&data)).chain(moon);
    NBodyGravity::new(settings, GravityModel::new(center.data.body, rows, read.boolean(orbit.relativity)))
}

/// Until when the ephemerides place all that attracts, in s past J2000 TDB.
fn last_epoch_s(read: Read<'_>) -> f64 {
    let variables = read.variables;
    let is_onboard = matches!(read.choice(variables.ephemeris_source), EphemerisSource::Chebyshev);
    let carried = precise(read.setup.ephemeris.as_ref()).filter(|_| is_onboard);
    let spans = carried
        .into_iter()
        .flat_map(|carried| placed(read).filter_map(|(target, from)| carried.span(target, from)));
    spans.map(|span| span.end_s).fold(VALID_EPOCH_S, f64::min)
}

/// Bodies that ephemerides have to place, each relative to another: all that attract, and the planet of the encounter.
fn placed<'a>(read: Read<'a>) -> impl Iterator<Item = (OnboardTarget, Body)> + 'a {
    let variables = read.variables;
    let encounter = variables.encounter.body(&variables.orbit, read.values);
    let planets = attracting(read).chain(encounter).map(|body| (body.into(), Body::Sun));
    let has_moon = read.boolean(variables.orbit.attraction.moon);
    planets.chain(has_moon.then_some((OnboardTarget::Moon, Body::Earth)))
}

/// Refuses onboard ephemerides that do not place Sun, Earth and all that attracts, or not at this epoch.
pub(super) fn check_onboard(
    read: Read<'_>,
    carried: &OnboardEphemeris,
    epoch: NamedEpoch,
) -> Result<(), Failure> {
    let variables = read.variables;
    epoch.check_onboard(carried, read.choice(variables.orbit.center).0)?;
    if !variables.orbit.is_n_body(read.values) {
        return Ok(());
    }
    for (target, from) in placed(read) {
        let span = carried.span(target, from).ok_or_else(|| {
            Failure::new(format!(
                "{EPHEMERIS_FILE}: found no [[body]] that joins {target} with {}, allowed with orbit.dynamics nBody (3): one of \
                 each that attracts (heliotorque ephemeris --bodies ...,{target}), or orbit.attraction.{target} = false",
                OnboardTarget::from(from)
            ))
        })?;
        epoch.check(target, span)?;
    }
    Ok(())
}
