"""Builds a foreign FMU: FMPy's container, a C library not of this project, around a packed MomentumPlant.

    python foreign_fmu.py dist/MomentumPlant.fmu foreign.fmu
"""

import sys
import tempfile
from pathlib import Path

from fmpy import read_model_description
from fmpy.container_fmu.cli import create_container_fmu
from fmpy.container_fmu.config import Component, Configuration
from fmpy.model_description import CoSimulation, DefaultExperiment, ModelDescription, ModelVariable, Unknown

GUID = "{container}"
NAMES = ["momentum.body[1]", "momentum.body[3]"]


def build(inner, outer):
    plant = Component(name="plant", filename=inner, modelDescription=read_model_description(str(inner)))
    inside = {variable.name: variable for variable in plant.modelDescription.modelVariables}
    mappings = {}
    for name in NAMES:
        shown = ModelVariable(
            name=f"plant.{name}",
            type="Real",
            valueReference=0,
            causality="output",
            variability="continuous",
            initial="calculated",
        )
        mappings[shown] = [(plant, inside[name])]

    description = ModelDescription()
    description.fmiVersion, description.modelName = "2.0", "Container"
    description.guid = description.instantiationToken = GUID
    description.coSimulation = CoSimulation()
    description.coSimulation.modelIdentifier = "container_fmu"
    description.coSimulation.canHandleVariableCommunicationStepSize = True
    description.coSimulation.fixedInternalStepSize = 600.0
    description.defaultExperiment = DefaultExperiment()
    description.defaultExperiment.startTime = "0"
    description.defaultExperiment.stopTime = "864000"
    description.defaultExperiment.stepSize = "600"
    # The container's library keeps value reference 0 for the time.
    time = ModelVariable(
        name="time", type="Real", valueReference=0, causality="independent", variability="continuous"
    )
    description.modelVariables = [time, *mappings]
    description.outputs = [Unknown(variable=variable) for variable in mappings]
    description.initialUnknowns = [Unknown(variable=variable) for variable in mappings]

    configuration = Configuration(
        parallelDoStep=False,
        modelDescription=description,
        components=[plant],
        connections=[],
        variableMappings=mappings,
    )
    # FMPy renames the archive: both stand on one file system.
    with tempfile.TemporaryDirectory(dir=outer.parent) as scratch:
        create_container_fmu(configuration, Path(scratch), outer)


if __name__ == "__main__":
    build(Path(sys.argv[1]), Path(sys.argv[2]))
