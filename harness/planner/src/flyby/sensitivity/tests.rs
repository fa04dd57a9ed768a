//! Partials are what flights by another integrator differ by; what they say of a miss takes it away.

use nalgebra::{Matrix3x6, SVector, Vector3};

use super::*;
use crate::flyby::test_flight::{DAY_S, Intercept, LONG_S, Law, Leg, fixed_in_the_body, force_model, packed};
use crate::momentum::test_spacecraft::sunlit;

struct LinearizedLeg {
    leg: Leg,
    recorded: SimulatedFlight,
    sensitivity: Sensitivity,
    intercept: Intercept,
}

fn flight(law: Law, flips: bool) -> LinearizedLeg {
    let mut leg = Leg::new(law, flips);
    let start = leg.start();
    let intercept = leg.intercept(start, 0.0, LONG_S);
    let recorded = leg.recorded(start, intercept.z);
    let sensitivity = Sensitivity::new(&recorded, &force_model(), &sunlit([0.0; 3])).unwrap();
    LinearizedLeg { leg, recorded, sensitivity, intercept }
}

impl LinearizedLeg {
    fn state(&self, row: usize) -> SVector<f64, 6> {
        packed(&self.recorded.rows[row].motion.unwrap().from_sun)
    }

    /// Central differences of the aimpoint by the state at a row, whose steps move B by some 2 km.
    fn differences(&mut self, row: usize) -> Matrix3x6<f64> {
        let (time_s, state) = (self.recorded.rows[row].time_s, self.state(row));
        let partials = self.sensitivity.at(time_s);
        let mut found = Matrix3x6::zeros();
        for axis in 0..6 {
            let block = partials.fixed_view::<2, 3>(0, axis / 3 * 3).norm();
            let step = 2e3 / block;
            let [after, before] = [step, -step].map(|step| {
                let mut moved = state;
                moved[axis] += step;
                self.leg.intercept(moved, time_s, self.intercept.z)
            });
            found.set_column(axis, &((after - before) / (2.0 * step)));
        }
        found
    }

    /// The worst row and half of partials: by how much they differ from differences, over their norm.
    fn off(&mut self, row: usize) -> f64 {
        let partials = self.sensitivity.at(self.recorded.rows[row].time_s);
        let differences = self.differences(row);
        let mut worst = 0.0_f64;
        for half in [0, 3] {
            let [found, expected] =
                [partials, differences].map(|it| it.fixed_columns::<3>(half).into_owned());
            for row in 0..3 {
                worst = worst.max((found.row(row) - expected.row(row)).norm() / expected.row(row).norm());
            }
        }
        worst
    }
}

#[test]
fn the_encounter_is_that_of_the_flight() {
    let flight = flight(fixed_in_the_body(1.0), true);
    let encounter = &flight.sensitivity.encounter;
    assert!(
        (encounter.time_s - flight.intercept.z).abs() < 1e-3,
        "{} {}",
        encounter.time_s,
        flight.intercept.z
    );
    let off_m =
        (encounter.plane.b_t_m - flight.intercept.x).hypot(encounter.plane.b_r_m - flight.intercept.y);
    assert!(off_m < 10.0, "{off_m}");
    assert!((encounter.plane.excess_speed_m_s - 5.02e3).abs() < 20.0);
}

#[test]
fn without_a_flip_partials_by_state_are_those_of_flights_to_1e_5() {
    let mut flight = flight(fixed_in_the_body(1.0), false);
    for row in [0, 24 * 90, 24 * 196] {
        let off = flight.off(row);
        assert!(off < 1e-5, "{row}: {off:e}");
    }
}

/// Thirty times as strong, so that what light does to them counts: 1e-3 of a row.
#[test]
fn with_strong_light_that_turns_over_they_are_to_1e_4() {
    let mut flight = flight(fixed_in_the_body(30.0), true);
    for row in [0, 24 * 90] {
        let off = flight.off(row);
        assert!(off < 1e-4, "{row}: {off:e}");
    }
}

#[test]
fn the_desired_change_of_velocity_takes_a_miss_away() {
    let mut flight = flight(fixed_in_the_body(1.0), true);
    for days_before in [118.0, 4.0] {
        let row = ((flight.intercept.z - days_before * DAY_S) / 3600.0) as usize;
        let time_s = flight.recorded.rows[row].time_s;
        for miss_m in [[-17e3, 0.0], [6e3, 11e3]] {
            let desired = flight.sensitivity.desired(time_s, miss_m).unwrap();
            let mut changed = flight.state(row);
            let mut rows = changed.fixed_rows_mut::<3>(3);
            rows += desired.delta_v_m_s;
            let intercept = flight.leg.intercept(changed, time_s, flight.intercept.z);
            let left_m = (intercept.x - flight.intercept.x + miss_m[0])
                .hypot(intercept.y - flight.intercept.y + miss_m[1]);
            assert!(left_m < 5e-3 * miss_m[0].hypot(miss_m[1]), "{days_before}: {left_m}");
            // The same with the time of arrival kept.
            let desired = flight.sensitivity.desired_in_time(time_s, miss_m, 0.0).unwrap();
            let mut changed = flight.state(row);
            let mut rows = changed.fixed_rows_mut::<3>(3);
            rows += desired.delta_v_m_s;
            let intercept = flight.leg.intercept(changed, time_s, flight.intercept.z);
            assert!((intercept.z - flight.intercept.z).abs() < 0.05, "{}", intercept.z - flight.intercept.z);
            let direction = Vector3::new(
                desired.declination_rad().cos() * desired.right_ascension_rad().cos(),
                desired.declination_rad().cos() * desired.right_ascension_rad().sin(),
                desired.declination_rad().sin(),
            );
            assert!((direction * desired.size_m_s() - desired.delta_v_m_s).norm() < 1e-12);
        }
    }
}
