"""A line scan over a tip: positions and heights."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .image_shapes import Array
from .text_table import read_columns

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
"""Length units by name, m."""

FEWEST_POINTS = 20
"""Points that a scan needs."""


class ScanError(ValueError):
    """A scan that cannot become a profile; the text says why and what to do."""


@dataclass(frozen=True)
class Scan:
    """A line scan: positions and heights, m, in the order of rising position."""

    x: Array
    z: Array


def read_scan(path: str | Path, unit: str = "m", z_unit: str | None = None) -> Scan:
    """Reads a line scan of two columns x and z.

    `unit` is that of both columns, `z_unit` that of the second one if it differs: m, mm, um or nm.
    """
    of_x, of_z = _factor("unit", unit), _factor("z_unit", unit if z_unit is None else z_unit)
    columns = read_columns(path)
    if len(columns) < FEWEST_POINTS:
        raise ScanError(f"{path}: {len(columns)} point(s), but at least {FEWEST_POINTS} are needed")
    columns = columns[np.argsort(columns[:, 0], kind="stable")]
    return Scan(columns[:, 0] * of_x, columns[:, 1] * of_z)


def _factor(name: str, unit: str) -> float:
    """What 1 of a unit is in m."""
    if unit not in UNITS:
        raise ScanError(f"{name} = {unit!r} is no unit of a scan: give one of {', '.join(UNITS)}")
    return UNITS[unit]


def checked(scan: Scan) -> Scan:
    """The scan with its columns as arrays of finite numbers, and positions that do not fall."""
    x, z = (_column(name, values) for name, values in (("x", scan.x), ("z", scan.z)))
    if len(x) != len(z):
        raise ScanError(f"x has {len(x)} points and z has {len(z)}: give one height per position")
    falls = np.diff(x) < 0
    if falls.any():
        k = int(np.argmax(falls)) + 1
        raise ScanError(
            f"x[{k}] = {x[k]:g} m is below x[{k - 1}] = {x[k - 1]:g} m, but positions rise: sort "
            "the points by x, for example k = numpy.argsort(x); Scan(x[k], z[k])"
        )
    return Scan(x, z)


def _column(name: str, values: Array) -> Array:
    try:
        column = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ScanError(f"{name} of the scan is no array of numbers: give numbers in m") from None
    if column.ndim != 1:
        raise ScanError(f"{name} has the shape {column.shape}: give one number for each point")
    if not np.isfinite(column).all():
        k = int(np.argmin(np.isfinite(column)))
        raise ScanError(
            f"{name}[{k}] = {column[k]} is not finite: leave this point out, in x and in z"
        )
    return column


def difference_noise(z: Array) -> float:
    """Standard deviation of independent noise on a smooth curve, from its third differences."""
    third = np.diff(z, 3)
    return float(np.median(np.abs(third - np.median(third)))) * 1.4826 / np.sqrt(20)
