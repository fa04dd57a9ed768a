"""MomentumPlant in FMPy: it validates, runs 90 days, and no choice of step changes its outputs."""

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


def test_communication_steps_change_no_bit(momentum_plant):
    fine = simulate(momentum_plant, 60.0, start=PAPER)
    coarse = simulate(momentum_plant, 600.0, start=PAPER)
    common = stack(fine, "momentum.body")[::10]
    assert common.shape == stack(coarse, "momentum.body").shape
    assert np.array_equal(common, stack(coarse, "momentum.body"))
    assert np.array_equal(dump_times(fine), dump_times(coarse))
    assert fine["dump.count"][-1] >= 1


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


def test_momentum_without_dumps_is_the_quadrature_of_torque(momentum_plant):
    """Simpson's rule over the torque output, which knows nothing of the plant's own integration."""
    start = PAPER | {f"dump.threshold[{i}]": 1e9 for i in (1, 2, 3)}
    # Without downlink and with a wide keep-in zone the attitude has neither jump nor kink.
    start |= {"guided.downlinkEvery": 0, "keepIn.elevation": 0.5}
    names = vector("momentum.body") + vector("torque.total")
    result = simulate(momentum_plant, 10.0, days=5.0, start=start, output=names)
    torque, momentum = stack(result, "torque.total"), stack(result, "momentum.body")
    gained = 20.0 / 6.0 * (torque[:-2:2] + 4.0 * torque[1:-1:2] + torque[2::2]).cumsum(axis=0)
    assert np.abs(momentum[-1]).max() > 0.1
    assert np.abs(momentum[2::2] - gained).max() < 1e-9


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


@pytest.mark.parametrize("source", [3, 4])
@pytest.mark.parametrize("name, value", [("momentum.convention", 2), ("start.momentum[2]", 1.0)])
def test_what_controlled_and_free_flight_cannot_take_is_refused_by_name(momentum_plant, source, name, value):
    messages = []

    def logger(environment, instance, status, category, message):
        messages.append(message.decode())

    with pytest.raises(Exception):
        simulate(momentum_plant, days=1.0, start={"attitude.source": source, name: value}, logger=logger)
    assert any(name.partition("[")[0] in m and "allowed with attitude.source" in m for m in messages), messages


def test_first_downlink_starts_where_the_schedule_says(momentum_plant):
    """The Sun stands on -Y in downlink; the pitch toward the planet ends exactly at the window's begin."""
    result = simulate(momentum_plant, 60.0, days=1.0, start=PAPER, output=["sun.elevation", "orbit.timeSincePeriapsis"])
    hours = result["time"] / 3600.0
    downlink = np.abs(result["sun.elevation"]) < 1e-9
    assert downlink.sum() * 60.0 == pytest.approx(8 * 3600.0, abs=120.0)
    begin = hours[downlink].min() % 12.0
    assert begin == pytest.approx(2.0, abs=0.05)
