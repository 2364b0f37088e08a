"""The bodies of the published cases under 100 N: profile, 1-D image, scales of the contact.

A body that wears at constant depth ends as `FinalShape`. SI units throughout.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from theory import Sphere

STEEL = Sphere()  # the pair of materials, the load and the ball
CONE_SLOPE = 0.02  # rad
BLUNT_RATIO = 0.3  # b/a₀: the paper shows a worn tip and gives no number


@dataclass(frozen=True)
class Parabola:
    """f = r²/(2R), g = x²/R."""

    name = "Parabola"
    dimensions = f"R = {1e3 * STEEL.radius:g} mm"

    @property
    def parameters(self):
        return {"profile": "parabola", "radius": STEEL.radius}

    @property
    def contact_radius(self):
        return STEEL.contact_radius

    def height(self, r):
        return r**2 / (2 * STEEL.radius)

    def image(self, x):
        return x**2 / STEEL.radius


@dataclass(frozen=True)
class Cone:
    """f = r tanθ, g = (π/2) x tanθ."""

    name = "Cone"
    dimensions = f"slope {CONE_SLOPE:g} rad"

    @property
    def parameters(self):
        return {"profile": "cone", "cone_slope": CONE_SLOPE}

    @property
    def contact_radius(self):
        """From F_N = (π/2) E* a² tanθ."""
        return np.sqrt(2 * STEEL.normal_force / (np.pi * STEEL.plane_modulus * np.tan(CONE_SLOPE)))

    def height(self, r):
        return r * np.tan(CONE_SLOPE)

    def image(self, x):
        return np.pi / 2 * x * np.tan(CONE_SLOPE)


@dataclass(frozen=True)
class BluntedParabola:
    """f = (r² − b²)/(2R) and g = (x/R) √(x² − b²) outside the flat tip r < b."""

    name = "Parabola with a worn tip"
    dimensions = f"R = {1e3 * STEEL.radius:g} mm, b = {BLUNT_RATIO:g} a₀"

    @property
    def parameters(self):
        return {"profile": "blunted_sphere", "radius": STEEL.radius, "flat_radius": self.flat}

    @cached_property
    def contact_radius(self):
        """From F_N = (2E*/3R) (2a² + b²) √(a² − b²) with b = BLUNT_RATIO·a."""
        shape = (
            2
            / 3
            * STEEL.plane_modulus
            / STEEL.radius
            * (2 + BLUNT_RATIO**2)
            * np.sqrt(1 - BLUNT_RATIO**2)
        )
        return (STEEL.normal_force / shape) ** (1 / 3)

    @property
    def flat(self):
        return BLUNT_RATIO * self.contact_radius

    def height(self, r):
        return np.clip(r**2 - self.flat**2, 0, None) / (2 * STEEL.radius)

    def image(self, x):
        return x / STEEL.radius * np.sqrt(np.clip(x**2 - self.flat**2, 0, None))


@dataclass(frozen=True)
class FinalShape:
    """Where the wear of the parabola ends that sticks up to c at constant depth d
    (Popov 2014): g = g₀ inside c, d outside.

    f = (1/πR) [r² asin(c/r) − c √(r² − c²)] + (2/π) d acos(c/r), until that meets the unworn
    profile.
    """

    depth: float
    stick_radius: float

    def height(self, r):
        c = self.stick_radius
        outside = np.maximum(r, c)
        chord = np.sqrt(outside**2 - c**2)
        stuck = (outside**2 * np.arcsin(c / outside) - c * chord) / (np.pi * STEEL.radius)
        flat = 2 / np.pi * self.depth * np.arccos(c / outside)
        unworn = Parabola().height(r)
        return np.where(r > c, np.maximum(stuck + flat, unworn), unworn)

    @property
    def normal_force(self):
        """What the stick disc carries, N: 2E* ∫₀ᶜ (d − g₀) dx."""
        c = self.stick_radius
        return 2 * STEEL.plane_modulus * (self.depth * c - c**3 / (3 * STEEL.radius))
