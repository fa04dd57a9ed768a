"""Paper 002: how long nutation takes to show, over spin rate and inertia ratio."""

import sys

sys.path[0] += "/.."
import numpy as np

from spin.spinner import FMU, body
from study import main, verdict

# The figure shows times beyond this, and ends at that, in min.
LONG_MIN = 30.0
TALLEST_MIN = 60.0
RATIOS = 1.4715 + 0.001 * np.arange(24) * 22.5 / 23.0
RATES_RPM = 4.9 + 0.2 * (np.arange(40) + 0.5) / 40.0


def label(ratio):
    return f"ratio {ratio:.4f}"


def figure7(run):
    ratios = run.chosen(RATIOS, label)
    fmu = run.fmu(FMU)
    names = ["starTracker.observationTimeNominal", "starTracker.observationTime"]

    def times_min(ratio):
        """By spin rate: eq 20, and what samples by the clock and by spins take."""
        rows = []
        for rate_rpm in RATES_RPM:
            spinning = body(ratio) | {"burn.plan": "commanded", "spin.initialRate": rate_rpm * np.pi / 30.0}
            clock, spins = (
                fmu.simulate(label(ratio), spinning | {"starTracker.sampling": sampling}, names, 1.0, 1.0).rows[-1] / 60.0
                for sampling in ("clock", "spins")
            )
            rows.append([*clock, spins[1]])
        return np.array(rows)

    found_min = np.array(run.all(ratios, times_min))
    run.line("Time to see the full range of declinations over spin rate and ratio (paper 002, Figure 7)")
    eq20, clock, spins = 100.0 * np.mean(found_min > LONG_MIN, axis=(0, 1))
    # Greatest relative spread of the time over the spin rates, among the ratios.
    by_spins_min = found_min[:, :, 2]
    spread = np.max(by_spins_min.max(axis=1) / by_spins_min.min(axis=1) - 1.0)
    drops_out = verdict(spread < 0.2 / 4.9 + 0.001, "the spin rate drops out but for the length of a spin")
    run.table(
        "beyond 30 min | paper | ours | verdict",
        [
            ["eq 20", "about 20 %", f"{eq20:.1f} %", verdict(abs(eq20 - 20.0) < 2.0)],
            [
                "exact, clock samples every 96 s",
                "-",
                f"{clock:.1f} %",
                verdict(abs(clock - eq20) < 1.0, "what eq 20 approximates"),
            ],
            ["exact, samples every 8 spins", "-", f"{spins:.1f} %", drops_out],
        ],
    )
    rows = (
        [f"{rate_rpm:.4f}", f"{ratio:.6f}", *(f"{it:.6f}" for it in times)]
        for ratio, by_rate in zip(ratios, found_min)
        for rate_rpm, times in zip(RATES_RPM, by_rate)
    )
    run.csv("figure7.csv", "spin_rate_rpm | ratio | eq20_min | clock_min | spins_min", rows)
    drawing, panels = run.axes("Nutation observation time", "spin rate [rpm]", ["observation time [min]"] * 2)
    for axes, method, column in zip(panels, ("by equation 20", "sampled every 8 spins"), (0, 2)):
        for k in range(0, len(ratios), max(len(ratios) // 4, 1)):
            axes.plot(RATES_RPM, found_min[k, :, column], label=label(ratios[k]))
        axes.axhline(LONG_MIN, color="black", linestyle="--", label="30 min")
        axes.set(title=method, ylim=(0.0, TALLEST_MIN))
    run.figure("figure7.svg", drawing)


main(figure7)
