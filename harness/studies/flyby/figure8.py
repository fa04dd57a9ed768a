"""Paper 003: the same 18 days before it, where orbit determination found a drift."""

import sys

sys.path[0] += "/.."
import study
from flyby import corrected


def figure8(run):
    corrected.figure(run, 8)


study.main(figure8)
