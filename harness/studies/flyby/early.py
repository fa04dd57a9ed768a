"""The first flyby of Mercury with its arrays turned when the baseline has it, and three days early, as paper 003's Figure 3 has it."""

import numpy as np

from flyby.leg import FLYBY_1, Corridor, Leg
from flyby.plane import Target
from study import AU_M, DAY_S
from vectors import norm, unit

EARLIER_S = 3.0 * DAY_S
# Printed misses before and behind the change.
BEFORE_M = 10e3
BEHIND_M = 11e3


class Early:
    """Misses, altitudes and costs before and behind the change of the arrays."""

    def __init__(self, run):
        leg = Leg(run, FLYBY_1)
        first, self.target = leg.encounter, Target(leg)
        steps = Corridor(run).baseline(first.times_s, norm(first.states[:, :3]) / AU_M)
        early = [*steps[:-1], (steps[-1][0] - EARLIER_S, steps[-1][1])]
        # Before the flyby, and from what to what the arrays turn, in rad.
        self.step_s, self.turned_rad = first.meets[2] - steps[-1][0], (steps[-2][1], steps[-1][1])
        nominal = leg.scheduled(steps).led(self.target.aim)
        moved_m = nominal.scheduled(early).encounter.b_m - nominal.encounter.b_m
        # A state with the miss before the change: by the least change of velocity.
        before_m = before_change_m(self.target, moved_m)
        changed = nominal.changed(nominal.encounter.desired_m_s(0.0, -before_m))
        legs = changed, changed.scheduled(early)
        before, behind = (it.encounter for it in legs)
        self.misses_m = [it.b_m - self.target.aim_m for it in (before, behind)]
        self.altitude_offsets_m = [it.closest()[0] - first.altitude_m for it in legs]
        self.covariance_m2 = behind.covariance_m2(steps[-1][0] - EARLIER_S)
        # Direction along T and R that a place nearer to the Sun is moved to.
        self.sunward = unit(-before.partials[-1, :2, :3] @ before.states[-1, :3])


def before_change_m(target, moved_m):
    """A miss of the first printed size that moves to one of the second: of both that at which the altitude changes most to that of
    the aim."""
    size_m = norm(moved_m)
    along = moved_m / size_m
    along_m = (BEHIND_M**2 - BEFORE_M**2 - size_m**2) / (2.0 * size_m)
    aside_m = np.sqrt(BEFORE_M**2 - along_m**2) * np.array([-along[1], along[0]])

    def gained_m(miss_m):
        return abs(target.altitude_offset_m(miss_m)) - abs(target.altitude_offset_m(miss_m + moved_m))

    return max((along_m * along + aside_m, along_m * along - aside_m), key=gained_m)
