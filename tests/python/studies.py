"""Running `heliotorque study` as a user would."""

import csv
import os
import subprocess


def study(heliotorque, dist, folder, name, threads):
    """What the study prints and the content of the files it leaves, by name."""
    run = subprocess.run(
        [heliotorque, "study", name, "--quiet", "--dist", dist, "--output", folder],
        capture_output=True, text=True, encoding="utf-8", env=os.environ | {"RAYON_NUM_THREADS": str(threads)},
    )
    assert run.returncode == 0, run.stderr
    return run.stdout, {file.name: file.read_text(encoding="utf-8") for file in folder.iterdir()}


def table(files, name):
    """The rows of a CSV file by column."""
    rows = list(csv.DictReader(files[name].splitlines()))
    assert rows and all(None not in row and None not in row.values() for row in rows), "a ragged table"
    return rows
