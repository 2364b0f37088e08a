"""Many contacts: sets of parameters on all cores of this machine or on a cluster."""

import os
import sys
import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .dask_cluster import run_on_dask
from .fmu_file import fmu_path
from .history import new_axes
from .parameter_sets import sets_of
from .quantities import ParameterError, near
from .sweep_folder import open_folder, parts, read_part, write_part
from .sweep_task import CyclicLife, Task
from .worker_pool import run_on_processes

ALL = "all.parquet"
"""File with all results, in the order of the sets; written when the last one is there."""

SECONDS_BETWEEN_LINES = 1.0
"""Between two lines of progress."""

MARKS = {"stick": "o", "partial": "s", "gross": "^"}


@dataclass(frozen=True)
class SweepResult:
    """Results of a sweep, in the order of the sets."""

    columns: dict[str, NDArray[Any]]
    """Values of the sets and results by name; `error` is the message of a refused set, else empty.
    """
    run: int
    """Sets that this call has run; the others were there from before."""
    missing: int
    """Sets that are not there yet: those of other shares."""

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.columns:
            raise ParameterError(
                f"{name} is no column of the results{near(str(name), self.columns)}; there are "
                f"{', '.join(self.columns) or 'none'}"
            )
        return self.columns[name]

    def to_pandas(self) -> Any:
        """The results as a pandas table."""
        try:
            import pandas
        except ImportError as problem:
            raise ImportError(
                "to_pandas needs pandas: pip install fretting-contact[sweep], or take the arrays "
                "as they are in columns"
            ) from problem
        return pandas.DataFrame(self.columns)

    @property
    def refused(self) -> dict[str, int]:
        """Messages of the sets that the component has refused, with how often each came."""
        return dict(Counter(str(text) for text in self.columns["error"] if text))

    def plot(self, x: str, y: str, color: str = "wear_volume", axes: Any = None) -> Any:
        """A map on logarithmic axes, coloured by the logarithm of a result; returns the axes."""
        values, *places = (self._numbers(name) for name in (color, x, y))
        axes = new_axes(axes)
        from matplotlib.colors import LogNorm

        positive = values[values > 0]
        shades = LogNorm(np.percentile(positive, 2), positive.max()) if len(positive) else None
        regimes = self.columns.get("regime", np.full(len(self), "partial"))
        dots = None
        for name, mark in MARKS.items():
            here = (regimes == name) & (values > 0)
            if here.any():
                dots = axes.scatter(
                    *(place[here] for place in places),
                    c=values[here],
                    marker=mark,
                    s=12,
                    norm=shades,
                    label=name,
                )
        axes.set(xscale="log", yscale="log", xlabel=x, ylabel=y)
        if dots is not None:
            axes.figure.colorbar(dots, ax=axes, label=color)
            axes.legend()
        return axes

    def _numbers(self, name: str) -> NDArray[np.float64]:
        """A column as numbers."""
        try:
            return self[name].astype(float)
        except ValueError:
            raise ParameterError(
                f"{name} has texts, such as {str(self[name][0])!r}: give a column of numbers"
            ) from None


def sweep(
    parameters: Mapping[str, Any] | None = None,
    over: Any = None,
    *,
    cycles: float = 1e5,
    task: Task | None = None,
    out: str | os.PathLike[str] | None = None,
    processes: int | None = None,
    cluster: Any = None,
    share: tuple[int, int] | None = None,
    batch: int = 20,
    progress: bool | Callable[[str], None] = True,
    fmu: str | os.PathLike[str] | None = None,
) -> SweepResult:
    """Runs a contact for each set of parameters.

    `parameters`: values that all sets have in common. `over`: the sets; a dictionary of arrays
    (their grid), `spread(...)`, a pandas table, or the path of a CSV file. Any parameter or input
    may be in either.

    `cycles`: each contact makes so many cycles of `displacement_amplitude`; results are its regime,
    force and work in the first cycle, and its wear after all of them. `task`: something else to do
    with each contact, a function of a `Contact` that returns a dictionary.

    `out`: folder for Parquet files, one for each batch, and `all.parquet` at the end. Called again
    with the same folder, the sweep continues with what is missing. `processes`: worker processes on
    this machine; its cores if not given. `cluster`: address of a Dask scheduler, or a client, in
    place of them. `share`: (number, count), the part of the batches that this call runs, number
    from 0: for job arrays that share the folder `out`. `batch`: sets in a batch. `progress`: a bar
    (tqdm) or lines, or a function that takes a line.

    A set that the component refuses has its message in the column `error`, warnings are in
    `warning`. A worker that dies costs time, no results. In a script call `sweep` under `if
    __name__ == "__main__":`, since workers import it.
    """
    sets = sets_of(over)
    action: Task = task if task is not None else CyclicLife(float(cycles))
    common = dict(parameters or {})
    if task is None:
        common = {"loading": "cyclic", **common}
    content = fmu_path(fmu).read_bytes()
    folder = None if out is None else Path(out)
    if share is not None and (folder is None or not 0 <= share[0] < share[1]):
        raise ValueError(
            f"share = {share}: give (number, count) with 0 <= number < count, and "
            "out, the folder of all shares"
        )
    every = parts(folder or Path(), len(sets), batch)
    results: dict[int, list[dict[str, Any]]] = {}
    if folder is not None:
        open_folder(folder, content, common, sets, action, batch)
        results = {part.number: read_part(part.path) for part in every if part.path.exists()}
    mine = every if share is None else every[share[0] :: share[1]]
    todo = [part for part in mine if part.number not in results]
    batches = [sets.rows(part.first, part.last) for part in todo]
    total = sum(len(rows) for rows in batches)
    if cluster is None:
        incoming = run_on_processes(
            content, common, batches, action, processes or os.cpu_count() or 1
        )
    else:
        incoming = run_on_dask(content, common, batches, action, cluster)
    report = _reporter(progress, total)
    done = 0
    for k, rows in incoming:
        part = todo[k]
        results[part.number] = rows
        if folder is not None:
            write_part(part.path, rows)
        done += len(rows)
        report(done)
    report(None)
    found = [row for part in every for row in results.get(part.number, [])]
    if folder is not None and len(found) == len(sets) and share is None:
        write_part(folder / ALL, found)
    return SweepResult(_columns(found), total, len(sets) - len(found))


def _columns(rows: list[dict[str, Any]]) -> dict[str, NDArray[Any]]:
    """Arrays of the results; what a refused set does not have is NaN, or an empty text."""
    columns = {}
    for name in dict.fromkeys(name for row in rows for name in row):
        values = [row.get(name) for row in rows]
        is_text = any(isinstance(value, str) for value in values)
        columns[name] = np.array(
            [("" if is_text else np.nan) if value is None else value for value in values]
        )
    return columns


def _reporter(progress: bool | Callable[[str], None], total: int) -> Callable[[int | None], None]:
    """A function that takes the number of sets that are done, and None at the end."""
    if progress is False or total == 0:
        return lambda done: None
    started, last = time.perf_counter(), [0.0]
    if progress is True and sys.stderr.isatty():
        try:
            from tqdm import tqdm
        except ImportError:
            pass
        else:
            bar = tqdm(total=total, unit="set")
            return lambda done: bar.close() if done is None else bar.update(done - bar.n) and None

    def line(done: int | None) -> None:
        now = time.perf_counter() - started
        if done is None or (
            progress is True and done < total and now - last[0] < SECONDS_BETWEEN_LINES
        ):
            return
        last[0] = now
        text = f"{done} of {total} sets, {done / now:.0f} a second"
        print(text, file=sys.stderr, flush=True) if progress is True else progress(text)

    return line
