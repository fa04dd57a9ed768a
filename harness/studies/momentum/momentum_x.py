"""Figures 4 and 5 of paper 000: X momentum over 90 days."""

from momentum.cases import ALONG_Z, CYLINDER, PAPER, Simulated, with_strategies
from study import mark

FIGURE_4 = ("figure4", "thruster dumps only", ("dumps only",))
FIGURE_5 = ("figure5", "targets by sunlight", ("reactive", "predictive"))


def figure(run, figure, number):
    """One figure, small wheels."""
    cases = with_strategies(figure[2], [(PAPER, CYLINDER, "paper's")], [4.0], ALONG_Z)
    cases = run.chosen(cases, lambda case: case.label())
    fmu = run.fmu("MomentumPlant.fmu")
    draw(run, run.all(cases, lambda case: Simulated(fmu, case)), figure)
    run.line(f"X momentum over 90 days (paper 000, Figure {number})")


def draw(run, simulated, figure):
    """The figure's strategies, one panel an offset as in the paper: the first shade, threshold and dumps simulated."""
    name, title, strategies = figure
    own = [it for it in simulated if it.case.convention == "paper's" and it.case.strategy in strategies]
    if not own:
        return
    first = own[0].case
    chosen = [it for it in own if first.same(it.case, "strategy", "offset_in")]
    offsets_in = list(dict.fromkeys(it.case.offset_in for it in chosen))
    threshold_n_m_s = first.threshold_n_m_s
    title = f"X momentum with {title}: {first.shade} shade, {threshold_n_m_s:g} N.m.s, dumps to {first.dumps_to} of it"
    drawing, panels = run.axes(title, "time [d]", ["H_x [N.m.s]"] * len(offsets_in))
    for offset_in, axes in zip(offsets_in, panels):
        for it in chosen:
            if it.case.offset_in == offset_in:
                strategy = f"{it.case.strategy}, " if len(strategies) > 1 else ""
                label = f"{strategy}centre of mass at Z = {it.case.offset_label()}, {it.count} dumps"
                axes.plot(it.time_d, it.momentum_x_n_m_s, label=label)
        mark(axes, (-threshold_n_m_s, threshold_n_m_s), "threshold")
        axes.set_ylim(-1.25 * threshold_n_m_s, 1.25 * threshold_n_m_s)
    run.figure(f"{name}.svg", drawing)
    rows = (
        [it.case.label(), f"{time_d:.6f}", f"{momentum_n_m_s:.9f}"]
        for it in chosen
        for time_d, momentum_n_m_s in zip(it.time_d[::6], it.momentum_x_n_m_s[::6])
    )
    run.csv(f"{name}.csv", "case | time_d | momentum_x_n_m_s", rows)
