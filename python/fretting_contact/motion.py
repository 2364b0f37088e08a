"""Motions that are followed step by step: a friction loop, and a measured displacement."""

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .contact import Contact
from .history import OUTPUTS, Array, MotionHistory
from .quantities import ParameterError, in_si


class SignalError(ValueError):
    """A signal that cannot be followed; the text says where and what to do."""


@dataclass(frozen=True)
class FrictionLoop(MotionHistory):
    """One closed cycle; its first and its last point are the same place."""

    @property
    def work(self) -> float:
        """Friction work of the cycle, J."""
        return float(self.dissipated_energy[-1] - self.dissipated_energy[0])

    @property
    def worn_volume(self) -> float:
        """Volume that the cycle wore, m³."""
        return float(self.wear_volume[-1] - self.wear_volume[0])

    @property
    def force_amplitude(self) -> float:
        """Half the range of the tangential force, N."""
        return float(np.ptp(self.tangential_force) / 2)

    @property
    def displacement_amplitude(self) -> float:
        """Half the range of the displacement in the contact, m."""
        return float(np.ptp(self.contact_displacement) / 2)


def loop(
    contact: Contact,
    amplitude: float | str,
    *,
    normal_force: float | str | None = None,
    center: float | str = 0.0,
    cycles: int = 2,
    points: int = 200,
    period: float = 1.0,
) -> FrictionLoop:
    """Cycles of a sine displacement; returns the last one.

    `amplitude`, `center`: of the displacement, m. `normal_force`: N, constant; that of the contact
    if not given. These may be texts with a unit: `amplitude="1.5 um"`. `cycles`: number of cycles;
    the first one begins at rest and differs. `points`: steps in a cycle. `period`: of a cycle, s;
    it has no influence on friction and wear.

    >>> with Contact() as contact:
    ...     last = loop(contact, 1.5e-6)
    >>> print(f"{last.force_amplitude:.2f} N, {last.work:.3g} J")
    44.31 N, 1.9e-05 J
    """
    for name, number, least in ("cycles", cycles, 1), ("points", points, 4):
        if not (isinstance(number, Real) and number >= least and float(number).is_integer()):
            raise SignalError(f"{name} = {number!r}: give a whole number, {least} or more")
    points = int(points)
    amplitude = _number(amplitude, "m", "amplitude")
    center = _number(center, "m", "center")
    phase = np.arange(points * int(cycles) + 1) / points
    displacement = center + amplitude * np.sin(2 * np.pi * phase)
    whole = drive(contact, phase * period, displacement, normal_force)
    last = slice(-points - 1, None)
    return FrictionLoop(**{name: values[last] for name, values in whole.columns().items()})  # type: ignore[arg-type]


def drive(
    contact: Contact,
    time: ArrayLike,
    displacement: ArrayLike,
    normal_force: ArrayLike | str | None = None,
    *,
    displacement_y: ArrayLike | None = None,
    outputs: str | Sequence[str] = (),
) -> MotionHistory:
    """Follows measured signals, straight from sample to sample.

    `time`: s, rising. `displacement`: m, in the direction of `tangential_displacement`;
    `displacement_y`: m, across it. `normal_force`: N, one value, which may be a text with a unit,
    or one a sample; that of the contact if not given. Lists, arrays and pandas columns are
    accepted. `outputs`: further outputs to record, one name or several; enumerations are recorded
    by number, Booleans as 0 or 1, of fields single values: "pressure[1]". A contact that has not
    been moved yet is pressed on at the first sample, so that an offset of the displacement does no
    harm; another one goes straight there. Noise of a displacement wears: filter it first
    (docs/noisy_signals.md).

    >>> with Contact() as contact:
    ...     there = drive(contact, [0.0, 0.1, 0.2], [0.0, 1e-6, 4e-6], normal_force=[100, 100, 50])
    >>> there.tangential_force.round(2).tolist()
    [0.0, 31.7, 30.0]
    """
    contact.require(loading="transient")
    signals: dict[str, Array] = {
        "time": _signal("time", time),
        "tangential_displacement": _signal("displacement", displacement),
    }
    if displacement_y is not None:
        signals["tangential_displacement_y"] = _signal("displacement_y", displacement_y)
    if normal_force is not None:
        load = _number(normal_force, "N", "normal_force")
        signals["normal_force"] = (
            np.full(signals["time"].shape, _signal("normal_force", [load])[0])
            if np.ndim(load) == 0
            else _signal("normal_force", load)
        )
    count = len(signals["time"])
    for name, values in signals.items():
        if len(values) != count:
            raise SignalError(
                f"{name} has {len(values)} samples and time has {count}: give one sample "
                "for each time"
            )
    given = signals.pop("time")
    steps = np.diff(given)
    if count > 1 and not np.all(steps > 0):
        k = int(np.argmin(steps > 0))
        raise SignalError(
            f"time[{k + 1}] = {given[k + 1]:g} s does not rise from time[{k}] = "
            f"{given[k]:g} s: sort the samples"
        )
    outputs = [outputs] if isinstance(outputs, str) else list(outputs)
    for name in outputs:
        if name in contact.fields:
            raise ParameterError(
                f"outputs has {name!r}, a field, which drive does not record: give single values "
                f"such as {name + '[1]'!r}, or step by step read contact[{name!r}]"
            )
        if contact._require(name).type == "String":
            raise ParameterError(f"outputs has {name!r}, a text: give names of numbers")
    names = [*OUTPUTS.values(), *outputs]
    with contact.unchanged_if_refused():
        if not contact.has_moved:
            contact.restart(
                **{**contact.given, **{name: values[0] for name, values in signals.items()}}
            )
            first = contact._reader(names)()
            rest = contact.follow(
                names, steps, **{name: values[1:] for name, values in signals.items()}
            )
            found = {
                name: np.concatenate([[value], rest[name]]) for name, value in zip(names, first)
            }
        else:
            # the way to the first sample takes one more step of time, without influence on what
            # happens
            lead = float(steps[0]) if count > 1 else 1e-3
            found = contact.follow(names, np.concatenate([[lead], steps]), **signals)
    columns = {field: found[name] for field, name in OUTPUTS.items()}
    more = {name: found[name] for name in outputs}
    return MotionHistory(
        time=given, displacement=signals["tangential_displacement"], **columns, more=more
    )


def frequency_of(contact: Contact) -> float:
    """The frequency of cyclic loading, Hz."""
    frequency: float = contact.get("frequency")
    if not frequency > 0:
        raise SignalError(f"frequency = {frequency:g} Hz makes no cycles: set a frequency above 0")
    return frequency


def _number(value: Any, unit: str, name: str) -> Any:
    """The value in `unit` where it is a text with a unit; another one is left as it is."""
    return in_si(value, unit, name) if isinstance(value, str) else value


def _signal(name: str, values: ArrayLike) -> Array:
    """A finite one-dimensional array."""
    if np.ma.is_masked(values):
        k = int(np.argmax(np.ma.getmaskarray(values)))
        raise SignalError(
            f"{name}[{k}] is masked: interpolate the gap or cut the signal there"
        )
    given = np.asarray(values)
    if given.dtype.kind in "Mm":
        raise SignalError(
            f"{name} has the type {given.dtype}: give numbers, times in seconds such as "
            '(t - t[0]) / np.timedelta64(1, "s")'
        )
    try:
        array = given.astype(float)
    except (TypeError, ValueError):
        raise SignalError(f"{name} has the type {given.dtype}: give numbers") from None
    if array.ndim != 1 or len(array) == 0:
        raise SignalError(f"{name} has the shape {array.shape}: give a sequence of samples")
    if not np.all(np.isfinite(array)):
        k = int(np.argmin(np.isfinite(array)))
        raise SignalError(
            f"{name}[{k}] = {array[k]} is not finite: interpolate the gap or cut the signal there"
        )
    return array
