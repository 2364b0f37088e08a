"""The tests' own closed forms, against published figures and against each other."""

import numpy as np
import pytest
from closed_forms import (
    E_STAR,
    G_STAR,
    BluntedSphere,
    Cone,
    PowerLaw,
    RoundedPunch,
    Sphere,
    Tangential,
    contact_radius,
)
from scipy.integrate import quad

SHAPES = [Sphere(), Cone(), PowerLaw(), BluntedSphere(), RoundedPunch()]


def test_steel_ball_figures():
    # Steel on steel, R = 10 mm, 100 N, μ = 0.6; the figures are given to six digits.
    case = Tangential(Sphere(), 100.0)
    found = [
        E_STAR,
        G_STAR,
        case.contact_radius,
        case.depth,
        case.full_slip,
        Sphere().pressure(0.0, case.contact_radius),
    ]
    assert found == pytest.approx(
        [115.385e9, 95.0226e9, 186.626e-6, 3.48291e-6, 2.53755e-6, 1.37088e9], rel=5e-6
    )


@pytest.mark.parametrize(
    ("theta", "force", "work"),
    [
        (0.25, 21.0289, 1.27356e-6),
        (0.5, 38.7868, 11.0828e-6),
        (0.75, 52.5, 41.8696e-6),
        (1.0, 60.0, 121.802e-6),
    ],
)
def test_steel_ball_loops(theta, force, work):
    case = Tangential(Sphere(), 100.0)
    amplitude = theta * case.full_slip
    assert case.loading(amplitude)[0] == pytest.approx(force, rel=5e-6)
    assert case.loop_work(amplitude) == pytest.approx(work, rel=1e-5)  # six digits given


def test_blunted_sphere_figures():
    case = Tangential(BluntedSphere(), 100.0)
    found = [case.contact_radius, case.depth, case.full_slip]
    assert found == pytest.approx([188.717e-6, 3.02029e-6, 2.20050e-6], rel=5e-6)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_force_is_the_integral_of_contact_radius(shape):
    # dF_N/dd = 2 E* a for every body of revolution: depth and force must belong together.
    a = contact_radius(shape, 100.0)
    h = 1e-5 * a
    slope = (shape.force(a + h) - shape.force(a - h)) / (shape.depth(a + h) - shape.depth(a - h))
    assert slope == pytest.approx(2 * E_STAR * a, rel=1e-8)  # h² of the central difference


@pytest.mark.parametrize(
    "shape", [Sphere(), Cone(), PowerLaw()], ids=lambda shape: type(shape).__name__
)
def test_pressure_carries_the_force(shape):
    a = contact_radius(shape, 100.0)
    total, _ = quad(
        lambda r: 2 * np.pi * r * float(shape.pressure(np.array([r]), a)[0]), 0, a, epsrel=1e-9
    )
    assert total == pytest.approx(
        100.0, rel=1e-7
    )  # the quadrature meets a root singularity at r = a
