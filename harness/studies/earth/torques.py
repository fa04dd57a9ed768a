"""No paper: every torque on a CubeSat about the Earth against height, 180 to 36,000 km."""

import sys

sys.path[0] += "/.."
import numpy as np

from earth.cubesat import EFFECTS, EQUATOR_M, FMU, by_effect, period_s, variables
from study import brief, main, scientific

# Orbits evenly spaced by the logarithm of the height.
HEIGHTS_M = 180e3 * (36e6 / 180e3) ** (np.arange(25) / 24.0)
# Communication points of an orbit.
POINTS = 200.0
TICKS_KM = (200, 500, 1000, 2000, 5000, 10_000, 20_000, 36_000)


def label(height_m):
    return f"{height_m / 1e3:.0f} km"


def air_equals_sunlight_km(heights_m, mean_n_m):
    """The height at which air falls below sunlight, by logarithms; None if it is not between the first and the last."""
    with np.errstate(divide="ignore"):
        excess, heights = np.log(mean_n_m[:, 1] / mean_n_m[:, 3]), np.log(heights_m)
    below = np.flatnonzero((excess[:-1] > 0.0) & (excess[1:] <= 0.0))
    if len(below) == 0:
        return None
    k = below[0]
    share = excess[k] / (excess[k] - excess[k + 1]) if np.isfinite(excess[k + 1]) else 0.5
    return np.exp(heights[k] + (heights[k + 1] - heights[k]) * share) / 1e3


def torques(run):
    heights_m = np.array(run.chosen(HEIGHTS_M, label))
    fmu = run.fmu(FMU)

    def one_orbit(height_m):
        radius_m = EQUATOR_M + height_m
        orbit = {"orbit.dynamics": "twoBody", "orbit.semiMajorAxis": radius_m, "orbit.eccentricity": 0.0}
        duration_s = period_s(radius_m)
        simulated = fmu.simulate(label(height_m), orbit, variables("torque"), duration_s, duration_s / POINTS)
        torque_n_m = by_effect(simulated, "torque")
        return torque_n_m.mean(axis=0), torque_n_m.max(axis=0)

    mean_n_m, greatest_n_m = np.moveaxis(run.all(heights_m, one_orbit), 1, 0)
    run.line(
        "Torque on a 12U CubeSat that points to the nadir, on circular orbits of 97.4 deg, mean magnitude over an\n"
        "orbit; air by NRLMSISE-00 at F10.7 150 and Ap 4, Sentman's law; field by IGRF-14, a residual dipole of 0.035 A m2\n"
    )
    run.table(
        "height [km] | " + " | ".join(f"{effect} [N m]" for effect in EFFECTS),
        [[f"{height_m / 1e3:.0f}", *(brief(mean) for mean in means)] for height_m, means in zip(heights_m[::4], mean_n_m[::4])],
    )
    crossing_km = air_equals_sunlight_km(heights_m, mean_n_m)
    if crossing_km is not None:
        run.line(f"Air is the greater of air and sunlight up to {crossing_km:.0f} km.")
    pairs = np.stack([mean_n_m, greatest_n_m], axis=2).reshape(len(heights_m), -1)
    run.csv(
        "torques.csv",
        "height [km]" + "".join(f" | {effect} mean [N m] | {effect} greatest [N m]" for effect in EFFECTS),
        ([f"{height_m / 1e3:.3f}", *scientific(numbers)] for height_m, numbers in zip(heights_m, pairs)),
    )
    drawing, (axes,) = run.axes("Torque on a 12U CubeSat by height", "height [km]", ["mean torque [N m]"], 4.0)
    for effect, means in zip(EFFECTS, mean_n_m.T):
        axes.plot(heights_m / 1e3, np.where(means >= 1e-14, means, np.nan), label=effect)
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(TICKS_KM, [str(tick_km) for tick_km in TICKS_KM])
    axes.minorticks_off()
    run.figure("torques.svg", drawing)


main(torques)
