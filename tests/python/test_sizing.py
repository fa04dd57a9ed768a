"""`heliotorque size`: what windows gather, by numpy from the columns of `run`, and the same for flights of any length."""

import re

import numpy as np
import pytest

from spacecraft import HEAD, RESOURCES, call, pack

EXAMPLES = RESOURCES / "examples"
TUTORIAL = RESOURCES.parents[1] / "docs" / "src" / "tutorial"
GEO = ("orbit.semiMajorAxis=42164 km", "orbit.eccentricity=0", "orbit.inclination=0.05 deg")
CRAFT = {
    "cubesat": (EXAMPLES / "cubesat-12u.toml", ()),
    "leo": (TUTORIAL / "leo.toml", ()),
    "geo": (EXAMPLES / "leo-500kg.toml", GEO),
    "venus": (TUTORIAL / "venus.toml", ()),
    "messenger": (RESOURCES / "messenger.toml", ()),
}
# At one place and in one attitude: light of constant strength and direction.
CRUISER = HEAD.format(name="Cruiser") + """
[[boxes]]
name = "bus"
center_m = [0.05, 0.0, -0.1]
size_m = [1.5, 1.0, 1.2]
optics = "paint"

[start]
"orbit.center" = "sun"
"orbit.source" = "held"
"orbit.position" = [1.35e11, 0, 0]
"orbit.velocity" = [0, 31000, 0]
"attitude.source" = "commanded"
"""


def sized(heliotorque, dist, file, days, sets, folder):
    """Momentum gathered between dumps by axis, and for how long, as printed."""
    words = [word for assignment in sets for word in ("--set", assignment)]
    done = call(
        heliotorque, "size", file, "--template", (dist / "MomentumPlant.fmu").resolve(), "--duration", f"{days} d",
        "--budget", "0 s", "--output", folder, *words,
    )
    assert done.returncode == 0, done.stderr
    gathered, span, unit = re.search(r"every axis at once: ([^:]*) N.m.s gathered in (\S+) (min|h|d) ", done.stdout).groups()
    return np.array([float(it) for it in gathered.split(", ")]), float(span) * {"min": 60.0, "h": 3600.0, "d": 86400.0}[unit]


def gathered_by_numpy(heliotorque, dist, file, days, sets, span_s, folder):
    """The largest components of A(t) (H(t) - H(t0)) over all t0 <= t <= t0 + span."""
    fmu = pack(heliotorque, dist, folder, file.read_text(encoding="utf-8"), "Sized")
    never = [f"dump.threshold[{axis}]=1e9" for axis in (1, 2, 3)]
    words = [word for assignment in (*sets, *never) for word in ("--set", assignment)]
    count = int(np.ceil(span_s / 120.0))
    done = call(
        heliotorque, "run", fmu, "--stop", f"{days} d", "--step", f"{span_s / count!r} s",
        "--record", "momentum.inertial,attitude.q", "--output", folder / "run.csv", *words,
    )
    assert done.returncode == 0, done.stderr
    table = np.genfromtxt(folder / "run.csv", delimiter=",", names=True, deletechars="")
    h = np.column_stack([table[f"momentum.inertial[{axis}]"] for axis in (1, 2, 3)])
    v, w = np.column_stack([table[f"attitude.q[{k}]"] for k in (1, 2, 3)]), table["attitude.q[4]"]
    largest = np.zeros(3)
    for lag in range(1, min(count, len(h) - 1) + 1):
        d, v1, w1 = h[lag:] - h[:-lag], v[lag:], w[lag:, None]
        turned = (w1**2 - np.sum(v1**2, axis=1, keepdims=True)) * d + 2 * v1 * np.sum(v1 * d, axis=1, keepdims=True)
        largest = np.maximum(largest, np.abs(turned - 2 * w1 * np.cross(v1, d)).max(axis=0))
    return largest


LENGTHS = [("venus", 10), *[pytest.param(name, days, marks=pytest.mark.long) for name in CRAFT for days in (10, 30, 120)]]


@pytest.mark.parametrize("name, days", LENGTHS)
def test_the_momentum_gathered_between_dumps_is_the_largest_of_all_windows(heliotorque, dist, tmp_path, name, days):
    file, sets = CRAFT[name]
    printed, span_s = sized(heliotorque, dist, file, days, sets, tmp_path)
    expected = gathered_by_numpy(heliotorque, dist, file, days, sets, span_s, tmp_path / "fmu")
    print(name, days, printed, expected)
    assert np.abs(printed - expected).max() < 0.01 * expected.max()


def test_the_length_of_the_flight_does_not_change_what_a_steady_light_gathers(heliotorque, dist, tmp_path):
    (tmp_path / "cruiser.toml").write_text(CRUISER, encoding="utf-8")
    (short, _), (long, _) = (sized(heliotorque, dist, tmp_path / "cruiser.toml", days, (), tmp_path) for days in (10, 120))
    assert short.max() > 0 and np.abs(short - long).max() < 0.01 * short.max()
