//! Summary of a plan on the screen.

use nalgebra::Vector3;
use physics::constants::DAY_S;

use super::planned::Planned;
use crate::momentum::{
    plan::MomentumPlan,
    report::{self, Price},
    windows::WindowKind,
};

/// All of it, a line each; `seeds` are greatest |H| and dumps of flights with other seeds.
pub(super) fn text(
    planned: &Planned<'_>,
    found: &MomentumPlan,
    (prices, seeds): (&[Price], &[(f64, u32)]),
) -> String {
    let size = planned.task.limit.size;
    let mut lines = momentum(planned, found);
    if !found.holds {
        lines.push(
            "no plan was found that holds: the best flight exceeds the limit, or misses its aim".to_owned(),
        );
    }
    if found.is_mission {
        lines.push("the plan is the mission as it is: no better one was found".to_owned());
    }
    let gap = match (found.changes - found.changes_at_least, found.changes_at_least) {
        (0, _) => "no plan has fewer on this baseline".to_owned(),
        (_, 0) => "fewer are not excluded".to_owned(),
        (_, least) => format!("no plan has fewer than {least} on this baseline"),
    };
    let free = found.windows.iter().filter(|window| window.kind == WindowKind::Free);
    lines.push(match planned.mission.is_in_orbit() {
        true => format!("places of the Sun in {} downlinks", free.count()),
        false => format!(
            "{} steps of the baseline, {} changes of the arrays; {gap}",
            found.baseline.len(),
            found.changes
        ),
    });
    lines.extend(prices.iter().map(|price| {
        format!(
            "{} {}: {:.3} N.m.s gathered more, {:+.3} N.m.s at the limit, {:+} dumps",
            if price.removed { "without" } else { "with" },
            price.name,
            Vector3::from(price.gathered_n_m_s).norm(),
            price.momentum_n_m_s,
            price.dumps,
        )
    }));
    if !seeds.is_empty() {
        let [momentum, dumps] = report::of_seeds(seeds).map(|of| of.map(terminal::short).join(", "));
        let count = seeds.len();
        lines.push(format!("{count} seeds: {size} {momentum} N.m.s, dumps {dumps} (50, 90, 99 %)"));
    }
    lines.push(format!("{:.1} s", planned.progress.elapsed_s()));
    lines.join("\n")
}

/// Momentum as the mission is, planned and simulated, and the dumps.
fn momentum(planned: &Planned<'_>, found: &MomentumPlan) -> Vec<String> {
    let day = |time_s: f64| (time_s - planned.mission.start_s) / DAY_S;
    let [most_planned, most_simulated] = found.greatest_n_m_s();
    let (limit, size) = (planned.task.limit.momentum_n_m_s, planned.task.limit.size);
    let mut lines = vec![
        format!("{size} as the mission is: {:.3} N.m.s", planned.simulated.greatest(size).0),
        format!(
            "{size} planned {most_planned:.3}, simulated {most_simulated:.3}, limit {limit:.3} N.m.s; flight and plan differ by {:.4} at most, \
             {:.2} % of the limit, after {} flight{}",
            found.difference_n_m_s(),
            100.0 * found.difference_n_m_s() / limit,
            found.rounds,
            if found.rounds == 1 { "" } else { "s" },
        ),
    ];
    let Some(exceeded) = &found.exceeded else {
        lines.push("dumps: 0".to_owned());
        return lines;
    };
    let bound = match found.dumps_at_least {
        0 => "no plan without a dump was found".to_owned(),
        count => format!("no plan holds without a dump: {count} at least on this baseline"),
    };
    lines.push(format!(
        "{bound}; the limit is exceeded by {:.3} N.m.s at the least that was found, first on day {:.1}; {} may be ([momentum] dumps)",
        exceeded.excess_n_m_s,
        day(exceeded.first_s),
        planned.task.dumps,
    ));
    let days: Vec<String> = found.dumps.iter().map(|dump| format!("{:.2}", day(dump.at_s))).collect();
    lines.push(format!("dumps on days {}", days.join(", ")));
    lines
}
