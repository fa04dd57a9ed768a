"""Paper 000: dumps and momentum a day with misaligned, unequal and slowly turning parts, the paper's open questions."""

import sys

sys.path[0] += "/.."
import numpy as np
import tomlkit

from momentum.cases import CONVENTIONS, OWN, PANELS, SPAN_D, STEP_S, STRATEGIES, Case
from study import DAY_S, main
from vectors import norm

# Above all that gathers.
NO_DUMPS = {"dump.threshold": [1e6] * 3}
# The paper's plates and panels; strategy and momentum vary.
CASE = Case("dumps only", 5.5, OWN, PANELS, "paper's", (0, 0, -1))

REMARK = """\
Dumps: with dumps only / reactive / predictive targets; 5.5 N.m.s, to 0.9 of the opposite threshold, centre of mass at
Z = -2.54 cm. Momentum a day: mean magnitude of what each of the 90 days adds without dumps or targets. Unchanged: panels at
65 deg, shade cloth of specular 0.15, turns at once. An axis of a panel is turned with its cell side."""


def shade(*rotation_deg):
    """The sunshade turned."""

    def edit(spacecraft):
        spacecraft["sunshade"]["rotation_deg"] = list(rotation_deg)

    return edit


def named(tables, name):
    """The first table of a list with this name."""
    return next(table for table in tables if table["name"] == name)


def axis(panels, toward):
    """Axes of panels turned by a degree toward Z, or toward -Y with the cell side."""

    def edit(spacecraft):
        for name in panels:
            panel = named(spacecraft["panels"], name)
            panel["axis"] = [0.99984770, 0.0, 0.01745241] if toward == "Z" else [0.99984770, -0.01745241, 0.0]
            if toward == "-Y":
                panel["zero_normal"] = [-0.01745241, -0.99984770, 0.0]

    return edit


def aged(plate):
    """A plate of the sunshade of specular 0.10."""

    def edit(spacecraft):
        spacecraft["optics"]["aged"] = {"specular": 0.10, "diffuse": 0.35}
        named(spacecraft["sunshade"]["plates"], plate)["optics"] = "aged"

    return edit


def offsets(*angles_deg):
    return {f"panel[{number}].sunOffset": np.radians(angle_deg) for number, angle_deg in enumerate(angles_deg, 1)}


# Each with the change of the spacecraft file, and of parameters.
CHANGES = {
    "nothing": (None, {}),
    "shade turned 1 deg about X": (shade(1.0, 0.0, 0.0), {}),
    "shade turned 1 deg about Y": (shade(0.0, 1.0, 0.0), {}),
    "shade turned 1 deg about Z": (shade(0.0, 0.0, 1.0), {}),
    "axis of +X panel 1 deg toward Z": (axis(["+X"], "Z"), {}),
    "axis of +X panel 1 deg toward -Y": (axis(["+X"], "-Y"), {}),
    "axes of both panels 1 deg toward -Y": (axis(["+X", "-X"], "-Y"), {}),
    "+X panel at 66 deg": (None, offsets(66.0)),
    "panels at 66 and 64 deg": (None, offsets(66.0, 64.0)),
    "panels at 66 and 66 deg": (None, offsets(66.0, 66.0)),
    "side +X at specular 0.10": (aged("side +X"), {}),
    "front at specular 0.10": (aged("front"), {}),
    "top front at specular 0.10": (aged("top front"), {}),
    "turns at 0.1 deg/s": (None, {"guided.slewRate": np.radians(0.1)}),
    "turns at 0.01 deg/s": (None, {"guided.slewRate": np.radians(0.01)}),
}


def sensitivity(run):
    changes = run.chosen(CHANGES)
    template = run.fmu("MomentumPlant.fmu")

    def row(change):
        edit, settings = CHANGES[change]
        fmu = template
        if edit is not None:
            spacecraft = tomlkit.parse(template.resource("spacecraft.toml"))
            edit(spacecraft)
            fmu = run.variant("MomentumPlant.fmu", spacecraft=tomlkit.dumps(spacecraft))
        settings, stop_s = CASE.settings() | settings, SPAN_D * DAY_S
        cells = [change]
        for item, momentum in zip(CONVENTIONS.values(), ("momentum.body", "momentum.inertial")):
            own = settings | {"momentum.convention": item}
            counts = []
            for strategy in STRATEGIES.values():
                found = fmu.simulate(change, own | {"momentum.strategy": strategy}, ["dump.count"], stop_s, STEP_S, every=144)
                counts.append(f"{found.last('dump.count'):.0f}")
            daily = fmu.simulate(change, own | NO_DUMPS, [momentum], stop_s, STEP_S, every=144)[momentum]
            cells += [" / ".join(counts), f"{norm(np.diff(daily, axis=0)).sum() / SPAN_D:.4f}"]
        return cells

    rows = run.all(changes, row)
    run.line("Small changes of the spacecraft: dumps in 90 days and momentum a day (paper 000, plates and panels)\n")
    header = "change | dumps, paper's | paper's a day [N.m.s] | dumps, inertial | inertial a day [N.m.s]"
    run.table_and_csv("sensitivity.csv", header, rows)
    run.line(REMARK)


main(sensitivity)
