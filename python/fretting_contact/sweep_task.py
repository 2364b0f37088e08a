"""What a worker of a sweep does: one contact for each set of parameters."""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .component import ContactError
from .contact import Contact, ContactWarning
from .fmu_file import file_of_bytes
from .motion import SignalError, frequency_of
from .quantities import ParameterError

Task = Callable[[Contact], dict[str, Any]]
"""Moves a contact and returns numbers or texts by name. Workers import it: define it in a module.
"""

LIMIT_OF_STICK = 0.95
"""Share of the contact radius that sticks, above which a cycle counts as full stick."""


def regime(stick_radius: float, contact_radius: float) -> str:
    """Slip regime of a cycle: "gross", "partial", "stick" where more than 95 % of the radius
    sticks, or "separated".

    >>> regime(0.0, 1e-4), regime(5e-5, 1e-4), regime(9.9e-5, 1e-4), regime(0.0, 0.0)
    ('gross', 'partial', 'stick', 'separated')
    """
    if contact_radius == 0.0:
        return "separated"
    share = stick_radius / contact_radius
    return "gross" if share == 0.0 else "stick" if share > LIMIT_OF_STICK else "partial"


@dataclass(frozen=True)
class CyclicLife:
    """Many cycles of one amplitude: the contact in the first cycle and after all of them."""

    cycles: float
    """Number of cycles, above 0."""

    def __post_init__(self) -> None:
        if not 0 < self.cycles < math.inf:
            raise SignalError(f"cycles = {self.cycles:g}: give a finite number above 0")

    def __call__(self, contact: Contact) -> dict[str, Any]:
        contact.require(loading="cyclic")
        cycle, part = 1.0 / frequency_of(contact), min(self.cycles, 1.0)
        outputs = (
            "tangential_force",
            "dissipated_energy",
            "stick_radius",
            "contact_radius",
            "wear_volume",
            "wear_depth",
        )
        contact.step(part * cycle)
        force, work, stick, radius, *_ = contact.get(*outputs)
        first = {"regime": regime(stick, radius), "force_amplitude": force}
        first |= {"work_per_cycle": work / part}
        if self.cycles > 1:
            contact.step((self.cycles - 1) * cycle)
        force, work, stick, radius, volume, depth = contact.get(*outputs)
        last = {
            "regime_at_end": regime(stick, radius),
            "force_amplitude_at_end": force,
            "dissipated_energy": work,
        }
        last |= {
            "stick_radius": stick,
            "contact_radius": radius,
            "wear_volume": volume,
            "wear_depth": depth,
        }
        return first | last


def run_batch(
    content: bytes, parameters: dict[str, Any], rows: list[dict[str, Any]], task: Task
) -> list[dict[str, Any]]:
    """Results of some sets, in their order, by one instance of the FMU whose bytes are `content`.

    Each result has the values of the set, what the task returned, `warning`, and `error`: the
    component's message where it has refused the set. Both are empty texts where there is none.
    """
    results = []
    contact: Contact | None = None
    with warnings.catch_warnings(record=True) as noted:
        warnings.simplefilter("always", ContactWarning)
        for row in rows:
            noted.clear()
            outcome: dict[str, Any]
            try:
                values = {**parameters, **row}
                contact = (
                    contact.restart(**values)
                    if contact
                    else Contact(fmu=file_of_bytes(content), **values)
                )
                outcome = {**task(contact), "error": ""}
            except (ContactError, ParameterError, SignalError) as problem:
                outcome = {"error": str(problem)}
            results.append(
                {**row, **outcome, "warning": " / ".join(str(note.message) for note in noted)}
            )
        if contact is not None:
            contact.close()
    return results
