"""Systems under several masters: our own, FMPy's, libcosim's."""

import pathlib
import zipfile

import numpy as np
from fmpy import read_model_description
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd

from spacecraft import call


def simulated(heliotorque, ssp, names, *options):
    """A run's table: time and columns by name, a row at the start."""
    done = call(heliotorque, "run", ssp, "--quiet", "--record", ",".join(names), "--output", "-", *options)
    assert done.returncode == 0, done.stderr
    header, *rows = done.stdout.split()
    values = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    return dict(zip(header.split(","), values.T, strict=True))


def simulated_by_fmpy(ssp, stop_s, step_s):
    """FMPy's table: its row k is of the end of step k, where inputs have been exchanged already."""
    return simulate_ssp(str(ssp), stop_time=stop_s, step_size=step_s)


def connectors(ssp):
    """Names of output and input connectors, what the system's own outputs show counting as inputs, and what every connected input
    takes; FMPy validates the file."""
    system = read_ssd(str(ssp)).system
    kinds = {f"{part.name}.{it.name}": it.kind for part in system.elements for it in part.connectors}

    def name(element, connector):
        return f"{element}.{connector}" if element else connector

    joined = {
        name(it.endElement, it.endConnector): name(it.startElement, it.startConnector) for it in system.connections
    }
    outputs = [name for name, kind in kinds.items() if kind == "output"]
    inputs = [name for name, kind in kinds.items() if kind == "input"]
    inputs += [it.name for it in system.connectors if it.kind == "output"]
    return outputs, inputs, joined


def loop_of(ssp, folder, initially):
    """A chain of variables that leads back to its beginning: through the connections, and through the components by what
    their FMUs declare of Outputs, or of InitialUnknowns; None if there is none."""
    zipfile.ZipFile(ssp).extractall(folder)
    followers = {}
    system = read_ssd(str(ssp)).system
    for it in system.connections:
        followers.setdefault(f"{it.startElement}.{it.startConnector}", set()).add(f"{it.endElement}.{it.endConnector}")
    for part in system.elements:
        description = read_model_description(str(pathlib.Path(folder) / part.source))
        unknowns = description.initialUnknowns if initially else description.outputs
        for unknown in unknowns:
            knowns = description.modelVariables if unknown.dependencies is None else unknown.dependencies
            for known in knowns:
                followers.setdefault(f"{part.name}.{known.name}", set()).add(f"{part.name}.{unknown.variable.name}")
    done = set()
    for first in followers:
        path, open_ones = [], [iter([first])]
        while open_ones:
            name = next(open_ones[-1], None)
            if name is None:
                open_ones.pop()
                if path:
                    done.add(path.pop())
            elif name in path:
                return path[path.index(name) :]
            elif name not in done:
                path.append(name)
                open_ones.append(iter(followers.get(name, ())))
    return None


def simulated_by_libcosim(ssp, folder, step_s, steps, names):
    """The last values under libcosim, which exchanges outputs in initialization."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    zipfile.ZipFile(ssp).extractall(folder)
    execution = CosimExecution.from_ssp_file(ssp_path=str(folder), step_size=int(step_s * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer=observer)
    assert execution.step(step_count=steps)
    values = {}
    for component, part in enumerate(read_ssd(str(ssp)).system.elements):
        references = {it.name.decode(): it.reference for it in execution.slave_variables(slave_index=component)}
        own = [name for name in names if name.startswith(f"{part.name}.")]
        if own:
            expected = [references[name.partition(".")[2]] for name in own]
            last = observer.last_real_values(slave_index=component, variable_references=expected)
            values |= dict(zip(own, last, strict=True))
    return [values[name] for name in names]
