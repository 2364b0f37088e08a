"""From a measured line scan to a profile table that the FMU accepts.

    python -m fretting_contact.profile SCAN --unit um -o profile.txt

The scan (x, z) may be tilted, off centre and noisy, and its tip may be worn flat. It is levelled, centred and folded. A
smooth curve f(r) is fitted whose 1-D image g(x) = x ∫₀ˣ f'(r) dr/√(x² − r²) rises monotonically, for only then is the contact
one disc. How: see `fit_scan`.
"""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, inf, log, sqrt
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, minimize_scalar, nnls

from .image_shapes import SHARP, SPHERE, Array, FlatTip, Power, Shape, candidates, profile_of_image
from .text_table import TextTableError, read_columns

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
"""Length units by name, m."""

USUAL_TILT = 3.5e-3
"""A usual error of alignment (0.2°), rad. It decides between tilt and centre where the scan cannot: on a sphere."""

OUTLIER = 6.0
"""A point this many standard deviations off the first fit is dropped."""

OUTLIER_ROUNDS = 20
"""Repetitions of the search for outliers."""

LEAST_OUTLIER = 1e-3
"""A point that is less than this off, in units of the height range, is no outlier."""

FEWEST_POINTS = 20
"""Points that a scan needs."""

TABLE_POINTS, TABLE_GRADING = 401, 1.5
"""Points of the table that is written; its radii go like this power of their number, since light loads need more of them."""

MOST_SHAPES, SHORT_LIST = 12, 8
"""Shapes of a profile; candidates that are tried for the next one."""

MOST_OUTLIERS = 0.05
"""Share of the points that may be dropped."""

LEAST_PITCHES = 3
"""Shapes of a smaller radius, in units of the distance of the points, are not looked for."""

LEAST_NOISE = 1e-5
"""Smallest standard deviation that is assumed, in units of the height range."""

LEAST_RISE = 1e-6
"""Share of a sphere that is added to the image, so that it still rises where it is flat once the digits are cut."""


class ScanError(ValueError):
    """A scan that cannot become a profile; the text says why and what to do."""


@dataclass(frozen=True)
class Scan:
    """A line scan: positions and heights, m, in the order of rising position."""

    x: Array
    z: Array


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
        """Radius of curvature on the axis, m; infinite where that is less than 1 % of the whole, 0 where it is pointed."""
        if any(isinstance(shape, Power) and shape.exponent < 2 for _, shape in self.shapes):
            return 0.0
        step = 1e-3
        curvature = sum(c * float(shape.image(np.array(step))) for c, shape in self.shapes) / step**2
        return inf if curvature <= 1e-2 * self.image[-1] else float(self.radius[-1] ** 2 / curvature)

    @property
    def flank_radius(self) -> float:
        """r/f' at the last radius, m: the radius of the sphere whose flank has the same slope."""
        last = slice(-TABLE_POINTS // 10, None)
        slope = np.polyfit(self.radius[last] ** 2, self.height[last], 1)[0]
        return float(1 / (2 * slope))

    @property
    def flat_radius(self) -> float:
        """Radius up to which the tip is flat within the residual, m, and within a thousandth of the height."""
        return float(self.radius[np.searchsorted(self.height, max(self.rms, 1e-3 * self.height[-1])) - 1])


def read_scan(path: str | Path, unit: str = "m", z_unit: str | None = None) -> Scan:
    """Reads a line scan of two columns x and z.

    `unit` is that of both columns, `z_unit` that of the second one if it differs: m, mm, um or nm.
    """
    columns = read_columns(path)
    if len(columns) < FEWEST_POINTS:
        raise ScanError(f"{path}: {len(columns)} point(s), but at least {FEWEST_POINTS} are needed")
    columns = columns[np.argsort(columns[:, 0], kind="stable")]
    return Scan(columns[:, 0] * UNITS[unit], columns[:, 1] * UNITS[z_unit or unit])


class _Columns:
    """Least squares of the heights of a scan by tilt, offset and shapes about a centre. Lengths in units of `width`."""

    def __init__(self, x: Array, z: Array, tilt_weight: float) -> None:
        """`tilt_weight`: what a tilt of 1 counts as, in units of z."""
        self.x, self.radius = x, np.abs(x)
        self.tilt_weight = tilt_weight
        self.free, _ = np.linalg.qr(self._with_prior(np.column_stack([np.ones_like(x), x]), tilt_weight))
        self.target = self._without_free(self._with_prior(z, 0.0))

    @staticmethod
    def _with_prior(values: Array, last: float) -> Array:
        """One more row, which says that the tilt is small."""
        row = np.zeros((1, *values.shape[1:]))
        row[..., -1] = last
        return np.concatenate([values, row])

    def _without_free(self, values: Array) -> Array:
        """What is left once offset and tilt have been fitted."""
        return values - self.free @ (self.free.T @ values)

    def shapes(self, shapes: Sequence[Shape]) -> Array:
        profiles = np.column_stack([shape.profile(self.radius) for shape in shapes])
        return self._without_free(self._with_prior(profiles, 0.0))

    def heights(self, shapes: Sequence[Shape], coefficients: Array) -> Array:
        """Heights of the sum of the shapes at the points."""
        return np.sum([c * shape.profile(self.radius) for c, shape in zip(coefficients, shapes)], axis=0)

    def level(self, rest: Array) -> tuple[float, float]:
        """Offset and tilt of what the shapes leave of the heights."""
        rows = self._with_prior(np.column_stack([np.ones_like(self.x), self.x]), self.tilt_weight)
        level, slope = np.linalg.lstsq(rows, self._with_prior(rest, 0.0), rcond=None)[0]
        return float(level), float(slope)

    def fit(self, shapes: Sequence[Shape]) -> tuple[Array, Array]:
        """Coefficients, none of them negative, and what is left of the heights."""
        columns = self.shapes(shapes)
        # the triangle of QR has the same least squares in few rows
        q, triangle = np.linalg.qr(columns)
        size = np.linalg.norm(triangle, axis=0)
        size[size == 0.0] = 1.0
        coefficients = nnls(triangle / size, q.T @ self.target)[0] / size
        return coefficients, self.target - columns @ coefficients


def _with_one_more(columns: _Columns, shapes: list[Shape], known: Sequence[Shape], noise: float) -> list[Shape] | None:
    """The known shapes and the one that takes most off the sum of squares, less its price; none where no one is worth it."""
    every = [*known, *shapes]
    matrix = columns.shapes(every)
    price = noise**2 * np.array([_price(shape, len(matrix), len(shapes)) for shape in shapes])
    basis, _ = np.linalg.qr(matrix[:, : len(known)])
    rest = columns.fit(known)[1] if known else columns.target
    new = matrix[:, len(known) :]
    size = np.sum(new**2, axis=0)
    new = new - basis @ (basis.T @ new)
    left_size = np.sum(new**2, axis=0)
    gain = np.maximum(new.T @ rest, 0.0) ** 2 / np.where(left_size > 1e-12 * size, left_size, inf)
    least, best = float(rest @ rest), None
    for index in np.argsort(gain - price)[-SHORT_LIST:]:
        subset = [*known, shapes[index]]
        coefficients, left = columns.fit(subset)
        if left @ left + price[index] < least:
            least = float(left @ left + price[index])
            best = [shape for shape, c in zip(subset, coefficients) if c > 0]
    return best


def _price(shape: Shape, points: int, count: int) -> float:
    """What a shape has to take off the sum of squares, in units of noise².

    ln n for each number that is fitted to n points, and 4 ln m more for what is no sphere but was chosen among m candidates: an
    extended Bayesian information criterion, strict because a feature that is not there spoils light loads most.
    """
    is_sphere = shape in SPHERE
    return log(points) * max(len(shape.positions), 1) + (0.0 if is_sphere else 4 * log(count))


class _Window:
    """The points within `width` of a centre, in units of that width and of their height range."""

    def __init__(self, scan: Scan, centre: float, width: float, keep: NDArray[np.bool_]) -> None:
        self.inside = (np.abs(scan.x - centre) <= width * (1 + 1e-9)) & keep
        self.centre, self.width = centre, width
        x, z = scan.x[self.inside], scan.z[self.inside]
        if len(x) < FEWEST_POINTS:
            raise ScanError(
                f"{len(x)} point(s) within {width:g} m of the centre, x = {centre:g} m, but at least {FEWEST_POINTS} "
                "are needed: scan further on both sides, or give another --center"
            )
        self.rise = float(np.ptp(z))
        if self.rise == 0.0:
            raise ScanError(f"the heights are all {z[0]:g} m: scan over the flanks of the body")
        self.x, self.z = (x - centre) / width, (z - z.mean()) / self.rise
        self.candidates = candidates(least=LEAST_PITCHES * float(np.median(np.diff(self.x))))
        self.candidate_count = len(self.candidates)

    def columns(self, shift: float, noise: float) -> _Columns:
        """Least squares about the centre moved by `shift`, for points of that standard deviation; both in units."""
        return _Columns(self.x - shift, self.z, self.tilt_weight(noise))

    def tilt_weight(self, noise: float) -> float:
        """A tilt in units times this is a usual tilt times the standard deviation."""
        return max(noise, LEAST_NOISE) * self.rise / (self.width * USUAL_TILT)

    def noise(self, left: Array, count: int) -> float:
        """Standard deviation of a point from the residual of a fit of `count` shapes."""
        return max(float(np.sqrt(left @ left / max(len(left) - 3 - count, 1))), LEAST_NOISE)


def _difference_noise(z: Array) -> float:
    """Standard deviation of independent noise on a smooth curve, from its third differences."""
    third = np.diff(z, 3)
    return float(np.median(np.abs(third - np.median(third)))) * 1.4826 / np.sqrt(20)


def _vertex(scan: Scan) -> float:
    """Position of the vertex of the parabola through all points, m."""
    middle, half = (scan.x[0] + scan.x[-1]) / 2, (scan.x[-1] - scan.x[0]) / 2
    square, slope, _ = np.polyfit((scan.x - middle) / half, scan.z, 2)
    return middle + half * float(np.clip(-slope / (2 * square), -0.8, 0.8)) if square else middle


def _is_one_sided(scan: Scan, centre: float | None) -> bool:
    """Whether the positions are radii: they begin at 0, and so does the body."""
    span = float(np.ptp(scan.x))
    starts_at_axis = abs(scan.x[0]) <= 1e-9 * span
    return bool(starts_at_axis and (_vertex(scan) <= 0.15 * span if centre is None else centre == 0.0))


def _best_shift(window: _Window, noise: float) -> float:
    """Centre of symmetry: the shift about which any monotone image fits best, in units of the window."""
    shapes = candidates(10)
    span = 0.3

    def cost(shift: float) -> float:
        x = (window.x - shift) / (1 - span)
        part = np.abs(x) <= 1
        left = _Columns(x[part], window.z[part], window.tilt_weight(noise) / (1 - span)).fit(shapes)[1]
        return float(left @ left) / part.sum()

    shifts = np.linspace(-span, span, 31)
    start = float(shifts[np.argmin([cost(float(shift)) for shift in shifts])])
    step = shifts[1] - shifts[0]
    return float(minimize_scalar(cost, bounds=(start - step, start + step), method="bounded").x)


@dataclass(frozen=True)
class _Model:
    """Shapes about a centre, and how well they explain a window."""

    shift: float
    shapes: list[Shape]
    cost: float
    """Sum of squares and prices, in units of noise²."""


def _refined(window: _Window, shapes: list[Shape], noise: float, shift: float, centre_is_free: bool) -> _Model:
    """Least squares over the centre and the positions of the shapes."""
    counts = [len(shape.positions) for shape in shapes]

    def moved(values: Array) -> tuple[float, list[Shape]]:
        positions = iter(values[1:] if centre_is_free else values)
        placed = [shape.moved([float(next(positions)) for _ in range(n)]) for shape, n in zip(shapes, counts)]
        return (float(values[0]) if centre_is_free else shift), placed

    def left(values: Array) -> Array:
        at, placed = moved(values)
        return window.columns(at, noise).fit(placed)[1] / noise

    free = [(shift, shift - 0.2, shift + 0.2)] if centre_is_free else []
    free += [position for shape in shapes for position in shape.positions]
    best = np.zeros(0)
    if free:
        start, low, high = np.array(free).T
        best = least_squares(left, start, bounds=(low, high), diff_step=1e-5, x_scale=0.1, max_nfev=30).x
    at, placed = moved(best)
    rest = left(best)
    price = sum(_price(shape, len(rest), window.candidate_count) for shape in placed)
    return _Model(at, placed, float(rest @ rest) + price)


def _simpler(shapes: list[Shape]) -> list[list[Shape]]:
    """The same shapes less one, or with a sphere or a sharp edge in place of a flat tip."""
    others = [shapes[:i] + shapes[i + 1 :] for i in range(len(shapes))] if len(shapes) > 1 else []
    for i, shape in enumerate(shapes):
        if isinstance(shape, FlatTip):
            others.append([*shapes[:i], SPHERE[0], *shapes[i + 1 :]])
            if not shape.is_sharp:
                others.append([*shapes[:i], FlatTip(shape.flat, SHARP), *shapes[i + 1 :]])
    return others


def _model(window: _Window, noise: float, centre_is_free: bool) -> _Model | None:
    """The fewest shapes that explain the heights within their noise; none where the heights do not rise.

    To a sphere one shape after the other is added, centre and positions are refined each time; then what has become needless
    is left out.
    """
    columns = window.columns(0.0, noise)
    coefficients, _ = columns.fit(SPHERE)
    sphere = [shape for shape, c in zip(SPHERE, coefficients) if c > 0]
    model = _refined(window, sphere, noise, 0.0, centre_is_free) if sphere else None
    if model and model.cost * noise**2 >= columns.target @ columns.target:
        model = None
    while model is None or len(model.shapes) < MOST_SHAPES:
        shift, known = (model.shift, model.shapes) if model else (0.0, [])
        chosen = _with_one_more(window.columns(shift, noise), window.candidates, known, noise)
        if chosen is None:
            break
        larger = _refined(window, chosen, noise, shift, centre_is_free)
        if model and larger.cost >= model.cost:
            break
        model = larger
    while model and (options := _simpler(model.shapes)):
        columns = window.columns(model.shift, noise)
        promising = sorted(options, key=lambda option: float(np.sum(columns.fit(option)[1] ** 2)))[:2]
        refined = [_refined(window, option, noise, model.shift, centre_is_free) for option in promising]
        simpler = min(refined, key=lambda one: one.cost)
        if simpler.cost >= model.cost:
            break
        model = simpler
    return model


def fit_scan(scan: Scan, centre: float | None = None, radius: float | None = None) -> ProfileFit:
    """Fits a profile with a monotone image to a line scan.

    `centre`: position of the axis in the scan, m; found by symmetry if not given. `radius`: largest radius of the
    profile, m; all that the scan has on both sides if not given.

    Heights are offset + tilt x + f(|x − centre|). f is a sum of shapes with monotone images (`image_shapes`) whose coefficients
    are not negative (scipy.optimize.nnls), so that the image of the sum is monotone. Noise is the standard
    deviation that a fit of all candidate shapes leaves. Of these as few are taken as explain the heights within that noise
    (`_model`, `_price`); centre and positions of the shapes are fitted as well (scipy.optimize.least_squares).
    """
    mirrored = _is_one_sided(scan, centre)
    if mirrored:
        scan, centre = Scan(np.concatenate([-scan.x[:0:-1], scan.x]), np.concatenate([scan.z[:0:-1], scan.z])), 0.0
    vertex = _vertex(scan) if centre is None else centre
    curvature = np.polyfit((scan.x - vertex) / np.ptp(scan.x), scan.z, 2)[0]
    is_peak = bool(curvature < 0)
    upward = Scan(scan.x, -scan.z if is_peak else scan.z)
    keep = np.ones(len(scan.x), dtype=bool)
    noise_of_points = _difference_noise(scan.z)

    def window_about(middle: float) -> _Window:
        width = min(middle - scan.x[0], scan.x[-1] - middle)
        if radius is not None and radius > width * (1 + 1e-9):
            raise ScanError(
                f"radius = {radius:g} m, but the scan reaches {width:g} m on both sides of its centre, x = {middle:g} m: "
                "give a smaller --radius"
            )
        if width <= 0:
            raise ScanError(
                f"centre = {middle:g} m, but the scan goes from {scan.x[0]:g} m to {scan.x[-1]:g} m: give a --center inside"
            )
        return _Window(upward, middle, width if radius is None else radius, keep)

    if centre is None:
        first = window_about(vertex)
        vertex += _best_shift(first, noise_of_points / first.rise) * first.width
    for _ in range(OUTLIER_ROUNDS):
        window = window_about(vertex)
        columns = window.columns(0.0, noise_of_points / window.rise)
        coefficients, left = columns.fit(window.candidates)
        deviation = 1.4826 * float(np.median(np.abs(left[:-1])))
        off = np.abs(left[:-1])
        # the largest first: they bend the fit, and then their neighbours are off as well
        wrong = off > max(OUTLIER * deviation, LEAST_OUTLIER, 0.5 * float(off.max()))
        if not wrong.any():
            break
        keep[np.flatnonzero(window.inside)[wrong]] = False
    dropped = int(np.sum(~keep))
    if dropped > MOST_OUTLIERS * len(keep):
        raise ScanError(
            f"{dropped} of {len(keep)} points lie more than {OUTLIER:g} standard deviations off any profile of a round tip: "
            "cut the scan to the tip, or check that it passes over the axis"
        )
    noise = window.noise(left, int(np.sum(coefficients > 0)))
    if mirrored:
        noise *= sqrt(2)  # each point counts twice
    model = _model(window, noise, centre is None)
    if model is None:
        raise ScanError("the heights do not rise from the centre by more than their noise: scan further out")
    final = window_about(vertex + model.shift * window.width)
    return _result(upward, final, model.shapes, window, noise, is_peak, mirrored, dropped)


def _result(
    scan: Scan,
    window: _Window,
    shapes: list[Shape],
    units: _Window,
    noise: float,
    is_peak: bool,
    mirrored: bool,
    dropped: int,
) -> ProfileFit:
    """The fit about its final centre, in SI units."""
    scale = units.width / window.width
    shapes = [shape.scaled(scale) for shape in shapes]
    columns = window.columns(0.0, noise)
    coefficients, left = columns.fit(shapes)
    level, slope = columns.level(window.z - columns.heights(shapes, coefficients))
    last = float(sum(c * shape.image(np.array(1.0)) for c, shape in zip(coefficients, shapes)))
    terms = [(float(c), shape) for c, shape in zip(coefficients, shapes) if c > 0] + [(LEAST_RISE * last, Power(2))]
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
    """Writes the profile as a table of r and f, m, for `profile = table` and `profile_unit = m` of the FMU."""
    header = "\n".join(
        [
            f"Profile fitted to the line scan {source}".rstrip(),
            *summary(fit),
            "column 1: radius r from the axis, m",
            "column 2: height f above the tip, m",
        ]
    )
    np.savetxt(path, np.column_stack([fit.radius, fit.height]), fmt="%.14e", header=header, encoding="utf-8")


def _length(value: float) -> str:
    """A length with a unit that suits it."""
    for unit, factor in ("nm", 1e-9), ("um", 1e-6), ("mm", 1e-3):
        if abs(value) < 1000 * factor:
            return f"{value / factor:.4g} {unit}"
    return f"{value:.4g} m"


def summary(fit: ProfileFit) -> list[str]:
    """What was done to the scan and what came out, one line each."""
    turned = "turned over, since the tip is the highest point" if fit.is_peak else "as it is, the tip is the lowest point"
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
        f"folded: {len(fit.x)} points up to r = {_length(fit.radius[-1])}; {fit.unused} further out are not used",
        f"outliers: {fit.dropped} dropped",
        f"residual: {_length(fit.rms)} rms",
        f"radius of curvature at the apex: {tip}",
        f"radius of curvature of the flank, r/f' at the last radius: {_length(fit.flank_radius)}",
        f"image: rises monotonically up to r = {_length(fit.radius[-1])}, where it is {_length(fit.image[-1])}",
    ]


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="cargo fmu profile", description="Makes a profile table for the FMU from a measured line scan."
    )
    parser.add_argument("scan", type=Path, help="two columns: position x and height z over the tip, both flanks")
    parser.add_argument("-o", "--output", type=Path, required=True, help="the table to write; a picture goes beside it")
    parser.add_argument("--unit", choices=UNITS, default="m", help="unit of both columns (default: m)")
    parser.add_argument("--z-unit", choices=UNITS, help="unit of the heights, if another one")
    parser.add_argument("--center", type=float, help="x of the axis, in the unit of the scan (default: by symmetry)")
    parser.add_argument("--radius", type=float, help="largest radius, in the unit of the scan (default: all there is)")
    options = parser.parse_args(arguments)
    factor = UNITS[options.unit]
    try:
        scan = read_scan(options.scan, options.unit, options.z_unit)
        fit = fit_scan(
            scan,
            None if options.center is None else options.center * factor,
            None if options.radius is None else options.radius * factor,
        )
        write_table(fit, options.output, options.scan.name)
        from .profile_picture import draw

        picture = draw(fit, options.output.with_suffix(".png"), options.scan.name)
    except (ScanError, TextTableError, OSError) as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 1
    print("\n".join([*summary(fit), f"table: {options.output}, r and f in m", f"picture: {picture}"]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
