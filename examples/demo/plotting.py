"""The look of the demo's pictures, and how their data are saved."""

import csv

import matplotlib

matplotlib.use("Agg")  # draws to files; needs no display

import matplotlib.pyplot as plt
import numpy as np

# Okabe–Ito: distinct with every common colour blindness, and in grey.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#D55E00",
    "#CC79A7",
    "#56B4E9",
)
INK, GREY = "#222222", "#8a8a8a"

STYLE = {
    "figure.dpi": 110,
    "savefig.dpi": 110,
    "figure.constrained_layout.use": True,
    "font.size": 11,
    "axes.titlesize": 12,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": INK,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "lines.linewidth": 1.8,
    "legend.frameon": False,
    "legend.fontsize": 9.5,
}

MICRO = 1e6  # m → µm, J → µJ
GIGA = 1e-9  # Pa → GPa


def shades(count, name="viridis", darkest=0.05, lightest=0.88):
    """Colours for a sequence in time: dark first, evenly spaced in lightness."""
    return plt.get_cmap(name)(np.linspace(darkest, lightest, count))


def figure(*arguments, **keywords):
    """A figure with axes, as plt.subplots, in the demo's style."""
    plt.rcParams.update(STYLE)
    return plt.subplots(*arguments, **keywords)


def save_picture(fig, path):
    """Writes and closes a figure."""
    fig.savefig(path)
    plt.close(fig)
    return path


def save_table(path, columns):
    """Writes {header with unit: sequence} as CSV."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(
            [value if isinstance(value, str) else f"{value:.9g}" for value in row]
            for row in zip(*columns.values(), strict=True)
        )
    return path
