"""Running a study as a user would, and reading vectors and attitudes from what it leaves."""

import csv
import os
import pathlib
import re
import subprocess
import sys

import numpy as np

STUDIES = pathlib.Path(__file__).parents[2] / "harness" / "studies"


def program(heliotorque, dist, folder, name, *options):
    """A study as a command."""
    paths = ["--heliotorque", heliotorque, "--dist", dist, "--output", folder]
    return [sys.executable, STUDIES / f"{name}.py", "--quiet", *paths, *options]


def study(heliotorque, dist, folder, name, cores, *options):
    """Output of the study and the content of the files it leaves, by name; `momentum/table2` is `momentum/tables --table 2`."""
    if table := re.fullmatch("momentum/table([2-5])", name):
        name, options = "momentum/tables", (*options, "--table", table[1])
    allowed = sorted(os.sched_getaffinity(0))[:cores]
    run = subprocess.run(
        program(heliotorque, dist, folder, name, *options),
        capture_output=True, text=True, encoding="utf-8", preexec_fn=lambda: os.sched_setaffinity(0, allowed),
    )
    assert run.returncode == 0, run.stderr
    return run.stdout, {file.name: file.read_text(encoding="utf-8") for file in folder.iterdir()}


def table(files, name):
    """The rows of a CSV file by column."""
    rows = list(csv.DictReader(files[name].splitlines()))
    assert rows and all(None not in row and None not in row.values() for row in rows), "a ragged table"
    return rows


def vector(row, names):
    """The columns of these names as one vector."""
    return np.array([float(row[name]) for name in names.split()])


def unit(v):
    return v / np.linalg.norm(v)


def attitude(row, names="q1 q2 q3 q4"):
    """The matrix from EME2000 to body: (w2 - v.v) 1 + 2 v vT - 2 w [v x]."""
    *v, w = vector(row, names)
    v = np.array(v)
    assert abs(v @ v + w * w - 1.0) < 1e-12
    crossed = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return (w * w - v @ v) * np.eye(3) + 2.0 * np.outer(v, v) - 2.0 * w * crossed
