"""A sweep of 2,000 sets whose workers are killed on the way: are all results there?

    python tests/python/killed_worker_study.py [workers to kill] [dask]

Kills a worker process after each 200 sets; ends with the numbers of sets, of different sets and of
refused ones.
"""

import multiprocessing
import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from fretting_contact import spread, sweep

COUNT, CYCLES = 2000, 1e5
OVER = {"normal_force": (10.0, 300.0, "log"), "displacement_amplitude": (1.3e-7, 7.5e-6, "log")}


def run(kills: int, workers: Callable[[], list[int]], **where: Any) -> None:
    """Runs the sweep, kills one of `workers` after each 200 sets, and prints what came out."""
    killed: list[int] = []

    def kill(line: str) -> None:
        if len(killed) < kills and int(line.split()[0]) >= 200 * (len(killed) + 1):
            killed.append(workers()[0])
            os.kill(killed[-1], signal.SIGKILL)

    started = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        results = sweep({}, spread(OVER, COUNT), cycles=CYCLES, out=folder, progress=kill, **where)
    different = len(set(zip(results["normal_force"], results["displacement_amplitude"])))
    print(
        f"{len(killed)} workers killed; {len(results)} results of {different} "
        f"different sets, {len(results.refused)} refused"
    )
    print(
        f"least worn volume {results['wear_volume'].min():.3e} m3; "
        f"{time.perf_counter() - started:.1f} s"
    )


def main(kills: int, on_dask: bool) -> None:
    """On two processes, or on a Dask cluster of two."""
    if not on_dask:
        run(
            kills,
            lambda: [child.pid or 0 for child in multiprocessing.active_children()],
            processes=2,
        )
        return
    import dask
    from distributed import Client

    with dask.config.set({"distributed.scheduler.allowed-failures": 10}):
        with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
            run(
                kills,
                lambda: list(client.run(os.getpid).values()),
                cluster=client.scheduler.address,
            )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 4, "dask" in sys.argv)
