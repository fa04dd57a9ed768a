//! Missions that have a plan, or hold without one; flights that answer more than the model says.

use super::*;
use crate::momentum::in_force::ActiveControls;

const CENTER_OF_MASS_M: [f64; 3] = [0.01, 0.02, 0.03];
const DAYS: u32 = 20;

fn integrated(echo: f64) -> Integrated {
    let sunlit = sunlit(CENTER_OF_MASS_M);
    let simulated = simulated(&sunlit, DAYS, 0.4);
    Integrated { sunlit, simulated, more_n_m: Vector3::zeros(), echo, flights: 0 }
}

fn all_controls() -> ControlBounds {
    ControlBounds {
        windmill_rad: 0.06,
        azimuth_rad: 0.1,
        elevation_rad: 0.1,
        alternate: 0.5,
        ..ControlBounds::default()
    }
}

/// The frozen part comes within the guard of the limit. By the guard alone no programme of what is left had an answer, and every window
/// moved its arrays.
#[test]
fn planning_again_within_the_guard_of_the_limit_is_never_worse() {
    let mut flies = integrated(0.0);
    let (sunlit, bare) = (flies.sunlit.clone(), flies.simulated.clone());
    let task = task(3.0, all_controls());
    let first = solved(&task, &sunlit, &bare, &mut flies);
    assert!(first.holds && !first.is_mission);
    let own: Vec<ActiveControls> =
        first.windows.iter().map(|it| ActiveControls { at_s: it.start_s, controls: it.controls }).collect();
    let greatest_n_m_s = first.flight.greatest(MomentumSize::Length).0;
    for from_d in [6.0, 10.5, 14.0] {
        let layout = Layout {
            frozen_until_s: from_d * DAY_S,
            own: own.clone(),
            in_force: own.clone(),
            ..task.layout.clone()
        };
        let limit = Limit { momentum_n_m_s: 1.002 * greatest_n_m_s, ..task.limit.clone() };
        let again = PlanTask { layout, limit, ..task.clone() };
        let mut flies = Integrated { simulated: first.flight.clone(), ..integrated(0.0) };
        let found = solved(&again, &sunlit, &first.flight, &mut flies);
        let behind = first.windows.windows(2).filter(|pair| pair[1].start_s > from_d * DAY_S - 1.0);
        let moves = behind.filter(|pair| {
            [Control::Offset, Control::Windmill]
                .iter()
                .any(|it| (pair[0].controls.get(*it) - pair[1].controls.get(*it)).abs() > 1e-6)
        });
        let own_changes = moves.count();
        assert!(found.holds && found.dumps.is_empty(), "{from_d}");
        assert!(found.changes <= own_changes, "{from_d}: {} for {own_changes}", found.changes);
        assert!(found.changes_at_least <= found.changes);
    }
}

/// A mission whose own arrays hold its momentum, in a corridor that every offset keeps: arrays in the middle of it do not.
#[test]
fn without_a_corridor_the_arrays_stay_where_the_mission_has_them() {
    let mut flies = integrated(0.0);
    let (sunlit, bare) = (flies.sunlit.clone(), flies.simulated.clone());
    let at = |offset_deg: f64| Controls::default().with(Control::Offset, offset_deg.to_radians());
    let torque =
        |offset_deg: f64| sunlit.torque_n_m(&bare.rows[0], Attitude::Downlink, &at(offset_deg)).norm();
    let offsets_deg = (0..18).map(|k| 5.0 * f64::from(k));
    let best_deg = offsets_deg.min_by(|a, b| torque(*a).total_cmp(&torque(*b))).unwrap();
    let limit_n_m_s = 1.1 * torque(best_deg) * f64::from(DAYS) * DAY_S;
    assert!(torque(45.0) * f64::from(DAYS) * DAY_S > 1.2 * limit_n_m_s, "{best_deg}");
    let mut task = task(limit_n_m_s, ControlBounds::default());
    task.layout.own = vec![ActiveControls { at_s: 0.0, controls: at(best_deg) }];
    // As the mission flies.
    let (mut windows, _) = task.layout.windows(&sunlit, &bare).unwrap();
    windows.iter_mut().for_each(|it| it.controls = at(best_deg));
    let simulated = flies.simulate(&windows, &[]).unwrap();
    let found = solved(&task, &sunlit, &simulated, &mut flies);
    assert!(found.holds && found.dumps.is_empty() && found.changes == 0, "{:?}", found.greatest_n_m_s());
    assert_eq!(found.baseline.len(), 1);
    assert!((found.baseline[0].offset_rad - best_deg.to_radians()).abs() < 1e-12);
}

/// Tilt does twice what the model says: each correction in full leads to the other side of the answer, and the flights never agreed.
#[test]
fn plans_are_judged_by_their_flights_and_corrections_are_damped() {
    let control_bounds = ControlBounds { azimuth_rad: 0.2, elevation_rad: 0.2, ..ControlBounds::default() };
    let task = task(2.5, control_bounds);
    let mut flies = integrated(1.0);
    let (sunlit, bare) = (flies.sunlit.clone(), flies.simulated.clone());
    let found = solved(&task, &sunlit, &bare, &mut flies);
    assert!(found.holds && found.greatest_n_m_s()[1] <= 2.5);
    assert!(found.difference_n_m_s() <= AGREED * 2.5, "{}", found.difference_n_m_s());
}

/// Flights with one more torque, the other way in every other one: no model agrees with the next.
struct Fickle(Integrated);

impl Simulates for Fickle {
    fn simulate(
        &mut self,
        windows: &[Window],
        dumps: &[PlannedDump],
    ) -> Result<SimulatedFlight, Box<dyn std::error::Error>> {
        self.0.more_n_m = -self.0.more_n_m;
        self.0.simulate(windows, dumps)
    }
}

#[test]
fn a_plan_whose_flight_stays_below_the_limit_holds_however_far_the_model_is() {
    let mut flies = integrated(0.0);
    let (sunlit, bare) = (flies.sunlit.clone(), flies.simulated.clone());
    let mut task = task(1.0, ControlBounds::default());
    let (windows, _) = task.layout.windows(&sunlit, &bare).unwrap();
    let unmanaged_n_m_s = flies.simulate(&windows, &[]).unwrap().greatest(MomentumSize::Length).0;
    task.limit.momentum_n_m_s = 1.1 * unmanaged_n_m_s;
    let span_s = f64::from(DAYS) * DAY_S;
    flies.more_n_m = Vector3::new(0.045, 0.0, 0.0) * (unmanaged_n_m_s / span_s);
    let found = solved(&task, &sunlit, &bare, &mut Fickle(flies));
    assert!(found.difference_n_m_s() > AGREED * task.limit.momentum_n_m_s, "{}", found.difference_n_m_s());
    assert!(found.greatest_n_m_s()[1] < task.limit.momentum_n_m_s);
    assert!(found.holds && found.dumps.is_empty());
}
