"""The Python of docs/python.md and docs/multibody.md runs as it stands; so do the doctests."""

import doctest
import importlib
import pkgutil
import re
import subprocess
import sys

import fretting_contact
import pytest
from conftest import ROOT

PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
LOOPS = (ROOT / "docs" / "multibody.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", PAGE + LOOPS, re.DOTALL)
MODULES = sorted(
    module.name
    for module in pkgutil.iter_modules(fretting_contact.__path__)
    if module.name != "__main__"
)
NEED_MORE = {"dask_cluster": "distributed", "sweep_folder": "pyarrow"}


@pytest.mark.parametrize("number", range(len(BLOCKS)))
def test_a_block_of_the_guide_runs_and_says_what_it_shows(tmp_path, number, monkeypatch, fmu_path):
    monkeypatch.setenv("FRETTING_FMU", str(fmu_path))
    code, shown = BLOCKS[number]
    script = tmp_path / "block.py"
    script.write_text(code, encoding="utf-8")
    command = [sys.executable, "-W", "error", str(script)]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=120, cwd=tmp_path, encoding="utf-8"
    )
    assert done.returncode == 0, done.stderr
    if shown:
        assert done.stdout == shown


def test_the_loop_for_chrono_is_python():
    """It is compiled only: no package registry has Chrono."""
    (code,) = re.findall(r"```py\n(.*?)```", LOOPS, re.DOTALL)
    compile(code, "multibody.md", "exec")


def test_the_ten_lines_are_ten():
    assert len(BLOCKS[0][0].splitlines()) == 10
    assert "## Ten lines" in PAGE.split("```python")[0]


def test_every_public_name_is_there_and_explained():
    assert fretting_contact.__all__ == sorted(
        fretting_contact.__all__, key=lambda name: (name[0].islower(), name)
    )
    defined = {
        name
        for module in MODULES
        for name, what in vars(importlib.import_module(f"fretting_contact.{module}")).items()
        if isinstance(what, type)
        and issubclass(what, Exception)
        and what.__module__.startswith("fretting_contact")
    }
    assert defined - {"OutputError"} <= set(fretting_contact.__all__)  # of the command line
    assert issubclass(fretting_contact.QuantityError, fretting_contact.ParameterError)
    for name in fretting_contact.__all__:
        assert getattr(fretting_contact, name).__doc__, name
    with pytest.raises(AttributeError, match="no attribute 'looop'"):
        _ = fretting_contact.looop


def test_the_version_is_that_of_the_workspace():
    (version,) = re.findall(
        r'^version = "(.+)"$', (ROOT / "Cargo.toml").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert fretting_contact.__version__ == version
    assert f"fretting_contact-{version}-py3" in PAGE


@pytest.mark.parametrize("name", MODULES)
def test_doctests(name, monkeypatch, fmu_path):
    monkeypatch.setenv("FRETTING_FMU", str(fmu_path))
    if name in NEED_MORE:
        pytest.importorskip(NEED_MORE[name])
    assert doctest.testmod(importlib.import_module(f"fretting_contact.{name}")).failed == 0


def test_doctests_are_found():
    found = [
        doctest.DocTestFinder().find(importlib.import_module(f"fretting_contact.{name}"))
        for name in ("contact", "motion", "quantities")
    ]
    assert sum(bool(test.examples) for tests in found for test in tests) == 5
