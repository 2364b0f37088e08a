"""Least squares of a line scan by the fewest shapes with monotone images that explain it."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, log

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, nnls

from .image_shapes import SHARP, SPHERE, Array, FlatTip, Shape, candidates
from .line_scan import FEWEST_POINTS, Scan, ScanError

USUAL_TILT = 3.5e-3
"""A usual error of alignment (0.2°), rad. It decides between tilt and centre on a sphere."""

MOST_SHAPES, SHORT_LIST = 12, 8
"""Shapes of a profile; candidates that are tried for the next one."""

LEAST_PITCHES = 3
"""Shapes of a smaller radius, in units of the distance of the points, are not looked for."""

LEAST_NOISE = 1e-5
"""Smallest standard deviation that is assumed, in units of the height range."""


class _Columns:
    """Least squares of heights by tilt, offset and shapes. Lengths in units of the half-width."""

    def __init__(self, x: Array, z: Array, tilt_weight: float) -> None:
        """`tilt_weight`: what a tilt of 1 counts as, in units of z."""
        self.x, self.radius = x, np.abs(x)
        self.tilt_weight = tilt_weight
        self.free, _ = np.linalg.qr(
            self._with_prior(np.column_stack([np.ones_like(x), x]), tilt_weight)
        )
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
        return np.sum(
            [c * shape.profile(self.radius) for c, shape in zip(coefficients, shapes)], axis=0
        )

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


def _with_one_more(
    columns: _Columns, shapes: list[Shape], known: Sequence[Shape], noise: float
) -> list[Shape] | None:
    """The known shapes and the one that lowers the sum of squares most, beyond its price.

    None if no shape is worth its price.
    """
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

    ln n for each number that is fitted to n points, and 4 ln m more for a shape that is no sphere
    and was chosen among m candidates. This is an extended Bayesian information criterion. It is
    strict because a feature that does not exist spoils light loads most.
    """
    is_sphere = shape in SPHERE
    return log(points) * max(len(shape.positions), 1) + (0.0 if is_sphere else 4 * log(count))


class Window:
    """The points within `width` of a centre, in units of that width and of their height range."""

    def __init__(
        self,
        scan: Scan,
        centre: float,
        width: float,
        keep: NDArray[np.bool_],
        usual_tilt: float = USUAL_TILT,
    ) -> None:
        self.inside = (np.abs(scan.x - centre) <= width * (1 + 1e-9)) & keep
        self.centre, self.width, self.usual_tilt = centre, width, usual_tilt
        x, z = scan.x[self.inside], scan.z[self.inside]
        if len(x) < FEWEST_POINTS:
            raise ScanError(
                f"{len(x)} point(s) within {width:g} m of the centre, x = {centre:g} m, "
                f"but at least {FEWEST_POINTS} "
                "are needed: scan further on both sides, or give another --center"
            )
        self.rise = float(np.ptp(z))
        if self.rise == 0.0:
            raise ScanError(f"the heights are all {z[0]:g} m: scan over the flanks of the body")
        self.x, self.z = (x - centre) / width, (z - z.mean()) / self.rise
        self.candidates = candidates(least=LEAST_PITCHES * float(np.median(np.diff(self.x))))
        self.candidate_count = len(self.candidates)

    def columns(self, shift: float, noise: float) -> _Columns:
        """Least squares about the centre moved by `shift`; `noise` is the deviation of a point."""
        return _Columns(self.x - shift, self.z, self.tilt_weight(noise))

    def tilt_weight(self, noise: float) -> float:
        """A tilt in units times this is a usual tilt times the standard deviation."""
        return max(noise, LEAST_NOISE) * self.rise / (self.width * self.usual_tilt)

    def noise(self, left: Array, count: int) -> float:
        """Standard deviation of a point from the residual of a fit of `count` shapes."""
        return max(float(np.sqrt(left @ left / max(len(left) - 3 - count, 1))), LEAST_NOISE)


@dataclass(frozen=True)
class _Model:
    """Shapes about a centre, and how well they explain a window."""

    shift: float
    shapes: list[Shape]
    cost: float
    """Sum of squares and prices, in units of noise²."""


def _refined(
    window: Window, shapes: list[Shape], noise: float, shift: float, centre_is_free: bool
) -> _Model:
    """Least squares over the centre and the positions of the shapes."""
    counts = [len(shape.positions) for shape in shapes]

    def moved(values: Array) -> tuple[float, list[Shape]]:
        positions = iter(values[1:] if centre_is_free else values)
        placed = [
            shape.moved([float(next(positions)) for _ in range(n)])
            for shape, n in zip(shapes, counts)
        ]
        return (float(values[0]) if centre_is_free else shift), placed

    def left(values: Array) -> Array:
        at, placed = moved(values)
        return window.columns(at, noise).fit(placed)[1] / noise

    free = [(shift, shift - 0.2, shift + 0.2)] if centre_is_free else []
    free += [position for shape in shapes for position in shape.positions]
    best = np.zeros(0)
    if free:
        start, low, high = np.array(free).T
        best = least_squares(
            left, start, bounds=(low, high), diff_step=1e-5, x_scale=0.1, max_nfev=30
        ).x
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


def best_model(
    window: Window, noise: float, centre_is_free: bool, most: int = MOST_SHAPES
) -> _Model | None:
    """The fewest shapes, `most` at most, that explain the heights within their noise; none if the
    heights do not rise.

    Shapes are added to a sphere one by one. Centre and positions are refined each time. Then shapes
    that are no longer needed are left out.
    """
    columns = window.columns(0.0, noise)
    coefficients, _ = columns.fit(SPHERE)
    sphere = [shape for shape, c in zip(SPHERE, coefficients) if c > 0]
    model = _refined(window, sphere, noise, 0.0, centre_is_free) if sphere else None
    if model and model.cost * noise**2 >= columns.target @ columns.target:
        model = None
    while model is None or len(model.shapes) < most:
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
        promising = sorted(options, key=lambda option: float(np.sum(columns.fit(option)[1] ** 2)))[
            :2
        ]
        refined = [
            _refined(window, option, noise, model.shift, centre_is_free) for option in promising
        ]
        simpler = min(refined, key=lambda one: one.cost)
        if simpler.cost >= model.cost:
            break
        model = simpler
    return model
