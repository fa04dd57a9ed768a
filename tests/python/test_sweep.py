"""`heliotorque sweep`: its flights are those of FMPy to the bit, its Sobol points SciPy's, its tables those that SALib works with."""

import csv
import importlib.util
import io
import pathlib

import numpy as np
import pytest
from fmpy import simulate_fmu
from scipy.stats import qmc

from spacecraft import call

DAY_S = 86400
CAMPAIGN = """
fmu = "{fmu}"
stop = "2 d"
step = "1 h"
runs = 8
sampling = "sobol"
[vary]
"spacecraft.centerOfMass[1]" = {{ uniform = [0, 1] }}
"spacecraft.centerOfMass[3]" = {{ uniform = [0, 1] }}
"start.epoch" = {{ uniform = [0, 1] }}
[keep]
final = ["momentum.body"]
extremes = ["momentum.body[1]"]
"""


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def swept(heliotorque, folder, text, *options):
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    done = call(heliotorque, "sweep", folder / "campaign.toml", "--output", "-", "--quiet", *options)
    assert done.returncode == 0, done.stderr
    return rows(done.stdout)


def test_sobol_points_are_those_of_scipy(heliotorque, dist, tmp_path):
    text = CAMPAIGN.format(fmu=(dist / "MomentumPlant.fmu").resolve()).replace("runs = 8", "runs = 1024")
    found = swept(heliotorque, tmp_path, text, "--dry-run")
    names = ["spacecraft.centerOfMass[1]", "spacecraft.centerOfMass[3]", "start.epoch"]
    assert [list(row) for row in found[:1]] == [["run", *names]]
    points = np.array([[float(row[name]) for name in names] for row in found])
    assert (points == qmc.Sobol(3, scramble=False).random(1024)).all()


def test_flights_are_those_of_fmpy_to_the_bit(heliotorque, dist, tmp_path):
    fmu = (dist / "MomentumPlant.fmu").resolve()
    text = CAMPAIGN.format(fmu=fmu).replace("[0, 1]", "[0, 0.01]").replace('"start.epoch" = { uniform = [0, 0.01]', '"start.epoch" = { uniform = ["2011-04-06 TDB", "2012-04-06 TDB"]')
    for row in swept(heliotorque, tmp_path, text):
        values = {name: float(row[name]) for name in ["spacecraft.centerOfMass[1]", "spacecraft.centerOfMass[3]", "start.epoch"]}
        flight = simulate_fmu(
            str(fmu), stop_time=2 * DAY_S, step_size=3600, output_interval=3600, start_values=values,
            output=[f"momentum.body[{k}]" for k in (1, 2, 3)],
        )
        assert row["status"] == "ok"
        for k in (1, 2, 3):
            assert float(row[f"momentum.body[{k}].final"]) == flight[f"momentum.body[{k}]"][-1]
        first = flight["momentum.body[1]"]
        found = [float(row[f"momentum.body[1].{what}"]) for what in ("min", "max", "largest", "timeOfLargest")]
        assert found == [first.min(), first.max(), abs(first).max(), flight["time"][abs(first).argmax()]]


def test_indices_of_ishigamis_function_are_those_of_the_closed_form(heliotorque, probe_library, tmp_path, monkeypatch):
    monkeypatch.setenv("HELIOTORQUE", str(heliotorque))
    fmu = tmp_path / "Functions.fmu"
    done = call(heliotorque, "pack", "--library", probe_library, "--model", "Functions", "--output", fmu)
    assert done.returncode == 0, done.stderr
    path = pathlib.Path(__file__).parents[2] / "examples" / "sobol_indices.py"
    spec = importlib.util.spec_from_file_location("sobol_indices", path)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    problem = {"num_vars": 3, "names": ["x[1]", "x[2]", "x[3]"], "bounds": [[-np.pi, np.pi]] * 3}
    first, total = example.indices(fmu, problem, "ishigami", 1, 4096)
    # Variances of Ishigami and Homma's function with a = 7, b = 0.1.
    b, a = 0.1, 7.0
    alone = np.array([0.5 * (1 + b * np.pi**4 / 5) ** 2, a**2 / 8, 0])
    both = 8 * b**2 * np.pi**8 / 225
    whole = alone.sum() + both
    assert first == pytest.approx(alone / whole, abs=0.02)
    assert total == pytest.approx((alone + [both, 0, both]) / whole, abs=0.02)
