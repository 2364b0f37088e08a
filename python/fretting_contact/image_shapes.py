"""Profiles whose 1-D MDR image rises monotonically, in closed form.

The image of a profile f(r) is g(x) = x ∫₀ˣ f'(r) dr/√(x² − r²). Each shape below has an image that
never falls. A sum of such shapes with coefficients that are not negative has one, too.

Lengths are in units of the largest radius of the scan.

| shape | image g(x), X = x² | profile f(r), ρ = r² |
| --- | --- | --- |
| power n | κₙ xⁿ | rⁿ |
| ramp up to B = b² | min(X, B) | ρ/2 for ρ < B, else [ρ asin(b/r) − b√(ρ − B) + 2B acos(b/r)]/π |
| flat tip of radius b | x√(X − B) for X > B = b² | (ρ − B)/2 for ρ > B |
| edge rounded over w | quadrature | [z + √(z² + s²)]/4 less its value at 0; z = ρ − B, s = 2Bw |

The last one is convex in ρ: a sum of flat tips, whose image is monotone, too.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import gamma, pi, sqrt
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

Array = NDArray[np.float64]

SHARP, LEAST_WIDTH = 0.0, 0.02
"""Width of a sharp edge, and least width of a rounded edge, in units of the radius of the flat tip.
"""

QUADRATURE = tuple(0.5 * (np.polynomial.legendre.leggauss(200) + np.array([[1.0], [0.0]])))
"""Points and weights on 0 < t < 1."""


class Shape(Protocol):
    """A profile with a monotone image."""

    def profile(self, r: Array) -> Array:
        """f(r)."""

    def image(self, x: Array) -> Array:
        """g(x)."""

    def moved(self, positions: Sequence[float]) -> "Shape":
        """The same shape at other positions."""

    def scaled(self, factor: float) -> "Shape":
        """The same shape with all its radii multiplied."""

    @property
    def positions(self) -> tuple[tuple[float, float, float], ...]:
        """What may be fitted: value, lower and upper bound of each."""


def ramp_profile(r: Array, corner: float) -> Array:
    """Profile of the image min(x², corner²)."""
    outside = np.maximum(r, corner)
    share = corner / np.where(outside > 0, outside, 1.0)
    leg = np.sqrt(np.maximum(outside**2 - corner**2, 0.0))
    beyond = (outside**2 * np.arcsin(share) - corner * leg + 2 * corner**2 * np.arccos(share)) / pi
    return np.where(r <= corner, r**2 / 2, beyond)


@dataclass(frozen=True)
class Power:
    """f = rⁿ: a cone, a parabola, and what a circle has beyond its parabola."""

    exponent: float

    def profile(self, r: Array) -> Array:
        return r**self.exponent

    def image(self, x: Array) -> Array:
        n = self.exponent
        return sqrt(pi) * gamma(n / 2 + 1) / gamma((n + 1) / 2) * x**n

    def moved(self, positions: Sequence[float]) -> "Power":
        return self

    def scaled(self, factor: float) -> "Power":
        return self

    @property
    def positions(self) -> tuple[tuple[float, float, float], ...]:
        return ()


SPHERE: list[Shape] = [Power(2), Power(4), Power(6)]
"""A circle is a sum of these: R - √(R² - r²) = r²/2R + r⁴/8R³ + r⁶/16R⁵ + ..."""


@dataclass(frozen=True)
class Ramp:
    """An image that rises in x² between two radii and is constant elsewhere: a worn wall, a rim."""

    start: float
    end: float

    def profile(self, r: Array) -> Array:
        return ramp_profile(r, self.end) - ramp_profile(r, self.start)

    def image(self, x: Array) -> Array:
        return np.clip(x**2, self.start**2, self.end**2) - self.start**2

    def scaled(self, factor: float) -> "Ramp":
        return Ramp(self.start * factor, self.end * factor)

    def moved(self, positions: Sequence[float]) -> "Ramp":
        (end,) = positions
        return Ramp(self.start * end / self.end, end)

    @property
    def positions(self) -> tuple[tuple[float, float, float], ...]:
        return (_radius_bounds(self.end),)


@dataclass(frozen=True)
class FlatTip:
    """A sphere whose tip is cut off flat.

    The edge is rounded over some `width` times the radius of the flat to either side.
    """

    flat: float
    width: float

    def profile(self, r: Array) -> Array:
        z = r**2 - self.flat**2
        if self.is_sharp:
            return np.maximum(z, 0.0) / 2
        base = sqrt(self.flat**4 + self._softness**2) - self.flat**2
        return (z + np.sqrt(z**2 + self._softness**2) - base) / 4

    def image(self, x: Array) -> Array:
        if self.is_sharp:
            return x * np.sqrt(np.maximum(x**2 - self.flat**2, 0.0))
        # with r² = x² (1 - t²) the root in the denominator drops out: g = 2x² ∫₀¹ (df/dρ) dt
        t, weights = QUADRATURE
        z = np.asarray(x)[..., None] ** 2 * (1 - t**2) - self.flat**2
        slope = (1 + z / np.sqrt(z**2 + self._softness**2)) / 4
        return 2 * np.asarray(x) ** 2 * (slope @ weights)

    @property
    def _softness(self) -> float:
        return 2 * self.flat**2 * self.width

    def scaled(self, factor: float) -> "FlatTip":
        return FlatTip(self.flat * factor, self.width)

    def moved(self, positions: Sequence[float]) -> "FlatTip":
        flat, *width = positions
        return FlatTip(flat, width[0] if width else self.width)

    @property
    def is_sharp(self) -> bool:
        """Whether the edge has no width of its own to be fitted."""
        return self.width <= SHARP

    @property
    def positions(self) -> tuple[tuple[float, float, float], ...]:
        flat = _radius_bounds(self.flat)
        return (flat,) if self.is_sharp else (flat, (self.width, LEAST_WIDTH, 1.5))


def _radius_bounds(radius: float) -> tuple[float, float, float]:
    return radius, 0.25 * radius, 0.5 * (1 + radius)


def candidates(count: int = 24, least: float = 0.0) -> list[Shape]:
    """The shapes from which a profile is put together: none has a radius below `least`.

    Their radii lie closer near the axis, where light loads are carried.
    """
    radii = [float(radius) for radius in least + (1 - least) * (np.arange(1, count) / count) ** 1.5]
    shapes: list[Shape] = [*SPHERE, Power(1)]
    shapes += [FlatTip(radius, width) for radius in radii for width in (SHARP, 0.1, 0.3, 0.8)]
    shapes += [Ramp(0.0, radius) for radius in radii]
    shapes += [Ramp(start, end) for step in (1, 4) for start, end in zip(radii, radii[step:])]
    return shapes


def profile_of_image(x: Array, image: Array) -> Array:
    """Heights at the radii x of the profile whose image has the given values there and is linear in
    x² between them.

    f(r) = (2/π) ∫₀ʳ g dx/√(r² − x²). The FMU solves this relation for the image and gets these
    values back.
    """
    slopes = np.diff(image) / np.diff(x**2)
    corners = np.array([ramp_profile(x, corner) for corner in x])
    return slopes @ np.diff(corners, axis=0) + image[0]


def image_of_table(r: Array, f: Array) -> Array:
    """The image at the radii of a table, as the FMU computes it: see `profile_of_image`."""
    corners = np.array([ramp_profile(r, corner) for corner in r])
    # heights from increments of the image: a lower triangular matrix
    weights = np.diff(corners, axis=0)[:, 1:].T / np.diff(r**2)
    return (
        np.concatenate([[0.0], np.cumsum(solve_triangular(weights, f[1:] - f[0], lower=True))])
        + f[0]
    )
