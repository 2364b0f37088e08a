"""The presets (SSV files) in the FMU, read by tools that support SSP, and set on the FMU."""

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import ROOT
from fmpy import simulate_fmu
from fmpy.ssp.ssd import read_ssv

FILES = sorted((ROOT / "presets").glob("*.ssv"))
PAGE = (ROOT / "docs" / "presets.md").read_text(encoding="utf-8")
MASTERS = Path(__file__).parent / "masters"
STROKE = 0.5e-6
"""m: partial slip with each of the presets."""


@pytest.fixture(params=FILES, ids=lambda path: path.stem)
def file(request):
    return request.param


def test_the_fmu_has_the_files_of_the_repository(fmu_path, file):
    with zipfile.ZipFile(fmu_path) as archive:
        assert archive.read(f"resources/presets/{file.name}") == file.read_bytes()


def test_fmpy_reads_a_preset_from_the_fmu(fmu_path, fmu, file):
    """FMPy also checks the file against the schema of SSP 1.0."""
    preset = read_ssv(str(fmu_path), resource=f"resources/presets/{file.name}")
    assert preset.name == file.stem
    for parameter in preset.parameters:
        variable = fmu.variables[parameter.name]
        assert (variable.causality, variable.type) == ("parameter", parameter.type)
        assert parameter.unit == variable.unit, parameter.name


def values_of(file):
    return {parameter.name: float(parameter.value) for parameter in read_ssv(str(file)).parameters}


def test_pyssp_standard_reads_the_same_values_and_units(file):
    ssv = pytest.importorskip(
        "pyssp_standard.ssv",
        reason="pyssp-standard is not installed: see tests/python/tools-requirements.txt",
    )
    with ssv.SSV(file) as preset:
        assert preset.name == file.stem
        preset.check_compliance(preset.schemas[preset.identifier], preset.namespaces)
        attributes = {
            parameter["name"]: parameter["type_value"].parameter for parameter in preset.parameters
        }
    assert {name: float(given["value"]) for name, given in attributes.items()} == values_of(file)
    units = {parameter.name: parameter.unit for parameter in read_ssv(str(file)).parameters}
    assert {name: given.get("unit") for name, given in attributes.items()} == units


@pytest.mark.parametrize("master", ["libcosimpy", "ecospy"])
def test_a_master_simulates_a_system_with_a_preset(master, fmu_path, file, tmp_path):
    """The system is the one that docs/presets.md shows, with each of the presets."""
    description = re.search(r"```xml\n(.*?)```", PAGE, re.DOTALL)[1].replace("ti_6al_4v", file.stem)
    system, answer = tmp_path / "joint.ssp", tmp_path / "answer.json"
    with zipfile.ZipFile(system, "w") as archive:
        archive.writestr("SystemStructure.ssd", description)
        archive.write(fmu_path, "resources/FrettingContact.fmu")
        archive.write(file, f"resources/{file.name}")
    values = values_of(file)
    script = MASTERS / f"{master}_ssp.py"
    outputs = ["contact_radius", "tangential_force"]
    command = [sys.executable, script, system, file.stem, answer, STROKE, *values, *outputs]
    command = [str(part) for part in command]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    if "MISSING:" in done.stderr:
        pytest.skip(done.stderr[done.stderr.index("MISSING:") :].strip())
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads(answer.read_text())
    assert found.pop("contact_radius") == pytest.approx(hertz_radius(values), rel=1e-9)
    assert found.pop("tangential_force") == pytest.approx(mindlin_force(values), rel=1e-6)
    assert found == values


def hertz_radius(values):
    """m, for two bodies of one material, with the other start values of the FMU."""
    modulus = values["youngs_modulus_1"] / (2 * (1 - values["poisson_ratio_1"] ** 2))
    return (3 * 100.0 * 0.01 / (4 * modulus)) ** (1 / 3)


def mindlin_force(values):
    """N, at the end of the first stroke, for two bodies of one material (Mindlin)."""
    poisson, friction = values["poisson_ratio_1"], values.get("friction_coefficient", 0.6)
    ratio = (2 - poisson) / (2 * (1 - poisson))  # E*/G*
    full_slip = friction * ratio * hertz_radius(values) ** 2 / 0.01
    assert full_slip > STROKE
    return friction * 100.0 * (1 - (1 - STROKE / full_slip) ** 1.5)


def test_the_fmu_accepts_the_values(start_contact, file):
    values = values_of(file)
    contact = start_contact(**values)
    assert {name: contact.get(name) for name in values} == values
    assert contact.get("contact_radius") > 0


def test_a_preset_changes_the_simulation_as_hertz_says(fmu_path):
    values = values_of(ROOT / "presets" / "ti_6al_4v.ssv")
    result = simulate_fmu(str(fmu_path), start_values=values, output=["contact_radius"])
    assert result["contact_radius"][0] == pytest.approx(hertz_radius(values), rel=1e-9)


def test_the_page_shows_the_values_of_the_files():
    header = next(line for line in PAGE.splitlines() if line.startswith("| | [steel"))
    columns = re.findall(r"\[(\w+)\]", header)
    assert sorted(columns) == [path.stem for path in FILES]
    presets = {
        name: {p.name: p.value for p in read_ssv(str(ROOT / "presets" / f"{name}.ssv")).parameters}
        for name in columns
    }
    rows = [line.strip("| ").split(" | ") for line in PAGE.splitlines() if line.startswith("| `")]
    shown = set()
    for title, *cells in rows:
        first = re.match(r"`(\w+)`", title)[1]
        names = [first, first.replace("_1", "_2")] if first.endswith("_1") else [first]
        for column, cell in zip(columns, cells):
            for name in names:
                assert presets[column].get(name, "not set") == cell, (column, name)
        shown.update(names)
    assert shown == set().union(*presets.values())
