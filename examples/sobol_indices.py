"""Sobol' indices: what share of the variance of an output comes from which parameter. SALib chooses the runs, `heliotorque sweep` simulates them."""

import csv
import os
import pathlib
import subprocess
import tempfile

import numpy as np
from SALib.analyze import sobol
from SALib.sample import sobol as sampled

PROGRAM = os.environ.get("HELIOTORQUE", "heliotorque")
DAY_S = 86400


def indices(fmu, problem, output, stop_s, samples):
    """First and total indices of an output at the end, by the names of the problem."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        with open(folder / "values.csv", "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(problem["names"])
            rows.writerows(sampled.sample(problem, samples, calc_second_order=False, seed=1).tolist())
        campaign = folder / "campaign.toml"
        campaign.write_text(
            f"fmu = '{pathlib.Path(fmu).resolve()}'\nstop = {stop_s}\nstep = {stop_s}\nsampling = 'file'\nfile = 'values.csv'\n"
            f"[keep]\nfinal = ['{output}']\n",
            encoding="utf-8",
        )
        subprocess.run([PROGRAM, "sweep", campaign, "--output", folder / "runs.csv", "--quiet"], check=True)
        with open(folder / "runs.csv", newline="", encoding="utf-8") as file:
            values = np.array([float(row[f"{output}.final"]) for row in csv.DictReader(file)])
    found = sobol.analyze(problem, values, calc_second_order=False, seed=1)
    return found["S1"], found["ST"]


def main():
    from picture import finish, folders, panels

    dist, pictures = folders(__doc__)
    problem = {
        "num_vars": 3,
        "names": ["spacecraft.centerOfMass[1]", "spacecraft.centerOfMass[3]", "solar.scale"],
        "bounds": [[-0.01, 0.01], [-0.0304, -0.0204], [0.95, 1.05]],
    }
    first, total = indices(dist / "MomentumPlant.fmu", problem, "momentum.body[1]", 3 * DAY_S, 256)
    for name, one, all_of_it in zip(problem["names"], first, total):
        print(f"{name}: {one:.3f} alone, {all_of_it:.3f} with others, of the variance of the X momentum after 3 days")
    figure, (axis,) = panels(1, "parameter")
    places = np.arange(3)
    axis.bar(places - 0.2, first, 0.4, label="alone")
    axis.bar(places + 0.2, total, 0.4, label="with others")
    axis.set_xticks(places, problem["names"])
    axis.set_ylabel("share of the variance")
    finish(figure, pictures / "sobol_indices.svg")


if __name__ == "__main__":
    main()
