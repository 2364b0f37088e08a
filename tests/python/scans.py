"""Synthetic line scans of bodies that are known without noise, and the contacts of both."""

from dataclasses import dataclass
from math import radians, tan
from pathlib import Path

import numpy as np
from conftest import ROOT  # noqa: F401  # puts python/ on the path
from fretting_contact.image_shapes import Array
from fretting_contact.profile import Scan

TILT = radians(0.1)
BALL_RADIUS = 0.01  # m


@dataclass(frozen=True)
class Body:
    """A body of revolution: its heights, how far it is scanned, and how the FMU is given it without
    noise.
    """

    name: str
    half_width: float  # m
    parameters: dict
    flat: float = 0.0  # m
    edge: float = 0.0  # m, half the width over which the edge of the flat is rounded
    radius: float = BALL_RADIUS  # m

    def height(self, r: Array) -> Array:
        """f(r), m."""
        if self.edge:
            softness, z = 2 * self.flat * self.edge, r**2 - self.flat**2
            base = np.hypot(self.flat**2, softness) - self.flat**2
            return (z + np.hypot(z, softness) - base) / (4 * self.radius)
        if self.flat:
            return np.maximum(r**2 - self.flat**2, 0.0) / (2 * self.radius)
        if self.parameters.get("profile") == "table":
            return r**2 / (
                self.radius + np.sqrt(self.radius**2 - r**2)
            )  # the circle, without cancellation
        return r**2 / (2 * self.radius)

    def scan(self, noise: float, pitch: float, seed: int) -> Scan:
        """A tilted scan with the apex off its centre; noise and pitch in m."""
        x = np.arange(-self.half_width, self.half_width + 0.5 * pitch, pitch)
        centre = 0.08 * self.half_width
        heights = 3e-6 + tan(TILT) * x - self.height(np.abs(x - centre))
        return Scan(x, heights + noise * np.random.default_rng(seed).standard_normal(len(x)))

    def start_values(self, folder: Path) -> dict:
        """Parameters of the FMU for the body without noise."""
        if self.parameters.get("profile") != "table":
            return self.parameters
        path = folder / f"{self.name}.txt"
        r = self.half_width * (np.arange(1001) / 1000) ** 1.5
        np.savetxt(path, np.column_stack([r, self.height(r)]), fmt="%.16e")
        return self.parameters | {"profile_file": str(path)}


BALL = Body("ball of 10 mm", 500e-6, {"profile": "parabola", "radius": BALL_RADIUS})
SMALL_BALL = Body("ball of 1 mm", 200e-6, {"profile": "table"}, radius=1e-3)
WORN_FLAT = Body(
    "worn flat of 100 µm",
    500e-6,
    {"profile": "blunted_sphere", "radius": BALL_RADIUS, "flat_radius": 100e-6},
    flat=100e-6,
)
SMALL_FLAT = Body(
    "worn flat of 60 µm",
    500e-6,
    {"profile": "blunted_sphere", "radius": BALL_RADIUS, "flat_radius": 60e-6},
    flat=60e-6,
)
ROUNDED_FLAT = Body(
    "worn flat of 100 µm, rounded edge", 500e-6, {"profile": "table"}, flat=100e-6, edge=30e-6
)


@dataclass(frozen=True)
class Contact:
    """A contact at one load."""

    load: float  # N
    radius: float  # m
    depth: float  # m


def at_depth(start_contact, parameters: dict, depth: float) -> Contact:
    """The contact of indentation depth `depth`, m."""
    contact = start_contact(
        **parameters, normal_control="indentation", indentation=depth, wear_coefficient=0.0
    )
    load, radius = contact.get("normal_reaction", "contact_radius")
    return Contact(load, radius, depth)


def at_load(start_contact, table: Path, load: float) -> Contact:
    """The contact of a profile table under `load`, N."""
    contact = start_contact(
        profile="table", profile_file=str(table), normal_force=load, wear_coefficient=0.0
    )
    radius, depth = contact.get("contact_radius", "indentation_depth")
    return Contact(load, radius, depth)
