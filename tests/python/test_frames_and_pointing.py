"""Where MomentumPlant's orbit, Sun, Earth, planet and panels stand, against directions built up by hand in EME2000."""

import numpy as np
import pytest

from simulation import QUATERNION, simulate, stack, to_body, turned, vector
from spacecraft import RESOURCES, solar_torque

X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
AU_M = 149_597_870_700.0
GM_MERCURY = 2.2032e13
# North of the ecliptic of J2000: the equator's pole turned about the equinox by IAU 1976's obliquity.
ECLIPTIC_NORTH = turned(Z, X, np.radians(84_381.448 / 3600.0))


def unit(vector):
    return vector / np.linalg.norm(vector)


def pole(right_ascension_deg, declination_deg):
    return turned(turned(X, [0.0, -1.0, 0.0], np.radians(declination_deg)), Z, np.radians(right_ascension_deg))


def frame_axes(frame):
    """First axis and pole of the frame of the orbital elements."""
    if frame == 1:
        # Paper 004's Table 4: Mercury's orbit, by its node and inclination on the ecliptic.
        node = turned(X, ECLIPTIC_NORTH, np.radians(48.33))
        return node, turned(ECLIPTIC_NORTH, node, np.radians(7.0))
    if frame == 2:
        # IAU 2015: Mercury's equator, from its ascending node on the Earth's.
        north = pole(281.0103, 61.4155)
        return unit(np.cross(Z, north)), north
    return X, Z if frame == 3 else ECLIPTIC_NORTH


ELEMENTS = {"orbit.inclination": 1.1, "orbit.ascendingNode": 2.3, "orbit.periapsisArgument": -0.7}
STATE = vector("position") + vector("velocity") + vector("heliocentric.position")


@pytest.mark.parametrize("frame", [1, 2, 3, 4])
def test_the_orbit_stands_in_the_frame_of_its_elements(momentum_plant, frame):
    start = ELEMENTS | {"orbit.frame": frame, "orbit.semiMajorAxis": 1e7, "orbit.eccentricity": 0.5}
    result = simulate(momentum_plant, 600.0, days=600.0 / 86_400.0, start=start, output=STATE)
    first, north = frame_axes(frame)
    node = turned(first, north, ELEMENTS["orbit.ascendingNode"])
    normal = turned(north, node, ELEMENTS["orbit.inclination"])
    periapsis = turned(node, normal, ELEMENTS["orbit.periapsisArgument"])
    position, velocity = stack(result, "position")[0], stack(result, "velocity")[0]
    assert np.abs(position - 5e6 * periapsis).max() < 1e-5
    # Vis-viva at the periapsis of a(1 - e) = 5000 km, onward about the normal.
    speed = np.sqrt(GM_MERCURY * (2.0 / 5e6 - 1.0 / 1e7))
    assert np.abs(velocity / speed - np.cross(normal, periapsis)).max() < 1e-4


def test_paper_004s_frame_lies_in_the_orbit_in_which_mercury_moves(momentum_plant):
    """Without its Table 4: the plane that VSOP87 moves Mercury in, within the hundredths of a degree it is rounded to."""
    start = {"orbit.frame": 1, "orbit.inclination": 0.0, "orbit.semiMajorAxis": 1e7}
    result = simulate(momentum_plant, 3600.0, days=20.0, start=start, output=STATE)
    mercury = stack(result, "heliocentric.position") - stack(result, "position")
    simulated = unit(np.cross(mercury[0], mercury[-1]))
    normal = unit(np.cross(stack(result, "position")[0], stack(result, "velocity")[0]))
    assert np.degrees(np.linalg.norm(simulated - normal)) < 0.01


LOOK = QUATERNION + vector("position") + vector("heliocentric.position") + vector("sun.direction") + [
    "sun.azimuth", "sun.elevation", "earth.azimuth", "earth.elevation", "keepIn.margin"
]
TUMBLE = {"attitude.source": 2} | {f"command.rate[{axis}]": rate for axis, rate in ((1, 6.3e-5), (2, -7.3e-5), (3, 1e-5))}
# The paper's zone: the Sun within 15 deg in azimuth and 13 deg in elevation.
ZONE = np.radians([15.0, 13.0])


def seen(result, direction):
    """Unit vectors of the body frame toward a direction in EME2000, one a row."""
    return np.einsum("kij,kj->ki", to_body(result), direction / np.linalg.norm(direction, axis=1)[:, None])


def azimuth_elevation(body):
    """Paper 000: u = [cos E sin A, -cos E cos A, -sin E]."""
    return np.arctan2(body[:, 0], -body[:, 1]), -np.arcsin(body[:, 2])


def test_azimuth_elevation_and_margin_are_those_of_the_directions(momentum_plant):
    sun, earth = np.array([0.02, -0.3, 0.01]) * AU_M, np.array([-0.9, 0.2, 0.6]) * AU_M
    given = {"ephemeris.source": 3, "attitude.source": 2, "command.rate[1]": 6e-5, "command.rate[3]": 2e-5}
    given |= {f"{body}.position[{k + 1}]": at[k] for body, at in (("sun", sun), ("earth", earth)) for k in range(3)}
    result = simulate(momentum_plant, 600.0, days=10.0, start=given, output=LOOK)
    position = stack(result, "position")
    assert np.abs(stack(result, "heliocentric.position") - (position - sun)).max() < 1e-4
    angles = azimuth_elevation(seen(result, sun - position))
    # The Sun goes round the body, through the zone and high over both poles.
    assert np.ptp(angles[0]) > 6.0 and np.ptp(angles[1]) > 2.0
    for body, expected in (("sun", angles), ("earth", azimuth_elevation(seen(result, earth - position)))):
        around = np.angle(np.exp(1j * (result[f"{body}.azimuth"] - expected[0])))
        assert np.abs(around).max() < 1e-12, body
        assert np.abs(result[f"{body}.elevation"] - expected[1]).max() < 1e-12, body
    margins = ZONE - np.abs(np.column_stack(angles))
    margin = margins.min(axis=1)
    assert (margin > 0.0).any() and margin.min() < -1.5 and (margins[:, 0] > margins[:, 1]).any()
    assert np.abs(result["keepIn.margin"] - margin).max() < 1e-12


@pytest.mark.parametrize("limit_deg", [13.0, 40.0])
def test_the_nadir_rule_points_z_at_the_planet_as_far_as_the_zone_allows(momentum_plant, limit_deg):
    limit = np.radians(limit_deg)
    start = {"guided.scienceRule": 2, "guided.downlinkEvery": 0, "keepIn.elevation": limit}
    result = simulate(momentum_plant, 300.0, days=3.0, start=start, output=LOOK)
    nadir = seen(result, -stack(result, "position"))
    sun = seen(result, -stack(result, "heliocentric.position"))
    azimuth, elevation = azimuth_elevation(sun)
    # The Sun in the YZ plane on the side of -Y, the planet in the same plane on the side of +Z.
    assert np.abs(azimuth).max() < 1e-9 and np.abs(nadir[:, 0]).max() < 1e-9 and nadir[:, 2].min() > 0.0
    expected = np.arccos(np.einsum("ki,ki->k", nadir, sun)) - 0.5 * np.pi
    inside = np.abs(expected) < limit
    assert 0.05 < inside.mean() < 0.99
    assert np.abs(nadir[inside] - Z).max() < 1e-9
    assert np.abs(elevation - np.clip(expected, -limit, limit)).max() < 1e-9
    assert result["keepIn.margin"].min() > -1e-9


MESSENGER = (RESOURCES / "messenger.toml").read_text(encoding="utf-8")
PRESSURE_PA = 9e-6
FIXED_LIGHT = {"solar.fixedPressure": True, "solar.pressure": PRESSURE_PA, "eclipse.method": 4}
PANELS = vector("sun.direction") + vector("torque.solar") + ["panel[1].angleActual", "panel[2].angleActual"]


def panels_torque(momentum_plant, start):
    """Runs with panels and, in the same attitudes, with the sunshade alone; the panels' torque is the difference."""
    start = FIXED_LIGHT | TUMBLE | start
    result = simulate(momentum_plant, 1800.0, days=3.0, start=start, output=PANELS)
    bare = {"panel[1].enabled": False, "panel[2].enabled": False}
    shade = simulate(momentum_plant, 1800.0, days=3.0, start=start | bare, output=PANELS)
    sun, angles = stack(result, "sun.direction"), np.column_stack([result[name] for name in PANELS[-2:]])
    expected = np.array([solar_torque(MESSENGER, *row) for row in zip(sun, [PRESSURE_PA] * len(sun), angles)])
    torque = stack(result, "torque.solar") - stack(shade, "torque.solar")
    assert np.abs(expected).max() > 1e-6
    assert np.abs(torque - expected).max() < 1e-12 * np.abs(expected).max()
    return sun, angles


def test_a_panel_by_angle_stands_as_told(momentum_plant):
    start = {"panel[1].control": 2, "panel[1].angle": 0.3, "panel[2].control": 2, "panel[2].angle": -1.2}
    # What holds a panel by Sun offset does not matter.
    start |= {"panel[1].sunOffset": 1.0, "panel[2].tilt": 2}
    _, angles = panels_torque(momentum_plant, start)
    assert (angles == [0.3, -1.2]).all()


@pytest.mark.parametrize("tilt, sign", [(1, 1.0), (2, -1.0)])
def test_a_panel_by_sun_offset_keeps_it_on_the_side_of_its_tilt(momentum_plant, tilt, sign):
    offset = np.array([0.5, 1.4])
    start = {"panel[1].sunOffset": offset[0], "panel[2].sunOffset": offset[1]}
    start |= {"panel[1].tilt": tilt, "panel[2].tilt": tilt, "panel[1].angle": 0.3}
    sun, angles = panels_torque(momentum_plant, start)
    for panel in (0, 1):
        # Cells toward -Y at angle 0, turned right-handed about +X.
        normal = np.array([turned([0.0, -1.0, 0.0], X, angle) for angle in angles[:, panel]])
        facing = np.column_stack([np.zeros(len(sun)), sun[:, 1], sun[:, 2]])
        # No angle brings the cells nearer to the Sun than the Sun is to the plane they turn in.
        nearest = np.linalg.norm(facing, axis=1)
        reachable = nearest > np.cos(offset[panel])
        assert reachable.sum() > 20
        cosine = np.einsum("ki,ki->k", normal, sun)
        assert np.abs(cosine - np.minimum(nearest, np.cos(offset[panel]))).max() < 1e-12
        assert (sign * np.cross(facing, normal)[:, 0] > 0.0)[reachable].all()
