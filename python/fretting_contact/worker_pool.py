"""Batches on processes of this machine. A batch whose process dies is run again."""

import multiprocessing
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from .sweep_task import Task, run_batch

MOST_LOSSES, MOST_LOSSES_AT_START = 10, 2
"""Times in a row that workers may die without a batch coming in: later, and before the first batch.
"""


class WorkersLostError(RuntimeError):
    """Workers die as often as they are started."""


def run_on_processes(
    content: bytes,
    parameters: dict[str, Any],
    batches: Sequence[list[dict[str, Any]]],
    task: Task,
    processes: int,
) -> Iterator[tuple[int, list[dict[str, Any]]]]:
    """Yields number and results of each batch as they come in."""
    missing, losses, limit = set(range(len(batches))), 0, MOST_LOSSES_AT_START
    context = multiprocessing.get_context(
        "spawn"
    )  # a copy of a process with a loaded FMU and threads is not safe
    while missing:
        count = min(processes, len(missing))
        with ProcessPoolExecutor(max_workers=count, mp_context=context) as pool:
            futures: dict[Future[list[dict[str, Any]]], int] = {}
            try:
                for k in sorted(missing):
                    futures[pool.submit(run_batch, content, parameters, batches[k], task)] = k
                for future in as_completed(futures):
                    result = future.result()
                    missing.discard(futures[future])
                    losses, limit = 0, MOST_LOSSES
                    yield futures[future], result
            except BrokenProcessPool as problem:
                # one death ends the pool; what has come in meanwhile is kept
                for future, k in futures.items():
                    if (
                        k in missing
                        and future.done()
                        and not future.cancelled()
                        and future.exception() is None
                    ):
                        missing.discard(k)
                        losses, limit = 0, MOST_LOSSES
                        yield k, future.result()
                losses += 1
                if losses > limit:
                    raise WorkersLostError(
                        f"workers ended {losses} times without a result: if this is a script, "
                        "call sweep() under "
                        '`if __name__ == "__main__":`; else look for too little memory'
                    ) from problem
