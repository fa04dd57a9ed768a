"""DisturbanceTorque in FMPy: it validates, runs, and its parts add up to its totals."""

import tomllib

import numpy as np
import pytest
from fmpy import calloc, extract, free, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Error,
)
from fmpy.validation import validate_fmu

from simulation import Stepped, basilisk_table, columns, vector
from spacecraft import RESOURCES, call, pack

SOURCES = ["solar", "albedo", "infrared", "thermal"]


@pytest.fixture(scope="session")
def disturbance_torque(dist):
    return str(dist / "DisturbanceTorque.fmu")


class Placed:
    """DisturbanceTorque stepped by hand, its inputs set by name."""

    def __init__(self, fmu, folder):
        description = read_model_description(fmu)
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.messages = []
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(fmu, unzipdir=str(folder)),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="placed",
        )
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(
            lambda environment, instance, status, category, message: self.messages.append(message.decode())
        )
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.slave.instantiate(callbacks=callbacks)
        self.time = 0.0

    def put(self, name, values):
        self.slave.setReal([self.references[f"{name}[{i}]"] for i in (1, 2, 3)], values)

    def start(self):
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        self.time = 0.0

    def step(self):
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=60.0)
        self.time += 60.0

    def total(self):
        return self.slave.getReal([self.references[f"torque.total[{i}]"] for i in (1, 2, 3)])


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


IMPOSSIBLE = {
    "inside the planet": ("planet.positionBody", [1e6, -1e6, 0.0], "radius"),
    "near the planet's centre": ("planet.positionBody", [0.0, 0.0, 1.0], "radius"),
    "in the Sun": ("sun.positionBody", [2e6, 3e6, 9e6], "Sun"),
}


@pytest.mark.parametrize("place", IMPOSSIBLE)
@pytest.mark.parametrize("running", [False, True], ids=["at the start", "in a step"])
def test_an_impossible_place_is_an_error_that_names_it_and_reset_forgets_it(place, running, disturbance_torque, tmp_path):
    variable, values, why = IMPOSSIBLE[place]
    untouched = Placed(disturbance_torque, tmp_path / "untouched")
    untouched.start()
    untouched.step()
    placed = Placed(disturbance_torque, tmp_path / "placed")
    if running:
        placed.start()
        placed.step()
    assert placed.messages == []
    with pytest.raises(FMICallException) as refused:
        placed.put(variable, values)
        placed.step() if running else placed.start()
    assert refused.value.status == fmi2Error
    assert any(variable in message and why in message for message in placed.messages), placed.messages
    placed.slave.reset()
    placed.start()
    placed.step()
    assert placed.total() == untouched.total() and any(placed.total())
    for instance in (placed, untouched):
        instance.slave.terminate()
        instance.slave.freeInstance()


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


def faces_of(text, angles):
    """Area, centre, outward normal, specular and diffuse share of every face of a file of flat surfaces, fronts and backs."""
    spacecraft = tomllib.loads(text)
    optics = spacecraft["optics"]
    faces = []

    def add(area, center, normal, surface):
        for side, key in ((1.0, "optics"), (-1.0, "rear_optics")):
            if key in surface:
                material = optics[surface[key]]
                faces.append((area, center, side * normal, material["specular"], material["diffuse"]))

    def outlined(surface):
        corners = np.array(surface["polygon_m"])
        parts = [(corners[0], a, b) for a, b in zip(corners[1:], corners[2:])]
        vectors = [np.cross(a - o, b - o) / 2.0 for o, a, b in parts]
        whole = sum(vectors)
        area = np.linalg.norm(whole)
        weights = [vector @ whole / area for vector in vectors]
        return area, sum(w * (o + a + b) / 3.0 for w, (o, a, b) in zip(weights, parts)) / area

    for surface in [*spacecraft["plates"], *spacecraft["sunshade"]["plates"]]:
        area, center = outlined(surface)
        area, center = surface.get("area_m2", area), np.array(surface.get("center_m", center))
        normal = np.array(surface["normal"])
        add(area, center, normal / np.linalg.norm(normal), surface)
    for surface, angle in zip(spacecraft["panels"], angles):
        area, center = outlined(surface)
        axis, zero = np.array(surface["axis"]), np.array(surface["zero_normal"])
        add(area, center, np.cos(angle) * zero + np.sin(angle) * np.cross(axis, zero), surface)
    return faces


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
    faces, distance = faces_of(text, angles), 6.0e10
    pressure = 1365.0 * (1.495978707e11 / distance) ** 2 / 299792458.0
    random = np.random.default_rng(3)
    for sun in random.normal(size=(200, 3)):
        sun /= np.linalg.norm(sun)
        light.set(**{f"sun.positionBody[{i + 1}]": distance * value for i, value in enumerate(sun)})
        light.step(1.0)
        force, torque, size = np.zeros(3), np.zeros(3), 0.0
        for area, center, normal, specular, diffuse in faces:
            cosine = normal @ sun
            if cosine > 0.0:
                push = (1.0 - specular) * sun + 2.0 * (specular * cosine + diffuse / 3.0) * normal
                push *= -pressure * area * cosine
                force, torque = force + push, torque + np.cross(center - center_of_mass, push)
                size += np.linalg.norm(push)
        # The file's outlines have nine decimals, and their centres lie within a hundredth of a millimetre of those printed.
        assert np.abs(light.get(*vector("force.solar")) - force).max() < 1e-8 * size
        assert np.abs(light.get(*vector("torque.solar")) - torque).max() < 1e-5 * size
    light.close()
