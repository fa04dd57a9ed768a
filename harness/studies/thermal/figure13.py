"""Paper 004: accelerations over a Mercury year, least, mean and greatest of every orbit."""

import sys

sys.path[0] += "/.."
import numpy as np

from study import agrees, brief, main, scientific
from thermal.orbit import EFFECTS, MERCURY_YEAR_S, ORBIT_S, Accelerations, fmus

STEP_S = 60.0


def figure13(run):
    year = Accelerations(fmus(run), 0.0, MERCURY_YEAR_S, STEP_S)
    number = (year.time_s / ORBIT_S).astype(int)
    first = np.flatnonzero(np.diff(number, prepend=-1))
    by_orbit = np.split(year.effects, first[1:])
    ranges = {
        "least": np.array([orbit.min(axis=0) for orbit in by_orbit]),
        "mean": np.array([orbit.mean(axis=0) for orbit in by_orbit]),
        "greatest": np.array([orbit.max(axis=0) for orbit in by_orbit]),
    }
    share, of_orbit = year.thermal_share(), number[year.is_lit]
    mean_share = np.bincount(of_orbit, share) / np.bincount(of_orbit)
    lit = year.effects[year.is_lit]
    infrared, thermal = np.max(lit[:, 2:] / lit[:, :1], axis=0)
    vector = np.max(year.without_solar[year.is_lit] / lit[:, 0])
    total = year.total[year.is_lit].max()
    count = MERCURY_YEAR_S / ORBIT_S

    run.line("A whole Mercury year (paper 004, Figure 13)\n")
    run.table(
        "quantity | paper | ours | verdict",
        [
            ["orbits in a year", "172", f"{count:.1f}", agrees(abs(count - 172.0) < 0.5)],
            [
                "mean sum of thermal effects, of solar",
                "20-30 %",
                f"{mean_share.min() * 100.0:.1f} % to {mean_share.max() * 100.0:.1f} %",
                agrees(mean_share.min() > 0.195 and mean_share.max() < 0.305),
            ],
            ["greatest infrared, of solar", "about 25 %", f"{infrared * 100.0:.1f} %", agrees(abs(infrared - 0.25) < 0.03)],
            ["greatest recoil, of solar", "about 25 %", f"{thermal * 100.0:.1f} %", agrees(abs(thermal - 0.25) < 0.03)],
            [
                "greatest sum of magnitudes, of solar",
                "up to 50 %",
                f"{share.max() * 100.0:.1f} %",
                agrees(share.max() < 0.505),
            ],
            ["greatest total", "order of 1e-6 m/s2", f"{brief(total, 2)} m/s2", agrees(5e-7 <= total < 2e-6)],
        ],
    )
    run.line(
        f"The printed elements give {count:.1f} orbits in a year. The sum of magnitudes is the paper's; the magnitude of the\n"
        f"vector sum of albedo, infrared and recoil reaches {vector * 100.0:.1f} % of solar."
    )
    true_anomaly_deg = year.true_anomaly_deg[first]
    labels = [f"{name} a [1e-7 m/s2]" for name in ("greatest", "mean", "least")]
    title = "Accelerations over a Mercury year, by orbit"
    drawing, panels = run.axes(title, "true anomaly of Mercury [deg]", labels)
    for axes, name in zip(panels, ("greatest", "mean", "least")):
        for effect, values in zip(EFFECTS, ranges[name].T):
            axes.plot(true_anomaly_deg, values * 1e7, label=effect)
    run.figure("figure13.svg", drawing)
    header = "".join(f" | {it}_least_m_s2 | {it}_mean_m_s2 | {it}_greatest_m_s2" for it in EFFECTS)
    by_effect = np.stack([ranges["least"], ranges["mean"], ranges["greatest"]], axis=2).reshape(len(first), -1)
    rows = ([f"{anomaly:.4f}", *scientific(values)] for anomaly, values in zip(true_anomaly_deg, by_effect))
    run.csv("figure13.csv", f"true_anomaly_deg{header}", rows)


main(figure13)
