//! Places of an encounter whose partials are constant: reach in closed form, plans that meet a target.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::*;
use crate::momentum::{
    encountered::Encountered,
    in_force::ActiveControls,
    plan::{MomentumPlan, PlanTask, plan},
    simulated::MomentumSize,
    target::Target,
    test_spacecraft::{DAY_S, row, simulated, sunlit, task},
    windows::ControlBounds,
};

const DAYS: f64 = 8.0;
const LIMIT_N_M_S: f64 = 6.0;
/// What a m/s does, in s.
const BY_VELOCITY_S: f64 = 2e6;

/// T along Y, R along Z of EME2000.
fn by_velocity() -> Matrix3<f64> {
    let (y, z) = (Vector3::y().transpose(), Vector3::z().transpose());
    Matrix3::from_rows(&[y * BY_VELOCITY_S, z * BY_VELOCITY_S, y * 0.0])
}

fn force(sunlit: &SunlitSpacecraft, row: &FlightRow, window: &Window, time_s: f64) -> Vector3<f64> {
    let load = sunlit.linearised(row, Attitude::Downlink, &window.controls);
    let is_alternate = window.alternate_spans_s().iter().any(|[a, b]| (*a..*b).contains(&time_s));
    load.mean_force_n(f64::from(u8::from(is_alternate))).0
}

/// Simulates windows in steps of half an hour, the alternate attitude as it is timed.
struct Encounters {
    sunlit: SunlitSpacecraft,
    simulated: SimulatedFlight,
    miss_m: Vector3<f64>,
}

impl Encounters {
    /// Misses by `miss_m` without any control.
    fn new(miss_m: Vector3<f64>) -> Self {
        let sunlit = sunlit([0.01, 0.02, 0.03]);
        let mut simulated = simulated(&sunlit, DAYS as u32, 0.4);
        let (windows, _) = task(1.0, tilts()).layout.windows(&sunlit, &simulated).unwrap();
        // The arrays on the baseline.
        for row in &mut simulated.rows {
            let sun_body = row.inertial_from_body.inverse() * row.to_sun_m.normalize();
            let panels = sunlit.spacecraft.panels.iter().zip(&sunlit.panels);
            let angles = panels.map(|(panel, own)| {
                panel.angle_for_sun_offset(&sun_body, windows[0].baseline_rad, own.tilt.sign)
            });
            row.panel_angles_rad = angles.collect();
        }
        let by_velocity = [0.0, DAYS * DAY_S].map(|at_s| (at_s, by_velocity()));
        simulated.encountered = Some(Encountered { miss: miss_m, by_velocity: by_velocity.to_vec() });
        Self { sunlit, simulated, miss_m }
    }
}

impl Simulates for Encounters {
    fn simulate(
        &mut self,
        windows: &[Window],
        _: &[PlannedDump],
    ) -> Result<SimulatedFlight, Box<dyn std::error::Error>> {
        let mut flight = self.simulated.clone();
        let (mut momentum, mut miss) = (Vector3::zeros(), self.miss_m);
        let mass_kg = self.sunlit.current_mass_panels_stowed.mass_kg;
        for index in 1..flight.rows.len() {
            let from = flight.rows[index - 1].clone();
            let step_s = (flight.rows[index].time_s - from.time_s) / 4.0;
            for step in 0..4 {
                let time_s = from.time_s + step_s * (f64::from(step) + 0.5);
                let window = windows.iter().find(|window| window.stop_s > time_s).unwrap();
                let load = self.sunlit.linearised(&from, Attitude::Downlink, &window.controls);
                let is_alternate = window.alternate_spans_s().iter().any(|[a, b]| (*a..*b).contains(&time_s));
                momentum += load.mean(f64::from(u8::from(is_alternate))).0 * step_s;
                let controls = Controls::default().with(Control::Offset, window.baseline_rad);
                let bare = Window { controls, ..window.clone() };
                let more =
                    force(&self.sunlit, &from, window, time_s) - force(&self.sunlit, &from, &bare, time_s);
                miss += by_velocity() * more * (step_s / mass_kg);
            }
            flight.rows[index].momentum_n_m_s = momentum;
        }
        if let Some(encountered) = &mut flight.encountered {
            encountered.miss = miss;
        }
        Ok(flight)
    }

    fn progress(&mut self, _: &str) {}
}

fn tilts() -> ControlBounds {
    ControlBounds { azimuth_rad: 0.1, elevation_rad: 0.1, windmill_rad: 0.05, ..ControlBounds::default() }
}

fn targeting(limit_n_m_s: f64, control_bounds: ControlBounds) -> PlanTask {
    PlanTask {
        target: Some(Target { tolerance: [Some(100.0), Some(100.0), None] }),
        ..task(limit_n_m_s, control_bounds)
    }
}

fn planned(task: &PlanTask, miss_m: Vector3<f64>) -> MomentumPlan {
    let mut encounters = Encounters::new(miss_m);
    let (sunlit, simulated) = (encounters.sunlit.clone(), encounters.simulated.clone());
    plan(&PlanProblem { task, sunlit: &sunlit, simulated: &simulated }, &mut encounters).unwrap()
}

fn reached(task: &PlanTask) -> Reachable {
    let encounters = Encounters::new(Vector3::zeros());
    let problem = PlanProblem { task, sunlit: &encounters.sunlit, simulated: &encounters.simulated };
    reachable(&problem, &mut Silent).unwrap()
}

/// One control alone: the force at its bounds, times the time, is the reach.
#[test]
fn the_reach_of_one_control_is_what_its_bounds_do() {
    let one = ControlBounds { elevation_rad: 0.1, ..ControlBounds::default() };
    let task = targeting(1e3, one);
    let found = reached(&task);
    let encounters = Encounters::new(Vector3::zeros());
    let (windows, _) = task.layout.windows(&encounters.sunlit, &encounters.simulated).unwrap();
    let row = row(&encounters.sunlit, 0.0, 0.4, 0.3);
    let at = |elevation_rad: f64| {
        let controls = windows[0].controls.with(Control::Elevation, elevation_rad);
        let force = encounters.sunlit.linearised(&row, Attitude::Downlink, &controls).normal.force_n;
        by_velocity() * force * (DAYS * DAY_S / encounters.sunlit.current_mass_panels_stowed.mass_kg)
    };
    let places = [0.1, -0.1].map(|elevation_rad| (at(elevation_rad) - at(0.0)).xy());
    assert!(places[0].norm() > 5e3, "{places:?}");
    for place in places {
        let nearest = found.region_m.corners.iter().map(|corner| (Vector2::from(*corner) - place).norm());
        assert!(
            nearest.fold(f64::INFINITY, f64::min) < 1e-3 * place.norm(),
            "{:?} {place}",
            found.region_m.corners
        );
    }
    // A segment, but for what is not linear.
    let area = |corners: &[[f64; 2]]| {
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        0.5 * pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    };
    assert!(area(&found.region_m.corners) < 0.05 * (places[0] - places[1]).norm_squared());
}

/// What lies inside of the polygon is met within all limits, what lies outside is not.
#[test]
fn a_target_in_reach_is_met_and_one_beyond_is_not() {
    let task = targeting(LIMIT_N_M_S, tilts());
    let reach = reached(&task);
    for (axis, sign, along) in [(0, 1.0, 0), (1, -1.0, 3)] {
        let farthest_m: f64 = reach.along_m[along].unwrap();
        assert!(farthest_m > 5e3);
        let corners = reach.region_m.corners.iter().map(|corner| sign * corner[axis]);
        assert!(corners.fold(0.0, f64::max) >= farthest_m * (1.0 - 1e-3));
        for (share, is_met) in [(0.85, true), (1.2, false)] {
            let mut miss_m = Vector3::zeros();
            miss_m[axis] = -sign * share * farthest_m;
            let found = planned(&task, miss_m);
            assert_eq!(found.holds, is_met, "{axis} {sign} {share}: {:?}", found.flight.encountered);
            let left = found.flight.encountered.as_ref().unwrap().miss;
            assert_eq!(left.xy().amax() <= 100.0, is_met);
            assert!(!is_met || found.greatest_n_m_s()[1] <= LIMIT_N_M_S);
            // No dump leads there.
            assert!(found.dumps.is_empty() && found.exceeded.is_none());
        }
    }
}

/// Alternate throughout and below its limit without a plan: what it is keeps all limits, and so does all between what was found.
#[test]
fn a_flight_that_alternates_is_within_its_own_reach() {
    let bounds = ControlBounds { alternate: 1.0, ..tilts() };
    let mut task = targeting(f64::INFINITY, bounds);
    let controls = Controls::default().with(Control::Alternate, 1.0);
    task.layout.in_force = vec![ActiveControls { at_s: 0.0, controls }];
    let Encounters { sunlit, mut simulated, .. } = Encounters::new(Vector3::new(1e5, -2e4, 0.0));
    let mut momentum = Vector3::zeros();
    for row in &mut simulated.rows {
        let load = sunlit.linearised(row, Attitude::Downlink, &controls);
        row.inertial_from_body = Rotation3::from_matrix_unchecked(load.half_turn) * row.inertial_from_body;
        row.momentum_n_m_s = momentum;
        momentum += load.mean(1.0).0 * 7200.0;
    }
    task.limit.momentum_n_m_s = 1.02 * simulated.greatest(MomentumSize::Length).0;
    let problem = PlanProblem { task: &task, sunlit: &sunlit, simulated: &simulated };
    let found = reachable(&problem, &mut Silent).unwrap();
    println!("{found:?}");
    let all: Vec<Vector2<f64>> = found.region_m.corners.iter().map(|corner| Vector2::from(*corner)).collect();
    let is_within = |place: Vector2<f64>| {
        let mut pairs = all.iter().zip(all.iter().cycle().skip(1));
        pairs.all(|(from, to)| (to - from).perp(&(place - from)) >= 0.0)
    };
    assert!(is_within(Vector2::zeros()));
    let axes = [Vector2::x(), -Vector2::x(), Vector2::y(), -Vector2::y()];
    for (axis, along_m) in axes.iter().zip(found.along_m) {
        let along_m = along_m.unwrap();
        assert!(
            is_within(axis * (along_m - 1e-3)) && !is_within(axis * (along_m + 1e-3)),
            "{axis} {along_m}"
        );
    }
}
