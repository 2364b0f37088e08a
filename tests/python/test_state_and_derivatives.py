"""Saved states, also in another process, and derivatives, as FMPy calls them."""

import json
import os
import subprocess
import sys

import pytest
from fretting_contact.component import ContactError, ContactFmu, FmuFile
from histories import history

OUTPUTS = [
    "tangential_force",
    "wear_volume",
    "wear_depth",
    "dissipated_energy",
    "indentation_depth",
    "stick_radius",
]


def run(contact, seed, steps=12):
    for force, displacement in history(seed, steps):
        contact.step(normal_force=force, tangential_displacement=displacement)
    return [value.hex() for value in contact.get(*OUTPUTS)]


def take_up(fmu, data, time, seed):
    """What a fresh instance comes to from a serialised state."""
    contact = ContactFmu(fmu)
    state = contact._call(contact.slave.deSerializeFMUstate, data)
    contact._call(contact.slave.setFMUState, state)
    contact.time = time
    values = run(contact, seed)
    contact.__exit__()
    return values


def saved(start_contact):
    contact = start_contact(wear_coefficient=1e-2)
    run(contact, 1)
    state = contact._call(contact.slave.getFMUState)
    return contact, state, contact._call(contact.slave.serializeFMUstate, state)


def test_rollback_and_other_instances_and_processes_give_the_same_bits(
    start_contact, fmu, fmu_path
):
    contact, state, data = saved(start_contact)
    time = contact.time
    first = run(contact, 2)
    contact._call(contact.slave.setFMUState, state)
    contact.time = time
    assert run(contact, 2) == first
    assert take_up(fmu, data, time, 2) == first
    command = [sys.executable, __file__, str(fmu_path), data.hex(), time.hex(), "2"]
    output = subprocess.run(
        command, check=True, capture_output=True, text=True, env=environment()
    ).stdout
    assert json.loads(output) == first
    contact._call(contact.slave.freeFMUState, state)


def environment():
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}


@pytest.mark.parametrize(
    "spoil", [lambda b: b[:-1], lambda b: b + b"\0", lambda b: b[:80] + b"\xff" + b[81:]]
)
def test_spoiled_bytes_are_refused(start_contact, spoil):
    contact, _, data = saved(start_contact)
    assert spoil(data) != data
    with pytest.raises(ContactError) as caught:
        contact._call(contact.slave.deSerializeFMUstate, spoil(data))
    assert "serialised state is refused" in " ".join(caught.value.messages)
    run(contact, 3)


def test_the_directional_derivative_is_the_tangential_stiffness(start_contact, fmu):
    contact = start_contact(wear_coefficient=0.0)
    contact.step(tangential_displacement=1e-6)
    reference = {name: fmu.variables[name].valueReference for name in fmu.variables}
    unknowns = [reference["tangential_force"], reference["normal_reaction"]]
    knowns = [reference["tangential_displacement"], reference["normal_force"]]
    ask = contact.slave.getDirectionalDerivative
    assert contact._call(ask, unknowns, knowns, [1.0, 0.0]) == [
        contact.get("tangential_stiffness"),
        0.0,
    ]
    assert contact._call(ask, unknowns, knowns, [0.0, 1.0])[1] == pytest.approx(1.0, rel=1e-12)
    # and what a further step does
    before = contact.get("tangential_force")
    contact.step(tangential_displacement=1e-6 * (1 + 1e-6))
    change = contact._call(ask, unknowns, knowns, [1e-12, 0.0])[0]
    assert contact.get("tangential_force") - before == pytest.approx(change, rel=1e-5)


def test_output_derivatives_continue_the_last_step(start_contact, fmu):
    contact = start_contact(wear_coefficient=0.0)
    contact.step(1e-3, tangential_displacement=1e-6)
    references = [
        fmu.variables[name].valueReference for name in ("tangential_force", "normal_reaction")
    ]
    rates = contact._call(contact.slave.getRealOutputDerivatives, references, [1, 1])
    assert rates[0] == pytest.approx(contact.get("tangential_stiffness") * 1e-3, rel=1e-12)
    assert rates[1] == 0.0


if __name__ == "__main__":
    with FmuFile(sys.argv[1]) as file:
        print(
            json.dumps(
                take_up(
                    file, bytes.fromhex(sys.argv[2]), float.fromhex(sys.argv[3]), int(sys.argv[4])
                )
            )
        )
