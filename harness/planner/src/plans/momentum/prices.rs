//! Prices: what removing each planned command, or adding an activity, changes in momentum and dumps.

use nalgebra::Vector3;

use super::{planned::Planned, prepared::span_s};
use crate::{
    Failure,
    momentum::{
        attainable::{downlink_momentum_n_m_s, fewest_dumps, least_excess_n_m_s},
        plan::{MomentumPlan, PlanProblem},
        report::Price,
        windows::{BusySpan, Window, WindowKind},
    },
};

/// All of them.
pub(super) fn all(planned: &Planned<'_>, found: &MomentumPlan) -> Result<Vec<Price>, Failure> {
    let (file, problem) = (&planned.file, planned.problem());
    let PlanProblem { task, sunlit, simulated } = problem;
    let has_planned = task.layout.occupied.iter().any(|it| it.planned);
    if !has_planned && file.activities.is_empty() {
        return Ok(Vec::new());
    }
    planned.progress.say("prices");
    let of = |problem: &PlanProblem<'_>, from_s: f64| -> Result<(f64, i64), Failure> {
        let excess = least_excess_n_m_s(problem, from_s)?;
        Ok((excess, fewest_dumps(problem)?.map_or(-1, |count| count as i64)))
    };
    let price =
        |name: String, [start_s, stop_s]: [f64; 2], gathered: Vector3<f64>, other: PlanProblem<'_>| {
            let [without, changed] = [of(&problem, start_s)?, of(&other, start_s)?];
            Ok::<_, Failure>(Price {
                name,
                removed: false,
                start_s,
                stop_s,
                gathered_n_m_s: gathered.into(),
                momentum_n_m_s: changed.0 - without.0,
                dumps: changed.1 - without.1,
            })
        };
    let mut prices = Vec::new();
    for removed in task.layout.occupied.iter().filter(|it| it.planned) {
        let mut other = task.clone();
        other.layout.occupied.retain(|it| it != removed);
        let span_s =
            [removed.start_s.max(planned.mission.start_s), removed.stop_s.min(planned.mission.stop_s)];
        let default = downlink_momentum_n_m_s(sunlit, simulated, &found.windows, span_s);
        let name = format!("planned command {}", removed.command + 1);
        let gathered = default - found.flight.gained_n_m_s(span_s);
        let price = price(name, span_s, gathered, PlanProblem { task: &other, ..problem })?;
        prices.push(Price { removed: true, ..price });
    }
    for at in &file.activities {
        let activity = &at.it;
        let span_s @ [from_s, to_s] = span_s(file, at, &planned.mission)?;
        let touches = |window: &&Window| window.start_s < to_s && window.stop_s > from_s;
        if found.windows.iter().filter(touches).any(|window| window.kind != WindowKind::Free) {
            let what = "found a time that the mission holds fixed, allowed: free time behind `freeze`";
            return Err(file.problem(at, what).into());
        }
        let flight = planned
            .simulate_plan(&found.windows, &found.dumps, Some((activity, span_s)))
            .map_err(|error| file.problem(at, &error.to_string()))?;
        let with = simulated.with_part_of(&flight, span_s);
        let mut other = task.clone();
        let busy = BusySpan { start_s: from_s, stop_s: to_s, planned: false, command: usize::MAX };
        other.layout.occupied.push(busy);
        other.layout.occupied.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
        let gathered = flight.gained_n_m_s(span_s) - found.flight.gained_n_m_s(span_s);
        let other = PlanProblem { task: &other, simulated: &with, ..problem };
        prices.push(price(activity.name.clone(), span_s, gathered, other)?);
    }
    Ok(prices)
}
