//! Results of a plan, as `plan.json` and `windows.csv`.

use physics::constants::DAY_S;
use serde::Serialize;
use serde_json::{Value, json};

use super::{
    baseline::NoOffset,
    controls::{ARRAYS, Control, PLACE},
    plan::{MomentumPlan, PlanTask, greatest_n_m_s},
    simulated::SAME_S,
    windows::Window,
};
use crate::text_table::csv;

/// An event of the mission or of the plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanEvent {
    /// Time in s of the flight.
    pub at_s: f64,
    /// dump, maneuver, centerOfMass.
    pub kinds: Vec<&'static str>,
    /// Whether the plan put it there.
    pub planned: bool,
}

/// Change by removing a planned command or adding an activity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Price {
    /// Name of the command or activity.
    pub name: String,
    /// Removed from the plan, or added to it.
    #[serde(skip)]
    pub removed: bool,
    /// Time in s of the flight.
    pub start_s: f64,
    /// Time in s of the flight.
    pub stop_s: f64,
    /// Momentum that its span gathers more, the rest being as planned, EME2000, in N m s.
    pub gathered_n_m_s: [f64; 3],
    /// By how much the least greatest |H| that any choice of controls attains from its beginning on rises, in N m s; negative: falls.
    pub momentum_n_m_s: f64,
    /// Dumps more.
    pub dumps: i64,
}

/// The name of a plan's state: found, proved not to exist on the baseline, or neither.
pub fn status(plan: &MomentumPlan, task: &PlanTask) -> &'static str {
    match plan.holds && plan.dumps.len() <= task.dumps {
        true => "planned",
        false if plan.dumps_at_least > task.dumps => "infeasible",
        false => "notFound",
    }
}

/// Scope of each number that is no count of the plan.
fn scopes() -> Value {
    let bound = "no plan on this baseline has fewer, by the linear model and the most that it departs by";
    json!({
        "dumpsAtLeast": bound,
        "changesAtLeast": format!("{bound}; with these dumps where it has any"),
        "firstDay": "no bound: the search found no controls that keep the limit longer; others may",
    })
}

/// Binding limits of a plan, as JSON: which, when, by how much it is exceeded.
fn binding(plan: &MomentumPlan) -> Value {
    let start_s = plan.rows.first().map_or(0.0, |row| row.time_s);
    if let Some(exceeded) = &plan.exceeded {
        return json!({
            "limit": "momentum",
            "excess_n_m_s": exceeded.excess_n_m_s,
            "firstDay": (exceeded.first_s - start_s) / DAY_S,
            "at_s": exceeded.first_s,
        });
    }
    let left = |row: &super::plan::PlannedRow| row.allowed_n_m_s - row.simulated_n_m_s;
    let least = plan.rows.iter().min_by(|a, b| left(a).total_cmp(&left(b)));
    least.map_or(Value::Null, |row| {
        json!({ "limit": "momentum", "excess_n_m_s": -left(row), "at_s": row.time_s, "day": (row.time_s - start_s) / DAY_S })
    })
}

/// The 50th, 90th and 99th percentile.
pub fn percentiles(mut values: Vec<f64>) -> [f64; 3] {
    tables::percentiles(&mut values, [50.0, 90.0, 99.0])
}

/// Percentiles by their names.
pub(crate) fn by_percent([half, most, nearly_all]: [f64; 3]) -> Value {
    json!({ "50": half, "90": most, "99": nearly_all })
}

/// Percentiles of the greatest |H| (N m s) and of the dumps of flights.
pub fn of_seeds(flights: &[(f64, u32)]) -> [[f64; 3]; 2] {
    let momentum = flights.iter().map(|(momentum, _)| *momentum).collect();
    [percentiles(momentum), percentiles(flights.iter().map(|(_, dumps)| f64::from(*dumps)).collect())]
}

/// `plan.json`; `seeds` are greatest |H| and dumps of flights with other seeds, `more` are members of a flyby.
///
/// # Errors
/// What JSON does not take.
pub fn json(
    plan: &MomentumPlan,
    task: &PlanTask,
    events: &[PlanEvent],
    (prices, seeds): (&[Price], &[(f64, u32)]),
    more: Option<Value>,
) -> Result<String, serde_json::Error> {
    let [planned, simulated] = plan.greatest_n_m_s();
    let priced =
        |removed: bool| -> Vec<&Price> { prices.iter().filter(|price| price.removed == removed).collect() };
    let [momentum, dumps] = of_seeds(seeds);
    let percentiles = (!seeds.is_empty()).then(|| {
        json!({ "seeds": seeds.len(), "momentum_n_m_s": by_percent(momentum), "dumps": by_percent(dumps) })
    });
    let mut all = json!({
        "status": status(plan, task),
        "limit_n_m_s": task.limit.momentum_n_m_s,
        "dumps": plan.dumps.len(),
        "dumpsAtLeast": plan.dumps_at_least,
        "changes": plan.changes,
        "changesAtLeast": plan.changes_at_least,
        "scopes": scopes(),
        "asTheMissionIs": plan.is_mission,
        "largestMomentum": { "planned": planned, "simulated": simulated },
        "largestDifference_n_m_s": plan.difference_n_m_s(),
        "binding": binding(plan),
        "rounds": plan.rounds,
        "events": events,
        "planned": priced(true),
        "activities": priced(false),
        "percentiles": percentiles,
    });
    if let (Value::Object(all), Some(Value::Object(more))) = (&mut all, more) {
        all.extend(more);
    }
    serde_json::to_string_pretty(&all)
}

/// `plan.json` of a flyby for which no controls that lead to its aimpoint were found; `all` are its members.
///
/// # Errors
/// What JSON does not take.
pub fn without_plan_json(status: &str, mut all: Value) -> Result<String, serde_json::Error> {
    all["status"] = json!(status);
    serde_json::to_string_pretty(&all)
}

/// `plan.json` where the corridor is empty.
///
/// # Errors
/// What JSON does not take.
pub fn corridor_json(none: &NoOffset, start_s: f64) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(&json!({
        "status": "infeasible",
        "dumps": 0,
        "changes": 0,
        "binding": {
            "limit": "corridor",
            "suns": none.suns,
            "distance_au": none.distance_au,
            "firstDay": (none.at_s - start_s) / DAY_S,
            "at_s": none.at_s,
        },
        "rounds": 0,
        "events": [],
    }))
}

/// Greatest |H| in a window as planned and as simulated, in N m s.
pub fn greatest_in(plan: &MomentumPlan, window: &Window) -> [f64; 2] {
    let inside = window.start_s - SAME_S..=window.stop_s + SAME_S;
    greatest_n_m_s(plan.rows.iter().filter(|row| inside.contains(&row.time_s)))
}

/// `windows.csv`; `shown_deg` gives an angle in rad as it is simulated.
pub fn windows_csv(plan: &MomentumPlan, shown_deg: &dyn Fn(f64) -> f64) -> String {
    let row = |window: &Window| {
        let angles = [window.controls.each(ARRAYS), window.controls.each(PLACE), window.sun_place_rad(true)];
        let [arrays, place, own] = angles.map(|rad| rad.map(|rad| shown_deg(rad).to_string()));
        let share = format!("{:.6}", window.controls.get(Control::Alternate));
        let greatest = greatest_in(plan, window).map(|momentum| format!("{momentum:.6}"));
        let span = [window.start_s, window.stop_s].map(|time_s| time_s.to_string());
        let cells = [&span[..], &[window.kind.name().to_owned()], &arrays, &place, &[share], &own, &greatest];
        cells.concat()
    };
    let header = "start_s,stop_s,status,offset_deg,windmill_deg,azimuth_deg,elevation_deg,alternate_share,\
                  alternate_azimuth_deg,alternate_elevation_deg,momentum_planned_n_m_s,momentum_simulated_n_m_s";
    csv(header, plan.windows.iter().map(row))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_of_seeds_lie_between_neighbours() {
        let flights: Vec<(f64, u32)> = (1..=200).rev().map(|k| (f64::from(k), k / 100)).collect();
        let [momentum, dumps] = of_seeds(&flights);
        // NumPy's percentile of 1 to 200.
        for (found, expected) in momentum.into_iter().zip([100.5, 180.1, 198.01]) {
            approx::assert_relative_eq!(found, expected, max_relative = 1e-14);
        }
        assert_eq!(dumps, [1.0; 3]);
        assert_eq!(percentiles(vec![2.0]), [2.0; 3]);
    }
}
