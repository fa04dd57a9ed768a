"""MomentumPlant in FMPy: it validates, and halving its internal step changes nothing that matters."""

import numpy as np
import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

from simulation import PAPER, dump_times, simulate, stack, vector


def test_fmpy_has_nothing_to_report(momentum_plant):
    assert validate_fmu(momentum_plant) == []


def test_description_passes_the_schema(momentum_plant):
    description = read_model_description(momentum_plant, validate=True)
    assert description.coSimulation is not None
    assert len(description.modelVariables) > 100


@pytest.mark.parametrize("convention", [1, 2])
def test_halving_the_internal_step_changes_nothing_that_matters(momentum_plant, convention):
    start = PAPER | {"momentum.convention": convention}
    whole = simulate(momentum_plant, start=start | {"solver.step": 600.0})
    half = simulate(momentum_plant, start=start | {"solver.step": 300.0})
    assert np.abs(dump_times(whole) - dump_times(half)).max() < 1.0
    # A communication point between two nearly equal dump times sees one simulation before and one after its dump.
    same = whole["dump.count"] == half["dump.count"]
    assert same.mean() > 0.999
    difference = np.abs(stack(whole, "momentum.body") - stack(half, "momentum.body"))[same]
    assert difference.max() < 1e-6


def test_inertial_momentum_is_the_physical_total_in_both_conventions(momentum_plant):
    names = vector("momentum.inertial")
    free = {f"dump.threshold[{i}]": 1e9 for i in (1, 2, 3)}
    simulations = [
        stack(simulate(momentum_plant, days=5.0, start=PAPER | free | {"momentum.convention": c}, output=names), "momentum.inertial")
        for c in (1, 2)
    ]
    assert np.abs(simulations[0] - simulations[1]).max() < 1e-9


def test_commanded_attitude_is_followed(momentum_plant):
    """A constant rate about Z turns the body by rate times time; held inputs leave no trace of the steps."""
    rate = 1e-4
    start = {"attitude.source": 2, "command.rate[3]": rate, "command.q[1]": 0.6, "command.q[4]": 0.8}
    names = [f"attitude.q[{i}]" for i in (1, 2, 3, 4)]
    result = simulate(momentum_plant, 600.0, days=0.25, start=start, output=names)
    q = np.column_stack([result[name] for name in names])
    half = 0.5 * rate * result["time"]
    # (0.6, 0, 0, 0.8) followed by a turn about body Z, written out by hand.
    expected = np.column_stack([0.6 * np.cos(half), -0.6 * np.sin(half), 0.8 * np.sin(half), 0.8 * np.cos(half)])
    expected *= np.where(expected[:, 3:] < 0.0, -1.0, 1.0)
    assert np.abs(q - expected).max() < 1e-12
