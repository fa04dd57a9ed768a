"""DisturbanceTorque in FMPy: it validates, and its sunlight is that of Basilisk and of a sum face by face."""

import tomllib

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from simulation import Stepped, basilisk_table, columns, vector
from spacecraft import RESOURCES, call, pack, solar_loads

@pytest.fixture(scope="session")
def disturbance_torque(dist):
    return str(dist / "DisturbanceTorque.fmu")


def test_fmpy_has_nothing_to_report(disturbance_torque):
    assert validate_fmu(disturbance_torque) == []


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
    spacecraft = tomllib.loads(file.read_text(encoding="utf-8"))
    surfaces = spacecraft.get("plates", []) + spacecraft.get("sunshade", {}).get("plates", []) + spacecraft.get("panels", [])
    assert len(temperatures) == sum(2 if "rear_optics" in surface else 1 for surface in surfaces) > 8
    forces = [name.replace("temperature", f"force[{i}]") for name in temperatures for i in (1, 2, 3)]
    total = [f"force.total[{i}]" for i in (1, 2, 3)]
    output = [*temperatures, *forces, *total]
    result = simulate_fmu(str(fmu), stop_time=60, step_size=60, output=output)
    force = np.array([result[name][-1] for name in forces]).reshape(-1, 3)
    expected = np.array([result[name][-1] for name in total])
    assert np.abs(expected).max() > 1e-6
    assert np.abs(force.sum(axis=0) - expected).max() <= 1e-12 * np.abs(force).max()
    # Without a planet an insulated plate that radiates as well as it absorbs has the temperature of a black one, unlit that of space.
    result = simulate_fmu(str(fmu), stop_time=60, step_size=60, start_values={"planet.present": False}, output=output)
    sun_m = 5.791e10
    for k, plate in enumerate(spacecraft["plates"], 1):
        sunlit = 1365.0 * (1.495978707e11 / sun_m) ** 2 * max(0.0, -plate["normal"][1])
        assert np.isclose(result[f"plate[{k}].temperature"][-1], (sunlit / 5.670374419e-8 + 2.725**4) ** 0.25, rtol=1e-9)


def test_sunlight_is_basilisks(heliotorque, dist, tmp_path):
    """Forty directions of the Sun, nine of which light backs alone, the panels at five and four angles.

    `sunlight-basilisk.csv` holds what Basilisk 2.12.1 gives (facetSRPDynamicEffector) for the plates and panels of the file.
    """
    table = basilisk_table("sunlight-basilisk")
    text = (RESOURCES / "messenger.toml").read_text(encoding="utf-8")
    fmu = pack(heliotorque, dist, tmp_path, text, "Messenger", "DisturbanceTorque.fmu")
    # Basilisk's flux.
    spacecraft = Stepped(extract(fmu, unzipdir=str(tmp_path / "unpacked")), {"solar.flux": 1368.0})
    inputs = vector("sun.positionBody") + ["panel[1].angle", "panel[2].angle"]
    for names in (vector("force.solar"), vector("torque.solar")):
        expected = columns(table, names)
        assert np.abs(expected).max() > 1e-4
        for row, wanted in zip(table, expected):
            spacecraft.set(**{name: row[name] for name in inputs})
            spacecraft.step(1.0)
            assert np.abs(spacecraft.get(*names) - wanted).max() < 1e-14 * np.abs(expected).max()
    spacecraft.close()


def test_the_whole_messenger_is_pushed_as_its_faces_are(heliotorque, dist, tmp_path):
    """Two hundred directions all over the sphere, without shadows, against a sum written out face by face."""
    text = (RESOURCES / "messenger-full.toml").read_text(encoding="utf-8")
    fmu = pack(heliotorque, dist, tmp_path, text, "Whole", "DisturbanceTorque.fmu")
    angles = [0.4, -1.1]
    light = Stepped(
        extract(fmu, unzipdir=str(tmp_path / "unpacked")),
        {"solar.flux": 1365.0, "planet.present": False, "shadowing.enabled": False},
    )
    center_of_mass = np.array([0.01, -0.02, 0.03])
    light.set(**{f"spacecraft.centerOfMass[{i + 1}]": value for i, value in enumerate(center_of_mass)})
    light.set(**{f"panel[{i + 1}].angle": angle for i, angle in enumerate(angles)})
    faces, distance = text.replace("[[sunshade.plates]]", "[[plates]]"), 6.0e10
    pressure = 1365.0 * (1.495978707e11 / distance) ** 2 / 299792458.0
    random = np.random.default_rng(3)
    for sun in random.normal(size=(200, 3)):
        sun /= np.linalg.norm(sun)
        light.set(**{f"sun.positionBody[{i + 1}]": distance * value for i, value in enumerate(sun)})
        light.step(1.0)
        force, torque, size = solar_loads(faces, sun, pressure, angles, center_of_mass)
        # The file's outlines have nine decimals, and their centres lie within a hundredth of a millimetre of those printed.
        assert np.abs(light.get(*vector("force.solar")) - force).max() < 1e-8 * size
        assert np.abs(light.get(*vector("torque.solar")) - torque).max() < 1e-5 * size
    light.close()
