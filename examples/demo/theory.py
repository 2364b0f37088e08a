"""Closed forms that the demo draws beside the FMU: the sphere of radius R under a constant load.

Mindlin–Cattaneo with the effective moduli E* and G* of the pair; θ = U/u_max, u_max = μ d E*/G*.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Sphere:
    """An elastic ball on a flat of the same material. SI units; the defaults are 52100 steel."""

    normal_force: float = 100.0
    radius: float = 0.01
    friction: float = 0.6
    youngs_modulus: float = 210e9
    poisson_ratio: float = 0.3

    @property
    def plane_modulus(self):
        """E*, Pa."""
        return self.youngs_modulus / (2 * (1 - self.poisson_ratio**2))

    @property
    def shear_modulus(self):
        """G*, Pa."""
        return self.youngs_modulus / ((1 + self.poisson_ratio) * (2 - self.poisson_ratio))

    @property
    def contact_radius(self):
        """a, m, from F_N = (4/3) E* a³/R."""
        return (3 * self.normal_force * self.radius / (4 * self.plane_modulus)) ** (1 / 3)

    @property
    def depth(self):
        """d = a²/R, m."""
        return self.contact_radius**2 / self.radius

    @property
    def peak_pressure(self):
        """p₀ = 3 F_N / (2 π a²), Pa."""
        return 1.5 * self.normal_force / (np.pi * self.contact_radius**2)

    @property
    def full_slip(self):
        """u_max, m: the displacement at which the last point begins to slip."""
        return self.friction * self.depth * self.plane_modulus / self.shear_modulus

    @property
    def limit(self):
        """μ F_N, N."""
        return self.friction * self.normal_force

    @property
    def stiffness(self):
        """2 G* a, N/m: the tangential stiffness while all points stick."""
        return 2 * self.shear_modulus * self.contact_radius

    def loading(self, displacement):
        """T on first loading from rest, N."""
        return self.limit * (1 - np.clip(1 - displacement / self.full_slip, 0, None) ** 1.5)

    def reversal(self, displacement, amplitude):
        """T on the way back from +amplitude (Masing), N."""
        return self.loading(amplitude) - 2 * self.loading((amplitude - displacement) / 2)

    def loop_work(self, amplitude):
        """Friction work of one closed loop, J."""
        theta = amplitude / self.full_slip
        if theta > 1:
            return 4 * self.limit * (amplitude - 0.8 * self.full_slip)
        rest = 1 - theta
        return (
            self.limit
            * self.full_slip
            * (4 * theta + 4 * theta * rest**1.5 - 3.2 * (1 - rest**2.5))
        )
