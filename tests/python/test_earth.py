"""The Earth about Cubesat.fmu: its orientation and heights by pyerfa, its magnetic field by ppigrf, a day's loads by Basilisk."""

import shlex
from datetime import datetime

import erfa
import numpy as np
import ppigrf
import pytest
from fmpy import extract

from simulation import DAY_S, QUATERNION, basilisk_table, columns, simulate, stack, to_body, vector
from spacecraft import RESOURCES, call, pack, urchin
from studies import table

ARCSECOND = np.radians(1.0 / 3600.0)
# IERS Bulletin A's UT1 - UTC on each 1 January to 0.1 s: any value serves, so long as both have it.
YEARS = {2015: -0.5, 2020: -0.2, 2025: 0.0, 2030: 0.3}
GEODETIC = ["geodetic.latitude", "geodetic.longitude", "geodetic.height"]


@pytest.fixture(scope="session")
def cubesat(dist, tmp_path_factory):
    return extract(str(dist / "Cubesat.fmu"), unzipdir=str(tmp_path_factory.mktemp("Cubesat")))


def epoch(year):
    """TDB seconds past J2000 of a 1 January, 00:00 UTC, and its UTC and TT as ERFA's two-part dates."""
    utc = erfa.dtf2d("UTC", year, 1, 1, 0, 0, 0.0)
    tt = erfa.taitt(*erfa.utctai(*utc))
    # TDB by the annual term, within 50 us.
    days = (tt[0] - erfa.DJ00) + tt[1]
    anomaly = np.radians(357.53 + 0.985_600_28 * days)
    return days * DAY_S + 0.001_657 * np.sin(anomaly), utc, tt


def terrestrial(utc, tt, offset_s, time_s=0.0):
    """The matrix from GCRS to ITRS by IAU 2006/2000A, without polar motion."""
    ut1 = utc[0], utc[1] + (offset_s + time_s) / DAY_S
    return erfa.c2t06a(tt[0], tt[1] + time_s / DAY_S, *ut1, 0.0, 0.0)


def by_erfa(position, matrix):
    """Geodetic longitude, latitude and height over WGS84."""
    return erfa.gc2gd(erfa.WGS84, matrix @ position)


@pytest.mark.filterwarnings("ignore:.*dubious year")
@pytest.mark.parametrize("year", YEARS)
def test_latitude_longitude_and_height_are_erfas_within_an_arcsecond(cubesat, year):
    start_s, utc, tt = epoch(year)
    names = vector("position") + GEODETIC
    # The field's model ends in 2030.
    start = {"start.epoch": start_s, "earth.ut1Offset": YEARS[year], "magnetics.enabled": False}
    result = simulate(cubesat, days=0.5, start=start, output=names)
    worst = 0.0
    for row in result:
        position = np.array([row[name] for name in names[:3]])
        longitude, latitude, height = by_erfa(position, terrestrial(utc, tt, YEARS[year], row["time"]))
        east = (row["geodetic.longitude"] - longitude + np.pi) % (2.0 * np.pi) - np.pi
        away = np.hypot(row["geodetic.latitude"] - latitude, east * np.cos(latitude))
        worst = max(worst, away / ARCSECOND)
        # An arcsecond turns a place into another height by the flattening, some 0.2 m.
        assert abs(row["geodetic.height"] - height) < 0.2
    assert worst < 1.0, worst


def test_a_second_of_ut1_turns_the_earth_by_fifteen_arcseconds(cubesat):
    start_s, _, _ = epoch(2020)
    longitudes = []
    for offset_s in (0.0, 1.0):
        start = {"start.epoch": start_s, "earth.ut1Offset": offset_s}
        result = simulate(cubesat, days=0.0, start=start, output=GEODETIC)
        longitudes.append(result["geodetic.longitude"][0])
    assert abs((longitudes[0] - longitudes[1]) / ARCSECOND - 15.041_067) < 1e-3


@pytest.mark.parametrize("year", (2015, 2020, 2025))
def test_the_field_is_that_of_ppigrf(cubesat, year):
    """At a 1 January of its table, where neither interpolates in time, all round an orbit over both poles.

    Size and radial part do not depend on the frame, which leaves the direction in EME2000 to an arcsecond.
    """
    start_s, utc, tt = epoch(year)
    to_inertial = terrestrial(utc, tt, 0.0).T
    names = vector("position") + vector("magneticField.inertial") + GEODETIC
    for anomaly in np.radians(np.arange(0.0, 360.0, 45.0)):
        start = {"start.epoch": start_s, "orbit.trueAnomaly": anomaly, "atmosphere.tolerance": 1e-12}
        row = simulate(cubesat, days=0.0, start=start, output=names)
        position, field = stack(row, "position")[0], stack(row, "magneticField.inertial")[0]
        latitude, longitude, height = (row[name][0] for name in GEODETIC)
        fixed = erfa.gd2gc(erfa.WGS84, longitude, latitude, height)
        radius = np.linalg.norm(fixed)
        up = fixed / radius
        place = radius / 1e3, np.degrees(np.arccos(up[2])), np.degrees(longitude)
        radial, south, east = (1e-9 * part.item() for part in ppigrf.igrf_gc(*place, datetime(year, 1, 1)))
        size = np.sqrt(radial**2 + south**2 + east**2)
        assert abs(np.linalg.norm(field) - size) < 1e-9 * size
        assert abs(field @ position / radius - radial) < 1e-9 * size
        easterly = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
        expected = to_inertial @ (radial * up + south * np.cross(easterly, up) + east * easterly)
        assert np.linalg.norm(field - expected) < ARCSECOND * size


def test_loads_along_a_day_are_basilisks_at_equal_density_and_field(heliotorque, dist, tmp_path):
    """`earth_basilisk.py` writes what it simulates: ten plates that tumble, the air co-rotating, a dipole in three torque bars."""
    rows = basilisk_table("earth-basilisk")
    fmu = pack(heliotorque, dist, tmp_path, urchin(10), "Urchin")
    body = extract(fmu, unzipdir=str(tmp_path / "unpacked"))
    start = {"orbit.center": 4, "orbit.source": 2, "attitude.source": 2, "aerodynamics.enabled": True, "magnetics.enabled": True}
    start |= {"aerodynamics.law": 1, "atmosphere.method": 3, "magneticField.method": 3, "planet.orientation": 1}
    # A pole along Z of EME2000, and Basilisk's constants.
    start |= {"planet.poleDeclination": np.pi / 2.0, "planet.rotationRate": 7.292_115_373_194e-5}
    start |= {"planet.gravitationalParameter": 3.986_004_355_07e14}
    start |= dict(zip(vector("dipole.residual"), (0.5, -0.3, 0.8)))
    loads = [vector(name) for name in ("force.aerodynamic", "torque.aerodynamic", "torque.magnetic", "torque.gravityGradient")]
    given = [name for name in rows.dtype.names if name.startswith(("orbit.", "command.", "atmosphere.", "magneticField."))]
    found = []
    for row in rows:
        at = start | {name: row[name] for name in given}
        found.append(simulate(body, days=0.0, start=at, output=[*sum(loads, []), *GEODETIC])[0])
    found = np.array(found)
    for names in loads:
        expected = columns(rows, names)
        assert np.abs(expected).max() > 1e-6
        assert np.abs(columns(found, names) - expected).max() < 1e-6 * np.abs(expected).max()
    # Basilisk's heights count from a sphere of the equator's radius: over the poles its air is that of 21 km below.
    expected = erfa.gc2gd(erfa.WGS84, columns(rows, vector("orbit.position")))[2]
    assert np.abs(found["geodetic.height"] - expected).max() < 1e-3
    higher_m = expected - rows["height"]
    assert abs(higher_m.min()) < 1.0 and 20e3 < higher_m.max() < 21.4e3


# A day of the file's epoch, which is midnight UTC, and two hours about midnight, when the air's model goes on to another day.
@pytest.mark.parametrize(("epoch", "hours"), [("2024-03-20 UTC", 24), ("2024-03-20T23:00:00 UTC", 2)])
def test_bits_are_the_same_in_steps_of_ten_seconds_and_of_ten_minutes(heliotorque, dist, tmp_path, epoch, hours):
    recorded = [part for name in ("torque.*", "atmosphere.*", "magneticField.*", "geodetic.*") for part in ("--record", name)]
    tables = []
    for step in ("10s", "600s"):
        file = tmp_path / f"{step}.csv"
        times = ("--stop", f"{hours}h", "--step", step, "--set", f"start.epoch={epoch}")
        done = call(heliotorque, "run", (dist / "Cubesat.fmu").resolve(), *times, *recorded, "--output", file, "--quiet")
        assert done.returncode == 0, done.stderr
        tables.append(file.read_text(encoding="utf-8").splitlines())
    fine, coarse = tables
    assert fine[0] == coarse[0] and "atmosphere.density" in fine[0]
    assert len(fine) == 360 * hours + 2 and len(coarse) == 6 * hours + 2
    assert coarse[1:] == fine[1::60]


# Through every height at which the model of the air changes its form.
ELLIPSE = {"orbit.semiMajorAxis": "7468137", "orbit.eccentricity": "0.121837"}


def test_a_day_between_180_and_2000_km_stays_in_the_work_budget(heliotorque, dist):
    every = {name: "true" for name in ("planetLight.enabled", "thermal.enabled", "gravityGradient.flattening")}

    def run(limit):
        values = ELLIPSE | every | {"solver.workLimit": limit}
        settings = [part for name, value in values.items() for part in ("--set", f"{name}={value}")]
        return call(heliotorque, "run", (dist / "Cubesat.fmu").resolve(), "--stop", "1d", "--step", "1d", *settings)

    # Of the default a twentieth; it takes some 380,000.
    done = run(1_000_000)
    assert done.returncode == 0, done.stderr
    done = run(200_000)
    assert done.returncode != 0 and "solver.workLimit = 200000" in done.stderr, done.stderr


@pytest.mark.parametrize(
    ("name", "value", "allowed"), [("spaceWeather.f107", -1, "0.0 to 1000.0"), ("spaceWeather.ap", 401, "0.0 to 400.0")]
)
def test_space_weather_outside_its_range_is_refused_by_name(heliotorque, dist, name, value, allowed):
    times = ("--stop", "60s", "--step", "60s", "--set", f"{name}={value}")
    done = call(heliotorque, "run", (dist / "Cubesat.fmu").resolve(), *times)
    assert done.returncode != 0
    assert f"`{name}`" in done.stderr and f"set to {value}.0, allowed is {allowed}" in done.stderr, done.stderr


@pytest.mark.parametrize("name", ["aerodynamics.enabled", "magnetics.enabled"])
def test_the_log_says_that_an_effect_follows_the_earth_unless_it_is_set(heliotorque, dist, name):
    command = ("run", (dist / "Cubesat.fmu").resolve(), "--stop", "60s", "--step", "60s", "--log")
    line = f"{name} = true, as about the Earth unless it is set"
    for settings, count in (((), 1), (("--set", f"{name}=true"), 0), (("--set", f"{name}=false"), 0)):
        done = call(heliotorque, *command, *settings)
        assert done.returncode == 0 and (done.stdout + done.stderr).count(line) == count, done.stderr


def test_wind_comes_from_the_velocity_along_east_north_and_up(cubesat):
    """Local axes where the geodetic latitude has them, turned to EME2000 by pyerfa."""
    start_s, utc, tt = epoch(2020)
    to_inertial = terrestrial(utc, tt, YEARS[2020]).T
    names = vector("position") + vector("atmosphere.velocityBody") + QUATERNION
    found = []
    for wind in np.vstack([np.zeros(3), 300.0 * np.eye(3)]):
        start = {"start.epoch": start_s, "earth.ut1Offset": YEARS[2020], "orbit.trueAnomaly": 0.7}
        start |= dict(zip(vector("atmosphere.wind"), wind))
        found.append(simulate(cubesat, days=0.0, start=start, output=names))
    still = found[0]
    longitude, latitude, _ = by_erfa(stack(still, "position")[0], to_inertial.T)
    east = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
    up = np.array([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)])
    for axis, row in zip((east, np.cross(up, east), up), found[1:]):
        change = stack(row, "atmosphere.velocityBody")[0] - stack(still, "atmosphere.velocityBody")[0]
        expected = -300.0 * to_body(still)[0] @ to_inertial @ axis
        assert np.linalg.norm(change - expected) < ARCSECOND * 300.0


def test_the_example_of_500_kg_is_simulated_for_an_hour(heliotorque, dist, tmp_path):
    text = (RESOURCES / "examples" / "leo-500kg.toml").read_text(encoding="utf-8")
    body = extract(pack(heliotorque, dist, tmp_path, text, "Leo"), unzipdir=str(tmp_path / "unpacked"))
    loads = ("torque.solar", "torque.gravityGradient", "torque.aerodynamic", "torque.magnetic", "force.aerodynamic")
    names = [*sum(map(vector, loads), []), *vector("velocity"), *QUATERNION, "geodetic.height"]
    result = simulate(body, step_s=60.0, days=1.0 / 24.0, output=names)
    # 500 km by the equator's radius; over the poles 21 km more, and as much again by the flattening's short periods.
    assert len(result) == 61 and (np.abs(result["geodetic.height"] - 530e3) < 40e3).all()
    for load in loads:
        assert np.isfinite(stack(result, load)).all() and np.abs(stack(result, load)).max() > 1e-9, load
    # Drag: against the velocity, within what the turning air and lift make of it.
    velocity = np.einsum("nij,nj->ni", to_body(result), stack(result, "velocity"))
    force = stack(result, "force.aerodynamic")
    cosine = (force * velocity).sum(axis=1) / np.linalg.norm(force, axis=1) / np.linalg.norm(velocity, axis=1)
    assert (cosine < -0.99).all(), cosine


def test_plant_and_disturbance_torque_joined_by_wire_have_equal_torques(heliotorque, dist, tmp_path):
    """What the plant reports at one communication point DisturbanceTorque has in the next step, by its own surfaces, dipole and inertia."""
    text = (RESOURCES / "examples" / "cubesat-12u.toml").read_text(encoding="utf-8")
    text = text.partition("[start]")[0] + '[start]\n"orbit.center" = "earth"\n'
    light = pack(heliotorque, dist, tmp_path, text, "Light", "DisturbanceTorque.fmu")
    ssp, file = tmp_path / "loop.ssp", tmp_path / "loop.csv"
    wired = call(heliotorque, "wire", f"plant={(dist / 'Cubesat.fmu').resolve()}", f"light={light}", "--output", ssp)
    assert wired.returncode == 0, wired.stderr
    both = {"aerodynamics.law": "sentman", "aerodynamics.shadowing": "true", "dipole.residual": "0.02,-0.03,0.05"}
    both["gravityGradient.flattening"] = "true"
    values = {f"{part}.{name}": value for part in ("plant", "light") for name, value in both.items()}
    values |= {"light.aerodynamics.enabled": "true", "light.magnetics.enabled": "true"}
    settings = [part for name, value in values.items() for part in ("--set", f"{name}={value}")]
    effects = ("aerodynamic", "magnetic", "gravityGradient", "solar")
    names = [f"{part}.torque.{effect}" for part in ("plant", "light") for effect in effects]
    recorded = [part for name in names for part in ("--record", name)]
    times = ("--stop", "6000", "--step", "60", "--master", "jacobi")
    done = call(heliotorque, "run", ssp, *times, *settings, *recorded, "--output", file, "--quiet")
    assert done.returncode == 0, done.stderr
    result = np.genfromtxt(file, delimiter=",", names=True, deletechars="", encoding="utf-8")
    for effect in effects:
        plant, light = (columns(result, vector(f"{part}.torque.{effect}")) for part in ("plant", "light"))
        assert np.abs(plant).max() > 1e-9
        assert np.abs(light[1:] - plant[:-1]).max() <= 1e-14 * np.abs(plant).max()


def test_the_tutorials_spacecraft_gets_all_four_torques_in_one_picture(heliotorque, dist, tmp_path):
    book = RESOURCES.parents[1] / "docs" / "src" / "tutorial"
    command = "run EarthSurveyor.fmu --stop 3h --step 1min --record 'torque.*' --output torques.svg"
    assert f"$ heliotorque {command}\n" in (book / "low-earth-orbit.md").read_text(encoding="utf-8")
    pack(heliotorque, dist, tmp_path, (book / "leo.toml").read_text(encoding="utf-8"), "EarthSurveyor")
    done = call(heliotorque, *shlex.split(command), "--output", "torques.csv", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    rows = np.genfromtxt(tmp_path / "torques.csv", delimiter=",", names=True, deletechars="", encoding="utf-8")
    picture = (tmp_path / "torques.svg").read_text(encoding="utf-8")
    shown = (book.parent / "pictures" / "torques.svg").read_text(encoding="utf-8")
    for effect in ("solar", "gravityGradient", "aerodynamic", "magnetic"):
        assert np.abs(columns(rows, vector(f"torque.{effect}"))).max() > 1e-6, effect
        assert all(f">torque.{effect} [uN.m]</text>" in drawn for drawn in (picture, shown)), effect
    assert "torque.albedo" not in picture


EFFECTS = {
    "gravity gradient": ["gravityGradient"], "air": ["aerodynamic"], "magnetic field": ["magnetic"], "sunlight": ["solar"],
    "planet light (reflected and infrared)": ["albedo", "infrared"],
}


def test_the_study_of_a_day_is_what_fmpy_simulates(studied, cubesat):
    text, files = studied("earth/day")
    rows = table(files, "day.csv")
    effects = [effect for together in EFFECTS.values() for effect in together]
    names = [name for effect in effects for kind in ("torque", "momentum") for name in vector(f"{kind}.{effect}")]
    result = simulate(cubesat, step_s=60.0, days=1.0, output=["atmosphere.density", *names])
    assert [float(row["time [s]"]) for row in rows] == list(result["time"])

    def same(column, expected):
        found = np.array([float(row[column]) for row in rows])
        assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max(), column

    same("density [kg/m3]", result["atmosphere.density"])
    for effect, together in EFFECTS.items():
        sizes = [np.linalg.norm(sum(stack(result, f"{kind}.{it}") for it in together), axis=1) for kind in ("torque", "momentum")]
        for (kind, unit), size in zip((("torque", "N m"), ("momentum", "N m s")), sizes):
            same(f"{effect} {kind} [{unit}]", size)
        line = next(line for line in text.splitlines() if line.strip().startswith(effect))
        printed = [float(cell) for cell in line.replace(effect, "", 1).split()]
        expected = [sizes[0].mean() * 1e6, sizes[0].max() * 1e6, sizes[1][-1] * 1e3]
        assert np.abs(np.array(printed) - expected).max() < 0.000_51
    assert "<svg" in files["day.svg"]


def test_the_study_of_heights_follows_what_each_torque_depends_on(studied):
    text, files = studied("earth/torques")
    rows = table(files, "torques.csv")
    column = lambda name: np.array([float(row[name]) for row in rows])
    height_km = column("height [km]")
    mean = {effect: column(f"{effect} mean [N m]") for effect in EFFECTS}
    assert np.allclose(height_km[[0, -1]], [180.0, 36_000.0], rtol=1e-6) and len(rows) == 25
    radius = height_km + 6378.137
    # To the nadir on a circle nothing but the distance changes.
    scaled = mean["gravity gradient"] * radius**3
    assert np.ptp(scaled) < 1e-3 * scaled[0]
    # A dipole's field falls as the gradient does; higher harmonics and the tilt to the orbit change its mean by less than a tenth.
    scaled = mean["magnetic field"] * radius**3
    assert np.ptp(scaled) < 0.1 * scaled[-1], scaled
    assert (mean["air"][height_km > 2000.0] == 0.0).all() and (np.diff(mean["air"][height_km < 2000.0]) < 0.0).all()
    # The planet shades half of a low orbit's sunlight at most.
    assert 1.0 < mean["sunlight"][-1] / mean["sunlight"][0] < 2.0
    excess = np.log(mean["air"] / mean["sunlight"], where=mean["air"] > 0.0, out=np.full(25, -np.inf))
    k = int(np.argmax(excess < 0.0))
    share = excess[k - 1] / (excess[k - 1] - excess[k])
    crossing_km = np.exp(np.interp(share, [0.0, 1.0], np.log(height_km[k - 1 : k + 1])))
    assert f"up to {crossing_km:.0f} km" in text
    assert "<svg" in files["torques.svg"]
