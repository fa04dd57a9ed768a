"""Paper 004: accelerations around one orbit, four positions of Mercury."""

import sys

sys.path[0] += "/.."
from study import agrees, main, plain, scientific
from thermal.orbit import EFFECTS, fmus
from thermal.tables import chosen_cases, one_orbit


def figure12(run):
    cases = chosen_cases(run)
    both = fmus(run)
    found = run.all(cases, lambda case: one_orbit(both, case))
    run.line("Solar, albedo, infrared and recoil around one orbit (paper 004, Figure 12)\n")
    means = [accelerations.thermal_share().mean() for accelerations in found]
    run.table(
        "case | paper: mean sum of thermal effects | ours | verdict",
        [[str(case), "20-30 %", f"{mean * 100.0:.1f} %", agrees(0.195 <= mean <= 0.305)] for case, mean in zip(cases, means)],
    )
    drawing, panels = run.axes("Accelerations around one orbit", "time [h]", ["a [1e-7 m/s2]"] * len(cases))
    for case, accelerations, axes in zip(cases, found, panels):
        for effect, values in zip(EFFECTS, accelerations.effects.T):
            axes.plot(accelerations.time_s / 3600.0, values * 1e7, label=f"{effect}, case {case}")
    run.figure("figure12.svg", drawing)
    rows = (
        [case, plain(time_s), *scientific(effects)]
        for case, accelerations in zip(cases, found)
        for time_s, effects in zip(accelerations.time_s[::4], accelerations.effects[::4])
    )
    run.csv("figure12.csv", "case | time_s | solar_m_s2 | albedo_m_s2 | infrared_m_s2 | thermal_m_s2", rows)


main(figure12)
