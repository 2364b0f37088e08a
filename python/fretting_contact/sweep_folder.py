"""The folder of a sweep: a Parquet file for each batch, and a description of the sweep."""

import hashlib
import io
import json
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .parameter_sets import ParameterSets

DESCRIPTION = "sweep.json"


class SweepFolderError(ValueError):
    """A folder that holds another sweep."""


@dataclass(frozen=True)
class Part:
    """One batch and its file."""

    number: int
    path: Path
    first: int
    last: int
    """Number of its first set, and of the first one of the next batch."""


def parts(folder: Path, count: int, batch: int) -> list[Part]:
    """The batches of `count` sets."""
    starts = range(0, count, batch)
    return [
        Part(number, folder / f"part-{number:05d}.parquet", first, min(first + batch, count))
        for number, first in enumerate(starts)
    ]


def open_folder(
    folder: Path,
    content: bytes,
    parameters: dict[str, Any],
    sets: ParameterSets,
    task: Any,
    batch: int,
) -> None:
    """Makes the folder, or checks that it holds results of the same sweep."""
    _parquet()  # nothing is written where no results can be
    described = {
        "fmu": hashlib.sha256(content).hexdigest(),
        "parameters": {name: repr(value) for name, value in sorted(parameters.items())},
        "sets": hashlib.sha256(json.dumps(sets.columns, default=repr).encode()).hexdigest(),
        "number of sets": len(sets),
        "task": repr(task)
        if not callable(task) or hasattr(task, "__dataclass_fields__")
        else task.__qualname__,
        "sets in a batch": batch,
    }
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / DESCRIPTION
    if path.exists():
        found = json.loads(path.read_text(encoding="utf-8"))
        differ = [name for name, value in described.items() if found.get(name) != value]
        if differ:
            raise SweepFolderError(
                f"{folder} holds another sweep, which differs in {', '.join(differ)}: "
                "give another folder, or delete this one"
            )
        return
    write_whole(path, json.dumps(described, indent=2).encode())


def write_whole(path: Path, content: bytes) -> None:
    """Whole or not at all, so that a stop leaves no half a file."""
    handle, half = tempfile.mkstemp(dir=path.parent, suffix=".half")
    with os.fdopen(handle, "wb") as file:
        file.write(content)
    os.replace(half, path)


def _parquet() -> Any:
    try:
        import pyarrow.parquet
    except ImportError as problem:
        raise ImportError(
            "out = ... writes Parquet: pip install fretting-contact[sweep]"
        ) from problem
    return pyarrow


def write_part(path: Path, rows: list[dict[str, Any]]) -> None:
    """Writes results as Parquet."""
    pyarrow = _parquet()
    columns = {
        name: [row.get(name) for row in rows]
        for name in dict.fromkeys(name for row in rows for name in row)
    }
    for name, values in columns.items():
        if (
            len({isinstance(value, str) for value in values if value is not None}) > 1
        ):  # "10 mm" and 0.02: a column has one type
            columns[name] = [None if value is None else str(value) for value in values]
    table = pyarrow.table(columns)
    buffer = io.BytesIO()
    pyarrow.parquet.write_table(table, buffer)
    write_whole(path, buffer.getvalue())


def read_part(path: Path) -> list[dict[str, Any]]:
    """Reads the results of a batch."""
    found: list[dict[str, Any]] = _parquet().parquet.read_table(path).to_pylist()
    return found
