"""Normal contact through the FMU against the exact solutions: it must hold at any resolution."""

import numpy as np
import pytest
from closed_forms import E_STAR, BluntedSphere, Cone, PowerLaw, RoundedPunch, Sphere, contact_radius

# The unworn profiles are analytic in the engine: what is left is rounding and root finding.
EXACT = 1e-9

SHAPES = [
    Sphere(),
    Sphere(0.5),
    Cone(),
    PowerLaw(),
    PowerLaw(1.5, 0.05),
    BluntedSphere(),
    RoundedPunch(),
]
FORCES = [1e-3, 100.0, 1e3]


@pytest.mark.parametrize("resolution", [16, 128, 512])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_radius_and_depth_under_force(start_contact, shape, resolution):
    for force in FORCES:
        contact = start_contact(**shape.parameters(), normal_force=force, resolution=resolution)
        a = contact_radius(shape, force)
        found = contact.get(
            "contact_radius", "indentation_depth", "normal_reaction", "normal_stiffness"
        )
        assert found == pytest.approx([a, shape.depth(a), force, 2 * E_STAR * a], rel=EXACT)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_force_under_indentation(start_contact, shape):
    a = contact_radius(shape, 100.0)
    contact = start_contact(
        **shape.parameters(), normal_control="indentation", indentation=shape.depth(a)
    )
    assert contact.get("contact_radius", "normal_reaction") == pytest.approx([a, 100.0], rel=EXACT)


def test_flat_punch(start_contact):
    b, force = 1e-4, 50.0
    contact = start_contact(profile="flat_punch", flat_radius=b, normal_force=force)
    depth = force / (2 * E_STAR * b)
    assert contact.get("contact_radius", "indentation_depth") == pytest.approx(
        [b, depth], rel=EXACT
    )
    r, p = contact.field("radius_probe"), contact.field("pressure")
    inside = r < 0.99 * b
    exact = force / (2 * np.pi * b * np.sqrt(b**2 - r[inside] ** 2))
    assert inside.sum() > 10
    assert p[inside] == pytest.approx(exact, rel=1e-6)


def test_peak_pressure_of_a_sphere(start_contact):
    contact = start_contact()
    a = contact_radius(Sphere(), 100.0)
    assert contact.get("max_pressure") == pytest.approx(Sphere().pressure(0.0, a), rel=EXACT)


@pytest.mark.parametrize("shape", [BluntedSphere(), RoundedPunch()], ids=str)
def test_pressure_at_the_axis_of_a_flattened_tip(start_contact, shape):
    contact = start_contact(**shape.parameters())
    a = contact_radius(shape, 100.0)
    assert contact.field("radius_probe")[0] == 0.0
    # The probes' pressure comes from an Abel integral over the image, whose kink at the rim of the
    # flat limits it.
    assert contact.get("pressure[1]") == pytest.approx(shape.pressure_at_axis(a), rel=1e-4)


@pytest.mark.parametrize("shape", [Sphere(), Cone(), PowerLaw()], ids=str)
def test_pressure_distribution(start_contact, shape):
    contact = start_contact(**shape.parameters())
    a = contact_radius(shape, 100.0)
    r, p = contact.field("radius_probe"), contact.field("pressure")
    assert np.all(np.diff(r) > 0)
    inside = (r > 0) & (r < 0.98 * a)
    assert inside.sum() > 10
    assert p[inside] == pytest.approx(shape.pressure(r[inside], a), rel=1e-4)
    assert np.all(p[r > a] == 0.0)


@pytest.mark.parametrize("shape", [Sphere(), Cone(), PowerLaw()], ids=str)
def test_image(start_contact, shape):
    """g(a) is the depth at which the contact radius is a."""
    contact = start_contact(**shape.parameters())
    assert contact.field("image") == pytest.approx(
        shape.depth(contact.field("radius_probe")), rel=EXACT
    )


def test_no_motion_no_friction(start_contact):
    contact = start_contact()
    assert contact.get("tangential_force", "dissipated_energy", "wear_volume", "wear_depth") == [
        0,
        0,
        0,
        0,
    ]
    assert contact.get("slip_state") == "stick"
    assert contact.get("stick_radius") == contact.get("contact_radius")
