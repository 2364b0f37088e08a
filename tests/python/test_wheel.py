"""The wheel in an empty environment without Rust: it installs on the platforms of its FMU only,
and the guide's example runs.

`cargo fmu test` says by FRETTING_FMU_BUILD which program builds the wheel; without it the test is
skipped.
"""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import ROOT

PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
TEN_LINES, SHOWN = re.search(r"```python\n(.*?)```\n\n```text\n(.*?)```", PAGE, re.DOTALL).groups()


@pytest.fixture(scope="module")
def wheel(fmu_path, tmp_path_factory):
    if "FRETTING_FMU_BUILD" not in os.environ:
        pytest.skip("FRETTING_FMU_BUILD is not set: `cargo fmu test` sets it")
    folder = tmp_path_factory.mktemp("dist")
    command = [
        os.environ["FRETTING_FMU_BUILD"],
        "wheel",
        "--fmu",
        fmu_path.resolve(),
        "--output",
        folder,
    ]
    own = os.environ | {
        "CARGO_MANIFEST_DIR": str(ROOT / "fmu-build")
    }  # the program's checkout is this one
    done = subprocess.run(command, env=own, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    (path,) = folder.glob("*.whl")
    return path


def test_the_wheel_holds_the_fmu_and_all_modules(wheel, fmu_path):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        assert archive.read("fretting_contact/FrettingContact.fmu") == fmu_path.read_bytes()
    sources = {
        f"fretting_contact/{path.name}"
        for path in (ROOT / "python" / "fretting_contact").glob("*.py")
    }
    assert sources | {"fretting_contact/py.typed"} <= names
    assert {Path(name).name for name in names if "/licenses/" in name} == {
        "LICENSE-MIT",
        "LICENSE-APACHE",
    }


# platform tags of pip for the folders of FMI 2.0 that `cargo fmu release` fills
MACHINES = {"linux64": "x86_64", "aarch64-linux": "aarch64", "win64": "win_amd64"}


def platform_tags(wheel):
    python, abi, platforms = wheel.stem.split("-")[2:]
    assert (python, abi) == ("py3", "none")
    return platforms.split(".")


def test_the_name_and_the_file_wheel_have_the_platforms_of_the_fmu(wheel, fmu_path):
    with zipfile.ZipFile(fmu_path) as fmu:
        folders = {name.split("/")[1] for name in fmu.namelist() if name.startswith("binaries/")}
    with zipfile.ZipFile(wheel) as archive:
        assert archive.testzip() is None
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/WHEEL"))
        lines = archive.read(name).decode().splitlines()
    tags = platform_tags(wheel)
    assert [line for line in lines if line.startswith("Tag:")] == [
        f"Tag: py3-none-{tag}" for tag in tags
    ]
    assert "Root-Is-Purelib: false" in lines
    if not folders <= MACHINES.keys():
        pytest.skip(f"no list of tags for {sorted(folders - MACHINES.keys())}")
    machines = {re.sub(r"^manylinux_2_\d+_", "", tag) for tag in tags}
    assert machines == {MACHINES[folder] for folder in folders}


def pip_for(platform, wheel, folder):
    command = [sys.executable, "-m", "pip", "install", "--no-index", "--no-deps"]
    command += ["--platform", platform, "--only-binary=:all:", "--target", folder, wheel]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def test_pip_installs_it_for_a_platform_of_the_fmu(wheel, tmp_path):
    for platform in platform_tags(wheel):
        done = pip_for(platform, wheel, tmp_path / platform)
        assert done.returncode == 0, done.stderr
        assert (tmp_path / platform / "fretting_contact" / "FrettingContact.fmu").is_file()


@pytest.mark.parametrize(
    "platform", ["macosx_11_0_arm64", "musllinux_1_2_x86_64", "manylinux_2_5_x86_64", "win_arm64"]
)
def test_pip_refuses_it_for_another_platform(wheel, tmp_path, platform):
    if platform in platform_tags(wheel):
        pytest.skip("the FMU has a library for it")
    done = pip_for(platform, wheel, tmp_path / "other")
    assert done.returncode != 0
    assert "is not a supported wheel on this platform" in done.stderr
    assert not (tmp_path / "other" / "fretting_contact").exists()


def test_it_installs_and_the_ten_lines_run_without_rust(wheel, tmp_path):
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("FRETTING", "PYTHON", "CARGO", "RUST"))
    }
    environment["PATH"] = os.pathsep.join(
        part for part in os.environ["PATH"].split(os.pathsep) if "cargo" not in part
    )
    environment["MPLBACKEND"] = "Agg"

    def run(*command):
        done = subprocess.run(
            [str(part) for part in command],
            env=environment,
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=300,
            encoding="utf-8",
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    run(sys.executable, "-m", "venv", "empty")
    python = (
        tmp_path / "empty" / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    )
    run(
        python,
        "-m",
        "pip",
        "install",
        "--no-compile",
        "--disable-pip-version-check",
        f"{wheel}[plot]",
    )
    (tmp_path / "ten.py").write_text(TEN_LINES, encoding="utf-8")
    assert run(python, "-X", "utf8", "ten.py") == SHOWN
    assert (tmp_path / "loop.png").read_bytes().startswith(b"\x89PNG")
    path = run(python, "-c", "import fretting_contact; print(fretting_contact.fmu_path())")
    assert Path(path.strip()).is_relative_to(tmp_path / "empty")
