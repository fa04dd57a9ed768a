"""An FMU by its names, on top of FMPy: vectors whole, options by their item's name, one step at a time."""

import shutil

from fmpy import extract, read_model_description
from fmpy.simulation import instantiate_fmu

SETTERS = {"Real": "setReal", "Integer": "setInteger", "Enumeration": "setInteger", "Boolean": "setBoolean"}
GETTERS = {"Real": "getReal", "Integer": "getInteger", "Enumeration": "getInteger", "Boolean": "getBoolean"}


def by_name(description):
    """The variables behind every name: one behind its own, and name[1], name[2] ... in order behind a vector's bare name."""
    found = {}
    for variable in description.modelVariables:
        found[variable.name] = [variable]
        if variable.name.endswith("]"):
            found.setdefault(variable.name.rpartition("[")[0], []).append(variable)
    return found


def number(variable, value):
    """What FMI takes: for the name of an option's item its number, anything else as it is."""
    if variable.type == "Enumeration" and isinstance(value, str):
        return next(int(item.value) for item in variable.declaredType.items if item.name == value)
    return value


def start_values(path, values):
    """Vectors and options by name, as the start values that FMPy's simulate_fmu takes."""
    variables = by_name(read_model_description(path))
    start = {}
    for name, value in values.items():
        each = value if isinstance(value, (list, tuple)) else [value]
        start |= {variable.name: number(variable, one) for variable, one in zip(variables[name], each, strict=True)}
    return start


class Fmu:
    """A running instance, from time 0; `with Fmu(path, {...}) as plant:` frees it at the end."""

    def __init__(self, path, start=()):
        description = read_model_description(path)
        self.variables = by_name(description)
        self.folder, self.time = extract(path), 0.0
        self.slave = instantiate_fmu(self.folder, description, "CoSimulation")
        self.slave.setupExperiment(startTime=0.0)
        for name, value in dict(start).items():
            self.set(name, value)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def set(self, name, value):
        found = self.variables[name]
        each = value if len(found) > 1 else [value]
        each = [number(variable, one) for variable, one in zip(found, each, strict=True)]
        getattr(self.slave, SETTERS[found[0].type])([variable.valueReference for variable in found], each)

    def get(self, name):
        found = self.variables[name]
        values = getattr(self.slave, GETTERS[found[0].type])([variable.valueReference for variable in found])
        return values if len(found) > 1 else values[0]

    def step(self, step_s):
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=step_s)
        self.time += step_s

    def save(self):
        """All of the instance's state, as bytes for a file or another process."""
        state = self.slave.getFMUstate()
        blob = self.slave.serializeFMUstate(state)
        self.slave.freeFMUstate(state)
        return blob

    def restore(self, blob, time_s):
        state = self.slave.deSerializeFMUstate(blob)
        self.slave.setFMUstate(state)
        self.slave.freeFMUstate(state)
        self.time = time_s

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)
