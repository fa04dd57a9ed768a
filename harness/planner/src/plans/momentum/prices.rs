//! Prices: what removing each planned command, or adding an activity, changes in momentum and dumps.

use inputs::plan::PlanFile;
use nalgebra::Vector3;

use super::{planned::Planned, prepared::span_s};
use crate::{
    Failure,
    momentum::{
        attainable::{downlink_momentum_n_m_s, fewest_dumps, least_excess_n_m_s},
        plan::{MomentumPlan, PlanTask},
        report::Price,
        simulated::SimulatedFlight,
        windows::{BusySpan, Window, WindowKind},
    },
};

/// All of them.
pub(super) fn all(
    file: &PlanFile,
    planned: &Planned<'_>,
    found: &MomentumPlan,
) -> Result<Vec<Price>, Failure> {
    let task = &planned.task;
    let has_planned = task.layout.occupied.iter().any(|it| it.planned);
    if !has_planned && file.activities.is_empty() {
        return Ok(Vec::new());
    }
    planned.progress.say("prices");
    let (sunlit, simulated) = (&planned.sunlit, &planned.simulated);
    let of = |task: &PlanTask, simulated: &SimulatedFlight, from_s: f64| -> Result<(f64, i64), Failure> {
        let excess = least_excess_n_m_s(task, sunlit, simulated, from_s)?;
        let dumps = fewest_dumps(task, sunlit, simulated)?;
        Ok((excess, dumps.map_or(-1, |count| count as i64)))
    };
    let price = |name: String,
                 [start_s, stop_s]: [f64; 2],
                 gathered: Vector3<f64>,
                 other: (&PlanTask, &SimulatedFlight)| {
        let [without, changed] = [of(task, simulated, start_s)?, of(other.0, other.1, start_s)?];
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
        let price = price(name, span_s, default - found.flight.gained_n_m_s(span_s), (&other, simulated))?;
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
        let with = planned.simulated.with_part_of(&flight, span_s);
        let mut other = task.clone();
        let busy = BusySpan { start_s: from_s, stop_s: to_s, planned: false, command: usize::MAX };
        other.layout.occupied.push(busy);
        other.layout.occupied.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
        let gathered = flight.gained_n_m_s(span_s) - found.flight.gained_n_m_s(span_s);
        prices.push(price(activity.name.clone(), span_s, gathered, (&other, &with))?);
    }
    Ok(prices)
}
