"""Paper 000: dumps to zero and to one side of X, and the plates alone, by strategy."""

import sys

sys.path[0] += "/.."
from momentum.cases import ALONG_Z, CYLINDER, OWN, PLATES, STRATEGIES, ZERO, Simulated, with_strategies
from momentum.counts import REMARK, counts, write_dumps
from study import main


def dump_targets(run):
    both = [(dumps_to, shade, "paper's") for dumps_to, shade in ((OWN, PLATES), (ZERO, CYLINDER))]
    small = [(dumps_to, CYLINDER, "paper's") for dumps_to in ("X +0.9", "X -0.9")]
    cases = with_strategies(STRATEGIES, both, [4.0, 7.0], ALONG_Z) + with_strategies(STRATEGIES, small, [4.0], ALONG_Z)
    cases = run.chosen(cases, lambda case: case.label())
    fmu = run.fmu("MomentumPlant.fmu")
    simulated = run.all(cases, lambda case: Simulated(fmu, case))
    counts(run, "dump-targets.csv", simulated, "plates alone, and dumps that paper 000's tables do not have")
    run.line(REMARK)
    write_dumps(run, simulated)


main(dump_targets)
