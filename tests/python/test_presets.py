"""The presets (SSV files) in the FMU, read by a tool that supports SSP, and set on the FMU."""

import re
import zipfile

import pytest
from conftest import ROOT
from fmpy import simulate_fmu
from fmpy.ssp.ssd import read_ssv

FILES = sorted((ROOT / "presets").glob("*.ssv"))
PAGE = (ROOT / "docs" / "presets.md").read_text(encoding="utf-8")


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


def test_the_fmu_accepts_the_values(start_contact, file):
    values = {parameter.name: float(parameter.value) for parameter in read_ssv(str(file)).parameters}
    contact = start_contact(**values)
    assert {name: contact.get(name) for name in values} == values
    assert contact.get("contact_radius") > 0


def test_a_preset_changes_the_simulation_as_hertz_says(fmu_path):
    values = {p.name: float(p.value) for p in read_ssv(str(ROOT / "presets" / "ti_6al_4v.ssv")).parameters}
    result = simulate_fmu(str(fmu_path), start_values=values, output=["contact_radius"])
    modulus = values["youngs_modulus_1"] / (2 * (1 - values["poisson_ratio_1"] ** 2))
    assert result["contact_radius"][0] == pytest.approx((3 * 100.0 * 0.01 / (4 * modulus)) ** (1 / 3), rel=1e-9)


def test_the_page_shows_the_values_of_the_files():
    header = next(line for line in PAGE.splitlines() if line.startswith("| | [steel"))
    columns = re.findall(r"\[(\w+)\]", header)
    assert sorted(columns) == [path.stem for path in FILES]
    presets = {name: {p.name: p.value for p in read_ssv(str(ROOT / "presets" / f"{name}.ssv")).parameters} for name in columns}
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
