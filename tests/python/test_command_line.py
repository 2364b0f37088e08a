"""python -m fretting_contact: demo, life, calibrate, profile; what a missing package causes."""

import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT
from fretting_contact import SweepResult, sweep
from fretting_contact.__main__ import main

LOOP = str(ROOT / "examples" / "python" / "measured_loop.csv")


@pytest.fixture(autouse=True)
def this_fmu(fmu_path, monkeypatch):
    monkeypatch.setenv("FRETTING_FMU", str(fmu_path))


def test_demo_says_numbers_and_draws(tmp_path, capsys):
    assert main(["demo", "-o", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "force amplitude          44.31 N" in said and "19.00 uJ" in said
    assert {path.name for path in tmp_path.glob("*.png")} == {"loop.png", "life.png"}


def test_life_prints_a_table_and_writes_it(tmp_path, capsys):
    path = tmp_path / "life.csv"
    assert (
        main(
            [
                "life",
                "radius=20 mm",
                "displacement_amplitude=1.5e-6",
                "--cycles",
                "1e4",
                "--rows",
                "2",
                "-o",
                str(path),
            ]
        )
        == 0
    )
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + 3 and lines[-1].split()[0] == "10000"
    table = np.genfromtxt(path, delimiter=",", names=True)
    assert table["cycles"].tolist() == [0, 5000, 10000] and table["wear_volume"][-1] > 0


def test_calibrate_says_the_values_and_draws(tmp_path, capsys):
    wear = ["--volume", "0.01154 mm3", "--amplitude", "8 um", "--cycles", "2e5"]
    picture = tmp_path / "fit.png"
    assert main(["calibrate", LOOP, "--normal-force", "100 N", *wear, "-o", str(picture)]) == 0
    said = {line.split()[0]: line.split()[1:4] for line in capsys.readouterr().out.splitlines()}
    for name, truth in ("friction_coefficient", 0.62), ("rig_stiffness", 24e6):
        value, scatter = float(said[name][0]), float(said[name][2])
        assert abs(value - truth) < 4 * scatter < 0.1 * truth
    assert float(said["wear_per_work"][0]) == pytest.approx(5e-14, rel=0.03)
    assert picture.stat().st_size > 5000


def test_profile_is_the_command_of_cargo(tmp_path, capsys):
    x = np.linspace(-400, 400, 201)
    np.savetxt(tmp_path / "scan.txt", np.column_stack([x, x**2 / 20_000]))
    assert (
        main(
            [
                "profile",
                str(tmp_path / "scan.txt"),
                "--unit",
                "um",
                "-o",
                str(tmp_path / "table.txt"),
            ]
        )
        == 0
    )
    assert "radius of curvature at the apex: 10 mm" in capsys.readouterr().out


def test_errors_of_profile_name_the_command_that_was_given(capsys):
    with pytest.raises(SystemExit):
        main(["profile"])
    assert "python -m fretting_contact profile: error: " in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["life", "raduis=1"],
            "error: raduis is no variable of the component (did you mean radius or",
        ),
        (["life", "radius=-1"], "radius = -1.0 is refused"),
        (
            ["calibrate", LOOP, "--normal-force", "100 kg"],
            "error: --normal-force = '100 kg': the unit has to be one of N",
        ),
        (
            ["calibrate", LOOP, "--normal-force", "100 N", "--cycles", "5"],
            "error: --volume, --amplitude and --cycles belong together",
        ),
        (["calibrate", "none.csv", "--normal-force", "100 N"], "'none.csv' cannot be read"),
        (
            ["calibrate", LOOP, "--normal-force", "100 N", "nope=5"],
            "error: nope is no variable of the component",
        ),
        (["calibrate", LOOP, "--normal-force", "1 N", "-o", "none/x.png"], "no folder 'none'"),
        (["life", "loading=transient"], "error: loading = 'transient' is not allowed: the command"),
        (["life", "loading=nope"], "error: loading = 'nope': give one of transient, cyclic"),
        (["life", f"fmu={LOOP}"], "measured_loop.csv is no FMU"),
        (["life", "--rows", "0"], "--rows = 0: give cycles above 0, and one row"),
        (["life", "--cycles", "-5"], "--cycles = -5, "),
        (["life", "-o", "none/life.csv"], "error: --output = 'none/life.csv' cannot be written"),
        (["demo", "-o", LOOP], "measured_loop.csv' cannot be read or written (File exists)"),
    ],
)
def test_an_error_is_one_line_and_the_status_1(arguments, message, capsys):
    assert main(arguments) == 1
    said = capsys.readouterr().err
    assert message in said and len(said.splitlines()) == 1, said


@pytest.mark.parametrize(
    "arguments",
    [["profile", "scan.txt", "-o", "out.txt"], ["calibrate", LOOP, "--normal-force", "100 N"]],
    ids=["profile", "calibrate"],
)
def test_what_is_missing_is_named(arguments, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import sys\nsys.modules['scipy'] = None\n"
        "from fretting_contact.__main__ import main\nsys.exit(main(sys.argv[1:]))\n"
    )
    command = [sys.executable, str(script), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and len(done.stderr.splitlines()) == 1, done.stderr
    assert "needs scipy: pip install fretting-contact[calibrate]" in done.stderr


def test_a_profile_without_matplotlib_is_written(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "fretting_contact.profile_picture", raising=False)
    x = np.linspace(-400, 400, 201)
    np.savetxt(tmp_path / "scan.txt", np.column_stack([x, x**2 / 2e4]))
    table = tmp_path / "out.txt"
    assert main(["profile", str(tmp_path / "scan.txt"), "--unit", "um", "-o", str(table)]) == 0
    assert table.exists()
    assert "picture: none, pip install fretting-contact[plot]" in capsys.readouterr().out


def test_a_calibration_without_matplotlib_is_printed(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    picture = str(tmp_path / "fit.png")
    assert main(["calibrate", LOOP, "--normal-force", "100 N", "-o", picture]) == 0
    said = capsys.readouterr().out
    assert "friction_coefficient" in said
    assert "picture: none, pip install fretting-contact[plot]" in said


def test_a_table_without_pandas_names_what_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    results = SweepResult({"normal_force": np.array([1.0])}, 1, 0)
    with pytest.raises(ImportError, match=r"needs pandas: pip install fretting-contact\[sweep\]"):
        results.to_pandas()


def test_a_sweep_without_pyarrow_writes_nothing(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    out = tmp_path / "results"
    with pytest.raises(ImportError, match=r"writes Parquet: pip install fretting-contact\[sweep\]"):
        sweep({}, {"normal_force": [1.0]}, out=out)
    assert not out.exists()


def test_a_warning_is_one_line(capsys):
    assert main(["life", "hardness=800", "wear_coefficient=0", "--rows", "1"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("warning: the pressure at the first contact, "), line


def test_a_parameter_without_a_value_is_refused(capsys):
    with pytest.raises(SystemExit):
        main(["life", "radius"])
    assert "give NAME=VALUE" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["life", "--cycles", "inf"], "argument --cycles: 'inf': give a finite number"),
        (["life", "--cycles", "abc"], "argument --cycles: 'abc': give a finite number"),
        (["life", "--rows", "2.5"], "argument --rows: '2.5': give a whole number"),
        (["calibrate", LOOP, "--normal-force", "100 N", "nope"], "unknown arguments: nope"),
        (["demo", "radius=1"], "unknown arguments: radius=1"),
    ],
)
def test_an_unknown_argument_is_refused(arguments, message, capsys):
    with pytest.raises(SystemExit):
        main(arguments)
    assert message in capsys.readouterr().err
