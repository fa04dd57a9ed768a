"""Flights by orbit.dynamics nBody and disturbed against Newton's law in DOP853, by the list of bodies that is switched on.

Planets and the Moon stand on circles that nothing pulls them along, so that what moves the centre is the list and not its path. The
FMU reads them from its ephemeris.toml; here they are the circles themselves, which the polynomials follow to a millimetre.
"""

import numpy as np
import pytest
from fmpy import simulate_fmu
from scipy.integrate import solve_ivp

from spacecraft import call
from simulation import DAY_S, vector

EPOCH_S = 3.0e8
C_M_S = 299_792_458.0
SUN_M3_S2 = 1.32712440041279419e20
# Gravitational parameter in m3/s2, radius of the circle in m, its inclination and its phase at the start in rad.
PLANETS = {
    "mercury": (2.2031868551e13, 5.79e10, 0.50, 1.0),
    "venus": (3.24858592e14, 1.082e11, 0.43, 4.0),
    "earth": (3.98600435507e14, 1.496e11, 0.41, 0.3),
    "mars": (4.2828375816e13, 2.279e11, 0.44, 2.0),
    "jupiter": (1.26686531900e17, 7.785e11, 0.41, 5.0),
    "custom": (4.892, 1.6842e11, 0.36, 0.6),
}
MOON = (4.902800118e12, 3.844e8, 0.45, 2.2)
# North of EME2000, about which flattened() is.
POLE = {"planet.orientation": 1}
J2_EARTH = (1.0826359e-3, 6.3781363e6)
SPACECRAFT = """name = "Ball"
[mass_properties]
mass_kg = 100.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]]
[optics.foil]
specular = 0.2
diffuse = 0.1
[[discs]]
name = "sail"
center_m = [0.0, 0.0, 0.0]
normal = [0.0, -1.0, 0.0]
radius_m = 0.5
optics = "foil"
[body]
name = "Rock"
gravitational_parameter_m3_s2 = 4.892
radii_m = [245.0, 245.0, 245.0]
[start]
"ephemeris.source" = "chebyshev"
"start.epoch" = 3.0e8
"""


def circle(orbit, mu, t):
    """Position and velocity, a column a time, seconds after the start."""
    _, a, inclination, phase = orbit
    rate = np.sqrt(mu / a**3)
    u = phase + rate * np.asarray(t)
    tilt = np.array([1.0, np.cos(inclination), np.sin(inclination)])
    c, s = np.cos(u), np.sin(u)
    return (a * tilt * np.array([c, s, s]).T).T, (a * rate * tilt * np.array([-s, c, c]).T).T


def ephemeris():
    """The circles as segments of two days."""
    text, length_s, degree = 'frame = "EME2000"\n', 2.0 * DAY_S, 14
    bodies = [(name, "sun", orbit, SUN_M3_S2) for name, orbit in PLANETS.items()]
    for name, center, orbit, mu in [*bodies, ("moon", "earth", MOON, PLANETS["earth"][0])]:
        text += f'[[body]]\nbody = "{name}"\ncenter = "{center}"\ndegree = {degree}\nerror_m = 1e-3\nerror_m_s = 1e-6\nsegment = [\n'
        for k in range(-1, 7):
            middle_s = (k + 0.5) * length_s
            nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
            places, _ = circle(orbit, mu, middle_s + 0.5 * length_s * nodes)
            rows = np.polynomial.chebyshev.chebfit(nodes, places.T, degree).T
            row = ", ".join(f"{axis}_m = {[float(x) for x in values]}" for axis, values in zip("xyz", rows))
            text += f"{{ start_s = {EPOCH_S + k * length_s}, end_s = {EPOCH_S + (k + 1) * length_s}, {row} }},\n"
        text += "]\n"
    return text


@pytest.fixture(scope="module")
def fmu(heliotorque, dist, tmp_path_factory):
    folder = tmp_path_factory.mktemp("ball")
    (folder / "ball.toml").write_text(SPACECRAFT, encoding="utf-8")
    (folder / "sky.toml").write_text(ephemeris(), encoding="utf-8")
    packed = call(
        heliotorque, "pack", "--spacecraft", "ball.toml", "--ephemeris", "sky.toml", "--template",
        (dist / "MomentumPlant.fmu").resolve(), "--name", "Ball", folder=folder,
    )
    assert packed.returncode == 0, packed.stderr
    return str(folder / "Ball.fmu")


def start_about(mu, radius_m):
    """A circle that lies askew to everything."""
    along, across = np.array([0.6, 0.64, 0.48]), np.array([-0.8, 0.48, 0.36])
    return radius_m * along, np.sqrt(mu / radius_m) * across


def relativity(r, v):
    return SUN_M3_S2 / (C_M_S**2 * np.linalg.norm(r) ** 3) * (
        (4.0 * SUN_M3_S2 / np.linalg.norm(r) - v @ v) * r + 4.0 * (r @ v) * v
    )


def flattened(s, mu):
    j2, radius_m = J2_EARTH
    d, z2 = np.linalg.norm(s), (s[2] / np.linalg.norm(s)) ** 2
    return -1.5 * j2 * mu * radius_m**2 / d**5 * s * np.array([1.0 - 5.0 * z2, 1.0 - 5.0 * z2, 3.0 - 5.0 * z2])


def independent(center, radius_m, days, bodies, moon=False, relativistic=False, oblate=False):
    """Position about the centre after the flight, by what the bodies do to the spacecraft less what they do to the centre."""
    mu = PLANETS[center][0]

    def rate(t, y):
        s, v = y[:3], y[3:]
        c, cv = circle(PLANETS[center], SUN_M3_S2, t)
        others = [(SUN_M3_S2, -c)]
        others += [(PLANETS[name][0], circle(PLANETS[name], SUN_M3_S2, t)[0] - c) for name in bodies if name != center]
        if moon:
            earth = circle(PLANETS["earth"], SUN_M3_S2, t)[0]
            others.append((MOON[0], earth + circle(MOON, PLANETS["earth"][0], t)[0] - c))
        a = -mu * s / np.linalg.norm(s) ** 3 + (flattened(s, mu) if oblate else 0.0)
        for gm, p in others:
            a += gm * ((p - s) / np.linalg.norm(p - s) ** 3 - p / np.linalg.norm(p) ** 3)
        if relativistic:
            a += relativity(c + s, cv + v) - relativity(c, cv)
        return np.concatenate([v, a])

    start = np.concatenate(start_about(mu, radius_m))
    scale = np.repeat([radius_m, np.linalg.norm(start[3:])], 3)
    end = solve_ivp(rate, (0.0, days * DAY_S), start, "DOP853", rtol=1e-13, atol=1e-13 * scale).y[:, -1]
    return end[:3]


def flown(fmu, center, radius_m, days, values):
    position, velocity = start_about(PLANETS[center][0], radius_m)
    start = {
        "orbit.center": CENTERS[center], "orbit.source": 2,
        "orbit.radiationFeedback": False, **dict(zip(vector("orbit.position"), position)),
        **dict(zip(vector("orbit.velocity"), velocity)), **values,
    }
    result = simulate_fmu(
        fmu, stop_time=days * DAY_S, step_size=DAY_S, output_interval=DAY_S, start_values=start, output=vector("position")
    )
    return np.array([result[name][-1] for name in vector("position")])


CENTERS = {"mercury": 1, "earth": 4, "custom": 100}
EVERYTHING = ["mercury", "venus", "earth", "moon", "mars", "jupiter"]
ORBITS = {"low": ("earth", 7.0e6), "geostationary": ("earth", 4.2164e7), "mercury": ("mercury", 4.0e6), "bennu": ("custom", 1.5e3)}
SOME = [("low", "moon", 1), ("geostationary", "all", 10), ("mercury", "venus", 1), ("mercury", "relativity", 1), ("bennu", "none", 10)]
ALL = [(orbit, off, 10) for orbit in ORBITS for off in [*EVERYTHING, "relativity", "none", "all"]]


@pytest.mark.parametrize("orbit, off, days", [*SOME, *(pytest.param(*case, marks=pytest.mark.long) for case in ALL)])
def test_whatever_is_off_pulls_neither_spacecraft_nor_centre(fmu, orbit, off, days):
    center, radius_m = ORBITS[orbit]
    on = {name: name != off and off != "all" for name in [*EVERYTHING, "relativity"]}
    values = {f"orbit.attraction.{name}": on[name] for name in EVERYTHING}
    values |= {"orbit.dynamics": 3, "planet.j2": 0.0, "orbit.relativity": on["relativity"]}
    found = flown(fmu, center, radius_m, days, values)
    bodies = [name for name in EVERYTHING if name != "moon" and on[name]]
    expected = independent(center, radius_m, days, bodies, on["moon"], on["relativity"])
    print(f"{orbit} without {off}, {days} d: {np.linalg.norm(found - expected):.2e} m")
    assert np.linalg.norm(found - expected) < 0.1 * days


@pytest.mark.parametrize(
    "radius_m, days, moves_m",
    [(7.0e6, 1, 30.0), (4.2164e7, 2, 3000.0), pytest.param(7.0e6, 10, 30.0, marks=pytest.mark.long)],
)
def test_the_moons_tide_acts_on_a_disturbed_orbit_about_the_earth(fmu, radius_m, days, moves_m):
    values = {"orbit.dynamics": 2, "aerodynamics.enabled": False, "orbit.step": 120.0, **POLE}
    found = flown(fmu, "earth", radius_m, days, values)
    expected = independent("earth", radius_m, days, [], moon=True, oblate=True)
    print(f"{radius_m:.4g} m, {days} d: {np.linalg.norm(found - expected):.2e} m")
    assert np.linalg.norm(found - expected) < 0.1 * days
    without = flown(fmu, "earth", radius_m, days, {**values, "orbit.moonTide": False})
    assert np.linalg.norm(without - found) > moves_m * days
