//! Tables 7 and 8: extremes around the orbit beside the paper's.

use super::orbit::{EFFECTS, Sample};
use super::paper::Row;
use crate::report::{Outcome, Run};
use drawing::{BarChart, BarPanel};

/// One row of the paper, simulated.
pub(super) struct Simulated {
    pub(super) row: Row,
    pub(super) samples: Vec<Sample>,
    /// By the planet's cells, where requested.
    pub(super) by_cells: Option<Vec<Sample>>,
}

/// How far the greatest of solar, albedo, infrared and recoil may be off the printed one, relative to it.
pub(super) type Tolerances = [f64; 4];

/// Greatest and least of an effect; solar and recoil are taken in the light only.
fn extremes(samples: &[Sample], effect: usize) -> (f64, f64) {
    let in_light_only = effect == 0 || effect == 3;
    samples
        .iter()
        .filter(|sample| sample.lit || !in_light_only)
        .map(|sample| sample.effects[effect])
        .fold((0.0, f64::INFINITY), |(greatest, least): (f64, f64), a| (greatest.max(a), least.min(a)))
}

/// Solar in 1e-7 m/s2, the others in % of the greatest solar; greatest and least.
fn as_printed(samples: &[Sample]) -> [(f64, f64); 4] {
    let solar_m_s2 = extremes(samples, 0).0;
    [0, 1, 2, 3].map(|effect| {
        let (greatest, least) = extremes(samples, effect);
        let unit = if effect == 0 { 1e-7 } else { solar_m_s2 / 100.0 };
        (greatest / unit, least / unit)
    })
}

/// Prints and draws the table `name`.
pub(super) fn print(
    run: &mut Run<'_>,
    name: &str,
    simulated: &[Simulated],
    tolerances: &Tolerances,
) -> Outcome {
    let header = "\
        case | effect | paper | ours | difference of the greatest | difference of the least | verdict | \
        by cells | difference";
    let mut rows = Vec::new();
    for Simulated { row, samples, by_cells } in simulated {
        let ours = as_printed(samples);
        let cells = by_cells.as_deref().map(as_printed);
        for effect in 0..EFFECTS.len() {
            let paper = row.extremes[effect];
            let digits = if effect == 0 { 3 } else { 2 };
            let pair = |(greatest, least): (f64, f64)| format!("{greatest:.digits$} / {least:.digits$}");
            let off = |found: [(f64, f64); 4]| found[effect].0 / paper.0 - 1.0;
            let unit = if effect == 0 { "1e-7 m/s2" } else { "%" };
            rows.push(vec![
                row.case.to_string(),
                format!("{} [{unit}]", EFFECTS[effect]),
                paper.1.map_or(format!("{:.2}", paper.0), |least| format!("{:.2} / {least:.2}", paper.0)),
                pair(ours[effect]),
                percent(off(ours)),
                paper.1.map_or("-".to_owned(), |least| format!("{:+.2} points", ours[effect].1 - least)),
                verdict(off(ours), tolerances[effect]),
                cells.map_or("-".to_owned(), |cells| pair(cells[effect])),
                cells.map_or("-".to_owned(), |cells| percent(off(cells))),
            ]);
        }
    }
    run.table_and_csv(&format!("{name}.csv"), header, rows)?;
    run.picture(&format!("{name}.svg"), &chart(simulated))
}

/// The greatest of each effect by case: the paper's beside ours.
fn chart(simulated: &[Simulated]) -> BarChart {
    let has_cells = simulated.iter().any(|it| it.by_cells.is_some());
    let panel = |effect: usize| {
        let greatest = |samples: &[Sample]| as_printed(samples)[effect].0;
        let by_cells = |it: &Simulated| it.by_cells.as_deref().map_or(f64::NAN, greatest);
        let mut values: Vec<Vec<f64>> = vec![
            simulated.iter().map(|it| it.row.extremes[effect].0).collect(),
            simulated.iter().map(|it| greatest(&it.samples)).collect(),
        ];
        if has_cells {
            values.push(simulated.iter().map(by_cells).collect());
        }
        let unit = if effect == 0 { "1e-7 m/s2" } else { "% of solar" };
        BarPanel { y_label: format!("{} [{unit}]", EFFECTS[effect]), values }
    };
    let bars = ["paper", "ours", "ours, planet by cells"];
    BarChart {
        title: "Greatest acceleration around one orbit".to_owned(),
        cases: simulated
            .iter()
            .map(|it| format!("case {}: true anomaly {} deg", it.row.case, it.row.true_anomaly_deg))
            .collect(),
        bars: bars.into_iter().take(if has_cells { 3 } else { 2 }).map(str::to_owned).collect(),
        panels: (0..EFFECTS.len()).map(panel).collect(),
    }
}

fn percent(off: f64) -> String {
    format!("{:+.1} %", off * 100.0)
}

fn verdict(off: f64, tolerance: f64) -> String {
    if off.abs() <= tolerance {
        format!("within {} %", tolerance * 100.0)
    } else {
        format!("off by more than {} %", tolerance * 100.0)
    }
}
