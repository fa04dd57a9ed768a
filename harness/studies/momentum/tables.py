"""Paper 000: Tables 2 to 5 from one set of simulations."""

import sys

sys.path[0] += "/.."
from momentum.cases import (
    ALL_OFFSETS,
    ALONG_Z,
    CYLINDER,
    OPTIMUM,
    OWN,
    PANELS,
    PAPER,
    PLANNED,
    STRATEGIES,
    Simulated,
    with_strategies,
)
from momentum.counts import REMARK, counts, gaps, write_dumps
from momentum.momentum_x import FIGURE_4, draw
from momentum.optimum import optimum
from study import main

TABLE = {"metavar": "NUMBER", "type": int, "choices": (2, 3, 4, 5), "help": "one table alone, 2 to 5"}


def by_rules(shade, thresholds_n_m_s, offsets_in):
    """Every strategy by the paper's own dumps, then the FMU's default ones, then these under the physical momentum; then the
    optimum of each threshold and offset under both momenta."""
    groups = [(PAPER, shade, "paper's"), (OWN, shade, "paper's"), (OWN, shade, "inertial")]
    planned = [(PLANNED, shade, convention) for convention in ("paper's", "inertial")]
    cases = with_strategies(STRATEGIES, groups, thresholds_n_m_s, offsets_in)
    return cases + with_strategies([OPTIMUM], planned, thresholds_n_m_s, offsets_in)


def is_papers(case):
    """Whether a case is one that Tables 3 and 5 have: what the paper's momentum gives of Tables 2 and 4."""
    return case.convention == "paper's" and case.strategy != OPTIMUM


def tables(run):
    number = run.options.table
    cylinder, panels = by_rules(CYLINDER, [4.0, 7.0], ALONG_Z), by_rules(PANELS, [5.5], ALL_OFFSETS)
    cases = {2: cylinder, 3: filter(is_papers, cylinder), 4: panels, 5: filter(is_papers, panels)}.get(number, cylinder + panels)
    cases = run.chosen(cases, lambda case: case.label())
    fmu = run.fmu("MomentumPlant.fmu")

    def simulate(case):
        return optimum(run, fmu, case) if case.strategy == OPTIMUM else Simulated(fmu, case)

    simulated = run.all(cases, simulate)
    for table, shade in ((2, CYLINDER), (3, CYLINDER), (4, PANELS), (5, PANELS)):
        own = [it for it in simulated if it.case.shade == shade and (table in (2, 4) or is_papers(it.case))]
        if own and number in (None, table):
            if table in (2, 4):
                counts(run, f"table{table}.csv", own, f"paper 000, Table {table}")
            else:
                gaps(run, f"table{table}.csv", own, f"Table {table}")
    if number in (None, 2):
        draw(run, simulated, FIGURE_4)
    run.line(REMARK)
    write_dumps(run, simulated)


main(tables, table=TABLE)
