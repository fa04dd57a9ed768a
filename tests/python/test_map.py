"""`heliotorque map`: its torque is that of DisturbanceTorque in FMPy and of the flat-plate law; missions leave the band when they dump."""

import csv
import io
import re

import numpy as np
import pytest
from fmpy import extract

from simulation import DAY_S, Stepped, vector
from spacecraft import RESOURCES, SAILER, call, pack, solar_torque

AU_M = 149_597_870_700.0


def direction(azimuth_deg, elevation_deg):
    azimuth, elevation = np.radians([azimuth_deg, elevation_deg])
    return np.array([
        np.cos(elevation) * np.sin(azimuth),
        -np.cos(elevation) * np.cos(azimuth),
        -np.sin(elevation),
    ])


def mapped(heliotorque, dist, spacecraft, *arguments):
    """Rows of the CSV as numbers."""
    done = call(
        heliotorque, "map", spacecraft, "--template", (dist / "MomentumPlant.fmu").resolve(), "--output", "-", "--quiet",
        *arguments,
    )
    assert done.returncode == 0, done.stderr
    return [{name: float(cell) for name, cell in row.items()} for row in csv.DictReader(io.StringIO(done.stdout))]


def torque(row):
    return np.array([row[f"torque_{axis}_n_m"] for axis in "xyz"])


@pytest.mark.parametrize("name", ["messenger", "messenger-full", "examples/mercury-orbiter", "examples/sunshield-telescope"])
def test_directions_are_as_in_fmpy(heliotorque, dist, tmp_path, name):
    path = RESOURCES / f"{name}.toml"
    rows = mapped(heliotorque, dist, path, "--distance", "0.35", "--step", "5deg")
    assert len(rows) == 72 * 37
    fmu = pack(heliotorque, dist, tmp_path, path.read_text(encoding="utf-8"), "Torque", "DisturbanceTorque.fmu")
    stepped = Stepped(extract(fmu, unzipdir=str(tmp_path / "unpacked")), {"planet.present": False})
    panels = sum(column.startswith("panel_") for column in rows[0])
    greatest = max(np.linalg.norm(torque(row)) for row in rows)
    for row in rows[::7]:
        sun_m = 0.35 * AU_M * direction(row["sun_azimuth_deg"], row["sun_elevation_deg"])
        angles = {f"panel[{k}].angle": np.radians(row[f"panel_{k}_angle_deg"]) for k in range(1, panels + 1)}
        stepped.set(**dict(zip(vector("sun.positionBody"), sun_m)), **angles)
        stepped.step(1.0)
        # Sines and cosines of two libraries differ in the last digit.
        assert np.abs(stepped.get(*vector("torque.solar")) - torque(row)).max() <= 1e-13 * greatest, row
        force = [row[f"force_{axis}_n"] for axis in "xyz"]
        found = stepped.get(*vector("force.solar"))
        assert np.abs(found - force).max() <= 1e-13 * max(np.linalg.norm(found), 1e-9), row
    stepped.close()


def test_directions_follow_the_flat_plate_law(heliotorque, dist, tmp_path):
    spacecraft = tmp_path / "sailer.toml"
    spacecraft.write_text(SAILER, encoding="utf-8")
    rows = mapped(
        heliotorque, dist, spacecraft, "--distance", "1", "--step", "10deg", "--set", "solar.flux=1361"
    )
    pressure = 1361.0 / 299_792_458.0
    greatest = max(np.linalg.norm(torque(row)) for row in rows)
    for row in rows:
        sun = direction(row["sun_azimuth_deg"], row["sun_elevation_deg"])
        angles = [np.radians(row[f"panel_{k}_angle_deg"]) for k in (1, 2, 3)]
        assert np.abs(solar_torque(SAILER, sun, pressure, angles) - torque(row)).max() <= 1e-12 * greatest, row


def interval_day(simulated, least, most):
    """The day on which no momentum about X is left that downlinks could have led to within 4 N.m.s."""
    with open(simulated, encoding="utf-8") as file:
        rows = [{name: float(cell) for name, cell in row.items()} for row in csv.DictReader(file)]
    low = high = 0.0
    for before, now in zip(rows, rows[1:]):
        span = now["time"] - before["time"]
        if "torque.total[1]" in now:
            gained = 0.5 * span * (before["torque.total[1]"] + now["torque.total[1]"])
            light = 0.5 * sum((0.3870990 * AU_M / row["sun.distance"]) ** 2 for row in (before, now))
        else:
            gained, light = now["momentum.body[1]"] - before["momentum.body[1]"], 1.0
            # A dump's own change is as small as its neighbours'.
            gained = usual if now["dump.count"] != before["dump.count"] else gained
        usual = gained
        low, high = low + gained + light * span * least, high + gained + light * span * most
        if low > 4.0 or high < -4.0:
            return now["time"] / DAY_S
        low, high = max(low, -4.0), min(high, 4.0)
    return np.inf


@pytest.mark.parametrize("columns", ["torque.total,sun.distance", "momentum.body,dump.count"])
def test_a_mission_leaves_the_band_when_it_dumps(heliotorque, dist, tmp_path, columns):
    settings = [
        *("--set", "momentum.convention=bodyIntegral", "--set", "spacecraft.centerOfMass[3]=-2.54cm"),
        *("--set", "dump.threshold=4,4,4"),
    ]
    plant = (dist / "MomentumPlant.fmu").resolve()
    simulated, when = tmp_path / "simulated.csv", tmp_path / "when.csv"
    for output, record in [(simulated, columns), (when, "dump.lastTime,dump.count")]:
        done = call(
            heliotorque, "run", plant, "--stop", "60d", "--step", "600", "--record", record, "--output", output, "--quiet", *settings
        )
        assert done.returncode == 0, done.stderr
    with open(when, encoding="utf-8") as file:
        first_s = next(float(row["dump.lastTime"]) for row in csv.DictReader(file) if row["dump.count"] == "1")
    arguments = ["--recording", simulated, "--no-picture", "--step", "10deg", "--set", "spacecraft.centerOfMass[3]=-2.54cm"]
    arguments += ["--set", "dump.threshold=4,4,4"]
    told = call(heliotorque, "map", RESOURCES / "messenger.toml", "--template", plant, *arguments)
    assert told.returncode == 0, told.stderr
    [day] = re.findall(r"without targets in downlinks until day ([\d.]+) of 60.0", told.stdout)
    assert abs(float(day) - first_s / DAY_S) < 0.06, told.stdout
    # Z is held with ease, so X decides, between what the table says downlinks can add at the least and at the most.
    least, most = np.array(re.search(r"mean torque about X +(\S+) +(\S+)", told.stdout).groups(), dtype=float) * 1e-6
    held = re.search(r"holdable without a dump until day ([\d.]+) of 60.0", told.stdout)
    expected = interval_day(simulated, least, most)
    assert abs(float(held[1]) - expected) < 0.06, (expected, told.stdout)
    assert expected > float(day) + 5
    # Without downlinks nothing is held any longer.
    told = call(heliotorque, "map", RESOURCES / "messenger.toml", "--template", plant, *arguments, "--set", "guided.downlinkEvery=0")
    assert f"holdable without a dump until day {day} of 60.0" in told.stdout, told.stdout
