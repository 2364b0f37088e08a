"""A rough surface beds in: a thousand summits on one rigid body, 100,000 cycles.

    python bedding_in.py [FrettingContact.fmu] [picture.png]

The heights are normal (Greenwood and Williamson). At first the highest summits carry the load and
slip; as they wear, the body comes down, lower summits touch, and more of the contact sticks.
"""

import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np
from fretting_contact import Contact

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
PICTURE = Path(sys.argv[2] if len(sys.argv) > 2 else Path(tempfile.gettempdir()) / "bedding_in.png")
SUMMITS, SIGMA = 1000, 0.5e-6  # number; standard deviation of the heights, m
CYCLES = np.array([0, 1, 10, 100, 1_000, 10_000, 100_000])
SURFACE = {
    "radius": "300 um",
    "normal_force": 15.0,
    "displacement_amplitude": "0.5 um",
    "loading": "cyclic",
    "resolution": 16,
    "tolerance": 1e-2,
}
READ = [
    "contact_count_in_touch",
    "indentation_depth",
    "wear_depth",
    "wear_volume",
    "tangential_force",
]


def contacts(folder):
    """Writes offset, x, y and radius factor of each summit, in m."""
    random = np.random.default_rng(1966)
    heights = random.normal(0.0, SIGMA, SUMMITS)
    places = random.uniform(-1e-3, 1e-3, (SUMMITS, 2))
    factors = random.uniform(0.7, 1.3, SUMMITS)
    path = Path(folder) / "contacts.txt"
    np.savetxt(
        path,
        np.column_stack([heights.max() - heights, places, factors]),
        header="offset x y factor",
    )
    return path


def bed_in():
    """What READ lists, after each of CYCLES."""
    with (
        tempfile.TemporaryDirectory() as folder,
        Contact(fmu=FMU, contacts_file=contacts(folder), **SURFACE) as joint,
    ):
        rows = []
        for cycles in np.diff(CYCLES, prepend=0):
            joint.step(float(cycles) if cycles else 1e-9)  # at 1 Hz a second is a cycle
            rows.append(joint.get(*READ))
    return np.array(rows).T


def draw(count, approach, depth, force):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    at = np.maximum(CYCLES, 0.1)  # the start, on a logarithmic axis
    left.semilogx(at, 1e6 * approach, "o-", label="approach of the body")
    left.semilogx(at, 1e6 * depth, "s-", label="deepest wear")
    left.set(xlabel="cycles", ylabel="µm")
    left.legend()
    right.semilogx(at, count, "o-", color="C2")
    right.set(xlabel="cycles", ylabel="summits in touch")
    right.yaxis.label.set_color("C2")
    other = right.twinx()
    other.semilogx(at, force, "s-", color="C3")
    other.set_ylabel("amplitude of the tangential force, N", color="C3")
    figure.savefig(PICTURE, dpi=120)


if __name__ == "__main__":
    count, approach, depth, volume, force = bed_in()
    for row in zip(CYCLES, count, approach, depth, volume, force):
        line = "after {:6d} cycles: {:3.0f} in touch, approach {:.4e} m, "
        print((line + "wear {:.3e} m, {:.3e} m3, T {:.4f} N").format(*row))
    draw(count, approach, depth, force)
    print(f"picture: {PICTURE}")
