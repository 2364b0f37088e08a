"""Thousands of fretting contacts: a running-condition map of load and amplitude.

    python sweep.py --out target/sweep --sets 2000               # on the cores of this machine
    python sweep.py ... --cluster tcp://scheduler:8786           # on a Dask cluster
    python sweep.py ... --share 3 40                             # part 3 of 40, as slurm.sh does

Needs pyarrow (sweep-requirements.txt). Started again after it was stopped, the sweep continues with
what is missing.
"""

import argparse
from pathlib import Path

from fretting_contact import ParameterSets, spread, sweep

CYCLES = 100_000
FULL_SLIP = 2.53755e-6
"""Amplitude at which the whole contact of the default steel ball begins to slip under 100 N, m."""


def sets(count: int) -> ParameterSets:
    """Loads from 10 to 300 N, amplitudes from 0.05 to 3 times that of full slip under 100 N; even
    logarithms.
    """
    amplitudes = (0.05 * FULL_SLIP, 3.0 * FULL_SLIP, "log")
    return spread(
        {"normal_force": (10.0, 300.0, "log"), "displacement_amplitude": amplitudes}, count
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fmu", type=Path, help="that of the package if not given")
    parser.add_argument("--out", type=Path, default=Path("target/sweep"))
    parser.add_argument("--sets", type=int, default=2000)
    parser.add_argument("--cycles", type=float, default=CYCLES)
    parser.add_argument(
        "--cluster", help="address of a Dask scheduler; this machine's cores if not given"
    )
    parser.add_argument(
        "--share",
        type=int,
        nargs=2,
        metavar=("NUMBER", "COUNT"),
        help="of a job array, number from 0",
    )
    options = parser.parse_args()
    where = {
        "fmu": options.fmu,
        "out": options.out,
        "cluster": options.cluster,
        "share": options.share,
    }
    result = sweep(
        {"friction_coefficient": 0.6}, over=sets(options.sets), cycles=options.cycles, **where
    )
    if options.share is None:
        from regimes import draw  # here, so that workers need not load matplotlib

        print(draw(result, options.out / "map.png"))
    else:
        print(f"{result.run} sets run")


if __name__ == "__main__":
    main()
