"""Paper 003: velocity change that leads to the second flyby's aim, by its time."""

import sys

sys.path[0] += "/.."
import numpy as np

from flyby.leg import FLYBY_2, Leg
from study import DAY_S, exact, main, verdict
from vectors import norm

# What is to be taken away, along T and R; the direction is assumed.
MISS_M = np.array([-170e3, 0.0])
# Before the flyby.
TIMES_D = 200.0 - 0.5 * np.arange(400)


def figure5(run):
    encounter = Leg(run, FLYBY_2).encounter
    change_m_s = np.array([encounter.desired_m_s(encounter.meets[2] - time_d * DAY_S, MISS_M) for time_d in TIMES_D])
    size_m_s, x, y, z = norm(change_m_s), *change_m_s.T
    ascension_deg, declination_deg = np.degrees(np.arctan2(y, x)) % 360.0, np.degrees(np.arctan2(z, np.hypot(x, y)))
    mm_s = dict(zip(TIMES_D, 1e3 * size_m_s))
    least_d = TIMES_D[np.argmin(size_m_s)]

    def near(what, paper, ours, printed, digits):
        return [what, paper, f"{ours:.{digits}f}", verdict(abs(ours / printed - 1.0) < 0.05)]

    rows = [
        near("118 d before [mm/s]", "9.2, the least", mm_s[118.0], 9.2, 2),
        near("4 d before [mm/s]", "480", mm_s[4.0], 480.0, 0),
        near("the least [mm/s]", "9.2", mm_s[least_d], 9.2, 2),
        ["its time [d before]", "118", f"{least_d:.1f}", verdict(abs(least_d - 118.0) < 5.0)],
    ]
    run.line("Velocity change that takes a miss of 170 km away, by its time (paper 003, Figure 5)\n")
    run.table("what | paper | ours | verdict", rows)
    run.line(
        "Numbers of the paper are read off its figure. Assumed: the leg (messenger-flyby2.toml), as it is, and that the miss is along -T. "
        "Near 130 d before the flyby no velocity moves both components of B: how far from 118 d that is depends on the place of departure, "
        "which is not published."
    )
    title = "Velocity change that takes 170 km along -T away"
    drawing, (size, angles) = run.axes(title, "day from flyby 2", ["m/s", "direction [deg]"])
    size.semilogy(-TIMES_D, size_m_s, label="ours")
    size.semilogy([-118.0, -4.0], [9.2e-3, 0.48], "o", label="paper")
    angles.plot(-TIMES_D, ascension_deg, ".", label="right ascension")
    angles.plot(-TIMES_D, declination_deg, ".", label="declination")
    run.figure("figure5.svg", drawing)
    header = "before_d | delta_v_m_s | right_ascension_deg | declination_deg | delta_v_x_m_s | delta_v_y_m_s | delta_v_z_m_s"
    cells = np.column_stack([TIMES_D, size_m_s, ascension_deg, declination_deg, change_m_s])
    run.csv("figure5.csv", header, (map(exact, row) for row in cells))


main(figure5)
