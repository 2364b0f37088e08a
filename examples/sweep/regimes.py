"""The map of a sweep: what slips at which load and amplitude, and what wears."""

from collections import Counter

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np
from sweep import FULL_SLIP

MARKS = {"stick": "o", "partial": "s", "gross": "^"}


def full_slip(load):
    """Amplitude at which the whole contact begins to slip under a load, m: μ (E*/G*) d, d ∝
    F^(2/3).
    """
    return FULL_SLIP * (np.asarray(load) / 100.0) ** (2 / 3)


def draw(results, path):
    """Writes the picture; returns how many sets are in each regime."""
    load, amplitude, volume, regime = (
        results[name]
        for name in ("normal_force", "displacement_amplitude", "wear_volume", "regime")
    )
    figure, axes = plt.subplots(figsize=(8, 6), layout="constrained")
    scale = matplotlib.colors.LogNorm(np.percentile(volume, 2) * 1e15, volume.max() * 1e15)
    shades = {"norm": scale, "cmap": "viridis"}
    for name, mark in MARKS.items():
        here = regime == name
        dots = axes.scatter(
            amplitude[here] * 1e6, load[here], c=volume[here] * 1e15, marker=mark, s=12, **shades
        )
        axes.plot([], [], mark, color="0.4", label=name)
    loads = np.geomspace(load.min(), load.max(), 100)
    axes.plot(full_slip(loads) * 1e6, loads, "k-", lw=1.5, label="all slips (Mindlin)")
    stick = (1 - 0.95**2) * full_slip(loads)
    axes.plot(stick * 1e6, loads, "k--", lw=1.5, label="5 % of the radius slips")
    axes.set(
        xscale="log", yscale="log", xlabel="displacement amplitude (µm)", ylabel="normal force (N)"
    )
    axes.set(
        xlim=(amplitude.min() * 0.9e6, amplitude.max() * 1.1e6),
        ylim=(load.min() * 0.9, load.max() * 1.1),
    )
    for axis in (axes.xaxis, axes.yaxis):  # 0.2, 0.5, 1 ... in place of powers
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_locator(matplotlib.ticker.NullLocator())
    axes.set_title(
        "Running conditions of a steel ball, R = 10 mm, by the first cycle",
        loc="left",
        fontweight="bold",
    )
    figure.legend(loc="outside lower center", ncols=5, fontsize=8)
    figure.colorbar(dots, label="volume worn in all cycles (10⁻⁶ mm³)")
    figure.savefig(path, dpi=130)
    plt.close(figure)
    return (
        f"{dict(Counter(regime.tolist()))} in the first cycle, "
        f"{dict(Counter(results['regime_at_end'].tolist()))} in the last: {path}"
    )
