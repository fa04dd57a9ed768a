"""FMPy gives what `heliotorque run` recorded of a day of MomentumPlant, to the bit: wheel.py FMU CSV"""

import sys

import numpy as np

from simulation import simulate, vector

fmu, csv = sys.argv[1:]
names = ["time", *vector("momentum.body")]
recorded = np.genfromtxt(csv, delimiter=",", names=True, deletechars="", encoding="utf-8")
result = simulate(fmu, days=1.0, output=names[1:])
different = [name for name in names if not np.array_equal(recorded[name], result[name])]
if different or len(recorded) != 145 or not np.any(result[names[1]]):
    sys.exit(f"{fmu}: FMPy and {csv} differ in {different}, {len(recorded)} rows")
print(f"{fmu}: FMPy gives the {len(recorded)} rows of {csv}")
