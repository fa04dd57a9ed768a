"""Answers do not depend on how a question is put: the step of a map, the order of a file's tables, the rows of a history."""

import json
import re

import numpy as np

from spacecraft import HEAD, RESOURCES, call, pack

CRUISE = RESOURCES / "examples" / "missions" / "messenger-cruise.toml"
BUS = '[[boxes]]\nname = "bus"\ncenter_m = [0.05, 0.0, -0.1]\nsize_m = [1.5, 1.0, 1.2]\noptics = "paint"\n'
MAST = '[[plates]]\nname = "mast"\nnormal = [0, -1, 0]\narea_m2 = 0.4\ncenter_m = [0, 0, 2]\noptics = "paint"\nrear_optics = "paint"\n'
WHEELS = [
    f"[[wheels]]\naxis = {axis}\ncapacity_n_m_s = {capacity}\n"
    for axis, capacity in (([1, 0, 0], 2.0), ([0, 1, 0], 3.0), ([0, 0, 1], 4.0), ([0.6, 0.0, 0.8], 1.0))
]


def test_a_map_of_any_step_has_the_same_torques(heliotorque, dist, tmp_path):
    rows = {}
    for step in ("10 deg", "30 deg"):
        path = tmp_path / f"{step}.csv"
        template = (dist / "MomentumPlant.fmu").resolve()
        file = RESOURCES / "messenger.toml"
        done = call(heliotorque, "map", file, "--template", template, "--step", step, "--output", path, folder=tmp_path)
        assert done.returncode == 0, done.stderr
        rows[step] = {tuple(line.split(",")[:2]): line for line in path.read_text(encoding="utf-8").splitlines()[1:]}
    assert len(rows["30 deg"]) > 50
    assert all(rows["10 deg"][place] == line for place, line in rows["30 deg"].items())


def test_the_order_of_a_files_tables_changes_no_answer(heliotorque, dist, tmp_path):
    answers = []
    for order, tables in enumerate(([BUS, MAST, *WHEELS], [*WHEELS[::-1], MAST, BUS])):
        folder = tmp_path / str(order)
        fmu = pack(heliotorque, dist, folder, HEAD.format(name="Any") + "".join(tables), "Any")
        checked = call(heliotorque, "check", "Any.toml", "--template", (dist / "MomentumPlant.fmu").resolve(), folder=folder)
        told = call(heliotorque, "info", fmu, "--coefficients", folder=folder)
        assert checked.returncode == told.returncode == 0, checked.stderr + told.stderr
        # The list of the wheels themselves keeps the file's order.
        answers.append((checked.stdout, told.stdout.split("What the 4 wheels")[0], re.findall("In use: .*", told.stdout)))
    assert answers[0] == answers[1]


def test_a_refit_of_every_second_row_finds_the_same_centre_of_mass(heliotorque, dist, tmp_path):
    template = (dist / "MomentumPlant.fmu").resolve()
    moved = ("--set", "spacecraft.centerOfMass[1]=3mm", "--stop", "40 d", "--record", "momentum.inertial")
    found = []
    for step in ("3 h", "6 h"):
        rows = tmp_path / f"{step}.csv"
        done = call(heliotorque, "run", CRUISE, "--template", template, *moved, "--step", step, "--output", rows, folder=tmp_path)
        assert done.returncode == 0, done.stderr
        output = tmp_path / f"{step}.toml"
        done = call(
            heliotorque, "refit", CRUISE, "--template", template, "--telemetry", rows, "--output", output, folder=tmp_path
        )
        assert done.returncode == 0, done.stderr
        found.append(json.loads(output.with_suffix(".json").read_text(encoding="utf-8")))
    (one, other), sigma_m = (np.array(it["centerOfMass_m"]) for it in found), np.sqrt(np.diag(found[1]["covariance"])[:3])
    assert np.all(np.abs(one - other) < sigma_m), (one, other, sigma_m)
