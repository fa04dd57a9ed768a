"""Paper 003's steps to the second flyby: momentum planned, departure led to that plan, its error, and plans anew by sunlight."""

import csv
import json
from dataclasses import dataclass

import numpy as np

from flyby.leg import FLYBY_2, STEP_S, Leg
from flyby.plane import Target
from study import DAY_S

# Miss behind the departure, along T and R; its direction is assumed.
DEPARTURE_MISS_M = np.array([-170e3, 0.0])
# The plan of momentum alone: tilts and momentum leave room for what corrects later.
MOMENTUM = {
    "window": "10 d",
    "windmill": "2 deg",
    "alternation": 0.0,
    "momentum": {"limit": "4.5 N.m.s", "margin": 0.0},
    "tilt": {"azimuth": "5 deg", "elevation": "6 deg"},
}

ASSUMED = """\
Assumed, as it is not published: state at the departure, mass, centre of mass and aim (messenger-flyby2.toml, 200 km, B along T), the
corridor of the arrays, that the miss is along -T, and the state's covariance: 1 km and 0.5 mm/s along each axis. Ellipses: three
deviations by that alone."""


# The paper's threshold of dumps, in N m s.
THRESHOLD_N_M_S = 5.5


@dataclass
class Correction:
    """A correction of the paper: its figure and date, days before the flyby, windows of the plan, the drift along T and R in m that
    orbit determination found since the plan before, the limit of momentum in N m s, of which the earlier ones leave something of
    the threshold, and contours in m/s."""

    figure: int
    date: str
    before_d: float
    window: str
    drift_m: tuple
    limit_n_m_s: float
    costs_m_s: tuple

    def plan(self, at_s, position_m, velocity_m_s, aim_m):
        """The plan file from a state on, with the keep-in zone of the paper, and offsets of the arrays off the baseline of the rest
        of the leg, or as the plan before has them."""
        return {
            "window": self.window,
            "windmill": "2 deg",
            "alternation": 0.0,
            "momentum": {"limit": f"{self.limit_n_m_s} N.m.s", "margin": 0.0},
            "sunOffset": {"change": True, "largest": "5 deg"},
            "tilt": {"azimuth": "10 deg", "elevation": "12 deg"},
            "flyby": {"body": "mercury", "bT": float(aim_m[0]), "bR": float(aim_m[1]), "from": at_s},
            "update": {"at": at_s, "position": position_m.tolist(), "velocity": velocity_m_s.tolist()},
        }


CORRECTIONS = (
    Correction(7, "17 June 2008", 111.0, "10 d", (0.0, 0.0), 5.0, (20.0, 40.0, 80.0, 120.0)),
    Correction(8, "18 September 2008", 18.0, "1 d", (-4e3, 0.0), 5.3, (1.0, 2.0, 4.0)),
    # The printed 4 km.
    Correction(9, "29 September 2008", 7.0, "1 d", (2.83e3, 2.83e3), 5.45, (1.0, 2.0, 4.0)),
)


class Steps:
    """The second flyby's leg: its aim, led to the plan of momentum, with the error of the departure, and corrected."""

    def __init__(self, run, corrections=0):
        unmanaged = Leg(run, FLYBY_2)
        self.target, self.aimed_altitude_m = Target(unmanaged), unmanaged.encounter.altitude_m
        planned = unmanaged.planned(MOMENTUM)
        self.windows = read_windows(planned)
        self.led = Leg(run, FLYBY_2, planned / "mission.toml").led(self.target.aim)
        self.error_m_s = self.led.encounter.desired_m_s(0.0, -DEPARTURE_MISS_M)
        self.departed = self.led.changed(self.error_m_s)
        self.corrected = []
        for correction in CORRECTIONS[:corrections]:
            last = self.corrected[-1].after if self.corrected else self.departed
            self.corrected.append(Corrected(self, correction, last))


class Corrected:
    """The leg before and after a correction: the plan before from a time on, with a state that moves its intercept by the least
    change of velocity, and the plan anew from there."""

    def __init__(self, steps, correction, last):
        found = last.encounter
        at_s = round((found.meets[2] - correction.before_d * DAY_S) / STEP_S) * STEP_S
        state = found.states[np.searchsorted(found.times_s, at_s)]
        velocity_m_s = state[3:] + found.desired_m_s(at_s, -np.array(correction.drift_m))
        planned = last.planned(correction.plan(at_s, state[:3], velocity_m_s, steps.target.aim_m))
        self.plan = json.loads((planned / "plan.json").read_text(encoding="utf-8"))
        self.windows, self.before_m = read_windows(planned), np.array(self.plan["missBefore_m"])
        self.after = Leg(last.run, FLYBY_2, planned / "mission.toml", last.stop_s - at_s)
        self.miss_m = self.after.encounter.b_m - steps.target.aim_m
        self.altitude_offset_m = self.after.closest()[0] - steps.aimed_altitude_m


def read_windows(planned):
    """The windows of a plan: start in s, offset in deg."""
    with open(planned / "windows.csv", encoding="utf-8") as file:
        return np.array([[float(row["start_s"]), float(row["offset_deg"])] for row in csv.DictReader(file)])
