"""Paper 003: the same 111 days before it, planned anew by sunlight."""

import sys

sys.path[0] += "/.."
import study
from flyby import corrected


def figure7(run):
    corrected.figure(run, 7)


study.main(figure7)
