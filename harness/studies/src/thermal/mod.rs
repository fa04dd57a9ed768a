//! Paper 004: solar, albedo, infrared and recoil accelerations of MESSENGER around Mercury.
//!
//! Tables 7 and 8, Figures 12 and 13.

mod orbit;
mod paper;
mod table;
mod year;

use crate::StudyError;
use crate::cells::scientific;
use crate::report::{Outcome, Run};
use crate::verdict::{agrees, compared};
use drawing::{Chart, Panel, Series};

use orbit::{Case, EFFECTS, Fmus, Planet, Sample};
use paper::{Row, TABLE_7, TABLE_8};
use table::Simulated;
pub(crate) use year::figure13;

/// "One revolution of the orbiter (i.e. 12 hours)", from periapsis, in s.
const DURATION_S: f64 = 43_200.0;

/// Belts of the planet's cells: odd, which the paper's infrared betrays; their number it does not print.
const BELTS: i32 = 45;

/// Time between samples around one orbit, in s.
const STEP_S: f64 = 15.0;

/// Table 7: one orbit with the planet standing still.
pub(crate) fn table7(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_rows(run, &TABLE_7, Planet::Still, Some(BELTS))?;
    run.line("One orbit, planet standing still, cylindrical shadow (paper 004, Table 7, \"analytical\")\n");
    table::print(run, "table7", &simulated, &[0.0015, 0.02, 0.05, 0.03])?;
    run.line(REMARK);
    run.line(
        "Recoil of cases 2 to 4: the plates' emissivities are not printed, and with emissivity equal to absorptivity no\n\
         conduction gives the printed pairs.",
    );
    Ok(())
}

/// Table 8: one orbit with the planet moving.
pub(crate) fn table8(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_rows(run, &TABLE_8, Planet::Moving, Some(BELTS))?;
    run.line("One orbit, planet moving, no light in the penumbra (paper 004, Table 8, \"numerical\")\n");
    table::print(run, "table8", &simulated, &[0.0015, 0.02, 0.08, 0.03])?;
    run.line(REMARK);
    run.line(
        "Infrared and albedo of cases 1 and 2 cannot be had from the printed geometry by any scan tried: from Table 7 to\n\
         Table 8 the paper halves the infrared of case 1 and nearly doubles that of case 2, while the planet turns by 2 to 3 deg.\n\
         Recoil is printed lower than in Table 7 though nothing about the panels changes.",
    );
    Ok(())
}

/// Figure 12: the accelerations around one orbit.
pub(crate) fn figure12(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_rows(run, &TABLE_8, Planet::Moving, None)?;
    let chart = Chart::new("Accelerations around one orbit", "time [h]").with(simulated.iter().map(
        |Simulated { row, samples, .. }| {
            Panel::new("a [1e-7 m/s2]")
                .with((0..4).map(|k| series(k, &format!(", case {}", row.case), samples)))
        },
    ));
    run.line("Solar, albedo, infrared and recoil around one orbit (paper 004, Figure 12)\n");
    let rows: Vec<Vec<String>> = simulated
        .iter()
        .map(|Simulated { row, samples, .. }| {
            let lit: Vec<&Sample> = samples.iter().filter(|sample| sample.lit).collect();
            let share = |sample: &&Sample| sample.effects[1..].iter().sum::<f64>() / sample.effects[0];
            let mean = lit.iter().map(share).sum::<f64>() / lit.len().max(1) as f64;
            let verdict = agrees((0.195..=0.305).contains(&mean));
            compared(&format!("{} | 20-30 %", row.case), format!("{:.1} %", mean * 100.0), verdict)
        })
        .collect();
    run.table("case | paper: mean sum of thermal effects | ours | verdict", &rows);
    run.picture("figure12.svg", &chart)?;
    let header = "case | time_s | solar_m_s2 | albedo_m_s2 | infrared_m_s2 | thermal_m_s2";
    let rows = simulated.iter().flat_map(|Simulated { row, samples, .. }| {
        samples.iter().step_by(4).map(|sample| {
            [vec![row.case.to_string(), format!("{}", sample.time_s)], scientific(sample.effects)].concat()
        })
    });
    run.csv("figure12.csv", header, rows)
}

const REMARK: &str = "\
Greatest / least around the orbit, the verdict on the greatest. Albedo, infrared and recoil in % of the greatest solar
acceleration, the least solar and recoil without eclipses. Not printed in the paper, chosen because they fit, once for
all cases: 1365 W/m2 at 1 AU, planet absorptivity 0.88, diffuse reflectivity 0.12, emissivity 0.9, night side 100 K,
700 kg, panel conductance 18 W/m2/K with a radiative exchange of 0.11. Ours is the limit of many planet cells. By
cells: the paper's way to sum, here on 45 belts of 90; an odd number has a meridian of cells right on the terminator,
and these count as lit.";

fn series(effect: usize, suffix: &str, samples: &[Sample]) -> Series {
    let point = |sample: &Sample| (sample.time_s / 3600.0, sample.effects[effect] * 1e7);
    Series::line(format!("{}{suffix}", EFFECTS[effect]), samples.iter().map(point).collect())
}

/// Runs the rows that the options leave, on all cores.
fn simulate_rows(
    run: &Run<'_>,
    rows: &[Row],
    planet: Planet,
    belts: Option<i32>,
) -> Result<Vec<Simulated>, StudyError> {
    let rows = run.chosen(rows.iter().copied(), |row| format!("case {}", row.case))?;
    let fmus = Fmus::open(run.options)?;
    run.all(&rows, |row| {
        let true_anomaly_deg = row.true_anomaly_deg;
        let simulate = |belts| {
            fmus.simulate(&Case { true_anomaly_deg, planet, duration_s: DURATION_S, step_s: STEP_S, belts })
        };
        let by_cells = belts.map(|belts| simulate(Some(belts))).transpose()?;
        Ok(Simulated { row: *row, samples: simulate(None)?, by_cells })
    })
}
