"""The worn volume over the friction work, k/σ₀, from the volumes of wear tests."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from .contact import Contact
from .history import Array
from .quantities import ParameterError, in_si


@dataclass(frozen=True)
class WornVolume:
    """The volume that a wear test wore at constant load and amplitude of the drive.

    Quantities may be texts with a unit: `volume="0.0115 mm3"`.
    """

    volume: float
    """Worn volume, m³."""
    normal_force: float
    """Normal force, N."""
    amplitude: float
    """Amplitude of the displacement of the drive, m."""
    cycles: float
    """Number of cycles."""
    uncertainty: float | None = None
    """Standard deviation of the volume, m³; from the scatter of several volumes if not given."""

    def __post_init__(self) -> None:
        units = {"volume": "m3", "normal_force": "N", "amplitude": "m", "uncertainty": "m3"}
        for name, unit in units.items():
            value = getattr(self, name)
            if isinstance(value, str):
                object.__setattr__(self, name, in_si(value, unit, name))
        for name in "volume", "uncertainty":
            value = getattr(self, name)
            if value is not None and not 0 < value < np.inf:
                hint = "" if name == "volume" else ", or leave it out"
                raise ParameterError(f"{name} = {value!r} m3: give a finite number above 0{hint}")


def fit_volumes(
    contact: Contact,
    volumes: Sequence[WornVolume],
    fitted: Sequence[str],
    parameters: dict[str, Any],
    names: tuple[str, ...],
    values: Array,
    covariance: Array,
) -> tuple[tuple[str, ...], Array, Array]:
    """Adds the worn volume over friction work to the values of a fit to loops."""
    measured = np.log([volume.volume for volume in volumes])
    given = [
        np.nan if volume.uncertainty is None else volume.uncertainty / volume.volume
        for volume in volumes
    ]
    relative = np.array(given)
    if np.isnan(relative).any():
        if not np.isnan(relative).all():
            raise ParameterError(
                "uncertainty is given for some volumes only: give it for all or for none"
            )
        relative = np.ones(len(volumes))

    def outcome(volume: WornVolume, log: Array, per_work: float) -> tuple[float, float]:
        contact.restart(
            **parameters,
            **dict(zip(fitted, np.exp(log))),
            loading="cyclic",
            normal_force=volume.normal_force,
            displacement_amplitude=volume.amplitude,
            frequency=volume.cycles,
            wear_coefficient=per_work * parameters["hardness"],
        )
        contact.step(1.0)
        worn, work = contact.get("wear_volume", "dissipated_energy")
        if not work > 0:
            raise ParameterError(
                f"amplitude = {volume.amplitude:g} m at {volume.normal_force:g} N wears "
                "nothing in the model: "
                "check amplitude and load of the wear test"
            )
        return worn, work

    def logs(log: Array, log_k: float) -> Array:
        return np.log([outcome(volume, log, float(np.exp(log_k)))[0] for volume in volumes])

    log = np.log(values[: len(fitted)])
    work = [outcome(volume, log, 1e-18)[1] for volume in volumes]
    start = np.mean(measured - np.log(work))
    fit = least_squares(
        lambda x: (logs(log, x[0]) - measured) / relative, [start], diff_step=1e-4, x_scale=0.1
    )
    found = float(fit.x[0])
    slope = (logs(log, found + 1e-3) - logs(log, found - 1e-3)) / 2e-3
    others = [
        (logs(log + 1e-3 * unit, found) - logs(log - 1e-3 * unit, found)) / 2e-3
        for unit in np.eye(len(fitted))
    ]
    weighted = slope / relative
    inverse = weighted / (weighted @ weighted)
    scatter = 1.0
    if (
        volumes[0].uncertainty is None
    ):  # of one volume alone the scatter is not known, and 0 is taken
        scatter = float(2 * fit.cost / (len(volumes) - 1)) if len(volumes) > 1 else 0.0
    per_work = np.exp(found)
    row = np.zeros(len(values))  # change of k/σ₀ with the other values
    row[: len(fitted)] = [
        -per_work * float(inverse @ (other / relative)) for other in others
    ] / values[: len(fitted)]
    grown = np.zeros((len(values) + 1,) * 2)
    grown[:-1, :-1] = covariance
    grown[-1, :-1] = grown[:-1, -1] = row @ covariance
    grown[-1, -1] = row @ covariance @ row + per_work**2 * scatter * float(inverse @ inverse)
    return (*names, "wear_per_work"), np.append(values, per_work), grown
