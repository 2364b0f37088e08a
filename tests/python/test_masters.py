"""Masters that others wrote: each drives the FMU through the same inputs to the same results.

The inputs are set at a communication point and hold for the step from there, which every master can
do. Each master runs in a process of its own, so that none sees what another has loaded or left
behind.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

MASTERS = Path(__file__).parent / "masters"

#: s; a power of two, so that the communication points add up exactly.
STEP = 0.125
OUTPUTS = [
    "tangential_force",
    "wear_volume",
    "wear_depth",
    "dissipated_energy",
    "contact_radius",
    "indentation_depth",
]
#: Wear that shows, in partial slip and in gross slip.
PARAMETERS = {"wear_coefficient": 0.03, "friction_coefficient": 0.5}
AGREEMENT = 1e-12


def history():
    """(N, m) of 40 steps: growing strokes under a load that moves, into gross slip and back."""
    stroke = lambda k: 4e-6 * (k / 40) * math.sin(0.9 * k)  # noqa: E731
    return [(100.0 + 20.0 * math.sin(0.3 * k), stroke(k)) for k in range(1, 41)]


def run(master, fmu_path, folder):
    """The outputs after each step, as the master gives them; skips where it cannot run on this
    machine.
    """
    task = {
        "fmu": str(fmu_path),
        "folder": str(folder),
        "step": STEP,
        "inputs": history(),
        "outputs": OUTPUTS,
        "parameters": PARAMETERS,
    }
    script = MASTERS / f"{master}_master.py"
    done = subprocess.run(
        [sys.executable, str(script)],
        input=json.dumps(task),
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    if "MISSING:" in done.stderr:
        pytest.skip(done.stderr[done.stderr.index("MISSING:") :].strip())
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads((folder / "answer.json").read_text())


@pytest.fixture(scope="module")
def truth(fmu_path, tmp_path_factory):
    return run("fmpy", fmu_path, tmp_path_factory.mktemp("fmpy"))


def test_the_history_slips_and_wears(truth):
    """Else agreement would say little."""
    force, volume = [row[0] for row in truth], [row[1] for row in truth]
    assert max(force) > 40 and min(force) < -40
    assert volume[-1] > 1e-15 and all(later >= before for before, later in zip(volume, volume[1:]))


@pytest.mark.parametrize("master", ["libcosimpy", "ecospy", "pathsim", "rust"])
def test_other_masters_come_to_the_same_numbers(master, truth, fmu_path, tmp_path):
    rows = run(master, fmu_path, tmp_path)
    assert len(rows) == len(truth)
    for k, (row, expected) in enumerate(zip(rows, truth)):
        for name, value, exact in zip(OUTPUTS, row, expected):
            assert math.isclose(value, exact, rel_tol=AGREEMENT, abs_tol=0.0), f"step {k}, {name}"
