"""Studies `pointing/*`: lines and ellipsoids, quaternions and scans computed again with numpy from the CSV files.

The files carry position, velocity and Sun (EME2000, from the planet's centre) and the commanded quaternion of every sample.
"""

import math
import re
import subprocess

import numpy as np
import pytest
from fmpy import read_model_description

from studies import attitude, program, table, unit, vector

TRIAXIAL_M = np.array([2_440_530.0, 2_439_280.0, 2_438_260.0])
# 2009-04-06 00:00 TDB in seconds past J2000.
START_S = (3_382 * 24 + 12) * 3600.0
Z = np.array([0.0, 0.0, 1.0])


def off(a, b):
    """Sine of the angle between two directions on one side."""
    assert a @ b > 0.0
    return np.linalg.norm(np.cross(unit(a), unit(b)))


def body_angles_deg(body):
    """Azimuth from -Y toward +X, elevation toward -Z."""
    x, y, z = unit(body)
    return math.degrees(math.atan2(x, -y)), math.degrees(math.asin(-z))


def position(row):
    return vector(row, "x_m y_m z_m")


def velocity(row):
    return vector(row, "vx_m_s vy_m_s vz_m_s")


def sun(row):
    return vector(row, "sun_x_m sun_y_m sun_z_m")


def about(axis, angle):
    """Passive rotation: components in a frame turned by the angle about the axis."""
    c, s = math.cos(angle), math.sin(angle)
    matrix = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = s, -s
    return matrix


@pytest.fixture(scope="module")
def to_planet(dist):
    """The matrix from EME2000 to the planet's axes at a row's epoch, by the start values of the description."""
    variables = read_model_description(str(dist / "Guidance.fmu")).modelVariables
    start = {v.name: float(v.start) for v in variables if v.name.startswith("planet.") and v.start}
    ascension, declination = start["planet.poleRightAscension"], start["planet.poleDeclination"]

    def matrix(row):
        meridian = start["planet.primeMeridian"] + start["planet.rotationRate"] * float(row["epoch_s"])
        tilt = about(0, math.pi / 2 - declination) @ about(2, math.pi / 2 + ascension)
        return about(2, meridian) @ tilt

    matrix.radius_m = start["planet.radii[1]"]
    return matrix


@pytest.fixture(scope="module")
def limb(studied):
    text, files = studied("pointing/limb")
    return text, files


@pytest.fixture(scope="module")
def mosaic(studied):
    text, files = studied("pointing/mosaic")
    rows = table(files, "mosaic.csv")
    return text, {name: [row for row in rows if row["scan"] == name] for name in ("inertial", "body", "planet")}


@pytest.fixture(scope="module")
def transition(studied):
    text, files = studied("pointing/transition")
    rows = table(files, "transition.csv")
    return text, {name: [row for row in rows if row["case"] == name] for name in ("camera follows", "camera held")}


# Limb


def level(row):
    """Downtrack, left and up."""
    up = unit(position(row))
    downtrack = unit(velocity(row) - up * (up @ velocity(row)))
    return downtrack, np.cross(up, downtrack), up


def closest_m(row, direction, to_planet):
    """How far a line from the spacecraft passes outside the ellipsoid, in units of the radii times their mean."""
    origin, ray = (to_planet(row) @ v / TRIAXIAL_M for v in (position(row), direction))
    nearest = origin - ray * (origin @ ray) / (ray @ ray)
    return (np.linalg.norm(nearest) - 1.0) * TRIAXIAL_M.mean()


def test_limb_points_lie_at_their_azimuths_and_touch_the_ellipsoid(limb, to_planet):
    rows = table(limb[1], "limb.csv")
    assert [float(row["azimuth_deg"]) for row in rows] == [45.0 * k for k in range(8)]
    for row in rows:
        assert float(row["epoch_s"]) == START_S + 6 * 86_400.0
        c = attitude(row)
        boresight = c.T @ Z
        assert abs(closest_m(row, boresight, to_planet)) < 1e-6
        downtrack, left, _ = level(row)
        found = math.degrees(math.atan2(boresight @ left, boresight @ downtrack))
        expected = float(row["azimuth_deg"])
        assert abs((found - expected + 180.0) % 360.0 - 180.0) < 1e-10
        assert abs((float(row["found_azimuth_deg"]) - expected + 180.0) % 360.0 - 180.0) < 1e-10
        assert abs(float(row["height_m"])) < 1e-6 and row["reachable"] == "true"
        off_nadir = math.degrees(math.asin(off(boresight, -position(row))))
        assert float(row["off_nadir_deg"]) == pytest.approx(off_nadir, abs=1e-10)
        azimuth, elevation = body_angles_deg(c @ (sun(row) - position(row)))
        assert abs(azimuth) < 1e-10 and abs(elevation) < 13.0
        assert float(row["sun_elevation_deg"]) == pytest.approx(elevation, abs=1e-10)
    # The disc is no circle to better than its triaxiality, and not to worse.
    angles = [float(row["off_nadir_deg"]) for row in rows]
    assert 1e-4 < max(angles) / min(angles) - 1.0 < 2e-3


def terminator_points(row, to_planet):
    """Eqs 20 to 22 in closed form, for the ellipsoid scaled to the unit sphere."""
    to = to_planet(row)
    rho, sigma = to @ position(row) / TRIAXIAL_M, unit(to @ sun(row) * TRIAXIAL_M)
    across = rho - sigma * (rho @ sigma)
    square = across @ across
    if square < 1.0:
        return []
    side = unit(np.cross(rho, sigma)) * math.sqrt(1.0 - 1.0 / square)
    return [to.T @ ((across / square + sign * side) * TRIAXIAL_M) for sign in (1.0, -1.0)]


def test_the_terminator_has_two_limb_points_or_none_and_the_nearer_to_downtrack_is_taken(limb, to_planet):
    text, files = limb
    rows = table(files, "limb-terminator.csv")
    assert len(rows) == 721
    outside = 0
    for row in rows:
        c = attitude(row)
        boresight = c.T @ Z
        points = terminator_points(row, to_planet)
        assert int(row["solutions"]) == len(points) and (row["reachable"] == "true") == bool(points)
        if points:
            for point in points:
                assert abs(point @ unit(sun(row))) < 1e-6
                assert abs(closest_m(row, point - position(row), to_planet)) < 1e-6
            downtrack = level(row)[0]
            toward = max((unit(point - position(row)) for point in points), key=lambda v: v @ downtrack)
            assert off(boresight, toward) < 1e-12
            assert abs(float(row["height_m"])) < 1e-6
        else:
            assert off(boresight, -position(row)) < 1e-14
            assert math.isnan(float(row["height_m"])) and math.isnan(float(row["azimuth_deg"]))
        azimuth, elevation = body_angles_deg(c @ (sun(row) - position(row)))
        assert abs(azimuth) < 1e-8 and abs(elevation - float(row["sun_elevation_deg"])) < 1e-8
        outside += abs(elevation) > 13.0
    none = sum(row["solutions"] == "0" for row in rows)
    assert 50 < none < 200
    assert f"({none} of 721 minutes)" in text and f"({721 - none} of 721 minutes)" in text
    assert f"({721 - outside} of 721 minutes)" in text and "721 of 721" in text


# Mosaic


def camera_axes(row):
    """Boresight, across toward +X, across sunward: rows, in the body frame."""
    angle = math.radians(float(row["mdis_angle_deg"]))
    boresight = np.array([0.0, -math.sin(angle), math.cos(angle)])
    right = np.array([1.0, 0.0, 0.0])
    return np.array([boresight, right, np.cross(right, boresight)])


def rays(row, side):
    """Directions evenly over the field, EME2000."""
    reach = math.tan(math.radians(float(row["field_deg"]) / 2.0)) * (np.arange(side) + 0.5 - side / 2) / (side / 2)
    x, y = (grid.ravel() for grid in np.meshgrid(reach, reach))
    return np.column_stack([np.ones_like(x), x, y]) @ camera_axes(row) @ attitude(row)


def hits(directions, row, radius_m):
    """Where the rays meet the sphere: points, and which do."""
    d = directions / np.linalg.norm(directions, axis=1)[:, None]
    along = -d @ position(row)
    inside = radius_m**2 - (position(row) @ position(row) - along**2)
    meets = inside >= 0.0
    return position(row) + d[meets] * (along - np.sqrt(np.where(meets, inside, 0.0)))[meets][:, None], meets


def shown(fixed, row, to_planet):
    """Which of the points along the planet's axes the frame shows."""
    points = fixed @ to_planet(row)
    seen = (points - position(row)) @ attitude(row).T @ camera_axes(row).T
    limit = math.tan(math.radians(float(row["field_deg"]) / 2.0)) * seen[:, 0]
    above = points @ unit(position(row)) > to_planet.radius_m**2 / np.linalg.norm(position(row))
    return (np.abs(seen[:, 1]) <= limit) & (np.abs(seen[:, 2]) <= limit) & above


def test_frames_show_what_a_square_field_shows_of_a_sphere(mosaic, to_planet):
    for rows in mosaic[1].values():
        for row, after in zip(rows, rows[1:] + [None]):
            points, meets = hits(rays(row, 83), row, to_planet.radius_m)
            assert float(row["on_disc"]) == pytest.approx(meets.mean(), abs=0.01)
            if after is None:
                assert math.isnan(float(row["overlap_with_next"]))
                continue
            shared = shown(points @ to_planet(row).T, after, to_planet).mean()
            assert float(row["overlap_with_next"]) == pytest.approx(shared, abs=0.01), (row["scan"], row["frame"])


def test_middles_stand_where_the_boresight_meets_the_planet(mosaic, to_planet):
    for rows in mosaic[1].values():
        for row in rows:
            boresight = attitude(row).T @ camera_axes(row)[0]
            off_nadir = math.degrees(math.asin(off(boresight, -position(row))))
            assert float(row["off_nadir_deg"]) == pytest.approx(off_nadir, abs=1e-9)
            points, meets = hits(boresight[None, :], row, to_planet.radius_m)
            if meets[0]:
                x, y, z = to_planet(row) @ points[0]
                assert float(row["latitude_deg"]) == pytest.approx(math.degrees(math.atan2(z, math.hypot(x, y))), abs=1e-7)
                assert float(row["longitude_deg"]) == pytest.approx(math.degrees(math.atan2(y, x)), abs=1e-6)


def test_coverage_is_that_of_points_scattered_over_the_disc(mosaic, to_planet):
    text, scans = mosaic
    for name, rows in scans.items():
        # The place midway, by a cubic through those of the frames.
        times = np.array([float(row["time_s"]) for row in rows])
        duration = {"inertial": 600.0, "body": 420.0, "planet": 600.0}[name]
        at = [np.polyval(np.polyfit(times - duration / 2, [float(row[axis]) for row in rows], 3), 0.0) for axis in ("x_m", "y_m", "z_m")]
        epoch = float(rows[0]["epoch_s"]) - times[0] + duration / 2
        middle = dict(zip(("x_m", "y_m", "z_m", "epoch_s"), (*at, epoch)))
        nadir = -unit(np.array(at))
        across = unit(np.cross(nadir, Z))
        generator = np.random.default_rng(1)
        reach = 1.01 * to_planet.radius_m / np.linalg.norm(at)
        x, y = generator.uniform(-1.02 * reach, 1.02 * reach, (2, 60_000))
        points, _ = hits(nadir + x[:, None] * across + y[:, None] * np.cross(nadir, across), middle, to_planet.radius_m)
        count = sum(shown(points @ to_planet(middle).T, row, to_planet).astype(int) for row in rows)
        line = next(line for line in text.splitlines() if line.startswith(f" {name} "))
        covered, twice = (float(x) for x in re.findall(r"([\d.]+) %", line)[:2])
        assert covered == pytest.approx(100.0 * (count > 0).mean(), abs=1.0), name
        assert twice == pytest.approx(100.0 * (count > 1).sum() / (count > 0).sum(), abs=1.5), name
        assert line.rstrip().endswith(f"0 of {duration + 1:.0f} s")


# Transition


def test_downlink_and_camera_stand_as_paper_001_says(transition):
    text, cases = transition
    for name, rows in cases.items():
        assert [float(row["time_s"]) for row in rows] == list(range(1001))
        for row in rows:
            c, time = attitude(row), float(row["time_s"])
            to_sun = sun(row) - position(row)
            azimuth, elevation = body_angles_deg(c @ to_sun)
            assert azimuth == pytest.approx(float(row["sun_azimuth_deg"]), abs=1e-10) and abs(azimuth) < 1e-10
            if time < 500.0:
                assert abs(elevation) < 1e-10
                assert float(row["earth_azimuth_deg"]) == pytest.approx(-33.0, abs=0.05)
                assert abs(float(row["earth_elevation_deg"])) < 1e-10
                continue
            camera = camera_axes(row)[0]
            assert off(c.T @ camera, -position(row)) < 1e-12
            sun_nadir = math.degrees(math.acos(unit(to_sun) @ -unit(position(row))))
            following = 90.0 - sun_nadir
            angle = float(row["mdis_angle_deg"])
            if name == "camera follows":
                assert angle == pytest.approx(following, abs=1e-10) and abs(elevation) < 1e-10
            else:
                # A camera farther sunward than nadir asks for turns the Sun from -Y toward -Z.
                assert angle == float(rows[500]["mdis_angle_deg"])
                assert elevation == pytest.approx(angle - following, abs=1e-10)
            mercury = body_angles_deg(c @ -position(row))
            assert float(row["mercury_elevation_deg"]) == pytest.approx(mercury[1], abs=1e-10)
    held = max(abs(float(row["sun_elevation_deg"])) for row in cases["camera held"])
    assert 0.1 < held < 2.0 and text.count("differs") == 1


def test_the_earth_goes_where_the_slew_about_the_sun_line_takes_it(transition):
    text, cases = transition
    rows = cases["camera follows"]
    before, after = attitude(rows[499]), attitude(rows[500])
    slew = after @ before.T
    angle = math.degrees(math.acos((np.trace(slew) - 1.0) / 2.0))
    printed = [float(x) for x in re.findall(r"slew angle\s+not printed\s+([\d.]+) deg", text)]
    assert printed == pytest.approx([angle] * 2, abs=1e-3)
    # The Sun stays on -Y, so the slew is a turn about Y: the angle between Earth and Sun stays, too.
    assert abs(slew[1, 1] - 1.0) < 1e-9
    for row in (rows[499], rows[500]):
        azimuth, elevation = (math.radians(float(row[f"earth_{kind}_deg"])) for kind in ("azimuth", "elevation"))
        assert math.cos(elevation) * math.cos(azimuth) == pytest.approx(math.cos(math.radians(33.0)), abs=1e-4)
    # The commanded quaternion jumps at 500 s and nowhere else.
    q = np.array([vector(row, "q1 q2 q3 q4") for row in rows])
    steps = np.linalg.norm(np.diff(q, axis=0), axis=1)
    assert np.argmax(steps) == 499 and steps[499] > 0.5 and np.delete(steps, 499).max() < 1e-3


def test_only_leaves_the_cases_named(heliotorque, dist, tmp_path):
    run = subprocess.run(
        program(heliotorque, dist, tmp_path, "pointing/limb", "--only", "azimuth 90"),
        capture_output=True, text=True, encoding="utf-8",
    )
    assert run.returncode == 0, run.stderr
    assert sorted(file.name for file in tmp_path.iterdir()) == ["limb.csv", "limb.svg"]
    assert len((tmp_path / "limb.csv").read_text().splitlines()) == 2
