"""FMPy's one-line simulation: a run that cannot go on ends soon, and the message says why."""

import subprocess
import sys

import numpy as np
import pytest

RUN = """
import numpy as np, sys, time
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
names = ["time", "normal_force", "indentation", "tangential_displacement",
         "displacement_amplitude", "frequency", "tangential_displacement_y", "rotation"]
rows = [(t, {force}, 0.0, {displacement}, 1e-6, 1.0, 0.0, 0.0) for t in np.linspace(0, 1, 51)]
signals = np.array(rows, dtype=[(name, float) for name in names]) if {moves} else None
begin = time.process_time()
try:
    simulate_fmu(sys.argv[1], stop_time=1.0, start_values={start}, input=signals,
                 output_interval=0.02)
except FMICallException as error:
    print("ended with", error)
print("processor time, s:", time.process_time() - begin)
"""


def simulate(fmu_path, start, displacement=None, force="100.0"):
    """What a run prints in a process of its own, and its processor time, s."""
    code = RUN.format(
        start=start, force=force, displacement=displacement or 0.0, moves=displacement is not None
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(fmu_path)],
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    lines = done.stdout.splitlines(keepends=True)
    (last,) = [line for line in lines if line.startswith("processor time, s:")]
    lines.remove(last)
    return "".join(lines) + done.stderr, float(last.split(":")[1])


SINE = "3e-6 * np.sin(6.2832 * t)"


@pytest.mark.parametrize(
    ("start", "force", "words"),
    [
        # a hardness of 800 Pa, meant as 8 GPa or 800 HV
        (
            {"hardness": 800},
            "100.0",
            ["wears more than the profile can follow", "hardness = 800 Pa"],
        ),
        ({"wear_coefficient": 1e3}, "100.0", ["wears more than the profile can follow"]),
        # a force that grows beyond what can be computed with
        ({}, "100.0 if t < 0.5 else 1e61", ["1e60 at most"]),
    ],
    ids=["hardness", "wear", "range"],
)
def test_a_step_that_cannot_be_done_ends_the_run(fmu_path, start, force, words):
    printed, seconds = simulate(fmu_path, start, SINE, force)
    assert "ended with fmi2DoStep failed with status 3 (error)" in printed, printed
    for word in ["the same step is asked for again", *words]:
        assert word in printed, printed
    assert printed.count("cannot be done, and nothing has changed") == 2, (
        "the discard, and its reason again"
    )
    assert seconds < 1.0


def test_a_sensible_run_says_nothing(fmu_path):
    printed, _ = simulate(fmu_path, {}, "2e-6 * np.sin(6.2832 * t)")
    assert printed == ""


def test_it_is_the_default_run(fmu_path):
    """With nothing but a start value, as in a first try."""
    printed, seconds = simulate(fmu_path, {"hardness": 800})
    assert "hardness = 800 Pa" in printed and seconds < 1.0
    assert np.isfinite(seconds)
