"""The FMU as a file: what validators and importing tools see."""

import math
import zipfile

import fmpy
import numpy as np
import pytest
from closed_forms import Sphere, Tangential
from fretting_contact.component import PROBES
from fmpy.validation import validate_fmu

INPUTS = {
    "normal_force",
    "indentation",
    "tangential_displacement",
    "tangential_displacement_y",
    "displacement_amplitude",
    "frequency",
    "rotation",
}
OUTPUTS = {
    "tangential_force",
    "tangential_force_y",
    "wear_volume",
    "wear_depth",
    "dissipated_energy",
    "normal_reaction",
    "indentation_depth",
    "contact_radius",
    "stick_radius",
    "max_pressure",
    "tangential_stiffness",
    "normal_stiffness",
    "slip_state",
}
ENUMERATIONS = {
    "profile": [
        "parabola",
        "cone",
        "power_law",
        "blunted_sphere",
        "rounded_punch",
        "flat_punch",
        "table",
        "ellipse",
    ],
    "normal_control": ["force", "indentation"],
    "loading": ["transient", "cyclic"],
    "slip_state": ["separated", "stick", "partial_slip", "gross_slip"],
}


def test_fmpy_finds_no_fault(fmu_path):
    assert validate_fmu(str(fmu_path)) == []


def test_files_in_the_archive(fmu_path):
    with zipfile.ZipFile(fmu_path) as archive:
        names = set(archive.namelist())
    library = f"binaries/{fmpy.platform}/FrettingContact{fmpy.sharedLibraryExtension}"
    assert {"modelDescription.xml", "documentation/index.html", "model.png", library} <= names


def test_model_identifier_is_the_library_name(fmu):
    assert fmu.description.fmiVersion == "2.0"
    assert fmu.description.coSimulation.modelIdentifier == "FrettingContact"


def test_inputs_and_outputs(fmu):
    by_causality = {}
    for variable in fmu.variables.values():
        by_causality.setdefault(variable.causality, set()).add(variable.name)
    assert by_causality["input"] == INPUTS
    assert by_causality["output"] >= OUTPUTS
    fields = {
        f"{name}[{i}]"
        for name in ("radius_probe", "worn_depth", "pressure", "shear_traction", "image")
        for i in range(1, PROBES + 1)
    }
    assert by_causality["local"] >= fields


@pytest.mark.parametrize(("variable", "items"), ENUMERATIONS.items())
def test_enumerations(fmu, variable, items):
    assert [item.name for item in fmu.variables[variable].declaredType.items] == items


def test_every_real_variable_has_a_known_unit(fmu):
    known = {unit.name for unit in fmu.description.unitDefinitions}
    for variable in fmu.variables.values():
        unit = variable.unit or (variable.declaredType.unit if variable.declaredType else None)
        if variable.type == "Real" and variable.causality in ("input", "output", "local"):
            assert unit in known, variable.name


def test_start_values_are_those_of_the_library(fmu, start_contact):
    """What the XML promises is what an instance with nothing set holds, bit for bit."""
    contact = start_contact()
    for variable in fmu.variables.values():
        if variable.causality in ("parameter", "input") and variable.type == "Real":
            assert contact.get(variable.name) == float(variable.start), variable.name


def test_runs_with_nothing_set(fmu_path):
    result = fmpy.simulate_fmu(str(fmu_path))
    assert result["time"][-1] > 0
    for name in result.dtype.names:
        assert np.all(np.isfinite(result[name].astype(float))), name


def test_simulate_with_an_input_signal(fmu_path):
    """fmpy's own loop sets an input at the beginning of a step, so that the force is that of one
    step before.
    """
    case = Tangential(Sphere(), 100.0)
    time = np.linspace(0, 1, 41)
    signal = np.array(
        [(t, 100.0, case.full_slip * t) for t in time],
        dtype=[("time", float), ("normal_force", float), ("tangential_displacement", float)],
    )
    result = fmpy.simulate_fmu(
        str(fmu_path),
        stop_time=1.0,
        output_interval=time[1],
        input=signal,
        start_values={"wear_coefficient": 0.0},
        output=["tangential_force"],
    )
    exact = case.loading(case.full_slip * np.clip(result["time"] - time[1], 0, None))
    # 1e-4 of μF is the accuracy promised at the default resolution.
    assert np.max(np.abs(result["tangential_force"] - exact)) < 1e-4 * case.limit


def test_step_sizes_that_do_not_sum_exactly(start_contact):
    """Ten thousand steps of 0.1 ms accumulate rounding errors in the master's clock."""
    contact = start_contact(wear_coefficient=0.0)
    for _ in range(10_000):
        contact.step(1e-4)
    assert not math.isclose(contact.time, 1.0, rel_tol=1e-16)
    assert contact.get("tangential_force") == 0.0
