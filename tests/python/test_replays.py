"""A recorded attitude drives the plant in FMPy, which interpolates each element linearly: right at the rows, poor between them."""

import numpy as np
from fmpy import simulate_fmu

STEP_S = 10.0
ROW_STEPS = 24
STOP_S = 4800.0


def names(vector, count):
    return [f"{vector}[{i + 1}]" for i in range(count)]


def fly(fmu, **options):
    return simulate_fmu(fmu, stop_time=STOP_S, step_size=STEP_S, output_interval=STEP_S, **options)


def test_a_replayed_attitude_is_right_at_the_rows(dist):
    cubesat = dist / "Cubesat.fmu"
    q, rate = names("attitude.q", 4), names("attitude.rate", 3)
    truth = fly(cubesat, output=q + rate)
    table = np.column_stack([truth[name] for name in ["time", *q, *rate]])
    attitude = table[:, 1:5]
    # Whatever sign the plant shows: linear interpolation needs neighbours of one.
    signs = np.cumprod(np.r_[1.0, np.where((attitude[1:] * attitude[:-1]).sum(axis=1) < 0.0, -1.0, 1.0)])
    attitude *= signs[:, None]
    columns = ["time", *names("command.q", 4), *names("command.rate", 3)]
    rows = np.array([tuple(row) for row in table[::ROW_STEPS]], dtype=[(name, float) for name in columns])
    replay = fly(cubesat, input=rows, start_values={"attitude.source": 2}, output=q)
    found = np.column_stack([replay[name] for name in q])
    # Half the chord of the turn is the sine of its quarter.
    chord = np.minimum(np.linalg.norm(found - attitude, axis=1), np.linalg.norm(found + attitude, axis=1))
    error_deg = np.degrees(4.0 * np.arcsin(np.minimum(1.0, chord / 2.0)))
    # A row is set at the beginning of a step and propagated by its rate to the end of it.
    behind_rows = np.arange(1, len(found), ROW_STEPS)
    assert error_deg[behind_rows].max() < 0.05
    assert error_deg[1:].max() > 10.0 * error_deg[behind_rows].max()
