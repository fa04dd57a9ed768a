"""The gallery's spacecraft, written by `heliotorque new` and flown by the missions beside them: a number of each by hand."""

import re

import numpy as np
import pytest

from spacecraft import call

G0_M_S2 = 9.80665
AU_M = 1.495978707e11
PRESSURE_N_M2 = 1361.0 / 299792458.0


def flown(heliotorque, dist, folder, kind, *words):
    """The columns of `run` of the kind's mission."""
    assert call(heliotorque, "new", kind, folder / f"{kind}.toml").returncode == 0
    mission = folder / f"{kind}-mission.toml"
    done = call(
        heliotorque, "run", mission, "--template", (dist / "MomentumPlant.fmu").resolve(), "--output", folder / "run.csv", *words
    )
    assert done.returncode == 0, done.stderr
    return np.genfromtxt(folder / "run.csv", delimiter=",", names=True, deletechars="")


def vectors(table, name):
    return np.column_stack([table[f"{name}[{axis}]"] for axis in (1, 2, 3)])


def test_torque_and_propellant_of_a_comsat(heliotorque, dist, tmp_path):
    table = flown(heliotorque, dist, tmp_path, "comsat", "--record", "torque.solar,panel[*].suns,sun.litFraction")
    # s, d of the cells; area and arm of the north wing, then of the south wing.
    at_1_au_n_m = PRESSURE_N_M2 * (1 + 0.15 + 2 * 0.05 / 3) * (30.0 * 8.2 - 24.0 * 6.95)
    lit = table["sun.litFraction"] == 1.0
    torque_n_m = np.linalg.norm(vectors(table, "torque.solar"), axis=1)[lit]
    assert np.abs(torque_n_m / (at_1_au_n_m * table["panel[1].suns"][lit]) - 1).max() < 0.03
    # The answer needs none of the further flights that `--budget` is for.
    template = (dist / "MomentumPlant.fmu").resolve()
    done = call(heliotorque, "size", tmp_path / "comsat.toml", "--template", template, "--output", tmp_path, "--budget", "0s")
    assert done.returncode == 0, done.stderr
    printed_kg = float(re.search(r"; (\S+) kg of propellant a year", done.stdout.splitlines()[0]).group(1))
    # Couples with arms of 1.1 m; mean of cos2(beta) over a year.
    elevation_rad = np.deg2rad(23.44) * np.sin(np.linspace(0, 2 * np.pi, 3600))
    impulse_n_m_s = at_1_au_n_m * 365.25 * 86400 * np.mean(np.cos(elevation_rad) ** 2)
    assert printed_kg == pytest.approx(impulse_n_m_s / (1.1 * 285.0 * G0_M_S2), rel=0.1)


def test_the_orbit_of_an_asteroid_orbiter_stands_behind_the_terminator(heliotorque, dist, tmp_path):
    table = flown(heliotorque, dist, tmp_path, "asteroid")
    radius_m, gm_m3_s2 = 1200.0, 4.89
    orbit = table["time"] <= 2 * np.pi * np.sqrt(radius_m**3 / gm_m3_s2)
    position_m, from_sun_m = vectors(table, "position")[orbit], vectors(table, "heliocentric.position")[orbit]
    # Plane through the positions by least squares, its normal toward the Sun.
    mean_m = position_m.mean(axis=0)
    normal = np.linalg.svd(position_m - mean_m)[2][2]
    normal *= -np.sign(normal @ from_sun_m[0])
    suns = (AU_M / np.linalg.norm(from_sun_m[0])) ** 2
    force_n = suns * PRESSURE_N_M2 * (10.0 * (1 + 0.1 + 2 * 0.05 / 3) + 4.8 * (1 + 0.3 + 2 * 0.2 / 3))
    behind_m = force_n / 1200.0 * radius_m**3 / gm_m3_s2
    assert -(normal @ mean_m) == pytest.approx(behind_m, rel=0.15)


def test_the_first_layer_of_a_telescopes_shield(heliotorque, dist, tmp_path):
    words = ("--stop", "1h", "--set", "shadowing.enabled=false", "--record", "plate*.force,heliocentric.position")
    assert call(heliotorque, "new", "telescope", tmp_path / "telescope.toml").returncode == 0
    file, template, fmu = tmp_path / "telescope.toml", (dist / "MomentumPlant.fmu").resolve(), tmp_path / "T.fmu"
    packed = call(heliotorque, "pack", "--spacecraft", file, "--per-plate", "--template", template, "--output", fmu)
    assert packed.returncode == 0, packed.stderr
    done = call(heliotorque, "run", fmu, "--output", tmp_path / "run.csv", *words)
    assert done.returncode == 0, done.stderr
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True, deletechars="")
    names = [name for name in table.dtype.names if re.fullmatch(r"plate\[[1-4]\]\.force\[2\]", name)]
    assert len(names) == 4, table.dtype.names
    found_n = sum(table[name][0] for name in names)
    half_m2 = (14.2 + 3.0) / 2 * np.hypot(10.6, 0.37)
    suns = (AU_M / np.linalg.norm(vectors(table, "heliocentric.position")[0])) ** 2
    assert found_n == pytest.approx(suns * PRESSURE_N_M2 * 2 * half_m2 * (1 + 0.55 + 2 * 0.2 / 3), rel=0.03)


def test_burn_and_propellant_of_a_spinners_turn(heliotorque, dist, tmp_path):
    table = flown(heliotorque, dist, tmp_path, "spinner")
    turned_rad = np.deg2rad(2.0)
    momentum_n_m_s = 215.0 * 5 * 2 * np.pi / 60
    # Two thrusters of 4.4 N, each at 0.7 m.
    burn_s = momentum_n_m_s * turned_rad / (2 * 4.4 * 0.7)
    assert table["propellant.used"][-1] == pytest.approx(2 * 4.4 * burn_s / (220.0 * G0_M_S2), rel=0.01)
    pulses, length_s = table["burn.pulsesFired"][-1], 0.032
    assert pulses * length_s == pytest.approx(2 * burn_s, rel=0.01)


@pytest.mark.parametrize("days", [5, pytest.param(365, marks=pytest.mark.long)])
def test_the_decay_of_a_cubesats_orbit(heliotorque, dist, tmp_path, days):
    names = "atmosphere.density,position,velocity"
    table = flown(heliotorque, dist, tmp_path, "cubesat", "--stop", f"{days} d", "--step", "10 min", "--record", names)
    gm_m3_s2, mass_kg = 3.986004418e14, 20.0
    position_m, velocity_m_s = vectors(table, "position"), vectors(table, "velocity")
    # Bus of 0.226 m by 0.34 m; two panels of 0.18 m2, turned about X toward the Sun: a mean of 2/pi across the flow in the orbit's plane.
    area_m2 = 0.226 * 0.34 + 0.36 * 2 / np.pi
    speed_m_s, radius_m = np.linalg.norm(velocity_m_s, axis=1), np.linalg.norm(position_m, axis=1)
    drag_m_s2 = 0.5 * table["atmosphere.density"] * speed_m_s**2 * 2.2 * area_m2 / mass_kg
    axis_m = 1 / (2 / radius_m - speed_m_s**2 / gm_m3_s2)
    by_hand_m = np.trapezoid(2 * axis_m**2 * drag_m_s2 * speed_m_s / gm_m3_s2, table["time"])
    # Energy in the field of an oblate Earth, which drag alone takes away.
    oblate_m2_s2 = gm_m3_s2 * 1.0826e-3 * 6378137.0**2 / (2 * radius_m**3) * (3 * (position_m[:, 2] / radius_m) ** 2 - 1)
    energy_m2_s2 = speed_m_s**2 / 2 - gm_m3_s2 / radius_m + oblate_m2_s2
    decay_m = -gm_m3_s2 / 2 * (1 / energy_m2_s2[0] - 1 / energy_m2_s2[-1])
    print(days, decay_m, by_hand_m)
    assert decay_m == pytest.approx(by_hand_m, rel=0.2)
