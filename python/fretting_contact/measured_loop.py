"""A measured friction loop, and the smooth drive that it is reduced to."""

import os
from dataclasses import dataclass

import numpy as np

from .history import Array
from .quantities import in_si
from .text_table import read_columns

MOST_HARMONICS = 25
"""Harmonics of a drive at most: with them a triangular drive is within 1 % of its amplitude."""

FEWEST_POINTS = 16
"""Points that a cycle needs."""


class LoopError(ValueError):
    """A loop that cannot be used; the text says why and what to do."""


@dataclass(frozen=True)
class MeasuredLoop:
    """Displacement of the drive and tangential force, sampled evenly in time over whole cycles."""

    displacement: Array
    """Displacement of the drive, m."""
    force: Array
    """Tangential force, N, of the sign of the displacement."""
    normal_force: float
    """Normal force, N, or a text with a unit."""
    cycles: int = 1
    """Number of cycles in the record."""

    def __post_init__(self) -> None:
        for name in "displacement", "force":
            values = np.asarray(getattr(self, name), dtype=float)
            object.__setattr__(self, name, values)
            if values.ndim != 1 or not np.all(np.isfinite(values)):
                raise LoopError(
                    f"{name} has the shape {values.shape}: give a sequence of finite numbers"
                )
        count = len(self.displacement)
        if count != len(self.force):
            raise LoopError(
                f"displacement has {count} points and force has {len(self.force)}: give pairs"
            )
        if self.cycles < 1 or count < FEWEST_POINTS * self.cycles:
            raise LoopError(
                f"{count} points for {self.cycles} cycle(s): at least {FEWEST_POINTS} "
                "points a cycle are needed"
            )
        if isinstance(self.normal_force, str):
            load = in_si(self.normal_force, "N", "normal_force")
            object.__setattr__(self, "normal_force", load)
        if not self.normal_force > 0:
            raise LoopError(f"normal_force = {self.normal_force} N: give a number > 0")

    @property
    def is_one_cycle(self) -> bool:
        """Whether the record is a single cycle."""
        return self.cycles == 1

    @property
    def points_per_cycle(self) -> int:
        """Points of the first cycle."""
        return -(-len(self.displacement) // self.cycles)

    @staticmethod
    def read(
        path: str | os.PathLike[str],
        normal_force: float | str,
        cycles: int = 1,
        displacement_unit: float = 1.0,
        force_unit: float = 1.0,
    ) -> "MeasuredLoop":
        """Reads two columns, displacement and force, of a text file.

        `displacement_unit`, `force_unit`: what 1 in the file is, in m and in N.
        """
        table = read_columns(os.fspath(path))
        return MeasuredLoop(
            table[:, 0] * displacement_unit, table[:, 1] * force_unit, normal_force, cycles
        )


@dataclass(frozen=True)
class Drive:
    """A Fourier series fitted to a measured displacement."""

    basis: Array
    """Values of the functions 1, cos, sin, ... at the points."""
    coefficients: Array
    """Their coefficients, m; the first is the mean."""
    covariance: Array
    """Covariance of the coefficients, m²."""
    noise: float
    """Standard deviation about the series, m; 0 below a millionth of the amplitude."""

    @property
    def mean(self) -> float:
        """Mean displacement, m."""
        return float(self.coefficients[0])

    @property
    def displacement(self) -> Array:
        """The series at the points, m."""
        return self.basis @ self.coefficients


def _check_force(loop: MeasuredLoop) -> None:
    """Raises where the force is not that of friction and springs along the displacement."""
    if not np.ptp(loop.force) > 0:
        raise LoopError(f"force is {loop.force[0]:g} N at all points: a loop needs a varying force")
    u, force = loop.displacement - loop.displacement.mean(), loop.force - loop.force.mean()
    work = float(np.trapezoid(np.r_[force, force[0]], np.r_[u, u[0]]))
    if work < 0 and float(u @ force) < 0:
        raise LoopError(
            f"force has the opposite sign of displacement: the loop makes {work:.2g} J of friction "
            "work, which has to be positive; give -force"
        )


def smooth_drive(loop: MeasuredLoop) -> Drive:
    """The Fourier series whose number of harmonics has the least Bayesian criterion."""
    count = len(loop.displacement)
    phase = 2 * np.pi * np.arange(count) * loop.cycles / count
    most = min(MOST_HARMONICS, (loop.points_per_cycle - 1) // 4)
    harmonics = np.outer(phase, np.arange(1, most + 1))
    basis = np.column_stack(
        [
            np.ones(count),
            np.stack([np.cos(harmonics), np.sin(harmonics)], axis=2).reshape(count, -1),
        ]
    )
    amplitude = float(np.ptp(loop.displacement) / 2)
    if not amplitude > 0:
        raise LoopError("displacement is constant: a loop needs a motion")
    _check_force(loop)
    best: tuple[float, Drive] | None = None
    for size in range(3, 2 * most + 2, 2):
        columns = basis[:, :size]
        coefficients, *_ = np.linalg.lstsq(columns, loop.displacement, rcond=None)
        left = float(np.sum((loop.displacement - columns @ coefficients) ** 2))
        floor = (
            count * (1e-6 * amplitude) ** 2
        )  # of rounding in a text file: no reason for a harmonic
        criterion = count * np.log(max(left, floor) / count) + size * np.log(count)
        if best is None or criterion < best[0]:
            noise = np.sqrt(left / (count - size)) if left > floor else 0.0
            covariance = noise**2 * np.linalg.inv(columns.T @ columns)
            best = criterion, Drive(columns, coefficients, covariance, float(noise))
    assert best is not None
    if float(np.hypot(*best[1].coefficients[1:3])) < 0.5 * amplitude:
        raise LoopError(
            f"the displacement does not make {loop.cycles} cycle(s): give the number "
            "of cycles of the record"
        )
    return best[1]
