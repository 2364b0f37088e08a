"""fmi2SetRealInputDerivatives: the target of a step is the input extrapolated to the step's end."""

import pytest
from fretting_contact.component import ContactError


def set_rate(contact, **rates):
    references = [contact.fmu.variables[name].valueReference for name in rates]
    contact._call(
        contact.slave.setRealInputDerivatives, references, [1] * len(rates), list(rates.values())
    )


def test_extrapolated_input_is_the_target(start_contact):
    by_rate, by_value = start_contact(), start_contact()
    h = 1e-3
    for n in range(8):
        displacement, force = 2e-7 * n, 100.0 + 5.0 * n
        by_rate.set(tangential_displacement=displacement, normal_force=force)
        set_rate(by_rate, tangential_displacement=2e-7 / h, normal_force=5.0 / h)
        by_rate.step(h)
        by_value.step(h, tangential_displacement=2e-7 * (n + 1), normal_force=100.0 + 5.0 * (n + 1))
        # One rounding of the product rate · h separates the two targets.
        assert by_rate.get("tangential_force") == pytest.approx(
            by_value.get("tangential_force"), rel=1e-9
        )
        assert by_rate.get("indentation_depth") == pytest.approx(
            by_value.get("indentation_depth"), rel=1e-9
        )


def test_rate_that_is_no_number(start_contact):
    contact = start_contact()

    def bad():
        set_rate(contact, tangential_displacement=float("nan"))
        contact.step(1e-3)

    with pytest.raises(ContactError) as caught:
        bad()
    assert "tangential_displacement" in " ".join(caught.value.messages)


def test_derivative_of_an_output(start_contact):
    contact = start_contact()
    with pytest.raises(ContactError) as caught:
        set_rate(contact, tangential_force=1.0)
    assert "tangential_force" in " ".join(caught.value.messages)
