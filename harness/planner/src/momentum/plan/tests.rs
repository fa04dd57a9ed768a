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
            let other = (from.other_torque_n_m + flight.rows[index].other_torque_n_m) * 0.5;
            for step in 0..steps {
                let time_s = from.time_s + duration_s * (f64::from(step) + 0.5) / f64::from(steps);
                let window = windows.iter().find(|window| window.stop_s > time_s).unwrap();
                let torque = self.sunlit.torque_n_m(&from, Attitude::Downlink, &window.controls);
                let is_alternate = window.alternate_spans_s().iter().any(|[a, b]| (*a..*b).contains(&time_s));
                let about = from.to_sun_m.normalize();
                let turned = about * (2.0 * about.dot(&torque)) - torque;
                let torque = if is_alternate { turned } else { torque };
                momentum += (torque + other + self.more_n_m) * (duration_s / f64::from(steps));
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

const DAYS: usize = 7;
/// Torques about the axis of that by windmill angles, by day, where those give up to 0.75 a day and the limit is 0.5, and the fewest
/// changes of the angle, by intervals of the momentum carried through all choices of the days. Going on as far as possible takes
/// more changes of the first (3) and the second (2).
const BY_DAY: [([f64; DAYS], usize); 4] = [
    ([0.7, -0.4, -0.6, 0.5, 0.4, 0.7, -0.7], 2),
    ([-0.7, 0.7, 0.2, 0.6, 0.7, -0.3, 0.1], 1),
    ([0.7, -0.5, -0.5, 0.6, 0.6, -0.6, -0.7], 3),
    ([0.5, -0.7, -0.5, 0.7, -0.1, -0.2, 0.6], 2),
];

/// Of all choices of the days at which the arrays move, a plan has one with the fewest.
#[test]
fn arrays_move_no_more_often_than_by_the_best_of_all_choices() {
    const UNIT_N_M_S: f64 = 2.0;
    let sunlit = sunlit([0.0; 3]);
    let still = simulated(&sunlit, DAYS as u32, 0.4);
    let row = &still.rows[0];
    let layout = |windmill_rad| task(0.5 * UNIT_N_M_S, Reach { windmill_rad, ..Reach::default() });
    let (windows, _) = layout(0.05).layout.windows(&still).unwrap();
    let torque = |windmill_rad: f64| {
        let controls = windows[0].controls.with(Control::Windmill, windmill_rad);
        sunlit.torque_n_m(row, Attitude::Downlink, &controls)
    };
    let by_rad = (torque(1e-3) - torque(-1e-3)) / 2e-3;
    let axis = by_rad.normalize();
    let task = layout(0.75 * UNIT_N_M_S / DAY_S / by_rad.norm());
    for (by_day, expected) in BY_DAY {
        let mut simulated = still.clone();
        for row in &mut simulated.rows {
            let day = |time_s: f64| by_day[((time_s / DAY_S) as usize).min(DAYS - 1)];
            // Where one follows another, their mean.
            let mean = 0.5 * (day(row.time_s - 1.0) + day(row.time_s + 1.0));
            row.other_torque_n_m = axis * (mean * UNIT_N_M_S / DAY_S) - torque(0.0);
        }
        let mut integrated = Integrated {
            sunlit: sunlit.clone(),
            simulated: simulated.clone(),
            more_n_m: Vector3::zeros(),
            flights: 0,
        };
        let found = plan(&task, &sunlit, &simulated, &mut integrated).unwrap();
        let (windows, _) = task.layout.windows(&simulated).unwrap();
        let start = Model::new(&sunlit, simulated, windows, task.limit.clone());
        assert!(found.holds && found.dumps.is_empty(), "{by_day:?}: {:?}", found.greatest_n_m_s());
        assert_eq!((found.changes, found.changes_at_least), (expected, expected), "{by_day:?}");
        let mut fewer = (0_u32..1 << (DAYS - 1)).filter(|places| (places.count_ones() as usize) < expected);
        let kept = fewer.find(|places| {
            let mut leader = 0;
            let leaders = (0..DAYS).map(|window| {
                if window > 0 && places >> (window - 1) & 1 == 1 {
                    leader = window;
                }
                leader
            });
            let (leaders, mut model): (Vec<usize>, _) = (leaders.collect(), start.clone());
            refine(&mut model, &sunlit, &leaders, (Goal::LeastExcess, WHOLE), &mut integrated).unwrap()
        });
        assert_eq!(kept, None, "{by_day:?}");
    }
}
