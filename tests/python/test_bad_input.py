"""What is refused, how it is said, and that nothing is lost by it."""

import pytest
from fretting_contact.component import ContactError

ERRORS = (2, 3)  # fmi2Discard, fmi2Error; never fmi2Fatal


def refused(call, *words):
    """Runs a call that has to be refused in one message with all these words."""
    with pytest.raises(ContactError) as caught:
        call()
    assert caught.value.status in ERRORS
    assert len(caught.value.messages) == 1, caught.value.messages
    for word in words:
        assert word in caught.value.messages[0], caught.value.messages
    return caught.value.messages[0]


def step_with(contact, **inputs):
    return lambda: contact.step(**inputs)


@pytest.mark.parametrize("name", ["tangential_displacement", "normal_force"])
@pytest.mark.parametrize(
    ("value", "word"), [(float("nan"), "NaN"), (float("inf"), "inf"), (float("-inf"), "-inf")]
)
def test_input_that_is_no_number(start_contact, name, value, word):
    contact, untouched = start_contact(), start_contact()
    for each in (contact, untouched):
        each.step(tangential_displacement=1e-6)
    refused(step_with(contact, **{name: value}), name, word)
    for each in (contact, untouched):
        each.step(tangential_displacement=-1e-6, normal_force=100.0)
    outputs = ("tangential_force", "wear_volume", "dissipated_energy")
    assert contact.get(*outputs) == untouched.get(*outputs)


@pytest.mark.parametrize(
    "inputs",
    [{"displacement_amplitude": -1e-6}, {"frequency": float("nan")}, {"frequency": -1.0}],
    ids=str,
)
def test_bad_input_of_cyclic_loading(start_contact, inputs):
    contact = start_contact(loading="cyclic", displacement_amplitude=1e-6, frequency=1.0)
    name, value = next(iter(inputs.items()))
    refused(step_with(contact, **inputs), name, "NaN" if value != value else "-")
    contact.step(1.0, displacement_amplitude=1e-6, frequency=1.0)
    assert contact.get("wear_volume") > 0


BAD_PARAMETERS = [
    ("radius", -0.01, "-0.01"),
    ("radius", 0.0, "0"),
    ("radius", float("nan"), "NaN"),
    ("youngs_modulus_1", 0.0, "0"),
    ("youngs_modulus_2", -210e9, "-2"),
    ("poisson_ratio_1", 0.6, "0.6"),
    ("poisson_ratio_2", -1.0, "-1"),
    ("friction_coefficient", -0.1, "-0.1"),
    ("wear_coefficient", -1e-4, "-0.0001"),
    ("hardness", 0.0, "0"),
    ("resolution", 2, "2"),
    ("tolerance", 0.0, "0"),
]


@pytest.mark.parametrize(("name", "value", "word"), BAD_PARAMETERS)
def test_bad_parameter(new_contact, name, value, word):
    contact = new_contact()
    refused(lambda: contact.start(**{name: value}), name, word)
    contact.reset()
    contact.start()
    assert contact.get("contact_radius") > 0


@pytest.mark.parametrize(
    ("profile", "name", "value"),
    [
        ("cone", "cone_slope", -0.1),
        ("cone", "cone_slope", 1.6),
        ("power_law", "exponent", 0.0),
        ("power_law", "coefficient", -1.0),
        ("blunted_sphere", "flat_radius", -1e-4),
        ("rounded_punch", "radius", 0.0),
        ("flat_punch", "flat_radius", 0.0),
    ],
)
def test_bad_shape(new_contact, profile, name, value):
    contact = new_contact()
    refused(lambda: contact.start(profile=profile, **{name: value}), name)


def test_unknown_references(start_contact):
    contact = start_contact()
    for type_ in ("Real", "Integer", "Boolean", "String"):
        getter = getattr(contact.slave, f"get{type_}")
        refused(lambda getter=getter: contact._call(getter, [987654]), "987654")
    refused(lambda: contact._call(contact.slave.setReal, [987654], [1.0]), "987654")
    contact.step(tangential_displacement=1e-6)
    assert contact.get("tangential_force") > 0


def test_enumeration_without_such_an_item(new_contact):
    contact = new_contact()
    refused(lambda: contact.start(profile=99), "profile", "99")
    contact.reset()
    contact.start(profile="cone")
    assert contact.get("profile") == "cone"


def test_setting_an_output(start_contact):
    contact = start_contact()
    refused(lambda: contact.set(tangential_force=1.0), "tangential_force")


def test_changing_a_parameter_while_running(start_contact):
    contact = start_contact()
    contact.step(tangential_displacement=1e-6)
    refused(lambda: contact.set(radius=0.02), "radius")
    contact.step(tangential_displacement=0.0)


def test_step_of_negative_length(start_contact):
    contact = start_contact()
    contact.step(1e-3, tangential_displacement=1e-6)
    before = contact.get("tangential_force")
    refused(lambda: contact.step(-1e-3), "-0.001")
    assert contact.get("tangential_force") == before
    contact.time = 1e-3
    contact.step(1e-3)


def test_step_before_initialisation(new_contact):
    contact = new_contact()
    refused(lambda: contact.step(1e-3), "fmi2DoStep")
    contact.start()
    contact.step(1e-3)


def test_missing_profile_file(new_contact, tmp_path):
    contact = new_contact()
    missing = str(tmp_path / "no such profile.txt")
    refused(lambda: contact.start(profile="table", profile_file=missing), "profile_file", missing)


def test_no_profile_file(new_contact):
    contact = new_contact()
    refused(lambda: contact.start(profile="table"), "profile_file")


BAD_FILES = {
    "unsorted": ("0 0\n2e-4 2e-6\n1e-4 5e-7\n3e-4 4.5e-6\n", "line 3"),
    "equal radii": ("0 0\n1e-4 5e-7\n1e-4 6e-7\n3e-4 4.5e-6\n", "line 3"),
    "one column": ("0 0\n1e-4\n2e-4 2e-6\n", "line 2"),
    "three columns": ("0 0\n1e-4 5e-7 1\n2e-4 2e-6\n", "line 2"),
    "words": ("# radius height\n0 0\n1e-4 deep\n2e-4 2e-6\n", "line 3"),
    "not a number": ("0 0\n1e-4 nan\n2e-4 2e-6\n3e-4 4.5e-6\n", "line 2"),
    "off the axis": ("1e-5 0\n1e-4 5e-7\n2e-4 2e-6\n", 'line 1, "1e-5 0"'),
    "both sides": ("-1e-4 5e-7\n0 0\n1e-4 5e-7\n", "cargo fmu profile"),
    "two headers": ("r f\nm m\n0 0\n1e-4 5e-7\n2e-4 2e-6\n", 'line 2, "m m"'),
    "empty": ("# nothing but a comment\n", "profile"),
}


@pytest.mark.parametrize("kind", BAD_FILES)
def test_malformed_profile_file(new_contact, tmp_path, kind):
    text, place = BAD_FILES[kind]
    path = tmp_path / "profile.txt"
    path.write_text(text)
    contact = new_contact()
    refused(lambda: contact.start(profile="table", profile_file=str(path)), "profile", place)
    contact.reset()
    contact.start()


def test_profile_whose_image_is_not_monotone(new_contact, tmp_path):
    """A ball with a deep groove at r = 100 µm: its contact region would be a disc and a ring."""
    path = tmp_path / "groove.txt"
    radii = [i * 2e-6 for i in range(300)]
    path.write_text(
        "".join(f"{r:.9e} {r**2 / 0.02 + 2e-6 * (90e-6 < r < 110e-6):.9e}\n" for r in radii)
    )
    contact = new_contact()
    refused(
        lambda: contact.start(profile="table", profile_file=str(path), normal_force=100.0),
        "monotone",
        "r = ",
        "cargo fmu profile",
    )


def test_load_beyond_the_table(start_contact, tmp_path):
    path = tmp_path / "short.txt"
    path.write_text("".join(f"{i * 1e-6:.9e} {(i * 1e-6) ** 2 / 0.02:.9e}\n" for i in range(101)))
    contact = start_contact(profile="table", profile_file=str(path), normal_force=1.0)
    refused(step_with(contact, normal_force=1e4), "normal_force", "table")
    contact.step(normal_force=2.0)
    assert contact.get("normal_reaction") == pytest.approx(2.0, rel=1e-9)
