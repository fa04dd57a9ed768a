"""Paper 002: nutation left by a 2 deg manoeuvre in n pulses, twice a turn."""

import sys

sys.path[0] += "/.."
import study
from spin import pulse_trains


def figure2(run):
    pulse_trains.figure(run, "figure2", 0.5, paper_envelope_deg=0.0237)


study.main(figure2)
