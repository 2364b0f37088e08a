"""FrettingContact.fmu as a Python object, on fmpy's low-level interface.

    with FmuFile("FrettingContact.fmu") as fmu, ContactFmu(fmu) as contact:
        contact.start(normal_force=100.0)
        contact.step(tangential_displacement=1e-6)
        print(contact.get("tangential_force"))

Everything is in SI units. Variables go by their names; enumerations may be given by their item's name.
"""

import itertools
import shutil
from ctypes import byref

import fmpy
import numpy as np
from fmpy import calloc, free
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

PROBES = 64
"""Number of radii at which the FMU reports its fields."""

_messages = {}
_numbers = itertools.count(1)


def _log(_environment, instance_name, status, _category, message):
    text = (message or b"").decode("utf-8", "replace")
    _messages.setdefault((instance_name or b"").decode(), []).append((status, text))


# fmpy formats printf-style messages in a native proxy that keeps one pointer to a Python logger for the
# whole process. One set of callbacks that lives as long as the process is therefore shared by all instances.
_callbacks = fmi2CallbackFunctions()
_callbacks.logger = fmi2CallbackLoggerTYPE(_log)
_callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
_callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
_proxied_logger = _callbacks.logger  # addLoggerProxy replaces the field: keep the Python side alive
addLoggerProxy(byref(_callbacks))


class ContactError(Exception):
    """A call that the FMU refused: `function`, FMI `status`, and the messages of the FMU in `messages`."""

    def __init__(self, function, status, messages):
        self.function, self.status, self.messages = function, status, messages
        super().__init__(f"{function} returned status {status}: {' / '.join(messages) or 'no message'}")


class FmuFile:
    """An FMU unpacked into a temporary directory, for any number of instances."""

    def __init__(self, path):
        self.path = str(path)
        self.description = fmpy.read_model_description(self.path)
        self.directory = fmpy.extract(self.path)
        self.variables = {v.name: v for v in self.description.modelVariables}

    def close(self):
        shutil.rmtree(self.directory, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class ContactFmu:
    """One instance of the FMU. `start` initialises it; `step` advances it."""

    def __init__(self, fmu):
        self.fmu = fmu
        self.name = f"contact {next(_numbers)}"
        self.time = 0.0
        self.slave = FMU2Slave(
            guid=fmu.description.guid,
            unzipDirectory=fmu.directory,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName=self.name,
        )
        self._call(self.slave.instantiate, callbacks=_callbacks, loggingOn=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.slave.freeInstance()
        _messages.pop(self.name, None)

    @property
    def messages(self):
        """All (status, text) pairs that the instance has logged."""
        return _messages.get(self.name, [])

    def start(self, **values):
        """Sets parameters and initial inputs, and initialises. The bodies then touch with these inputs."""
        self._call(self.slave.setupExperiment, startTime=0.0)
        self.set(**values)
        self._call(self.slave.enterInitializationMode)
        self._call(self.slave.exitInitializationMode)
        self.time = 0.0
        return self

    def reset(self):
        """Back to the state right after the instance was made."""
        self._call(self.slave.reset)

    def set(self, **values):
        """Sets variables by name."""
        for type_, group in self._by_type(values).items():
            setter = getattr(self.slave, "set" + {"Enumeration": "Integer"}.get(type_, type_))
            references = [variable.valueReference for variable in group]
            self._call(setter, references, [self._encode(variable, values[variable.name]) for variable in group])

    def get(self, *names):
        """Values of variables: one for one name, otherwise a list in the requested order."""
        found = {}
        for type_, group in self._by_type(names).items():
            getter = getattr(self.slave, "get" + {"Enumeration": "Integer"}.get(type_, type_))
            values = self._call(getter, [variable.valueReference for variable in group])
            found.update({variable.name: self._decode(variable, x) for variable, x in zip(group, values)})
        return found[names[0]] if len(names) == 1 else [found[name] for name in names]

    def field(self, name):
        """A field at the probe radii, as an array."""
        return np.array(self.get(*(f"{name}[{i}]" for i in range(1, PROBES + 1))))

    def step(self, size=1e-3, **inputs):
        """Sets inputs and advances by `size` seconds: the contact follows a straight line to the new inputs."""
        if inputs:
            self.set(**inputs)
        self._call(self.slave.doStep, self.time, size)
        self.time += size

    def walk(self, outputs, step_size=1e-3, **inputs):
        """Follows equally long sequences of inputs; returns {output: array}, the state after each step."""
        rows = []
        for values in zip(*inputs.values(), strict=True):
            self.step(step_size, **dict(zip(inputs, values)))
            rows.append([self.get(*outputs)] if len(outputs) == 1 else self.get(*outputs))
        return dict(zip(outputs, np.array(rows, dtype=object).T.astype(float)))

    def _by_type(self, names):
        groups = {}
        for name in names:
            variable = self.fmu.variables[name]
            groups.setdefault(variable.type, []).append(variable)
        return groups

    @staticmethod
    def _encode(variable, value):
        if variable.type == "Enumeration" and isinstance(value, str):
            return next(int(item.value) for item in variable.declaredType.items if item.name == value)
        return value

    @staticmethod
    def _decode(variable, value):
        if variable.type == "Enumeration":
            return next(item.name for item in variable.declaredType.items if int(item.value) == value)
        return value.decode() if isinstance(value, bytes) else value

    def _call(self, function, *arguments, **keywords):
        first = len(self.messages)
        try:
            return function(*arguments, **keywords)
        except FMICallException as error:
            texts = [text for status, text in self.messages[first:] if status > 0]
            raise ContactError(error.function, error.status, texts) from error
