"""The optimum of paper 000's tables: the Sun's place in every downlink, and what dumps leave, planned with all 90 days in view.

`heliotorque plan` searches the fewest dumps, then the least momentum, with science as the rule has it and downlinks when they are; a
dump may leave any momentum. The plan's inputs are simulated with the case's own thresholds: a dump that the plan does not have would
be counted. In the paper's momentum, whose body components are integrated, each stays below the threshold, the physical one by its
length.
"""

import csv

import numpy as np

from momentum.cases import SPAN_D, STEP_S, Simulated
from fmu import SAME
from study import DAY_S

# Points at which a plan looks at the momentum: downlinks begin and end at them.
EVERY_S = 1800.0


def optimum(run, fmu, case):
    """Simulates a case by its plan."""
    settings = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in case.settings().items()}
    mission = {"model": "MomentumPlant", "stop": SPAN_D * DAY_S, "step": EVERY_S, "record": ["momentum.body"], "set": settings}
    momentum = {"limit": f"{case.threshold_n_m_s} N.m.s", "margin": 0.0, "dumps": 1000}
    folder = run.plan(mission, {"every": EVERY_S, "momentum": momentum})
    with open(folder / "plan.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return Simulated(fmu, case, inputs=held(rows, round(SPAN_D * DAY_S / STEP_S) + 1))


def held(rows, count):
    """Inputs at every communication point: of rows up to a time the last holds."""
    at_s = STEP_S * np.arange(count)
    last = np.searchsorted([float(row["time"]) for row in rows], at_s + SAME * STEP_S, side="right") - 1
    names = [name for name in rows[0] if name != "time"]
    vectors = dict.fromkeys(name.split("[")[0] for name in names)

    def number(text):
        return float({"true": 1, "false": 0}.get(text, text))

    return {
        vector: np.array([[number(row[name]) for name in names if name.split("[")[0] == vector] for row in rows])[last]
        for vector in vectors
    }
