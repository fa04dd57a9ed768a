"""A planet given cell by cell in the spacecraft's file: DisturbanceTorque sums its light, by local time."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from spacecraft import RESOURCES, call

SPACECRAFT = (RESOURCES / "messenger-thermal.toml").read_text(encoding="utf-8")
STEFAN_BOLTZMANN = 5.670374419e-8
BELTS = 8
MAP = {"planetLight.method": 3}
FORCES = [f"force.{effect}[{i}]" for effect in ("albedo", "infrared") for i in (1, 2, 3)]


def planet_map(temperature_k, diffuse=0.12, emissivity=0.9):
    """The section of the file; `temperature_k` by belt and column."""
    def rows(value):
        return [[float(value(belt, column)) for column in range(2 * BELTS)] for belt in range(BELTS)]
    keys = {"diffuse_reflectivity": lambda *_: diffuse, "emissivity": lambda *_: emissivity, "temperature_k": temperature_k}
    return "\n[planet_map]\n" + "".join(f"{key} = {rows(value)}\n" for key, value in keys.items())


@pytest.fixture
def pack(heliotorque, dist, tmp_path):
    def packed(section):
        (tmp_path / "spacecraft.toml").write_text(SPACECRAFT + section, encoding="utf-8")
        fmu = tmp_path / "Craft.fmu"
        done = call(
            heliotorque, "pack", "--spacecraft", tmp_path / "spacecraft.toml", "--template", (dist / "DisturbanceTorque.fmu").resolve(),
            "--name", "Craft", "--output", fmu,
        )
        assert done.returncode == 0, done.stderr
        return str(fmu)
    return packed


def forces(fmu, start, **options):
    result = simulate_fmu(fmu, stop_time=60, step_size=60, start_values=start, output=FORCES, **options)
    return np.array([result[name][-1] for name in FORCES]).reshape(2, 3)


def test_a_map_of_the_planets_own_temperatures_is_the_planet(pack):
    place = {"sun.positionBody[2]": -6.0e10, "planet.positionBody[1]": 1e6, "planet.positionBody[2]": 3.5e6, "planet.positionBody[3]": -2e6}
    sun_from_planet = np.array([0.0, -6.0e10, 0.0]) - [1e6, 3.5e6, -2e6]
    # Paper 004 eq 32: the day side radiates twice what a quarter of its own area would absorb square to the Sun.
    flux = 1365.0 * (1.495978707e11 / np.linalg.norm(sun_from_planet)) ** 2
    day_k = (0.88 * flux / (2 * 0.9 * STEFAN_BOLTZMANN)) ** 0.25

    fmu = pack(planet_map(lambda belt, column: day_k if BELTS / 2 <= column < 3 * BELTS / 2 else 100.0))
    cells = forces(fmu, {**place, "planetLight.method": 2, "planetLight.belts": BELTS})
    assert np.linalg.norm(cells, axis=1).min() > 1e-8
    assert np.allclose(forces(fmu, {**place, **MAP}), cells, rtol=0.0, atol=1e-7 * np.linalg.norm(cells))


@pytest.mark.parametrize("hot, columns", [("evening", range(BELTS, 2 * BELTS)), ("morning", range(BELTS))])
def test_columns_run_from_midnight_over_morning_to_evening(pack, hot, columns):
    fmu = pack(planet_map(lambda belt, column: 500.0 if column in columns else 0.0, diffuse=0.0))
    # The Sun at -Y, north at -Z: a place on the planet turns from the Sun toward -X, where its evening is.
    for side, lit in ((+1, hot == "evening"), (-1, hot == "morning")):
        place = {"planet.positionBody[1]": side * 3.6e6, "planet.positionBody[2]": 0.0, "planet.positionBody[3]": 0.0}
        albedo, infrared = forces(fmu, {**place, **MAP})
        assert not albedo.any() and infrared.any() == lit
        # Light pushes away from the planet.
        assert not lit or -side * infrared[0] > 1e-7


def test_belts_run_from_south_to_north(pack):
    fmu = pack(planet_map(lambda belt, column: 500.0 if belt >= BELTS / 2 else 0.0))
    seen = []
    for above in (-1, +1):
        # North is at -Z: a spacecraft there has the planet at +Z.
        place = {"planet.positionBody[1]": 0.0, "planet.positionBody[2]": 0.0, "planet.positionBody[3]": above * 3.6e6}
        seen.append(forces(fmu, {**place, **MAP})[1])
    assert not seen[0].any() and -seen[1][2] > 1e-7
    # The other pole as north turns it over.
    place["planet.pole[3]"] = 1.0
    assert not forces(fmu, {**place, **MAP})[1].any()


def test_without_a_map_the_method_is_refused_by_name(dist):
    messages = []
    with pytest.raises(FMICallException):
        forces(str(dist / "DisturbanceTorque.fmu"), MAP, logger=lambda *message: messages.append(message[-1].decode()))
    assert any("planetLight.method is map, allowed only where the spacecraft's file has a planet_map" in it for it in messages), messages


def test_a_torn_map_is_told_by_line_and_cell(heliotorque, tmp_path):
    section = planet_map(lambda belt, column: -5.0 if (belt, column) == (2, 3) else 300.0)
    damaged = section.replace("emissivity = [[0.9", "emissivity = [[1.5").replace("0.9, 0.9]]", "0.9]]")
    assert len(section) - len(damaged) == len("0.9, ")
    (tmp_path / "damaged.toml").write_text(SPACECRAFT + damaged, encoding="utf-8")
    checked = call(heliotorque, "check", tmp_path / "damaged.toml")
    assert checked.returncode == 1
    text = checked.stdout + checked.stderr
    for words in (
        "planet_map.temperature_k[3][4]: found -5", "allowed: a number from 0 to 10000 K",
        "planet_map.emissivity[8]: found 15 cells, allowed: 16", "planet_map.emissivity[1][1]: found 1.5",
    ):
        assert words in text, text[:3000]
