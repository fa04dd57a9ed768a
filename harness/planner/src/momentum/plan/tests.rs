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
    let (windows, _) = task.layout.windows(&sunlit, &simulated).unwrap();
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

/// Two downlinks of an orbit phase; between them the momentum drifts whatever is chosen.
mod downlinks {
    use super::*;

    const HOUR_S: f64 = 3600.0;
    const DOWNLINKS_S: [[f64; 2]; 2] = [[12.0 * HOUR_S, 22.0 * HOUR_S], [60.0 * HOUR_S, 70.0 * HOUR_S]];
    /// In N m.
    const DRIFTS: [[f64; 3]; 3] = [[1.2e-5, 0.0, -4e-6], [-6e-6, 1e-6, 6e-6], [-1.0e-5, 0.0, 2e-6]];
    const REACH_RAD: [f64; 2] = [0.26, 0.22];

    /// Momentum at the edges: every torque is constant between them.
    fn at_edges(gains: [Vector3<f64>; 2]) -> [Vector3<f64>; 5] {
        let [first, second] = DOWNLINKS_S;
        let [drift, then, last] = DRIFTS.map(Vector3::from);
        let a = drift * first[0];
        let b = a + gains[0];
        let c = b + then * (second[0] - first[1]);
        let d = c + gains[1];
        [a, b, c, d, d + last * (96.0 * HOUR_S - second[1])]
    }

    struct Edges {
        sunlit: SunlitSpacecraft,
        simulated: SimulatedFlight,
        size: MomentumSize,
    }

    impl Edges {
        fn gain(&self, controls: &Controls, span_s: [f64; 2]) -> Vector3<f64> {
            let row = &self.simulated.rows[0];
            self.sunlit.torque_n_m(row, Attitude::Downlink, controls) * (span_s[1] - span_s[0])
        }

        fn flight(&self, controls: [Controls; 2]) -> SimulatedFlight {
            let [first, second] = DOWNLINKS_S;
            let gains = [self.gain(&controls[0], first), self.gain(&controls[1], second)];
            let momentum = at_edges(gains);
            let times = [0.0, first[0], first[1], second[0], second[1], 96.0 * HOUR_S];
            let mut flight = self.simulated.clone();
            for row in &mut flight.rows {
                let to = times.iter().position(|it| *it >= row.time_s).unwrap().max(1);
                let share = (row.time_s - times[to - 1]) / (times[to] - times[to - 1]);
                let before = if to == 1 { Vector3::zeros() } else { momentum[to - 2] };
                row.momentum_n_m_s = before.lerp(&momentum[to - 1], share);
                row.downlink = DOWNLINKS_S.iter().any(|[from, until]| (*from..*until).contains(&row.time_s));
            }
            flight
        }

        /// The least greatest momentum over a grid of places in both downlinks.
        fn least_of_grid(&self) -> f64 {
            let steps = 20;
            let mut places = Vec::new();
            for (i, j) in (-steps..=steps).flat_map(|i| (-steps..=steps).map(move |j| (i, j))) {
                let share = |k: i32| f64::from(k) / f64::from(steps);
                let controls = Controls::default()
                    .with(Control::Azimuth, share(i) * REACH_RAD[0])
                    .with(Control::Elevation, share(j) * REACH_RAD[1]);
                let [azimuth, elevation] = [Control::Azimuth, Control::Elevation].map(|it| controls.get(it));
                if self.sunlit.allows(&self.simulated.rows[0], azimuth, elevation) {
                    places.push(controls);
                }
            }
            let gains = |span_s: [f64; 2]| -> Vec<Vector3<f64>> {
                places.iter().map(|controls| self.gain(controls, span_s)).collect()
            };
            let [first, second] = DOWNLINKS_S.map(gains);
            let mut least = f64::INFINITY;
            for a in &first {
                for b in &second {
                    let greatest = at_edges([*a, *b]).iter().map(|it| self.size.of(it)).fold(0.0, f64::max);
                    least = least.min(greatest);
                }
            }
            least
        }
    }

    impl Simulates for Edges {
        fn simulate(
            &mut self,
            windows: &[Window],
            _: &[PlannedDump],
        ) -> Result<SimulatedFlight, Box<dyn std::error::Error>> {
            let free: Vec<&Window> = windows.iter().filter(|it| it.kind == WindowKind::Free).collect();
            assert_eq!(free.iter().map(|it| [it.start_s, it.stop_s]).collect::<Vec<_>>(), DOWNLINKS_S);
            Ok(self.flight([free[0].controls, free[1].controls]))
        }

        fn progress(&mut self, _: &str) {}
    }

    #[test]
    fn no_places_of_a_grid_leave_less_momentum() {
        for (convention, size) in [
            (Convention::Inertial, MomentumSize::Length),
            (Convention::BodyIntegral, MomentumSize::LargestComponent),
        ] {
            let mut sunlit = sunlit([0.0, 0.0, -0.0254]);
            sunlit.convention = convention;
            let mut edges = Edges { sunlit: sunlit.clone(), simulated: simulated(&sunlit, 4, 0.35), size };
            edges.simulated = edges.flight([Controls::default(); 2]);
            let unmanaged = edges.simulated.greatest(size).0;
            let reach = Reach { azimuth_rad: REACH_RAD[0], elevation_rad: REACH_RAD[1], ..Reach::default() };
            let task = PlanTask {
                layout: Layout::of_downlinks(edges.simulated.downlinks_s(), reach, 0.0),
                least: Least::Momentum,
                limit: Limit { size, ..task(5.0, reach).limit },
                ..task(5.0, reach)
            };
            let simulated = edges.simulated.clone();
            let found = plan(&task, &sunlit, &simulated, &mut edges).unwrap();
            assert!(found.holds && found.dumps.is_empty() && found.changes == 0);
            let [planned, flown] = found.greatest_n_m_s();
            let least = edges.least_of_grid();
            println!(
                "{convention:?}: unmanaged {unmanaged}, grid {least}, planned {planned}, simulated {flown}"
            );
            assert!(least < 0.8 * unmanaged, "{least} {unmanaged}");
            // As good as the grid but for where it stops, and no better than its spacing allows.
            assert!(flown <= 1.002 * least && flown >= 0.97 * least, "{convention:?}: {flown} {least}");
            assert!((planned - flown).abs() <= 1e-3 * flown);
            for window in found.windows.iter().filter(|window| window.kind == WindowKind::Free) {
                let [azimuth, elevation] =
                    [Control::Azimuth, Control::Elevation].map(|it| window.controls.get(it));
                assert!(sunlit.allows(&simulated.rows[0], azimuth, elevation));
            }
        }
    }
}
