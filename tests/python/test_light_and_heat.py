"""Light and heat at Mercury inside MomentumPlant, simulated by FMPy: albedo against a plain sum over the planet's surface, the
shadow, stored heat."""

import re
import tomllib

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from simulation import QUATERNION, stack, to_body, vector
from spacecraft import RESOURCES, call

DAY_S = 86_400.0
LIGHT_M_S = 299_792_458.0
AU_M = 1.495978707e11
RADIUS_M, FLUX_W_M2, REFLECTED = 2.4394e6, 1353.0, 0.12
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
    flown = simulate(orbiter, 60.0, DAY_S, {**EFFECTS, **ECLIPSES, **DISTURBED}, output)
    dark = flown["sun.litFraction"] == 0.0
    assert 10 < dark.sum() < len(flown) / 2
    assert not stack(flown, "force.solar")[dark].any()
    # The spacecraft is its own mirror image across its Y-Z plane: the recoil of heat lies within it.
    thermal = np.abs(stack(flown, "force.thermal")[dark])
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


def albedo_force(result, row, spacecraft):
    """Force of reflected sunlight in the body frame: a sum over squares of the planet's surface."""
    def at(name):
        return np.array([result[element][row] for element in vector(name)])

    body = to_body(result)[row]
    position, sun = at("position"), at("position") - at("heliocentric.position")
    # Rings about the point below the spacecraft, up to its horizon.
    up = position / np.linalg.norm(position)
    east = np.cross(up, [0.3, -0.5, 0.8])
    east /= np.linalg.norm(east)
    north = np.cross(up, east)
    rings, spokes = 400, 800
    horizon = np.arccos(RADIUS_M / np.linalg.norm(position))
    # More rings near the nadir, where a low spacecraft sees most.
    edges = horizon * np.linspace(0.0, 1.0, rings + 1) ** 2
    angle, width = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    azimuth = (np.arange(spokes) + 0.5) * 2.0 * np.pi / spokes
    place = (
        np.cos(angle)[:, None, None] * up
        + np.sin(angle)[:, None, None] * (np.cos(azimuth)[None, :, None] * east + np.sin(azimuth)[None, :, None] * north)
    )
    area = RADIUS_M**2 * np.sin(angle) * width * 2.0 * np.pi / spokes
    to_cell = RADIUS_M * place - position
    distance = np.linalg.norm(to_cell, axis=2)
    direction = to_cell / distance[:, :, None]
    lit = np.maximum(0.0, place @ (sun / np.linalg.norm(sun)))
    leaving = REFLECTED * FLUX_W_M2 * (AU_M / np.linalg.norm(sun)) ** 2 * lit
    seen = np.maximum(0.0, -np.einsum("rsk,rsk->rs", direction, place))
    pressure = leaving * seen * area[:, None] / (np.pi * distance**2 * LIGHT_M_S)
    direction = direction @ body.T

    force = np.zeros(3)
    for normal, area_m2, optics in faces(spacecraft, [result[f"panel[{k}].angleActual"][row] for k in (1, 2)]):
        cosine = np.maximum(0.0, direction @ normal)
        specular, diffuse = optics["specular"], optics["diffuse"]
        received = pressure * cosine * area_m2
        along = -(1.0 - specular) * np.einsum("rs,rsk->k", received, direction)
        force += along - 2.0 * ((specular * received * cosine).sum() + diffuse / 3.0 * received.sum()) * normal
    return force


def faces(spacecraft, angles):
    for surface in spacecraft["plates"] + spacecraft["panels"]:
        corners = np.array(surface["polygon_m"])
        across = sum(np.cross(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True))
        area_m2 = 0.5 * np.linalg.norm(across)
        if "axis" in surface:
            angle = angles[spacecraft["panels"].index(surface)]
            axis, zero = np.array(surface["axis"]), np.array(surface["zero_normal"])
            normal = np.cos(angle) * zero + np.sin(angle) * np.cross(axis, zero)
        else:
            normal = np.array(surface["normal"])
        yield normal, area_m2, spacecraft["optics"][surface["optics"]]
        if "rear_optics" in surface:
            yield -normal, area_m2, spacecraft["optics"][surface["rear_optics"]]


def test_albedo_is_a_sum_over_the_planets_surface(orbiter):
    spacecraft = tomllib.loads(FILE.read_text(encoding="utf-8"))
    output = [
        *QUATERNION, *vector("position"), *vector("heliocentric.position"), *vector("force.albedo"),
        "panel[1].angleActual", "panel[2].angleActual",
    ]
    start = {"planetLight.enabled": True, "planet.radius": RADIUS_M, "solar.flux": FLUX_W_M2, "planetLight.nodes": 12,
             "planet.diffuseReflectivity": REFLECTED, "solver.disturbanceTolerance": 1e-8}
    # From periapsis out to several radii.
    result = simulate(orbiter, 400.0, 6_000.0, start, output)
    ours = stack(result, "force.albedo")
    compared = 0
    for row in range(len(result)):
        expected = albedo_force(result, row, spacecraft)
        size = np.linalg.norm(expected)
        if size > 0.0:
            compared += size > 1e-6
            assert np.linalg.norm(ours[row] - expected) < 1e-3 * size, result["time"][row]
    assert compared > 9
