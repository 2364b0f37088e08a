"""Friction, rig stiffness and wear coefficient from measured friction loops and worn volumes.

How: each loop is reduced to a smooth drive, a Fourier series fitted to the measured displacement.
The contact behind the rig follows that drive; friction coefficient, rig stiffness and one force
offset for each loop are fitted to the measured forces (scipy.optimize.least_squares). The worn
volume over the friction work, k/σ₀, is fitted afterwards to the volumes, with friction and rig
held. The covariance has the noise of the force, the noise of the displacement, carried over by the
derivatives of the force with respect to the coefficients of the drive, and the scatter of the
volumes.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from .contact import Contact
from .history import MICRO, Array, new_axes
from .measured_loop import Drive, LoopError, MeasuredLoop, smooth_drive
from .quantities import ParameterError
from .worn_volume import WornVolume, fit_volumes

__all__ = ["Calibration", "LoopError", "MeasuredLoop", "WornVolume", "calibrate"]

FITTED = ("friction_coefficient", "rig_stiffness")
LOG_STEP = 1e-4
"""Step of a logarithm in a difference quotient."""
MOST_DEVIATION = 0.25
"""Largest standard deviation of a logarithm: beyond it errors are no longer normal."""
CYCLES_BEFORE = 1
"""Cycles that the contact makes before the one that is compared: the first begins at rest."""


@dataclass(frozen=True)
class Calibration:
    """Fitted values with their covariance."""

    names: tuple[str, ...]
    """Names of the values: friction_coefficient (1), rig_stiffness (N/m), wear_per_work (m³/J),
    which is wear_coefficient/hardness, and for each loop force_offset[i] (N) and
    displacement_offset[i] (m).
    """
    values: Array
    """The values in SI units."""
    covariance: Array
    """Their covariance."""
    force_noise: float
    """Standard deviation of the measured forces about the fit, N."""
    loops: tuple[MeasuredLoop, ...]
    """The measured loops."""
    drives: tuple[Array, ...]
    """Smooth displacement at the points of each loop, m."""
    forces: tuple[Array, ...]
    """Fitted force at these points, N."""
    hardness: float
    """Hardness that `parameters` refers the wear coefficient to, Pa."""

    def __getitem__(self, name: str) -> float:
        return float(self.values[self._index(name)])

    def std(self, name: str) -> float:
        """Standard deviation of a value."""
        return float(np.sqrt(self.covariance[self._index(name), self._index(name)]))

    def _index(self, name: str) -> int:
        if name not in self.names:
            raise KeyError(f"{name} was not fitted; there are {', '.join(self.names)}")
        return self.names.index(name)

    def parameters(self) -> dict[str, float]:
        """The fitted values as parameters of a `Contact`."""
        found = {name: self[name] for name in FITTED if name in self.names}
        if "wear_per_work" in self.names:
            found |= {
                "wear_coefficient": self["wear_per_work"] * self.hardness,
                "hardness": self.hardness,
            }
        return found

    def __str__(self) -> str:
        units = {"friction_coefficient": "", "rig_stiffness": " N/m", "wear_per_work": " m3/J"}
        units |= {
            name: " N" if name.startswith("force") else " m"
            for name in self.names
            if name.endswith("]")
        }
        lines = [
            f"{name:<23} {self[name]:11.4e} +- {self.std(name):.1e}{units[name]}"
            for name in self.names
        ]
        return "\n".join([*lines, f"{'noise of the force':<23} {self.force_noise:11.4e} N"])

    def plot(self, axes: Any = None) -> Any:
        """Measured and fitted loops in one picture; returns the axes."""
        axes = new_axes(axes)
        for k, (loop, drive, force) in enumerate(
            zip(self.loops, self.drives, self.forces), start=1
        ):
            colour = f"C{(k - 1) % 10}"
            label = f"{loop.normal_force:g} N"
            axes.plot(
                loop.displacement * MICRO,
                loop.force,
                ".",
                color=colour,
                ms=3,
                alpha=0.5,
                label=f"measured, {label}",
            )
            around = np.r_[np.arange(len(drive)), 0] if loop.is_one_cycle else np.arange(len(drive))
            axes.plot(drive[around] * MICRO, force[around], color=colour, label=f"fitted, {label}")
        axes.set(xlabel="displacement of the drive (µm)", ylabel="tangential force (N)")
        axes.legend()
        return axes


def calibrate(
    loops: MeasuredLoop | Sequence[MeasuredLoop],
    volumes: WornVolume | Sequence[WornVolume] = (),
    *,
    hardness: float = 8e9,
    fmu: str | os.PathLike[str] | None = None,
    **parameters: Any,
) -> Calibration:
    """Fits friction coefficient, rig stiffness and offsets to loops, and k/σ₀ to worn volumes.

    `loops`: one or several loops of the same pair, at any loads and amplitudes; one at least should
    reach gross slip: in partial slip the friction coefficient hardly acts on the loop, and its
    errors are larger than normal ones. `volumes`: of wear tests with the same pair and rig.
    `parameters`: of the contact, as for `Contact`. A `rig_stiffness` or a `friction_coefficient`
    among them is held and not fitted. `hardness`: Pa; only the ratio to the wear coefficient
    counts. `fmu`: path of the FMU; that of the package if not given. Noise is taken as independent
    from sample to sample.
    """
    loops = (loops,) if isinstance(loops, MeasuredLoop) else tuple(loops)
    volumes = (volumes,) if isinstance(volumes, WornVolume) else tuple(volumes)
    if not loops:
        raise ParameterError("loops is empty: one measured loop at least is needed")
    for name in "loading", "normal_force", "wear_coefficient":
        if name in parameters:
            raise ParameterError(
                f"{name} is not a parameter of calibrate: loads are those of the loops and volumes"
            )
    fitted = tuple(name for name in FITTED if name not in parameters)
    with Contact(fmu=fmu) as contact:
        model = _LoopModel(loops, fitted, parameters, contact)
        names, values, covariance, noise = _fit_loops(model)
        log = np.log(values[: len(fitted)])
        forces = model.forces(log)
        offsets = values[len(fitted) : len(fitted) + len(loops)]
        if volumes:
            held = {**parameters, "hardness": hardness}
            names, values, covariance = fit_volumes(
                contact, volumes, fitted, held, names, values, covariance
            )
    return Calibration(
        names=names,
        values=values,
        covariance=covariance,
        force_noise=noise,
        loops=loops,
        drives=tuple(drive.displacement for drive in model.drives),
        forces=tuple(force + offset for force, offset in zip(forces, offsets)),
        hardness=hardness,
    )


class _LoopModel:
    """Forces along the smooth drives for given friction and rig."""

    def __init__(
        self,
        loops: Sequence[MeasuredLoop],
        fitted: Sequence[str],
        parameters: dict[str, Any],
        contact: Contact,
    ):
        self.loops, self.fitted, self.contact = loops, fitted, contact
        self.drives = [smooth_drive(loop) for loop in loops]
        self.parameters = {**parameters, "loading": "transient", "wear_coefficient": 0.0}

    def start_values(self) -> Array:
        """Friction by the height of the loops, rig by their height over their elastic width."""
        friction, rig = [], []
        for loop, drive in zip(self.loops, self.drives):
            u, force = (
                drive.displacement - drive.mean,
                loop.force - (loop.force.max() + loop.force.min()) / 2,
            )
            height = float(np.ptp(force) / 2)
            work = abs(float(np.trapezoid(np.r_[force, force[0]], np.r_[u, u[0]]))) / loop.cycles
            elastic = max(float(np.ptp(u) / 2) - work / (4 * height), 0.02 * float(np.ptp(u)))
            friction.append(height / loop.normal_force)
            rig.append(2 * height / elastic)
        found = {"friction_coefficient": max(friction), "rig_stiffness": float(np.median(rig))}
        return np.log([found[name] for name in self.fitted])

    def force(self, k: int, log: Array, displacement: Array) -> Array:
        """Force at the points of loop `k` along a displacement about its mean."""
        values = dict(zip(self.fitted, np.exp(log)))
        self.contact.restart(**self.parameters, **values, normal_force=self.loops[k].normal_force)
        lead = displacement[: self.loops[k].points_per_cycle]
        path = np.concatenate([*([lead] * CYCLES_BEFORE), displacement])
        return self.contact.follow(["tangential_force"], tangential_displacement=path)[
            "tangential_force"
        ][-len(displacement) :]

    def forces(self, log: Array) -> list[Array]:
        """Forces at the points of all loops."""
        return [
            self.force(k, log, drive.displacement - drive.mean)
            for k, drive in enumerate(self.drives)
        ]


def _fit_loops(model: _LoopModel) -> tuple[tuple[str, ...], Array, Array, float]:
    """Names, values and covariance of friction, rig and offsets, and the noise of the force."""
    loops, count = model.loops, len(model.fitted)
    measured = np.concatenate([loop.force for loop in loops])
    which = np.repeat(np.arange(len(loops)), [len(loop.force) for loop in loops])
    offset_columns = (which[:, None] == np.arange(len(loops))).astype(float)

    def residual(x: Array) -> Array:
        return np.concatenate(model.forces(x[:count])) + offset_columns @ x[count:] - measured

    def jacobian(x: Array) -> Array:
        columns = []
        for k in range(count):
            ends = [
                np.concatenate(model.forces(x[:count] + sign * LOG_STEP * np.eye(count)[k]))
                for sign in (1, -1)
            ]
            columns.append((ends[0] - ends[1]) / (2 * LOG_STEP))
        return np.column_stack([*columns, offset_columns])

    offsets = [float(loop.force.max() + loop.force.min()) / 2 for loop in loops]
    start = np.concatenate([model.start_values(), offsets])
    fit = least_squares(residual, start, jac=jacobian, x_scale="jac", xtol=1e-10, ftol=1e-12)
    freedom = len(measured) - len(start)
    slopes = jacobian(fit.x)
    inverse = np.linalg.pinv(slopes, rcond=1e-12)  # of (JᵀJ)⁻¹Jᵀ
    noise = float(np.sqrt(2 * fit.cost / max(freedom, 1)))
    size = len(start)
    whole = np.zeros((size + len(loops), size + len(loops)))
    whole[:size, :size] = noise**2 * (inverse @ inverse.T)
    for k, drive in enumerate(model.drives):
        # an error of the drive moves the fit by −(JᵀJ)⁻¹Jᵀ ∂T/∂c; its mean is the displacement
        # offset
        rows = np.flatnonzero(which == k)
        carried = np.zeros((size + len(loops), len(drive.coefficients)))
        carried[:size] = -inverse[:, rows] @ _drive_slopes(model, k, fit.x[:count], drive)
        carried[size + k, 0] = 1.0
        whole += carried @ drive.covariance @ carried.T
    for k, name in enumerate(model.fitted):
        if not whole[k, k] < MOST_DEVIATION**2:
            raise LoopError(
                f"the loops do not determine {name}: its standard deviation is "
                f"{100 * np.sqrt(whole[k, k]):.0f} % of "
                f"{np.exp(fit.x[k]):.2e}; add a loop of larger amplitude, or give {name} "
                "as a parameter"
            )
    scale = np.ones(len(whole))
    scale[:count] = np.exp(fit.x[:count])  # from logarithms to values
    covariance = whole * np.outer(scale, scale)
    indices = [f"[{k}]" for k in range(1, len(loops) + 1)]
    names = (
        *model.fitted,
        *(f"force_offset{k}" for k in indices),
        *(f"displacement_offset{k}" for k in indices),
    )
    values = np.concatenate(
        [np.exp(fit.x[:count]), fit.x[count:], [drive.mean for drive in model.drives]]
    )
    return names, values, covariance, noise


def _drive_slopes(model: _LoopModel, k: int, log: Array, drive: Drive) -> Array:
    """Derivatives of the force of loop `k` with respect to the coefficients of its drive, N/m."""
    slopes = np.zeros((len(drive.displacement), len(drive.coefficients)))
    if drive.noise == 0:
        return slopes
    about = drive.displacement - drive.mean
    step = max(1e-4 * float(np.ptp(about)), float(np.sqrt(drive.covariance[1, 1])))
    for j in range(
        1, len(drive.coefficients)
    ):  # a shift of all points has no influence on a closed cycle
        ends = [model.force(k, log, about + sign * step * drive.basis[:, j]) for sign in (1, -1)]
        slopes[:, j] = (ends[0] - ends[1]) / (2 * step)
    return slopes
