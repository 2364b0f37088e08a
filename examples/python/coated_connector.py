"""Life of a coated connector: how many cycles of fretting until the coating has worn through.

    python coated_connector.py [FrettingContact.fmu]

A gold-plated rivet of 2 mm radius on a plated flat, moved by vibration or by heat. Both platings
wear; the joint fails when the sum of both depths is the thickness of one plating. Below the
amplitude of full slip only an annulus wears. Archard's estimate takes the mean pressure and the
whole amplitude for slip. The picture coated_connector.png is written beside the FMU, or to the
working directory.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from fretting_contact import Contact

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
PICTURE = Path(FMU).with_name("coated_connector.png") if FMU else Path("coated_connector.png")
COATING, MOST = 0.8e-6, 1e9  # m; cycles that are tried
FORCES = (0.5, 2.0)  # N
AMPLITUDES = np.geomspace(0.3e-6, 20e-6, 14)  # m
GOLD = {"radius": "2 mm", "friction_coefficient": 0.5}
GOLD |= {"wear_coefficient": 4e-4, "hardness": "1.5 GPa"}
GOLD |= {"wear_coefficient_2": 2e-4, "hardness_2": "1.5 GPa"}
GOLD |= {f"youngs_modulus_{body}": "80 GPa" for body in (1, 2)}
GOLD |= {f"poisson_ratio_{body}": 0.42 for body in (1, 2)}
PER_WORK = (4e-4 + 2e-4) / 1.5e9  # m3/J of both bodies


def connector(force, amplitude):
    values = {"loading": "cyclic", "coating_thickness": COATING, "probe_radius_max": 75e-6}
    return Contact(fmu=FMU, normal_force=force, displacement_amplitude=amplitude, **GOLD, **values)


def life(force, amplitude):
    """Cycles until the coating has worn through, and the contact then; infinite if it lasts."""
    with connector(force, amplitude) as contact:
        cycles = 1e3
        while cycles <= MOST:
            contact.step(cycles)  # 1 Hz
            if contact["worn_through"]:
                return contact["cycles_to_wear_through"]
            cycles *= 4
    return np.inf


def worn_profile(force, amplitude, cycles):
    """Profile before and after some cycles, at the same radii, and the volumes of both bodies."""
    with connector(force, amplitude) as contact:
        radius, before = contact["radius_probe"], contact["profile_height"]
        contact.step(cycles)
        return (
            radius,
            before,
            contact["profile_height"],
            contact.get("wear_volume_1", "wear_volume_2"),
        )


def archard(force, amplitude):
    """Cycles by mean pressure: depth = PER_WORK * friction * pressure * 4 * amplitude * cycles."""
    with connector(force, amplitude) as contact:
        pressure = force / (np.pi * contact["contact_radius"] ** 2)
    return COATING / (PER_WORK * 0.5 * pressure * 4 * amplitude)


if __name__ == "__main__":
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    for force, colour in zip(FORCES, ("tab:blue", "tab:orange")):
        lives = np.array([life(force, amplitude) for amplitude in AMPLITUDES])
        estimates = np.array([archard(force, amplitude) for amplitude in AMPLITUDES])
        for row in zip(AMPLITUDES * 1e6, lives, estimates):
            print("{:.1f} N, {:6.2f} um: {:.3e} cycles, by Archard {:.3e}".format(force, *row))
        left.loglog(AMPLITUDES * 1e6, lives, "o-", color=colour, label=f"{force} N")
        left.loglog(AMPLITUDES * 1e6, estimates, "--", color=colour, label=f"{force} N, Archard")
        lasting = AMPLITUDES[np.isinf(lives)] * 1e6
        if lasting.size:
            left.plot(
                lasting, np.full_like(lasting, 1e5), "^", color=colour, label=f"{force} N, lasts"
            )
        for style, amplitude, cycles in zip(("-", ":"), AMPLITUDES[[2, -1]], lives[[2, -1]]):
            radius, before, after, volumes = worn_profile(force, amplitude, cycles)
            label = f"{force} N, {amplitude * 1e6:.1f} µm"
            right.plot(radius * 1e6, (after - before) * 1e6, style, color=colour, label=label)
            print(f"{label}: bodies 1 and 2 lose {volumes[0]:.3e} and {volumes[1]:.3e} m3")
    left.set(xlabel="displacement amplitude (µm)", ylabel="cycles to wear-through")
    right.set(xlabel="radius (µm)", ylabel="worn depth at wear-through (µm)")
    for axes in (left, right):
        axes.legend()
        axes.grid(alpha=0.3)
    figure.savefig(PICTURE, dpi=150)
