"""Friction, rig stiffness and wear coefficient from a loop and a volume, both synthetic.

    python calibrate.py [FrettingContact.fmu]

A test rig measures the displacement of its drive, not that of the contact: `rig_stiffness` takes
that apart. The loop in measured_loop.csv is synthetic: Mindlin's formulas with noise
(make_measured_loop.py), so that the answer is known: mu = 0.62, rig 24 N/um; the volume belongs to
k/sigma0 = 5e-14 m3/J.
"""

import sys
from pathlib import Path

from fretting_contact import MeasuredLoop, WornVolume, calibrate

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
MEASURED = Path(__file__).with_name("measured_loop.csv")
FORCE, AMPLITUDE = 100.0, 8e-6  # N, m of the drive
CYCLES, VOLUME = 200_000, 1.154e-11  # of the wear test, and what it wore, m³
HARDNESS = 8e9  # Pa

if __name__ == "__main__":
    loop = MeasuredLoop.read(MEASURED, FORCE)
    fit = calibrate(loop, WornVolume(VOLUME, FORCE, AMPLITUDE, CYCLES), hardness=HARDNESS, fmu=FMU)
    print(
        f"friction coefficient {fit['friction_coefficient']:.4f} +- "
        f"{fit.std('friction_coefficient'):.4f}"
    )
    print(f"rig stiffness        {fit['rig_stiffness']:.4e} +- {fit.std('rig_stiffness'):.1e} N/m")
    print(
        f"offset of the force  {fit['force_offset[1]']:.4f} +- {fit.std('force_offset[1]'):.4f} N"
    )
    print(f"k/sigma0             {fit['wear_per_work']:.4e} m3/J")
    print(f"wear coefficient     {fit.parameters()['wear_coefficient']:.4e}")
