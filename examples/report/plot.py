"""Draws reports/error_against_time.{svg,png} from the CSV of the same name: one panel per problem."""

import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # draws to files; needs no display
matplotlib.rcParams["svg.hashsalt"] = "fretting"  # the same picture from the same numbers

import matplotlib.pyplot as plt

# Okabe–Ito: told apart with every common colour blindness
COLOURS = ["#0072B2", "#56B4E9", "#009E73", "#E69F00"]
OTHERS = {"published": ("#D55E00", "s"), "plain spring row": ("#CC79A7", "^"), "engine": ("#0072B2", "o")}


def read(path):
    """{problem: {series: [(error, seconds, least, most)]}}; the engine's series are its resolutions."""
    problems = defaultdict(lambda: defaultdict(list))
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            series = row["method"]
            if series == "engine" and row["settings"].startswith("resolution"):
                series = "engine, " + row["settings"].split(",")[0]
            point = [float(row[name]) for name in ("error", "seconds", "seconds_least", "seconds_most")]
            if point[0] > 0:  # refused points have no error
                problems[row["problem"]][series].append(point)
    return problems


def draw(axes, title, series):
    shade = iter(COLOURS)
    for name, points in series.items():
        colour, marker = OTHERS[name] if name in OTHERS else (next(shade, "#222222"), "o")
        error, median, least, most = zip(*points)
        spread = [[m - low for m, low in zip(median, least)], [high - m for m, high in zip(median, most)]]
        axes.errorbar(error, median, yerr=spread, marker=marker, ms=4, lw=1.2, color=colour, label=name)
    axes.set(xscale="log", yscale="log", xlabel="error", ylabel="time, s")
    axes.set_title(title, fontsize=9)
    axes.invert_xaxis()
    axes.grid(True, color="#dddddd", lw=0.6)
    axes.legend(fontsize=6.5, frameon=False)


def main(folder):
    problems = read(folder / "error_against_time.csv")
    rows = (len(problems) + 1) // 2
    figure, panels = plt.subplots(rows, 2, figsize=(10, 3.4 * rows), constrained_layout=True, squeeze=False)
    for axes in panels.flat[len(problems) :]:
        axes.set_visible(False)
    for axes, (title, series) in zip(panels.flat, problems.items()):
        draw(axes, title, series)
    for ending in ("svg", "png"):
        metadata = {"Date": None} if ending == "svg" else None
        figure.savefig(folder / f"error_against_time.{ending}", dpi=110, metadata=metadata)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "reports"))
