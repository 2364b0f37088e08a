"""The examples as a user starts them: each runs, and its numbers are right."""

import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from closed_forms import Sphere, Tangential
from conftest import ROOT
from scripts import run_script

EXAMPLES = ROOT / "examples"
PYTHON = EXAMPLES / "python"
BALL = Tangential(Sphere(), 100.0)
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")


def run(*command, **options):
    done = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, timeout=120, **options
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def run_python(name, fmu_path, *arguments):
    said = run_script(PYTHON / name, fmu_path, *arguments)
    assert "missing input" not in said
    return said


def numbers(text, title):
    """All numbers behind a title, one list for each line that begins with it."""
    lines = [line for line in text.splitlines() if line.startswith(title)]
    assert lines, f"{title} is not in:\n{text}"
    return [[float(number) for number in NUMBER.findall(line[len(title) :])] for line in lines]


def first(text, title):
    return numbers(text, title)[0][0]


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("[cpr]*/*.*")), ids=lambda path: path.name)
def test_an_example_is_short(path):
    if path.suffix in (".py", ".c", ".rs") and path.parent.name in ("c", "python", "rust"):
        assert len(path.read_text(encoding="utf-8").splitlines()) < 100


def test_every_example_is_listed():
    page = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    for folder in ("c", "python", "rust"):
        for path in (EXAMPLES / folder).glob("*"):
            if path.is_file() and not path.name.startswith(("make_", "measured_")):
                assert f"({folder}/{path.name})" in page, path


def test_every_python_example_is_run():
    here = Path(__file__).read_text(encoding="utf-8")
    for path in PYTHON.glob("*.py"):
        assert path.name.startswith("make_") or f'run_python("{path.name}"' in here, path


def test_loop(fmu_path):
    text = run_python("loop.py", fmu_path)
    assert first(text, "force amplitude") == pytest.approx(BALL.loading(2e-6), rel=1e-4)
    work = BALL.loop_work(2e-6)
    assert first(text, "work of a loop") == pytest.approx(
        work, rel=2e-3
    )  # of the trapezium rule on 80 points
    per_work = 4e-14
    # of the tenth cycle the last quarter slips least: ten loops but for what the first quarter,
    # from rest, does not slip
    assert first(text, "worn volume, stepped") == pytest.approx(9.75 * work * per_work, rel=0.03)
    assert first(text, "worn volume, at once") == pytest.approx(10 * work * per_work, rel=1e-3)


def test_orbit(fmu_path):
    text = run_python("orbit.py", fmu_path)
    # 180 corners for a circle; 128 springs: 2e-4 of the limit of friction, which in the work is of
    # its path
    assert first(text, "force, stepped") == pytest.approx(
        first(text, "force, closed form"), rel=1e-3
    )
    assert first(text, "work, stepped") == pytest.approx(first(text, "work, closed form"), rel=3e-3)
    edge = (3 * 100.0 * 0.01 / (4 * 115.385e9)) ** (1 / 3)
    stick = edge * (1 - 1.5e-6 / BALL.full_slip) ** 0.5
    assert first(text, "stick radius") == pytest.approx(stick, rel=1e-3)


def test_coated_connector(fmu_path):
    text = run_python("coated_connector.py", fmu_path)
    lines = re.findall(r"^(\S+) N, +(\S+) um: (\S+) cycles, by Archard (\S+)", text, re.MULTILINE)
    rows = np.array(lines, dtype=float)
    assert len(rows) == 28
    for force in (0.5, 2.0):
        _, amplitude, life, estimate = rows[rows[:, 0] == force].T
        assert np.all(np.diff(life[np.isfinite(life)]) < 0), "more motion, shorter life"
        # the estimate leaves out that wear enlarges the contact, and that a part of it sticks
        assert np.all(life > estimate) and life[-1] < 3 * estimate[-1]
        assert life[0] > 1.3 * life[-1] / estimate[-1] * estimate[0]
    volumes = re.findall(r"lose (\S+) and (\S+) m3", text)
    assert len(volumes) == 4
    assert all(float(one) == pytest.approx(2 * float(two), rel=1e-3) for one, two in volumes)
    assert fmu_path.with_name("coated_connector.png").stat().st_size > 10_000


def test_groove(fmu_path, tmp_path):
    """A ball in a groove against Hertz' formulas, with the integrals by the midpoint rule."""
    picture = tmp_path / "groove.png"
    text = run_python("groove.py", fmu_path, picture)
    assert picture.read_bytes().startswith(b"\x89PNG")
    across, along, force, friction = (
        1 / (1 / 4e-3 - 1 / 4.16e-3),
        1 / (1 / 4e-3 + 1 / 20e-3),
        100.0,
        0.15,
    )
    normal, shear, poisson = 210e9 / (2 * 0.91), 210e9 / 2.6, 0.3
    phi = (np.arange(20000) + 0.5) * np.pi / 40000

    def integrals(k):
        weight = np.pi / 40000 / np.sqrt(np.cos(phi) ** 2 + (k * np.sin(phi)) ** 2)
        return np.sum(weight), np.sum(weight * np.sin(phi) ** 2)

    low, high = 1e-3, 1.0
    for _ in range(60):
        k = (low + high) / 2
        whole, part = integrals(k)
        low, high = (k, high) if (whole - part) / (k * k * part) > across / along else (low, k)
    major = (3 * force * part * across / (np.pi * normal)) ** (1 / 3)
    pressure = 3 * force / (2 * np.pi * k * major**2)
    depth = pressure / normal * k * major * whole
    assert numbers(text, "semi-axes")[0] == pytest.approx([major, k * major], rel=1e-4)
    assert first(text, "largest pressure") == pytest.approx(pressure, rel=1e-4)
    for title, share in (
        ("across the groove", 1 - part / whole),
        ("along the groove", part / whole),
    ):
        modulus = shear / (1 - poisson * share)
        full = friction * depth * normal / modulus
        for amplitude, reached, work, *_, volume, _ in numbers(text, title):
            theta = min(amplitude / full, 1.0)
            assert reached == pytest.approx(friction * force * (1 - (1 - theta) ** 1.5), rel=1e-3)
            loop = 4 * theta + 4 * theta * (1 - theta) ** 1.5 - 3.2 * (1 - (1 - theta) ** 2.5)
            expected = friction * force * full * loop
            if amplitude > full:
                expected = 4 * friction * force * (amplitude - 0.8 * full)
            assert work == pytest.approx(expected, rel=1e-3)
            assert volume == pytest.approx(1e5 * 4e-14 * expected, rel=1e-3)


def test_oscillator(fmu_path):
    pytest.importorskip("pathsim_fmi", reason="PathSim and its FMI toolbox are not installed")
    text = run_python("oscillator.py", fmu_path)
    amplitude, work = first(text, "amplitude"), first(text, "work of a loop")
    assert first(text, "force amplitude") == pytest.approx(60.0, rel=1e-6)  # gross slip, μF
    full_slip = BALL.full_slip
    assert amplitude > full_slip
    assert work == pytest.approx(
        4 * 60.0 * (amplitude - 0.8 * full_slip), rel=0.05
    )  # it still swings in


def test_running_in(fmu_path):
    text = run_python("running_in.py", fmu_path)
    rows = re.findall(r"friction (\S+), force +(\S+) N, worn +(\S+) µm³", text)
    (friction, _, volume), (_, greased, most), (_, dry, least) = np.array(rows, dtype=float)
    # from the work that the worn volume tells, by the law of running in
    assert friction == pytest.approx(0.7 - 0.55 * np.exp(-volume * 1e-18 / 4e-14 / 0.15), abs=1e-3)
    assert greased == pytest.approx(0.15 * 100.0)  # gross slip
    assert dry < 0.7 * 100.0 and least < volume < most


def test_joint(fmu_path):
    """The trapezium rule is of second order: errors of a doubled number of steps fall to a
    quarter.
    """
    text = run_python("joint.py", fmu_path)
    for title in ("amplitude of body 1", "work of the joints"):
        coarse, middle, fine = (line[0] for line in numbers(text, title))
        assert abs(fine - middle) < 0.4 * abs(middle - coarse)
        assert fine == pytest.approx(middle, rel=0.02)
    iterations = [float(x) for x in re.findall(r"([\d.]+) iterations", text)]
    assert len(iterations) == 3 and max(iterations) < 4  # Newton's, by the FMU's own derivatives


def test_blade_root(fmu_path):
    text = run_python("blade_root.py", fmu_path)
    works = []
    for title in ("steady load at speed", "load in step", "load a quarter apart"):
        work, volume, worst = numbers(text, title)[0][0], *numbers(text, title)[0][-2:]
        volume = float(re.search(rf"{title}.*worn ([\d.e-]+) m3", text)[1])
        assert volume == pytest.approx(4e-13 * work, rel=1e-4)
        assert worst <= 1.0
        works.append(work)
    assert works[0] != works[1] != works[2]


def test_calibrate(fmu_path):
    text = run_python("calibrate.py", fmu_path)
    for title, truth in (("friction coefficient", 0.62), ("rig stiffness", 24e6)):
        value, scatter = numbers(text, title)[0][:2]
        assert value == pytest.approx(truth, rel=0.02)
        assert abs(value - truth) < 4 * scatter < 0.1 * truth
    assert first(text, "k/sigma0") == pytest.approx(5e-14, rel=0.03)


def test_noisy_displacement(fmu_path):
    """The figures of docs/noisy_signals.md."""
    text = run_python("noisy_displacement.py", fmu_path)
    page = (ROOT / "docs" / "noisy_signals.md").read_text(encoding="utf-8").replace("−", "-")
    rows = {"as measured": "| as measured", "low-pass": "| low-pass filter"}
    rows |= {f"dead band {width} x rms": f"| dead band of {width} times" for width in (1, 2, 3)}
    for title, row in rows.items():
        cells = next(line for line in page.splitlines() if line.startswith(row)).split("|")[-3:-1]
        for noise, cell in zip((20, 50), cells):
            found = numbers(text, f"{noise} nm rms, {title}")[0]
            assert [float(number) for number in re.findall(r"[-+][\d.]+", cell)] == found
    assert abs(first(text, "no noise, low-pass")) < 0.05


def test_the_measured_loop_is_made_as_it_says(tmp_path):
    script = tmp_path / "make_measured_loop.py"
    shutil.copy(PYTHON / script.name, script)
    run(sys.executable, script)
    made = (tmp_path / "measured_loop.csv").read_text(encoding="utf-8")
    assert made == (PYTHON / "measured_loop.csv").read_text(encoding="utf-8")


PAGES = [
    path
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
    if "```python" in path.read_text("utf-8")
]
for of_the_package in ("python.md", "multibody.md"):  # test_python_guide.py runs them
    PAGES.remove(ROOT / "docs" / of_the_package)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_the_python_of_a_page_runs_as_it_stands_and_says_what_it_shows(fmu_path, tmp_path, page):
    text = page.read_text(encoding="utf-8")
    for block in re.finditer(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", text, re.DOTALL):
        code, shown = block[1], block[2]
        assert "target/fmu/FrettingContact.fmu" in code
        code = code.replace("target/fmu/FrettingContact.fmu", fmu_path.as_posix())
        said = run(sys.executable, "-c", code, cwd=tmp_path)
        assert "Warning" not in said
        if shown:
            lines = [line for line in shown.splitlines() if line != "..."]
            assert said.splitlines()[: len(lines)] == lines


def test_the_loop_of_the_readme_is_that_of_mindlin(fmu_path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = re.search(
        r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL
    )[1]
    names = {}
    exec(code.replace("target/fmu/FrettingContact.fmu", fmu_path.as_posix()), names)
    last = names["result"][-names["steps"] - 1 :]
    displacement, force = last["contact_displacement"], last["tangential_force"]
    assert np.ptp(displacement) / 2 == pytest.approx(1.5e-6, rel=1e-12)
    assert np.ptp(force) / 2 == pytest.approx(BALL.loading(1.5e-6)[0], rel=1e-6)
    # the trapezium rule on 200 points a cycle is (2π/200)²/6 = 1.6e-4 low
    assert np.trapezoid(force, displacement) == pytest.approx(BALL.loop_work(1.5e-6), rel=2e-4)
    # what the README warns of: the input as abscissa
    of_input = np.interp(
        last["time"], names["signals"]["time"], names["signals"]["tangential_displacement"]
    )
    assert np.trapezoid(force, of_input) == pytest.approx(0.65 * BALL.loop_work(1.5e-6), rel=0.01)
    assert (tmp_path / "loop.png").read_bytes().startswith(b"\x89PNG")


def test_input_derivatives_fail_inside_fmpy_as_the_readme_says(fmu_path):
    signals = np.array(
        [(0.0, 0.0), (1.0, 1e-6)], dtype=[("time", "f8"), ("tangential_displacement", "f8")]
    )
    with pytest.raises(ValueError, match="Can only assign sequence of same size"):
        fmpy.simulate_fmu(
            str(fmu_path),
            stop_time=1.0,
            output_interval=0.1,
            input=signals,
            set_input_derivatives=True,
        )


@pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="the example loads a Linux library"
)
def test_c(fmu_path, tmp_path):
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        pytest.skip("no C compiler")
    headers = Path(fmpy.__file__).parent / "c-code"
    program, folder = tmp_path / "drive", tmp_path / "contact"
    strict = ["-Wall", "-Wextra", "-Werror", "-std=gnu11"]
    run(compiler, *strict, "-I", headers, EXAMPLES / "c" / "drive.c", "-ldl", "-lm", "-o", program)
    with zipfile.ZipFile(fmu_path) as archive:
        archive.extractall(folder)
    text = run(program, folder)
    top = BALL.loading(2e-6)
    assert numbers(text, "t = 0.25 s")[0][-1] == pytest.approx(top, rel=1e-4)
    assert numbers(text, "t = 0.75 s")[0][-1] == pytest.approx(-top, rel=1e-4)
    assert first(text, "worn volume") > 0


def test_bedding_in(fmu_path, tmp_path):
    picture = tmp_path / "bedding_in.png"
    text = run_python("bedding_in.py", fmu_path, picture)
    rows = numbers(text, "after")
    cycles, touching, approach, depth, _, force = np.array(
        [[row[k] for k in (0, 1, 2, 3, 4, 6)] for row in rows]
    ).T
    assert cycles[-1] == 100_000
    # the body comes down, more summits touch, and more of the contact sticks
    assert (
        np.all(np.diff(approach) >= 0)
        and np.all(np.diff(touching) >= 0)
        and np.all(np.diff(depth) >= 0)
    )
    assert touching[-1] > 2 * touching[0] and force[-1] < force[0] <= 0.6 * 15.0 * (1 + 1e-9)
    assert picture.stat().st_size > 10_000
