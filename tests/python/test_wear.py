"""Wear by following each stroke (loading = transient)."""

import numpy as np
import pytest
from closed_forms import E_STAR, G_STAR, MU, SLIDING, Cone, Sphere, Tangential
from histories import history

PER_WORK = 4e-14  # m³/J, the default k/σ₀
HARDNESS = 8e9  # Pa, the default
IDENTITY = 1e-3  # relative: worn volume against (k/σ₀) × friction work, promised for every scene


def strokes(amplitude, cycles, points):
    """Closed cycles from +amplitude back to +amplitude."""
    half = amplitude * np.cos(np.linspace(0, np.pi, points + 1)[1:])
    return np.tile(np.concatenate([half, -half]), cycles)


def faster(factor):
    """Wear parameters that make few cycles change the profile visibly."""
    return {"wear_coefficient": factor * PER_WORK * HARDNESS}


@pytest.mark.parametrize("shape", [Sphere(), Cone()], ids=str)
@pytest.mark.parametrize("theta", [0.6, 1.5])
def test_volume_is_friction_work(start_contact, shape, theta):
    """The work is integrated here from T and U, so it shares no code with the volume."""
    amplitude = theta * Tangential(shape, 100.0).full_slip
    contact = start_contact(**shape.parameters(), **faster(2000))
    contact.step(tangential_displacement=amplitude)
    start = contact.get("tangential_force", "wear_volume", "dissipated_energy")
    path = strokes(amplitude, 3, 200)
    result = contact.follow(
        ["tangential_force", "wear_volume", "dissipated_energy"], tangential_displacement=path
    )
    force = np.concatenate([[start[0]], result["tangential_force"]])
    work = np.trapezoid(force, np.concatenate([[amplitude], path]))
    volume = result["wear_volume"][-1] - start[1]
    assert result["dissipated_energy"][-1] - start[2] == pytest.approx(
        volume / (2000 * PER_WORK), rel=1e-9
    )
    # The trapezium rule errs by 1e-4 at 200 points a stroke, and the elastic energy at +U₀ changes
    # a little from cycle to cycle as the contact wears: together below 1 %.
    assert volume == pytest.approx(2000 * PER_WORK * work, rel=1e-2)


def test_volume_is_friction_work_without_visible_wear(start_contact):
    """As above at the true rate of wear, where the loop closes exactly: the strict bound holds."""
    amplitude = 0.6 * Tangential(Sphere(), 100.0).full_slip
    contact = start_contact()
    contact.step(tangential_displacement=amplitude)
    start = contact.get("tangential_force", "wear_volume")
    path = strokes(amplitude, 1, 400)
    result = contact.follow(["tangential_force", "wear_volume"], tangential_displacement=path)
    force = np.concatenate([[start[0]], result["tangential_force"]])
    work = np.trapezoid(force, np.concatenate([[amplitude], path]))
    assert result["wear_volume"][-1] - start[1] == pytest.approx(PER_WORK * work, rel=IDENTITY)


@pytest.mark.parametrize(("theta", "error"), [(0.6, 0.05), (3.0, 0.02)])
def test_volume_is_the_integral_of_depth(start_contact, theta, error):
    """64 probes see the worn ring as a polygon: 2 % of its volume, and 5 % where its inner edge is
    steep.
    """
    amplitude = theta * Tangential(Sphere(), 100.0).full_slip
    contact = start_contact(**faster(5000))
    contact.follow(["wear_volume"], tangential_displacement=strokes(amplitude, 3, 20))
    r, depth = contact.field("radius_probe"), contact.field("worn_depth")
    volume = np.pi * np.trapezoid(depth, r**2)
    assert volume == pytest.approx(contact.get("wear_volume"), rel=error)
    # The deepest point lies between probes; depth varies by less than this from one to the next.
    assert depth.max() == pytest.approx(contact.get("wear_depth"), rel=0.05)
    assert depth.max() <= contact.get("wear_depth") * (1 + 1e-9)


def test_wear_never_heals(start_contact):
    contact = start_contact(**faster(2000))
    last, depths = (0.0, 0.0, 0.0), np.zeros(64)
    radius = contact.field("radius_probe")
    for force, displacement in history(7, steps=60):
        contact.step(normal_force=force, tangential_displacement=displacement)
        now = contact.get("wear_volume", "wear_depth", "dissipated_energy")
        assert now[0] >= last[0] and now[2] >= last[2]
        # Between two profile updates the depth is an estimate, good to half of the tolerance times
        # the indentation depth: here each line, two thousand times faster than steel, wears several
        # hundredths of that depth.
        room = 5e-4 * 3.48e-6
        assert now[1] >= last[1] - room
        last = now
        here = contact.field("radius_probe")
        if np.array_equal(here, radius):  # the probes may follow a growing contact
            assert np.all(contact.field("worn_depth") >= depths - room)
        radius, depths = here, contact.field("worn_depth")
    assert last[0] > 0


def test_sticking_contact_does_not_wear(start_contact):
    """A flat punch below its limit sticks everywhere: not a trace of wear, however often."""
    b, force = 1e-4, 50.0
    contact = start_contact(profile="flat_punch", flat_radius=b, normal_force=force, **faster(1e6))
    amplitude = 0.9 * MU * force / (2 * G_STAR * b)
    contact.follow(["wear_volume"], tangential_displacement=strokes(amplitude, 5, 10))
    assert contact.get("wear_volume", "wear_depth", "dissipated_energy") == [0, 0, 0]


def test_sticking_centre_does_not_wear(start_contact):
    """Under constant depth the stick circle stays where it is, and inside it not a trace wears."""
    shape, c = Sphere(), 0.4
    depth = 3.5e-6
    a = np.sqrt(depth * 0.01)
    amplitude = SLIDING * depth * (1 - c**2)
    contact = start_contact(normal_control="indentation", indentation=depth, **faster(5000))
    contact.follow(["wear_volume"], tangential_displacement=strokes(amplitude, 20, 8))
    r, worn = contact.field("radius_probe"), contact.field("worn_depth")
    assert contact.get("wear_depth") > 1e-9
    # The engine may place the stick edge within a cell of its exact place: 1/128 of the contact.
    assert np.all(worn[r < (c - 1 / 128) * a] == 0.0)
    assert contact.get("stick_radius") == pytest.approx(c * a, abs=a / 128)
    assert shape.depth(a) == pytest.approx(depth)


def test_no_wear_coefficient_no_wear(start_contact):
    contact = start_contact(wear_coefficient=0.0)
    contact.follow(["wear_volume"], tangential_displacement=strokes(5e-6, 2, 20))
    assert contact.get("wear_volume", "wear_depth") == [0, 0]
    assert np.all(contact.field("worn_depth") == 0.0)
    assert contact.get("dissipated_energy") > 0


def test_wear_of_steady_sliding(start_contact):
    """V = (kμ/σ₀) F_N s; the stroke's elastic part, 0.4 u_max for a sphere, does not slide."""
    contact = start_contact()
    path = 1e-3
    contact.step(tangential_displacement=path)
    case = Tangential(Sphere(), 100.0)
    assert contact.get("wear_volume") == pytest.approx(
        PER_WORK * case.limit * (path - 0.4 * case.full_slip), rel=IDENTITY
    )


def test_central_wear_of_a_sliding_sphere(start_contact):
    """Independent runs: w₀/d₀ = 0.4893 at S = κE*s/a₀ = 1 and 0.7972 at S = 2."""
    case = Tangential(Sphere(), 100.0)
    contact = start_contact(**faster(100))
    for sliding, depth in ((1.0, 0.4893), (2.0, 0.7972)):
        path = sliding * case.contact_radius / (100 * PER_WORK * MU * E_STAR)
        contact.step(tangential_displacement=path)
        # 1 %: the figures are good to their digits; the elastic lead-in adds 0.4 u_max of path
        # without wear, which is less than 1e-3 of it here.
        assert contact.get("worn_depth[1]") / case.depth == pytest.approx(depth, rel=0.01)


def test_volume_scales_with_the_wear_coefficient(start_contact):
    """Twice the coefficient, half the strokes' worth: at invisible wear the volume is proportional
    to k.
    """
    volumes = []
    for factor in (1.0, 2.0):
        contact = start_contact(**faster(factor))
        contact.follow(["wear_volume"], tangential_displacement=strokes(2e-6, 1, 10))
        volumes.append(contact.get("wear_volume"))
    assert volumes[1] == pytest.approx(
        2 * volumes[0], rel=1e-4
    )  # the profile changes by about 1e-5 of d


def test_steady_sliding_stays_sliding(start_contact):
    """Under constant load T = μF_N and all springs slip, also in the steps in which the profile is
    brought up to date: masters that use tangential_stiffness would otherwise see the joint seize
    for one step.
    """
    case = Tangential(Sphere(), 100.0)
    contact = start_contact(**faster(100))
    for displacement in np.linspace(1.1, 6.0, 300) * case.full_slip:
        contact.step(tangential_displacement=displacement)
        assert contact.get("slip_state", "tangential_stiffness") == ["gross_slip", 0.0], (
            displacement
        )
        assert contact.get("tangential_force") == pytest.approx(case.limit, rel=IDENTITY)
