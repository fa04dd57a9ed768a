"""The simulations of paper 000's study: what is set, and the dumps that follow."""

from dataclasses import dataclass, replace

import numpy as np

from study import DAY_S, plain

SPAN_D = 90.0
STEP_S = 600.0
# The paper's offsets are inches.
INCH_M = 0.0254
# 2009-04-06 in s past J2000 TDB: the FMU's default `start.epoch`.
START_S = 292_248_000.0

CYLINDER, PLATES, PANELS = "cylinder", "plates", "plates and panels"
# The paper's momentum, whose body components are integrated on their own, and the physical one.
CONVENTIONS = {"paper's": "bodyIntegral", "inertial": "inertial"}
# What sunlight is used for during downlinks, from the strategy that saves no dump to the one that saves most: nothing, to bring
# the momentum to zero, to bring it where the coming cycles keep it below the thresholds.
STRATEGIES = {"dumps only": "dumpsOnly", "reactive": "reactive", "predictive": "predictive"}
# What a plan with all the days in view makes of it.
OPTIMUM = "optimum"
# Share of the opposite threshold at which a dump leaves a component: the paper's, the FMU's default, zero; or the plan's.
PAPER, OWN, ZERO, PLANNED = "1.0", "0.9", "0.0", "planned"

# What a simulation chooses otherwise than the study does, where the paper prints nothing: senses of the panels' tilts off the
# Sun among it, + right-handed about their axes.
STUDY = "study's own"
CHOICES = {
    STUDY: {},
    "start 40 days later": {"start.epoch": START_S + 40.0 * DAY_S},
    "Mercury's orbit plane": {"orbit.frame": "planetOrbit"},
    "ecliptic": {"orbit.frame": "ecliptic"},
    "panel tilts + +": {"panel[1].tilt": "positive", "panel[2].tilt": "positive"},
    "panel tilts - -": {"panel[1].tilt": "negative", "panel[2].tilt": "negative"},
    "panel tilts + -": {"panel[1].tilt": "positive", "panel[2].tilt": "negative"},
    "panel tilts - +": {"panel[1].tilt": "negative", "panel[2].tilt": "positive"},
}

# Tables 2 and 3: nothing, one and two inches along -Z. Tables 4 and 5: those, both along +Z, and an inch along all axes.
ALONG_Z = ((0, 0, 0), (0, 0, -1), (0, 0, -2))
ALL_OFFSETS = (*ALONG_Z, (0, 0, 1), (0, 0, 2), (1, 1, 1), (-1, -1, -1))
NAMES = ["momentum.body", "dump.count", "dump.lastTime", "dump.impulse"]


@dataclass(frozen=True)
class Case:
    """One simulation of 90 days: what sunlight is used for, the dump threshold of all axes, where dumps leave a component, what
    the Sun pushes, which momentum, the centre of mass in inches, and what else differs."""

    strategy: str
    threshold_n_m_s: float
    dumps_to: str
    shade: str
    convention: str
    offset_in: tuple
    choice: str = STUDY

    @property
    def is_along_z(self):
        return self.offset_in[:2] == (0, 0)

    def offset_label(self):
        """The offset as the paper writes it: of Z alone, or of all axes."""
        if self.offset_in == (0, 0, 0):
            return "0 cm"
        if self.is_along_z:
            sign = "+" if self.offset_in[2] > 0 else ""
            return f"{100.0 * INCH_M * self.offset_in[2]:{sign}.2f} cm"
        return ", ".join(f"{100.0 * INCH_M * inches:+.2f}" for inches in self.offset_in) + " cm"

    def label(self):
        """Name in files and filters."""
        choice = "" if self.choice == STUDY else f", {self.choice}"
        return (
            f"{self.strategy}, {plain(self.threshold_n_m_s)} N.m.s, to {self.dumps_to}, {self.shade}, {self.convention} momentum"
            f"{choice}, {'Z ' if self.is_along_z else ''}{self.offset_label()}"
        )

    def setting_cells(self):
        """The first cells of its rows."""
        return [f"{plain(self.threshold_n_m_s)} N.m.s", self.dumps_to, self.shade, self.convention, self.strategy]

    def settings(self):
        """Settings of the case."""
        settings = {
            "solar.fixedPressure": True,
            "gravityGradient.enabled": False,
            "eclipse.method": "off",
            "panel[1].enabled": self.shade == PANELS,
            "panel[2].enabled": self.shade == PANELS,
            "sunshade.shape": "cylinder" if self.shade == CYLINDER else "plates",
            "momentum.convention": CONVENTIONS[self.convention],
            "momentum.strategy": STRATEGIES.get(self.strategy, "dumpsOnly"),
            "spacecraft.centerOfMass": [INCH_M * inches for inches in self.offset_in],
            "dump.threshold": [self.threshold_n_m_s] * 3,
        }
        if self.dumps_to.startswith("X"):
            # Along +X at this share of the threshold, whichever side it was on.
            share = float(self.dumps_to.split()[1])
            settings |= {"dump.reinitTo": "target", "dump.target[1]": share * self.threshold_n_m_s}
        elif self.dumps_to != PLANNED:
            settings["dump.reinitFraction"] = float(self.dumps_to)
        return settings | CHOICES[self.choice]

    def same(self, other, *fields):
        """Whether another differs in these fields only."""
        return replace(self, **{field: getattr(other, field) for field in fields}) == other


class Simulated:
    """A finished simulation: X momentum in the body frame by time, number and times of dumps, and their impulses."""

    def __init__(self, fmu, case, inputs=None):
        stop_s = SPAN_D * DAY_S
        found = fmu.simulate(case.label(), case.settings(), NAMES, stop_s, STEP_S, inputs=inputs, counter="dump.count")
        self.case, self.time_d, self.count = case, found.time_s / DAY_S, int(found.last("dump.count"))
        self.momentum_x_n_m_s = found["momentum.body"][:, 0]
        is_after = np.diff(found["dump.count"], prepend=0.0) > 0.0
        self.dumps_d, self.impulses_body_n_m_s = found["dump.lastTime"][is_after] / DAY_S, found["dump.impulse"][is_after]

    def spacing(self):
        """The gaps between its dumps."""
        return Spacing.of(self.dumps_d)


@dataclass(frozen=True)
class Spacing:
    """Gaps between consecutive dumps, in days: the shortest and the longest, and where the middle half lies, or what the paper
    states as typical; None where there is none."""

    dumps: int
    extremes_d: tuple | None = None
    typical_d: tuple | None = None

    @classmethod
    def of(cls, dumps_d):
        """Gaps of rising dump times."""
        gaps_d = np.diff(dumps_d)
        if len(gaps_d) == 0:
            return cls(len(dumps_d))
        return cls(len(dumps_d), (gaps_d.min(), gaps_d.max()), tuple(np.quantile(gaps_d, [0.25, 0.75])))

    def __str__(self):
        if self.extremes_d is None:
            return f"{self.dumps} in 90 d"
        closest_d, farthest_d = self.extremes_d
        if self.dumps <= 2:
            return f"2, {closest_d:.1f} d apart"
        typical = "" if self.typical_d is None else ", typical {:.0f}-{:.0f} d".format(*self.typical_d)
        return f"closest {closest_d:.1f} d, farthest {farthest_d:.1f} d{typical}"

    def five_days(self):
        """Whether the mission's five days between dumps are kept."""
        return "broken" if self.extremes_d is not None and self.extremes_d[0] < 5.0 else "kept"

    def against(self, stated):
        """Verdict on the paper's statement, whose "typical" is not defined."""
        if stated.extremes_d is None:
            return "no gap, as in the paper" if self.extremes_d is None else "off"
        is_near = self.extremes_d is not None and abs(self.extremes_d[0] / stated.extremes_d[0] - 1.0) <= 0.25
        if self.dumps == 2 and stated.dumps == 2:
            return "gap within 25 %" if is_near else "off"
        if stated.typical_d is None:
            return "closest within 25 %" if is_near else "closest off"
        if self.typical_d is None:
            return "off"
        overlaps = self.typical_d[0] <= stated.typical_d[1] and stated.typical_d[0] <= self.typical_d[1]
        if not overlaps:
            return "typical gaps off, closest within 25 %" if is_near else "off"
        return f"typical gaps overlap, closest {'within 25 %' if is_near else 'off'}"


def with_strategies(strategies, groups, thresholds_n_m_s, offsets_in):
    """The cases of every group (dumps_to, shade, convention) with every threshold, strategy and offset, in this order."""
    return [
        Case(strategy, threshold_n_m_s, *group, offset_in)
        for group in groups
        for threshold_n_m_s in thresholds_n_m_s
        for strategy in strategies
        for offset_in in offsets_in
    ]
