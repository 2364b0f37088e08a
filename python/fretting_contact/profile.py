"""From a measured line scan to a profile table that the FMU accepts.

    python -m fretting_contact.profile SCAN --unit um -o profile.txt

The scan (x, z) may be tilted, off centre and noisy, and its tip may be worn flat. It is levelled,
centred and folded. A smooth curve f(r) is fitted whose 1-D image g(x) = x ∫₀ˣ f'(r) dr/√(x² − r²)
rises monotonically, for only then is the contact one disc. How: see `fit_scan`.
"""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, inf, sqrt
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .command_errors import OutputError, check_output, finite, report
from .image_shapes import Array, Power, Shape, profile_of_image
from .line_scan import FEWEST_POINTS, UNITS, Scan, ScanError, checked, difference_noise, read_scan
from .monotone_fit import USUAL_TILT, Window, best_model
from .scan_centre import Start, is_peak, mirrored, spikes, starting_axis, starts_at_axis
from .text_table import TextTableError

__all__ = [
    "ProfileFit",
    "Scan",
    "ScanError",
    "fit_scan",
    "main",
    "read_scan",
    "summary",
    "write_table",
]

OUTLIER = 6.0
"""A point this many standard deviations off a fit is dropped."""

LEAST_OUTLIER = 1e-3
"""A point that is less than this off, in units of the height range, is no outlier."""

TABLE_POINTS, TABLE_GRADING = 401, 1.5
"""Points of the table. Its radii go like this power of their number: light loads need close points.
"""

MOST_OUTLIERS = 0.05
"""Share of the points that may be dropped."""

LEAST_RISE = 1e-6
"""Share of a sphere that is added: so the image of a flat tip still rises after rounding to text.
"""


@dataclass(frozen=True)
class ProfileFit:
    """A profile with a monotone image, and what was done to the scan. SI units."""

    radius: Array
    """Radii of the table, m."""
    height: Array
    """Heights f above the tip at these radii, m."""
    image: Array
    """1-D image g at these radii, m."""
    x: Array
    """Positions of the points that were fitted, from the centre, m."""
    z: Array
    """Their heights above the tip, levelled and turned so that the flanks rise, m."""
    residual: Array
    """Heights less fit at these points, m."""
    dropped: int
    """Points that were left out as outliers."""
    unused: int
    """Points beyond the largest radius that the scan has on both sides."""
    tilt: float
    """Slope that was taken off, rad."""
    centre: float
    """Position of the axis in the scan, m."""
    offset: float
    """Height of the tip in the scan, m."""
    is_peak: bool
    """Whether the tip is the highest point of the scan."""
    mirrored: bool
    """Whether the file had one side only, radii from 0 on."""
    shapes: tuple[tuple[float, Shape], ...]
    """Coefficients, m, and shapes of the image, lengths in units of the last radius."""

    @property
    def rms(self) -> float:
        """Root mean square of the residual, m."""
        return float(np.sqrt(np.mean(self.residual**2)))

    @property
    def tip_radius(self) -> float:
        """Radius of curvature on the axis, m; 0 for a pointed tip.

        Infinite if the curvature there is less than 1 % of that of the whole body.
        """
        if any(isinstance(shape, Power) and shape.exponent < 2 for _, shape in self.shapes):
            return 0.0
        step = 1e-3
        curvature = (
            sum(c * float(shape.image(np.array(step))) for c, shape in self.shapes) / step**2
        )
        return (
            inf if curvature <= 1e-2 * self.image[-1] else float(self.radius[-1] ** 2 / curvature)
        )

    @property
    def flank_radius(self) -> float:
        """r/f' at the last radius, m: the radius of the sphere whose flank has the same slope."""
        last = slice(-TABLE_POINTS // 10, None)
        slope = np.polyfit(self.radius[last] ** 2, self.height[last], 1)[0]
        return float(1 / (2 * slope))

    @property
    def flat_radius(self) -> float:
        """Radius up to which the height is below the residual or a thousandth of the whole, m."""
        return float(
            self.radius[np.searchsorted(self.height, max(self.rms, 1e-3 * self.height[-1])) - 1]
        )


def fit_scan(scan: Scan, centre: float | None = None, radius: float | None = None) -> ProfileFit:
    """Fits a profile with a monotone image to a line scan.

    `centre`: position of the axis in the scan, m; found by symmetry if not given. `radius`: largest
    radius of the profile, m; all that the scan has on both sides if not given.

    Heights are offset + tilt x + f(|x − centre|). f is a sum of shapes with monotone images
    (`image_shapes`) whose coefficients are not negative (scipy.optimize.nnls), so that the image of
    the sum is monotone. Noise is the standard deviation that a fit of all candidate shapes leaves.
    The fewest shapes that explain the heights within that noise are taken (`monotone_fit`). The
    centre and the positions of the shapes are fitted as well (scipy.optimize.least_squares).
    """
    scan = checked(scan)
    if len(scan.x) < FEWEST_POINTS:
        raise ScanError(f"{len(scan.x)} point(s), but at least {FEWEST_POINTS} are needed")
    if not np.ptp(scan.x) > 0:
        raise ScanError(
            f"the positions are all {scan.x[0]:g} m: give a scan along x, position in column 1"
        )
    wild = spikes(scan)
    start = Start(centre or 0.0, USUAL_TILT, centre == 0.0 and starts_at_axis(scan))
    if centre is None:
        start = starting_axis(Scan(scan.x[~wild], scan.z[~wild]))
    if start.mirrored:
        scan, wild, centre = mirrored(scan), np.concatenate([wild[:0:-1], wild]), 0.0
    turned = is_peak(Scan(scan.x[~wild], scan.z[~wild]))
    upward = Scan(scan.x, -scan.z if turned else scan.z)
    keep = ~wild
    noise_of_points = difference_noise(scan.z)

    def window_about(middle: float) -> Window:
        width = min(middle - scan.x[0], scan.x[-1] - middle)
        if radius is not None and radius > width * (1 + 1e-9):
            raise ScanError(
                f"radius = {radius:g} m, but the scan reaches {width:g} m on both sides "
                f"of its centre, x = {middle:g} m: "
                "give a smaller --radius"
            )
        if width <= 0:
            raise ScanError(
                f"the centre, x = {middle:g} m, is not inside the scan, which goes from "
                f"{scan.x[0]:g} m to {scan.x[-1]:g} m: scan further on both sides, or give "
                "another --center"
            )
        return Window(upward, middle, width if radius is None else radius, keep, start.usual_tilt)

    def drop(window: Window, left: Array) -> bool:
        """Drops the outliers among the points of a window; whether there are any."""
        off = np.abs(left[:-1])
        deviation = 1.4826 * float(np.median(off))
        # the largest first: they bend the fit, and then their neighbours are off as well
        wrong = off > max(OUTLIER * deviation, LEAST_OUTLIER, 0.5 * float(off.max()))
        keep[np.flatnonzero(window.inside)[wrong]] = False
        dropped = int(np.sum(~keep))
        if dropped > MOST_OUTLIERS * len(keep):
            raise ScanError(
                f"{dropped} of {len(keep)} points lie more than {OUTLIER:g} standard "
                "deviations off any profile of a round tip: "
                "cut the scan to the tip, or check that it passes over the axis"
            )
        return bool(wrong.any())

    vertex = start.centre if centre is None else centre
    while True:  # each further round drops points, which are a share at most
        window = window_about(vertex)
        columns = window.columns(0.0, noise_of_points / window.rise)
        coefficients, left = columns.fit(window.candidates)
        if drop(window, left):
            continue
        noise = window.noise(left, int(np.sum(coefficients > 0)))
        if start.mirrored:
            noise *= sqrt(2)  # each point counts twice
        model = best_model(window, noise, centre is None)
        if model is None:
            raise ScanError(
                "the heights do not rise from the centre by more than their noise: scan further out"
            )
        final = window_about(vertex + model.shift * window.width)
        fit = _result(upward, final, model.shapes, window, noise, turned, start.mirrored, keep)
        # the last window may reach further than the one whose outliers are out
        if not drop(final, np.append(fit.residual / final.rise, 0.0)):
            return fit


def _result(
    scan: Scan,
    window: Window,
    shapes: list[Shape],
    units: Window,
    noise: float,
    is_peak: bool,
    mirrored: bool,
    keep: NDArray[np.bool_],
) -> ProfileFit:
    """The fit about its final centre, in SI units."""
    scale = units.width / window.width
    shapes = [shape.scaled(scale) for shape in shapes]
    columns = window.columns(0.0, noise)
    coefficients, left = columns.fit(shapes)
    level, slope = columns.level(window.z - columns.heights(shapes, coefficients))
    dropped = int(np.sum(~keep))
    last = float(sum(c * shape.image(np.array(1.0)) for c, shape in zip(coefficients, shapes)))
    terms = [(float(c), shape) for c, shape in zip(coefficients, shapes) if c > 0] + [
        (LEAST_RISE * last, Power(2))
    ]
    x = np.linspace(0, 1, TABLE_POINTS) ** TABLE_GRADING
    image = np.sum([c * shape.image(x) for c, shape in terms], axis=0)
    sign = -1.0 if is_peak else 1.0
    mean = float(scan.z[window.inside].mean())
    return ProfileFit(
        radius=x * window.width,
        height=profile_of_image(x, image) * window.rise,
        image=image * window.rise,
        x=window.x * window.width,
        z=(window.z - level - slope * window.x) * window.rise,
        residual=left[:-1] * window.rise,
        dropped=dropped,
        unused=int(len(scan.x) - dropped - window.inside.sum()),
        tilt=sign * slope * window.rise / window.width,
        centre=window.centre,
        offset=sign * (mean + level * window.rise),
        is_peak=is_peak,
        mirrored=mirrored,
        shapes=tuple((c * window.rise, shape) for c, shape in terms),
    )


def write_table(fit: ProfileFit, path: str | Path, source: str = "") -> None:
    """Writes the profile as a table of r and f.

    M, for `profile = table` and `profile_unit = m` of the FMU.
    """
    header = "\n".join(
        [
            f"Profile fitted to the line scan {source}".rstrip(),
            *summary(fit),
            "column 1: radius r from the axis, m",
            "column 2: height f above the tip, m",
        ]
    )
    np.savetxt(
        path,
        np.column_stack([fit.radius, fit.height]),
        fmt="%.14e",
        header=header,
        encoding="utf-8",
    )


def _length(value: float) -> str:
    """A length with a unit that suits it."""
    for unit, factor in ("nm", 1e-9), ("um", 1e-6), ("mm", 1e-3):
        if abs(value) < 1000 * factor:
            return f"{value / factor:.4g} {unit}"
    return f"{value:.4g} m"


def summary(fit: ProfileFit) -> list[str]:
    """What was done to the scan and what came out, one line each."""
    turned = (
        "turned over, since the tip is the highest point"
        if fit.is_peak
        else "as it is, the tip is the lowest point"
    )
    if fit.tip_radius == inf:
        tip = f"infinite: flat within the residual up to r = {_length(fit.flat_radius)}"
    elif fit.tip_radius == 0:
        tip = "0: the tip is pointed"
    else:
        tip = _length(fit.tip_radius)
    mirrored = ["one side only, radii from 0 on: mirrored"] if fit.mirrored else []
    return [
        *mirrored,
        f"height: {turned}; {_length(fit.offset)} subtracted",
        f"tilt: {degrees(fit.tilt):.3f} deg taken off",
        f"centre: x = {_length(fit.centre)}",
        f"folded: {len(fit.x)} points up to r = {_length(fit.radius[-1])}; "
        f"{fit.unused} further out are not used",
        f"outliers: {fit.dropped} dropped",
        f"residual: {_length(fit.rms)} rms",
        f"radius of curvature at the apex: {tip}",
        f"radius of curvature of the flank, r/f' at the last radius: {_length(fit.flank_radius)}",
        f"image: rises monotonically up to r = {_length(fit.radius[-1])}, where "
        f"it is {_length(fit.image[-1])}",
    ]


def main(arguments: Sequence[str] | None = None, prog: str = "cargo fmu profile") -> int:
    """The command line, which is called ``prog``; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog=prog,
        description="Makes a profile table for the FMU from a measured line scan.",
    )
    parser.add_argument(
        "scan", type=Path, help="two columns: position x and height z over the tip, both flanks"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        help="the table to write; a picture goes beside it",
    )
    parser.add_argument(
        "--unit", choices=UNITS, default="m", help="unit of both columns (default: m)"
    )
    parser.add_argument("--z-unit", choices=UNITS, help="unit of the heights, if another one")
    parser.add_argument(
        "--center",
        type=finite,
        help="x of the axis, in the unit of the scan (default: by symmetry)",
    )
    parser.add_argument(
        "--radius",
        type=finite,
        help="largest radius, in the unit of the scan (default: all there is)",
    )
    options = parser.parse_args(arguments)
    factor = UNITS[options.unit]
    try:
        check_output(options.output)
        picture = options.output.with_suffix(".png")
        if picture == options.output:
            raise OutputError(
                f"--output = {str(picture)!r} is the name of the picture: "
                "give the table another ending, such as .txt"
            )
        scan = read_scan(options.scan, options.unit, options.z_unit)
        fit = fit_scan(
            scan,
            None if options.center is None else options.center * factor,
            None if options.radius is None else options.radius * factor,
        )
        write_table(fit, options.output, options.scan.name)
        try:
            from .profile_picture import draw
        except ImportError:
            drawn = "none, pip install fretting-contact[plot]"
        else:
            drawn = str(draw(fit, picture, options.scan.name))
    except (OutputError, ScanError, TextTableError, OSError) as problem:
        return report(problem)
    print(
        "\n".join([*summary(fit), f"table: {options.output}, r and f in m", f"picture: {drawn}"])
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
