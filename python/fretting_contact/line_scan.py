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
    columns = read_columns(path)
    if len(columns) < FEWEST_POINTS:
        raise ScanError(f"{path}: {len(columns)} point(s), but at least {FEWEST_POINTS} are needed")
    columns = columns[np.argsort(columns[:, 0], kind="stable")]
    return Scan(columns[:, 0] * UNITS[unit], columns[:, 1] * UNITS[z_unit or unit])


def difference_noise(z: Array) -> float:
    """Standard deviation of independent noise on a smooth curve, from its third differences."""
    third = np.diff(z, 3)
    return float(np.median(np.abs(third - np.median(third)))) * 1.4826 / np.sqrt(20)
