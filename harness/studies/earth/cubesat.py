"""The CubeSat about the Earth, and its torque and momentum by effect."""

import math

import numpy as np

from vectors import norm

FMU = "Cubesat.fmu"
# Radius of the equator, from which heights count here.
EQUATOR_M = 6_378_137.0
# Gravitational parameter, by which an orbit's duration is known ahead.
GM_M3_S2 = 3.986_004_4e14

EFFECTS = ("gravity gradient", "air", "magnetic field", "sunlight", "planet light (reflected and infrared)")
SOURCES = ("gravityGradient", "aerodynamic", "magnetic", "solar", "albedo", "infrared")


def variables(kind):
    """The outputs that `by_effect` reads: of kind torque or momentum."""
    return [f"{kind}.{source}" for source in SOURCES]


def by_effect(simulated, kind):
    """Magnitudes in the order of EFFECTS, one row a point; the two kinds of planet light together."""
    *others, albedo, infrared = (simulated[name] for name in variables(kind))
    return np.column_stack([norm(vector) for vector in (*others, albedo + infrared)])


def period_s(radius_m):
    """The duration of a circular orbit."""
    return 2.0 * math.pi * math.sqrt(radius_m**3 / GM_M3_S2)
