//! Prices: what removing each planned command, or adding an activity, changes in momentum and dumps.

use inputs::{
    plan::{PlanFile, keys::Activity},
    reading::At,
};
use nalgebra::Vector3;

use super::{
    super::flights::{OUTSIDE, SimulatedMission},
    planned::Planned,
};
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

/// When an activity begins and ends, in s of the mission.
pub(super) fn span_s(
    file: &PlanFile,
    at: &At<Activity>,
    mission: &SimulatedMission,
) -> Result<[f64; 2], String> {
    let [from_s, to_s] = [at.it.start, at.it.stop].map(|instant| mission.time_in_file_s(file, at, instant));
    let (from_s, to_s) = (from_s?, to_s?);
    if from_s < mission.start_s || to_s > mission.stop_s {
        return Err(file.problem(at, OUTSIDE));
    }
    Ok([from_s, to_s])
}

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
    planned.say("prices");
    let (sunlit, simulated) = (&planned.sunlit, &planned.simulated);
    let of = |task: &PlanTask, simulated: &SimulatedFlight, from_s: f64| -> Result<(f64, i64), Failure> {
        let excess =
            least_excess_n_m_s(task, sunlit, simulated, from_s).map_err(|error| error.to_string())?;
        let dumps = fewest_dumps(task, sunlit, simulated).map_err(|error| error.to_string())?;
        Ok((excess, dumps.map_or(-1, |count| count as i64)))
    };
    let mut prices = Vec::new();
    for removed in task.layout.occupied.iter().filter(|it| it.planned) {
        let mut other = task.clone();
        other.layout.occupied.retain(|it| it != removed);
        let span_s =
            [removed.start_s.max(planned.mission.start_s), removed.stop_s.min(planned.mission.stop_s)];
        let [without, changed] = [of(task, simulated, span_s[0])?, of(&other, simulated, span_s[0])?];
        let default = downlink_momentum_n_m_s(sunlit, simulated, &found.windows, span_s);
        let flight = found.flight.momentum_n_m_s(span_s[1]) - found.flight.momentum_n_m_s(span_s[0]);
        prices.push(Price {
            name: format!("planned command {}", removed.command + 1),
            removed: true,
            span_s,
            gathered_n_m_s: (default - flight).into(),
            momentum_n_m_s: changed.0 - without.0,
            dumps: changed.1 - without.1,
        });
    }
    for at in &file.activities {
        let activity = &at.it;
        let [from_s, to_s] = span_s(file, at, &planned.mission)?;
        let touches = |window: &&Window| window.start_s < to_s && window.stop_s > from_s;
        if found.windows.iter().filter(touches).any(|window| window.kind != WindowKind::Free) {
            let what = "found a time that the mission holds fixed, allowed: free time behind `freeze`";
            return Err(file.problem(at, what).into());
        }
        let flight = planned
            .simulate_plan(&found.windows, &found.dumps, Some((activity, [from_s, to_s])))
            .map_err(|error| file.problem(at, &error.to_string()))?;
        let gathered = |flight: &SimulatedFlight| -> Vector3<f64> {
            flight.momentum_n_m_s(to_s) - flight.momentum_n_m_s(from_s)
        };
        let with = planned.simulated.with_part_of(&flight, [from_s, to_s]);
        let mut other = task.clone();
        other.layout.occupied.push(BusySpan {
            start_s: from_s,
            stop_s: to_s,
            planned: false,
            command: usize::MAX,
        });
        other.layout.occupied.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
        let [without, changed] = [of(task, simulated, from_s)?, of(&other, &with, from_s)?];
        prices.push(Price {
            name: activity.name.clone(),
            removed: false,
            span_s: [from_s, to_s],
            gathered_n_m_s: (gathered(&flight) - gathered(&found.flight)).into(),
            momentum_n_m_s: changed.0 - without.0,
            dumps: changed.1 - without.1,
        });
    }
    Ok(prices)
}
