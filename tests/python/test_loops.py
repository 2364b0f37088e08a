"""Tangential loading, unloading and loops under a constant load, against the closed forms."""

import numpy as np
import pytest
from closed_forms import G_STAR, BluntedSphere, Cone, PowerLaw, Sphere, Tangential

SHAPES = [Sphere(), Cone(), BluntedSphere(), PowerLaw()]
THETAS = [0.25, 0.5, 0.75, 1.0, 1.5]
FORCE_ERROR = 1e-4  # of μF: promised at the default resolution
WORK_ERROR = 1e-3  # relative: as documented


@pytest.fixture(params=SHAPES, ids=str)
def case(request):
    return Tangential(request.param, 100.0)


@pytest.fixture
def contact(case, start_contact):
    return start_contact(
        **case.shape.parameters(), normal_force=case.normal_force, wear_coefficient=0.0
    )


def test_loading(case, contact):
    path = np.linspace(0, 1.2 * case.full_slip, 61)[1:]
    force = contact.follow(["tangential_force"], tangential_displacement=path)["tangential_force"]
    assert np.max(np.abs(force - case.loading(path))) < FORCE_ERROR * case.limit


@pytest.mark.parametrize("theta", THETAS)
def test_unloading_and_reloading(case, contact, theta):
    amplitude = theta * case.full_slip
    contact.step(tangential_displacement=amplitude)
    back = np.linspace(amplitude, -amplitude, 41)[1:]
    force = contact.follow(
        ["tangential_force"], tangential_displacement=np.concatenate([back, -back])
    )["tangential_force"]
    exact = case.reversal(back, amplitude)
    assert np.max(np.abs(force - np.concatenate([exact, -exact]))) < FORCE_ERROR * case.limit


@pytest.mark.parametrize("theta", THETAS)
def test_work_of_a_loop(case, contact, theta):
    """Also that one step for each stroke does as well as many: the engine sees the straight
    line.
    """
    amplitude = theta * case.full_slip
    contact.step(tangential_displacement=amplitude)
    before = contact.get("dissipated_energy")
    for target in (-amplitude, amplitude):
        contact.step(tangential_displacement=target)
    work = contact.get("dissipated_energy") - before
    assert work == pytest.approx(case.loop_work(amplitude), rel=WORK_ERROR)


def test_first_quarter_dissipates_a_quarter(case, contact):
    amplitude = 0.75 * case.full_slip
    contact.step(tangential_displacement=amplitude)
    assert contact.get("dissipated_energy") == pytest.approx(
        case.loop_work(amplitude) / 4, rel=WORK_ERROR
    )


def test_sign_of_the_force(case, contact):
    contact.step(tangential_displacement=-0.5 * case.full_slip)
    assert contact.get("tangential_force") < 0


def test_slip_states(case, contact):
    contact.step(tangential_displacement=0.5 * case.full_slip)
    assert contact.get("slip_state") == "partial_slip"
    contact.step(tangential_displacement=1.2 * case.full_slip)
    assert contact.get("slip_state") == "gross_slip"
    assert contact.get("stick_radius", "tangential_stiffness") == [0, 0]


def test_stick_radius_and_stiffness_of_a_sphere(start_contact):
    case = Tangential(Sphere(), 100.0)
    contact = start_contact(wear_coefficient=0.0)
    for theta in (0.2, 0.5, 0.8):
        contact.step(tangential_displacement=theta * case.full_slip)
        stick = case.contact_radius * np.sqrt(1 - theta)
        # Half a cell of the default grid, 128 cells across the contact, is the coarsest reading of
        # the edge.
        assert contact.get("stick_radius") == pytest.approx(stick, abs=case.contact_radius / 256)
        assert contact.get("tangential_stiffness") == pytest.approx(
            2 * G_STAR * stick, abs=2 * G_STAR * case.contact_radius / 256
        )


def test_traction_of_a_sphere(start_contact):
    """τ = μp where it slips; inside the stick circle μp minus the pressure of a smaller Hertzian
    contact.
    """
    case, theta = Tangential(Sphere(), 100.0), 0.6
    contact = start_contact(wear_coefficient=0.0)
    contact.step(tangential_displacement=theta * case.full_slip)
    r = contact.field("radius_probe")
    shape, a = case.shape, case.contact_radius
    stick = a * np.sqrt(1 - theta)
    exact = 0.6 * (shape.pressure(r, a) - shape.pressure(r, stick))
    away = (np.abs(r - stick) > 0.03 * a) & (
        r < 0.98 * a
    )  # the kinks at c and a are rounded by a cell
    assert away.sum() > 20
    # relative to the largest traction; the transform of piecewise data is second order in the cell
    # width
    assert np.max(np.abs(contact.field("shear_traction") - exact)[away]) < 5e-3 * exact.max()


def test_flat_punch_sticks_until_it_slides(start_contact):
    b, force = 1e-4, 50.0
    contact = start_contact(
        profile="flat_punch", flat_radius=b, normal_force=force, wear_coefficient=0.0
    )
    full_slip = 0.6 * force / (2 * G_STAR * b)
    contact.step(tangential_displacement=0.99 * full_slip)
    assert contact.get("tangential_force") == pytest.approx(0.99 * 30.0, rel=1e-9)
    assert contact.get("slip_state") == "stick"
    assert contact.get("dissipated_energy") == 0.0
    contact.step(tangential_displacement=2 * full_slip)
    assert contact.get("tangential_force") == pytest.approx(30.0, rel=1e-9)
    assert contact.get("dissipated_energy") == pytest.approx(30.0 * full_slip, rel=WORK_ERROR)
