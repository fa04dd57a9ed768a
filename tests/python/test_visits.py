"""Visits of a flight by a timeline, as `run` lists them: each is a quadrature of DisturbanceTorque, and together they are the flight."""

import csv

import numpy as np
import pytest
from fmpy import extract

from simulation import DAY_S, QUATERNION, Stepped, to_body, vector
from spacecraft import RESOURCES, call

RATE_RAD_S = float(np.radians(0.05))
TIMELINE = """
[[command]]
at = 0
attitude = "sunPointing"
[[command]]
at = "1.5 d"
name = "north, then south"
attitude = [0.6, 0, 0.1, 0.793725393319377]
[[command]]
at = "3.2 d"
attitude.align = { axis = [0, 0, 1], to = "earth" }
attitude.constrain = { axis = [0, -1, 0], to = "sun" }
[[command]]
at = 432_000
until = "6.5 d"
name = "calibration"
attitude = [0, -0.8, 0.6, 0]
"""
NAMES = ["sunPointing", "north, then south", "aligned", "calibration", "-"]
# About the Sun, where nothing but sunlight turns the body; its panels stand.
SETTINGS = {
    "orbit.center": "sun", "orbit.frame": "ecliptic", "orbit.semiMajorAxis": "0.5 AU", "orbit.eccentricity": "0.05",
    "gravityGradient.enabled": "false", "keepIn.enabled": "false", "guided.slewRate": f"{RATE_RAD_S!r}", "guided.phase": "orbit",
    "spacecraft.centerOfMass": "0.01,0.02,-0.03", "panel[1].control": "angle", "panel[2].control": "angle",
    "panel[1].angle": "0.4", "panel[2].angle": "-0.3", "dump.threshold": "1e9",
}


def packed(heliotorque, dist, folder, model, name, settings, *more):
    fmu = folder / f"{name}.fmu"
    sets = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    done = call(
        heliotorque, "pack", "--template", (dist / f"{model}.fmu").resolve(), "--model", model, "--name", name, "--output", fmu,
        "--spacecraft", RESOURCES / "messenger.toml", *sets, *more,
    )
    assert done.returncode == 0, done.stderr
    return fmu


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("visits")


@pytest.fixture(scope="module")
def plant(heliotorque, dist, folder):
    timeline = folder / "week.toml"
    timeline.write_text(TIMELINE, encoding="utf-8")
    return packed(heliotorque, dist, folder, "MomentumPlant", "plant", SETTINGS, "--timeline", timeline)


def visits(heliotorque, plant, folder, name, *settings):
    table = folder / f"{name}.csv"
    record = ",".join(["momentum.inertial", "attitude.q", "dump.count"])
    done = call(heliotorque, "run", plant, "--stop", "7d", "--step", "1h", "--record", record, "--output", table, *settings)
    assert done.returncode == 0, done.stderr
    with open(folder / f"{name}-visits.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    gathered = np.array([[float(row[name]) for name in vector("momentum")] for row in rows])
    return rows, gathered, np.genfromtxt(table, delimiter=",", names=True, deletechars="", encoding="utf-8"), done.stderr


def gauss(start, end, panels=64, nodes=4):
    """Times and weights of a composite Gauss quadrature."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    edges = np.linspace(start, end, panels + 1)
    half = 0.5 * np.diff(edges)
    return (edges[:-1, None] + half[:, None] * (x + 1.0)).ravel(), (half[:, None] * w).ravel()


def test_each_visit_is_a_quadrature_and_together_they_are_the_flight(heliotorque, dist, folder, plant):
    rows, gathered, flight, printed = visits(heliotorque, plant, folder, "week")
    assert [row["name"] for row in rows] == NAMES
    edges = [0.0, 1.5 * DAY_S, 3.2 * DAY_S, 432_000.0, 6.5 * DAY_S, 7.0 * DAY_S]
    assert [float(row["begin"]) for row in rows] == edges[:-1]
    assert [float(row["end"]) for row in rows] == edges[1:]
    assert all(name in printed for name in NAMES) and "week-visits.csv" in printed
    # In its middle the Sun is on -Y where the attitude says so.
    assert np.abs([float(rows[0][name]) for name in ("sun.azimuth", "sun.elevation")]).max() < 1e-12

    unpacked = extract(str(plant), unzipdir=str(folder / "plant"))
    slewing, jumping = Stepped(unpacked), Stepped(unpacked, {"guided.slewRate": 0.0})
    light = packed(
        heliotorque, dist, folder, "DisturbanceTorque", "light",
        {"planet.present": "false", "spacecraft.centerOfMass": SETTINGS["spacecraft.centerOfMass"]},
    )
    light = Stepped(extract(str(light), unzipdir=str(folder / "light")))
    light.set(**{"panel[1].angle": 0.4, "panel[2].angle": -0.3})

    def go(flight, time_s):
        if time_s > flight.time:
            flight.step(time_s - flight.time)
            flight.time = time_s

    def torque(time_s):
        go(slewing, time_s)
        light.set(**dict(zip(vector("sun.positionBody"), slewing.get(*vector("sun.positionBody")))))
        light.step(1.0)
        turn = to_body({name: np.array([value]) for name, value in zip(QUATERNION, slewing.get(*QUATERNION))})[0]
        return turn.T @ light.get(*vector("torque.total"))

    slews = 0
    for begin, end, found in zip(edges, edges[1:], gathered):
        go(slewing, begin), go(jumping, begin)
        stands, target = slewing.get(*QUATERNION), jumping.get(*QUATERNION)
        turned = 2.0 * np.arccos(min(1.0, abs(stands @ target)))
        slews += turned > 0.1
        parts = [begin, begin + turned / RATE_RAD_S, end]
        pieces = [gauss(*part) for part in zip(parts, parts[1:]) if part[1] > part[0] + 1e-3]
        quadrature = sum(weight * torque(time_s) for times, weights in pieces for time_s, weight in zip(times, weights))
        assert np.linalg.norm(found - quadrature) < 1e-6 * np.linalg.norm(quadrature), (begin, found, quadrature)
    assert slews == 4
    momentum = np.column_stack([flight[name] for name in vector("momentum.inertial")])
    assert np.abs(gathered.sum(axis=0) - (momentum[-1] - momentum[0])).max() < 1e-13


def test_steps_on_edges_change_no_bit(heliotorque, folder, plant):
    *_, flight, _ = visits(heliotorque, plant, folder, "edges")
    plain = Stepped(extract(str(plant), unzipdir=str(folder / "plain")))
    names = vector("momentum.inertial") + QUATERNION
    for row in flight[1:100]:
        plain.step(3600.0)
        assert [row[name] for name in names] == list(plain.get(*names)), row["time"]
    plain.close()


def test_dumps_are_counted_and_leave_what_is_gathered(heliotorque, folder, plant):
    _, without, *_ = visits(heliotorque, plant, folder, "kept")
    rows, gathered, flight, _ = visits(heliotorque, plant, folder, "dumped", "--set", "dump.threshold=0.2")
    dumps = [int(row["dumps"]) for row in rows]
    assert sum(dumps) == flight["dump.count"][-1] and min(dumps[:4]) >= 1
    assert np.abs(gathered - without).max() < 1e-6 * np.abs(without).max()
