"""The picture of a profile fit: scan, fit, residual and 1-D image."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # draws to files; needs no display

import matplotlib.pyplot as plt
import numpy as np

from .profile import ProfileFit

BLUE, ORANGE, INK, GREY = "#0072B2", "#D55E00", "#222222", "#8a8a8a"
STYLE = {
    "figure.constrained_layout.use": True,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "axes.axisbelow": True,
    "legend.frameon": False,
}
MICRO, NANO = 1e6, 1e9


def draw(fit: ProfileFit, path: Path, name: str = "") -> Path:
    """Writes the picture; returns its path."""
    with plt.rc_context(STYLE):
        figure, ((scan, folded), (residual, image)) = plt.subplots(2, 2, figsize=(10, 7))
        both = np.concatenate([-fit.radius[::-1], fit.radius])
        heights = np.concatenate([fit.height[::-1], fit.height])
        scan.plot(
            fit.x * MICRO,
            fit.z * MICRO,
            ".",
            color=GREY,
            ms=2.5,
            label="scan, levelled and centred",
        )
        scan.plot(both * MICRO, heights * MICRO, color=ORANGE, lw=1.5, label="fit f(|x|)")
        scan.set(
            title="Scan and fit",
            xlabel="position from the axis (µm)",
            ylabel="height above the tip (µm)",
        )
        # both sides over one radius, near the tip
        near = np.abs(fit.x) <= 0.4 * fit.radius[-1]
        for side, colour in (-1, BLUE), (1, GREY):
            part = near & (np.sign(fit.x) == side)
            label = "left side" if side < 0 else "right side"
            folded.plot(
                np.abs(fit.x[part]) * MICRO,
                fit.z[part] * NANO,
                ".",
                color=colour,
                ms=3,
                label=label,
            )
        inner = fit.radius <= 0.4 * fit.radius[-1]
        folded.plot(
            fit.radius[inner] * MICRO, fit.height[inner] * NANO, color=ORANGE, lw=1.5, label="fit"
        )
        folded.set(
            title="Folded, near the tip",
            xlabel="radius r (µm)",
            ylabel="height f (nm)",
            xlim=(0, None),
        )
        residual.plot(
            fit.x * MICRO, fit.residual * NANO, ".", color=BLUE, ms=2.5, label="scan less fit"
        )
        residual.axhline(0, color=INK, lw=0.8)
        for sign in (-1, 1):
            residual.axhline(
                sign * fit.rms * NANO,
                color=ORANGE,
                lw=1,
                ls="--",
                label=f"rms = {fit.rms * NANO:.3g} nm" if sign > 0 else None,
            )
        residual.set(title="Residual", xlabel="position from the axis (µm)", ylabel="residual (nm)")
        image.plot(fit.radius * MICRO, fit.image * MICRO, color=ORANGE, lw=1.5, label="image g(x)")
        image.plot(
            fit.radius * MICRO,
            fit.height * MICRO,
            color=GREY,
            lw=1.2,
            ls="--",
            label="profile f(x)",
        )
        image.set(
            title="1-D image: rises everywhere",
            xlabel="radius x (µm)",
            ylabel="height (µm)",
            xlim=(0, None),
        )
        for axes in (scan, folded, residual, image):
            axes.legend(loc="best", fontsize=8.5)
        if name:
            figure.suptitle(name)
        figure.savefig(path, dpi=110)
        plt.close(figure)
    return path
