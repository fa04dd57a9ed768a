"""Running `heliotorque study` as a user would, and reading vectors and attitudes from what it leaves."""

import csv
import os
import subprocess

import numpy as np


def study(heliotorque, dist, folder, name, threads, *options):
    """What the study prints and the content of the files it leaves, by name."""
    run = subprocess.run(
        [heliotorque, "study", name, "--quiet", "--dist", dist, "--output", folder, *options],
        capture_output=True, text=True, encoding="utf-8", env=os.environ | {"RAYON_NUM_THREADS": str(threads)},
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
