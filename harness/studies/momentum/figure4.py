"""Paper 000: X momentum over 90 days with thruster dumps only."""

import sys

sys.path[0] += "/.."
import study
from momentum import momentum_x


def figure4(run):
    momentum_x.figure(run, momentum_x.FIGURE_4, 4)


study.main(figure4)
