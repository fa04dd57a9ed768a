//! Counts against closed forms and against all choices.

use nalgebra::Vector3;

use super::*;
use crate::momentum::{
    simulated::SimulatedFlight,
    test_spacecraft::{DAY_S, simulated, sunlit, task},
    torque::SunlitSpacecraft,
    windows::ControlBounds,
};

fn model<'a>(
    control_bounds: ControlBounds,
    limit: f64,
    (sunlit, simulated): (&'a SunlitSpacecraft, SimulatedFlight),
) -> Model<'a> {
    let task = task(limit, control_bounds);
    let (windows, _) = task.layout.windows(sunlit, &simulated).unwrap();
    Model::new(sunlit, simulated, windows, task.limit)
}

/// A torque along one direction through T t: the first dump after L, the others after 2 L each.
#[test]
fn dumps_of_a_constant_torque_are_counted_in_closed_form() {
    let per_day = 1.0;
    for (limit, days) in [(1.02, 12), (2.1, 12), (5.0, 12), (20.0, 12)] {
        let sunlit = sunlit([0.0; 3]);
        let mut simulated = simulated(&sunlit, days, 3000.0);
        for row in &mut simulated.rows {
            row.other_torque_n_m = Vector3::x() * (per_day / DAY_S);
        }
        let model = model(ControlBounds::default(), limit, (&sunlit, simulated));
        let expected = ((per_day * f64::from(days) - limit) / (2.0 * limit)).ceil().max(0.0) as usize;
        let found = fewest_dumps(&model, 0.0, &mut || {}).unwrap();
        assert_eq!(found.at_least, expected, "{limit}");
        assert_eq!(found.rows.len(), expected);
        let first = first_exceeded_s(&model);
        assert_eq!(first.is_some(), expected > 0);
        if let Some(first_s) = first {
            let at_d = limit / per_day;
            // Instants are a sixth of a day apart.
            assert!((first_s / DAY_S - at_d).abs() <= 1.0 / 6.0 + 1e-9, "{first_s}");
        }
    }
}

/// A torque that turns round needs windmill angles that do; the fewest changes are those of all choices.
#[test]
fn changes_are_the_fewest_of_all_choices() {
    let control_bounds = ControlBounds { windmill_rad: 0.05, ..ControlBounds::default() };
    for (pattern, limit) in [
        ([1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0], 0.6),
        ([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0], 0.6),
        ([1.0, 1.0, 1.0, -1.0, 0.5, 0.5, -1.0], 0.9),
        ([0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1], 0.9),
    ] {
        let sunlit = sunlit([0.0; 3]);
        let mut simulated = simulated(&sunlit, 7, 0.4);
        let sun = simulated.rows[0].to_sun_m.normalize();
        for row in &mut simulated.rows {
            let day = ((row.time_s / DAY_S) as usize).min(6);
            row.other_torque_n_m = sun * (pattern[day] / DAY_S);
        }
        let model = model(control_bounds, limit, (&sunlit, simulated));
        let until = Instant::now() + std::time::Duration::from_secs(60);
        let found = fewest_changes(&model, [0.0, WHOLE], until, &mut || {});
        let mut fewest = None;
        for places in 0_u32..1 << 6 {
            let mut leader = 0;
            let leaders: Vec<usize> = (0..7)
                .map(|window| {
                    if window > 0 && places >> (window - 1) & 1 == 1 {
                        leader = window;
                    }
                    leader
                })
                .collect();
            let part = Part { steps: [0, model.instants.len()], free: false };
            if is_kept(Formulation { model: &model, leaders: &leaders }, part, [0.0, WHOLE], 1.0) {
                let count = places.count_ones() as usize;
                fewest = Some(fewest.map_or(count, |least: usize| least.min(count)));
            }
        }
        assert_eq!(found.as_ref().map(|it| it.changes), fewest, "{pattern:?}");
        if let Some(found) = found {
            assert_eq!(found.at_least, found.changes);
        }
    }
}
