"""One contact, or a batch of them, on a worker."""

import atexit
import functools
import shutil
import tempfile
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

FRICTION = 0.6
OUTPUTS = ("tangential_force", "wear_volume", "wear_depth", "dissipated_energy", "stick_radius", "contact_radius")


@functools.lru_cache(maxsize=1)
def instance(content):
    """The FMU, unpacked and loaded once in each worker, from its bytes: a cluster need not share a disk."""
    folder = tempfile.mkdtemp(prefix="fretting-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    path = Path(folder) / "contact.fmu"
    path.write_bytes(content)
    description = read_model_description(str(path))
    unpacked = extract(str(path), unzipdir=str(Path(folder) / "unpacked"))
    identifier = description.coSimulation.modelIdentifier
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=unpacked, modelIdentifier=identifier, instanceName="sweep")
    fmu.instantiate()
    return fmu, {variable.name: variable.valueReference for variable in description.modelVariables}


def life(content, load, amplitude, cycles):
    """A contact in cyclic loading: its state in the first cycle and after all."""
    fmu, references = instance(content)
    fmu.reset()
    fmu.setInteger([references["loading"]], [2])  # cyclic
    inputs = [references[name] for name in ("normal_force", "displacement_amplitude", "frequency")]
    fmu.setReal([references["friction_coefficient"]], [FRICTION])
    fmu.setReal(inputs, [load, amplitude, 1.0])
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    outputs = [references[name] for name in OUTPUTS]
    fmu.doStep(0.0, 1.0)
    first = dict(zip(OUTPUTS, fmu.getReal(outputs)))
    fmu.doStep(1.0, cycles - 1.0)
    last = dict(zip(OUTPUTS, fmu.getReal(outputs)))
    return {
        "load": load,
        "amplitude": amplitude,
        "regime": regime(first),
        "regime_at_end": regime(last),
        "force_amplitude": first["tangential_force"],
        "work_per_cycle": first["dissipated_energy"],
        "wear_volume": last["wear_volume"],
        "wear_depth": last["wear_depth"],
    }


def regime(state):
    """Stick where nearly all of the disc sticks; Fouvry's limits of energy would do as well."""
    share = state["stick_radius"] / state["contact_radius"]
    return "gross" if share == 0.0 else "stick" if share > 0.95 else "partial"


def run_batch(content, loads, amplitudes, cycles):
    return [life(content, load, amplitude, cycles) for load, amplitude in zip(loads, amplitudes)]
