"""A campaign on a Dask cluster: where the centre of mass is drawn from, and the momentum that ten days of it collect."""

import os
import pathlib
import sys

import numpy as np
from distributed import Client, LocalCluster
from picture import finish, folders, panels

# Installed by `pip install ./harness/dask`, or taken from this checkout.
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "harness" / "dask"))
from heliotorque_dask import sweep

MISSION = """fmu = {plant}
stop = "10 d"
step = "1 h"
record = ["momentum.body"]
[set]
"momentum.convention" = "bodyIntegral"
"dump.threshold" = 1e9
"""

CAMPAIGN = """mission = "mission.toml"
runs = 40
seed = 1
sampling = "latinHypercube"
[vary]
"spacecraft.centerOfMass[3]" = { normal = ["-2.54 cm", "5 mm"] }
[keep]
final = ["momentum.body"]
"""


def main():
    dist, pictures = folders(__doc__)
    plant = (dist / "MomentumPlant.fmu").resolve()
    (pictures / "mission.toml").write_text(MISSION.format(plant=f"'{plant}'"), encoding="utf-8")
    (pictures / "campaign.toml").write_text(CAMPAIGN, encoding="utf-8")
    # Client("tcp://head:8786") would be a cluster's.
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        program = os.environ.get("HELIOTORQUE", "heliotorque")
        runs = sweep(client, pictures / "campaign.toml", pictures / "runs.csv", pieces=8, program=program)

    table = np.genfromtxt(pictures / "runs.csv", delimiter=",", names=True, deletechars="", dtype=None, encoding="utf-8")
    offset_m, momentum = table["spacecraft.centerOfMass[3]"], table["momentum.body[1].final"]
    slope, at_zero = np.polyfit(offset_m, momentum, 1)
    print(f"{runs} runs: X momentum {momentum.mean():.5f} +- {momentum.std():.5f} N.m.s, {slope / 100:.5f} N.m.s per cm")

    figure, (axis,) = panels(1, "Z of the centre of mass [cm]")
    axis.plot(offset_m * 100, momentum, "o", label="runs")
    axis.plot(offset_m * 100, at_zero + slope * offset_m, label="line through them")
    axis.set_ylabel("X momentum after ten days [N.m.s]")
    finish(figure, pictures / "dask_sweep.svg")


# The cluster's processes import this file.
if __name__ == "__main__":
    main()
