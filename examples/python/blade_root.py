"""A blade root: vibration under a centrifugal load that rises and falls, by load and motion alone or in step.

    python blade_root.py [FrettingContact.fmu]

A rounded punch stands for one flank of a dovetail. In a flight the speed, and with it the load, goes up, stays, and comes down; the blade
vibrates all the time. At speed the load itself ripples, in step with the vibration or a quarter period apart from it.
"""

import sys

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

FMU = sys.argv[1] if len(sys.argv) > 1 else "target/fmu/FrettingContact.fmu"
ROOT = {
    "profile": 5,  # rounded_punch
    "radius": 0.05,
    "flat_radius": 2e-4,
    "youngs_modulus_1": 114e9,  # Ti-6Al-4V on itself
    "poisson_ratio_1": 0.34,
    "youngs_modulus_2": 114e9,
    "poisson_ratio_2": 0.34,
    "friction_coefficient": 0.5,
    "hardness": 3.5e9,
    "wear_coefficient": 4e-13 * 3.5e9,  # 4e-13 m³ per J of friction
}
IDLE, FULL, RIPPLE = 150.0, 900.0, 0.3  # N, N, share of the load
VIBRATION, STEPS = 3e-6, 48  # m, steps a period


def instance(description, folder, name):
    model = description.coSimulation.modelIdentifier
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=model, instanceName=name)
    fmu.instantiate()
    for variable in description.modelVariables:
        if variable.name in ROOT:
            setter = fmu.setInteger if variable.type == "Enumeration" else fmu.setReal
            setter([variable.valueReference], [ROOT[variable.name]])
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    fmu.setReal([references["normal_force"]], [IDLE])
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    return fmu, references


def flight(description, folder, ripple, phase):
    """One flight of 5 vibrations up, 20 at speed and 5 down. Returns work, worn volume and the largest T over μF."""
    fmu, references = instance(description, folder, f"ripple {ripple} at {phase}")
    inputs = [references["normal_force"], references["tangential_displacement"]]
    outputs = [references[name] for name in ("tangential_force", "normal_reaction", "dissipated_energy", "wear_volume")]
    worst = 0.0
    for k in range(1, 30 * STEPS + 1):
        turns = k / STEPS
        speed = np.interp(turns, [0, 5, 25, 30], [0, 1, 1, 0])
        load = IDLE + (FULL - IDLE) * speed * (1 + ripple * np.sin(2 * np.pi * turns + phase))
        fmu.setReal(inputs, [load, VIBRATION * np.sin(2 * np.pi * turns)])
        fmu.doStep(turns - 1 / STEPS, 1 / STEPS)
        force, reaction, work, volume = fmu.getReal(outputs)
        worst = max(worst, abs(force) / (ROOT["friction_coefficient"] * reaction))
    fmu.terminate()
    fmu.freeInstance()
    return work, volume, worst


if __name__ == "__main__":
    description, folder = read_model_description(FMU), extract(FMU)
    cases = [("steady load at speed", 0.0, 0.0), ("load in step", RIPPLE, 0.0), ("load a quarter apart", RIPPLE, np.pi / 2)]
    for title, ripple, phase in cases:
        work, volume, worst = flight(description, folder, ripple, phase)
        print(f"{title:<21} work {work:.4e} J   worn {volume:.4e} m3   largest T/muF {worst:.4f}")
