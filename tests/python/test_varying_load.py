"""Loads that vary: the exact rules, a plain spring model, and loads over six decades."""

import numpy as np
import pytest
from closed_forms import E_STAR, G_STAR, SLIDING, Sphere, Tangential
from springs import SphereOnSprings

# of μF: promised for histories of any kind. It also bounds what the caller's splitting of a line
# may change.
HISTORY_ERROR = 1e-3


@pytest.fixture
def contact(start_contact):
    return start_contact(normal_force=100.0, wear_coefficient=0.0)


def test_rising_load_leaves_the_force(contact):
    contact.step(tangential_displacement=1e-6)
    before = contact.get("tangential_force", "dissipated_energy")
    contact.step(normal_force=250.0)
    # Springs keep their stretch; moving it to a larger contact may round, by less than 1e-4 of μF.
    assert contact.get("tangential_force") == pytest.approx(before[0], abs=1e-4 * 60)
    assert contact.get("dissipated_energy") == pytest.approx(before[1], rel=1e-9)


def test_falling_load_clips_the_springs(contact):
    """The state under the lower load is the one that this displacement would have reached there at
    once.
    """
    contact.step(tangential_displacement=1e-6)
    for force in (60.0, 30.0, 15.0):
        contact.step(normal_force=force)
        exact = Tangential(Sphere(), force).loading(1e-6)[0]
        assert contact.get("tangential_force") == pytest.approx(
            exact, abs=1e-4 * 0.6 * force + 1e-4 * 0.6 * 15
        )


@pytest.mark.parametrize("share", [0.3, 0.8, 1.0])
def test_oblique_loading_without_slip(start_contact, share):
    """U and d rising together with dU/dd ≤ μE*/G*: ΔT = (dU/dd)(G*/E*) ΔF_N and nothing slips."""
    first, last = 1e-6, 4e-6
    contact = start_contact(normal_control="indentation", indentation=first)
    force_before = contact.get("normal_reaction")
    slope = share * SLIDING
    for depth in np.linspace(first, last, 8)[1:]:
        contact.step(indentation=depth, tangential_displacement=slope * (depth - first))
    rise = contact.get("normal_reaction") - force_before
    tangential = contact.get("tangential_force")
    # The ramp of spring stretch outside the first contact is carried by cells: second order in
    # their width.
    assert tangential == pytest.approx(slope * G_STAR / E_STAR * rise, abs=1e-4 * 0.6 * rise)
    # At the limit (share = 1) each new spring is exactly on the verge; below it none may slip at
    # all.
    assert contact.get("dissipated_energy") <= 1e-6 * tangential * slope * (last - first)
    if share < 1:
        assert contact.get("slip_state") == "stick"
        assert contact.get("wear_volume") == 0.0


def test_splitting_a_line_does_not_matter(start_contact):
    results = []
    for pieces in (1, 7, 100):
        contact = start_contact(normal_force=20.0, wear_coefficient=0.0)
        for force, displacement in ((120.0, 2e-6), (40.0, -0.5e-6), (90.0, 1.5e-6), (30.0, 1.8e-6)):
            here = np.array(contact.get("normal_force", "tangential_displacement"))
            for share in np.linspace(0, 1, pieces + 1)[1:]:
                f, u = here + share * (np.array([force, displacement]) - here)
                contact.step(normal_force=f, tangential_displacement=u)
        results.append(contact.get("tangential_force", "dissipated_energy"))
    force, work = np.array(results).T
    assert np.ptp(force) < HISTORY_ERROR * 0.6 * 120
    assert np.ptp(work) < HISTORY_ERROR * work[0]


@pytest.mark.parametrize("seed", range(6))
def test_random_history_against_springs(start_contact, seed):
    random = np.random.default_rng(seed)
    forces, largest = 100.0 * random.uniform(0.05, 2.0, 25), 200.0
    displacements = random.uniform(-3e-6, 3e-6, forces.size)
    contact = start_contact(normal_force=forces[0], wear_coefficient=0.0)
    plain = SphereOnSprings(0.01, largest)
    plain.move(forces[0], 0.0, substeps=1)  # pressed at U = 0: springs unstressed
    for force, displacement in zip(forces, displacements):
        contact.step(normal_force=force, tangential_displacement=displacement)
        expected = plain.move(force, displacement)
        assert contact.get("tangential_force") == pytest.approx(
            expected, abs=HISTORY_ERROR * 0.6 * largest
        )


def test_six_decades_of_load_in_one_run(start_contact):
    decades = np.array([1e-3, 1e-2, 1e-1, 1.0, 10.0, 100.0, 1e3])
    contact = start_contact(normal_force=decades[0], wear_coefficient=0.0)
    for force in np.concatenate([decades, decades[::-1]]):
        case = Tangential(Sphere(), force)
        amplitude = 0.6 * case.full_slip
        contact.step(normal_force=force)
        for target in (amplitude, -amplitude):
            contact.step(tangential_displacement=target)
        low = contact.get("tangential_force")
        contact.step(tangential_displacement=amplitude)
        swing = (contact.get("tangential_force") - low) / 2
        # Sticking springs may carry an old offset from earlier loads; the range of a closed loop
        # does not depend on it.
        assert swing == pytest.approx(case.loading(amplitude)[0], abs=HISTORY_ERROR * case.limit)
        contact.step(tangential_displacement=0.0)


def test_contact_lost_and_found(start_contact):
    contact = start_contact(normal_force=100.0)
    contact.step(tangential_displacement=2e-6)
    worn = contact.get("wear_volume", "wear_depth", "dissipated_energy")
    assert worn[0] > 0
    for force in (0.0, -5.0):
        contact.step(normal_force=force, tangential_displacement=3e-6)
        assert contact.get("slip_state") == "separated"
        assert (
            contact.get(
                "tangential_force",
                "contact_radius",
                "stick_radius",
                "max_pressure",
                "normal_reaction",
            )
            == [0] * 5
        )
    after = contact.get("wear_volume", "wear_depth", "dissipated_energy")
    assert all(
        now >= then for now, then in zip(after, worn)
    )  # it slips while the load falls to zero
    contact.step(normal_force=0.0, tangential_displacement=-4e-6)
    assert (
        contact.get("wear_volume", "wear_depth", "dissipated_energy") == after
    )  # nothing rubs in the air

    contact.step(normal_force=100.0)  # straight down at fixed U: springs arrive unstressed
    assert contact.get("tangential_force") == 0.0
    assert contact.get("slip_state") == "stick"
    case = Tangential(Sphere(), 100.0)
    contact.step(tangential_displacement=-4e-6 + 1e-6)
    # The stroke above wore the ball by a few thousandths of a nanometre: no change at this
    # accuracy.
    assert contact.get("tangential_force") == pytest.approx(
        case.loading(1e-6)[0], abs=1e-4 * case.limit
    )


def test_indentation_control_lifts_off(start_contact):
    contact = start_contact(normal_control="indentation", indentation=2e-6, wear_coefficient=0.0)
    assert contact.get("normal_reaction") == pytest.approx(
        4 / 3 * E_STAR * np.sqrt(0.01) * 2e-6**1.5, rel=1e-9
    )
    contact.step(indentation=-1e-6)
    assert contact.get("slip_state") == "separated"
    assert contact.get("normal_reaction") == 0.0
    contact.step(indentation=2e-6)
    assert contact.get("contact_radius") == pytest.approx(np.sqrt(0.01 * 2e-6), rel=1e-9)
