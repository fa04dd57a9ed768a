"""DisturbanceTorque in FMPy: it validates, runs, and its parts add up to its totals."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

SOURCES = ["solar", "albedo", "infrared", "thermal"]


@pytest.fixture(scope="session")
def disturbance_torque(dist):
    return str(dist / "DisturbanceTorque.fmu")


def total_and_parts(fmu, quantity, extra, start=None):
    names = [f"{quantity}.{source}[{i}]" for source in [*SOURCES, *extra, "total"] for i in (1, 2, 3)]
    result = simulate_fmu(fmu, stop_time=600, step_size=60, start_values=start or {}, output=names)
    values = np.array([result[name][-1] for name in names]).reshape(-1, 3)
    return values[-1], values[:-1]


def test_fmpy_has_nothing_to_report(disturbance_torque):
    assert validate_fmu(disturbance_torque) == []


@pytest.mark.parametrize("quantity, extra", [("torque", ["gravityGradient"]), ("force", [])])
def test_sources_add_up_to_the_total(disturbance_torque, quantity, extra):
    total, parts = total_and_parts(disturbance_torque, quantity, extra)
    assert np.abs(parts).max() > 0.0
    assert np.abs(parts.sum(axis=0) - total).max() <= 1e-12 * np.abs(parts).max()


def test_without_a_planet_only_sun_and_own_heat_act(disturbance_torque):
    _, parts = total_and_parts(disturbance_torque, "force", [], {"planet.present": False})
    solar, albedo, infrared, thermal = parts
    assert np.abs(solar).max() > 1e-6 and np.abs(thermal).max() > 1e-8
    assert not albedo.any() and not infrared.any()


def test_sunlight_falls_with_the_square_of_the_distance(disturbance_torque):
    near, _ = total_and_parts(disturbance_torque, "force", [], {"planet.present": False})
    solar = []
    for metres in (-5.0e10, -1.0e11):
        start = {"planet.present": False, "sun.position[2]": metres}
        solar.append(total_and_parts(disturbance_torque, "force", [], start)[1][0])
    assert np.allclose(solar[0], 4.0 * solar[1], rtol=1e-12)
    assert np.abs(near).max() > 0.0
