"""Batches on a Dask cluster. A batch whose worker is lost goes to another one."""

from collections.abc import Iterator, Sequence
from typing import Any

from .sweep_task import Task, run_batch

RETRIES = 2
"""Repetitions of a batch that ends with an exception."""


def run_on_dask(
    content: bytes, parameters: dict[str, Any], batches: Sequence[list[dict[str, Any]]], task: Task, cluster: Any
) -> Iterator[tuple[int, list[dict[str, Any]]]]:
    """Yields number and results of each batch as they come in.

    `cluster`: address of a scheduler, or a `distributed.Client`. The workers need this package; the FMU
    is sent to them. How many workers may be lost under one batch is a setting of the scheduler,
    `distributed.scheduler.allowed-failures`.
    """
    try:
        from distributed import Client, as_completed
    except ImportError as problem:
        raise ImportError("cluster = ... needs Dask: pip install fretting-contact[sweep]") from problem
    client = cluster if isinstance(cluster, Client) else Client(cluster)
    try:
        sent = client.scatter(content, broadcast=True)
        tasks = {client.submit(run_batch, sent, parameters, rows, task, retries=RETRIES): k for k, rows in enumerate(batches)}
        for future in as_completed(list(tasks), loop=client.loop):  # not that of another client in this process
            number, result = tasks.pop(future), future.result()
            future.release()  # come in, it need not be run again if its worker is lost
            yield number, result
    finally:
        if client is not cluster:
            client.close()
