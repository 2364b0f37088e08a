"""The worked example in its short form: it runs, and its headline numbers are right."""

import csv
import subprocess
import sys

import numpy as np
import pytest
from conftest import DEMO

# name (beginning of) → allowed relative deviation from the expected value that the demo prints
# beside it
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
    "Partial slip: cycle by cycle": 1e-2,  # three cycles, the first less its first quarter
    "Gross slip: cycle by cycle": 2e-3,
    "amplitude with friction": 0.02,  # of a second-order scheme at 64 steps a period
    "friction work: counted": 0.03,  # of the same scheme; and the joint keeps some elastic energy
    "worn volume against": 1e-3,
    "worn volume /(a₀² d₀)": 0.01,  # tables good to 0.3 %
    # the image jumps at the stick edge, somewhere between two of 64 probes
    "force from the image": 0.03,
    "stick radius c/a₀": 1e-6,
    "last force": 5e-3,
    "fields of the map": 0.0,
    "friction work of the first cycle": 0.01,  # Mindlin's does not wear
}


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


LIVES = ["life_parabola", "life_cone", "life_constant_depth", "life_worn_tip"]


@pytest.mark.parametrize(
    "name", ["ball_loops", "worn_tip", "shaken_mass", "running_map", "overview", *LIVES]
)
def test_pictures(demo, name):
    picture = demo[0] / f"{name}.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert picture.stat().st_size > 20_000  # axes alone would be smaller


def test_tables_have_units_and_numbers(demo):
    tables = [path for path in demo[0].glob("*.csv") if path.name != "headlines.csv"]
    assert len(tables) == 8
    for path in tables:
        with open(path, encoding="utf-8", newline="") as file:
            header, *rows = csv.reader(file)
        assert sum("(" in column for column in header) >= 3, path.name
        assert len(rows) >= 40  # the shortest is the history of two lives
        for row in rows[:: len(rows) // 20]:
            [float(value) for column, value in zip(header, row) if "(" in column]


def test_the_life_at_constant_depth_ends_in_the_closed_shape(demo):
    rows = [
        row for quantity, row in headlines(demo[0]).items() if quantity.startswith("largest miss")
    ]
    assert len(rows) == 1
    assert 0 < float(rows[0]["value"]) < 5e-3  # of d₀, at the probes


def test_lives_start_unworn_and_never_heal(demo):
    """At the stops of each life the worn depth rises at every radius."""
    with open(demo[0] / "lives.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for case in {row["case"] for row in rows}:
        lives = sorted({float(row["life (N/N0)"]) for row in rows if row["case"] == case})
        assert lives[0] == 0 and len(lives) == 6
        before = None
        for life in lives:
            here = [
                row for row in rows if row["case"] == case and float(row["life (N/N0)"]) == life
            ]
            radius, worn, image, depth = (
                np.array([float(row[name]) for row in here])
                for name in ("radius (m)", "worn_depth (m)", "image (m)", "unworn_height (m)")
            )
            assert image.size == 64 and np.all(image >= depth - 1e-15)  # g is above f
            if before is None:
                assert np.max(worn) < 1e-6 * np.max(image)
            else:
                # the probes of two stops differ: the lesser of the former neighbours was worn off
                # between them, too
                above = np.searchsorted(before[0], radius)
                lesser = np.minimum(
                    *(np.append(before[1], 0.0)[np.clip(k, 0, 64)] for k in (above - 1, above))
                )
                assert np.all(worn >= lesser - 1e-6 * np.max(worn))
            before = radius, worn


def test_progress_and_list_of_files(demo):
    out, text = demo
    for step in ("[1/5]", "[2/5]", "[3/5]", "[4/5]", "[5/5]"):
        assert step in text
    for path in out.iterdir():
        assert path.name in text


def test_the_page_is_left_out_without_its_library(monkeypatch, tmp_path):
    import page

    monkeypatch.setitem(sys.modules, "vl_convert", None)
    with pytest.raises(page.NoLibrary, match="vl-convert is not installed"):
        page.write(tmp_path)
    assert not list(tmp_path.iterdir())


def test_missing_fmu_is_one_clear_line(tmp_path):
    command = [
        sys.executable,
        str(DEMO / "demo.py"),
        "--fmu",
        str(tmp_path / "none.fmu"),
        "--out",
        str(tmp_path),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "cargo fmu build" in done.stderr
