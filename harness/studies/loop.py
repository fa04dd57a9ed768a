"""A system of FMUs (SSP) stepped in a loop: every component takes the others' outputs of the step's beginning (Jacobi)."""

import contextlib
import pathlib
import tempfile
import zipfile
from xml.etree import ElementTree

import numpy as np

from fmu import Failure, Fmu, Port, Recording, steps

# Guidance samples once a second, and so do its studies.
SAMPLE_S = 1.0


class Loop:
    """The components of a system, each with one instance; variables are named `component.variable`."""

    def __init__(self, path):
        if not path.is_file():
            raise Failure(f"{path}: found no such file: see --dist")
        with tempfile.TemporaryDirectory(prefix="study-") as folder, zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
            root = ElementTree.parse(pathlib.Path(folder, "SystemStructure.ssd")).getroot()
            components = {it.get("name"): it.get("source") for it in root.iterfind(".//{*}Component")}
            self.fmus = {name: Fmu(pathlib.Path(folder, source)) for name, source in components.items()}
        ends = ("startElement", "startConnector", "endElement", "endConnector")
        joints = [tuple(it.get(end) for end in ends) for it in root.iterfind(".//{*}Connection")]
        joints = [joint for joint in joints if joint[0] and joint[2]]
        sources = list(dict.fromkeys(joint[:2] for joint in joints))
        self._outputs, self._inputs = [], []
        ordered = [source for component in self.fmus for source in sources if source[0] == component]
        for component, fmu in self.fmus.items():
            self._outputs.append(Port(fmu, [name for owner, name in ordered if owner == component]))
            own = [joint for joint in joints if joint[2] == component]
            self._inputs.append((Port(fmu, [joint[3] for joint in own]), [ordered.index(joint[:2]) for joint in own]))

    def split(self, names):
        """Names by component, without it."""
        parts = [name.split(".", 1) for name in names]
        return {component: [name for owner, name in parts if owner == component] for component in self.fmus}

    def default(self, name):
        """The start value of a variable or a vector."""
        component, own = name.split(".", 1)
        return self.fmus[component].default(own)

    def item(self, name, item):
        """The number of an Enumeration's item."""
        component, own = name.split(".", 1)
        return self.fmus[component].item(own, item)

    def set(self, settings):
        """Sets variables of the components."""
        for name, value in settings.items():
            component, own = name.split(".", 1)
            self.fmus[component].set(own, value)

    def simulate(self, label, settings, names, stop_s, step_s, steer=None):
        """The Recording of `names` once a second; `steer` answers each point, given by name, with what is set there."""
        with contextlib.ExitStack() as stack:
            for component, fmu in self.fmus.items():
                stack.enter_context(fmu.labelled(f"{label}, {component}"))
            return self._simulated(settings, names, stop_s, step_s, steer)

    def _simulated(self, settings, names, stop_s, step_s, steer):
        for component, own in self.split(settings).items():
            self.fmus[component].start({name: settings[f"{component}.{name}"] for name in own}, stop_s)
        ports = [Port(self.fmus[component], own) for component, own in self.split(names).items()]
        columns, first = {}, 0
        for component, port in zip(self.fmus, ports):
            for name, at in port.columns.items():
                at = slice(first + at.start, first + at.stop) if isinstance(at, slice) else first + at
                columns[f"{component}.{name}"] = at
            first += len(port.values)
        signals = np.concatenate([port.read() for port in self._outputs])
        times_s, rows = [], []

        def record(time_s):
            times_s.append(time_s)
            rows.append(np.concatenate([port.read() for port in ports]))
            if steer:
                self.set(steer(time_s, lambda name: rows[-1][columns[name]]))

        record(0.0)
        count, every = steps(stop_s, step_s), round(SAMPLE_S / step_s)
        for k in range(count):
            for port, of_signal in self._inputs:
                port.write(signals[of_signal])
            is_last = k + 1 == count
            for fmu in self.fmus.values():
                fmu.step(k * step_s, stop_s - k * step_s if is_last else step_s)
            np.concatenate([port.read() for port in self._outputs], out=signals)
            if (k + 1) % every == 0 or is_last:
                record(stop_s if is_last else (k + 1) * step_s)
        for fmu in self.fmus.values():
            fmu.slave.terminate()
        return Recording(times_s, rows, columns)
