"""`cargo fmu`: arguments that cannot be used are refused in one line, before anything is built."""

import os
import subprocess

import pytest
from conftest import ROOT


@pytest.mark.skipif(
    "FRETTING_FMU_BUILD" not in os.environ,
    reason="FRETTING_FMU_BUILD is not set: `cargo fmu test` sets it",
)
@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["test-python", "none.fmu"], ["there is no FMU at", "none.fmu", "give the path of one"]),
        (["test-python", "README.md"], ["README.md is not a zip archive"]),
        (["try", "none.fmu"], ["there is no FMU at", "none.fmu", "give the path of one"]),
        (["wheel", "--fmu", "none.fmu"], ["there is no FMU at", "none.fmu"]),
        (["wheel", "--fmu", "{fmu}", "--output", "README.md"], ["cannot make the folder"]),
        (["merge", "{fmu}", "{fmu}", "--output", "README.md/a.fmu"], ["cannot make the folder"]),
        (["coverage", "nope"], ["`nope` is no test program", "engine"]),
        (["fuzz", "nope"], ["`nope` is not a fuzz target", "calls"]),
        (["profile", "none.txt", "-o", "tip.txt"], ["'none.txt' cannot be read", "check the path"]),
    ],
)
def test_an_error_is_one_line(arguments, parts, fmu_path):
    program = os.environ["FRETTING_FMU_BUILD"]
    own = os.environ | {"CARGO_MANIFEST_DIR": str(ROOT / "fmu-build")}
    done = subprocess.run(
        [program, *(text.format(fmu=fmu_path.resolve()) for text in arguments)],
        env=own,
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 1 and done.stdout == ""
    assert all(part in done.stderr for part in parts), done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
