"""A blade root: vibration under a centrifugal load that rises and falls.

    python blade_root.py [FrettingContact.fmu]

A rounded punch stands for one flank of a dovetail. In a flight the speed, and with it the load,
goes up, stays, and comes down; the blade vibrates all the time. At speed the load itself ripples,
in step with the vibration or a quarter period apart from it.
"""

import sys

import numpy as np
from fretting_contact import Contact, drive

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
ROOT = {
    "profile": "rounded_punch",
    "radius": "50 mm",
    "flat_radius": "200 um",
    "youngs_modulus_1": "114 GPa",  # Ti-6Al-4V on itself
    "poisson_ratio_1": 0.34,
    "youngs_modulus_2": "114 GPa",
    "poisson_ratio_2": 0.34,
    "friction_coefficient": 0.5,
    "hardness": "3.5 GPa",
    "wear_coefficient": 4e-13 * 3.5e9,  # 4e-13 m³ per J of friction
}
IDLE, FULL, RIPPLE = 150.0, 900.0, 0.3  # N, N, share of the load
VIBRATION, STEPS = 3e-6, 48  # m, steps a period


def flight(ripple, phase):
    """One flight of 5 vibrations up, 20 at speed and 5 down. Returns work, worn volume and the
    largest T over μF.
    """
    turns = np.arange(30 * STEPS + 1) / STEPS
    speed = np.interp(turns, [0, 5, 25, 30], [0, 1, 1, 0])
    load = IDLE + (FULL - IDLE) * speed * (1 + ripple * np.sin(2 * np.pi * turns + phase))
    with Contact(fmu=FMU, **ROOT, normal_force=IDLE) as contact:
        done = drive(contact, turns, VIBRATION * np.sin(2 * np.pi * turns), load)
    worst = np.max(
        np.abs(done.tangential_force) / (ROOT["friction_coefficient"] * done.normal_force)
    )
    return done.dissipated_energy[-1], done.wear_volume[-1], worst


if __name__ == "__main__":
    cases = [
        ("steady load at speed", 0.0, 0.0),
        ("load in step", RIPPLE, 0.0),
        ("load a quarter apart", RIPPLE, np.pi / 2),
    ]
    for title, ripple, phase in cases:
        work, volume, worst = flight(ripple, phase)
        print(f"{title:<21} work {work:.4e} J   worn {volume:.4e} m3   largest T/muF {worst:.4f}")
