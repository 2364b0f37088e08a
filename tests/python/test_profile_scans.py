"""Line scans become tables that the FMU accepts and that press like the body without noise."""

import subprocess
import sys
from math import inf

import numpy as np
import pytest
from conftest import ROOT
from fretting_contact.component import ContactError
from fretting_contact.image_shapes import image_of_table
from fretting_contact.profile import Scan, ScanError, fit_scan, main, read_scan, write_table
from fretting_contact.text_table import TextTableError, parse_columns
from scans import BALL, ROUNDED_FLAT, SMALL_BALL, TILT, WORN_FLAT, at_depth, at_load

SEEDS = range(30)
NOISES = [5e-9, 20e-9, 50e-9]  # m
PITCHES = [1e-6, 2e-6, 5e-6]  # m


@pytest.mark.parametrize("body", [BALL, SMALL_BALL, WORN_FLAT], ids=lambda body: body.name)
def test_noisy_scans_press_like_the_body(start_contact, tmp_path, body):
    """Noise and pitch run through all pairs; the whole study is profile_study.py."""
    exact = {
        (noise, multiple): at_depth(start_contact, body.start_values(tmp_path), multiple * noise)
        for noise in NOISES
        for multiple in (10, 30)
    }
    for seed in SEEDS:
        noise, pitch = NOISES[seed % 3], PITCHES[seed // 3 % 3]
        table = tmp_path / "table.txt"
        write_table(fit_scan(body.scan(noise, pitch, seed)), table)
        for multiple in (10, 30):
            true = exact[noise, multiple]
            found = at_load(start_contact, table, true.load)
            scene = f"seed {seed}, {noise} m, {pitch} m, d = {multiple} noise"
            assert found.radius == pytest.approx(true.radius, rel=0.01), scene
            assert found.depth == pytest.approx(true.depth, rel=0.02), scene


def test_rounded_edge(start_contact, tmp_path):
    """A worn flat whose edge is rounded: 5 nm at every pitch."""
    exact = at_depth(start_contact, ROUNDED_FLAT.start_values(tmp_path), 50e-9)
    for seed in range(6):
        fit = fit_scan(ROUNDED_FLAT.scan(5e-9, PITCHES[seed % 3], seed))
        write_table(fit, tmp_path / "table.txt")
        found = at_load(start_contact, tmp_path / "table.txt", exact.load)
        assert found.radius == pytest.approx(exact.radius, rel=0.01)
        assert found.depth == pytest.approx(exact.depth, rel=0.02)
        assert fit.centre == pytest.approx(40e-6, abs=1e-6)
        assert fit.tilt == pytest.approx(TILT, abs=1e-4)


def test_scan_without_noise_is_the_ball():
    """In closed form: g = x²/R, tilt and centre of a sphere are one."""
    fit = fit_scan(BALL.scan(0.0, 2e-6, 0))
    assert fit.tip_radius == pytest.approx(0.01, rel=1e-5)
    assert fit.flank_radius == pytest.approx(0.01, rel=1e-5)
    assert fit.image == pytest.approx(fit.radius**2 / 0.01, rel=1e-5, abs=1e-15)
    assert fit.centre - 0.01 * np.tan(TILT - fit.tilt) == pytest.approx(40e-6, abs=1e-9)
    assert fit.rms < 1e-12 and fit.dropped == 0 and fit.is_peak


def test_scan_without_noise_of_a_worn_flat():
    """In closed form: g = x √(x² − b²)/R; here tilt and centre are both known."""
    fit = fit_scan(WORN_FLAT.scan(0.0, 2e-6, 0))
    exact = fit.radius * np.sqrt(np.maximum(fit.radius**2 - 100e-6**2, 0)) / 0.01
    assert np.max(np.abs(fit.image - exact)) < 1e-3 * exact[-1]
    assert fit.centre == pytest.approx(40e-6, abs=1e-7)
    assert fit.tilt == pytest.approx(TILT, rel=1e-3)
    assert fit.tip_radius == inf and fit.flat_radius == pytest.approx(100e-6, rel=0.03)


@pytest.mark.parametrize("exponent", [1.0, 4.0])
def test_images_of_a_table_converge(exponent):
    """The table's image against κ xⁿ: second order in the distance of the points for r⁴, first
    order for a cone's kink in r².
    """
    errors = []
    for count in (50, 100, 200):
        r = np.linspace(0, 1, count + 1)
        kappa = {1.0: np.pi / 2, 4.0: 8 / 3}[exponent]
        errors.append(np.max(np.abs(image_of_table(r, r**exponent) - kappa * r**exponent)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx({1.0: 1.0, 4.0: 2.0}[exponent], abs=0.1)


def test_outliers_are_dropped_and_reported():
    scan = BALL.scan(10e-9, 2e-6, 3)
    scan.z[[100, 260, 300]] += 1e-6
    fit = fit_scan(scan)
    assert fit.dropped == 3
    assert fit.tip_radius == pytest.approx(0.01, rel=0.01)


@pytest.mark.parametrize("seed", [1, 5, 7])
def test_few_wide_outliers_are_dropped(seed):
    """Three spikes of 5 µm on a worn flat with 20 nm of noise: 0 to 2 stayed in, or the scan was
    refused.
    """
    scan = WORN_FLAT.scan(20e-9, 2e-6, seed)
    random = np.random.default_rng(300 + seed)
    wrong = random.choice(len(scan.x), 3, replace=False)
    scan.z[wrong] += 5e-6 * random.choice([-1, 1], 3)
    fit = fit_scan(scan)
    assert fit.dropped == 3 and np.max(np.abs(fit.residual)) < 6 * 20e-9
    assert fit.tip_radius == inf and fit.flat_radius == pytest.approx(100e-6, rel=0.05)


def tilted(body, degrees, centre, first=0.0):
    """A scan of a body about `centre` in units of the half-width; its first position is `first`."""
    x = np.linspace(-body.half_width, body.half_width, 401)
    heights = body.height(np.abs(x - centre * body.half_width)) + np.tan(np.radians(degrees)) * x
    noise = 2e-8 * np.random.default_rng(0).standard_normal(x.size)
    return Scan(x - x[0] + first, heights + noise)


@pytest.mark.parametrize("degrees", [-5.0, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("centre", [0.0, 0.3, 0.6])
@pytest.mark.parametrize("body", [BALL, SMALL_BALL, WORN_FLAT], ids=lambda body: body.name)
def test_a_tilt_does_not_matter(body, centre, degrees):
    """Up to 5°, also where positions begin at 0 as radii do."""
    for first in (0.0, -3e-4):
        fit = fit_scan(tilted(body, degrees, centre, first))
        assert not fit.mirrored
        assert np.max(np.abs(fit.height - body.height(fit.radius))) < 2 * 2e-8
        if body is WORN_FLAT:
            middle = first + body.half_width * (1 + centre)
            assert fit.centre == pytest.approx(middle, abs=3e-6)
            assert np.degrees(fit.tilt) == pytest.approx(degrees, abs=0.05)


@pytest.mark.parametrize("degrees", [0.0, 1.0, 5.0])
def test_a_tilted_cone_is_a_cone(degrees):
    x = np.linspace(0.0, 1e-3, 401)
    noise = 2e-8 * np.random.default_rng(0).standard_normal(x.size)
    z = 0.02 * np.abs(x - 6.5e-4) + np.tan(np.radians(degrees)) * x + noise
    fit = fit_scan(Scan(x, z))
    assert fit.centre == pytest.approx(6.5e-4, abs=1e-6) and fit.tip_radius == 0.0
    assert fit.height == pytest.approx(0.02 * fit.radius, abs=4e-8)


def test_a_scan_of_one_position_is_named():
    with pytest.raises(ScanError, match="the positions are all 1 m: give a scan along x"):
        fit_scan(Scan(np.ones(50), np.arange(50.0)))


def test_given_centre_and_radius():
    fit = fit_scan(WORN_FLAT.scan(10e-9, 2e-6, 5), centre=40e-6, radius=300e-6)
    assert (fit.centre, fit.radius[-1]) == pytest.approx((40e-6, 300e-6))
    assert np.all(np.diff(fit.image) > 0) and fit.unused > 0
    with pytest.raises(ScanError, match=r"radius = 0.0006 m, but the scan reaches 0.00046 m"):
        fit_scan(WORN_FLAT.scan(10e-9, 2e-6, 5), centre=40e-6, radius=600e-6)


def test_scans_with_gaps_or_in_another_order_are_refused():
    """The message names the point and says what to do."""
    whole = BALL.scan(10e-9, 2e-6, 3)
    count = len(whole.x)
    gap, missing = whole.z.copy(), whole.x.copy()
    gap[7], missing[count - 1] = np.nan, np.inf
    swapped = np.r_[0:5, 6, 5, 7:count]
    turned = Scan(whole.x[swapped], whole.z[swapped])
    for scan, message in (
        (Scan(whole.x, gap), r"z\[7\] = nan is not finite: leave this point out"),
        (Scan(missing, whole.z), rf"x\[{count - 1}\] = inf is not finite"),
        (turned, r"x\[6\] = .* m is below x\[5\] = .*: sort the"),
        (Scan(whole.x[::-1], whole.z[::-1]), r"x\[1\] = .* m is below x\[0\]"),
        (Scan(whole.x[1:], whole.z), rf"x has {count - 1} points and z has {count}: give one"),
        (Scan(np.ones((count, 2)), whole.z), r"x has the shape .*: give one number"),
        (Scan(["a"] * count, whole.z), "x of the scan is no array of numbers"),
    ):
        with pytest.raises(ScanError, match=message):
            fit_scan(scan)
    fit = fit_scan(Scan(whole.x.tolist(), whole.z.tolist()))
    assert fit.tip_radius == fit_scan(whole).tip_radius


@pytest.mark.parametrize("name", ["unit", "z_unit"])
def test_an_unknown_unit_is_answered_with_those_that_there_are(name, tmp_path):
    path = tmp_path / "scan.txt"
    path.write_text("0 0\n")
    with pytest.raises(ScanError, match=rf"{name} = 'inch' .*: give one of m, mm, um, nm"):
        read_scan(path, **{name: "inch"})


def test_a_refused_table_becomes_one_that_is_accepted(start_contact, tmp_path):
    """A noisy half profile is refused; the command that the message names corrects it."""
    r = np.arange(0, 450e-6, 2e-6)
    f = WORN_FLAT.height(r) + 20e-9 * np.random.default_rng(4).standard_normal(len(r))
    table, corrected = tmp_path / "table.txt", tmp_path / "corrected.txt"
    np.savetxt(table, np.column_stack([r, f]))
    with pytest.raises(ContactError, match="not monotone.*cargo fmu profile"):
        start_contact(profile="table", profile_file=str(table))
    assert main([str(table), "-o", str(corrected)]) == 0
    radius = start_contact(profile="table", profile_file=str(corrected)).get("contact_radius")
    assert radius == pytest.approx(188.717e-6, rel=0.01)  # closed form, 100 N


def test_a_valley_is_not_turned_over():
    scan = BALL.scan(10e-9, 2e-6, 3)
    fit = fit_scan(Scan(scan.x, -scan.z))
    assert not fit.is_peak and fit.tip_radius == pytest.approx(0.01, rel=0.01)


FILES = {
    "decimal commas": "x [µm];z [µm]\r\n0,5;1,25\r\n1;2\r\n",
    "tabs": "\ufeffx\tz\n0,5\t1,25\n1,0\t2,0\n",
    "blanks": "# comment\n0.5 1.25 # more\n\n1 2",
    "commas": "x,z\n0.5,1.25\n1,2\n",
}


@pytest.mark.parametrize("kind", FILES)
def test_text_formats(kind):
    assert parse_columns(FILES[kind]).tolist() == [[0.5, 1.25], [1.0, 2.0]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0 0\n1 deep\n", 'line 2, "1 deep": `deep` is not a number'),
        ("0,5 1,25\n", 'line 1, "0,5 1,25": 4 column'),
        ("0 0\n1 nan\n", 'line 2, "1 nan": both numbers have to be finite'),
        ("x z\nm m\n0 0\n", 'line 2, "m m": a second line of words'),
        ("x z\n0 0\nx z\n", 'line 3, "x z": `x` is not a number'),
    ],
)
def test_messages_quote_the_line(text, message):
    with pytest.raises(TextTableError, match=message):
        parse_columns(text)


def test_command_line(start_contact, tmp_path):
    """A file in µm with a header in another encoding becomes a table, a picture and a report."""
    scan = WORN_FLAT.scan(20e-9, 5e-6, 1)
    lines = [
        f"{x * 1e6:.2f};{z * 1e6:.4f}".replace(".", ",") for x, z in zip(scan.x[::-1], scan.z[::-1])
    ]
    source = tmp_path / "scan.csv"
    source.write_bytes(("x [µm];z [µm]\r\n" + "\r\n".join(lines)).encode("latin-1"))
    output = tmp_path / "tip.txt"
    command = [
        sys.executable,
        "-m",
        "fretting_contact.profile",
        str(source),
        "--unit",
        "um",
        "-o",
        str(output),
    ]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT / "python", timeout=120)
    assert done.returncode == 0, done.stderr
    for part in ("deg taken off", "centre: x = 4", "radius of curvature", "nm rms", str(output)):
        assert part in done.stdout, done.stdout
    assert output.with_suffix(".png").stat().st_size > 10_000
    radius = start_contact(profile="table", profile_file=str(output)).get("contact_radius")
    assert radius == pytest.approx(188.717e-6, rel=0.01)  # physics of the blunted sphere, 100 N
    assert np.allclose(read_scan(source, "um").x, scan.x)


def test_command_line_refuses_what_is_no_scan(tmp_path, capsys):
    path = tmp_path / "flat.txt"
    noise = np.random.default_rng(1).standard_normal(200) * 1e-8
    np.savetxt(path, np.column_stack([np.arange(200) * 1e-6, noise]))
    assert main([str(path), "-o", str(tmp_path / "tip.txt")]) == 1
    assert "scan further out" in capsys.readouterr().err
    path.write_text("0 0\n1 2\n")
    assert main([str(path), "-o", str(tmp_path / "tip.txt")]) == 1
    assert "2 point(s), but at least 20 are needed" in capsys.readouterr().err


def test_command_line_refuses_files_that_cannot_be_used(tmp_path, capsys):
    """One line with the path and what to do; nothing is written."""
    x = np.linspace(-400, 400, 201)
    scan = tmp_path / "scan.txt"
    np.savetxt(scan, np.column_stack([x, x**2 / 20_000]))
    words, utf16 = tmp_path / "words.txt", tmp_path / "utf16.txt"
    words.write_text("x z\n0 0\n1 high\n")
    utf16.write_text(scan.read_text(), encoding="utf-16")
    table, unmade = tmp_path / "tip.txt", tmp_path / "no folder"
    before = sorted(tmp_path.iterdir())
    for source, output, parts in [
        (tmp_path / "none.txt", table, ["none.txt' cannot be read", "check the path"]),
        (tmp_path, table, ["cannot be read", "check the path"]),
        (words, table, [f'{words}, line 3, "1 high"', "correct the line"]),
        (utf16, table, [f"{utf16}: it is UTF-16", "save it as text in UTF-8"]),
        (scan, unmade / "tip.txt", [f"there is no folder {str(unmade)!r}", "make it"]),
        (scan, tmp_path, [f"{str(tmp_path)!r} is a folder", "give the path of a file"]),
        (scan, tmp_path / "tip.png", ["is the name of the picture", "such as .txt"]),
    ]:
        assert main([str(source), "--unit", "um", "-o", str(output)]) == 1
        said = capsys.readouterr().err
        assert all(part in said for part in parts) and len(said.splitlines()) == 1, said
    with pytest.raises(SystemExit):
        main([str(scan), "--center", "nan", "-o", str(table)])
    assert "'nan': give a finite number" in capsys.readouterr().err
    assert sorted(tmp_path.iterdir()) == before
