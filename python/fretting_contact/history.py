"""Results as arrays: what a contact did, with its pictures."""

import csv
import os
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
MICRO, MEGA, CUBIC_MM = 1e6, 1e-6, 1e9
"""Factors from SI to µm, µJ and N/µm; to MPa; to mm³."""


def new_axes(axes: Any, count: int = 1) -> Any:
    """The axes to draw into: those given, or those of a new figure."""
    if axes is not None:
        return axes
    try:
        import matplotlib.pyplot as plt
    except ImportError as problem:
        raise ImportError(
            "pictures need matplotlib: pip install fretting-contact[plot]"
        ) from problem
    return plt.subplots(1, count, figsize=(5.6 * count, 4.2), layout="constrained")[1]


class History:
    """Arrays of equal length, one element for each time."""

    def columns(self) -> dict[str, Array]:
        """The one-dimensional arrays by name, for a table: `pandas.DataFrame(result.columns())`."""
        found = {
            each.name: getattr(self, each.name) for each in fields(self) if each.name != "more"
        }  # type: ignore[arg-type]
        found |= getattr(self, "more", {})
        return {
            name: value
            for name, value in found.items()
            if isinstance(value, np.ndarray) and value.ndim == 1
        }

    def write_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes the columns, SI units."""
        columns = self.columns()
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(
                [f"{value:.9g}" for value in row] for row in zip(*columns.values(), strict=True)
            )


@dataclass(frozen=True)
class MotionHistory(History):
    """What a contact did in a motion that was followed step by step."""

    time: Array
    """Time, s."""
    displacement: Array
    """Displacement that was given, of the drive where there is a rig, m."""
    contact_displacement: Array
    """Displacement in the contact, without the stretch of the rig, m."""
    tangential_force: Array
    """Tangential force, N."""
    normal_force: Array
    """Normal force that the contact carries, N."""
    dissipated_energy: Array
    """Friction work since the contact was made, J."""
    wear_volume: Array
    """Worn volume since the contact was made, m³."""
    stick_radius: Array
    """Radius of the sticking part, m."""
    contact_radius: Array
    """Radius of the contact, m."""
    more: dict[str, Array] = field(default_factory=dict)
    """Outputs that were asked for in addition, by name."""

    def plot(self, axes: Any = None) -> Any:
        """Force against the displacement of the contact; returns the axes."""
        axes = new_axes(axes)
        axes.plot(self.contact_displacement * MICRO, self.tangential_force)
        axes.set(xlabel="contact displacement (µm)", ylabel="tangential force (N)")
        return axes

    def plot_history(self, axes: Any = None) -> Any:
        """Displacement, force and worn volume against time; returns the three axes."""
        axes = new_axes(axes, 3)
        axes[0].plot(self.time, self.contact_displacement * MICRO)
        axes[1].plot(self.time, self.tangential_force)
        axes[2].plot(self.time, self.wear_volume * CUBIC_MM)
        for each, label in zip(
            axes, ("contact displacement (µm)", "tangential force (N)", "worn volume (mm³)")
        ):
            each.set(xlabel="time (s)", ylabel=label)
        return axes


OUTPUTS = {
    "contact_displacement": "contact_displacement",
    "tangential_force": "tangential_force",
    "normal_force": "normal_reaction",
    "dissipated_energy": "dissipated_energy",
    "wear_volume": "wear_volume",
    "stick_radius": "stick_radius",
    "contact_radius": "contact_radius",
}
"""Arrays of a `MotionHistory` and the outputs they are read from.

Without `wear_depth`: reading it computes the depth along the whole profile, which takes ten times
as long as the step itself.
"""
