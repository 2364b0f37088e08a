"""A greased steel pair that runs in: friction rises while the grease is squeezed out.

    python running_in.py [FrettingContact.fmu]

A ball of 10 mm radius under 100 N oscillates by 2 um. The grease lets it slide at first, with a
coefficient of friction of 0.15. While friction work squeezes the grease out, friction rises to
0.7: gross slip becomes partial slip, the work per cycle falls, and so does the wear. Beside it
the same pair at constant friction, greased and dry. The picture running_in.png is written
beside the FMU, or to the working directory.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from fretting_contact import Contact

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
PICTURE = Path(FMU).with_name("running_in.png") if FMU else Path("running_in.png")
FORCE, AMPLITUDE, CYCLES = 100.0, 2e-6, 3000  # N, m
GREASED, DRY, ENERGY = 0.15, 0.7, 0.15  # J
RUNS_IN = {
    "friction_coefficient": GREASED,
    "friction_coefficient_final": DRY,
    "running_in_energy": ENERGY,
}


def history(**friction):
    """Cycles, coefficient of friction, amplitude of the force and worn volume, 60 points."""
    at = np.concatenate(([0], np.geomspace(1, CYCLES, 60).round()))
    names = ("friction_coefficient_now", "tangential_force", "wear_volume")
    rows = []
    with Contact(
        fmu=FMU, loading="cyclic", normal_force=FORCE, displacement_amplitude=AMPLITUDE, **friction
    ) as contact:
        for cycles in np.diff(at):
            contact.step(cycles)  # 1 Hz
            rows.append(contact.get(*names))
    return at[1:], np.array(rows).T


def first_loops(count):
    """Displacement and force of the first cycles, followed step by step."""
    phase = np.arange(1, 80 * count + 1) * np.pi / 40
    rows = []
    with Contact(fmu=FMU, normal_force=FORCE, tangential_displacement=0.0, **RUNS_IN) as contact:
        for displacement in AMPLITUDE * np.sin(phase):
            contact.step(1 / 80, tangential_displacement=displacement)
            rows.append((displacement, contact["tangential_force"]))
    return np.array(rows).T


if __name__ == "__main__":
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.0), layout="constrained")
    count = 400
    displacement, force = first_loops(count)
    for cycle, colour in zip((1, 50, 150, count), plt.cm.viridis(np.linspace(0, 0.9, 4))):
        rows = slice(80 * (cycle - 1) + (0 if cycle == 1 else -1), 80 * cycle)
        axes[0].plot(displacement[rows] * 1e6, force[rows], color=colour, label=f"cycle {cycle}")
    runs_in = {"runs in": RUNS_IN}
    constant = {f"constant {mu}": {"friction_coefficient": mu} for mu in (GREASED, DRY)}
    for name, friction in (runs_in | constant).items():
        cycles, (mu, amplitude, volume) = history(**friction)
        axes[1].semilogx(cycles, mu, label=name)
        axes[2].loglog(cycles, volume * 1e18, label=name)
        print(
            f"{name:13s} after {CYCLES} cycles: friction {mu[-1]:.3f}, "
            f"force {amplitude[-1]:6.2f} N, worn {volume[-1] * 1e18:6.0f} µm³"
        )
    axes[0].set(xlabel="displacement (µm)", ylabel="tangential force (N)")
    axes[1].set(xlabel="cycles", ylabel="coefficient of friction", ylim=(0, 0.8))
    axes[2].set(xlabel="cycles", ylabel="worn volume (µm³)")
    for ax in axes:
        ax.legend()
        ax.grid(alpha=0.3)
    figure.savefig(PICTURE, dpi=150)
