"""No paper: a day of a CubeSat at 500 km: torque and momentum by effect, air."""

import sys

sys.path[0] += "/.."
import numpy as np

from earth.cubesat import EFFECTS, FMU, by_effect, variables
from study import DAY_S, brief, main, plain, scientific
from vectors import norm

STEP_S = 60.0


def day(run):
    names = [*variables("torque"), *variables("momentum"), "momentum.body", "atmosphere.density", "geodetic.height"]
    simulated = run.fmu(FMU).simulate("a day at 500 km", {}, names, DAY_S, STEP_S)
    torque_n_m, momentum_n_m_s = by_effect(simulated, "torque"), by_effect(simulated, "momentum")
    density_kg_m3 = simulated["atmosphere.density"]
    run.line("A 12U CubeSat for a day at 500 km, pointing to the nadir, its wheels taking everything\n")
    columns = np.column_stack([torque_n_m.mean(axis=0) * 1e6, torque_n_m.max(axis=0) * 1e6, momentum_n_m_s[-1] * 1e3])
    run.table(
        "effect | mean torque [uN m] | greatest [uN m] | momentum after the day [mN m s]",
        [[effect, *(f"{number:.3f}" for number in numbers)] for effect, numbers in zip(EFFECTS, columns)],
    )
    least, most = (brief(density, 2) for density in (density_kg_m3.min(), density_kg_m3.max()))
    run.line(
        f"System momentum after the day {norm(simulated.last('momentum.body')) * 1e3:.3f} mN m s; density {least} to {most} kg/m3, "
        f"height {simulated.last('geodetic.height') / 1e3:.1f} km at the end."
    )
    pairs = np.stack([torque_n_m, momentum_n_m_s], axis=2).reshape(len(torque_n_m), -1)
    run.csv(
        "day.csv",
        "time [s] | density [kg/m3]" + "".join(f" | {effect} torque [N m] | {effect} momentum [N m s]" for effect in EFFECTS),
        (
            [plain(time_s), *scientific([density, *numbers])]
            for time_s, density, numbers in zip(simulated.time_s, density_kg_m3, pairs)
        ),
    )
    labels = ["torque [uN m]", "momentum [mN m s]", "density [1e-12 kg/m3]"]
    drawing, (torque, momentum, air) = run.axes("A 12U CubeSat for a day at 500 km", "time [h]", labels)
    hours = simulated.time_s / 3600.0
    for k, effect in enumerate(EFFECTS):
        torque.plot(hours, torque_n_m[:, k] * 1e6, label=effect)
        momentum.plot(hours, momentum_n_m_s[:, k] * 1e3, label=effect)
    air.plot(hours, density_kg_m3 * 1e12, label="density of the air")
    run.figure("day.svg", drawing)


main(day)
