"""MomentumPlant follows commands and dumps momentum as closed forms say: rotations composed by hand, a constant torque."""

import tomllib

import numpy as np
import pytest

from simulation import DAY_S, PAPER, QUATERNION, Stepped, simulate, stack, to_body, turned, vector
from spacecraft import RESOURCES

SPACECRAFT = tomllib.loads((RESOURCES / "messenger.toml").read_text(encoding="utf-8"))
INERTIA = np.array(SPACECRAFT["mass_properties"]["inertia_kg_m2"])
AXES = np.array([np.array(wheel["axis"]) / np.linalg.norm(wheel["axis"]) for wheel in SPACECRAFT["wheels"]])


def elements(name, values):
    return {f"{name}[{k}]": float(value) for k, value in enumerate(values, 1)}


def quaternion(axis, angle):
    """Scalar last, of a turn of the body about an axis."""
    return [*(np.sin(0.5 * angle) * np.asarray(axis, dtype=float) / np.linalg.norm(axis)), np.cos(0.5 * angle)]


def body_turned(matrix, axis_body, angle):
    """The matrix to the body frame after the body has turned about an axis given in body components."""
    return np.array([turned(row, axis_body, -angle) for row in matrix.T]).T


def attitude(plant):
    return to_body({name: plant.get(name) for name in QUATERNION})[0]


HELD = ([1.0, -2.0, 0.5], 0.9)
ERRORS = [([0.3, 1.0, -0.2], 0.4), ([-1.0, 0.1, 0.7], 2.1)]
COMMANDED = {"attitude.source": 2} | elements("start.q", quaternion(*HELD))


def undone(matrix, axis_body, angle):
    """The matrix after the body has turned out an error: the rotation from the commanded to the actual frame."""
    return body_turned(matrix, axis_body, -angle)


def test_an_error_quaternion_is_turned_out_once(unpacked_plant):
    first, second = ERRORS
    start = COMMANDED | {"command.kind": 2} | elements("command.error", quaternion(*first))
    # What another kind of command would follow.
    start |= elements("command.q", quaternion([0.0, 1.0, 0.0], 1.0))
    plant = Stepped(unpacked_plant, start)
    expected = undone(body_turned(np.eye(3), *HELD), *first)
    for _ in range(3):
        assert np.abs(attitude(plant) - expected).max() < 1e-13
        plant.step(600.0)
    # Another error counts only when the kind becomes errorQuaternion again.
    plant.set(**elements("command.error", quaternion(*second)))
    plant.step(600.0)
    assert np.abs(attitude(plant) - expected).max() < 1e-13
    plant.set(**{"command.kind": 0})
    plant.step(600.0)
    plant.set(**{"command.kind": 2})
    expected = undone(expected, *second)
    for _ in range(3):
        plant.step(600.0)
        assert np.abs(attitude(plant) - expected).max() < 1e-13
    # From then on the rate alone turns it, about body axes.
    rate = np.array([1e-4, -2e-4, 0.5e-4])
    plant.set(**elements("command.rate", rate))
    for k in (1, 2, 3):
        plant.step(600.0)
        assert np.abs(attitude(plant) - body_turned(expected, rate, np.linalg.norm(rate) * 600.0 * k)).max() < 1e-13
    plant.close()


def test_a_rate_alone_turns_the_attitude_held(unpacked_plant):
    rates = [np.array([1e-4, 2e-4, -1e-4]), np.array([-3e-4, 0.0, 1e-4])]
    start = COMMANDED | {"command.kind": 3} | elements("command.rate", rates[0])
    start |= elements("command.q", quaternion([0.0, 1.0, 0.0], 1.0)) | elements("command.error", quaternion(*ERRORS[0]))
    plant = Stepped(unpacked_plant, start)
    expected = body_turned(np.eye(3), *HELD)
    assert np.abs(attitude(plant) - expected).max() < 1e-13
    for rate in rates:
        plant.set(**elements("command.rate", rate))
        for k in (1, 2, 3):
            plant.step(600.0)
            turn = np.linalg.norm(rate) * 600.0 * k
            assert np.abs(attitude(plant) - body_turned(expected, rate, turn)).max() < 1e-13
            assert plant.get(*vector("attitude.rate")) == pytest.approx(rate, abs=1e-15)
        expected = body_turned(expected, rate, np.linalg.norm(rate) * 1800.0)
    plant.close()


# Nothing acts but a torque from outside, on a body that stands still: its momentum is the torque times the time.
TORQUE = np.array([1e-4, -3e-5, 2e-5])
DARK = {"attitude.source": 2, "solar.flux": 0.0, "gravityGradient.enabled": False} | elements("torque.applied", TORQUE)
DUMPED = vector("momentum.body") + vector("dump.impulse") + ["dump.count", "dump.lastTime", "dump.closest", "dump.tooClose"]
THRESHOLD = 2.0
FIRST_S = THRESHOLD / TORQUE[0]


@pytest.mark.parametrize("convention", [1, 2])
@pytest.mark.parametrize("left, policy", [
    (0.0, {"dump.reinitTo": 2}),
    (-1.25, {"dump.reinitTo": 2, "dump.target[1]": -1.25, "dump.target[2]": 7.0}),
    (0.5, {"dump.reinitTo": 2, "dump.target[1]": 0.5}),
    (-0.6 * THRESHOLD, {"dump.reinitTo": 1, "dump.reinitFraction": 0.6, "dump.target[1]": 0.5}),
])
def test_a_dump_leaves_the_component_where_the_policy_says(momentum_plant, convention, left, policy):
    start = DARK | policy | {"momentum.convention": convention, "dump.threshold[1]": THRESHOLD}
    start |= {"dump.threshold[2]": 1e6, "dump.threshold[3]": 1e6}
    result = simulate(momentum_plant, 600.0, days=2.0, start=start, output=DUMPED)
    time, cycle_s = result["time"], (THRESHOLD - left) / TORQUE[0]
    count = np.where(time < FIRST_S, 0, 1 + np.floor((time - FIRST_S) / cycle_s))
    # A dump may be seen or not where a communication point meets it.
    clear = np.abs((time - FIRST_S + 0.5 * cycle_s) % cycle_s - 0.5 * cycle_s) > 1.0
    assert count[-1] >= 3
    assert np.array_equal(result["dump.count"][clear], count[clear])
    expected = np.outer(time, TORQUE)
    expected[:, 0] -= count * (THRESHOLD - left)
    assert np.abs(stack(result, "momentum.body") - expected)[clear].max() < 1e-7
    impulse = np.outer(count > 0, [left - THRESHOLD, 0.0, 0.0])
    assert np.abs(stack(result, "dump.impulse") - impulse)[clear].max() < 1e-7
    last = np.where(count > 0, FIRST_S + (count - 1) * cycle_s, -1.0)
    assert np.abs(result["dump.lastTime"] - last)[clear].max() < 1e-3
    closest = np.where(count > 1, cycle_s, -1.0)
    assert np.abs(result["dump.closest"] - closest)[clear].max() < 1e-3
    # Hours are closer than the five days of paper 000's mission.
    assert np.array_equal(result["dump.tooClose"][clear] != 0, count[clear] > 1)


@pytest.mark.parametrize("gap_d, flagged", [(4.9, True), (5.1, False)])
def test_the_missions_five_days_between_dumps_are_watched(momentum_plant, gap_d, flagged):
    start = DARK | {"dump.reinitTo": 2, "torque.applied[1]": 2.0 / (gap_d * DAY_S)}
    start |= {f"dump.threshold[{axis}]": threshold for axis, threshold in ((1, 2.0), (2, 1e6), (3, 1e6))}
    result = simulate(momentum_plant, 3600.0, days=16.0, start=start, output=DUMPED)
    assert result["dump.count"][-1] == 3
    assert result["dump.closest"][-1] == pytest.approx(gap_d * DAY_S, abs=1e-3)
    assert (result["dump.tooClose"] != 0).any() == flagged


@pytest.mark.parametrize("required_s, flagged", [(9_999.0, False), (10_001.0, True)])
def test_the_required_spacing_can_be_chosen(momentum_plant, required_s, flagged):
    start = DARK | {"dump.reinitTo": 2, "dump.threshold[1]": 1.0, "dump.requiredSpacing": required_s}
    start |= {"dump.threshold[2]": 1e6, "dump.threshold[3]": 1e6}
    result = simulate(momentum_plant, 600.0, days=0.5, start=start, output=DUMPED)
    assert result["dump.closest"][-1] == pytest.approx(10_000.0, abs=1e-3)
    assert bool(result["dump.tooClose"][-1]) == flagged


def test_a_request_dumps_every_component_to_the_target_once(unpacked_plant):
    target = np.array([-0.2, 0.1, 0.05])
    plant = Stepped(unpacked_plant, DARK | elements("dump.threshold", [1e6] * 3) | elements("dump.target", target))
    plant.step(5_000.0)
    before = plant.get(*vector("momentum.body"))
    assert np.abs(before - 5_000.0 * TORQUE).max() < 1e-12
    plant.set(**{"dump.request": True})
    for k in (1, 2):
        plant.step(1_000.0)
        assert np.abs(plant.get(*vector("momentum.body")) - (target + 1_000.0 * k * TORQUE)).max() < 1e-12
        assert np.abs(plant.get(*vector("dump.impulse")) - (target - before)).max() < 1e-12
        assert plant.get("dump.count")[0] == 1 and plant.get("dump.lastTime")[0] == 5_000.0
    plant.close()


MOMENTA = vector("momentum.body") + vector("momentum.inertial") + vector("attitude.rate") + QUATERNION


@pytest.fixture(scope="module")
def guided(momentum_plant):
    """Sixty days under guidance, with dumps, slews and every component of momentum."""
    start = {"guided.slewRate": 1e-3, "wheel[2].capacity": 1.2} | elements("start.momentum", [0.5, -1.0, 2.0])
    start |= elements("dump.threshold", [2.5, 2.0, 2.0])
    wheels = [f"wheel[{k}].{what}" for k in (1, 2, 3, 4) for what in ("momentum", "saturated", "capacity")]
    return simulate(momentum_plant, 600.0, days=60.0, start=start, output=MOMENTA + wheels + ["dump.lastTime", "dump.closest"])


def test_the_closest_dumps_are_those_of_the_smallest_gap(guided):
    times = guided["dump.lastTime"]
    dumps = np.unique(times[times >= 0.0])
    gaps = np.diff(dumps)
    assert len(gaps) > 3 and gaps[0] > gaps.min() < gaps[-1]
    expected = [gaps[: max((dumps <= time).sum() - 1, 0)].min(initial=np.inf) for time in times]
    assert np.array_equal(guided["dump.closest"], np.where(np.isfinite(expected), expected, -1.0))


def test_body_momentum_is_the_inertial_one_in_body_components(guided):
    body = stack(guided, "momentum.body")
    expected = np.einsum("kij,kj->ki", to_body(guided), stack(guided, "momentum.inertial"))
    assert (np.abs(body).max(axis=0) > 1.0).all()
    assert np.abs(body[0] - [0.5, -1.0, 2.0]).max() < 1e-12
    assert np.abs(body - expected).max() < 1e-12


def test_wheels_hold_the_total_less_the_bodys_own(guided):
    momentum = np.column_stack([guided[f"wheel[{k}].momentum"] for k in (1, 2, 3, 4)])
    own = stack(guided, "attitude.rate") @ INERTIA
    assert np.abs(own).max() > 0.3
    held = stack(guided, "momentum.body") - own
    assert np.abs(momentum @ AXES - held).max() < 1e-12
    # Of all that add up to this, the share with the least squares.
    assert np.abs(momentum - held @ np.linalg.pinv(AXES)).max() < 1e-12
    saturated = np.column_stack([guided[f"wheel[{k}].saturated"] for k in (1, 2, 3, 4)]) != 0
    capacity = np.column_stack([guided[f"wheel[{k}].capacity"] for k in (1, 2, 3, 4)])
    assert np.array_equal(saturated, np.abs(momentum) > capacity)
    assert 0 < saturated[:, 1].sum() < len(saturated) and not saturated[:, [0, 2, 3]].any()


def test_wheels_hold_the_physical_momentum_in_the_papers_convention_too(momentum_plant):
    names = MOMENTA + [f"wheel[{k}].momentum" for k in (1, 2, 3, 4)]
    result = simulate(momentum_plant, 600.0, days=20.0, start=PAPER, output=names)
    total = np.einsum("kij,kj->ki", to_body(result), stack(result, "momentum.inertial"))
    assert np.abs(total - stack(result, "momentum.body")).max() > 0.1
    momentum = np.column_stack([result[f"wheel[{k}].momentum"] for k in (1, 2, 3, 4)])
    assert np.abs(momentum @ AXES - (total - stack(result, "attitude.rate") @ INERTIA)).max() < 1e-12
