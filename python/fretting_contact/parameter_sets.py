"""Sets of parameters for a sweep: grids, spread points, files."""

import csv
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


class SetsError(ValueError):
    """Sets that cannot be made; the text says where and what to do."""


@dataclass(frozen=True)
class ParameterSets:
    """Values of parameters by name: one column for each parameter, one row for each set."""

    columns: dict[str, list[Any]]

    def __post_init__(self) -> None:
        lengths = {name: len(values) for name, values in self.columns.items()}
        if not lengths or len(set(lengths.values())) != 1 or 0 in lengths.values():
            raise SetsError(
                f"the columns have {lengths} values: give as many for each parameter, and "
                "one at least"
            )

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def rows(self, first: int = 0, last: int | None = None) -> list[dict[str, Any]]:
        """The sets from `first` to before `last`, each as a dictionary."""
        names = list(self.columns)
        return [
            dict(zip(names, row))
            for row in zip(*(values[first:last] for values in self.columns.values()))
        ]


def _plain(values: ArrayLike) -> list[Any]:
    """A list of Python's own numbers and texts."""
    if isinstance(values, (list, tuple)) and not any(np.ndim(value) for value in values):
        return [
            value.item() if isinstance(value, np.generic) else value for value in values
        ]  # texts and numbers together
    found = np.asarray(values)
    if found.ndim != 1:
        raise SetsError(f"values of the shape {found.shape}: give a sequence for each parameter")
    return list(found.tolist())


def grid(over: Mapping[str, ArrayLike]) -> ParameterSets:
    """Each value of each parameter with all values of the others; the last parameter changes first.

    >>> grid({"normal_force": [50.0, 100.0], "radius": [0.01, 0.02]}).rows()[:2]
    [{'normal_force': 50.0, 'radius': 0.01}, {'normal_force': 50.0, 'radius': 0.02}]
    """
    lists = {name: _plain(values) for name, values in over.items()}
    places = np.indices([len(values) for values in lists.values()]).reshape(len(lists), -1)
    return ParameterSets(
        {name: [values[k] for k in place] for (name, values), place in zip(lists.items(), places)}
    )


def spread(over: Mapping[str, Sequence[Any]], count: int, seed: float = 1.0) -> ParameterSets:
    """`count` sets, spread evenly over ranges of one or several parameters.

    `over`: (low, high) for each parameter, or (low, high, "log") for even logarithms. The sequence
    is that of Kronecker with the powers of the generalised golden ratio; `seed` shifts it. More
    sets are the same sets and further ones.

    >>> sets = spread({"normal_force": (10.0, 300.0, "log"), "radius": (0.005, 0.02)}, 100)
    >>> len(sets), 10 < min(sets.columns["normal_force"]) < 12
    (100, True)
    """
    ratio = 2.0  # root of x^(n+1) = x + 1
    for _ in range(60):
        ratio = (1 + ratio) ** (1 / (len(over) + 1))
    steps = ratio ** -np.arange(1.0, len(over) + 1)
    places = (0.5 + seed * steps + np.arange(count)[:, None] * steps) % 1.0
    columns = {}
    for (name, bounds), place in zip(over.items(), places.T):
        low, high, *scale = bounds
        if scale not in ([], ["log"]) or not low < high or (scale and not low > 0):
            raise SetsError(
                f'{name} = {bounds!r}: give (low, high) or (low, high, "log") with low < '
                'high, above 0 for "log"'
            )
        values = low * (high / low) ** place if scale else low + (high - low) * place
        columns[name] = values.tolist()
    return ParameterSets(columns)


def read_sets(path: str | os.PathLike[str]) -> ParameterSets:
    """Sets from a CSV file: names of parameters in the first line, one set in each further line.

    Values are numbers in SI units, texts with a unit, or names of enumeration items.
    """
    with open(path, newline="", encoding="utf-8-sig") as file:
        lines = [line for line in csv.reader(file) if line]
    if len(lines) < 2:
        raise SetsError(f"{path}: {len(lines)} line(s); the names and one set at least are needed")
    names = [name.strip() for name in lines[0]]
    columns: dict[str, list[Any]] = {name: [] for name in names}
    for number, line in enumerate(lines[1:], start=2):
        if len(line) != len(names):
            raise SetsError(
                f"{path}, line {number}: {len(line)} value(s) for {len(names)} name(s): "
                "correct the line"
            )
        for name, text in zip(names, line):
            columns[name].append(_value(text.strip()))
    return ParameterSets(columns)


def _value(text: str) -> int | float | str:
    for kind in int, float:
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def sets_of(over: Any) -> ParameterSets:
    """Sets for `sweep`: `ParameterSets`, a grid of arrays, a pandas table or a CSV file."""
    if isinstance(over, ParameterSets):
        return over
    if isinstance(over, (str, os.PathLike)):
        return read_sets(over)
    if hasattr(over, "to_dict") and hasattr(over, "columns"):
        return ParameterSets({str(name): over[name].tolist() for name in over.columns})
    if isinstance(over, Mapping):
        return grid(over)
    raise SetsError(
        f"over = {over!r}: give a dictionary of arrays, grid(), spread(), a "
        "DataFrame or the path of a CSV file"
    )
