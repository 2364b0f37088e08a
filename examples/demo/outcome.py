"""What a case of the demo returns: the files it wrote and its main results."""

from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Headline:
    """One number, with its expected value, if that is known."""

    name: str
    value: float
    unit: str
    reference: float | None = None

    @property
    def deviation(self):
        """Relative to the reference; None without one."""
        return None if self.reference is None else self.value / self.reference - 1

    def __str__(self):
        text = f"{self.name:<64} {self.value:>10.5g} {self.unit:<5}"
        if self.reference is None:
            return text.rstrip()
        return f"{text} expected {self.reference:>10.5g}  ({self.deviation:+.1e})"


@dataclass
class Outcome:
    """Result of one case; `series` holds what the overview picture draws again."""

    title: str
    files: list[Path] = field(default_factory=list)
    headlines: list[Headline] = field(default_factory=list)
    series: dict = field(default_factory=dict)
