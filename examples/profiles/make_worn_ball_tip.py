"""Writes worn_ball_tip.txt: a 10 mm ball whose tip is blunted and slightly wavy.

The profile is synthetic and reproducible. Its 1-D image g(x) = x ∫ f'/√(x²−r²) dr must rise
everywhere, or the contact region would not be one disc; the script checks that before it writes.
"""

from pathlib import Path

import numpy as np

RADIUS = 0.01  # m, of the ball
FLAT = 90e-6  # m, where the blunted tip goes over into the ball
EDGE = 45e-6  # m, how far that transition is rounded
LAST = 800e-6  # m, last radius of the table
POINTS = 401
WAVES = ((260e-6, 28e-9), (150e-6, 9e-9), (95e-6, 3e-9))  # wavelength and amplitude, m
SEED = 52100

HEADER = """\
Synthetic radial profile of a worn 10 mm ball, made by make_worn_ball_tip.py; not measured
It has the form of a stylus scan, averaged over all directions and low-pass filtered
column 1: radius r from the axis, m
column 2: height f above the lowest point, m"""


def heights(r):
    """Profile heights f(r), m: a softened flat tip on a ball, and waves that die out towards the
    axis.
    """
    z = r**2 - FLAT**2
    softness = 2 * FLAT * EDGE
    ball = (z + np.sqrt(z**2 + softness**2)) / (4 * RADIUS)
    f = ball - ball[0]
    phases = np.random.default_rng(SEED).uniform(0, 2 * np.pi, len(WAVES))
    for (length, amplitude), phase in zip(WAVES, phases):
        wave = np.cos(2 * np.pi * r / length + phase) - np.cos(phase)
        f = f + amplitude * wave * (1 - np.exp(-((r / 60e-6) ** 4)))
    return f


def image(r, f, x):
    """1-D image at x of the points, joined linearly in r²: each piece contributes a difference of
    square roots.
    """
    slopes = np.diff(f) / np.diff(r**2)
    roots = np.sqrt(np.clip(x[:, None] ** 2 - r[None, :] ** 2, 0, None))
    return 2 * x * ((roots[:, :-1] - roots[:, 1:]) @ slopes)


def main():
    r = np.linspace(0, LAST, POINTS)
    f = heights(r)
    if f.min() < 0:
        raise SystemExit("the profile dips below its own axis: reduce the waves")
    # Between the points of a table g has microscopic dips behind each concave kink; what matters is
    # that it rises from point to point, and by a fair share of what the plain ball's image x²/R
    # does.
    rise = np.diff(image(r, f, r)) / np.diff(r**2 / RADIUS)
    outside = r[1:] > 0.6 * FLAT
    print(
        f"image rises by {rise.min():.3f} to {rise.max():.3f} of the ball's "
        f"({rise[outside].min():.3f} outside the tip)"
    )
    if rise.min() <= 0:
        raise SystemExit(
            f"the 1-D image falls at r = {r[1 + rise.argmin()]:.3e} m: reduce the waves"
        )
    target = Path(__file__).with_name("worn_ball_tip.txt")
    np.savetxt(target, np.column_stack([r, f]), fmt="%.7e", header=HEADER, encoding="utf-8")
    print(f"{POINTS} points written to {target.name}")


if __name__ == "__main__":
    main()
