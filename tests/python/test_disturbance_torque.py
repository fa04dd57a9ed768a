"""DisturbanceTorque in FMPy: it validates, runs, and its parts add up to its totals."""

import tomllib

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from spacecraft import RESOURCES, call

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


def test_plates_reported_one_by_one_add_up_to_the_force(heliotorque, dist, tmp_path):
    fmu = tmp_path / "Plates.fmu"
    template, file = (dist / "DisturbanceTorque.fmu").resolve(), RESOURCES / "messenger-thermal.toml"
    packed = call(
        heliotorque, "pack", "--per-plate", "--spacecraft", file, "--template", template, "--name", "Plates",
        "--output", fmu,
    )
    assert packed.returncode == 0, packed.stderr
    assert validate_fmu(str(fmu)) == []
    names = [variable.name for variable in read_model_description(str(fmu)).modelVariables]
    temperatures = [name for name in names if name.startswith("plate[") and name.endswith("].temperature")]
    craft = tomllib.loads(file.read_text(encoding="utf-8"))
    surfaces = craft.get("plates", []) + craft.get("sunshade", {}).get("plates", []) + craft.get("panels", [])
    assert len(temperatures) == sum(2 if "rear_optics" in surface else 1 for surface in surfaces) > 8
    forces = [name.replace("temperature", f"force[{i}]") for name in temperatures for i in (1, 2, 3)]
    total = [f"force.total[{i}]" for i in (1, 2, 3)]
    output = [*temperatures, *forces, *total]
    result = simulate_fmu(str(fmu), stop_time=60, step_size=60, output=output)
    force = np.array([result[name][-1] for name in forces]).reshape(-1, 3)
    expected = np.array([result[name][-1] for name in total])
    assert np.abs(expected).max() > 1e-6
    assert np.abs(force.sum(axis=0) - expected).max() <= 1e-12 * np.abs(force).max()
    # Without a planet an insulated plate that radiates as well as it absorbs has the temperature of a black one.
    result = simulate_fmu(str(fmu), stop_time=60, step_size=60, start_values={"planet.present": False}, output=output)
    sun_m = 5.791e10
    for k, plate in enumerate(craft["plates"], 1):
        sunlit = 1365.0 * (1.495978707e11 / sun_m) ** 2 * max(0.0, -plate["normal"][1])
        assert np.isclose(result[f"plate[{k}].temperature"][-1], (sunlit / 5.670374419e-8) ** 0.25, rtol=1e-9)
