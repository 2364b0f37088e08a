"""Draws the pictures of the reports from their CSV files: error_against_time, stability, coupling.

    python plot.py [reports]

A picture has a checksum of its data and of this file. It is drawn again when one of them changes.
"""

import csv
import hashlib
import io
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # draws to files; needs no display

import matplotlib.pyplot as plt  # noqa: E402, the backend is chosen first
from PIL import Image  # noqa: E402
from PIL.PngImagePlugin import PngInfo  # noqa: E402

#: Text in a picture's file: the checksum of what it was drawn from.
CHECKSUM = "SHA-256 of data and script"
SHADES = 64  # colours of a picture: lines on a plain ground need no more

# Okabe–Ito: distinct with every common colour blindness
COLOURS = ["#0072B2", "#56B4E9", "#009E73", "#E69F00"]
OTHERS = {
    "published": ("#D55E00", "s"),
    "plain spring row": ("#CC79A7", "^"),
    "boundary elements": ("#000000", "D"),
    "engine": ("#0072B2", "o"),
}
OUTCOMES = {"passed": ("#0072B2", "o"), "refused": ("#E69F00", "D"), "failed": ("#D55E00", "X")}
FLOOR, CEILING = 1e-12, 1e3  # of the shares that the stability picture shows


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def checksum(data):
    """Of a CSV file and of this script."""
    return hashlib.sha256(data.read_bytes() + Path(__file__).read_bytes()).hexdigest()


def is_current(data):
    """Whether the picture of a CSV file was drawn from what is there now."""
    picture = data.with_suffix(".png")
    if not picture.is_file():
        return False
    with Image.open(picture) as image:
        return image.info.get(CHECKSUM) == checksum(data)


def save(figure, data):
    """Writes and closes the picture of a CSV file."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=110)
    plt.close(figure)
    about = PngInfo()
    about.add_text(CHECKSUM, checksum(data))
    small = Image.open(drawn).convert("RGB").quantize(SHADES)
    small.save(data.with_suffix(".png"), optimize=True, pnginfo=about)


def series_of(row):
    """The engine's points form a line per resolution where a tolerance goes with it, else one line;
    tables one per settings.
    """
    parts = row["settings"].split(", ")
    if parts[-1].endswith("a period"):  # a line per master
        return "engine, " + parts[0]
    if row["method"] != "engine" or not any(part.startswith("tolerance") for part in parts):
        return row["method"]
    return "engine, " + ", ".join(parts[1:] if len(parts) > 2 else parts[:1])


def read_points(path):
    """{problem: {series: [(error, seconds, least, most)]}}, {problem: error of the reference}."""
    problems, references = defaultdict(lambda: defaultdict(list)), {}
    for row in rows(path):
        references[row["problem"]] = float(row["reference_error"])
        point = [float(row[name]) for name in ("error", "seconds", "seconds_least", "seconds_most")]
        if point[0] > 0:  # refused points have no error
            problems[row["problem"]][series_of(row)].append(point)
    return problems, references


def draw_points(axes, title, series, reference):
    if reference > 0:
        axes.axvline(
            reference, color="#888888", lw=1, ls=":", label="error of the reference itself"
        )
    shade = iter(COLOURS)
    for name, points in series.items():
        colour, marker = OTHERS[name] if name in OTHERS else (next(shade, "#222222"), "o")
        error, median, least, most = zip(*points)
        spread = [
            [m - low for m, low in zip(median, least)],
            [high - m for m, high in zip(median, most)],
        ]
        axes.errorbar(
            error, median, yerr=spread, marker=marker, ms=4, lw=1.2, color=colour, label=name
        )
    axes.set(xscale="log", yscale="log", xlabel="error", ylabel="time, s")
    axes.set_title(title, fontsize=9)
    axes.invert_xaxis()
    axes.grid(True, color="#dddddd", lw=0.6)
    # room for the legend
    axes.margins(y=0.25)
    axes.legend(fontsize=6.5, frameon=False)


def error_against_time(data):
    problems, references = read_points(data)
    lines = (len(problems) + 1) // 2
    figure, panels = plt.subplots(
        lines, 2, figsize=(10, 3.4 * lines), constrained_layout=True, squeeze=False
    )
    for axes in panels.flat[len(problems) :]:
        axes.set_visible(False)
    for axes, (title, series) in zip(panels.flat, problems.items()):
        draw_points(axes, title, series, references[title])
    figure.suptitle(
        "Steel on steel, μ = 0.6; ball and parabola: R = 10 mm; c/a0: stick "
        "radius over contact radius at the start",
        fontsize=10,
    )
    save(figure, data)


def stability(data):
    """Each scene at what came nearest to its bound, over that bound; scenes of one kind side by
    side.
    """
    scenes = list(rows(data))
    figure, axes = plt.subplots(figsize=(12, 5.2), constrained_layout=True)
    axes.axhspan(1, CEILING, color="#D55E00", alpha=0.08, lw=0)
    axes.axhline(1, color="#D55E00", lw=1, label="bound; above it a scene fails")
    for outcome, (colour, marker) in OUTCOMES.items():
        points = [
            (i, float(scene["share"]))
            for i, scene in enumerate(scenes)
            if scene["outcome"] == outcome
        ]
        if points:
            x, share = zip(*points)
            # what was refused before anything could be judged has broken nothing; what was not done
            # in time has
            unseen = FLOOR if outcome == "refused" else CEILING
            y = [min(max(s, FLOOR), CEILING) if s == s else unseen for s in share]
            axes.plot(
                x,
                y,
                marker,
                color=colour,
                ms=4.5,
                ls="",
                clip_on=False,
                label=f"{outcome}: {len(points)}",
            )
    starts = [
        i for i, scene in enumerate(scenes) if i == 0 or scene["scene"] != scenes[i - 1]["scene"]
    ]
    for left, right in zip(starts, [*starts[1:], len(scenes)]):
        axes.axvline(left - 0.5, color="#dddddd", lw=0.6, zorder=0)
        axes.text(
            (left + right - 1) / 2,
            FLOOR * 0.25,
            scenes[left]["scene"],
            rotation=60,
            ha="right",
            va="top",
            fontsize=7,
        )
    axes.set(yscale="log", ylim=(FLOOR * 0.4, CEILING), xlim=(-0.5, len(scenes) - 0.5), xticks=[])
    axes.set_ylabel("worst invariant / its bound")
    axes.set_title(
        "Each scene at its worst invariant; lowest row: nothing seen; top: far "
        "beyond, or not done in time",
        fontsize=9,
    )
    axes.grid(True, axis="y", color="#eeeeee", lw=0.6)
    axes.legend(fontsize=8, loc="upper right", ncols=3)
    save(figure, data)


def coupling(data):
    """Error of the work by hω, a panel per master, a line per coupling stiffness."""
    runs = defaultdict(lambda: defaultdict(list))
    for row in rows(data):
        error = abs(float(row["work_error"])) if row["stable"] == "true" else float("nan")
        runs[row["master"]][float(row["k_over_2Ga"])].append((float(row["h_omega"]), error))
    figure, panels = plt.subplots(
        1, len(runs), figsize=(3.2 * len(runs), 3.4), sharey=True, constrained_layout=True
    )
    shades = plt.get_cmap("viridis")
    for axes, (master, lines) in zip(panels, runs.items()):
        for i, (ratio, points) in enumerate(lines.items()):
            stiffness, error = zip(*points)
            axes.plot(
                stiffness,
                error,
                "o-",
                ms=3.5,
                lw=1,
                color=shades(i / len(lines)),
                label=f"k = {ratio:g} · 2G*a",
            )
        axes.axvline(2, color="#D55E00", lw=1, ls=":", label="explicit limit, hω = 2")
        axes.set(xscale="log", yscale="log", xlabel="hω", xlim=(0.3, 1e3))
        axes.set_title(master, fontsize=9)
        axes.grid(True, color="#eeeeee", lw=0.6)
    panels[0].set_ylabel("relative error of the friction work\nno point: unstable")
    figure.suptitle(
        "Ball, R = 10 mm, μ = 0.6, 100 N, on a mass m and a spring k; 200 steps "
        "a period of the drive in every run, ω² = (k + 2G*a)/m. "
        "hω grows because m is made smaller, not because h grows:\nwith less "
        "inertia the motion comes closer to the static answer to the drive, "
        "which implicit masters solve exactly at each step; so their error falls.",
        fontsize=8.5,
        x=0.01,
        ha="left",
    )
    panels[-1].legend(fontsize=6.5, frameon=False)
    save(figure, data)


def main(folder):
    for draw in (error_against_time, stability, coupling):
        data = folder / f"{draw.__name__}.csv"
        if data.is_file() and not is_current(data):
            draw(data)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "reports"))
