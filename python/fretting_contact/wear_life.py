"""Wear over many cycles at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .contact import Contact
from .history import CUBIC_MM, MICRO, Array, History, new_axes
from .motion import SignalError, frequency_of

_OUTPUTS = (
    "tangential_force",
    "dissipated_energy",
    "wear_volume",
    "wear_depth",
    "stick_radius",
    "contact_radius",
    "max_pressure",
    "indentation_depth",
)


@dataclass(frozen=True)
class WearLife(History):
    """What a contact became in the course of many cycles; one element for each number of cycles."""

    cycles: Array
    """Cycles since the call."""
    tangential_force: Array
    """Amplitude of the tangential force, N."""
    dissipated_energy: Array
    """Friction work since the contact was made, J."""
    wear_volume: Array
    """Worn volume since the contact was made, m³."""
    wear_depth: Array
    """Deepest point of the wear, m."""
    stick_radius: Array
    """Radius of the sticking part, m."""
    contact_radius: Array
    """Radius of the contact, m."""
    max_pressure: Array
    """Highest contact pressure, Pa."""
    indentation_depth: Array
    """Indentation depth of the unworn tip, m."""
    radius: Array
    """Radii of the fields, m; one row for each number of cycles."""
    worn_depth: Array
    """Depth of the wear at these radii, m."""
    pressure: Array
    """Contact pressure at these radii, Pa."""

    def plot(self, axes: Any = None) -> Any:
        """Worn volume and depth against cycles, worn depth along the radius; returns the axes."""
        axes = new_axes(axes, 3)
        axes[0].plot(self.cycles, self.wear_volume * CUBIC_MM)
        axes[1].plot(self.cycles, self.wear_depth * MICRO)
        for cycles, radius, depth in zip(self.cycles, self.radius, self.worn_depth):
            axes[2].plot(radius * MICRO, depth * MICRO, label=f"{cycles:.3g}")
        for each, label in zip(axes, ("worn volume (mm³)", "deepest point (µm)")):
            each.set(xlabel="cycles", ylabel=label)
        axes[2].set(xlabel="radius (µm)", ylabel="worn depth (µm)")
        if len(self.cycles) <= 8:
            axes[2].legend(title="cycles")
        return axes


def life(
    contact: Contact,
    cycles: float,
    at: ArrayLike | None = None,
    *,
    amplitude: float | None = None,
    normal_force: float | None = None,
) -> WearLife:
    """Cycles of one amplitude, computed many at once; the contact needs `loading="cyclic"`.

    `cycles`: number of cycles from now on. `at`: numbers of cycles, from now on, at which to
    read the contact; 21 even ones from 0 to `cycles` if not given. `amplitude`: of the
    displacement, m; `normal_force`: N; those of the contact if not given.

    >>> with Contact(loading="cyclic", displacement_amplitude="1.5 um") as contact:
    ...     worn = life(contact, 1e5, at=[1e4, 1e5])
    >>> print([f"{depth * 1e6:.1f} µm" for depth in worn.wear_depth])
    ['0.2 µm', '0.8 µm']
    """
    contact.require(loading="cyclic")
    if not (isinstance(cycles, Real) and 0 <= cycles < np.inf) or (at is None and cycles == 0):
        raise SignalError(f"cycles = {cycles!r}: give a finite number above 0 (a list goes to at)")
    numbers = np.linspace(0, cycles, 21) if at is None else np.asarray(at, dtype=float)
    if (
        numbers.ndim != 1
        or len(numbers) == 0
        or np.any(np.diff(numbers) <= 0)
        or not numbers[0] >= 0
    ):
        raise SignalError(f"at = {at!r}: give rising numbers of cycles, the first one 0 or more")
    if not numbers[-1] <= cycles * (1 + 1e-12):
        raise SignalError(
            f"at ends with {numbers[-1]:g}, beyond cycles = {cycles:g}: raise cycles or shorten at"
        )
    with contact.unchanged_if_refused():
        given = {"displacement_amplitude": amplitude, "normal_force": normal_force}
        contact.set(**{name: value for name, value in given.items() if value is not None})
        frequency = frequency_of(contact)
        rows: list[Sequence[float]] = []
        fields: dict[str, list[Array]] = {"radius_probe": [], "worn_depth": [], "pressure": []}
        done = 0.0
        for number in numbers:
            if number > done:
                contact.step((number - done) / frequency)
                done = number
            rows.append(contact.get(*_OUTPUTS))
            for name, values in fields.items():
                values.append(contact.field(name))
        if cycles > done:
            contact.step((cycles - done) / frequency)
    columns = dict(zip(_OUTPUTS, np.array(rows, dtype=float).T))
    radius, worn_depth, pressure = (np.array(values) for values in fields.values())
    return WearLife(
        cycles=numbers, **columns, radius=radius, worn_depth=worn_depth, pressure=pressure
    )
