"""FMUs that stay loaded: simulated with inputs over time, by communication points that keep events apart, and recorded."""

import contextlib
import ctypes
import pathlib
import re
import tempfile

import fmpy
import fmpy.fmi2
import numpy as np

# Times that differ by a smaller part of a step are one.
SAME = 1e-9
# Steps between states that are kept for events that a counter counts.
BLOCK = 64
# Events closer than a millionth of a step stay together.
MOST_HALVINGS = 20


class Failure(Exception):
    """A study that cannot go on, with a message for its user."""


class Fmu:
    """An FMU with one instance, which every simulation resets."""

    def __init__(self, path):
        if not path.is_file():
            raise Failure(f"{path}: found no such file: see --dist")
        self.folder = tempfile.TemporaryDirectory(prefix="study-")
        fmpy.extract(path, self.folder.name)
        self.description = fmpy.read_model_description(self.folder.name, validate=False)
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self._elements = {}
        for name in self.variables:
            self._elements.setdefault(re.sub(r"\[[\d,]+\]$", "", name), []).append(name)
        self._messages = []
        self._callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        ctypes.pointer(self._callbacks)[0] = fmpy.fmi2.defaultCallbacks
        self._callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(lambda *call: self._messages.append(call[4].decode()))
        self.slave = fmpy.fmi2.FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder.name,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=path.stem,
        )
        self.slave.instantiate(callbacks=self._callbacks)
        self._is_new = True

    def elements(self, name):
        """The names that a name means: its own, or those of a vector's elements."""
        if name in self.variables:
            return [name]
        if name not in self._elements:
            raise Failure(f"{name}: found no such variable in {self.description.modelName}")
        return self._elements[name]

    def members(self, group, names):
        """The names of all members of a numbered group, member by member: panel[1].angle, panel[2].angle."""
        count = next(k for k in range(len(self.variables)) if f"{group}[{k + 1}].{names[0]}" not in self._elements)
        return [f"{group}[{k + 1}].{name}" for k in range(count) for name in names]

    def default(self, name):
        """The start value of a variable or a vector in the description."""
        values = np.array([float(self.variables[element].start) for element in self.elements(name)])
        return values if len(values) > 1 else values[0]

    def resource(self, file):
        """The text of a file in its resources."""
        return pathlib.Path(self.folder.name, "resources", file).read_text(encoding="utf-8")

    def start(self, settings, stop_s, start_s=0.0):
        """Initializes the instance anew with these values, by variable or vector; Enumerations take the names of items."""
        if not self._is_new:
            self.slave.reset()
        self._is_new = False
        self._messages.clear()
        experiment = self.description.defaultExperiment
        tolerance = float(experiment.tolerance) if experiment is not None and experiment.tolerance else None
        self.slave.setupExperiment(tolerance=tolerance, startTime=start_s, stopTime=stop_s)
        is_input = {name: self.variables[self.elements(name)[0]].causality == "input" for name in settings}
        for name, value in settings.items():
            if not is_input[name]:
                self.set(name, value)
        self.slave.enterInitializationMode()
        for name, value in settings.items():
            if is_input[name]:
                self.set(name, value)
        self.slave.exitInitializationMode()

    def set(self, name, value):
        """Sets a variable or all elements of a vector."""
        variables = [self.variables[element] for element in self.elements(name)]
        references = [variable.valueReference for variable in variables]
        kind = variables[0].type
        if kind == "Enumeration" and isinstance(value, str):
            value = self.item(name, value)
        values = [value] if isinstance(value, str) else np.atleast_1d(value).ravel().tolist()
        if len(values) != len(references):
            raise Failure(f"{name}: found {len(values)} values, allowed: {len(references)}")
        setters = {"Real": self.slave.setReal, "Boolean": self.slave.setBoolean, "String": self.slave.setString}
        setters.get(kind, self.slave.setInteger)(references, values)

    def item(self, name, item):
        """The number of an Enumeration's item."""
        items = {it.name: int(it.value) for it in self.variables[name].declaredType.items}
        if item not in items:
            raise Failure(f"{name}: found {item}, allowed: {', '.join(items)}")
        return items[item]

    def step(self, time_s, step_s):
        """Takes one communication step."""
        self.slave.doStep(time_s, step_s)

    def step_apart(self, time_s, step_s, counter, between, halvings=MOST_HALVINGS):
        """Takes a step in which the counter rises by one at most; otherwise the state before it is restored and the step is
        taken in halves. `between` is called with every time at which a half ends within the step."""
        before = counter.read()[0]
        state = self.slave.getFMUState()
        self.step(time_s, step_s)
        is_crowded = halvings > 0 and counter.read()[0] > before + 1
        if is_crowded:
            self.slave.setFMUState(state)
        self.slave.freeFMUState(state)
        if is_crowded:
            half_s = 0.5 * step_s
            self.step_apart(time_s, half_s, counter, between, halvings - 1)
            between(time_s + half_s)
            self.step_apart(time_s + half_s, half_s, counter, between, halvings - 1)

    def simulate(self, label, settings, names, stop_s, step_s, every=1, inputs=None, counter=None):
        """Simulates from 0 to `stop_s` and returns the Recording of `names` at every `every`-th communication point.

        `inputs` has for each variable or vector one row a communication point, which is set there; `counter` is an Integer
        among the names whose every increment gets a point of its own. The label is for messages.
        """
        with self.labelled(label):
            self.start(settings, stop_s)
            return self._stepped(names, stop_s, step_s, every, inputs, counter)

    @contextlib.contextmanager
    def labelled(self, label):
        """Makes a call that fails a Failure with the label and the last message of the FMU."""
        try:
            yield
        except fmpy.fmi1.FMICallException as error:
            raise Failure(f"{label}: {self._messages[-1] if self._messages else error}") from None

    def _stepped(self, names, stop_s, step_s, every, inputs, counter):
        output, counted = Port(self, names), Port(self, [counter]) if counter else None
        written = Port(self, list(inputs)) if inputs else None
        table = np.column_stack([np.asarray(rows, float) for rows in inputs.values()]) if inputs else None
        times_s, rows, count = [0.0], [output.read().copy()], steps(stop_s, step_s)

        def record(time_s):
            times_s.append(time_s)
            rows.append(output.read().copy())

        def advance(first, last, is_apart=False):
            for k in range(first, last):
                time_s, is_last = k * step_s, k + 1 == count
                if written:
                    written.write(table[k])
                # Every step but the last has the step size itself: not each difference of two points is it to the bit.
                length_s = stop_s - time_s if is_last else step_s
                if is_apart:
                    self.step_apart(time_s, length_s, counted, record)
                else:
                    self.step(time_s, length_s)
                if (k + 1) % every == 0 or is_last:
                    record(stop_s if is_last else (k + 1) * step_s)

        if counter is None:
            advance(0, count)
        for first in range(0, count if counter else 0, BLOCK):
            # A block of steps is taken again where the counter rose by more than one in a step.
            state, done, last = self.slave.getFMUState(), len(rows), min(first + BLOCK, count)
            advance(first, last)
            if np.diff([row[output.columns[counter]] for row in rows[done - 1 :]]).max() > 1.0:
                self.slave.setFMUState(state)
                del times_s[done:], rows[done:]
                advance(first, last, is_apart=True)
            self.slave.freeFMUState(state)
        self.slave.terminate()
        return Recording(times_s, rows, output.columns)


def steps(stop_s, step_s):
    """The number of steps of a simulation; a remainder below rounding is no step."""
    quotient = stop_s / step_s
    whole = round(quotient)
    return max(1, whole if abs(quotient - whole) <= SAME * max(whole, 1) else int(np.ceil(quotient)))


class Port:
    """Variables of an FMU's instance that are read or written together, their values in one array."""

    def __init__(self, fmu, names):
        self._component = fmu.slave.component
        elements, self.columns = [], {}
        for name in names:
            own = fmu.elements(name)
            is_vector = name not in fmu.variables
            self.columns[name] = slice(len(elements), len(elements) + len(own)) if is_vector else len(elements)
            elements += own
        self.values = np.empty(len(elements))
        self._calls = []
        kinds = np.array([{"Enumeration": "Integer"}.get(kind, kind) for kind in (fmu.variables[it].type for it in elements)])
        for kind in dict.fromkeys(kinds.tolist()):
            where = np.flatnonzero(kinds == kind)
            references = (ctypes.c_uint * len(where))(*(fmu.variables[elements[k]].valueReference for k in where))
            buffer = ((ctypes.c_double if kind == "Real" else ctypes.c_int) * len(where))()
            whole = slice(None) if len(where) == len(elements) else where
            call = (getattr(fmu.slave, f"fmi2Get{kind}"), getattr(fmu.slave, f"fmi2Set{kind}"), references, buffer)
            self._calls.append((*call, np.frombuffer(buffer, dtype=buffer._type_), whole))

    def read(self):
        """Reads all; the array is that of the next read."""
        for get, _, references, buffer, view, where in self._calls:
            get(self._component, references, len(buffer), buffer)
            self.values[where] = view
        return self.values

    def write(self, values):
        """Sets all."""
        for _, set_, references, buffer, view, where in self._calls:
            view[:] = values[where]
            set_(self._component, references, len(buffer), buffer)

    def __getitem__(self, name):
        return self.values[self.columns[name]]


class Recording:
    """Recorded points: times in s, and by name the values of a variable or, one row a point, of a vector."""

    def __init__(self, times_s, rows, columns):
        self.time_s, self.rows, self._columns = np.array(times_s), np.array(rows), columns

    def __getitem__(self, name):
        return self.rows[:, self._columns[name]]

    def last(self, name):
        """The value at the last point."""
        return self[name][-1]
