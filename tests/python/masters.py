"""Two masters of FMPy that wire FMUs to each other: its simulation of SSP systems and its container FMU.

A system is a dict of components, name to FMU, and a list of connections ("a.output", "b.input"); a vector connects under
its bare name with its size.
"""

import copy
import zipfile
from xml.sax.saxutils import quoteattr

from fmpy import read_model_description
from fmpy.container_fmu.cli import create_container_fmu
from fmpy.container_fmu.config import Component, Configuration, Connection
from fmpy.model_description import CoSimulation, DefaultExperiment, ModelDescription, ModelVariable, Unknown
from fmpy.ssp.simulation import simulate_ssp

NAMESPACES = (
    'xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" '
    'xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"'
)


def elements(name, size):
    return [f"{name}[{i}]" for i in range(1, size + 1)]


def wires(source, target, size):
    """Connections of every element of two vectors."""
    return list(zip(elements(source, size), elements(target, size), strict=True))


def split(path):
    component, _, name = path.partition(".")
    return component, name


def simulate_ssp(folder, components, connections, step_s, stop_s, outputs=(), zeros=()):
    """Runs an SSP and records what is connected and `outputs`; inputs in `zeros` are set to 0 each step."""
    connectors = {component: {} for component in components}
    for source, target in connections:
        connectors[split(source)[0]][split(source)[1]] = "output"
        connectors[split(target)[0]][split(target)[1]] = "input"
    for path in outputs:
        connectors[split(path)[0]][split(path)[1]] = "output"
    # An input without a connection would get another one's in FMPy.
    for path in zeros:
        connectors[split(path)[0]][split(path)[1]] = "input"
    lines = ["<?xml version='1.0' encoding='UTF-8'?>"]
    lines.append(f'<ssd:SystemStructureDescription {NAMESPACES} name="Loop" version="1.0"><ssd:System name="Loop">')
    lines.append('<ssd:Connectors><ssd:Connector name="zero" kind="input"><ssc:Real/></ssd:Connector></ssd:Connectors>')
    lines.append("<ssd:Elements>")
    for component in components:
        kind = 'type="application/x-fmu-sharedlibrary"'
        lines.append(f'<ssd:Component name="{component}" {kind} source="resources/{component}.fmu"><ssd:Connectors>')
        for name, direction in connectors[component].items():
            lines.append(f'<ssd:Connector name={quoteattr(name)} kind="{direction}"><ssc:Real/></ssd:Connector>')
        lines.append("</ssd:Connectors></ssd:Component>")
    lines.append("</ssd:Elements>")
    lines.append("<ssd:Connections>")
    for source, target in connections:
        (a, output), (b, into) = split(source), split(target)
        ends = f'startElement="{a}" startConnector={quoteattr(output)} endElement="{b}" endConnector={quoteattr(into)}'
        lines.append(f"<ssd:Connection {ends}/>")
    for path in zeros:
        b, into = split(path)
        lines.append(f'<ssd:Connection startConnector="zero" endElement="{b}" endConnector={quoteattr(into)}/>')
    lines.append("</ssd:Connections></ssd:System></ssd:SystemStructureDescription>")
    ssp = folder / "loop.ssp"
    with zipfile.ZipFile(ssp, "w") as archive:
        archive.writestr("SystemStructure.ssd", "\n".join(lines))
        for component, fmu in components.items():
            archive.write(fmu, f"resources/{component}.fmu")
    return simulate_ssp(str(ssp), stop_time=stop_s, step_size=step_s)


def container(path, components, connections, step_s, outputs):
    """Packs the system into FMPy's container; its outputs are named as in `connections`."""
    inside, variables = {}, {}
    for name, fmu in components.items():
        description = read_model_description(str(fmu))
        inside[name] = Component(name=name, filename=fmu, modelDescription=description)
        variables[name] = {variable.name: variable for variable in description.modelVariables}

    def connection(source, target):
        (a, output), (b, into) = split(source), split(target)
        # The container's library has FMI 3's words for types.
        start, end = copy.copy(variables[a][output]), variables[b][into]
        start.type = {"Real": "Float64", "Integer": "Int32", "Enumeration": "Int32"}.get(start.type, start.type)
        return Connection(startElement=inside[a], startConnectors=[start], endElement=inside[b], endConnectors=[end])

    mappings = {}
    for output in outputs:
        component, name = split(output)
        shown = ModelVariable(
            name=output, type="Real", valueReference=0, causality="output", variability="continuous", initial="calculated"
        )
        mappings[shown] = [(inside[component], variables[component][name])]
    description = ModelDescription()
    description.fmiVersion, description.modelName = "2.0", "Container"
    description.guid = description.instantiationToken = "{container}"
    description.coSimulation = CoSimulation()
    description.coSimulation.canHandleVariableCommunicationStepSize = True
    description.coSimulation.fixedInternalStepSize = step_s
    description.defaultExperiment = DefaultExperiment()
    # The container's library keeps value reference 0 for the time.
    time = ModelVariable(
        name="time", type="Real", valueReference=0, causality="independent", variability="continuous"
    )
    description.modelVariables = [time, *mappings]
    description.outputs = [Unknown(variable=variable) for variable in mappings]
    description.initialUnknowns = [Unknown(variable=variable) for variable in mappings]
    scratch = path.parent / f"{path.stem}-parts"
    scratch.mkdir()
    configuration = Configuration(
        parallelDoStep=False,
        modelDescription=description,
        components=list(inside.values()),
        connections=[connection(*ends) for ends in connections],
        variableMappings=mappings,
    )
    create_container_fmu(configuration, scratch, path)
    return str(path)
