//! Paper 000, Figures 4 and 5: X momentum over 90 days.

use super::cases::{Case, Convention, Simulated, Strategy};
use super::lists;
use super::optimum::simulate_all;
use crate::report::{Outcome, Run};
use drawing::{Chart, Panel, Series};

/// A figure: one panel an offset, one line a strategy.
pub(super) struct Figure {
    name: &'static str,
    title: &'static str,
    strategies: &'static [Strategy],
}

/// Thruster dumps alone.
pub(super) const FIGURE_4: Figure =
    Figure { name: "figure4", title: "thruster dumps only", strategies: &[Strategy::DumpsOnly] };
/// Dumps and targets.
pub(super) const FIGURE_5: Figure = Figure {
    name: "figure5",
    title: "targets by sunlight",
    strategies: &[Strategy::Reactive, Strategy::Predictive],
};

/// Figure 4.
pub(crate) fn figure4(run: &mut Run<'_>) -> Outcome {
    figure(run, &FIGURE_4, "4")
}

/// Figure 5.
pub(crate) fn figure5(run: &mut Run<'_>) -> Outcome {
    figure(run, &FIGURE_5, "5")
}

fn figure(run: &mut Run<'_>, figure: &Figure, number: &str) -> Outcome {
    let simulated = simulate_all(run, lists::figure(figure.strategies))?;
    draw(run, &simulated, figure)?;
    run.line(&format!("X momentum over 90 days (paper 000, Figure {number})"));
    Ok(())
}

/// The figure's strategies, one panel an offset as in the paper: the cylinder with the paper's dumps at the lowest threshold
/// simulated.
pub(super) fn draw(run: &mut Run<'_>, simulated: &[Simulated], figure: &Figure) -> Outcome {
    let in_figure = |case: &Case| {
        case.convention == Convention::BodyIntegral && figure.strategies.contains(&case.strategy)
    };
    let Some(first) = simulated.iter().find(|simulation| in_figure(&simulation.case)) else { return Ok(()) };
    let selected = |case: &Case| {
        let same = Case { strategy: case.strategy, offset_in: case.offset_in, ..first.case };
        in_figure(case) && *case == same
    };
    let chosen: Vec<&Simulated> = simulated.iter().filter(|simulation| selected(&simulation.case)).collect();
    let mut offsets: Vec<[i8; 3]> = Vec::new();
    for simulation in &chosen {
        if !offsets.contains(&simulation.case.offset_in) {
            offsets.push(simulation.case.offset_in);
        }
    }
    let line = |simulation: &&&Simulated| {
        let case = &simulation.case;
        let strategy =
            if figure.strategies.len() > 1 { format!("{}, ", case.strategy.label()) } else { String::new() };
        let offset = case.offset_label();
        Series::line(
            format!("{strategy}centre of mass at Z = {offset}, {} dumps", simulation.count),
            simulation.times_d.iter().copied().zip(simulation.momentum_x_n_m_s.iter().copied()).collect(),
        )
    };
    let threshold_n_m_s = first.case.threshold_n_m_s;
    let limit = threshold_n_m_s * 1.25;
    let panel = |offset_in: &[i8; 3]| {
        Panel::new("H_x [N.m.s]")
            .range(-limit, limit)
            .marks("threshold", vec![-threshold_n_m_s, threshold_n_m_s])
            .with(chosen.iter().filter(|it| it.case.offset_in == *offset_in).map(|it| line(&it)))
    };
    let chart = Chart::new(
        format!(
            "X momentum with {}: {} shade, {threshold_n_m_s} N.m.s, dumps to {} of it",
            figure.title,
            first.case.shade.label(),
            first.case.dumps_to.label()
        ),
        "time [d]",
    )
    .with(offsets.iter().map(panel));
    run.picture(&format!("{}.svg", figure.name), &chart)?;
    let rows = chosen.iter().flat_map(|simulation| {
        let label = simulation.case.label();
        simulation.times_d.iter().zip(&simulation.momentum_x_n_m_s).step_by(6).map(
            move |(time_d, momentum)| vec![label.clone(), format!("{time_d:.6}"), format!("{momentum:.9}")],
        )
    });
    run.csv(&format!("{}.csv", figure.name), "case | time_d | momentum_x_n_m_s", rows)
}
