"""Libraries for other machines run under their emulators: force and wear by formulas.

They are in the FMU of `cargo fmu test --platforms linux64,win64,aarch64-linux`. A skipped test
names what is missing on this machine.
"""

import os
import subprocess
import zipfile

import pytest
from conftest import ROOT

BUILDER = (
    [os.environ["FRETTING_FMU_BUILD"]] if "FRETTING_FMU_BUILD" in os.environ else ["cargo", "fmu"]
)


@pytest.fixture(scope="module")
def tried(fmu_path):
    """platform: what became of its library."""
    own = os.environ | {
        "CARGO_MANIFEST_DIR": str(ROOT / "fmu-build")
    }  # the program's checkout is this one
    command = [*BUILDER, "try", fmu_path.resolve()]
    done = subprocess.run(command, cwd=ROOT, env=own, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return dict(line.split(": ", 1) for line in done.stdout.splitlines())


@pytest.mark.parametrize("platform", ["win64", "aarch64-linux"])
def test_a_library_for_another_machine_runs_under_its_emulator(fmu_path, tried, platform):
    with zipfile.ZipFile(fmu_path) as archive:
        folders = {
            name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")
        }
    if platform not in folders:
        pytest.skip(
            f"the FMU has no library for {platform}: `cargo fmu test --platforms "
            "linux64,win64,aarch64-linux` makes one"
        )
    if platform not in tried:
        pytest.skip(f"{platform} is this machine's own")
    if tried[platform].startswith("NOT RUN"):
        pytest.skip(f"{platform}: {tried[platform]}")
    assert tried[platform].startswith("loaded and stepped under"), tried[platform]
