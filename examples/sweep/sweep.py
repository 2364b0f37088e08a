"""Thousands of fretting contacts on Dask: a running-condition map of load and amplitude.

    pip install -r sweep-requirements.txt
    python sweep.py --fmu target/fmu/FrettingContact.fmu --out target/sweep --sets 2000
    python sweep.py ... --cluster tcp://scheduler:8786     # on a cluster; without it, on the cores of this machine

Each batch of sets is written as a Parquet file when it comes in. A batch whose worker is lost goes to another one; started again after
it was stopped, the sweep goes on with what is missing.
"""

import argparse
import time
from pathlib import Path

import dask
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from contact import run_batch
from dask.distributed import Client, as_completed
from regimes import draw

LOADS = (10.0, 300.0)  # N
AMPLITUDES = (0.05, 3.0)  # of the displacement at which all slips under 100 N, 2.54 µm
CYCLES = 100_000
BATCH = 20
LOSSES = 10  # workers that may be lost under one batch


def sets(count, seed=1):
    """Load and amplitude of each set, spread evenly over their logarithms (a Kronecker sequence)."""
    steps = np.array([0.7548776662466927, 0.5698402909980532])  # powers of the plastic number's inverse
    places = (0.5 + seed * steps + np.arange(count)[:, None] * steps) % 1.0
    low, high = np.log([LOADS[0], AMPLITUDES[0]]), np.log([LOADS[1], AMPLITUDES[1]])
    loads, amplitudes = np.exp(low + (high - low) * places).T
    return loads, amplitudes * 2.53755e-6


def parts(out, count):
    """File and first and last set of each batch."""
    return [(out / f"part-{k // BATCH:05d}.parquet", k, min(k + BATCH, count)) for k in range(0, count, BATCH)]


def write(path, rows):
    """Whole or not at all, so that a stop leaves no half a file."""
    half = path.with_suffix(".half")
    pq.write_table(pa.Table.from_pylist(rows), half)
    half.rename(path)


def sweep(client, fmu, out, count, cycles=CYCLES, progress=print):
    """Runs what is missing; returns all results as one table and how many sets were run."""
    out.mkdir(parents=True, exist_ok=True)
    loads, amplitudes = sets(count)
    missing = {path: (a, b) for path, a, b in parts(out, count) if not path.exists()}
    content = client.scatter(fmu.read_bytes(), broadcast=True)
    tasks = {
        client.submit(run_batch, content, loads[a:b].tolist(), amplitudes[a:b].tolist(), cycles, retries=2): (path, b - a)
        for path, (a, b) in missing.items()
    }
    started, done, total = time.perf_counter(), 0, sum(b - a for a, b in missing.values())
    for task in as_completed(list(tasks)):
        path, size = tasks.pop(task)
        write(path, task.result())
        task.release()  # written, it need not be run again if its worker is lost
        done += size
        progress(f"{done} of {total} sets, {done / (time.perf_counter() - started):.0f} a second")
    return pa.concat_tables(pq.read_table(path) for path, *_ in parts(out, count)), total


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fmu", type=Path, default=Path("target/fmu/FrettingContact.fmu"))
    parser.add_argument("--out", type=Path, default=Path("target/sweep"))
    parser.add_argument("--sets", type=int, default=2000)
    parser.add_argument("--cycles", type=float, default=CYCLES)
    parser.add_argument("--cluster", help="address of a Dask scheduler; this machine's cores if not given")
    options = parser.parse_args()
    dask.config.set({"distributed.scheduler.allowed-failures": LOSSES})
    where = {"address": options.cluster} if options.cluster else {"threads_per_worker": 1, "dashboard_address": None}
    with Client(**where) as client:
        client.upload_file(str(Path(__file__).with_name("contact.py")))
        table, _ = sweep(client, options.fmu, options.out, options.sets, options.cycles, lambda line: print(line, flush=True))
    print(draw(table.to_pydict(), options.out / "map.png"))


if __name__ == "__main__":
    main()
