//! Where the attitude turns over, and what that does to a change of the place, against flights with light ten thousand times as strong.

use nalgebra::SVector;
use physics::{bodies::Body, environment::orbit::OrbitMethod, numerics::Span};

use super::*;
use crate::flyby::test_flight::{LONG_S, Leg, fixed_in_the_body, force_model, packed};
use crate::momentum::test_spacecraft::sunlit;
use crate::orbit::transition;

#[test]
fn the_attitude_turns_over_later_where_the_place_says_so() {
    let mut leg = Leg::new(fixed_in_the_body(1.0), true);
    let start = leg.start();
    let intercept = leg.intercept(start, 0.0, LONG_S);
    let flight = leg.recorded(start, intercept.z);
    let path = Path::new(&flight).unwrap();
    let sunlit = sunlit([0.0; 3]);
    let flips = LightAlong::new(&path, &sunlit).flips();
    assert!(flips.len() >= 2, "{}", flips.len());
    for flip in &flips {
        let around = path.at(flip.time_s).from_sun.position_m;
        let earth = leg.body(Body::Earth, flip.time_s).position_m;
        assert!((-around).angle(&(earth - around)).cos().abs() < 1e-6);
    }
    // Three hours about the first, light being strong enough to see it.
    let flip_s = flips[0].time_s;
    let span_s = [flip_s - 5400.0, flip_s + 5400.0];
    let mut leg = Leg::new(fixed_in_the_body(1e4), true);
    let begin = packed(&path.at(span_s[0]).from_sun);
    let recorded = leg.recorded_over(begin, span_s, 300.0);
    let path = Path::new(&recorded).unwrap();
    let light = LightAlong::new(&path, &sunlit);
    let found = light.flips();
    assert_eq!(found.len(), 1);
    let (gravity, mut planets) = (force_model().gravity(Body::Sun), force_model().planets());
    let mut over = |span_s: [f64; 2]| {
        transition(&OrbitMethod::default(), Span::new(span_s[0], span_s[1]), |at_s| {
            let position_m = path.at(at_s).from_sun.position_m;
            gravity.model.gradient_per_s2(Body::Sun, at_s, &position_m, &mut planets)
                + light.gradient_per_s2(at_s.clamp(span_s[0] + 1.0, span_s[1] - 1.0))
        })
        .unwrap()
    };
    let [before, behind] = [over([span_s[0], found[0].time_s]), over([found[0].time_s, span_s[1]])];
    let whole = behind * found[0].saltation * before;
    let without = behind * before;
    for axis in 0..3 {
        let end = |leg: &mut Leg, step: f64| {
            let mut moved = begin;
            moved[axis] += step;
            leg.propagated(moved, span_s)
        };
        let expected: SVector<f64, 6> = (end(&mut leg, 1e6) - end(&mut leg, -1e6)) / 2e6;
        let velocity = |it: &SVector<f64, 6>| it.fixed_rows::<3>(3).into_owned();
        let size = velocity(&expected).norm();
        let off = (velocity(&whole.column(axis).into_owned()) - velocity(&expected)).norm();
        let off_without = (velocity(&without.column(axis).into_owned()) - velocity(&expected)).norm();
        assert!(off < 1e-3 * size && off_without > 0.5 * size, "{axis}: {off:e} of {size:e}");
    }
}
