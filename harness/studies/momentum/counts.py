"""Tables of dumps and of the time between them, and trends that hold whatever the paper leaves open."""

import itertools

from momentum.cases import OPTIMUM, PLANNED, STRATEGIES
from momentum.published import Published

REMARK = """\
Dumps to: share of the opposite threshold at which a dump leaves a component; 1.0 is the paper's, 0.9 the FMU's default,
0.0 is zero; "X +0.9" leaves X at that share of the threshold whichever side it was on.
Typical is the middle half of the gaps. The paper integrates each body component of torque on its own; the inertial
rows are the physical momentum, whose body components also turn with the spacecraft. As in the paper: pressure fixed
at its 0.3 AU value, no eclipses, no gravity gradient. Plates and panels: what the paper does not print of them is
"comparable" to the cylinder's, here to those of its two thresholds.
Fitted: the science rule's factor 0.25. Chosen, because the paper does not print it: paper 004's orbit about Mercury's
equator with a period of 12 h, start 2009-04-06, downlink 2 to 10 h after every second periapsis, twenty cycles that
predictive targets look ahead; momentum/assumptions shows what follows from other choices.
Optimum: the Sun's place in every downlink, and what each dump leaves, planned with all 90 days in view for the fewest
dumps, then the least momentum: of the body components in the paper's momentum, of |H| in the physical one."""


def by_setting(simulated):
    """Neighbouring simulations that differ in the offset alone."""
    groups = []
    for it in simulated:
        if groups and groups[-1][0].case.same(it.case, "offset_in"):
            groups[-1].append(it)
        else:
            groups.append([it])
    return groups


def across(group):
    """Cells of a group: offsets, the paper's counts, ours, and the verdict of all together."""
    published = [Published.of(it.case) for it in group]
    paper = " / ".join("-" if it is None else str(it) for it in published) if any(published) else ""
    verdicts = {paper.against(it.count) for paper, it in zip(published, group) if paper is not None}
    verdict = next((worst for worst in ("off", "within 2", "comparable") if worst in verdicts), "")
    offsets, counts = (it.case.offset_label() for it in group), (str(it.count) for it in group)
    return [" / ".join(offsets), paper, " / ".join(counts), verdict]


def counts(run, file, simulated, what):
    """Prints the number of dumps by setting, and writes it by case."""
    run.line(f"Thruster dumps in 90 days ({what})\n")
    header = "threshold | dumps to | shade | momentum | strategy | offsets | paper | ours | verdict"
    run.table(header, [group[0].case.setting_cells() + across(group) for group in by_setting(simulated)])
    run.line(trends(simulated))
    rows = []
    for it in simulated:
        published, spacing = Published.of(it.case), it.spacing()
        paper = ["-", str(it.count), ""] if published is None else [str(published), str(it.count), published.against(it.count)]
        gaps = str(published.spacing) if published and published.spacing else "-"
        rows.append([*it.case.setting_cells(), it.case.offset_label(), *paper, gaps, str(spacing), spacing.five_days()])
    header = "threshold | dumps to | shade | momentum | strategy | offset | paper | ours | verdict"
    run.csv(file, f"{header} | paper's gaps | our gaps | five days", rows)


def gaps(run, file, simulated, table):
    """Prints and writes the time between dumps by case."""
    run.line(f"Time between thruster dumps (paper 000, {table})\n")
    rows = []
    for it in simulated:
        published, spacing = Published.of(it.case), it.spacing()
        stated = published.spacing if published else None
        paper = ["-", str(spacing), "", ""]
        if stated:
            paper = [str(stated), str(spacing), spacing.against(stated), stated.five_days()]
        rows.append([*it.case.setting_cells(), it.case.offset_label(), *paper, spacing.five_days()])
    header = "threshold | dumps to | shade | momentum | strategy | offset | paper | ours | verdict"
    run.table_and_csv(file, f"{header} | paper's five days | five days", rows)


def write_dumps(run, simulated):
    """Writes every dump."""
    rows = (
        [it.case.label(), f"{time_d:.6f}", *(f"{component:.6f}" for component in impulse_n_m_s)]
        for it in simulated
        for time_d, impulse_n_m_s in zip(it.dumps_d, it.impulses_body_n_m_s)
    )
    run.csv("dumps.csv", "case | dump_time_d | impulse_x_n_m_s | impulse_y_n_m_s | impulse_z_n_m_s", rows)


def has_next_strategy(more, fewer):
    pairs = itertools.pairwise(STRATEGIES)
    return (more.strategy, fewer.strategy) in pairs and more.same(fewer, "strategy")


def is_its_optimum(more, fewer):
    is_optimum = more.strategy != OPTIMUM and fewer.strategy == OPTIMUM and fewer.dumps_to == PLANNED
    return is_optimum and more.same(fewer, "strategy", "dumps_to")


def has_higher_threshold(more, fewer):
    return more.threshold_n_m_s < fewer.threshold_n_m_s and more.same(fewer, "threshold_n_m_s")


def is_an_inch_closer(more, fewer):
    far, near = more.offset_in[2], fewer.offset_in[2]
    is_closer = more.is_along_z and fewer.is_along_z and far != 0 and near == far - (1 if far > 0 else -1)
    return is_closer and more.same(fewer, "offset_in")


TRENDS = {
    "strategy": has_next_strategy,
    "optimum": is_its_optimum,
    "threshold": has_higher_threshold,
    "offset": is_an_inch_closer,
}


def trends(simulated):
    """Text on comparisons of two simulations that differ in one thing: looking ahead saves dumps, so do large wheels and small
    offsets."""
    compared, exceptions = 0, []
    for kind, is_ordered in TRENDS.items():
        for more, fewer in itertools.product(simulated, simulated):
            if is_ordered(more.case, fewer.case):
                compared += 1
                if fewer.count > more.count:
                    pair = f"{more.count} dumps with [{more.case.label()}], {fewer.count} with [{fewer.case.label()}]"
                    exceptions.append(f"\n  {kind}: {pair}")
    return (
        "Trends (dumps only >= reactive >= predictive, each >= optimum, fewer with the threshold, more with the offset along Z): "
        f"{compared - len(exceptions)} of {compared} comparisons hold.{''.join(exceptions)}"
    )
