"""Papers 000 and 003: what a degree of windmilling, offset, azimuth and elevation, a centimetre of centre of mass and an alternation are worth.

One flight a distance from the Sun: the attitude is commanded, the place held, panels stand by a timeline of `[[panels]]`.
Momentum gathers for a minute under each change both ways; half of what both leave apart, over the change, is its worth (central
difference, off by a share of TURN_RAD squared). Momentum is inertial, by the body axes of the attitude that has the Sun on -Y.

Windmill: along the light (from the Sun to the spacecraft, its sign as for a vector) and the size of what is across it. The others:
sizes. Offset: all panels alike. Azimuth and elevation: of the Sun in the body frame. Alternation: half a turn about the Sun line,
which turns round what is across it. The CSV has all components, by the body axes of the attitude that has the Sun on -Y. Each is
a central difference of flights of MomentumPlant that is held and commanded, all its effects as its file has them.
"""

import sys

sys.path[0] += "/.."
import itertools
import math
import pathlib
import re

import numpy as np

from fmu import Failure
from study import AU_M, DAY_S, exact, main, plain
from vectors import across, angle_rad, body_direction, norm, to_body, turned

GM_SUN_M3_S2 = 1.327_124_400_18e20
DISTANCES_AU = (0.31, 0.35, 0.4, 0.5, 0.7)
# Offsets of the panels from the Sun; of a spacecraft without panels the first alone.
OFFSETS_DEG = tuple(map(float, range(0, 61, 5)))
# How long momentum gathers under each change, and the changes either way; momentum is linear in a shift.
STEP_S = 60.0
TURN_RAD = 1e-3
SHIFT_M = 1e-3
# Rounding of the momentum over that time, of the greatest that gathers: a component below it is none.
ROUNDING = 1e-12
AHEAD = body_direction(0.0, 0.0)

# By name in the CSV: the title in the figure, the unit of the worth, the changes that are simulated, and what their difference
# is divided by so that a degree, a centimetre or an alternation is left.
TURN = ("/deg", (TURN_RAD, -TURN_RAD), 2.0 * TURN_RAD / np.radians(1.0))
SHIFT = ("/cm", (SHIFT_M, -SHIFT_M), 2.0 * SHIFT_M / 0.01)
CONTROLS = {
    "windmill": ("windmill, across the light", *TURN),
    "offset": ("offset", *TURN),
    "azimuth": ("azimuth of the Sun", *TURN),
    "elevation": ("elevation of the Sun", *TURN),
    "center_x": ("centre of mass along X", *SHIFT),
    "center_y": ("centre of mass along Y", *SHIFT),
    "center_z": ("centre of mass along Z", *SHIFT),
    "alternation": ("alternation", "", (1.0,), 1.0),
}
# Variables that the study itself sets.
OWN = r"attitude\.source|command\.|momentum\.convention|dump\.threshold|orbit\.|panel\[\d+\]\.control|start\.epoch"


def between(a, b):
    """The rotation vector from one direction to another."""
    crossed = np.cross(a, b)
    return crossed * (angle_rad(a, b) / norm(crossed)) if norm(crossed) > 0.0 else crossed


# The attitude with the Sun, along inertial X, on -Y.
UPRIGHT = turned([0.0, 0.0, 0.0, 1.0], between(AHEAD, np.array([1.0, 0.0, 0.0])))


def attitude(change):
    """The attitude under a change."""
    sun = body_direction(change.get("azimuth", 0.0), change.get("elevation", 0.0))
    return turned(turned(UPRIGHT, between(sun, AHEAD)), sun * (np.pi * change.get("alternation", 0.0)))


def changes(controls):
    """Nothing, then every change of these controls."""
    return [{}, *({control: by} for control in controls for by in CONTROLS[control][2])]


class Worth:
    """Momentum that a distance and an offset leave, by body axes, in N m s a day: without a change, and by a degree, a centimetre or an
    alternation of each control."""

    def __init__(self, distance_au, offset_deg, controls, momentum_n_m_s):
        self.distance_au, self.offset_deg, self.by_control = distance_au, offset_deg, {}
        rates = to_body(UPRIGHT, np.diff(momentum_n_m_s, axis=0)) * (DAY_S / STEP_S)
        least = ROUNDING * np.abs(rates).max()

        def known(rate):
            return np.where(np.abs(rate) < least, 0.0, rate)

        self.still, first = known(rates[0]), 1
        for control in controls:
            _, _, by, per = CONTROLS[control]
            other = rates[first + 1] if len(by) > 1 else rates[0]
            self.by_control[control] = known(rates[first] - other) / per
            first += len(by)

    def along(self, control):
        """The part along the light."""
        return -self.by_control[control] @ AHEAD

    def size(self, control):
        """The size; of windmilling that of the part across the light."""
        worth = self.by_control[control]
        return norm(across(worth, AHEAD) if control == "windmill" else worth)


class Spacecraft:
    """The plant with a timeline of how its panels stand at every point: each offset under each change."""

    FILE = "MomentumPlant.fmu"

    def __init__(self, run):
        for assignment in run.options.set:
            name = assignment.split("=")[0]
            if re.match(OWN, name):
                raise Failure(f"--set: found {name}, which {run.name} sets itself, allowed: the others")
        self.run, self.file = run, run.options.spacecraft
        self.fmu = self._packed() if self.file or run.options.set else run.fmu(self.FILE)
        if "dump.count" not in self.fmu.variables:
            raise Failure(f"{self.file}: found a spacecraft of another model, allowed: one of MomentumPlant")
        self.panels = len(self.fmu.members("panel", ["control"]))
        self.controls = list(CONTROLS)
        self.offsets_deg = OFFSETS_DEG if self.panels else OFFSETS_DEG[:1]
        if self.panels:
            self._pack_timeline()
        else:
            self.controls = [control for control in CONTROLS if control not in ("windmill", "offset")]
        self.points = list(itertools.product(self.offsets_deg, changes(self.controls)))

    def _packed(self, **files):
        spacecraft = pathlib.Path(self.file) if self.file else self.run.fmu(self.FILE).resource("spacecraft.toml")
        return self.run.variant(self.FILE, self.run.options.set, spacecraft=spacecraft, **files)

    def _pack_timeline(self):
        """Packs the timeline; panels without a side refuse to windmill."""
        try:
            self.fmu = self._packed(timeline=self._timeline())
        except Failure as failure:
            if "windmill" not in str(failure):
                raise
            self.controls.remove("windmill")
            self.fmu = self._packed(timeline=self._timeline())

    def _timeline(self):
        points = enumerate(itertools.product(self.offsets_deg, changes(self.controls)))
        return "".join(
            f"[[panels]]\nat = {k * STEP_S}\nsunOffset = {math.radians(offset_deg) + change.get('offset', 0.0)}\n"
            f"windmill = {change.get('windmill', 0.0)}\n"
            for k, (offset_deg, change) in points
        )

    def worths(self, distance_au):
        """The worths by offset."""
        distance_m = distance_au * AU_M
        settings = {f"panel[{number}].control": "timeline" for number in range(1, self.panels + 1)} | {
            "attitude.source": "commanded",
            "command.source": "inputs",
            "command.kind": "attitude",
            "momentum.convention": "inertial",
            "dump.threshold": [1e6] * 3,
            "orbit.center": "sun",
            "orbit.source": "held",
            "orbit.position": [-distance_m, 0.0, 0.0],
            "orbit.velocity": [0.0, np.sqrt(GM_SUN_M3_S2 / distance_m), 0.0],
        }
        center_m = self.fmu.simulate("start", {}, ["spacecraft.centerOfMass"], 1.0, 1.0)["spacecraft.centerOfMass"][0]
        moved_m = [[change.get(f"center_{axis}", 0.0) for axis in "xyz"] for _, change in self.points]
        inputs = {
            "command.q": np.array([attitude(change) for _, change in self.points]),
            "spacecraft.centerOfMass": center_m + np.array(moved_m),
        }
        stop_s = len(self.points) * STEP_S
        label = f"{distance_au} AU"
        momentum_n_m_s = self.fmu.simulate(label, settings, ["momentum.inertial"], stop_s, STEP_S, inputs=inputs).rows
        count = len(self.points) // len(self.offsets_deg)
        return [
            Worth(distance_au, offset_deg, self.controls, momentum_n_m_s[k * count : (k + 1) * count + 1])
            for k, offset_deg in enumerate(self.offsets_deg)
        ]


def balance(spacecraft, worths):
    """Text on the offsets at which windmilling leaves nothing along the light: zeros of the cubics through the four offsets about
    a change of sign."""
    if "windmill" not in spacecraft.controls:
        why = "none of its panels has a side (`windmill_side`)" if spacecraft.panels else "it has no panels"
        return f"No windmilling: {why}.\n"
    own = [it for it in worths if it.distance_au == worths[0].distance_au]
    offsets_deg, along = (np.array(it) for it in zip(*((it.offset_deg, it.along("windmill")) for it in own)))
    zeros = []
    for k in range(len(own) - 1):
        # Where no torque is, rounding has signs.
        if along[k] * along[k + 1] < 0.0 and np.abs(along[k : k + 2]).min() > 1e-9 * np.abs(along).max():
            first = max(0, min(k - 1, len(own) - 4))
            near = slice(first, first + 4)
            cubic = np.polynomial.Polynomial.fit(offsets_deg[near], along[near], len(along[near]) - 1)
            zeros += [it.real for it in cubic.roots() if abs(it.imag) < 1e-9 and offsets_deg[k] <= it.real <= offsets_deg[k + 1]]
    shown = f"at {', '.join(f'{zero_deg:.1f} deg' for zero_deg in zeros)}" if zeros else "at none of these offsets"
    return f"Along the light windmilling is worth nothing {shown}.\n"


def draw(run, spacecraft, worths):
    """Authority of every control by offset, a line each distance; where there are no panels by distance."""
    shown = [
        (control, title, per, Worth.size) for control, (title, per, *_) in CONTROLS.items() if control in spacecraft.controls
    ]
    if "windmill" in spacecraft.controls:
        shown.insert(0, ("windmill", "windmill, along the light", "/deg", Worth.along))
    x_label = "offset of the panels from the Sun [deg]" if spacecraft.panels else "distance from the Sun [AU]"
    title = "What a change is worth in momentum a day"
    drawing, panels = run.axes(title, x_label, [f"[N.m.s/d{per}]" for _, _, per, _ in shown], 1.6)
    for k, (axes, (control, title, _, of)) in enumerate(zip(panels, shown)):
        for distance_au in dict.fromkeys(it.distance_au if spacecraft.panels else None for it in worths):
            own = [it for it in worths if distance_au in (None, it.distance_au)]
            places = [it.offset_deg if spacecraft.panels else it.distance_au for it in own]
            label = f"{distance_au} AU" if spacecraft.panels and k == 0 else "_"
            axes.plot(places, [of(it, control) for it in own], label=label)
        axes.set_title(title)
    run.figure("authority.svg", drawing)


def authority(run):
    spacecraft = Spacecraft(run)

    def label(place):
        return f"{place[0]} AU, {plain(place[1])} deg" if spacecraft.panels else f"{place[0]} AU"

    places = run.chosen(itertools.product(DISTANCES_AU, spacecraft.offsets_deg), label)
    distances_au = list(dict.fromkeys(distance_au for distance_au, _ in places))
    found = sum(run.all(distances_au, spacecraft.worths), [])
    worths = [it for it in found if (it.distance_au, it.offset_deg) in places]
    run.line("What a change is worth in momentum, by distance from the Sun and offset of the panels [N.m.s/day]\n")
    rows = []
    for it in worths:
        along = f"{it.along('windmill'):.4f}" if "windmill" in it.by_control else "-"
        sizes = (f"{it.size(control):.4f}" if control in it.by_control else "-" for control in CONTROLS)
        rows.append([str(it.distance_au), plain(it.offset_deg) if spacecraft.panels else "-", along, *sizes])
    header = "distance [AU] | offset [deg] | windmill along, a deg | across | offset, a deg | azimuth, a deg | elevation, a deg"
    run.table(f"{header} | centre of mass X, a cm | Y | Z | alternation", rows)
    run.line(balance(spacecraft, worths))
    run.remark()
    names = ["still", *CONTROLS]
    units = ["n_m_s_d", *(f"n_m_s_d{per.replace('/', '_')}" for _, per, *_ in CONTROLS.values())]
    own = "".join(f" | {name}_{axis}_{per}" for name, per in zip(names, units) for axis in "xyz")
    cells = []
    for it in worths:
        vectors = [it.still, *(it.by_control.get(control) for control in CONTROLS)]
        numbers = (["", "", ""] if vector is None else map(exact, vector) for vector in vectors)
        cells.append([exact(it.distance_au), exact(it.offset_deg), *itertools.chain(*numbers)])
    run.csv("authority.csv", f"distance_au | offset_deg{own}", cells)
    draw(run, spacecraft, worths)


SPACECRAFT = {"metavar": "TOML", "help": "spacecraft file (default: that of MomentumPlant.fmu)"}
SET = {"metavar": "NAME=VALUE", "action": "append", "default": [], "help": "another start value, as for pack; repeatable"}

main(authority, spacecraft=SPACECRAFT, set=SET)
