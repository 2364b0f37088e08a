"""A fretting contact as a Python object."""

import contextlib
import os
import struct
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from ctypes import c_void_p
from functools import cached_property
from numbers import Integral, Real
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .component import ContactError, ContactFmu
from .fmu_file import FmuFile, shared_file
from .quantities import ParameterError, in_si, near

SETTABLE = ("parameter", "input")


class ContactWarning(UserWarning):
    """A warning of the component: a value that is allowed and seldom meant."""


class SavedState:
    """The state of a contact at one time. `bytes(state)` is for a file or another process."""

    def __init__(self, contact: "Contact", pointer: c_void_p):
        self._contact, self._pointer, self.time = contact, pointer, contact.time
        self.has_moved, self._given = contact.has_moved, contact.given

    def __bytes__(self) -> bytes:
        contact = self._contact._check_open()
        return struct.pack("<d", self.time) + contact._call(
            contact.slave.serializeFMUstate, self._pointer
        )

    def __copy__(self) -> "SavedState":
        return self  # a state does not change; a second object would free it twice

    def __deepcopy__(self, _: Any) -> "SavedState":
        return self

    def __reduce__(self) -> Any:
        raise TypeError("a saved state cannot be pickled: store bytes(state)")

    def __del__(self) -> None:
        if self._contact._is_open:
            self._contact.slave.freeFMUstate(self._pointer)


class Contact(ContactFmu):
    """A contact of two bodies with friction and wear, ready to be moved.

    Parameters and initial inputs go by their names in the component (docs/variables.md) and are
    in SI units: m, N, Pa, rad, Hz, N/m. A text with a unit is converted: `radius="10 mm"`,
    `youngs_modulus_1="210 GPa"`. Enumerations are texts: `loading="cyclic"`. `profile_file` may
    also be the result of `fit_scan`, a pair of arrays r and f in m, or an array with these two
    columns; `profile` is "table" with any of them and with a path, unless it is given.
    `fmu`: path of the FMU; that of the package if not given.

    Read values with `contact["wear_volume"]`, fields with `contact["pressure"]` (an array at
    the radii `contact["radius_probe"]`). A refused call raises `ContactError` with the component's
    message, and changes nothing. Its warnings are issued as `ContactWarning`.

    >>> with Contact(radius="10 mm", normal_force=100.0) as contact:
    ...     _ = contact.step(tangential_displacement="1 um")
    ...     print(f"{contact['tangential_force']:.2f} N, {contact['slip_state']}")
    ...     print(contact["pressure"].shape)
    31.70 N, partial_slip
    (64,)
    """

    def __init__(self, *, fmu: str | os.PathLike[str] | FmuFile | None = None, **parameters: Any):
        super().__init__(fmu if isinstance(fmu, FmuFile) else shared_file(fmu))
        self._table: Path | None = None
        self.given: dict[str, Any] = {}  # what has been set before the first step
        self._is_initialised = False
        self._accepted: dict[str, Any] = {}  # inputs of the last calls that were not refused
        try:
            self.start(**parameters)
        except BaseException:
            self._free()
            raise

    def __enter__(self) -> "Contact":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Contact at {self.time:g} s>" if self._is_open else "<Contact, closed>"

    def close(self) -> None:
        """Ends the instance. Its last warnings are issued here."""
        if self._is_open:
            # a contact that has failed is freed as it is
            with contextlib.suppress(ContactError):
                self._call(self.slave.terminate)
            self._free()

    def start(self, **parameters: Any) -> "Contact":
        """Initialises with these parameters and inputs; others have their start values."""
        super().start(**parameters)
        self._is_initialised = True
        self._accepted = {}
        self._remove_table()  # it has been read
        return self

    def restart(self, **parameters: Any) -> "Contact":
        """The same instance as a new contact with these parameters; faster than a new instance."""
        with self.unchanged_if_refused():
            self.reset()
            return self.start(**parameters)

    def reset(self) -> None:
        """Back to the state right after the instance was made; `start` goes on from there."""
        super().reset()
        self.given, self._accepted, self._is_initialised = {}, {}, False

    @contextlib.contextmanager
    def unchanged_if_refused(self) -> Iterator[None]:
        """Returns to the present state where a call inside is refused."""
        state, was_initialised = None, self._is_initialised
        with contextlib.suppress(ContactError):  # a contact that has failed has no state
            state = self.save()
        try:
            yield
        except BaseException:
            self._remove_table()
            if state is not None:
                self.restore(state)
                self._is_initialised = was_initialised
            raise

    def set(self, **values: Any) -> None:
        """Sets inputs, tunable parameters (between steps), or parameters (before the start)."""
        with self._inputs_kept(values):
            self._apply(values)

    def step(self, size: float | str = 1e-3, **inputs: Any) -> "Contact":
        """Sets inputs and advances by `size`, s, along the straight line to the new inputs.

        `size` may be a text with a unit: "1 ms".
        In cyclic loading a step makes `frequency` times `size` cycles.
        """
        if isinstance(size, str):
            size = in_si(size, "s", "size")
        try:
            size = float(size)
        except (TypeError, ValueError):
            raise ParameterError(f"size = {size!r}: give a number in s") from None
        given = self.given
        with self._inputs_kept(inputs):
            if inputs:
                self._apply(inputs)
            self.given = given
            super().step(size)
        return self

    def follow(self, *arguments: Any, **inputs: ArrayLike) -> dict[str, NDArray[np.float64]]:
        self._accepted = {}
        return super().follow(*arguments, **inputs)

    def _apply(self, values: dict[str, Any]) -> None:
        given = values
        profile = values.get("profile_file")
        if profile is not None and not isinstance(profile, (str, os.PathLike)):
            profile = self._write_table(profile)
        if profile is not None and str(profile):
            values = {"profile": "table", **values, "profile_file": profile}
        super().set(**{name: self._checked(name, value) for name, value in values.items()})
        if not self.has_moved:
            self.given = {**self.given, **given}

    @contextlib.contextmanager
    def _inputs_kept(self, values: dict[str, Any]) -> Iterator[None]:
        """Puts inputs and tunable parameters back where a call inside is refused."""
        names = []
        if self._is_initialised and self._is_open:
            variables = [self._require(name) for name in values]
            names = [
                each.name
                for each in variables
                if each.causality in SETTABLE and each.variability != "fixed"
            ]
        unknown = [name for name in names if name not in self._accepted]
        if unknown:
            found = self.get(*unknown)
            self._accepted.update(zip(unknown, found if len(unknown) > 1 else [found]))
        try:
            yield
        except BaseException:
            if names:
                super().set(**{name: self._checked(name, self._accepted[name]) for name in names})
            raise
        self._accepted.update({name: values[name] for name in names})

    def __getitem__(self, name: str) -> Any:
        """The value of a variable; an array for the name of a field."""
        references = self.fields.get(name)
        if references is not None:
            return np.array(self._call(self.slave.getReal, references))
        self._require(name)
        return self.get(name)

    @cached_property
    def fields(self) -> dict[str, list[int]]:
        """Names of the fields, with the value references of their elements."""
        found: dict[str, list[int]] = {}
        for name, variable in self.fmu.variables.items():
            if name.endswith("]"):
                found.setdefault(name.split("[")[0], []).append(variable.valueReference)
        return found

    def field(self, name: str) -> NDArray[np.float64]:
        """A field at the radii `radius_probe`."""
        if name not in self.fields:
            raise ParameterError(
                f"{name} is no field{near(name, self.fields)}; there are {', '.join(self.fields)}"
            )
        return self[name]

    def save(self) -> SavedState:
        """The present state; `restore` returns to it."""
        return SavedState(self, self._call(self.slave.getFMUstate))

    def restore(self, state: SavedState | bytes | bytearray | memoryview) -> "Contact":
        """Returns to a state of this contact, or takes one over from bytes."""
        self._check_open()
        self._accepted = {}
        if isinstance(state, SavedState):
            if state._contact is not self:
                raise ParameterError(
                    "the state is of another contact: restore it there, or give bytes(state)"
                )
            self._call(self.slave.setFMUstate, state._pointer)
            self.time, self.has_moved, self.given = state.time, state.has_moved, state._given
            return self
        if not isinstance(state, (bytes, bytearray, memoryview)):
            raise ParameterError(
                f"{type(state).__name__} is no state: give what save() or bytes(save()) returned"
            )
        state = bytes(state)
        if len(state) < 8:
            raise ParameterError(
                f"{len(state)} byte(s) are no state: give what bytes(contact.save()) returned"
            )
        pointer = self._call(self.slave.deSerializeFMUstate, state[8:])
        try:
            self._call(self.slave.setFMUstate, pointer)
        finally:
            self.slave.freeFMUstate(pointer)
        (self.time,) = struct.unpack("<d", state[:8])
        self.has_moved = True  # it cannot be started again: its parameters may be others
        return self

    def require(self, **values: str) -> None:
        """Raises unless these enumerations have these values."""
        for name, value in values.items():
            found = self.get(name)
            if found != value:
                raise ParameterError(
                    f"{name} = {found!r}, but {value!r} is needed: Contact({name}={value!r}, ...)"
                )

    def _free(self) -> None:
        super()._free()
        self._remove_table()

    def _remove_table(self) -> None:
        if self._table is not None:
            self._table.unlink(missing_ok=True)
            self._table = None

    def _require(self, name: str) -> Any:
        variable = self.fmu.variables.get(name)
        if variable is None:
            if name in self.fields:
                raise ParameterError(
                    f"{name} is a field: read it with contact[{name!r}], or one value as {name}[1]"
                )
            names = [*(n for n in self.fmu.variables if not n.endswith("]")), *self.fields]
            raise ParameterError(
                f"{name} is no variable of the component{near(name, names)}; "
                "list(contact.fmu.variables) has all names, docs/variables.md says what they are"
            )
        return variable

    def _checked(self, name: str, value: Any) -> Any:
        """The value as the component takes it."""
        variable = self._require(name)
        if variable.causality not in SETTABLE:
            raise ParameterError(
                f"{name} is computed by the component: read it with contact[{name!r}]"
            )
        if variable.type == "Enumeration":
            return _enumeration(
                name, value, {item.name: int(item.value) for item in variable.declaredType.items}
            )
        if variable.type == "String":
            if not isinstance(value, (str, os.PathLike)):
                raise ParameterError(f"{name} = {value!r}: give a text")
            return os.fspath(value)
        if isinstance(value, str):
            return in_si(value, variable.unit or getattr(variable.declaredType, "unit", None), name)
        if isinstance(value, np.ndarray) and value.ndim == 0:
            value = value.item()
        whole = variable.type == "Integer"
        if whole and isinstance(value, Integral) and not isinstance(value, bool):
            return int(value)
        if not whole and isinstance(value, Real) and not isinstance(value, bool):
            return float(value)
        kind = "a whole number" if whole else "a number"
        raise ParameterError(
            f"{name} = {value!r}: give {kind}; for several values at once see sweep()"
        )

    def _write_table(self, profile: Any) -> str:
        """Writes a profile of r and f in m to a file that lives until it has been read."""
        table = _table_of(profile)
        self._remove_table()
        handle, path = tempfile.mkstemp(prefix="fretting-profile-", suffix=".txt")
        os.close(handle)
        self._table = Path(path)
        np.savetxt(path, table, fmt="%.17e")
        return path

    def _call(self, function: Callable[..., Any], *arguments: Any, **keywords: Any) -> Any:
        first = len(self.messages)
        result = super()._call(function, *arguments, **keywords)
        for status, text in self.messages[first:]:
            if status == 1:
                warnings.warn(text, ContactWarning, stacklevel=_level_of_user())
        return result


def _level_of_user() -> int:
    """The `stacklevel` of the line outside this package that has led to the call of this function.

    `skip_file_prefixes` of `warnings.warn` needs Python 3.12.
    """
    inside = (os.path.dirname(__file__) + os.sep, contextlib.__file__)
    level, frame = 0, sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(inside):
        level, frame = level + 1, frame.f_back
    return level


def _table_of(profile: Any) -> NDArray[np.float64]:
    """The columns r and f of a fit, of a pair of arrays, or of an array with these columns."""
    try:
        if hasattr(profile, "radius"):
            return np.column_stack([profile.radius, profile.height]).astype(float)
        table = np.asarray(profile, dtype=float)
    except (TypeError, ValueError):
        table = np.zeros(0)
    if table.ndim == 2 and len(table) == 2:  # r and f
        return table.T
    if table.ndim == 2 and table.shape[1] == 2:
        return table
    raise ParameterError(
        f"profile_file is {type(profile).__name__}: give a path, the result of fit_scan, a pair of "
        "equally long arrays r and f in m, or an array with these two columns"
    )


def _enumeration(name: str, value: Any, items: dict[str, int]) -> int:
    """The number of an item that is given by name or number."""
    if isinstance(value, str) and value in items:
        return items[value]
    if isinstance(value, Integral) and int(value) in items.values():
        return int(value)
    raise ParameterError(
        f"{name} = {value!r}{near(str(value), items)}: give one of {', '.join(items)}"
    )
