"""Flying MomentumPlant with FMPy: the paper's settings by name, results by name."""

import numpy as np
from fmpy import simulate_fmu

DAY_S = 86_400.0

# Paper 000's study: no panels, fixed pressure, body components integrated on their own, 4 N.m.s, dumps only.
PAPER = {
    "momentum.convention": 2,
    "solar.fixedPressure": True,
    "gravityGradient.enabled": False,
    "eclipse.model": 4,
    "panel[1].enabled": False,
    "panel[2].enabled": False,
}


def vector(name):
    return [f"{name}[{i}]" for i in (1, 2, 3)]


def fly(fmu, step_s=600.0, days=90.0, start=None, output=None, **options):
    output = output or vector("momentum.body") + ["dump.count", "dump.lastTime"]
    return simulate_fmu(
        fmu,
        stop_time=days * DAY_S,
        step_size=step_s,
        output_interval=step_s,
        start_values=start or {},
        output=output,
        **options,
    )


def stack(result, name):
    return np.column_stack([result[element] for element in vector(name)])


def dump_times(result):
    """Time of every dump, from the output that holds the last one."""
    return np.unique(result["dump.lastTime"][result["dump.count"] > 0])
