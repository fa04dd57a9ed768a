"""Paper 002: nutation in the star tracker's samples."""

import sys

sys.path[0] += "/.."
import numpy as np

from spin.spinner import FMU, RATIO, body
from study import main, rounds, verdict

NUTATION_RAD = np.radians(0.02)
STOP_S = 14_400.0
STEP_S = 0.5
# Length of the figure, and the step of its curve, finer than that of the samples: the wave has 8 s.
SHOWN_S = 800.0
SHOWN_STEP_S = 0.05
SAMPLINGS = {"clock, every 96 s": "clock", "every 8 spins": "spins"}


def figure6(run):
    labels = run.chosen(SAMPLINGS)
    fmu = run.fmu(FMU)
    run.line("Declination of a star in the tracker of a nutating spinner (paper 002, Figure 6)")
    names = [f"starTracker.{name}" for name in ("declinationTrue", "sampleTime", "declination", "nutation", "nutationSigma")]
    title = f"Star declination, 0.02 deg nutation, ratio {RATIO}, 5 rpm"
    drawing, panels = run.axes(title, "time [s]", ["declination - mean [deg]"] * len(labels))
    rows, cells = [], []
    for label, axes in zip(labels, panels):
        nutating = {"burn.plan": "commanded", "start.nutation": NUTATION_RAD, "starTracker.sampling": SAMPLINGS[label]}
        simulated = fmu.simulate(label, body() | nutating, names, STOP_S, STEP_S)
        true_rad, sample_s, measured_rad, nutation_rad, sigma_rad = simulated.rows.T
        # Where a sample has just come: the true declination there, and what the tracker measured.
        is_new = np.append(False, np.diff(sample_s) != 0.0) & (sample_s >= 0.0)
        sample_s, sampled_rad, measured_rad = sample_s[is_new], true_rad[is_new], measured_rad[is_new]
        span_min = (sample_s[:8][-1] - sample_s[0]) / 60.0
        rows.append([label, "11.2 min", f"{span_min:.2f} min", verdict(rounds(span_min, 11.2, 0.1), "span of 8 samples")])
        holds = abs(nutation_rad[-1] - NUTATION_RAD) < 3.0 * sigma_rad[-1]
        ours = f"{np.degrees(nutation_rad[-1]):.4f} +- {np.degrees(sigma_rad[-1]):.4f} deg"
        rows.append([f"{label}: nutation from the samples of 4 h", "0.02 deg (set)", ours, verdict(holds)])
        points = zip(sample_s, np.degrees(sampled_rad), np.degrees(measured_rad))
        cells += [[label, f"{at_s:.6f}", f"{true:.9f}", f"{measured:.9f}"] for at_s, true, measured in points]

        wave = fmu.simulate(label, body() | nutating, names[:1], SHOWN_S, SHOWN_STEP_S)
        mean_rad, is_shown = np.mean(true_rad), sample_s <= SHOWN_S
        axes.plot(wave.time_s, np.degrees(wave[names[0]] - mean_rad), linewidth=0.6, label=f"{label}: true")
        axes.plot(sample_s[is_shown], np.degrees(sampled_rad[is_shown] - mean_rad), "o", label="where sampled")
        axes.set_ylim(-0.03, 0.03)
    run.table("sampling | paper | ours | verdict", rows)
    run.line(
        'The declination swings by the nutation angle either way: the paper\'s "amplitude twice the nutation angle" is '
        "peak to peak."
    )
    run.csv("figure6.csv", "sampling | time_s | true_deg | measured_deg", cells)
    run.figure("figure6.svg", drawing)


main(figure6)
