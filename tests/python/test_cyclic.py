"""Whole cycles at a time (loading = cyclic)."""

import numpy as np
import pytest
from closed_forms import SLIDING, Sphere, Tangential

PER_WORK = 4e-14  # m³/J, the default k/σ₀
HARDNESS = 8e9  # Pa, the default
CASE = Tangential(Sphere(), 100.0)


def life_unit(amplitude, per_work=PER_WORK):
    """N₀ = π a₀² d₀ / ((k/σ₀) μ F_N U₀), cycles."""
    return np.pi * CASE.contact_radius**2 * CASE.depth / (per_work * CASE.limit * amplitude)


@pytest.mark.parametrize("theta", [0.5, 0.84, 1.5])
def test_few_cycles_agree_with_following_them(start_contact, theta):
    """With invisible wear a cycle is the closed form: 4 (kμ/σ₀) ∫ 2πr p s dr equals (k/σ₀) times
    the loop's work.
    """
    amplitude = theta * CASE.full_slip
    whole = start_contact(loading="cyclic", displacement_amplitude=amplitude, frequency=50.0)
    whole.step(0.1)  # five cycles
    assert whole.get("wear_volume") == pytest.approx(
        5 * PER_WORK * CASE.loop_work(amplitude), rel=1e-3
    )
    assert whole.get("tangential_force") == pytest.approx(
        CASE.loading(amplitude)[0], abs=1e-4 * CASE.limit
    )

    followed = start_contact()
    followed.step(tangential_displacement=amplitude)
    before = followed.get("wear_volume")
    for _ in range(5):
        followed.step(tangential_displacement=-amplitude)
        followed.step(tangential_displacement=amplitude)
    # Both promise 1e-3 of the work of a loop.
    assert followed.get("wear_volume") - before == pytest.approx(whole.get("wear_volume"), rel=2e-3)


def test_visible_wear_agrees_with_following_each_cycle(start_contact):
    """A tenth of the life unit in 40 fast-wearing cycles, transient, against as many whole ones."""
    amplitude, cycles = 0.84 * CASE.full_slip, 40
    per_work = PER_WORK * 0.1 * life_unit(amplitude) / cycles
    wear = {"wear_coefficient": per_work * HARDNESS}
    whole = start_contact(loading="cyclic", displacement_amplitude=amplitude, frequency=1.0, **wear)
    for _ in range(cycles):
        whole.step(1.0)
    followed = start_contact(**wear)
    followed.step(tangential_displacement=amplitude)
    before = followed.get("wear_volume")
    for _ in range(cycles):
        followed.step(tangential_displacement=-amplitude)
        followed.step(tangential_displacement=amplitude)
    # The cycle-averaged form freezes the profile within a cycle, of which each is 1/40 of the
    # change: 1 %.
    assert followed.get("wear_volume") - before == pytest.approx(whole.get("wear_volume"), rel=0.01)
    assert followed.get("indentation_depth") == pytest.approx(
        whole.get("indentation_depth"), rel=2e-3
    )


def test_life_under_constant_depth(start_contact):
    """Parabola, c = 0.4 a₀: V/(a₀²d₀) at Ñ, all digits converged; the end state is closed."""
    table = {0.16: 0.268719, 0.36: 0.619257, 0.64: 0.959203, 1.0: 1.097833, 9.0: 1.131108}
    amplitude = SLIDING * CASE.depth * (1 - 0.4**2)
    contact = start_contact(
        normal_control="indentation",
        indentation=CASE.depth,
        loading="cyclic",
        displacement_amplitude=amplitude,
        frequency=1.0,
    )
    unit, now = life_unit(amplitude), 0.0
    for life, volume in table.items():
        contact.step((life - now) * unit)
        now = life
        # 2 %: the accuracy asked of this scene at the default resolution and tolerance.
        assert contact.get("wear_volume") / (CASE.contact_radius**2 * CASE.depth) == pytest.approx(
            volume, rel=0.02
        )
    assert contact.get("stick_radius") == pytest.approx(0.4 * CASE.contact_radius, rel=0.01)
    # The image has kept its shape inside the stick radius and is flat outside: that part carries
    # nothing any more.
    x, image = contact.field("radius_probe"), contact.field("image")
    stuck, flat = (
        x < 0.39 * CASE.contact_radius,
        (x > 0.45 * CASE.contact_radius) & (x < 1.2 * CASE.contact_radius),
    )
    assert stuck.sum() > 10 and flat.sum() > 20
    assert image[stuck] == pytest.approx(CASE.shape.depth(x[stuck]), rel=1e-9)
    assert image[flat] == pytest.approx(CASE.depth, rel=5e-3)


def test_life_under_constant_force(start_contact):
    """Independent runs (± 0.3 %), parabola, c₀ = 0.4 a₀: V/(a₀²d₀) and d/d₀ at Ñ."""
    table = {0.04: (0.0625, 1.0190), 0.16: (0.2674, 1.0723), 0.36: (0.6500, 1.1558)}
    amplitude = SLIDING * CASE.depth * (1 - 0.4**2)
    contact = start_contact(loading="cyclic", displacement_amplitude=amplitude, frequency=1.0)
    unit, now = life_unit(amplitude), 0.0
    for life, (volume, depth) in table.items():
        contact.step((life - now) * unit)
        now = life
        assert contact.get("wear_volume") / (CASE.contact_radius**2 * CASE.depth) == pytest.approx(
            volume, rel=0.02
        )
        assert contact.get("indentation_depth") / CASE.depth == pytest.approx(depth, rel=5e-3)


def test_gross_slip_volume_is_exact(start_contact):
    """W = 4μF_N (U₀ − e) per loop: only the elastic part e depends on the profile. It is 0.8 u_max
    at first, 4 % of the amplitude here, and shrinks as the contact wears larger and stiffer.
    """
    amplitude = 20 * CASE.full_slip
    contact = start_contact(loading="cyclic", displacement_amplitude=amplitude, frequency=1.0)
    contact.step(1000.0)
    volume = contact.get("wear_volume")
    assert volume == pytest.approx(PER_WORK * contact.get("dissipated_energy"), rel=1e-3)
    least, most = (
        4000 * PER_WORK * CASE.limit * (amplitude - elastic)
        for elastic in (0.8 * CASE.full_slip, 0.0)
    )
    assert least < volume < most


def test_steps_may_be_any_share_of_a_cycle(start_contact):
    """Ten cycles in one step, or in steps of a third and of seven cycles: cycles are counted as a
    real number.
    """
    volumes = []
    for steps in ([10.0], [1 / 3] * 30, [7.0, 3.0]):
        contact = start_contact(loading="cyclic", displacement_amplitude=2e-6, frequency=2.0)
        for cycles in steps:
            contact.step(cycles / 2.0)
        volumes.append(contact.get("wear_volume"))
    assert volumes[1:] == pytest.approx([volumes[0]] * 2, rel=1e-3)  # the default tolerance
