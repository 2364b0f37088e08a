"""Where to start the search for the axis of a tilted line scan, and which points are spikes."""

from dataclasses import dataclass
from math import degrees, inf, log, sqrt

import numpy as np
from numpy.typing import NDArray

from .image_shapes import Array, Power
from .line_scan import Scan, difference_noise
from .monotone_fit import USUAL_TILT, Window, best_model

MOST_POINTS = 200
"""Points of a search: longer scans are averaged in blocks."""

PLACES = (-0.8, -0.6, -0.4, -0.2, 0.0, 0.2, 0.4, 0.6, 0.8)
"""Centres from which a search starts, in units of the half-width; each is fitted to 0.2 of the
farther side.
"""

MOST_SHAPES = 3
"""Shapes of a profile in a search."""

LEAST_NOISE = 1e-3
"""Noise that a search takes at least, in units of the height range of the levelled scan."""

SMALLEST_PART = 0.01
"""Part of a scan that counts as the smallest one about an axis."""

ANY_TILT = inf
"""A tilt that any tilt is small against, rad: in a search no tilt is more likely than another."""

SPIKE, SPIKE_NEIGHBOURS = 6.0, 3
"""A spike is off the median of so many neighbours on each side by so many times the noise, and by
so many of the steps there.
"""


@dataclass(frozen=True)
class Start:
    """An axis to start from."""

    centre: float
    """Position of the axis, m."""
    usual_tilt: float
    """What a tilt is small against, rad: a usual one for a ball, whose axis it decides; for another
    body at least the tilt about this axis.
    """
    mirrored: bool
    """Whether the positions are radii from 0 on."""


def spikes(scan: Scan) -> NDArray[np.bool_]:
    """Isolated points far off their neighbours. They would bend each fit towards themselves."""
    width = 2 * SPIKE_NEIGHBOURS + 1

    def windows(values: Array) -> Array:
        padded = np.pad(values, SPIKE_NEIGHBOURS, mode="reflect")
        return np.lib.stride_tricks.sliding_window_view(padded, width)

    medians = np.median(windows(scan.z), axis=1)
    steps = np.max(windows(np.abs(np.gradient(medians))), axis=1)
    noise = max(difference_noise(scan.z), LEAST_NOISE * float(np.ptp(medians)))
    return np.abs(scan.z - medians) > SPIKE * np.maximum(noise, steps)


def is_peak(scan: Scan) -> bool:
    """Whether the tip is the highest point; neither tilt nor centre change the curvature."""
    x = (scan.x - scan.x[0]) / np.ptp(scan.x)
    return bool(np.polyfit(x, scan.z, 2)[0] < 0)


def mirrored(scan: Scan) -> Scan:
    """A scan of radii and its mirror image about the axis."""
    others = slice(None, 0 if starts_at_axis(scan) else None, -1)
    return Scan(
        np.concatenate([-scan.x[others], scan.x]), np.concatenate([scan.z[others], scan.z])
    )


def starts_at_axis(scan: Scan) -> bool:
    """Whether the first position is 0, as that of radii."""
    return bool(abs(scan.x[0]) <= 1e-9 * np.ptp(scan.x))


def starting_axis(scan: Scan) -> Start:
    """The axis about which the fewest shapes with monotone images explain all points of the scan.

    Points on one side only count as well: a flank alone is a ball about any centre, whose tilt
    makes up for the centre, and only the points beyond it show that it is not. The axis of a body
    that is no ball does not depend on the tilt. Of axes that explain a ball equally, one with
    little tilt and a large part of the scan on both sides is taken.
    """
    short = _averaged(scan)
    middle, half = (short.x[0] + short.x[-1]) / 2, (short.x[-1] - short.x[0]) / 2
    upward = Scan(short.x, -short.z) if is_peak(short) else short
    noise = _noise(upward)
    best, least, smallest = Start(middle, USUAL_TILT, False), inf, inf
    for place in PLACES:
        window = _whole(upward, middle + place * half)
        model = best_model(window, noise / window.rise, True, MOST_SHAPES)
        if model is None:
            continue
        columns = window.columns(model.shift, noise / window.rise)
        coefficients, _ = columns.fit(model.shapes)
        _, slope = columns.level(window.z - columns.heights(model.shapes, coefficients))
        tilt = abs(slope) * window.rise / window.width
        centre = window.centre + model.shift * window.width
        on_both_sides = max(1 - abs(centre - middle) / half, SMALLEST_PART)
        # of the size of the price of a number
        cost = model.cost + log(len(short.x)) * (1 / on_both_sides + degrees(tilt))
        smallest = min(smallest, model.cost)
        if cost < least:
            is_ball = model.shapes == [Power(2)]
            best = Start(centre, USUAL_TILT if is_ball else max(tilt, USUAL_TILT), False)
            least = cost
    if starts_at_axis(scan):
        both = mirrored(short)
        window = _whole(Scan(both.x, -both.z) if is_peak(both) else both, 0.0)
        # each point counts twice
        one = best_model(window, sqrt(2) * noise / window.rise, False, MOST_SHAPES)
        if one is not None and one.cost <= smallest + log(len(short.x)):
            return Start(0.0, USUAL_TILT, True)
    return best


def _averaged(scan: Scan) -> Scan:
    """The scan with at most `MOST_POINTS`, each the mean of a block."""
    size = -(-len(scan.x) // MOST_POINTS)
    starts = np.arange(0, len(scan.x), size)
    counts = np.diff(np.append(starts, len(scan.x)))
    x, z = (np.add.reduceat(values, starts) / counts for values in (scan.x, scan.z))
    return Scan(x, z)


def _noise(scan: Scan) -> float:
    """Standard deviation of a point in a search, m."""
    line = np.polyval(np.polyfit(scan.x - scan.x[0], scan.z, 1), scan.x - scan.x[0])
    return max(difference_noise(scan.z), LEAST_NOISE * float(np.ptp(scan.z - line)))


def _whole(scan: Scan, centre: float) -> Window:
    """All points of a scan about a centre inside it."""
    farther = max(centre - scan.x[0], scan.x[-1] - centre)
    return Window(scan, centre, farther, np.ones(len(scan.x), dtype=bool), ANY_TILT)
