"""Several instances, reset, and repeatability: always the same bits."""

import numpy as np
from fretting_contact.component import ContactFmu
from histories import history

OUTPUTS = [
    "tangential_force",
    "wear_volume",
    "wear_depth",
    "dissipated_energy",
    "indentation_depth",
    "contact_radius",
]


def advance(contact, inputs):
    force, displacement = inputs
    contact.step(normal_force=force, tangential_displacement=displacement)
    return contact.get(*OUTPUTS)


def run_alone(contact, seed):
    return [advance(contact, inputs) for inputs in history(seed)]


def start(contact):
    return contact.start(wear_coefficient=0.5)


def test_two_at_once_are_as_one_alone(new_contact):
    alone = [run_alone(start(new_contact()), seed) for seed in (1, 2)]
    first, second = start(new_contact()), start(new_contact())
    together = ([], [])
    for inputs_1, inputs_2 in zip(history(1), history(2)):
        together[0].append(advance(first, inputs_1))
        together[1].append(advance(second, inputs_2))
    assert list(together) == alone
    assert alone[0] != alone[1]


def test_reset_and_run_again(new_contact):
    contact = new_contact()
    once = run_alone(start(contact), 3)
    contact.reset()
    again = run_alone(start(contact), 3)
    assert again == once


def test_reset_brings_back_the_start_values(new_contact, fmu):
    contact = new_contact()
    contact.start(radius=0.02, wear_coefficient=0.5, normal_force=50.0, profile="cone")
    contact.step(tangential_displacement=2e-6)
    contact.reset()
    contact.start()
    for name in ("radius", "wear_coefficient", "normal_force", "tangential_displacement"):
        assert contact.get(name) == float(fmu.variables[name].start), name
    assert contact.get("profile") == "parabola"
    assert contact.get("tangential_force", "wear_volume") == [0, 0]


def test_reading_fields_changes_nothing(new_contact):
    plain = run_alone(start(new_contact()), 4)
    watched = start(new_contact())
    results = []
    for inputs in history(4):
        results.append(advance(watched, inputs))
        for name in ("worn_depth", "pressure", "shear_traction", "image"):
            assert np.all(np.isfinite(watched.field(name)))
    assert results == plain


def test_freeing_one_leaves_the_other(fmu, new_contact):
    kept = start(new_contact())
    with ContactFmu(fmu) as gone:
        start(gone)
        advance(gone, history(5)[0])
    expected = run_alone(start(new_contact()), 6)
    assert run_alone(kept, 6) == expected


def test_many_instances(new_contact):
    contacts = [start(new_contact()) for _ in range(20)]
    results = [advance(contact, (80.0, 1e-6)) for contact in contacts]
    assert all(result == results[0] for result in results)
