"""One instance of FrettingContact.fmu on the low-level interface of FMPy.

    with FmuFile("FrettingContact.fmu") as fmu, ContactFmu(fmu) as contact:
        contact.start(normal_force=100.0)
        contact.step(tangential_displacement=1e-6)
        print(contact.get("tangential_force"))

SI units. Variables are used by their names; enumerations may be given by the name of their item.
`Contact` adds checks, units and warnings to this class.
"""

import itertools
from collections.abc import Callable, Iterable, Sequence
from ctypes import byref
from typing import Any

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
from numpy.typing import ArrayLike, NDArray

from .fmu_file import FmuFile

__all__ = ["PROBES", "ContactError", "ContactFmu", "FmuFile"]

PROBES = 64
"""Number of radii at which the FMU reports its fields."""

STATUS = ("fmi2OK", "fmi2Warning", "fmi2Discard", "fmi2Error", "fmi2Fatal", "fmi2Pending")

_messages: dict[str, list[tuple[int, str]]] = {}
_numbers = itertools.count(1)


def _log(
    _environment: object, instance_name: bytes, status: int, _category: bytes, message: bytes
) -> None:
    # FMI has a hash in a message doubled
    text = (message or b"").decode("utf-8", "replace").replace("##", "#")
    _messages.setdefault((instance_name or b"").decode(), []).append((status, text))


# fmpy formats printf-style messages in a native proxy that keeps one pointer to a Python logger for
# the whole process. One set of callbacks that lives as long as the process is therefore shared by
# all instances.
_callbacks = fmi2CallbackFunctions()
_callbacks.logger = fmi2CallbackLoggerTYPE(_log)
_callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
_callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
_proxied_logger = _callbacks.logger  # addLoggerProxy replaces the field: keep the Python side alive
addLoggerProxy(byref(_callbacks))


IN_PYTHON = {
    "call fmi2Reset": "call restart(...)",
    "or fmi2FreeInstance": "or close()",
    'not allowed in state "instantiated"': "the contact is not started, call start() first: "
    'not allowed in state "instantiated"',
}
"""What messages of the FMU are in terms of `Contact`."""


class ContactError(Exception):
    """A call that the FMU refused: `function`, FMI `status`, and the FMU's own `messages`."""

    def __init__(self, function: str, status: int, messages: list[str]):
        self.function, self.status, self.messages = function, status, messages
        name = STATUS[status] if status in range(len(STATUS)) else str(status)
        # a message begins with the function, which stands at the end here
        text = " / ".join(message.removeprefix(f"{function}: ") for message in messages)
        for fmi, python in IN_PYTHON.items():
            text = text.replace(fmi, python)
        super().__init__(f"{text or 'the component gave no message'} ({function}: {name})")


class ContactFmu:
    """One instance of the FMU. `start` initialises it; `step` advances it."""

    def __init__(self, fmu: FmuFile):
        self.fmu = fmu
        self._is_open = True
        self.name = f"contact {next(_numbers)}"
        self.time = 0.0
        self.has_moved = False  # whether a step has been taken since the start
        self.slave = FMU2Slave(
            guid=fmu.description.guid,
            unzipDirectory=fmu.directory,
            modelIdentifier=fmu.description.coSimulation.modelIdentifier,
            instanceName=self.name,
        )
        self._call(self.slave.instantiate, callbacks=_callbacks, loggingOn=True)

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        self._free()

    def _free(self) -> None:
        self._is_open = False
        self.slave.freeInstance()
        _messages.pop(self.name, None)

    @property
    def messages(self) -> list[tuple[int, str]]:
        """All (status, text) pairs that the instance has logged."""
        return _messages.get(self.name, [])

    def start(self, **values: Any) -> Any:
        """Sets parameters and initial inputs, and initialises with the bodies in contact."""
        self._call(self.slave.setupExperiment, startTime=0.0)
        self.set(**values)
        self._call(self.slave.enterInitializationMode)
        self._call(self.slave.exitInitializationMode)
        self.time = 0.0
        self.has_moved = False
        return self

    def reset(self) -> None:
        """Back to the state right after the instance was made."""
        self._call(self.slave.reset)

    def set(self, **values: Any) -> None:
        """Sets variables by name."""
        for type_, group in self._by_type(values).items():
            references = [variable.valueReference for variable in group]
            self._call(
                self._function("set", type_),
                references,
                [self._encode(variable, values[variable.name]) for variable in group],
            )

    def get(self, *names):
        """Values of variables: one for one name, otherwise a list in the requested order."""
        found = {}
        for type_, group in self._by_type(names).items():
            references = [variable.valueReference for variable in group]
            values = self._call(self._function("get", type_), references)
            found.update(
                {variable.name: self._decode(variable, x) for variable, x in zip(group, values)}
            )
        return found[names[0]] if len(names) == 1 else [found[name] for name in names]

    def field(self, name: str) -> NDArray[np.float64]:
        """A field at the probe radii, as an array."""
        return np.array(self.get(*(f"{name}[{i}]" for i in range(1, PROBES + 1))))

    def step(self, size=1e-3, **inputs):
        """Sets inputs and advances by `size` seconds, on a straight line to the new inputs."""
        if inputs:
            self.set(**inputs)
        self._call(self.slave.doStep, self.time, size)
        self.time += size
        self.has_moved = True
        return self

    def follow(
        self, outputs: Sequence[str], step_size: ArrayLike = 1e-3, **inputs: ArrayLike
    ) -> dict[str, NDArray[np.float64]]:
        """Follows equally long sequences of Real inputs, one step for each value.

        Outputs that are no Real are recorded as numbers: enumerations by that of their item.
        Returns {output: array}, the state after each step. `step_size`: s, one for all or one a
        step.
        """
        rows = np.column_stack(
            [np.asarray(values, dtype=float) for values in inputs.values()]
        ).tolist()
        sizes = np.broadcast_to(np.asarray(step_size, dtype=float), len(rows)).tolist()
        to_set = self._references(inputs)
        read = self._reader(outputs)
        found = np.empty((len(rows), len(outputs)))
        for k, (row, size) in enumerate(zip(rows, sizes)):
            self._call(self.slave.setReal, to_set, row)
            self._call(self.slave.doStep, self.time, size)
            self.time += size
            self.has_moved = True
            found[k] = read()
        return dict(zip(outputs, found.T))

    def _reader(self, names: Sequence[str]) -> Callable[[], list[float]]:
        """A function that reads variables as numbers, in the order of the names."""
        parts = [
            (self._function("get", type_), [variable.name for variable in group])
            for type_, group in self._by_type(names).items()
        ]
        calls = [(getter, self._references(group), group) for getter, group in parts]
        if len(calls) == 1:  # in the order of the names already
            getter, references, _ = calls[0]
            return lambda: self._call(getter, references)

        def read() -> list[float]:
            found: dict[str, float] = {}
            for getter, references, group in calls:
                found.update(zip(group, self._call(getter, references)))
            return [found[name] for name in names]

        return read

    def _function(self, verb: str, type_: str) -> Callable[..., Any]:
        """The function of the FMU that gets or sets variables of a type."""
        return getattr(self.slave, verb + {"Enumeration": "Integer"}.get(type_, type_))

    def _references(self, names: Iterable[str]) -> list[int]:
        return [self._require(name).valueReference for name in names]

    def _require(self, name: str) -> Any:
        """The variable of this name."""
        return self.fmu.variables[name]

    def _by_type(self, names: Iterable[str]) -> dict[str, list[Any]]:
        groups: dict[str, list[Any]] = {}
        for name in names:
            variable = self._require(name)
            groups.setdefault(variable.type, []).append(variable)
        return groups

    @staticmethod
    def _encode(variable: Any, value: Any) -> Any:
        if variable.type == "Enumeration" and isinstance(value, str):
            return next(
                int(item.value) for item in variable.declaredType.items if item.name == value
            )
        return value

    @staticmethod
    def _decode(variable: Any, value: Any) -> Any:
        if variable.type == "Enumeration":
            return next(
                item.name for item in variable.declaredType.items if int(item.value) == value
            )
        if variable.type == "Boolean":
            return bool(value)
        return value.decode() if isinstance(value, bytes) else value

    def __reduce__(self) -> Any:
        # two objects would free one instance
        raise TypeError(
            "a contact cannot be copied or pickled: make a new one, and give it bytes(save())"
        )

    def _check_open(self) -> Any:
        if not self._is_open:
            raise RuntimeError("the contact is closed: make a new one, Contact(...)")
        return self

    def _call(self, function: Callable[..., Any], *arguments: Any, **keywords: Any) -> Any:
        # a call with a freed instance would end the process
        self._check_open()
        first = len(self.messages)
        try:
            return function(*arguments, **keywords)
        except FMICallException as error:
            texts = [text for status, text in self.messages[first:] if status > 0]
            raise ContactError(error.function, error.status, texts) from error
