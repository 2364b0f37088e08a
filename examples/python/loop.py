"""A friction loop and its wear: the shortest way to an answer.

    python loop.py [FrettingContact.fmu]

Ten cycles of ±2 µm on a steel ball of 10 mm radius under 100 N, then the same number of cycles in
one step.
"""

import sys

import numpy as np
from fretting_contact import Contact, life, loop

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
BALL = {"fmu": FMU, "radius": "10 mm", "friction_coefficient": 0.6, "normal_force": 100.0}
AMPLITUDE, CYCLES = 2e-6, 10  # m

if __name__ == "__main__":
    with Contact(**BALL) as contact:
        last = loop(contact, AMPLITUDE, cycles=CYCLES, points=80)
    with Contact(**BALL, loading="cyclic", displacement_amplitude=AMPLITUDE) as contact:
        cycles = life(contact, CYCLES, at=[CYCLES])
    print(f"force amplitude      {last.force_amplitude:.4f} N")
    print(f"stick radius         {cycles.stick_radius[-1]:.4e} m")
    print(
        "work of a loop       "
        f"{np.trapezoid(last.tangential_force, last.contact_displacement):.4e} J"
    )
    print(f"worn volume, stepped {last.wear_volume[-1]:.4e} m3")
    print(f"worn volume, at once {cycles.wear_volume[-1]:.4e} m3")
