//! The manoeuvre leads back: flights by another integrator, with the miss and with it.

use nalgebra::Vector2;

use super::*;
use crate::flyby::test_flight::{DAY_S, LONG_S, Leg, fixed_in_the_body, force_model, packed, unpacked};
use crate::momentum::test_spacecraft::sunlit;

/// Behind the encounter, away from whole revolutions, after which every place is costly.
const NEXT_S: f64 = 300.0 * DAY_S;

#[test]
fn the_manoeuvre_leads_back_to_the_nominal_place() {
    let mut leg = Leg::new(fixed_in_the_body(0.0), true);
    let start = leg.start();
    let intercept = leg.intercept(start, 0.0, LONG_S);
    let flight = leg.recorded(start, intercept.z);
    let sensitivity = Sensitivity::new(&flight, &force_model(), &sunlit([0.0; 3])).unwrap();
    let encounter = sensitivity.encounter.clone();
    let [manoeuvre_s, date_s] = [30.0 * DAY_S, NEXT_S].map(|it| encounter.time_s + it);
    let cost = MissCost::new(&sensitivity, &force_model(), [manoeuvre_s, date_s]).unwrap();
    let body = leg.body(force_model().body, encounter.epoch_s);
    let nominal = packed(&(body + encounter.at_epoch));
    let mut propagated = |shift_m: Vector3<f64>, delta_v_m_s: Vector3<f64>| {
        let mut y = nominal;
        (0..3).for_each(|axis| y[axis] += shift_m[axis]);
        let intercept = leg.intercept(y, encounter.epoch_s, encounter.time_s);
        let mut y = leg.propagated(y, [encounter.epoch_s, manoeuvre_s]);
        (0..3).for_each(|axis| y[axis + 3] += delta_v_m_s[axis]);
        (intercept, unpacked(&leg.propagated(y, [manoeuvre_s, date_s])).position_m)
    };
    let (intercept, nominal_m) = propagated(Vector3::zeros(), Vector3::zeros());
    let by_place = encounter.at_epoch_partials.fixed_columns::<3>(0).into_owned();
    for miss_m in [[10.0, 0.0], [0.0, 10.0], [-6.0, 8.0]] {
        let shift_m = by_place.try_inverse().unwrap() * Vector3::new(miss_m[0], miss_m[1], 0.0);
        let (missed, without_m) = propagated(shift_m, Vector3::zeros());
        assert!((missed.x - intercept.x - miss_m[0]).hypot(missed.y - intercept.y - miss_m[1]) < 0.05);
        assert!((missed.z - intercept.z).abs() < 1e-3);
        let (_, with_m) = propagated(shift_m, cost.by_miss_1_s * Vector2::from(miss_m));
        let [left_m, whole_m] = [with_m, without_m].map(|it| (it - nominal_m).norm());
        assert!(left_m < 2e-3 * whole_m && whole_m > 1e3, "{left_m} of {whole_m} m");
    }
    assert!(MissCost::new(&sensitivity, &force_model(), [date_s, manoeuvre_s]).is_err());
}
