"""The worked example in its short form: it runs, writes what it says, and its headline numbers are right."""

import csv
import subprocess
import sys

import pytest
from conftest import DEMO

# name (beginning of) → allowed relative deviation from the expected value that the demo prints beside it
BOUNDS = {
    "contact radius": 1e-9,
    "indentation depth": 1e-9,
    "peak pressure": 1e-9,
    "friction work of a loop": 1e-3,
    "work of a cycle": 2e-3,  # ∮T dU by the trapezium rule on 160 points a cycle
    "Partial slip: worn volume": 1e-3,
    "Gross slip: worn volume": 1e-3,
    "Partial slip: volume from": 0.05,  # 64 probes across a steep-edged ring
    "Gross slip: volume from": 0.02,
    "Partial slip: cycle by cycle": 0.1,  # three cycles that wear as much as thousands
    "Gross slip: cycle by cycle": 0.1,
    "amplitude with friction": 0.02,  # of a second-order scheme at 64 steps a period
    "friction work: counted": 0.03,  # likewise; and the joint keeps some elastic energy
    "worn volume against": 1e-3,
}


@pytest.fixture(scope="module")
def demo(fmu_path, tmp_path_factory):
    out = tmp_path_factory.mktemp("demo")
    command = [sys.executable, str(DEMO / "demo.py"), "--fmu", str(fmu_path), "--out", str(out), "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return out, done.stdout


def headlines(out):
    with open(out / "headlines.csv", encoding="utf-8", newline="") as file:
        return {row["quantity"]: row for row in csv.DictReader(file)}


@pytest.mark.parametrize("name", BOUNDS)
def test_headline(demo, name):
    rows = [row for quantity, row in headlines(demo[0]).items() if quantity.startswith(name)]
    assert rows
    for row in rows:
        assert abs(float(row["relative_deviation"])) <= BOUNDS[name], row["quantity"]


def test_every_expectation_is_bounded(demo):
    for quantity, row in headlines(demo[0]).items():
        if row["expected"]:
            assert any(quantity.startswith(name) for name in BOUNDS), quantity


@pytest.mark.parametrize("name", ["ball_loops", "worn_tip", "shaken_mass", "overview"])
def test_pictures(demo, name):
    picture = demo[0] / f"{name}.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert picture.stat().st_size > 20_000  # axes alone would be smaller


def test_tables_have_units_and_numbers(demo):
    tables = [path for path in demo[0].glob("*.csv") if path.name != "headlines.csv"]
    assert len(tables) == 5
    for path in tables:
        with open(path, encoding="utf-8", newline="") as file:
            header, *rows = csv.reader(file)
        assert sum("(" in column for column in header) >= 3, path.name
        assert len(rows) >= 40  # the shortest is the history of two lives
        for row in rows[:: len(rows) // 20]:
            [float(value) for column, value in zip(header, row) if "(" in column]


def test_progress_and_list_of_files(demo):
    out, text = demo
    for step in ("[1/3]", "[2/3]", "[3/3]"):
        assert step in text
    for path in out.iterdir():
        assert path.name in text


def test_missing_fmu_is_one_clear_line(tmp_path):
    command = [sys.executable, str(DEMO / "demo.py"), "--fmu", str(tmp_path / "none.fmu"), "--out", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "cargo fmu build" in done.stderr
