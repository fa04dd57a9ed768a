"""Paper 000: X momentum over 90 days with reactive and predictive targets."""

import sys

sys.path[0] += "/.."
import study
from momentum import momentum_x


def figure5(run):
    momentum_x.figure(run, momentum_x.FIGURE_5, 5)


study.main(figure5)
