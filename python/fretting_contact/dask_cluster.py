"""Batches on a Dask cluster. A batch whose worker is lost goes to another one."""

from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError
from typing import Any

from .sweep_task import Task, run_batch

RETRIES = 2
"""Repetitions of a batch that ends with an exception."""

MOST_LOSSES = 100
"""Results that may be lost with their worker before they are fetched."""


def run_on_dask(
    content: bytes,
    parameters: dict[str, Any],
    batches: Sequence[list[dict[str, Any]]],
    task: Task,
    cluster: Any,
) -> Iterator[tuple[int, list[dict[str, Any]]]]:
    """Yields number and results of each batch as they come in.

    `cluster`: address of a scheduler, or a `distributed.Client`. The workers need this package; the
    FMU is sent to them. How many workers may be lost under one batch is a setting of the scheduler,
    `distributed.scheduler.allowed-failures`.
    """
    try:
        from distributed import Client, as_completed
    except ImportError as problem:
        raise ImportError(
            "cluster = ... needs Dask: pip install fretting-contact[sweep]"
        ) from problem
    client = cluster if isinstance(cluster, Client) else Client(cluster)
    try:
        # as the result of a task, and not scattered: that would be lost with the workers that hold
        # it
        sent = client.submit(bytes, content)
        losses = 0

        def submit(k: int) -> Any:
            return client.submit(
                run_batch, sent, parameters, batches[k], task, retries=RETRIES, pure=False
            )

        tasks = {submit(k): k for k in range(len(batches))}
        queue = as_completed(
            list(tasks), loop=client.loop
        )  # not that of another client in this process
        for future in queue:
            number = tasks.pop(future)
            try:
                result = future.result()
            except CancelledError:  # the worker was lost between the end of the batch and this call
                losses += 1
                if losses > MOST_LOSSES:
                    raise
                again = submit(number)
                tasks[again] = number
                queue.add(again)
                continue
            future.release()  # come in, it need not be run again if its worker is lost
            yield number, result
    finally:
        if client is not cluster:
            client.close()
