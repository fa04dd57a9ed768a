"""Paper 000: storage and mass of the wheels against dumps, by strategy."""

import sys

sys.path[0] += "/.."
import numpy as np

from momentum.cases import CONVENTIONS, OWN, PANELS, STRATEGIES, Simulated, with_strategies
from study import main

# Storage of a wheel, mass of four, threshold: "between 4 and 12 Nms per wheel with a total mass between 12 and 20 kg", of which
# 17 kg "will allow 8 Nms"; the thresholds are those of small, intermediate and large wheels. Straight lines between.
CAPACITIES_N_M_S = (4.0, 6.0, 8.0, 10.0, 12.0)
MASSES_KG = np.interp(CAPACITIES_N_M_S, [4.0, 8.0, 12.0], [12.0, 17.0, 20.0])
THRESHOLDS_N_M_S = np.interp(CAPACITIES_N_M_S, [4.0, 8.0, 12.0], [4.0, 5.5, 7.0])
OFFSETS_IN = ((0, 0, -1), (0, 0, -2))

REMARK = """\
Centre of mass at Z = -2.54 / -5.08 cm; a star where two dumps are less than the mission's five days apart. Dumps go to
0.9 of the opposite threshold. Printed: 4, 8 and 12 N.m.s; 12, 17 and 20 kg; thresholds 4, 5.5 and 7 N.m.s; straight lines
between. The paper does not print the wheels' axes: up to which threshold no wheel saturates holds for messenger.toml's
pyramid."""


def guaranteed_n_m_s(fmu, capacity_n_m_s):
    """The threshold up to which no wheel saturates, as the plant computes it from axes and storage."""
    capacities = {f"wheel[{k}].capacity": capacity_n_m_s for k in (1, 2, 3, 4)}
    return fmu.simulate("wheels", capacities, ["dump.guaranteedThreshold"], 1.0, 1.0).last("dump.guaranteedThreshold")


def wheels(run):
    groups = [(OWN, PANELS, convention) for convention in CONVENTIONS]
    cases = with_strategies(STRATEGIES, groups, THRESHOLDS_N_M_S.tolist(), OFFSETS_IN)
    cases = run.chosen(cases, lambda case: case.label())
    fmu = run.fmu("MomentumPlant.fmu")
    simulated = run.all(cases, lambda case: Simulated(fmu, case))

    def of(strategy, threshold_n_m_s, convention):
        wanted = (strategy, threshold_n_m_s, convention)
        return [it for it in simulated if (it.case.strategy, it.case.threshold_n_m_s, it.case.convention) == wanted]

    def dumps(found):
        starred = (f"{it.count}{'*' if it.spacing().five_days() == 'broken' else ''}" for it in found)
        return " / ".join(starred) if found else "-"

    rows = []
    for capacity_n_m_s, mass_kg, threshold_n_m_s in zip(CAPACITIES_N_M_S, MASSES_KG, THRESHOLDS_N_M_S):
        guaranteed = f"{guaranteed_n_m_s(fmu, capacity_n_m_s):.3f}"
        head = [f"{capacity_n_m_s:.0f}", f"{mass_kg:.2f}", f"{threshold_n_m_s:.3f}", guaranteed]
        for convention in CONVENTIONS:
            rows.append([*head, convention, *(dumps(of(it, threshold_n_m_s, convention)) for it in STRATEGIES)])
    run.line("Thruster dumps in 90 days over the storage of the wheels (paper 000), plates and panels\n")
    header = "storage [N.m.s] | mass of four [kg] | threshold [N.m.s] | no wheel saturates up to [N.m.s] | momentum"
    run.table_and_csv("wheels.csv", f"{header} | dumps only | reactive | predictive", rows)
    run.line(REMARK)

    shown = [(convention, offset_in) for convention in CONVENTIONS for offset_in in OFFSETS_IN]
    labels = [f"{convention}, Z {2.54 * offset_in[2]:.2f} cm" for convention, offset_in in shown]
    title = "Thruster dumps in 90 days over the mass of four wheels, by momentum and offset"
    drawing, panels = run.axes(title, "mass of four wheels [kg]: 12 kg store 4 N.m.s a wheel, 17 kg 8, 20 kg 12", labels)
    for (convention, offset_in), axes in zip(shown, panels):
        for strategy in STRATEGIES:
            by_wheels = (of(strategy, threshold_n_m_s, convention) for threshold_n_m_s in THRESHOLDS_N_M_S)
            counts = [[it.count for it in found if it.case.offset_in == offset_in] for found in by_wheels]
            points = [(mass_kg, count) for mass_kg, own in zip(MASSES_KG, counts) for count in own]
            if points:
                axes.plot(*zip(*points), label=strategy)
        axes.set_ylim(bottom=-0.5)
    run.figure("wheels.svg", drawing)


main(wheels)
