"""Friction and wear of a fretting contact, computed by FrettingContact.fmu.

    from fretting_contact import Contact, loop

    with Contact(radius="10 mm", normal_force=100.0) as contact:
        loop(contact, 1.5e-6).plot()

`Contact`: one contact. `loop`, `life`, `drive`: motions with results as arrays. `calibrate`:
parameters from measured loops. `sweep`: many contacts. `read_scan`, `fit_scan`: profiles from line
scans. SI units throughout.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .component import ContactError
from .contact import Contact, ContactWarning, SavedState
from .fmu_file import FmuNotFoundError, fmu_path
from .history import MotionHistory
from .motion import FrictionLoop, SignalError, drive, loop
from .quantities import ParameterError, QuantityError
from .wear_life import WearLife, life

if TYPE_CHECKING:
    from .calibration import Calibration, LoopError, MeasuredLoop, WornVolume, calibrate
    from .parameter_sets import ParameterSets, SetsError, grid, read_sets, spread
    from .parameter_sweep import SweepResult, sweep
    from .profile import ProfileFit, Scan, ScanError, fit_scan, read_scan, write_table
    from .sweep_folder import SweepFolderError
    from .text_table import TextTableError
    from .worker_pool import WorkersLostError

__version__ = "0.1.0"

_LATER = {
    "calibration": ("Calibration", "LoopError", "MeasuredLoop", "WornVolume", "calibrate"),
    "parameter_sets": ("ParameterSets", "SetsError", "grid", "read_sets", "spread"),
    "parameter_sweep": ("SweepResult", "sweep"),
    "profile": ("ProfileFit", "Scan", "ScanError", "fit_scan", "read_scan", "write_table"),
    "sweep_folder": ("SweepFolderError",),
    "text_table": ("TextTableError",),
    "worker_pool": ("WorkersLostError",),
}
"""Names by module, imported when they are used: scipy takes longer to load than a loop to run."""

__all__ = [
    "Calibration",
    "Contact",
    "ContactError",
    "ContactWarning",
    "FmuNotFoundError",
    "FrictionLoop",
    "LoopError",
    "MeasuredLoop",
    "MotionHistory",
    "ParameterError",
    "ParameterSets",
    "ProfileFit",
    "QuantityError",
    "SavedState",
    "Scan",
    "ScanError",
    "SetsError",
    "SignalError",
    "SweepFolderError",
    "SweepResult",
    "TextTableError",
    "WearLife",
    "WorkersLostError",
    "WornVolume",
    "calibrate",
    "drive",
    "fit_scan",
    "fmu_path",
    "grid",
    "life",
    "loop",
    "read_scan",
    "read_sets",
    "spread",
    "sweep",
    "write_table",
]


def __getattr__(name: str) -> Any:
    for module, names in _LATER.items():
        if name in names:
            try:
                return getattr(import_module(f".{module}", __name__), name)
            except ModuleNotFoundError as problem:
                if problem.name and problem.name.split(".")[0] == "scipy":
                    raise ImportError(
                        f"{name} needs scipy: pip install fretting-contact[calibrate]"
                    ) from problem
                raise
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
