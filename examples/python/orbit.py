"""Motion in both tangential directions, with FMPy: a round orbit of the body on its counter body.

    python orbit.py [FrettingContact.fmu]

Orbits of 1.5 um radius on a steel ball of 10 mm radius under 100 N. Springs of the contact whose friction bound b is less than the radius
slip along their own deflection, the others stick; force and work of a steady orbit follow in closed form and are printed beside. The
force lags behind the displacement: it is turned towards where the body goes.
"""

import sys

import numpy as np
from fmpy import simulate_fmu

FMU = sys.argv[1] if len(sys.argv) > 1 else "target/fmu/FrettingContact.fmu"
INPUTS = ["time", "normal_force", "indentation", "tangential_displacement", "displacement_amplitude", "frequency"]
INPUTS += ["tangential_displacement_y"]
FORCE, RADIUS, ORBITS, STEPS = 100.0, 1.5e-6, 8, 180  # N, m, of 1 s each, steps an orbit
FRICTION, NORMAL_MODULUS, SHEAR_MODULUS, BALL = 0.6, 115.385e9, 95.0226e9, 0.01  # steel on steel


def stepped():
    """Every step of the orbit, and one more: FMPy sets an input at the start of a step, the contact is there at its end."""
    signals = np.zeros(ORBITS * STEPS + 2, dtype=[(name, float) for name in INPUTS])
    signals["time"] = np.arange(len(signals)) / STEPS
    signals["normal_force"] = FORCE
    radius = RADIUS * np.minimum(signals["time"], 1.0)  # a spiral from the place of rest first
    signals["tangential_displacement"] = radius * np.cos(2 * np.pi * signals["time"])
    signals["tangential_displacement_y"] = radius * np.sin(2 * np.pi * signals["time"])
    return simulate_fmu(
        FMU,
        start_values={"wear_coefficient": 3.2e-5},
        input=signals,
        stop_time=ORBITS + 1 / STEPS,
        output_interval=1 / STEPS,
        output=["tangential_force", "tangential_force_y", "dissipated_energy", "wear_volume", "stick_radius"],
    )


def closed_form():
    """Amplitude of the force and work of a steady orbit: |e|^2 = U^2 - b^2 for each spring that slips."""
    edge = (3 * FORCE * BALL / (4 * NORMAL_MODULUS)) ** (1 / 3)
    x = np.linspace(0, edge, 200001)
    bound = np.minimum(FRICTION * NORMAL_MODULUS / SHEAR_MODULUS * (edge**2 - x**2) / BALL, RADIUS)
    slip = np.sqrt(RADIUS**2 - bound**2)
    along = 2 * SHEAR_MODULUS * np.trapezoid(bound**2 / RADIUS, x)
    across = 2 * SHEAR_MODULUS * np.trapezoid(bound * slip / RADIUS, x)
    return np.hypot(along, across), 2 * np.pi * RADIUS * across


if __name__ == "__main__":
    result = stepped()
    last = result[-STEPS - 1 :]
    force, work = closed_form()
    size = np.hypot(last["tangential_force"], last["tangential_force_y"])
    print(f"force, stepped       {size.mean():.4f} N")
    print(f"force, closed form   {force:.4f} N")
    print(f"limit of friction    {FRICTION * FORCE:.4f} N")
    print(f"work, stepped        {last['dissipated_energy'][-1] - last['dissipated_energy'][0]:.4e} J")
    print(f"work, closed form    {work:.4e} J")
    print(f"stick radius         {last['stick_radius'][-1]:.4e} m")
    print(f"worn volume          {last['wear_volume'][-1]:.4e} m3")
