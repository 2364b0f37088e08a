"""A ball in a groove that shakes: false brinelling, with loops along and across the groove.

    python groove.py [FrettingContact.fmu]

A bearing at rest is shaken on its way to the customer. A ball of 8 mm diameter in a groove of
4.16 mm radius touches in a long ellipse, which is softer along its length: across the groove it
takes more displacement to make it slip. Loops in both directions, the work of 100,000 cycles
and the volume that they wear. The picture is groove.png, or what the second argument names.
"""

import sys

import numpy as np
from fretting_contact import Contact, drive

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
PICTURE = sys.argv[2] if len(sys.argv) > 2 else "groove.png"
BALL, GROOVE, RACE = 4e-3, 4.16e-3, 20e-3  # radii, m: the ball, the groove across, the race along
ACROSS, ALONG = 1 / (1 / BALL - 1 / GROOVE), 1 / (1 / BALL + 1 / RACE)  # relative radii
FORCE, FRICTION, WEAR_PER_WORK = 100.0, 0.15, 4e-14  # N, greased, m³/J of bearing steel
AMPLITUDES = (0.15e-6, 0.3e-6, 0.6e-6)  # m
BEARING = {"profile": "ellipse", "wear_coefficient": 0, "normal_force": FORCE}
BEARING["friction_coefficient"] = FRICTION
ACROSS_THE_GROOVE = ("across the groove", (ACROSS, ALONG), "#2f6f9f")
ALONG_THE_GROOVE = ("along the groove", (ALONG, ACROSS), "#c8641e")


def measured(radii, amplitude):
    """A loop after the first reversal; its work, and that of a cycle among many in a step."""
    turns = np.arange(321) / 160
    parameters = BEARING | {"radius_x": radii[0], "radius_y": radii[1]}
    with Contact(fmu=FMU, **parameters) as contact:
        done = drive(contact, turns, amplitude * np.sin(2 * np.pi * turns))
    loop = slice(40, 201)
    parameters |= {"loading": "cyclic", "displacement_amplitude": amplitude, "frequency": 1e5}
    with Contact(fmu=FMU, **parameters) as contact:
        contact.step(1.0)
        cycles = contact["dissipated_energy"]
    work = np.ptp(done.dissipated_energy[loop])
    return done.displacement[loop], done.tangential_force[loop], work, cycles


def shape():
    """Semi-axes across and along, and the stick region of the middle amplitude across."""
    with Contact(fmu=FMU, **BEARING, radius_x=ACROSS, radius_y=ALONG) as contact:
        contact.step(tangential_displacement=AMPLITUDES[1])
        axes = contact["contact_semi_axis_x"], contact["contact_semi_axis_y"]
        return axes, contact["stick_radius"] / contact["contact_radius"], contact["max_pressure"]


def draw(loops, axes, stick):
    """The contact and the loops."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.patches import Ellipse

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9.5, 3.6), layout="constrained")
    a, b = (1e6 * axis for axis in axes)
    for size, colour in ((2, "#f0d9c8"), (2 * stick, "#b9d2e4")):
        left.add_patch(Ellipse((0, 0), size * a, size * b, facecolor=colour, edgecolor="#444"))
    left.annotate("stick", (0, 0), ha="center", va="center")
    left.annotate("slip", (0.5 * (1 + stick) * a, 0), ha="center", va="center")
    left.set(xlim=(-1.1 * a, 1.1 * a), ylim=(-3 * b, 3 * b), aspect="equal")
    left.set(xlabel="across the groove, µm", ylabel="along it, µm")
    left.set_title(f"the contact, moved by ±{AMPLITUDES[1] * 1e6:.1f} µm across", fontsize=10)
    for title, _, colour in (ACROSS_THE_GROOVE, ALONG_THE_GROOVE):
        for k, amplitude in enumerate(AMPLITUDES):
            place, force, *_ = loops[title, amplitude]
            right.plot(1e6 * place, force, color=colour, label=title if k == 0 else None)
    right.axhline(0, color="#bbb", linewidth=0.6, zorder=0)
    right.set(xlabel="displacement, µm", ylabel="tangential force, N")
    right.legend(fontsize=8, loc="upper left", frameon=False)
    figure.savefig(PICTURE, dpi=150)


if __name__ == "__main__":
    axes, stick, pressure = shape()
    print(f"semi-axes            {axes[0]:.4e} m across, {axes[1]:.4e} m along the groove")
    print(f"largest pressure     {pressure:.4e} Pa")
    loops = {}
    for title, radii, _ in (ACROSS_THE_GROOVE, ALONG_THE_GROOVE):
        for amplitude in AMPLITUDES:
            loops[title, amplitude] = measured(radii, amplitude)
            _, force, work, cycles = loops[title, amplitude]
            worn = cycles * WEAR_PER_WORK
            print(
                f"{title:<18} amplitude {amplitude:.1e} m  force {force.max():.4f} N  "
                f"work of a cycle {work:.4e} J  worn by 100,000 cycles {worn:.4e} m3"
            )
    draw(loops, axes, stick)
    print(f"picture              {PICTURE}")
