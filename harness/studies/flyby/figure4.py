"""Paper 003: corridor of the arrays by distance, and the offsets of baseline and plan in it."""

import sys

sys.path[0] += "/.."
import numpy as np

from flyby.leg import Corridor
from flyby.steps import Steps
from study import AU_M, DAY_S, exact, main, verdict
from vectors import norm

# Distances of the corridor.
DISTANCES_AU = 0.30 + 0.005 * np.arange(83)


def schedule(encounter, windows):
    """Distances from the Sun in AU by day of a leg, and the offsets of its plan there in deg, without windmilling."""
    daily = encounter.times_s % DAY_S == 0.0
    at = np.searchsorted(windows[:, 0], encounter.times_s[daily], side="right") - 1
    return norm(encounter.states[daily, :3]) / AU_M, windows[at, 1]


def figure4(run):
    steps, corridor = Steps(run, 1), Corridor(run)
    last = steps.corrected[-1]
    schedules = {
        "baseline": schedule(steps.led.encounter, steps.windows),
        "plan of 17 June 2008": schedule(last.after.encounter, last.windows),
    }
    rows = []
    for label, (distance_au, offset_deg) in schedules.items():
        least_deg, most_deg = np.degrees(corridor.bounds_rad(distance_au))
        margin_deg = np.minimum(offset_deg - least_deg, most_deg - offset_deg).min()
        changes = np.sum(np.diff(offset_deg) != 0.0)
        rows.append([label, str(changes), f"{margin_deg:.2f}", verdict(margin_deg >= 0.0)])
    run.line("Offsets of the arrays from the Sun in their corridor (paper 003, Figure 4)\n")
    run.table("schedule | changes | least margin [deg] | within the corridor", rows)
    run.line(
        "The paper prints no number of its corridor. Assumed: 2.0 to 4.2 suns on the cells, cos(offset)/D^2 with D in AU "
        "([articulation] of messenger.toml). Both schedules are of the leg to flyby 2; windmilling is beside them."
    )
    bounds_deg = np.degrees(corridor.bounds_rad(DISTANCES_AU))
    title = "Offset of the arrays by distance"
    drawing, (axes,) = run.axes(title, "distance from the Sun [AU]", ["offset from the Sun [deg]"], 4.0)
    for label, bound_deg in zip(("least, thermal", "greatest, power"), bounds_deg):
        axes.plot(DISTANCES_AU, bound_deg, "--", label=label)
    for label, points in schedules.items():
        axes.plot(*points, ".", label=label)
    run.figure("figure4.svg", drawing)
    both = zip(DISTANCES_AU, *bounds_deg)
    cells = [it for au, least, most in both if least == least for it in (("least", au, least), ("greatest", au, most))]
    cells += [(label, *it) for label, points in schedules.items() for it in zip(*points)]
    rows = ([label, exact(distance_au), exact(offset_deg)] for label, distance_au, offset_deg in cells)
    run.csv("figure4.csv", "what | distance_au | offset_deg", rows)


main(figure4)
