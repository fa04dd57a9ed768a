"""Paper 003: the same seven days before it."""

import sys

sys.path[0] += "/.."
import study
from flyby import corrected


def figure9(run):
    corrected.figure(run, 9)


study.main(figure9)
