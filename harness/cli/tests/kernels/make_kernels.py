"""Writes planets.bsp and craft.bsp by CSPICE: bodies on circles, whose states have a closed form.

    pip install spiceypy==8.3.0 numpy
    python make_kernels.py

The files are committed; `tests/main/kernels.rs` repeats the circles in its own words. Coordinates are J2000, km and TDB seconds.
planets.bsp covers 24 days from START, craft.bsp 2 days: spacecraft -236, whose first segment is on a circle of half the radius,
of which SPICE takes the second; spacecraft -121 on the first and the third half day; -122 and -123 on the first.
"""

from pathlib import Path

import numpy as np
import spiceypy as spice

DAY = 86400.0
START = 354_974_400.0  # 2011-04-02 TDB
FOLDER = Path(__file__).parent

# Radius in km, period in s, phase at START in rad, inclination to the equator in rad.
CIRCLES = {
    "sun": (742_000.0, 4332.6 * DAY, 0.4, 0.41),
    "mercury": (57_909_000.0, 87.969 * DAY, 1.1, 0.53),
    "emb": (149_598_000.0, 365.256 * DAY, 2.3, 0.409),
    "earth": (4_671.0, 27.3217 * DAY, 5.0, 0.42),
    "craft": (10_136.0, 12.07 * 3600.0, 0.7, 1.44),
    "wrong": (5_068.0, 12.07 * 3600.0, 0.7, 1.44),
}


def state(name: str, at: float) -> np.ndarray:
    """Position in km and velocity in km/s on a circle."""
    radius, period, phase, inclination = CIRCLES[name]
    rate = 2.0 * np.pi / period
    angle = phase + rate * (at - START)
    along = np.array([1.0, 0.0, 0.0])
    across = np.array([0.0, np.cos(inclination), np.sin(inclination)])
    position = radius * (np.cos(angle) * along + np.sin(angle) * across)
    velocity = radius * rate * (np.cos(angle) * across - np.sin(angle) * along)
    return np.concatenate([position, velocity])


def chebyshev(name: str, start: float, length: float, records: int, degree: int, values: int) -> np.ndarray:
    """Coefficients of so many records of the first 3 or all 6 values, interpolated at Chebyshev nodes."""
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    table = []
    for record in range(records):
        middle = start + (record + 0.5) * length
        samples = np.array([state(name, middle + 0.5 * length * x)[:values] for x in nodes])
        table.append(np.polynomial.chebyshev.chebfit(nodes, samples, degree).T.ravel())
    return np.concatenate(table)


def write_planets() -> None:
    path = FOLDER / "planets.bsp"
    path.unlink(missing_ok=True)
    handle = spice.spkopn(str(path), "circles for tests", 0)
    stop = START + 24 * DAY
    for name, target, center in [("sun", 10, 0), ("mercury", 1, 0), ("earth", 399, 3)]:
        table = chebyshev(name, START, 8 * DAY, 3, 14, 3)
        spice.spkw02(handle, target, center, "J2000", START, stop, name, 8 * DAY, 3, 14, table, START)
    table = chebyshev("emb", START, 12 * DAY, 2, 12, 6)
    spice.spkw03(handle, 3, 0, "J2000", START, stop, "emb", 12 * DAY, 2, 12, table, START)
    table = np.zeros(6)
    spice.spkw02(handle, 199, 1, "J2000", START, stop, "mercury itself", 24 * DAY, 1, 1, table, START)
    spice.spkcls(handle)


def write_craft() -> None:
    path = FOLDER / "craft.bsp"
    path.unlink(missing_ok=True)
    handle = spice.spkopn(str(path), "circles for tests", 0)
    epochs = np.arange(START, START + 2 * DAY + 1.0, 1800.0)
    table = chebyshev("wrong", START, 0.5 * DAY, 4, 20, 3)
    stop = START + 2 * DAY
    spice.spkw02(handle, -236, 199, "J2000", START, stop, "wrong", 0.5 * DAY, 4, 20, table, START)
    states = np.array([state("craft", at) for at in epochs])
    spice.spkw13(handle, -236, 199, "J2000", START, stop, "craft", 11, len(epochs), states, epochs)
    for begin in (0.0, 1.0 * DAY):
        epochs = np.arange(START + begin, START + begin + 0.5 * DAY + 1.0, 1800.0)
        states = np.array([state("craft", at) for at in epochs])
        spice.spkw09(
            handle, -121, 199, "J2000", epochs[0], epochs[-1], "halves", 15, len(epochs), states, epochs
        )
    epochs = np.arange(START, START + 0.5 * DAY + 1.0, 1800.0)
    states = np.array([state("craft", at) for at in epochs])
    for target, write, degree in [(-122, spice.spkw08, 15), (-123, spice.spkw12, 11)]:
        write(
            handle, target, 199, "J2000", epochs[0], epochs[-1], "half", degree, len(epochs), states, epochs[0], 1800.0
        )
    spice.spkcls(handle)


def judge() -> None:
    """CSPICE reads back what the circles say."""
    for path in ("planets.bsp", "craft.bsp"):
        spice.furnsh(str(FOLDER / path))
    worst = 0.0
    for at in START + np.linspace(0.0, 2 * DAY, 997):
        truth = {
            "SUN": state("sun", at) - state("mercury", at),
            "EARTH": state("emb", at) + state("earth", at) - state("mercury", at),
            "-236": state("craft", at),
        }
        for target, expected in truth.items():
            found, _ = spice.spkezr(target, at, "J2000", "NONE", "199")
            worst = max(worst, np.linalg.norm(found[:3] - expected[:3]))
    print(f"worst difference from the circles: {worst * 1e6:.3g} mm")


if __name__ == "__main__":
    write_planets()
    write_craft()
    judge()
