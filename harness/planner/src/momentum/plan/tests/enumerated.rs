//! Every "at least" of a plan against all plans of a grid, integrated here on their own.

use super::*;

const DAYS: usize = 4;
/// Cells of two hours in a day.
const CELLS: usize = 12;
const WINDMILL_RAD: f64 = 0.05;
const AZIMUTH_RAD: f64 = 0.1;
/// Torque that is not of sunlight by day, in N m s a day.
const DRIFTS: [[[f64; 3]; DAYS]; 4] = [
    [[0.9, 0.2, -0.4], [0.7, -0.3, 0.5], [-0.8, 0.6, 0.1], [0.5, 0.9, -0.6]],
    [[1.5, 0.1, 0.2], [1.2, 0.3, -0.2], [1.4, -0.2, 0.1], [1.1, 0.2, 0.3]],
    [[0.3, -1.2, 0.6], [-0.9, -0.8, 0.4], [0.4, -1.1, -0.3], [0.2, -0.7, 0.8]],
    [[0.2, 0.1, 1.3], [-0.1, 0.4, -1.4], [0.3, -0.2, 1.2], [0.1, 0.2, -1.3]],
];

/// Windmill angle, azimuth and share of the alternate attitude of a day.
fn choices() -> Vec<Controls> {
    let mut all = Vec::new();
    for windmill_rad in [-WINDMILL_RAD, 0.0, WINDMILL_RAD] {
        for azimuth_rad in [-AZIMUTH_RAD, AZIMUTH_RAD] {
            for share in [0.0, 0.5] {
                let offset = Controls::default().with(Control::Offset, core::f64::consts::FRAC_PI_4);
                let placed = offset.with(Control::Windmill, windmill_rad).with(Control::Azimuth, azimuth_rad);
                all.push(placed.with(Control::Alternate, share));
            }
        }
    }
    all
}

/// Momentum after each cell of a day from zero, alternate from 6 to 18 h where half of it is.
fn day(
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    of: usize,
    controls: &Controls,
    drift: [f64; 3],
) -> [Vector3<f64>; CELLS] {
    let mut at = Vector3::zeros();
    std::array::from_fn(|cell| {
        let row = &simulated.rows[of * CELLS + cell];
        let torque = sunlit.torque_n_m(row, Attitude::Downlink, controls);
        let about = row.to_sun_m.normalize();
        let is_alternate = controls.get(Control::Alternate) > 0.0 && (3..9).contains(&cell);
        let torque = if is_alternate { about * (2.0 * about.dot(&torque)) - torque } else { torque };
        at += torque * 7200.0 + Vector3::from(drift) / CELLS as f64;
        at
    })
}

/// Dumps of a path that goes on as long as it can after each, which leaves the middle of what follows at zero.
fn dumps(path: &[Vector3<f64>], limit: f64) -> Option<usize> {
    let (mut count, mut from, mut start) = (0, 0, Vector3::zeros());
    let (mut low, mut high) = (Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN));
    let mut last = Vector3::zeros();
    for to in 0..path.len() {
        let here = path[to] - start;
        (low, high) = (low.inf(&here), high.sup(&here));
        let middle = if count == 0 { Vector3::zeros() } else { (low + high) * 0.5 };
        let begins = if count == 0 { true } else { middle.norm() <= limit };
        let is_kept = begins && path[from..=to].iter().all(|it| (it - start - middle).norm() <= limit);
        if !is_kept {
            if to == from {
                return None;
            }
            (count, from, start) = (count + 1, to, last);
            let here = path[to] - start;
            (low, high) = (here.inf(&Vector3::zeros()), here.sup(&Vector3::zeros()));
        }
        last = path[to];
    }
    Some(count)
}

/// The fewest dumps of all plans of the grid, and the fewest changes of the arrays of those without a dump.
fn fewest(days: &[Vec<[Vector3<f64>; CELLS]>; DAYS], choices: &[Controls], limit: f64) -> (usize, usize) {
    let count = choices.len();
    let (mut fewest_dumps, mut fewest_changes) = (usize::MAX, usize::MAX);
    for number in 0..count.pow(DAYS as u32) {
        let of: [usize; DAYS] = std::array::from_fn(|day| number / count.pow(day as u32) % count);
        let mut at = Vector3::zeros();
        let mut path = Vec::with_capacity(DAYS * CELLS);
        for (day, choice) in of.iter().enumerate() {
            path.extend(days[day][*choice].iter().map(|it| at + it));
            at += days[day][*choice][CELLS - 1];
        }
        let Some(dumps) = dumps(&path, limit) else { continue };
        fewest_dumps = fewest_dumps.min(dumps);
        if dumps == 0 {
            let moves = of.windows(2).filter(|pair| {
                choices[pair[0]].get(Control::Windmill) != choices[pair[1]].get(Control::Windmill)
            });
            fewest_changes = fewest_changes.min(moves.count());
        }
    }
    (fewest_dumps, fewest_changes)
}

#[test]
fn no_plan_of_a_grid_has_fewer_dumps_or_changes_than_at_least() {
    let sunlit = sunlit([0.002, 0.004, -0.003]);
    let choices = choices();
    let mut decided = 0;
    for drifts in DRIFTS {
        let mut simulated = simulated(&sunlit, DAYS as u32, 0.4);
        for row in &mut simulated.rows {
            let of = |time_s: f64| Vector3::from(drifts[((time_s / DAY_S) as usize).min(DAYS - 1)]);
            row.other_torque_n_m = (of(row.time_s - 1.0) + of(row.time_s + 1.0)) * (0.5 / DAY_S);
        }
        let days: [Vec<_>; DAYS] = std::array::from_fn(|of| {
            choices.iter().map(|it| day(&sunlit, &simulated, of, it, drifts[of])).collect()
        });
        for limit in [0.5, 0.8, 1.2, 2.0] {
            let control_bounds = ControlBounds {
                windmill_rad: WINDMILL_RAD,
                azimuth_rad: AZIMUTH_RAD,
                alternate: 0.5,
                ..ControlBounds::default()
            };
            let task = PlanTask { dumps: DAYS, ..task(limit, control_bounds) };
            let mut flies = Integrated {
                sunlit: sunlit.clone(),
                simulated: simulated.clone(),
                more_n_m: Vector3::zeros(),
                echo: 0.0,
                flights: 0,
            };
            let found = solved(&task, &sunlit, &simulated, &mut flies);
            let (dumps, changes) = fewest(&days, &choices, limit);
            println!(
                "limit {limit}: dumps {} at least {}, grid {dumps}; changes {} at least {}, grid {changes}",
                found.dumps.len(),
                found.dumps_at_least,
                found.changes,
                found.changes_at_least
            );
            assert!(found.dumps_at_least <= dumps.min(found.dumps.len()));
            if found.dumps.is_empty() {
                assert!(found.changes_at_least <= changes.min(found.changes));
            }
            decided += usize::from(found.dumps_at_least > 0);
        }
    }
    assert!(decided > 0);
}
