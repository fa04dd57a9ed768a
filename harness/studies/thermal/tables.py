"""Tables 7 and 8 of paper 004: extremes of the accelerations around one orbit, by four positions of Mercury."""

import numpy as np

from thermal.orbit import EFFECTS, Accelerations, fmus

# "One revolution of the orbiter (i.e. 12 hours)", from periapsis.
DURATION_S = 43_200.0
STEP_S = 15.0
# Belts of the planet's cells: odd, which the paper's infrared betrays; their number it does not print.
BELTS = 45
# Mercury's true anomaly at the start, by case.
TRUE_ANOMALY_DEG = {1: 10.0, 2: 98.0, 3: 189.0, 4: 279.0}

# Greatest and least by case and effect, as printed: solar in 1e-7 m/s2, only the greatest, the others in % of it.
# Table 7 is by the analytical model, Table 8 by the numerical one.
TABLE_7 = {
    1: [(8.45, None), (0.32, 0.02), (6.68, 0.18), (25.60, 23.44)],
    2: [(5.51, None), (2.37, 0.00), (14.10, 0.01), (23.24, 18.80)],
    3: [(3.71, None), (0.95, 0.01), (19.24, 0.14), (19.99, 18.81)],
    4: [(6.22, None), (6.45, 0.00), (26.79, 0.00), (24.05, 17.93)],
}
TABLE_8 = {
    1: [(8.45, None), (0.20, 0.00), (3.66, 0.17), (23.78, 23.31)],
    2: [(5.51, None), (4.40, 0.00), (25.22, 0.02), (20.43, 18.46)],
    3: [(3.72, None), (0.77, 0.01), (17.56, 0.08), (18.97, 16.89)],
    4: [(6.33, None), (6.11, 0.00), (25.70, 0.00), (21.33, 17.74)],
}

REMARK = """\
Greatest / least around the orbit, the verdict on the greatest. Albedo, infrared and recoil in % of the greatest solar
acceleration, the least solar and recoil without eclipses. Not printed in the paper, chosen because they fit, once for
all cases: 1365 W/m2 at 1 AU, planet absorptivity 0.88, diffuse reflectivity 0.12, emissivity 0.9, night side 100 K,
700 kg, panel conductance 18 W/m2/K with a radiative exchange of 0.11. Ours is the limit of many planet cells. By
cells: the paper's way to sum, here on 45 belts of 90; an odd number has a meridian of cells right on the terminator,
and these count as lit."""


def chosen_cases(run):
    """The cases that --only leaves."""
    return run.chosen(TRUE_ANOMALY_DEG, lambda case: f"case {case}")


def one_orbit(fmus, case, **model):
    """The accelerations around one orbit."""
    return Accelerations(fmus, TRUE_ANOMALY_DEG[case], DURATION_S, STEP_S, **model)


def as_printed(accelerations):
    """Greatest and least by effect in the paper's units; solar and recoil are taken in the light only."""
    extremes = []
    for column, effect in enumerate(EFFECTS):
        values = accelerations.effects[:, column]
        if effect in ("solar", "thermal"):
            values = values[accelerations.is_lit]
        unit = 1e-7 if effect == "solar" else extremes[0][0] * 1e-7 / 100.0
        extremes.append((values.max(initial=0.0) / unit, values.min(initial=np.inf) / unit))
    return extremes


def table(run, name, printed, title, remark, tolerances, is_moving):
    """One table, as text, CSV and figure; tolerances of the greatest by effect, relative to the printed one."""
    cases = chosen_cases(run)
    both = fmus(run)

    def simulate(case):
        return [as_printed(one_orbit(both, case, is_moving=is_moving, belts=belts)) for belts in (None, BELTS)]

    found = run.all(cases, simulate)
    rows = []
    for case, (ours, cells) in zip(cases, found):
        for column, (effect, tolerance) in enumerate(zip(EFFECTS, tolerances)):
            greatest, least = printed[case][column]
            digits = 3 if effect == "solar" else 2
            off, cells_off = ours[column][0] / greatest - 1.0, cells[column][0] / greatest - 1.0
            limit = f"{tolerance * 100.0:g} %"
            rows.append(
                [
                    str(case),
                    f"{effect} [{'1e-7 m/s2' if effect == 'solar' else '%'}]",
                    f"{greatest:.2f}" if least is None else f"{greatest:.2f} / {least:.2f}",
                    " / ".join(f"{it:.{digits}f}" for it in ours[column]),
                    f"{off * 100.0:+.1f} %",
                    "-" if least is None else f"{ours[column][1] - least:+.2f} points",
                    f"within {limit}" if abs(off) <= tolerance else f"off by more than {limit}",
                    " / ".join(f"{it:.{digits}f}" for it in cells[column]),
                    f"{cells_off * 100.0:+.1f} %",
                ]
            )
    run.line(title + "\n")
    header = (
        "case | effect | paper | ours | difference of the greatest | difference of the least | verdict | by cells | difference"
    )
    run.table_and_csv(f"{name}.csv", header, rows)

    units = ["1e-7 m/s2", *["% of solar"] * 3]
    labels = [f"{effect} [{unit}]" for effect, unit in zip(EFFECTS, units)]
    drawing, panels = run.axes("Greatest acceleration around one orbit", "", labels)
    for column, axes in enumerate(panels):
        bars = {
            "paper": [printed[case][column][0] for case in cases],
            "ours": [ours[column][0] for ours, _ in found],
            "ours, planet by cells": [cells[column][0] for _, cells in found],
        }
        for k, (label, values) in enumerate(bars.items()):
            axes.bar(np.arange(len(cases)) + 0.27 * (k - 1), values, 0.25, label=label)
        axes.set_xticks(range(len(cases)), [f"case {case}: true anomaly {TRUE_ANOMALY_DEG[case]:g} deg" for case in cases])
        axes.set_xmargin(0.03)
    run.figure(f"{name}.svg", drawing)
    run.line(REMARK)
    run.line(remark)
