"""Motion in both tangential directions: a round orbit of the body on its counter body.

    python orbit.py [FrettingContact.fmu]

Orbits of 1.5 um radius on a steel ball of 10 mm radius under 100 N. Springs of the contact whose
friction bound b is less than the radius slip along their own deflection, the others stick; force
and work of a steady orbit follow in closed form and are printed beside. The force lags behind the
displacement: it is turned towards where the body goes.
"""

import sys

import numpy as np
from fretting_contact import Contact, drive

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
FORCE, RADIUS, ORBITS, STEPS = 100.0, 1.5e-6, 8, 180  # N, m, of 1 s each, steps an orbit
FRICTION, NORMAL_MODULUS, SHEAR_MODULUS, BALL = 0.6, 115.385e9, 95.0226e9, 0.01  # steel on steel


def stepped():
    """Every step of the orbits, after a spiral from the place of rest."""
    time = np.arange(ORBITS * STEPS + 1) / STEPS
    place = RADIUS * np.minimum(time, 1.0) * np.exp(2j * np.pi * time)
    with Contact(fmu=FMU, wear_coefficient=3.2e-5, normal_force=FORCE) as contact:
        return drive(
            contact, time, place.real, displacement_y=place.imag, outputs=["tangential_force_y"]
        )


def closed_form():
    """Force amplitude and work of an orbit: |e|^2 = U^2 - b^2 for each spring that slips."""
    edge = (3 * FORCE * BALL / (4 * NORMAL_MODULUS)) ** (1 / 3)
    x = np.linspace(0, edge, 200001)
    bound = np.minimum(FRICTION * NORMAL_MODULUS / SHEAR_MODULUS * (edge**2 - x**2) / BALL, RADIUS)
    slip = np.sqrt(RADIUS**2 - bound**2)
    along = 2 * SHEAR_MODULUS * np.trapezoid(bound**2 / RADIUS, x)
    across = 2 * SHEAR_MODULUS * np.trapezoid(bound * slip / RADIUS, x)
    return np.hypot(along, across), 2 * np.pi * RADIUS * across


if __name__ == "__main__":
    result = stepped()
    force, work = closed_form()
    last = slice(-STEPS - 1, None)
    size = np.hypot(result.tangential_force, result.more["tangential_force_y"])[last]
    print(f"force, stepped       {size.mean():.4f} N")
    print(f"force, closed form   {force:.4f} N")
    print(f"limit of friction    {FRICTION * FORCE:.4f} N")
    print(f"work, stepped        {np.ptp(result.dissipated_energy[last]):.4e} J")
    print(f"work, closed form    {work:.4e} J")
    print(f"stick radius         {result.stick_radius[-1]:.4e} m")
    print(f"worn volume          {result.wear_volume[-1]:.4e} m3")
