//! Whole plans, simulated by an integration of their own with a torque that the model does not know.

use nalgebra::Vector3;

use super::*;
use crate::momentum::{
    test_spacecraft::{DAY_S, simulated, sunlit, task},
    windows::Reach,
};

/// Simulates windows with the alternate attitude as it is timed, in steps of ten minutes, and one more torque.
struct Integrated {
    sunlit: SunlitSpacecraft,
    simulated: SimulatedFlight,
    more_n_m: Vector3<f64>,
    flights: usize,
}

impl Simulates for Integrated {
    fn simulate(
        &mut self,
        windows: &[Window],
        dumps: &[PlannedDump],
    ) -> Result<SimulatedFlight, Box<dyn std::error::Error>> {
        self.flights += 1;
        let mut momentum = Vector3::zeros();
        let mut flight = self.simulated.clone();
        let steps = 12_u32;
        let mut count = 0;
        for index in 1..flight.rows.len() {
            let from = flight.rows[index - 1].clone();
            if let Some(dump) = dumps.iter().find(|dump| (dump.at_s - from.time_s).abs() < 1.0) {
                momentum = dump.after_n_m_s;
                count += 1;
            }
            let duration_s = flight.rows[index].time_s - from.time_s;
            for step in 0..steps {
                let time_s = from.time_s + duration_s * (f64::from(step) + 0.5) / f64::from(steps);
                let window = windows.iter().find(|window| window.stop_s > time_s).unwrap();
                let torque = self.sunlit.torque_n_m(&from, Attitude::Downlink, &window.controls);
                let is_alternate = window.alternate_spans_s().iter().any(|[a, b]| (*a..*b).contains(&time_s));
                let about = from.to_sun_m.normalize();
                let turned = about * (2.0 * about.dot(&torque)) - torque;
                let torque = if is_alternate { turned } else { torque };
                momentum += (torque + self.more_n_m) * (duration_s / f64::from(steps));
            }
            flight.rows[index].momentum_n_m_s = momentum;
            flight.rows[index].dumps = count;
        }
        Ok(flight)
    }

    fn progress(&mut self, _: &str) {}
}

fn planned(task: &PlanTask, more_n_m: Vector3<f64>) -> (MomentumPlan, Integrated) {
    let sunlit = sunlit([0.01, 0.02, 0.03]);
    let simulated = simulated(&sunlit, 20, 0.4);
    let mut integrated =
        Integrated { sunlit: sunlit.clone(), simulated: simulated.clone(), more_n_m, flights: 0 };
    let found = plan(task, &sunlit, &simulated, &mut integrated).unwrap();
    (found, integrated)
}

#[test]
fn the_flight_agrees_with_the_plan_below_the_limit() {
    let reach = Reach {
        windmill_rad: 0.06,
        azimuth_rad: 0.1,
        elevation_rad: 0.1,
        alternate: 0.5,
        ..Reach::default()
    };
    let task = task(3.0, reach);
    let more = Vector3::new(0.05, -0.08, 0.03) / DAY_S;
    let (found, integrated) = planned(&task, more);
    assert!(found.holds && found.exceeded.is_none() && found.dumps.is_empty());
    let [_, simulated] = found.greatest_n_m_s();
    assert!(simulated <= 3.0 && found.difference_n_m_s() <= AGREED * 3.0);
    assert_eq!(integrated.flights, found.rounds);
    // Without the plan the limit is exceeded.
    let bare = PlanTask { layout: Layout { reach: Reach::default(), ..task.layout.clone() }, ..task };
    let (none, _) = planned(&bare, more);
    let exceeded = none.exceeded.unwrap();
    assert!(exceeded.excess_n_m_s > 1.0 && !none.dumps.is_empty());
    assert_eq!(none.dumps.len(), none.dumps_at_least);
    assert!(none.holds, "dumps hold it");
}

/// By hand: the torque is constant, so |H| = |T| t exceeds L first at L / |T|, and by |T| t_end - L at the end.
#[test]
fn what_no_plan_holds_is_told_with_its_day() {
    let task = task(2.0, Reach::default());
    let sunlit = sunlit([0.01, 0.02, 0.03]);
    let simulated = simulated(&sunlit, 20, 0.4);
    let (windows, _) = task.layout.windows(&simulated).unwrap();
    let torque = sunlit.torque_n_m(&simulated.rows[0], Attitude::Downlink, &windows[0].controls).norm();
    let (found, _) = planned(&task, Vector3::zeros());
    let exceeded = found.exceeded.unwrap();
    assert!((exceeded.excess_n_m_s - (torque * 20.0 * DAY_S - 2.0)).abs() < 1e-6);
    // The guard and the distance of instants come before it.
    let exact_d = 2.0 / torque / DAY_S;
    let found_d = exceeded.first_s / DAY_S;
    assert!((found_d - exact_d).abs() < 0.13 + 0.01 * exact_d, "{found_d} {exact_d}");
}

/// Tilt alone, whose least is known: the torque across the Sun line has to be made so much smaller that |H| ends at the limit.
#[test]
fn no_plan_of_the_same_windows_has_less_tilt() {
    let reach = Reach { azimuth_rad: 0.2, elevation_rad: 0.2, ..Reach::default() };
    let task = task(2.5, reach);
    let (found, _) = planned(&task, Vector3::zeros());
    assert!(found.holds);
    let tilt = |windows: &[Window]| windows.iter().map(|it| it.controls.tilt_rad()).sum::<f64>();
    let least = tilt(&found.windows);
    assert!(least > 1e-3);
    // With nine tenths of it everywhere the limit is exceeded by more than the guard.
    let mut less = found.windows.clone();
    for window in &mut less {
        for control in [Control::Azimuth, Control::Elevation] {
            window.controls = window.controls.with(control, 0.9 * window.controls.get(control));
        }
    }
    let sunlit = sunlit([0.01, 0.02, 0.03]);
    let simulated = simulated(&sunlit, 20, 0.4);
    let mut integrated = Integrated { sunlit, simulated, more_n_m: Vector3::zeros(), flights: 0 };
    let flight = integrated.simulate(&less, &[]).unwrap();
    assert!(flight.greatest_momentum().0 > found.greatest_n_m_s()[1]);
}
