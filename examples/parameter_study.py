"""A parameter study: which centre of mass collects least momentum in 30 days about Mercury, dumps left out."""

import shutil

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmu import start_values
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
plant = dist / "MomentumPlant.fmu"
OFFSETS_M = np.arange(-0.06, 0.0601, 0.01)

# Unpacked and read once for all runs. Body components are integrated one by one: then they are linear in the offset.
reused = {"filename": extract(plant), "model_description": read_model_description(plant)}
options = {"momentum.convention": "bodyIntegral", "dump.threshold": [1e9, 1e9, 1e9]}

largest, last = [], []
for offset_m in OFFSETS_M:
    result = simulate_fmu(
        **reused, stop_time=30 * 86400, step_size=3600, output_interval=3600, output=["momentum.body[1]"],
        start_values=start_values(plant, options | {"spacecraft.centerOfMass": [0.0, 0.0, offset_m]}),
    )
    largest.append(abs(result["momentum.body[1]"]).max())
    last.append(result["momentum.body[1]"][-1])
shutil.rmtree(reused["filename"], ignore_errors=True)

slope, at_zero = np.polyfit(OFFSETS_M, last, 1)
print(f"X momentum after 30 days {slope / 100:.4f} N.m.s per cm, none at Z = {-at_zero / slope * 100:.4f} cm")

figure, (axis,) = panels(1, "Z of the centre of mass [cm]")
axis.plot(OFFSETS_M * 100, last, "o-", label="after 30 days")
axis.plot(OFFSETS_M * 100, largest, "s-", label="largest on the way")
axis.set_ylabel("X momentum [N.m.s]")
finish(figure, pictures / "parameter_study.svg")
