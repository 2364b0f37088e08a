"""Errors of contacts on profiles from noisy scans: a table, a CSV file and a picture.

    cargo fmu build && target/venv/bin/python tests/python/profile_study.py reports

Each scan becomes a table by `fit_scan`; the FMU presses the table and the body without noise with
the same force, such that the body without noise has an indentation depth of 10, 30 or 100 times the
noise.
"""

import argparse
import csv
import io
import os
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from conftest import ROOT

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from fretting_contact.component import ContactFmu, FmuFile
from fretting_contact.profile import fit_scan, write_table
from fretting_contact.profile_picture import STYLE
from PIL import Image
from scans import BALL, ROUNDED_FLAT, SMALL_BALL, SMALL_FLAT, WORN_FLAT, at_depth, at_load

BODIES = [BALL, SMALL_BALL, WORN_FLAT, SMALL_FLAT, ROUNDED_FLAT]
NOISES = [5e-9, 20e-9, 50e-9]  # m
PITCHES = [1e-6, 5e-6]  # m
SEEDS = 30
DEPTHS = [10, 30, 100]  # indentation depth, in units of the noise
COLOURS = {5e-9: "#0072B2", 20e-9: "#E69F00", 50e-9: "#D55E00"}


def table_of(task):
    """The table that comes from one scan."""
    body, noise, pitch, seed, path = task
    write_table(fit_scan(BODIES[body].scan(noise, pitch, seed)), path)


def errors(fmu, folder):
    """Rows of body, noise, pitch, depth in units of noise, radius, and the relative errors of a and
    d of all seeds.
    """
    made = []

    def start(**values):
        made.append(ContactFmu(fmu))
        return made[-1].start(**values)

    tasks = [
        (body, noise, pitch, seed, folder / f"{body}_{noise}_{pitch}_{seed}.txt")
        for body in range(len(BODIES))
        for noise in NOISES
        for pitch in PITCHES
        for seed in range(SEEDS)
    ]
    with ProcessPoolExecutor() as pool:
        list(pool.map(table_of, tasks, chunksize=4))
    rows = []
    for index, body in enumerate(BODIES):
        for noise in NOISES:
            for multiple in DEPTHS:
                exact = at_depth(start, body.start_values(folder), multiple * noise)
                if exact.radius > 0.5 * body.half_width:
                    continue
                for pitch in PITCHES:
                    paths = [path for *task, _, path in tasks if task == [index, noise, pitch]]
                    found = [at_load(start, path, exact.load) for path in paths]
                    radius = np.array([contact.radius / exact.radius - 1 for contact in found])
                    depth = np.array([contact.depth / exact.depth - 1 for contact in found])
                    rows.append(
                        (body.name, noise, pitch, multiple, exact.radius, abs(radius), abs(depth))
                    )
                    for contact in made:
                        contact.__exit__()
                    made.clear()
    return rows


def write(rows, folder):
    with open(folder / "profile_scans.csv", "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(
            [
                *("body", "noise (m)", "pitch (m)", "seeds", "depth / noise", "contact radius (m)"),
                *("median error of a", "worst error of a", "median error of d", "worst error of d"),
                *("seeds with a beyond 1 %", "seeds with d beyond 2 %"),
            ]
        )
        for name, noise, pitch, multiple, a, radius, depth in rows:
            quantiles = [np.median(radius), radius.max(), np.median(depth), depth.max()]
            misses = [int(np.sum(radius > 0.01)), int(np.sum(depth > 0.02))]
            numbers = [f"{value:.3g}" for value in (noise, pitch)]
            out.writerow(
                [
                    name,
                    *numbers,
                    len(radius),
                    multiple,
                    f"{a:.4g}",
                    *(f"{q:.2e}" for q in quantiles),
                    *misses,
                ]
            )


def markdown(rows):
    """One line for each body, noise and pitch at the smallest depth, where errors are largest."""
    print(
        "| body | noise, nm | pitch, µm | a, µm | a: median, worst, % | d: "
        "median, worst, % | beyond 1 %, 2 % |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, noise, pitch, multiple, a, radius, depth in rows:
        if multiple == DEPTHS[0]:
            cells = [
                f"{100 * np.median(error):.2f}, {100 * error.max():.2f}"
                for error in (radius, depth)
            ]
            misses = f"{np.sum(radius > 0.01)}, {np.sum(depth > 0.02)}"
            numbers = f"{noise * 1e9:.0f} | {pitch * 1e6:.0f} | {a * 1e6:.1f}"
            print(f"| {name} | {numbers} | {cells[0]} | {cells[1]} | {misses} |")


def draw(rows, path):
    """Worst errors of all seeds against depth in units of the noise."""
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(
            2, len(BODIES), figsize=(2.3 * len(BODIES), 5.6), sharex=True, sharey="row"
        )
        for column, body in zip(axes.T, BODIES):
            for noise in NOISES:
                for pitch, style in zip(PITCHES, ("o-", "s--")):
                    part = [row for row in rows if row[:3] == (body.name, noise, pitch)]
                    label = f"{noise * 1e9:.0f} nm, {pitch * 1e6:.0f} µm"
                    for which, plot in zip((5, 6), column):
                        worst = [max(100 * row[which].max(), 1e-3) for row in part]
                        plot.loglog(
                            [row[3] for row in part],
                            worst,
                            style,
                            color=COLOURS[noise],
                            ms=4,
                            lw=1.2,
                            label=label,
                        )
            column[0].set_title(
                body.name.replace(", ", ",\n").replace(" of ", "\nof "), fontsize=10
            )
            column[1].set_xlabel("d / noise")
            for plot, limit in zip(column, (1.0, 2.0)):
                plot.axhline(limit, color="#222222", lw=1, label="wanted")
                plot.set_xticks(DEPTHS, [str(depth) for depth in DEPTHS])
                plot.minorticks_off()
        axes[0, 0].set_ylabel("worst error of a (%)")
        axes[1, 0].set_ylabel("worst error of d (%)")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=7)
        drawn = io.BytesIO()
        figure.savefig(drawn, format="png", dpi=110)
        plt.close(figure)
    # lines on a plain ground: 64 colours make a picture of a quarter of the size
    Image.open(drawn).convert("RGB").quantize(64).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, help="where CSV and picture go")
    folder = parser.parse_args().folder
    path = os.environ.get("FRETTING_FMU", ROOT / "target" / "fmu" / "FrettingContact.fmu")
    with FmuFile(path) as fmu, tempfile.TemporaryDirectory() as scratch:
        rows = errors(fmu, Path(scratch))
    write(rows, folder)
    draw(rows, folder / "profile_scans.png")
    markdown(rows)


if __name__ == "__main__":
    main()
