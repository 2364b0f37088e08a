"""A plain model to test against: a row of springs with Coulomb friction under a sphere.

Each spring follows eq. (13) of the method of dimensionality reduction; no wear, many small
sub-steps.
"""

import numpy as np
from closed_forms import E_STAR, G_STAR, MU


class SphereOnSprings:
    """Sphere of the given radius, loads up to `largest_force`; midpoints of equal cells."""

    def __init__(self, radius, largest_force, springs=20_000):
        self.radius = radius
        reach = (3 * largest_force * radius / (4 * E_STAR)) ** (1 / 3)
        self.cell = reach / springs
        self.position = (np.arange(springs) + 0.5) * self.cell
        self.stretch = np.zeros(springs)
        self.force = self.displacement = 0.0

    def move(self, force, displacement, substeps=100):
        """Straight line in (F_N, U); returns the tangential force at its end."""
        forces = np.linspace(self.force, force, substeps + 1)[1:]
        step = (displacement - self.displacement) / substeps
        for normal in forces:
            depth = (3 * max(normal, 0) / (4 * E_STAR)) ** (2 / 3) * self.radius ** (-1 / 3)
            room = MU * E_STAR / G_STAR * np.clip(depth - self.position**2 / self.radius, 0, None)
            self.stretch = np.clip(self.stretch + step, -room, room)
        self.force, self.displacement = force, displacement
        return 2 * G_STAR * self.cell * self.stretch.sum()
