"""Makes measured_loop.csv: a synthetic friction loop by Mindlin's formulas.

python make_measured_loop.py
"""

from pathlib import Path

import numpy as np

FORCE, RADIUS, FRICTION, RIG = 100.0, 0.01, 0.62, 24e6  # N, m, 1, N/m
NORMAL, SHEAR = 210e9 / (2 * 0.91), 2 * 210e9 / 2.6 / 1.7  # E*, G* of steel on steel, Pa
DRIVE, POINTS, NOISE = 8e-6, 60, 0.5  # m, per half, N

indentation = (FORCE * 3 / (4 * NORMAL * RADIUS**0.5)) ** (2 / 3)
full_slip = FRICTION * NORMAL / SHEAR * indentation


def virgin(u):
    return FRICTION * FORCE * (1 - np.clip(1 - u / full_slip, 0, None) ** 1.5)


def contact_at(drive, law):
    """Displacement of the contact, and its force, behind the rig."""
    low, high = -DRIVE, DRIVE
    for _ in range(100):
        u = (low + high) / 2
        low, high = (u, high) if u + law(u) / RIG < drive else (low, u)
    return u, law(u)


top, force_at_top = contact_at(DRIVE, virgin)
down = DRIVE * np.cos(np.pi * np.arange(POINTS) / POINTS)
forces = [contact_at(d, lambda u: force_at_top - 2 * virgin((top - u) / 2))[1] for d in down]
drive = np.concatenate([down, -down])
noise = NOISE * np.random.default_rng(7).standard_normal(2 * POINTS)
table = np.column_stack([drive, np.concatenate([forces, np.negative(forces)]) + noise])
header = "synthetic displacement of the drive (m),synthetic force (N)"
np.savetxt(
    Path(__file__).with_name("measured_loop.csv"),
    table,
    fmt="%.6e",
    delimiter=",",
    header=header,
    comments="",
)
