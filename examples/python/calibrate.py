"""Friction, rig stiffness and wear coefficient from a friction loop and a wear volume, both synthetic.

    python calibrate.py [FrettingContact.fmu]

A test rig measures the displacement of its drive, not that of the contact: `rig_stiffness` takes that apart. The loop in
measured_loop.csv is synthetic: Mindlin's formulas with noise (make_measured_loop.py), so that the answer is known: mu = 0.62,
rig 24 N/um; the volume belongs to k/sigma0 = 5e-14 m3/J.
"""

import sys
from pathlib import Path

import numpy as np
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu
from scipy.optimize import least_squares

FMU = sys.argv[1] if len(sys.argv) > 1 else "target/fmu/FrettingContact.fmu"
INPUTS = ["time", "normal_force", "indentation", "tangential_displacement", "displacement_amplitude", "frequency"]
INPUTS += ["tangential_displacement_y"]  # all inputs, or FMPy prints that one is missing
MEASURED = Path(__file__).with_name("measured_loop.csv")
FORCE, AMPLITUDE = 100.0, 8e-6  # N, m of the drive
CYCLES, VOLUME = 200_000, 1.154e-11  # of the wear test, and what it wore, m³
HARDNESS = 8e9  # Pa

description, folder = read_model_description(FMU), extract(FMU)


def loop(drive, friction, rig):
    """Force along a closed loop of the drive, which begins at its upper reversal; the contact is pressed on at 0."""
    signals = np.zeros(len(drive) + 2, dtype=[(name, float) for name in INPUTS])
    signals["time"], signals["normal_force"] = np.arange(len(signals)), FORCE
    signals["tangential_displacement"] = np.concatenate([[0.0], drive, drive[-1:]])
    result = simulate_fmu(
        folder,
        model_description=description,
        start_values={"friction_coefficient": friction, "rig_stiffness": rig, "wear_coefficient": 0.0},
        input=signals,
        stop_time=len(drive) + 1.0,
        output_interval=1.0,
        output=["tangential_force"],
    )
    return result["tangential_force"][2:]  # FMPy sets an input at the start of a step


def wear(friction, rig, per_work):
    result = simulate_fmu(
        folder,
        model_description=description,
        start_values={
            "loading": 2,  # cyclic
            "normal_force": FORCE,
            "displacement_amplitude": AMPLITUDE,
            "frequency": float(CYCLES),
            "friction_coefficient": friction,
            "rig_stiffness": rig,
            "hardness": HARDNESS,
            "wear_coefficient": per_work * HARDNESS,
        },
        stop_time=1.0,
        output_interval=1.0,
        output=["wear_volume"],
    )
    return result["wear_volume"][-1]


if __name__ == "__main__":
    drive, force = np.loadtxt(MEASURED, delimiter=",", skiprows=1).T
    # both parameters are positive and of very different size: their logarithms are fitted
    miss = lambda log: loop(drive, *np.exp(log)) - force  # noqa: E731
    fit = least_squares(miss, np.log([0.4, 1e8]), x_scale=0.1, diff_step=1e-3)
    friction, rig = np.exp(fit.x)
    scatter = np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)) * 2 * fit.cost / (len(force) - 2))
    print(f"friction coefficient {friction:.4f} +- {friction * scatter[0]:.4f}")
    print(f"rig stiffness        {rig:.4e} +- {rig * scatter[1]:.1e} N/m")
    low, high = np.log(1e-16), np.log(1e-11)
    for _ in range(40):  # the worn volume rises with k
        middle = 0.5 * (low + high)
        low, high = (middle, high) if wear(friction, rig, np.exp(middle)) < VOLUME else (low, middle)
    print(f"k/sigma0             {np.exp(middle):.4e} m3/J")
    print(f"wear coefficient     {np.exp(middle) * HARDNESS:.4e}")
