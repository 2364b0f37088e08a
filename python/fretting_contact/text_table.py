"""Two columns of numbers in a text file, as the FMU reads `profile_file`.

A byte-order mark, `#` comments, one header line of words, and decimal commas (with `;` or tab
between the columns) are accepted. The same rules are in `src/profile/text.rs`.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray


class TextTableError(ValueError):
    """A file that does not hold two columns of numbers; the text quotes the line."""


def _fields(content: str) -> list[str]:
    """The fields of one line: `;` separates before tab, tab before blanks and commas."""
    for separator in ";", "\t":
        if separator in content:
            parts = [part.strip().rstrip(",") for part in content.split(separator)]
            # with these separators a comma is a decimal comma
            return [part.replace(",", ".", 1) for part in parts if part]
    return content.replace(",", " ").split()


def _number(field: str) -> float | None:
    try:
        return float(field.replace("_", "?"))  # Python alone reads 1_000
    except ValueError:
        return None


def parse_columns(text: str) -> NDArray[np.float64]:
    """The two columns of a text as an array of shape (points, 2), in the unit of the file."""
    rows: list[tuple[float, float]] = []
    header_allowed = True
    for index, line in enumerate(text.removeprefix("\ufeff").splitlines(), start=1):
        fields = _fields(line.split("#")[0].strip())
        if not fields:
            continue
        numbers = [_number(field) for field in fields]
        is_words = all(number is None for number in numbers)
        if is_words and header_allowed:
            header_allowed = False
            continue
        header_allowed = False
        place = f'line {index}, "{line.strip()[:60]}"'
        if is_words and not rows:
            raise TextTableError(
                f"{place}: a second line of words, but one header line is skipped: delete it, or "
                "write # before it"
            )
        if len(fields) != 2:
            raise TextTableError(
                f"{place}: {len(fields)} column(s), but two are needed; with decimal "
                "commas separate them by ; or tab"
            )
        if numbers[0] is None or numbers[1] is None:
            raise TextTableError(
                f"{place}: `{fields[numbers.index(None)]}` is not a number: correct the line, or "
                "write # before it"
            )
        if not np.isfinite([numbers[0], numbers[1]]).all():
            raise TextTableError(f"{place}: both numbers have to be finite; delete the line")
        rows.append((numbers[0], numbers[1]))
    return np.array(rows, dtype=float).reshape(-1, 2)


def read_columns(path: str | Path) -> NDArray[np.float64]:
    """The two columns of a file; a header in another encoding than UTF-8 does no harm."""
    content = Path(path).read_bytes()
    if b"\0" in content:
        raise TextTableError(f"{path}: it is UTF-16 or no text: save it as text in UTF-8")
    try:
        return parse_columns(content.decode("utf-8", errors="replace"))
    except TextTableError as problem:
        raise TextTableError(f"{path}, {problem}") from None
