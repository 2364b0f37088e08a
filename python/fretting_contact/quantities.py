"""Values with units as text, such as "10 mm" or "210 GPa", in SI units."""

import difflib
import re
from collections.abc import Iterable

UNITS: dict[str, dict[str, float]] = {
    "m": {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9},
    "N": {"N": 1.0, "mN": 1e-3, "kN": 1e3},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm2": 1e6},
    "N/m": {"N/m": 1.0, "N/mm": 1e3, "kN/mm": 1e6, "N/um": 1e6, "N/µm": 1e6, "N/μm": 1e6},
    "rad": {"rad": 1.0, "mrad": 1e-3, "deg": 0.017453292519943295},
    "Hz": {"Hz": 1.0, "kHz": 1e3},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6, "min": 60.0, "h": 3600.0},
    "J": {"J": 1.0, "mJ": 1e-3, "uJ": 1e-6, "µJ": 1e-6, "μJ": 1e-6},
    "m3": {"m3": 1.0, "mm3": 1e-9, "um3": 1e-18, "µm3": 1e-18, "μm3": 1e-18},
    "1": {"": 1.0, "1": 1.0, "%": 1e-2},
}
"""Factors of the units that may be written, by the SI unit of the quantity."""

_PATTERN = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*")


class ParameterError(ValueError):
    """A name or a value that the component does not have; the text says what it has."""


class QuantityError(ParameterError):
    """A value that is no number with a unit of the right kind."""


def in_si(text: str, unit: str | None, name: str = "value") -> float:
    """The number that a text with a unit stands for, in `unit`, an SI unit.

    >>> in_si("10 mm", "m")
    0.01
    >>> in_si("210 GPa", "Pa")
    210000000000.0
    >>> in_si("5 N", "m", "radius")
    Traceback (most recent call last):
    fretting_contact.quantities.QuantityError: radius = '5 N': the unit has to be one of m, mm, um, nm; SI is m
    """  # noqa: E501
    match = _PATTERN.fullmatch(text)
    known = UNITS.get(unit or "", {})
    if match is None or not known:
        example = f'a number in {unit} or a text such as "1 {unit}"' if known else "a number"
        raise QuantityError(f"{name} = {text!r}: give {example}")
    if match[2] not in known:
        names = ", ".join(each for each in known if each.isascii() and each)
        raise QuantityError(f"{name} = {text!r}: the unit has to be one of {names}; SI is {unit}")
    # a quotient of two numbers without rounding of their own: "10 mm" is 0.01 to the last bit
    factor = known[match[2]]
    return (
        float(match[1]) / round(1 / factor)
        if factor < 1e-2 and unit != "rad"
        else float(match[1]) * factor
    )


def near(name: str, names: Iterable[str]) -> str:
    """The names that are like a misspelt one, as a part of a message.

    >>> near("raduis", ["radius", "hardness"])
    ' (did you mean radius?)'
    """
    found = difflib.get_close_matches(name, list(names), n=3)
    return f" (did you mean {' or '.join(found)}?)" if found else ""
