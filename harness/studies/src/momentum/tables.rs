//! Paper 000, Tables 2 to 5: how many dumps in 90 days, and how long apart.

use super::cases::{Dump, MomentumCase, Shade, Simulated, convention_label, simulate_campaigns};
use super::figures::{FIGURE_4, draw};
use super::lists;
use super::optimum::simulate_all;
use super::paper::Published;
use super::spacing::Spacing;
use super::trends::trends;
use crate::report::{Outcome, Run};

/// Tables 2 to 5 from one set of simulations.
pub(crate) fn tables(run: &mut Run<'_>) -> Outcome {
    let cases = [lists::cylinder(), lists::panels()].concat();
    let simulated = simulate_all(run, cases)?;
    let of = |shade: Shade, papers: bool| -> Vec<Simulated> {
        let is_requested =
            |it: &&Simulated| it.case.shade == shade && (!papers || lists::is_in_papers_convention(&it.case));
        simulated.iter().filter(is_requested).cloned().collect()
    };
    counts(run, "table2.csv", &of(Shade::Cylinder, false), TABLE_2)?;
    gaps(run, "table3.csv", &of(Shade::Cylinder, true), "Table 3")?;
    counts(run, "table4.csv", &of(Shade::PlatesAndPanels, false), TABLE_4)?;
    gaps(run, "table5.csv", &of(Shade::PlatesAndPanels, true), "Table 5")?;
    draw(run, &simulated, &FIGURE_4)?;
    finish(run, &simulated)
}

/// Table 2: number of dumps, cylinder.
pub(crate) fn table2(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_all(run, lists::cylinder())?;
    counts(run, "table2.csv", &simulated, TABLE_2)?;
    draw(run, &simulated, &FIGURE_4)?;
    finish(run, &simulated)
}

/// Table 3: time between dumps, cylinder.
pub(crate) fn table3(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_all(run, lists::in_papers_convention(lists::cylinder()))?;
    gaps(run, "table3.csv", &simulated, "Table 3")?;
    finish(run, &simulated)
}

/// Table 4: number of dumps, plates and panels.
pub(crate) fn table4(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_all(run, lists::panels())?;
    counts(run, "table4.csv", &simulated, TABLE_4)?;
    finish(run, &simulated)
}

/// Table 5: time between dumps, plates and panels.
pub(crate) fn table5(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_all(run, lists::in_papers_convention(lists::panels()))?;
    gaps(run, "table5.csv", &simulated, "Table 5")?;
    finish(run, &simulated)
}

/// What other targets of thruster dumps do.
pub(crate) fn dump_targets(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_all(run, lists::other_dumps())?;
    let what = "plates alone, and dumps that paper 000's tables do not have";
    counts(run, "dump-targets.csv", &simulated, what)?;
    finish(run, &simulated)
}

/// How the counts of Table 2 move with what the paper leaves open.
pub(crate) fn assumptions(run: &mut Run<'_>) -> Outcome {
    let simulated = simulate_campaigns(run, lists::open())?;
    run.line(
        "Thruster dumps in 90 days over what paper 000 leaves open: start date, orbit frame, panel tilts\n",
    );
    let rows: Vec<Vec<String>> = by_setting(&simulated)
        .map(|simulations| {
            let case = &simulations[0].case;
            let [offsets, paper, ours, verdict] = across(simulations);
            vec![
                format!("{} N.m.s", case.threshold_n_m_s),
                case.dumps_to.label(),
                case.shade.label().to_owned(),
                case.choice.label().to_owned(),
                offsets,
                paper,
                ours,
                verdict,
            ]
        })
        .collect();
    let header = "threshold | dumps to | shade | choice | Z offsets | paper | ours | verdict";
    run.table_and_csv("assumptions.csv", header, rows)?;
    run.line(ASSUMPTIONS_REMARK);
    run.csv("dumps.csv", DUMP_HEADER, simulated.iter().flat_map(dump_rows))
}

fn counts(run: &mut Run<'_>, file: &str, simulated: &[Simulated], what: &str) -> Outcome {
    if simulated.is_empty() {
        return Ok(());
    }
    run.line(&format!("Thruster dumps in 90 days ({what})\n"));
    let rows: Vec<Vec<String>> = by_setting(simulated)
        .map(|simulations| [&setting_cells(&simulations[0].case)[..], &across(simulations)].concat())
        .collect();
    let header = "threshold | dumps to | shade | momentum | strategy | offsets | paper | ours | verdict";
    run.table(header, &rows);
    run.line(&trends(simulated).text());
    let header = "\
        threshold | dumps to | shade | momentum | strategy | offset | paper | ours | verdict | paper's gaps | \
        our gaps | five days";
    run.csv(file, header, simulated.iter().map(count_row))
}

fn gaps(run: &mut Run<'_>, file: &str, simulated: &[Simulated], table: &str) -> Outcome {
    if simulated.is_empty() {
        return Ok(());
    }
    run.line(&format!("Time between thruster dumps (paper 000, {table})\n"));
    let rows: Vec<Vec<String>> = simulated.iter().map(gap_row).collect();
    let header = "\
        threshold | dumps to | shade | momentum | strategy | offset | paper | ours | verdict | \
        paper's five days | five days";
    run.table_and_csv(file, header, rows)
}

/// What was assumed, and every dump.
fn finish(run: &mut Run<'_>, simulated: &[Simulated]) -> Outcome {
    run.line(REMARK);
    run.csv("dumps.csv", DUMP_HEADER, simulated.iter().flat_map(dump_rows))
}

/// Simulations that differ in the offset alone.
fn by_setting(simulated: &[Simulated]) -> impl Iterator<Item = &[Simulated]> {
    simulated.chunk_by(|a, b| a.case.differs_only_in_offset(&b.case))
}

fn setting_cells(case: &MomentumCase) -> Vec<String> {
    vec![
        format!("{} N.m.s", case.threshold_n_m_s),
        case.dumps_to.label(),
        case.shade.label().to_owned(),
        convention_label(case.convention).to_owned(),
        case.strategy.label().to_owned(),
    ]
}

/// Offsets, the paper's counts, ours and the verdict of all together.
fn across(simulations: &[Simulated]) -> [String; 4] {
    let join =
        |cell: &dyn Fn(&Simulated) -> String| simulations.iter().map(cell).collect::<Vec<_>>().join(" / ");
    let paper = |simulation: &Simulated| Published::of(&simulation.case);
    let has_paper = simulations.iter().any(|simulation| paper(simulation).is_some());
    [
        join(&|simulation| simulation.case.offset_label()),
        if has_paper { join(&|it| paper(it).map_or("-".to_owned(), |it| it.dumps())) } else { String::new() },
        join(&|simulation| simulation.count.to_string()),
        verdict(simulations).to_owned(),
    ]
}

fn verdict(simulations: &[Simulated]) -> &'static str {
    let verdicts: Vec<&str> = simulations
        .iter()
        .filter_map(|simulation| Some(Published::of(&simulation.case)?.against(simulation.count)))
        .collect();
    ["off", "within 2", "comparable"].into_iter().find(|worst| verdicts.contains(worst)).unwrap_or("")
}

fn count_row(simulation: &Simulated) -> Vec<String> {
    let spacing = simulation.spacing();
    let paper = Published::of(&simulation.case);
    let gaps = paper.as_ref().and_then(Published::spacing);
    let cells = [
        simulation.case.offset_label(),
        paper.as_ref().map_or("-".to_owned(), Published::dumps),
        simulation.count.to_string(),
        paper.as_ref().map_or("", |paper| paper.against(simulation.count)).to_owned(),
        gaps.map_or("-".to_owned(), Spacing::to_string),
        spacing.to_string(),
        spacing.five_days().to_owned(),
    ];
    [&setting_cells(&simulation.case)[..], &cells].concat()
}

fn gap_row(simulation: &Simulated) -> Vec<String> {
    let spacing = simulation.spacing();
    let paper = Published::of(&simulation.case).and_then(|published| published.spacing());
    let cells = [
        simulation.case.offset_label(),
        paper.map_or("-".to_owned(), Spacing::to_string),
        spacing.to_string(),
        paper.map_or("", |paper| spacing.against(paper)).to_owned(),
        paper.map_or("", Spacing::five_days).to_owned(),
        spacing.five_days().to_owned(),
    ];
    [&setting_cells(&simulation.case)[..], &cells].concat()
}

const TABLE_2: &str = "paper 000, Table 2";
const TABLE_4: &str = "paper 000, Table 4";

const ASSUMPTIONS_REMARK: &str = "\
Dumps to: share of the opposite threshold; 1.0 is the paper's, 0.9 the FMU's default. Study's own: elements about
Mercury's equator, start 2009-04-06. Tilt signs: + turns a panel right-handed about +X, of the +X panel first. No
choice is fitted to the counts.";

const REMARK: &str = "\
Dumps to: share of the opposite threshold at which a dump leaves a component; 1.0 is the paper's, 0.9 the FMU's default,
0.0 is zero; \"X +0.9\" leaves X at that share of the threshold whichever side it was on.
Typical is the middle half of the gaps. The paper integrates each body component of torque on its own; the inertial
rows are the physical momentum, whose body components also turn with the spacecraft. As in the paper: pressure fixed
at its 0.3 AU value, no eclipses, no gravity gradient. Plates and panels: what the paper does not print of them is
\"comparable\" to the cylinder's, here to those of its two thresholds.
Fitted: the science rule's factor 0.25. Chosen, because the paper does not print it: paper 004's orbit about Mercury's
equator with a period of 12 h, start 2009-04-06, downlink 2 to 10 h after every second periapsis, twenty cycles that
predictive targets look ahead; momentum/assumptions shows what follows from other choices.
Optimum: the Sun's place in every downlink, and what each dump leaves, planned with all 90 days in view for the fewest
dumps, then the least momentum: of the body components in the paper's momentum, of |H| in the physical one.";

const DUMP_HEADER: &str = "case | dump_time_d | impulse_x_n_m_s | impulse_y_n_m_s | impulse_z_n_m_s";

fn dump_rows(simulation: &Simulated) -> Vec<Vec<String>> {
    let row = |dump: &Dump| {
        let mut row = vec![simulation.case.label(), format!("{:.6}", dump.time_d)];
        row.extend(dump.impulse_body_n_m_s.iter().map(|impulse_n_m_s| format!("{impulse_n_m_s:.6}")));
        row
    };
    simulation.dumps.iter().map(row).collect()
}
