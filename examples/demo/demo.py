"""The worked example: drives the FMU from Python and writes pictures, tables and a page.

python demo.py --fmu target/fmu/FrettingContact.fmu --out target/demo [--quick]
"""

import argparse
import sys
import time
from pathlib import Path

import ball
import lives
import overview
import page
import running_map
import shaken_mass
import worn_tip
from fretting_contact.component import FmuFile
from plotting import save_table

CASES = (ball, worn_tip, shaken_mass, lives, running_map)


def main(arguments=None):
    """Runs the cases; returns the exit code."""
    options = parse(arguments)
    if not options.fmu.is_file():
        print(
            f"demo: there is no FMU at {options.fmu}: build it with `cargo fmu build` first",
            file=sys.stderr,
        )
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    outcomes, files = [], []
    with FmuFile(options.fmu) as fmu:
        for number, case in enumerate(CASES, 1):
            title = case.__doc__.splitlines()[0].rstrip(".")
            print(f"[{number}/{len(CASES)}] {title}", flush=True)
            started = time.perf_counter()
            outcomes.append(case.run(fmu, options.out, options.quick))
            print(f"      done in {time.perf_counter() - started:.1f} s", flush=True)
    files += [path for outcome in outcomes for path in outcome.files]
    files.append(draw_overview(outcomes, options.out / "overview.png"))
    files.append(save_headlines(outcomes, options.out / "headlines.csv"))
    try:
        files.append(page.write(options.out))
        last = f"To look at and play with: {files[-1].resolve().as_uri()}"
    except page.NoLibrary as problem:
        last = (
            f"The page of pictures is left out: {problem}; see examples/demo/page-requirements.txt"
        )
    report(outcomes, files)
    print(f"\n{last}")
    return 0


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fmu", type=Path, required=True, help="path of FrettingContact.fmu")
    parser.add_argument("--out", type=Path, required=True, help="folder for pictures and CSV files")
    parser.add_argument("--quick", action="store_true", help="fewer steps and cycles: for tests")
    return parser.parse_args(arguments)


def draw_overview(outcomes, path):
    loops, tip, mass = (outcome.series for outcome in outcomes[:3])
    return overview.draw(loops["loops"], tip["lives"], mass["motion"], mass["envelope"], path)


def save_headlines(outcomes, path):
    headlines = [(outcome.title, line) for outcome in outcomes for line in outcome.headlines]
    return save_table(
        path,
        {
            "case": [title for title, _ in headlines],
            "quantity": [line.name for _, line in headlines],
            "value": [line.value for _, line in headlines],
            "unit": [line.unit for _, line in headlines],
            "expected": ["" if line.reference is None else line.reference for _, line in headlines],
            "relative_deviation": [
                "" if line.reference is None else line.deviation for _, line in headlines
            ],
        },
    )


def report(outcomes, files):
    for outcome in outcomes:
        print(f"\n{outcome.title}")
        for line in outcome.headlines:
            print(f"  {line}")
    print(f"\n{len(files)} files written to {files[0].parent}:")
    for path in files:
        print(f"  {path.name:<24} {path.stat().st_size / 1024:8.0f} kB")


if __name__ == "__main__":
    sys.exit(main())
