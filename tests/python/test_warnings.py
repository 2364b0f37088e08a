"""No example and no demo causes a warning."""

import subprocess
import sys

import pytest
from conftest import DEMO, ROOT

PYTHON = ROOT / "examples" / "python"
EXAMPLES = [
    "bedding_in.py",
    "blade_root.py",
    "calibrate.py",
    "coated_connector.py",
    "groove.py",
    "joint.py",
    "loop.py",
    "noisy_displacement.py",
    "orbit.py",
    "oscillator.py",
    "running_in.py",
]

# keeps what instances have said after they are gone
RUNNER = """
import runpy, sys
demo, script, *sys.argv[1:] = sys.argv[1:]
sys.path[:0] = [demo]
sys.argv[0] = script
from fretting_contact import component

class Kept(dict):
    def pop(self, *_):
        return None

component._messages = Kept()
try:
    runpy.run_path(script, run_name="__main__")
except SystemExit as end:
    assert not end.code, end.code
for messages in component._messages.values():
    for status, text in messages:
        print("[WARNING] of a kept message:", text) if status == 1 else None
"""


def warnings(script, *arguments):
    command = [
        sys.executable,
        "-c",
        RUNNER,
        str(DEMO),
        str(script),
        *(str(argument) for argument in arguments),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return [
        line for line in (done.stdout + done.stderr).splitlines() if line.startswith("[WARNING]")
    ]


def test_the_runner_finds_warnings(fmu_path, tmp_path):
    own = tmp_path / "own.py"
    own.write_text(
        "import sys\nfrom fretting_contact.component import ContactFmu, FmuFile\n"
        "with FmuFile(sys.argv[1]) as file, ContactFmu(file) as contact:\n"
        "    contact.start(hardness=800.0)\n",
        encoding="utf-8",
    )
    (line,) = warnings(own, fmu_path)
    assert "hardness = 8e2 Pa" in line
    simulated = tmp_path / "simulated.py"
    simulated.write_text(
        "import sys\nfrom fmpy import simulate_fmu\nsimulate_fmu(sys.argv[1], "
        "start_values={'hardness': 800})\n",
        encoding="utf-8",
    )
    (line,) = warnings(simulated, fmu_path)
    assert "hardness = 8e2 Pa" in line


@pytest.mark.parametrize("name", EXAMPLES)
def test_no_example_causes_one(fmu_path, name):
    assert warnings(PYTHON / name, fmu_path) == []


def test_the_demo_causes_none(fmu_path, tmp_path):
    assert warnings(DEMO / "demo.py", "--fmu", fmu_path, "--out", tmp_path, "--quick") == []


def test_every_example_is_run():
    makers = {"make_measured_loop.py"}
    assert {path.name for path in PYTHON.glob("*.py")} - makers == set(EXAMPLES)
