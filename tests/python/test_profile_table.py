"""Profiles from a file."""

import numpy as np
import pytest
from closed_forms import Sphere, Tangential
from conftest import ROOT

CASE = Tangential(Sphere(), 100.0)


def write(path, r, f, separator=" ", head=""):
    path.write_text(head + "".join(f"{x:.12e}{separator}{y:.12e}\n" for x, y in zip(r, f)))
    return str(path)


@pytest.fixture
def sampled_sphere(tmp_path):
    r = np.linspace(0, 400e-6, 41)
    return write(tmp_path / "sphere.txt", r, r**2 / 0.02)


def test_sampled_sphere_is_the_parabola(start_contact, sampled_sphere):
    """A table is linear in r² between its points, as the parabola is everywhere: both agree to the
    digits of the file.
    """
    table = start_contact(profile="table", profile_file=sampled_sphere, wear_coefficient=0.0)
    parabola = start_contact(wear_coefficient=0.0)
    path = np.concatenate([np.linspace(0, 2e-6, 11)[1:], np.linspace(2e-6, -2e-6, 21)[1:]])
    outputs = ["tangential_force", "contact_radius", "indentation_depth", "dissipated_energy"]
    found, expected = (
        contact.follow(outputs, tangential_displacement=path) for contact in (table, parabola)
    )
    for name in outputs:
        assert found[name] == pytest.approx(
            expected[name], rel=1e-6, abs=1e-6 * np.max(np.abs(expected[name]))
        ), name


def test_worn_sampled_sphere_is_the_worn_parabola(start_contact, sampled_sphere):
    volumes = []
    for parameters in ({"profile": "table", "profile_file": sampled_sphere}, {}):
        contact = start_contact(**parameters, wear_coefficient=1.0)
        contact.follow(["wear_volume"], tangential_displacement=np.tile([1.5e-6, -1.5e-6], 5))
        volumes.append(contact.get("wear_volume"))
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-4)  # a tenth of the default tolerance


@pytest.mark.parametrize("separator", [" ", "\t", ",", "; "])
def test_separators_and_comments(start_contact, tmp_path, separator):
    r = np.linspace(0, 400e-6, 41)
    path = write(
        tmp_path / "with blanks and ü.txt", r, r**2 / 0.02, separator, "# r f\n\n   # in m\n"
    )
    contact = start_contact(profile="table", profile_file=path)
    assert contact.get("contact_radius") == pytest.approx(CASE.contact_radius, rel=1e-6)
    assert contact.get("profile_file") == path


@pytest.mark.parametrize(("unit", "factor"), [("m", 1.0), ("mm", 1e3), ("um", 1e6)])
def test_files_of_instruments(start_contact, tmp_path, unit, factor):
    """A byte-order mark, a header, falling r, decimal commas, CRLF and a height on the axis: the
    same ball in each unit.
    """
    r = np.linspace(400e-6, 0, 41)
    lines = [f"{x * factor:.9e};{(2e-6 + x**2 / 0.02) * factor:.9e}".replace(".", ",") for x in r]
    path = tmp_path / "tip.csv"
    path.write_bytes(b"\xef\xbb\xbf" + "\r\n".join(["radius;height", *lines]).encode())
    contact = start_contact(profile="table", profile_file=str(path), profile_unit=unit)
    assert contact.get("contact_radius") == pytest.approx(CASE.contact_radius, rel=1e-6)
    assert contact.get("indentation_depth") == pytest.approx(CASE.depth, rel=1e-6)
    assert any(
        "f(0) = " in text and "e-6 m" in text and "subtracted" in text
        for _, text in contact.messages
    )


def test_shipped_profile(start_contact):
    """The example's tip: softer than the ball it came from, and within the table."""
    path = ROOT / "examples" / "profiles" / "worn_ball_tip.txt"
    contact = start_contact(profile="table", profile_file=str(path))
    radius, depth, force = contact.get("contact_radius", "indentation_depth", "normal_reaction")
    assert force == pytest.approx(100.0, rel=1e-9)
    r, f = np.loadtxt(path).T
    # F_N = 2 ∫₀ᵃ q dx, here with the image of the points, g(x) = 2x Σ slope·(√(x²−rᵢ²) −
    # √(x²−rᵢ₊₁²)).
    x = radius * (np.arange(4000) + 0.5) / 4000
    roots = np.sqrt(np.clip(x[:, None] ** 2 - r[None, :] ** 2, 0, None))
    image = 2 * x * ((roots[:, :-1] - roots[:, 1:]) @ (np.diff(f) / np.diff(r**2)))
    modulus = 210e9 / (2 * (1 - 0.3**2))
    assert 2 * modulus * np.sum(depth - image) * radius / 4000 == pytest.approx(
        100.0, rel=1e-4
    )  # midpoint rule
    assert radius > CASE.contact_radius
