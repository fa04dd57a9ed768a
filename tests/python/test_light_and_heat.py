"""Light and heat at Mercury inside MomentumPlant, simulated by FMPy: the shadow, stored heat."""

import re
import tomllib

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from simulation import stack, vector
from spacecraft import RESOURCES, call

DAY_S = 86_400.0
FILE = RESOURCES / "examples" / "mercury-orbiter.toml"

EFFECTS = {"planetLight.enabled": True, "thermal.enabled": True, "shadowing.enabled": True}
# The orbit's plane holds the Sun: an eclipse every revolution.
ECLIPSES = {"ephemeris.source": 2, "ephemeris.trueAnomaly": 1.7, "orbit.frame": 1}
DISTURBED = {"orbit.dynamics": 2, "guided.slewRate": 3e-3, "guided.downlinkEvery": 1}


@pytest.fixture(scope="module")
def orbiter(heliotorque, dist, tmp_path_factory):
    fmu = tmp_path_factory.mktemp("orbiter") / "MercuryOrbiter.fmu"
    template = (dist / "MomentumPlant.fmu").resolve()
    packed = call(
        heliotorque, "pack", "--per-plate", "--spacecraft", FILE, "--template", template, "--name", "MercuryOrbiter",
        "--output", fmu,
    )
    assert packed.returncode == 0, packed.stderr
    return str(fmu)


def simulate(fmu, step_s, stop_s, start, output):
    return simulate_fmu(
        fmu, stop_time=stop_s, step_size=step_s, output_interval=step_s, start_values=start, output=output
    )


def test_fmpy_has_nothing_to_report(orbiter):
    assert validate_fmu(orbiter) == []


def test_every_plate_says_which_surface_it_is(orbiter):
    surfaces = tomllib.loads(FILE.read_text(encoding="utf-8"))
    expected = []
    for surface in surfaces["plates"] + surfaces["panels"]:
        expected += [surface["name"]] + [f"{surface['name']}, rear"] * ("rear_optics" in surface)
    variables = read_model_description(orbiter).modelVariables
    plates = [variable for variable in variables if re.fullmatch(r"plate\[\d+\]\.temperature", variable.name)]
    found = [plate.description.rsplit(": ", 1)[0] for plate in plates]
    assert found == expected and len(set(found)) == len(found)


def test_in_the_shadow_heat_alone_pushes(orbiter):
    output = ["sun.litFraction", *vector("force.solar"), *vector("force.thermal")]
    recorded = simulate(orbiter, 60.0, DAY_S, {**EFFECTS, **ECLIPSES, **DISTURBED}, output)
    dark = recorded["sun.litFraction"] == 0.0
    assert 10 < dark.sum() < len(recorded) / 2
    assert not stack(recorded, "force.solar")[dark].any()
    # The spacecraft is its own mirror image across its Y-Z plane: the recoil of heat lies within it.
    thermal = np.abs(stack(recorded, "force.thermal")[dark])
    assert thermal[:, 1:].max(axis=1).min() > 1e-9 and thermal[:, 0].max() < 1e-20


def test_stored_heat_does_not_jump_where_light_does(orbiter):
    start = {**EFFECTS, **ECLIPSES}
    output = ["sun.litFraction", "plate[7].temperature", "plate[1].temperature"]
    stored, balanced = (
        simulate(orbiter, 10.0, 0.6 * DAY_S, {**start, "thermal.storage": storage}, output) for storage in (True, False)
    )
    # At most the sunlight absorbed in 10 s, 35 % of 13 kW/m2, over the heat capacity; a radiator sees the planet alone.
    for plate, moved_k in (("plate[1].temperature", 0.35 * 13e3 * 10.0 / 900.0), ("plate[7].temperature", 5.0)):
        assert np.abs(np.diff(stored[plate])).max() < moved_k
    # In balance the shade's front falls by hundreds of kelvin from one sample to the next two.
    assert np.abs(balanced["plate[1].temperature"][3:] - balanced["plate[1].temperature"][:-3]).max() > 150.0
