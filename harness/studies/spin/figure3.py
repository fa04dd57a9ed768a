"""Paper 002: nutation left by a 2 deg manoeuvre in n pulses, once a turn."""

import sys

sys.path[0] += "/.."
import study
from spin import pulse_trains


def figure3(run):
    pulse_trains.figure(run, "figure3", 1.0, paper_envelope_deg=0.0177)


study.main(figure3)
