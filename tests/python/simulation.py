"""Running MomentumPlant with FMPy: the paper's settings by name, results by name."""

import pathlib

import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave

DAY_S = 86_400.0

# Paper 000's study: no panels, fixed pressure, body components integrated on their own, 4 N.m.s, dumps only.
PAPER = {
    "momentum.convention": 2,
    "solar.fixedPressure": True,
    "gravityGradient.enabled": False,
    "eclipse.method": 4,
    "panel[1].enabled": False,
    "panel[2].enabled": False,
}

# Its Table 2, rows "thruster dumps only", for the cylinder: dumps in 90 days by threshold in N.m.s, one for each offset.
PAPER_COUNTS = {4.0: (4, 9, 14), 7.0: (2, 6, 8)}


def vector(name):
    return [f"{name}[{i}]" for i in (1, 2, 3)]


def simulate(fmu, step_s=600.0, days=90.0, start=None, output=None, **options):
    output = output or vector("momentum.body") + ["dump.count", "dump.lastTime"]
    return simulate_fmu(
        fmu,
        stop_time=days * DAY_S,
        step_size=step_s,
        output_interval=step_s,
        start_values=start or {},
        output=output,
        **options,
    )


def stack(result, name):
    return np.column_stack([result[element] for element in vector(name)])


def columns(table, names):
    return np.column_stack([table[name] for name in names])


def basilisk_table(name):
    """A table of `tests/reference` that Basilisk's numbers stand in, columns by FMI name."""
    path = pathlib.Path(__file__).parents[1] / "reference" / f"{name}.csv"
    return np.genfromtxt(path, delimiter=",", names=True, deletechars="", comments=None, encoding="utf-8")


def dump_times(result):
    """Time of every dump, from the output that holds the last one."""
    return np.unique(result["dump.lastTime"][result["dump.count"] > 0])


QUATERNION = [f"attitude.q[{i}]" for i in (1, 2, 3, 4)]


def to_body(result):
    """Matrices from EME2000 to the body frame, one a row of the result, from `attitude.q` (passive, scalar last)."""
    x, y, z, w = (result[name] for name in QUATERNION)
    rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def turned(vector, axis, angle):
    """The vector turned by the angle right-handed about the axis (Rodrigues' formula)."""
    axis = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    along = axis * (axis @ vector)
    return along + np.cos(angle) * (vector - along) + np.sin(angle) * np.cross(axis, vector)


class Stepped:
    """An unpacked FMU stepped by hand, so that inputs can change between steps and others can be stepped between."""

    def __init__(self, folder, start=None):
        description = read_model_description(folder)
        self._kinds = {variable.name: (variable.type, variable.valueReference) for variable in description.modelVariables}
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="stepped",
        )
        self.slave.instantiate()
        self.set(**(start or {}))
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        self.time = 0.0

    def set(self, **values):
        for name, value in values.items():
            kind, reference = self._kinds[name]
            setter = {"Real": self.slave.setReal, "Boolean": self.slave.setBoolean}.get(kind, self.slave.setInteger)
            setter([reference], [value])

    def get(self, *names):
        kinds = {self._kinds[name][0] for name in names}
        getter = self.slave.getReal if kinds == {"Real"} else self.slave.getInteger
        return np.array(getter([self._kinds[name][1] for name in names]))

    def step(self, step_s):
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=step_s)
        self.time += step_s

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()
