"""A friction loop and its wear, with FMPy: the shortest way to an answer.

    python loop.py [FrettingContact.fmu]

Ten cycles of ±2 µm on a steel ball of 10 mm radius under 100 N, then the same number of cycles in one step.
"""

import sys

import numpy as np
from fmpy import simulate_fmu

FMU = sys.argv[1] if len(sys.argv) > 1 else "target/fmu/FrettingContact.fmu"
INPUTS = ["time", "normal_force", "indentation", "tangential_displacement", "displacement_amplitude", "frequency"]
INPUTS += ["tangential_displacement_y"]  # all inputs, or FMPy prints that one is missing
FORCE, AMPLITUDE, CYCLES, STEPS = 100.0, 2e-6, 10, 80  # N, m, of 1 s each, steps a cycle


def stepped():
    """Every step of the motion, and one more: FMPy sets an input at the start of a step, the contact is there at its end."""
    signals = np.zeros(CYCLES * STEPS + 2, dtype=[(name, float) for name in INPUTS])
    signals["time"] = np.arange(len(signals)) / STEPS
    signals["normal_force"] = FORCE
    signals["tangential_displacement"] = AMPLITUDE * np.sin(2 * np.pi * signals["time"])
    return simulate_fmu(
        FMU,
        start_values={"radius": 0.01, "friction_coefficient": 0.6},
        input=signals,
        stop_time=CYCLES + 1 / STEPS,
        output_interval=1 / STEPS,
        output=["tangential_force", "contact_displacement", "wear_volume", "dissipated_energy"],
    )


def at_once():
    """The same cycles by their amplitude and number: loading 2 is cyclic."""
    return simulate_fmu(
        FMU,
        start_values={"loading": 2, "displacement_amplitude": AMPLITUDE, "frequency": 1.0},
        stop_time=CYCLES,
        output_interval=CYCLES,
        output=["tangential_force", "wear_volume", "stick_radius"],
    )


if __name__ == "__main__":
    steps, cycles = stepped(), at_once()[-1]
    last = steps[-STEPS - 1 :]
    loop = np.trapezoid(last["tangential_force"], last["contact_displacement"])
    print(f"force amplitude      {max(last['tangential_force']):.4f} N")
    print(f"stick radius         {cycles['stick_radius']:.4e} m")
    print(f"work of a loop       {loop:.4e} J")
    print(f"worn volume, stepped {steps['wear_volume'][-1]:.4e} m3")
    print(f"worn volume, at once {cycles['wear_volume']:.4e} m3")
