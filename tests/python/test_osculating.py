"""MomentumPlant's osculating elements against CSPICE's `oscltx` and `conics`, orbits by elements, and the Sun over the orbit's plane."""

import numpy as np
import pytest
import spiceypy
from fmpy import read_model_description

from simulation import DAY_S, simulate, stack, vector

ANGLES = ["inclination", "ascendingNode", "periapsisArgument", "trueAnomaly", "argumentOfLatitude"]
SIZES = ["semiMajorAxis", "eccentricity", "period", "periapsisHeight", "apoapsisHeight"]
ELEMENTS = [f"osculating.{name}" for name in SIZES + ANGLES]
STATE = vector("position") + vector("velocity")
SEEN = ELEMENTS + STATE + vector("sun.positionInertial") + ["sun.beta"]
# The spacecraft's own orbit, without whatever else acts.
QUIET = {"gravityGradient.enabled": False, "planetLight.enabled": False, "thermal.enabled": False, "eclipse.method": 4}


@pytest.fixture(scope="module")
def center(momentum_plant):
    """Gravitational parameter and radius of the planet, SI."""
    variables = {it.name: it.start for it in read_model_description(momentum_plant).modelVariables}
    return float(variables["planet.gravitationalParameter"]), float(variables["planet.radius"])


def held(fmu, states, frame):
    """Elements where the spacecraft is held in each of these states for a step."""
    names = ["time"] + [f"orbit.{name}[{i}]" for name in ("position", "velocity") for i in (1, 2, 3)]
    # The last one is held for a step more.
    rows = [(600.0 * k, *state) for k, state in enumerate([*states, states[-1]])]
    signals = np.array(rows, dtype=[(name, np.float64) for name in names])
    start = QUIET | {"orbit.source": 3, "orbit.frame": frame}
    return simulate(fmu, 600.0, days=600.0 * len(states) / DAY_S, start=start, output=SEEN, input=signals)[1:]


def turns(difference):
    """Size of an angle to the next whole turn."""
    return np.abs((difference + np.pi) % (2.0 * np.pi) - np.pi)


def random_states(gm, count):
    """States by CSPICE's `conics` from random elements: ellipses and hyperbolas of every inclination."""
    random = np.random.default_rng(7)
    states = []
    for k in range(count):
        closed = k % 3 != 0
        eccentricity = random.uniform(0.01, 0.95) if closed else random.uniform(1.05, 6.0)
        node, argument = random.uniform(0.0, 2.0 * np.pi, 2)
        inclination = random.uniform(0.02, np.pi - 0.02)
        anomaly = random.uniform(0.0, 2.0 * np.pi) if closed else random.uniform(-3.0, 3.0)
        shape = [10.0 ** random.uniform(3.6, 5.5), eccentricity, inclination, node, argument, anomaly, 0.0, 1e-9 * gm]
        states.append(1e3 * spiceypy.conics(shape, 0.0))
    return states


@pytest.mark.parametrize("frame, name", [(3, "J2000"), (4, "ECLIPJ2000")])
def test_elements_are_those_of_cspice(momentum_plant, center, frame, name):
    gm, radius = center
    result = held(momentum_plant, random_states(gm, 60), frame)
    to_frame = spiceypy.pxform("J2000", name, 0.0)
    worst = 0.0
    for row, position, velocity in zip(result, stack(result, "position"), stack(result, "velocity")):
        state = np.concatenate([to_frame @ position, to_frame @ velocity]) / 1e3
        periapsis, eccentricity, *angles, _, _, _, anomaly, axis, period = spiceypy.oscltx(state, 0.0, 1e-9 * gm)
        found = {name: row[f"osculating.{name}"] for name in SIZES + ANGLES}
        expected = {"semiMajorAxis": 1e3 * axis, "eccentricity": eccentricity, "period": period}
        expected["periapsisHeight"] = 1e3 * periapsis - radius
        expected["apoapsisHeight"] = 1e3 * axis * (1.0 + eccentricity) - radius if eccentricity < 1.0 else 0.0
        for key, value in expected.items():
            size = abs(value) + (radius if key.endswith("Height") else 0.0)
            worst = max(worst, abs(found[key] - value) / size if size else abs(found[key]))
        for key, value in zip(ANGLES, [*angles, anomaly, angles[2] + anomaly]):
            worst = max(worst, turns(found[key] - value))
    assert worst < 1e-10, worst


@pytest.mark.parametrize("eccentricity", [0.0, 0.4, 2.0])
@pytest.mark.parametrize("inclination", [0.0, 0.9, np.pi])
def test_circles_and_equatorial_orbits_give_their_state_back(momentum_plant, center, eccentricity, inclination):
    """By CSPICE's `conics`; an angle without a meaning is 0, and the next counts on."""
    gm, radius = center
    # CSPICE has no plane for exactly pi, whose sine is not 0.
    shape = [8e3, eccentricity, inclination, 0.7, 1.9, 0.6, 0.0, 1e-9 * gm]
    states = [1e3 * spiceypy.conics(shape, time) for time in (0.0, 500.0, 2000.0)]
    result = held(momentum_plant, states, 3)
    for row, state in zip(result, states):
        found = {name: row[f"osculating.{name}"] for name in SIZES + ANGLES}
        if inclination in (0.0, np.pi):
            assert found["ascendingNode"] == 0.0
        if eccentricity == 0.0:
            assert found["periapsisArgument"] == 0.0 and found["eccentricity"] < 1e-13
        e = found["eccentricity"]
        # Mean anomaly of conics from the true one.
        if e < 1.0:
            half = np.arctan2(np.sqrt(1.0 - e) * np.sin(found["trueAnomaly"] / 2.0), np.sqrt(1.0 + e) * np.cos(found["trueAnomaly"] / 2.0))
            mean = 2.0 * half - e * np.sin(2.0 * half)
        else:
            h = 2.0 * np.arctanh(np.sqrt((e - 1.0) / (e + 1.0)) * np.tan(found["trueAnomaly"] / 2.0))
            mean = e * np.sinh(h) - h
        periapsis = (found["periapsisHeight"] + radius) / 1e3
        back = spiceypy.conics([periapsis, e, *(found[name] for name in ANGLES[:3]), mean, 0.0, 1e-9 * gm], 0.0)
        for part in (slice(0, 3), slice(3, 6)):
            error = np.linalg.norm(1e3 * back[part] - state[part]) / np.linalg.norm(state[part])
            assert error < 2e-12, error


def test_no_output_is_without_a_number(momentum_plant):
    """On a line through the planet, waiting for a place, and at speeds and distances beyond all flights."""
    lines = [[1e7, 2e6, -3e6, 1e3, 2e2, -3e2], [1e7, 0.0, 0.0, 0.0, 0.0, 0.0]]
    extremes = [[0.0, 3e9, 0.0, 2.9e8, 0.0, 0.0], [2.5e9, 0.0, 0.0, 0.0, 1e-6, 0.0]]
    result = held(momentum_plant, lines + extremes, 3)
    for name in ELEMENTS + ["sun.beta"]:
        assert np.isfinite(result[name]).all(), name
        assert (result[name][:2] == 0.0).all(), name
    assert (result["osculating.semiMajorAxis"][2:] != 0.0).all()
    waiting = simulate(momentum_plant, 600.0, days=0.1, start={"orbit.source": 2}, output=ELEMENTS + ["sun.beta"])
    assert all((waiting[name] == 0.0).all() for name in ELEMENTS + ["sun.beta"])


def test_a_hyperbola_by_elements_is_that_of_its_state(momentum_plant, center):
    gm, radius = center
    shape = {"orbit.semiMajorAxis": -6e6, "orbit.eccentricity": 1.8, "orbit.inclination": 1.0, "orbit.trueAnomaly": -1.9}
    start = QUIET | shape | {"orbit.frame": 3, "orbit.ascendingNode": 2.0, "orbit.periapsisArgument": 0.4}
    flown = simulate(momentum_plant, 600.0, days=0.5, start=start, output=SEEN)
    for name, value in shape.items():
        first = flown[name.replace("orbit", "osculating")][0]
        assert first == pytest.approx(value, rel=1e-12), name
    assert (flown["osculating.period"] == 0.0).all() and (flown["osculating.apoapsisHeight"] == 0.0).all()
    assert flown["osculating.periapsisHeight"] == pytest.approx(6e6 * 0.8 - radius, rel=1e-9)
    for k in (1, -1):
        state = np.concatenate([stack(flown, "position")[k], stack(flown, "velocity")[k]]) / 1e3
        first = np.concatenate([stack(flown, "position")[0], stack(flown, "velocity")[0]]) / 1e3
        expected = spiceypy.prop2b(1e-9 * gm, first, flown["time"][k])
        assert np.abs(state - expected).max() / np.abs(expected).max() < 1e-11


def test_inclination_0_in_the_sun_line_is_the_terminators_plane(momentum_plant):
    circle = {"orbit.frame": 5, "orbit.semiMajorAxis": 4e6, "orbit.eccentricity": 0.0}
    zero = ["orbit.inclination", "orbit.ascendingNode", "orbit.periapsisArgument", "orbit.trueAnomaly"]
    start = QUIET | circle | dict.fromkeys(zero, 0.0)
    output = SEEN + vector("sun.velocityInertial")
    result = simulate(momentum_plant, 600.0, days=0.05, start=start, output=output)
    position, velocity, sun = (stack(result, name) for name in ("position", "velocity", "sun.positionInertial"))
    line = sun[0] / np.linalg.norm(sun[0])
    normal = np.cross(position, velocity)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    assert np.abs(normal - line).max() < 1e-12
    # Begun at the node: as far ahead of Mercury on its way as the plane allows.
    motion = -stack(result, "sun.velocityInertial")[0]
    ahead = motion - line * (line @ motion)
    assert np.abs(position[0] / 4e6 - ahead / np.linalg.norm(ahead)).max() < 1e-12
    # The Sun of the spacecraft, over its plane.
    to_sun = sun - position
    sine = np.sum(normal * to_sun, axis=1) / np.linalg.norm(to_sun, axis=1)
    assert np.abs(np.sin(result["sun.beta"]) - sine).max() < 1e-14
    assert result["sun.beta"][0] == pytest.approx(np.pi / 2.0, abs=1e-4)
    tilted = simulate(momentum_plant, 600.0, days=0.0, start=start | {"orbit.inclination": 2.0}, output=SEEN)
    assert tilted["sun.beta"][0] == pytest.approx(np.pi / 2.0 - 2.0, abs=1e-4)
