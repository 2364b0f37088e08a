"""Exact solutions of normal and tangential contact of bodies of revolution, for the tests.

Written from the 1-D image g(x) of each profile: F_N = 2 E* ∫₀ᵃ x g'(x) dx, p(r) = (E*/π) ∫ᵣᵃ g'(x)
dx / √(x²−r²). SI units throughout.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import gamma

YOUNG, POISSON = 210e9, 0.3  # the FMU's default materials: steel on steel
E_STAR = YOUNG / (2 * (1 - POISSON**2))
G_STAR = YOUNG / ((1 + POISSON) * (2 - POISSON))
MU = 0.6
SLIDING = MU * E_STAR / G_STAR  # u_max / d


@dataclass(frozen=True)
class Sphere:
    radius: float = 0.01
    exponent = 1.5  # m of F_N ∝ dᵐ

    def parameters(self):
        return {"profile": "parabola", "radius": self.radius}

    def depth(self, a):
        return a**2 / self.radius

    def force(self, a):
        return 4 / 3 * E_STAR * a**3 / self.radius

    def pressure(self, r, a):
        return 2 * E_STAR / (np.pi * self.radius) * np.sqrt(np.clip(a**2 - r**2, 0, None))


@dataclass(frozen=True)
class Cone:
    slope: float = 0.02  # rad
    exponent = 2.0

    def parameters(self):
        return {"profile": "cone", "cone_slope": self.slope}

    def depth(self, a):
        return np.pi / 2 * a * np.tan(self.slope)

    def force(self, a):
        return np.pi / 2 * E_STAR * a**2 * np.tan(self.slope)

    def pressure(self, r, a):
        return E_STAR / 2 * np.tan(self.slope) * np.arccosh(np.maximum(a / r, 1))


@dataclass(frozen=True)
class PowerLaw:
    power: float = 4.0
    coefficient: float = 2e9  # m^(1-n)

    def parameters(self):
        return {"profile": "power_law", "exponent": self.power, "coefficient": self.coefficient}

    @property
    def stretch(self):
        """κ of g(x) = κ A xⁿ."""
        return np.sqrt(np.pi) * gamma(self.power / 2 + 1) / gamma((self.power + 1) / 2)

    def depth(self, a):
        return self.stretch * self.coefficient * a**self.power

    def force(self, a):
        return 2 * E_STAR * self.power / (self.power + 1) * self.depth(a) * a

    def pressure(self, r, a):
        """By quadrature with x = √(r² + s²), which takes the root singularity away."""
        n, top = self.power, np.sqrt(np.clip(a**2 - np.asarray(r) ** 2, 0, None))
        slope = n * self.stretch * self.coefficient
        values = [
            quad(lambda s, r=r: (r**2 + s**2) ** (n / 2 - 1), 0, t, epsrel=1e-12)[0]
            for r, t in zip(r, top)
        ]
        return E_STAR / np.pi * slope * np.array(values)


@dataclass(frozen=True)
class BluntedSphere:
    radius: float = 0.01
    flat: float = 1e-4

    def parameters(self):
        return {"profile": "blunted_sphere", "radius": self.radius, "flat_radius": self.flat}

    def depth(self, a):
        return a / self.radius * np.sqrt(a**2 - self.flat**2)

    def force(self, a):
        return (
            2
            * E_STAR
            / (3 * self.radius)
            * (2 * a**2 + self.flat**2)
            * np.sqrt(a**2 - self.flat**2)
        )

    def pressure_at_axis(self, a):
        s = np.sqrt(a**2 - self.flat**2)
        return E_STAR / (np.pi * self.radius) * (2 * s - self.flat * np.arccos(self.flat / a))


@dataclass(frozen=True)
class RoundedPunch:
    radius: float = 0.01
    flat: float = 1e-4

    def parameters(self):
        return {"profile": "rounded_punch", "radius": self.radius, "flat_radius": self.flat}

    def depth(self, a):
        return (
            a / self.radius * (np.sqrt(a**2 - self.flat**2) - self.flat * np.arccos(self.flat / a))
        )

    def force(self, a):
        """From g' = [2√(x²−b²) − b acos(b/x)]/R."""
        b, s = self.flat, np.sqrt(a**2 - self.flat**2)
        return 2 * E_STAR / self.radius * (2 / 3 * s**3 - b / 2 * (a**2 * np.arccos(b / a) - b * s))

    def pressure_at_axis(self, a):
        b = self.flat
        value, _ = quad(
            lambda x: (2 * np.sqrt(x**2 - b**2) - b * np.arccos(b / x)) / x, b, a, epsrel=1e-12
        )
        return E_STAR / (np.pi * self.radius) * value


def contact_radius(shape, force):
    """a at which the shape carries the force."""
    least = getattr(shape, "flat", 0.0) * (1 + 1e-14) or 1e-9
    return brentq(lambda a: shape.force(a) - force, least, 0.01, xtol=1e-18, rtol=1e-15)


def force_at_depth(shape, depth):
    """F_N(d); 0 where the bodies are apart."""
    least = getattr(shape, "flat", 0.0) * (1 + 1e-14) or 1e-12
    if depth <= shape.depth(least):
        return 0.0
    return shape.force(
        brentq(lambda a: shape.depth(a) - depth, least, 0.01, xtol=1e-18, rtol=1e-15)
    )


class Tangential:
    """T(U) of a shape under a constant load: first loading, reversals (Masing), work of a loop."""

    def __init__(self, shape, normal_force):
        self.shape, self.normal_force = shape, normal_force
        self.contact_radius = contact_radius(shape, normal_force)
        self.depth = shape.depth(self.contact_radius)
        self.full_slip = SLIDING * self.depth
        self.limit = MU * normal_force

    def loading(self, displacement):
        """μ [F(d) − F(d − G* U/(μ E*))]: the tangential contact as a difference of normal
        contacts.
        """
        lost = [
            force_at_depth(self.shape, self.depth - u / SLIDING)
            for u in np.atleast_1d(displacement)
        ]
        return self.limit - MU * np.array(lost)

    def reversal(self, displacement, amplitude):
        """T on the way back from +amplitude."""
        return self.loading(amplitude) - 2 * self.loading(
            (amplitude - np.atleast_1d(displacement)) / 2
        )

    def loop_work(self, amplitude):
        """∮ T dU of the closed loop between ±amplitude."""
        reached = min(amplitude, self.full_slip)
        area, _ = quad(lambda u: self.loading(u)[0], 0, reached, epsrel=1e-10)
        area += self.limit * (amplitude - reached)
        return 8 * area - 4 * amplitude * self.loading(amplitude)[0]
