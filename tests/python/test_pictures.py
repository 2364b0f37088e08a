"""The pictures of the repository: one of each, small, and drawn from the present numbers."""

import importlib.util
import shutil

import pytest
from conftest import ROOT

FOLDERS = [ROOT / folder for folder in ("docs", "examples", "python", "reports")]
PICTURES = [
    path
    for folder in FOLDERS
    for ending in ("png", "svg", "jpg")
    for path in folder.rglob(f"*.{ending}")
]
LARGEST = 150_000  # bytes


@pytest.fixture(scope="module")
def plot():
    spec = importlib.util.spec_from_file_location("plot", ROOT / "reports" / "harness" / "plot.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("picture", PICTURES, ids=lambda path: path.name)
def test_a_picture_is_small_and_shown_on_a_page(picture):
    assert picture.suffix == ".png"
    assert picture.stat().st_size < LARGEST
    pages = [ROOT / "README.md", *(path for folder in FOLDERS for path in folder.rglob("*.md"))]
    shown = [page for page in pages if f"{picture.name})" in page.read_text(encoding="utf-8")]
    assert shown, "no page shows it: remove it"


@pytest.mark.parametrize("name", ["error_against_time", "stability", "coupling"])
def test_a_picture_of_a_report_is_drawn_from_the_present_numbers(plot, name):
    """Else run `target/venv/bin/python reports/harness/plot.py`."""
    assert plot.is_current(ROOT / "reports" / f"{name}.csv")


def test_a_picture_is_drawn_again_only_when_its_numbers_change(plot, tmp_path):
    data = tmp_path / "coupling.csv"
    shutil.copy(ROOT / "reports" / "coupling.csv", data)
    plot.main(tmp_path)
    picture = data.with_suffix(".png")
    drawn = picture.read_bytes()
    picture.touch()
    before = picture.stat().st_mtime_ns
    plot.main(tmp_path)
    assert picture.stat().st_mtime_ns == before
    lines = data.read_text(encoding="utf-8").splitlines(keepends=True)
    data.write_text("".join(lines[:-1]), encoding="utf-8")
    assert not plot.is_current(data)
    plot.main(tmp_path)
    assert plot.is_current(data) and picture.read_bytes() != drawn
