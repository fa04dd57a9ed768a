"""Legs of paper 003 to the flybys of Mercury: shipped missions, flown and described by `heliotorque plan`.

The paper prints neither state nor spacecraft, corridor or aimpoint: all of these are those of the missions.
"""

import copy
import csv
import functools
import json
import pathlib

import numpy as np
import tomlkit

from study import DAY_S, Failure
from vectors import norm

MISSIONS = pathlib.Path(__file__).resolve().parents[3] / "fmu-src/resources/examples/missions"
# Between rows of a flight; windows of plans begin and end at them.
STEP_S = 6.0 * 3600.0
# The departure manoeuvre, behind the flyby: it leads back to the path at the date of the next flyby.
DEPARTURE_S = 30.0 * DAY_S
# How long a flight past the planet continues behind it.
BEHIND_S = 2.0 * 3600.0
# Flights to lead a leg at most, and when it is there: in m, and in s of the arrival.
ROUNDS, LED_M, LED_S = 10, 20.0, 0.1
# Deviations of a state from orbit determination along each axis: assumed.
POSITION_M, VELOCITY_M_S = 1e3, 5e-4
# Up to when legs are flown, so that none ends in the planet, and the next flybys.
FLYBY_1 = ("messenger-flyby1.toml", 26.5 * DAY_S, "2008-10-06T08:40:00 UTC")
FLYBY_2 = ("messenger-flyby2.toml", 201.0 * DAY_S, "2009-09-29T00:00:00 UTC")


class Leg:
    """A leg from its start on, by a mission file: a shipped one or that of a plan."""

    def __init__(self, run, flyby, file=None, stop_s=None):
        self.run, self.flyby, self.stop_s = run, flyby, stop_s or flyby[1]
        file = file or MISSIONS / flyby[0]
        self.mission = tomlkit.parse(file.read_text(encoding="utf-8")).unwrap()
        self.mission |= {key: str((file.parent / self.mission[key]).resolve()) for key in self.mission.keys() & {"spacecraft", "timeline"}}
        self.mission |= {"stop": self.stop_s, "step": STEP_S}

    def changed(self, velocity_m_s=np.zeros(3), **settings):
        """The leg with another velocity at the start, and other values."""
        leg = copy.copy(self)
        leg.__dict__.pop("encounter", None)
        velocity_m_s = np.array(self.mission["set"]["orbit.velocity"]) + velocity_m_s
        leg.mission = self.mission | {"set": self.mission["set"] | {"orbit.velocity": velocity_m_s.tolist()} | settings}
        return leg

    def scheduled(self, steps):
        """The leg with arrays that turn to offsets, in rad, at times, the first of them the start."""
        leg = self.changed(**{f"panel[{k}].control": "timeline" for k in (1, 2)})
        timeline = tomlkit.dumps({"panels": [{"at": at_s, "sunOffset": offset_rad} for at_s, offset_rad in steps]})
        leg.mission["timeline"] = str(self.run.folder() / "timeline.toml")
        pathlib.Path(leg.mission["timeline"]).write_text(timeline, encoding="utf-8")
        return leg

    def planned(self, plan):
        """The folder of what `heliotorque plan` finds."""
        return self.run.plan(self.mission, {"every": STEP_S} | plan)

    @functools.cached_property
    def encounter(self):
        """The encounter as it is."""
        compare = {"next": self.flyby[2], "departure": DEPARTURE_S, "approach": []}
        return Encounter(self.planned({"flyby": {"body": "mercury"}, "compare": compare}))

    def led(self, aim):
        """The leg with the velocity at the start that leads it to B.T, B.R (m) and arrival (s) of an aim."""
        leg = self
        for _ in range(ROUNDS):
            miss = leg.encounter.meets - aim
            if norm(miss[:2]) < LED_M and abs(miss[2]) < LED_S:
                return leg
            leg = leg.changed(-np.linalg.solve(leg.encounter.at(0.0)[:, 3:], miss))
        raise Failure(f"{self.flyby[0]}: found no flight to the aim in {ROUNDS}")

    def last(self, stop_s, names):
        """The values of variables at the end of a flight."""
        folder = self.run.folder()
        mission = self.mission | {"record": list(names), "stop": stop_s, "step": 3600.0, "every": stop_s, "output": "rows.csv"}
        mission.pop("plot", None), mission.pop("limits", None)
        (folder / "mission.toml").write_text(tomlkit.dumps(mission), encoding="utf-8")
        template = self.run.dist("MomentumPlant.fmu")
        self.run.heliotorque("run", folder / "mission.toml", "--quiet", "--template", template, "--output", folder / "rows.csv")
        with open(folder / "rows.csv", encoding="utf-8", newline="") as file:
            last = list(csv.DictReader(file))[-1]
        return [float(last[name]) for name in names]

    def closest(self):
        """Altitude and excess speed of the closest approach, as the FMU reports them past the planet."""
        stop_s = np.ceil((self.encounter.meets[2] + BEHIND_S) / 3600.0) * 3600.0
        at_s, altitude_m = self.last(float(stop_s), ["encounter.lastTime", "encounter.lastAltitude"])
        return altitude_m, self.last(at_s, ["encounter.excessSpeed"])[0]


class Encounter:
    """An encounter that `heliotorque plan` describes: B.T, B.R (m) and arrival (s), altitude, speed far away, what a miss costs, and at
    the rows of the flight its state and the partials by it."""

    def __init__(self, folder):
        self.found = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
        self.meets = np.append(self.found["aim_m"], self.found["arrival_s"])
        self.b_m, self.altitude_m, self.excess_m_s = self.meets[:2], self.found["altitude_m"], self.found["excessSpeed_m_s"]
        self.lead_s = self.found["arrival_s"] - self.found["osculation_s"]
        self.by_miss_1_s = np.array(self.found["maneuvers"]["departure"]["byMiss_1_s"])
        rows = np.loadtxt(folder / "partials.csv", delimiter=",", skiprows=1)
        self.times_s, self.states, self.partials = rows[:, 0], rows[:, 1:7], rows[:, 7:].reshape(-1, 3, 6)

    def at(self, time_s):
        """The partials at a time. Between rows those by the velocity have the rate of minus those by the position: they are cubics."""
        k = min(np.searchsorted(self.times_s, time_s, side="right"), len(self.times_s) - 1) - 1
        start_s, span_s = self.times_s[k], self.times_s[k + 1] - self.times_s[k]
        (by_r, by_v), (next_r, next_v) = (np.split(partials, 2, axis=-1) for partials in self.partials[k : k + 2])
        x, rise = (time_s - start_s) / span_s, (next_v - by_v) / span_s
        # The cubic through both ends with both rates, and minus its rate.
        first, second = -by_r - rise, -next_r - rise
        middle = (1.0 - x) * by_v + x * next_v + x * (1.0 - x) * span_s * ((1.0 - x) * first - x * second)
        rate = rise + (1.0 - x) * (1.0 - 3.0 * x) * first + x * (3.0 * x - 2.0) * second
        return np.concatenate([-rate, middle], axis=-1)

    def covariance_m2(self, time_s):
        """Covariance of B where states from orbit determination have the assumed one at a time."""
        partials = self.at(time_s)[:2] * np.repeat([POSITION_M, VELOCITY_M_S], 3)
        return partials @ partials.T

    def desired_m_s(self, time_s, miss_m):
        """The least change of the velocity at a time that takes a miss away, in m along T and R."""
        rows = self.at(time_s)[:2, 3:]
        return -rows.T @ np.linalg.solve(rows @ rows.T, miss_m)


class Corridor:
    """Bounds of the offset from the Sun that keep the light on the cells, cos(offset)/D^2 with D in AU, between two numbers of suns."""

    def __init__(self, run):
        fmu = run.fmu("MomentumPlant.fmu")
        self.least_suns, self.most_suns = (fmu.default(f"articulation.{name}Suns") for name in ("minimum", "maximum"))

    def bounds_rad(self, distance_au):
        """The least, thermal, and the greatest, by power; not a number where no offset suits."""
        least_cosine, most_cosine = (suns * np.asarray(distance_au) ** 2 for suns in (self.least_suns, self.most_suns))
        with np.errstate(invalid="ignore"):
            return np.where(least_cosine <= 1.0, np.arccos([np.minimum(most_cosine, 1.0), least_cosine]), np.nan)

    def baseline(self, times_s, distances_au):
        """The fewest steps of one offset in the corridor, as times with offsets in rad: each lasts as long as its bounds meet."""
        steps, shared, last = [], None, None
        for time_s, bounds_rad in zip(times_s, self.bounds_rad(distances_au).T):
            # A step is at the row before the first that the offset does not suit.
            if shared is None or max(shared[0], bounds_rad[0]) > min(shared[1], bounds_rad[1]):
                begin_s, shared = last or (time_s, bounds_rad)
                steps.append([begin_s, None])
            shared = [max(shared[0], bounds_rad[0]), min(shared[1], bounds_rad[1])]
            steps[-1][1], last = 0.5 * (shared[0] + shared[1]), (time_s, bounds_rad)
        return [(float(at_s), float(offset_rad)) for at_s, offset_rad in steps]
