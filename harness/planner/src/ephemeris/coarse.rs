//! Coarse elements through the states of a flight.

use core::f64::consts::TAU;

use physics::{
    bodies::Body,
    environment::{
        CartesianState,
        onboard::{CoarseElements, KeplerianElements},
        orbit::Elements,
    },
    math,
    numerics::{Span, chebyshev::Segment},
};

/// States that a fit is made of.
pub(super) const COARSE_SAMPLES: usize = 256;

/// Fits states about the centre at the nodes of a span, from the last to the first; `None` where one is no ellipse.
pub(super) fn coarse_elements(
    center: Body,
    span: Span,
    states: &[CartesianState; COARSE_SAMPLES],
) -> Option<CoarseElements> {
    let nodes_s = Segment::<6, COARSE_SAMPLES>::nodes(span.start_s, span.end_s);
    let mut elements = [KeplerianElements::zeros(); COARSE_SAMPLES];
    let mut later: Option<(f64, KeplerianElements)> = None;
    for ((state, at_s), slot) in states.iter().zip(nodes_s).zip(&mut elements) {
        let mut found = classical(state, center)?;
        if let Some((later_s, later)) = later {
            // The mean anomaly continues by the mean motion, the other angles hardly at all.
            let a_m = 0.5 * (found[0] + later[0]);
            let motion_rad_s = (center.data().gm_m3_s2 / (a_m * a_m * a_m)).sqrt();
            for (angle, expected) in
                [(3, later[3]), (4, later[4]), (5, later[5] - motion_rad_s * (later_s - at_s))]
            {
                found[angle] -= ((found[angle] - expected) / TAU).round() * TAU;
            }
        }
        later = Some((at_s, found));
        *slot = found;
    }
    Some(CoarseElements::from_elements(center, span, &elements))
}

/// The elements of an ellipse; `None` for another orbit.
fn classical(state: &CartesianState, center: Body) -> Option<KeplerianElements> {
    let elements = Elements::from_state(state, center.data().gm_m3_s2).ok()?;
    let e = elements.eccentricity;
    if e >= 1.0 {
        return None;
    }
    let (sin, cos) = math::sin_cos(elements.true_anomaly_rad);
    let eccentric_rad = math::atan2(((1.0 - e) * (1.0 + e)).sqrt() * sin, cos + e);
    Some(KeplerianElements::from([
        elements.semi_major_axis_m,
        e,
        elements.inclination_rad,
        elements.ascending_node_rad,
        elements.periapsis_argument_rad,
        eccentric_rad - e * math::sin(eccentric_rad),
    ]))
}

#[cfg(test)]
mod tests {
    //! Elements that drift, and those of Mercury, are found again.

    use physics::{
        constants::{DAY_S, GM_MERCURY_M3_S2, GM_SUN_M3_S2},
        environment::{
            ephemeris::Ephemeris, kepler_planet::MESSENGER_AS_PRINTED, orbit::TwoBodyOrbit,
            time::MOMENTUM_STUDY_START_S as START_S,
        },
    };

    use super::*;

    /// An ellipse whose elements drift evenly is given back, over many turns.
    #[test]
    fn a_coarse_model_follows_elements_that_drift() {
        let span = Span::new(START_S, START_S + 365.0 * DAY_S);
        let drifting = |epoch_s: f64| {
            let elapsed = (epoch_s - START_S) / (365.0 * DAY_S);
            let orbit = TwoBodyOrbit::from_elements(MESSENGER_AS_PRINTED, GM_MERCURY_M3_S2, START_S).unwrap();
            let now = Elements::from_state(&orbit.state_at(epoch_s), GM_MERCURY_M3_S2).unwrap();
            Elements {
                periapsis_argument_rad: now.periapsis_argument_rad + 0.05 * elapsed,
                eccentricity: now.eccentricity + 0.01 * elapsed * elapsed,
                ..now
            }
            .state(GM_MERCURY_M3_S2)
            .unwrap()
        };
        let nodes = Segment::<6, COARSE_SAMPLES>::nodes(span.start_s, span.end_s);
        let first = Elements::from_state(&drifting(START_S), GM_MERCURY_M3_S2).unwrap();
        let motion = coarse_elements(Body::Mercury, span, &nodes.map(drifting)).unwrap();
        let found = motion.elements.value(span.end_s);
        assert!((found[4] - first.periapsis_argument_rad - 0.05).abs() < 1e-6 * 0.05, "{found}");
        assert!((found[1] - first.eccentricity - 0.01).abs() < 1e-8);
        // 730 turns, give or take what the drift of the eccentricity makes of the mean anomaly.
        let turns = (found[5] - motion.elements.value(span.start_s)[5]) / core::f64::consts::TAU;
        let period_s = core::f64::consts::TAU
            * (MESSENGER_AS_PRINTED.semi_major_axis_m.powi(3) / GM_MERCURY_M3_S2).sqrt();
        assert!((turns - 365.0 * DAY_S / period_s).abs() < 0.05, "{turns}");
    }

    /// Kepler's third law holds for the mean motion of a coarse planet.
    #[test]
    fn coarse_mercury_keeps_its_period() {
        let span @ Span { start_s, end_s } = Span::new(START_S, START_S + 10.0 * 365.25 * DAY_S);
        let mut ephemeris = Ephemeris::default();
        let nodes = Segment::<6, COARSE_SAMPLES>::nodes(start_s, end_s);
        let states = nodes.map(|epoch_s| ephemeris.state(Body::Mercury, epoch_s));
        let motion = coarse_elements(Body::Sun, span, &states).unwrap();
        let [first, last] = [start_s, end_s].map(|at_s| motion.elements.value(at_s));
        let motion_rad_s = (last[5] - first[5]) / (end_s - start_s);
        let a_m = math::cbrt(GM_SUN_M3_S2 / (motion_rad_s * motion_rad_s));
        assert!((a_m / first[0] - 1.0).abs() < 1e-5, "{}", a_m / first[0]);
    }
}
