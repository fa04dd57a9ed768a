"""Paper 000: how Table 2 moves with start date, orbit frame and panel tilts, which the paper leaves open."""

import sys

sys.path[0] += "/.."
from dataclasses import replace

from momentum.cases import ALONG_Z, CHOICES, CYLINDER, OWN, PANELS, PAPER, Simulated, with_strategies
from momentum.counts import across, by_setting, write_dumps
from study import main

REMARK = """\
Dumps to: share of the opposite threshold; 1.0 is the paper's, 0.9 the FMU's default. Study's own: elements about
Mercury's equator, start 2009-04-06. Tilt signs: + turns a panel right-handed about +X, of the +X panel first. No
choice is fitted to the counts."""


def cases():
    """Start dates and frames for the cylinder, tilts for plates and panels; each with the paper's dumps and our own."""
    is_tilt = {choice: choice.startswith("panel tilts") for choice in CHOICES}
    found = []
    for dumps_to in (PAPER, OWN):
        for threshold_n_m_s, shade, has_tilt in ((4.0, CYLINDER, False), (7.0, CYLINDER, False), (5.5, PANELS, True)):
            own = with_strategies(["dumps only"], [(dumps_to, shade, "paper's")], [threshold_n_m_s], ALONG_Z)
            choices = (choice for choice in CHOICES if is_tilt[choice] == has_tilt)
            found += [replace(case, choice=choice) for choice in choices for case in own]
    return found


def assumptions(run):
    chosen = run.chosen(cases(), lambda case: case.label())
    fmu = run.fmu("MomentumPlant.fmu")
    simulated = run.all(chosen, lambda case: Simulated(fmu, case))
    run.line("Thruster dumps in 90 days over what paper 000 leaves open: start date, orbit frame, panel tilts\n")
    rows = []
    for group in by_setting(simulated):
        case = group[0].case
        rows.append([*case.setting_cells()[:3], case.choice, *across(group)])
    header = "threshold | dumps to | shade | choice | Z offsets | paper | ours | verdict"
    run.table_and_csv("assumptions.csv", header, rows)
    run.line(REMARK)
    write_dumps(run, simulated)


main(assumptions)
