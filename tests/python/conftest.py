"""Fixtures: the FMU under test, and instances of it that are freed after each test.

The FMU is found by the environment variable FRETTING_FMU, or where `cargo fmu build` puts it.
"""

import os
import sys
from pathlib import Path

import pytest
from scripts import DEMO, run_script

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(DEMO))
PACKAGE = str(ROOT / "python")
sys.path.insert(0, PACKAGE)
os.environ["PYTHONPATH"] = os.pathsep.join(
    [PACKAGE, *filter(None, [os.environ.get("PYTHONPATH")])]
)  # of examples, too
os.environ.setdefault(
    "OPENBLAS_NUM_THREADS", "1"
)  # small matrices: threads would only wait for each other

from fretting_contact.component import ContactFmu, FmuFile  # noqa: E402


@pytest.fixture(scope="session")
def fmu_path():
    path = Path(os.environ.get("FRETTING_FMU", ROOT / "target" / "fmu" / "FrettingContact.fmu"))
    if not path.is_file():
        pytest.fail(
            f"there is no FMU at {path}: run `cargo fmu build`, or set FRETTING_FMU", pytrace=False
        )
    return path


@pytest.fixture(scope="session")
def fmu(fmu_path):
    with FmuFile(fmu_path) as file:
        yield file


@pytest.fixture(scope="session")
def demo(fmu_path, tmp_path_factory):
    """The worked example in its short form: the folder that it wrote, and what it said."""
    out = tmp_path_factory.mktemp("demo")
    said = run_script(DEMO / "demo.py", "--fmu", fmu_path, "--out", out, "--quick")
    return out, said


@pytest.fixture
def new_contact(fmu):
    """A function that makes instances, not yet initialised."""
    made = []

    def make():
        made.append(ContactFmu(fmu))
        return made[-1]

    yield make
    for contact in made:
        contact.__exit__()


@pytest.fixture
def start_contact(new_contact):
    """A function that makes instances and starts them with the given values."""
    return lambda **values: new_contact().start(**values)
