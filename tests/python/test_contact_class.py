"""The class Contact: parameters by name and unit, states, fields, messages, FMU file."""

import copy
import inspect
import pickle
import shutil
import warnings

import numpy as np
import pytest
from closed_forms import Sphere, contact_radius
from fretting_contact import (
    Contact,
    ContactError,
    ContactWarning,
    FmuNotFoundError,
    ParameterError,
    SignalError,
    drive,
    fmu_file,
    life,
    loop,
)
from fretting_contact.component import ContactFmu
from fretting_contact.fmu_file import FmuFile, file_of_bytes, shared_file
from fretting_contact.quantities import UNITS, QuantityError, in_si


@pytest.fixture(autouse=True)
def this_fmu(fmu_path, monkeypatch):
    monkeypatch.setenv("FRETTING_FMU", str(fmu_path))


def test_units_and_enumerations_are_those_of_the_component():
    with Contact(
        radius="20 mm",
        youngs_modulus_1="210 GPa",
        profile="cone",
        cone_slope="1 deg",
        normal_control="indentation",
    ) as contact:
        assert contact["radius"] == 0.02 and contact["youngs_modulus_1"] == 210e9
        assert contact["cone_slope"] == pytest.approx(np.pi / 180, rel=1e-15)
        assert contact["profile"] == "cone" and contact["normal_control"] == "indentation"


def test_numbers_of_numpy_and_of_enumerations_are_taken():
    with Contact(
        radius=np.float64(0.02), resolution=np.int64(96), profile=2, hardness=np.array(7e9)
    ) as contact:
        assert contact.get("radius", "resolution", "profile", "hardness") == [0.02, 96, "cone", 7e9]


WRONG = [
    ({"raduis": 1.0}, "raduis is no variable of the component .did you mean radius"),
    ({"loading": "cylic"}, "loading = 'cylic' .did you mean cyclic.*give one of transient, cyclic"),
    ({"profile": 99}, "profile = 99: give one of parabola, cone"),
    ({"wear_volume": 1.0}, r"computed by the component: read it with contact\['wear_volume'\]"),
    ({"radius": [0.01, 0.02]}, r"radius = \[0.01, 0.02\]: give a number; for several values"),
    ({"resolution": 64.5}, "resolution = 64.5: give a whole number"),
    ({"radius": True}, "radius = True: give a number"),
]


@pytest.mark.parametrize(("parameters", "message"), WRONG, ids=lambda value: str(value)[:20])
def test_what_the_component_does_not_have_is_named(parameters, message):
    with pytest.raises(ParameterError, match=message):
        Contact(**parameters)


@pytest.mark.parametrize("unit", [unit for unit in UNITS if unit != "1"])
def test_every_si_unit_has_the_factor_one_and_a_wrong_unit_is_refused(unit):
    assert in_si(f"2.5 {unit}", unit) == 2.5
    for name, factor in UNITS[unit].items():
        assert in_si(f"1e3 {name}", unit) == pytest.approx(1e3 * factor, rel=1e-15)
    with pytest.raises(QuantityError, match=f"x = '2 kg': the unit has to be one of {unit}"):
        in_si("2 kg", unit, "x")


def test_a_text_without_a_unit_or_for_a_quantity_without_one_is_refused():
    assert in_si("50 %", "1") == 0.5
    for text, unit in ("10", "m"), ("mm", "m"), ("1 m", None):
        with pytest.raises(QuantityError, match="give|the unit has to be"):
            in_si(text, unit)


def test_every_unit_of_the_component_is_known(fmu):
    units = {variable.unit for variable in fmu.variables.values() if variable.unit}
    assert units <= set(UNITS) | {"J/m2", "N.m"}


def test_a_refusal_has_the_message_of_the_component_and_changes_nothing():
    with pytest.raises(
        ContactError, match=r"^radius = -1\.0 is refused.*\(fmi2SetReal: fmi2Error\)$"
    ) as caught:
        Contact(radius=-1.0)
    assert caught.value.status == 3 and len(caught.value.messages) == 1
    with Contact() as contact:
        contact.step(tangential_displacement=1e-6)
        before = contact["tangential_force"]
        with pytest.raises(ContactError, match="NaN"):
            contact.step(tangential_displacement=float("nan"))
        assert contact["tangential_force"] == before


READ = ("tangential_force", "contact_displacement", "normal_reaction", "radius")
SHORT = (np.linspace(0, 4e-4, 50), np.linspace(0, 4e-4, 50) ** 2 / 0.02)
TIME = np.linspace(0, 1, 20)
SINE = 1e-6 * np.sin(6 * TIME)
REFUSED_CALLS = {
    "restart, value": lambda contact: contact.restart(radius=-1),
    "restart, name": lambda contact: contact.restart(raduis=1),
    "set": lambda contact: contact.set(normal_force=50.0, resolution=32),
    "step, size": lambda contact: contact.step(-1, tangential_displacement=5e-6),
    "step, load": lambda contact: contact.step(normal_force=1e5, tangential_displacement=5e-6),
    "drive, load at the start": lambda contact: drive(contact, TIME, SINE, normal_force=1e5),
    "drive, load": lambda contact: drive(contact, TIME, SINE, normal_force=100 + 1e5 * TIME),
    "drive, name": lambda contact: drive(contact, TIME, SINE, outputs=["profile_file"]),
    "loop": lambda contact: loop(contact, 1e-6, normal_force=1e5),
}


@pytest.mark.parametrize("moved", [False, True])
@pytest.mark.parametrize("call", REFUSED_CALLS)
def test_a_refused_call_leaves_the_contact_as_it_was(call, moved):
    with Contact(profile_file=SHORT, normal_force=100.0) as contact:
        if moved:
            contact.step(tangential_displacement=1e-6)
        before = contact.get(*READ), contact.time, contact.has_moved, contact.given
        with pytest.raises((ContactError, ParameterError)):
            REFUSED_CALLS[call](contact)
        assert before == (contact.get(*READ), contact.time, contact.has_moved, contact.given)
        contact.step()  # with the inputs from before
        assert contact.get(*READ) == before[0]


def test_a_contact_that_was_reset_takes_inputs_at_its_start():
    with Contact(normal_force=100.0) as contact, Contact(radius=0.02, normal_force=50.0) as other:
        contact.step(tangential_displacement=1e-6)
        contact.reset()
        contact.start(radius=0.02, normal_force=50.0)
        assert contact.get(*READ) == other.get(*READ)


def test_messages_name_what_python_calls():
    with Contact() as contact:
        with pytest.raises(
            ContactError, match=r"radius = 0.02 is refused: .*call restart\(...\) to"
        ):
            contact.set(radius=0.02)
        contact.reset()
        with pytest.raises(ContactError, match=r"call start\(\) first: not allowed in state"):
            _ = contact["radius"]


def test_the_size_of_a_step_may_be_a_text():
    with Contact() as contact:
        assert contact.step("1 ms").time == 1e-3
        for size, message in (
            ("1 m", "size = '1 m': the unit has to be one of s, ms"),
            ("1", "size = '1': the unit has to be"),
            ([1.0, 2.0], r"size = \[1.0, 2.0\]: give a number in s"),
            (None, "size = None: give a number in s"),
        ):
            with pytest.raises(ParameterError, match=message):
                contact.step(size)
        assert contact.time == 1e-3


def test_a_field_is_no_variable():
    with Contact() as contact:
        for use in (
            lambda: contact.set(pressure=1.0),
            lambda: contact.step(pressure=1.0),
            lambda: contact.get("pressure"),
            lambda: contact.get("tangential_force", "pressure"),
            lambda: contact.follow(["pressure"], tangential_displacement=[1e-6]),
        ):
            with pytest.raises(
                ParameterError, match=r"pressure is a field: .*contact\['pressure'\]"
            ):
                use()


def test_an_unknown_name_is_answered_with_those_that_are_like_it():
    with Contact() as contact:
        before = contact.get(*READ)
        for use in (
            lambda: contact.get("tangential_forces"),
            lambda: contact["tangential_forces"],
            lambda: contact.follow(["tangential_forces"], tangential_displacement=[1e-6]),
        ):
            with pytest.raises(ParameterError, match=r"did you mean tangential_force"):
                use()
        with pytest.raises(ParameterError, match=r"list\(contact.fmu.variables\) has all names"):
            contact.get("nothing like it")
        with pytest.raises(ParameterError, match=r"did you mean tangential_displacement"):
            contact.follow(["tangential_force"], tangential_displacements=[1e-6])
        assert contact.get(*READ) == before


def test_a_refused_life_leaves_the_contact_as_it_was():
    names = ("displacement_amplitude", "normal_force", "wear_volume")
    with Contact(profile_file=SHORT, loading="cyclic", frequency=0.0) as contact:
        before = contact.get(*names)
        with pytest.raises(SignalError, match="frequency = 0 Hz"):
            life(contact, 1e3, amplitude=2e-6, normal_force=50.0)
        assert contact.get(*names) == before


def test_a_path_of_a_profile_is_a_table(tmp_path):
    path = tmp_path / "ball.txt"
    x = np.linspace(0.0, 5e-4, 51)
    np.savetxt(path, np.column_stack([x, x**2 / 0.02]))
    with Contact(profile_file=path, normal_force=100.0) as read:
        assert read["profile"] == "table"
        with Contact(profile_file=(x, x**2 / 0.02), normal_force=100.0) as given:
            assert read["contact_radius"] == pytest.approx(given["contact_radius"], rel=1e-9)


def test_a_message_has_a_hash_once(tmp_path):
    path = tmp_path / "a#b.txt"
    with pytest.raises(ContactError) as caught:
        Contact(profile="table", profile_file=path)
    assert "a#b.txt" in str(caught.value)


def test_a_copy_of_a_state_is_the_state():
    with Contact() as contact:
        contact.step(tangential_displacement=1e-6)
        state, force = contact.save(), contact["tangential_force"]
        for kind in (copy.copy, copy.deepcopy):
            other = kind(state)
            del other
        contact.step(tangential_displacement=2e-6)
        assert contact.restore(state)["tangential_force"] == force
        for kind in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="a contact cannot be copied or pickled"):
                kind(contact)
        with pytest.raises(TypeError, match=r"store bytes\(state\)"):
            pickle.dumps(state)


@pytest.mark.parametrize("kind", [bytes, bytearray, memoryview])
def test_a_state_is_restored_from_any_kind_of_bytes(kind):
    with Contact() as contact, Contact() as other:
        contact.step(tangential_displacement=1e-6)
        other.restore(kind(bytes(contact.save())))
        assert other["tangential_force"] == contact["tangential_force"]
        with pytest.raises(ParameterError, match="str is no state: give what"):
            other.restore("state")


def test_warnings_of_the_component_are_those_of_python():
    with pytest.warns(ContactWarning, match="hardness = 800 Pa"):
        Contact(hardness=800.0).close()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Contact().close()


def test_a_warning_points_at_the_line_of_the_user():
    def line():
        return inspect.currentframe().f_back.f_lineno

    with warnings.catch_warnings(record=True) as noted:
        warnings.simplefilter("always", ContactWarning)
        first = line() + 1
        Contact(hardness=800.0).close()
        with Contact() as contact:
            contact.step(rotation=1e-3)
        with Contact() as contact:
            contact.follow(["wear_volume"], rotation=[1e-3])
        with Contact(loading="cyclic", tangential_displacement=0.0) as contact:
            contact.set(tangential_displacement=1e-6)
            life(contact, 10.0)
    assert [(note.filename, note.lineno - first) for note in noted] == [
        (__file__, line) for line in (0, 2, 4, 7)
    ]


def test_both_bodies_a_coating_and_fixed_probes():
    values = {
        "wear_coefficient": 0.02,
        "wear_coefficient_2": 0.02,
        "hardness_2": "4 GPa",
        "loading": "cyclic",
    }
    coated = {
        "coating_thickness": "0.2 um",
        "probe_radius_max": "0.3 mm",
        "displacement_amplitude": "1.5 um",
    }
    with Contact(normal_force=100.0, **values, **coated) as contact:
        before, radius = contact["profile_height"], contact["radius_probe"]
        assert contact["worn_through"] is False
        contact.step(2000.0)
        assert contact["worn_through"] is True
        life = contact["cycles_to_wear_through"]
        assert 0 < life < 2000 and contact["worn_through_time"] == pytest.approx(life, rel=1e-12)
        assert np.array_equal(contact["radius_probe"], radius) and radius[-1] == 3e-4
        assert contact["profile_height"] - before == pytest.approx(contact["worn_depth"], abs=1e-15)
        assert contact["wear_volume_2"] == pytest.approx(2 * contact["wear_volume_1"], rel=1e-12)
        density = contact["energy_density"]
        assert contact["worn_depth"] == pytest.approx(
            density * (0.02 / 8e9 + 0.02 / 4e9), rel=1e-12
        )
        # inside the stick radius there is no slip, at the edge it is next to that of the body
        slip = contact["slip_amplitude"]
        inside = radius < 0.999 * contact["stick_radius"]
        assert np.all(slip[inside] == 0.0) and 0.0 < slip.max() < 1.5e-6
        with pytest.raises(ParameterError, match="worn_through is computed"):
            contact.set(worn_through=True)
    with (
        Contact(wear_coefficient=0.0) as contact,
        pytest.warns(ContactWarning, match="energy_density"),
    ):
        assert np.all(np.isnan(contact["energy_density"]))


def test_fields_are_arrays_with_the_closed_form():
    with Contact(normal_force=100.0, wear_coefficient=0.0) as contact:
        assert {"radius_probe", "worn_depth", "pressure", "shear_traction", "image"} <= set(
            contact.fields
        )
        radius, pressure = contact["radius_probe"], contact.field("pressure")
        with pytest.raises(ParameterError, match="presure is no field .did you mean pressure"):
            contact.field("presure")
        with pytest.raises(ParameterError, match="wear_volum is no variable"):
            contact["wear_volum"]
    a = contact_radius(Sphere(), 100.0)
    hertz = 1.5 * 100.0 / (np.pi * a**2) * np.sqrt(np.clip(1 - (radius / a) ** 2, 0, None))
    assert radius.shape == pressure.shape
    assert pressure == pytest.approx(hertz, abs=1e-6 * hertz[0])


def test_a_saved_state_is_returned_to_and_goes_to_another_contact_as_bytes():
    def go_on(contact):
        contact.step(tangential_displacement=-2e-6)
        return contact.get("tangential_force", "wear_volume", "dissipated_energy")

    with Contact() as contact, Contact() as other:
        contact.step(0.5, tangential_displacement=2e-6)
        state = contact.save()
        stored = bytes(state)
        expected = go_on(contact)
        assert go_on(contact.restore(state)) == expected
        assert contact.restore(state).time == 0.5
        assert other.restore(stored).time == 0.5
        assert go_on(other) == expected
        with pytest.raises(ParameterError, match="another contact: restore it there"):
            other.restore(state)
        with pytest.raises(ParameterError, match="are no state"):
            other.restore(b"abc")
        with pytest.raises(ContactError, match="serialised state is refused"):
            other.restore(stored[:-1])
    with pytest.raises(RuntimeError, match="closed"):
        contact.save()


@pytest.mark.parametrize(
    "use",
    [
        lambda contact: contact["wear_volume"],
        lambda contact: contact["pressure"],
        lambda contact: contact.get("radius"),
        lambda contact: contact.set(normal_force=1.0),
        lambda contact: contact.step(),
        lambda contact: contact.restart(),
        lambda contact: contact.follow(["wear_volume"], tangential_displacement=[1e-6]),
    ],
)
def test_a_closed_contact_says_so(use):
    with Contact() as contact:
        contact.step(tangential_displacement=1e-6)
    with pytest.raises(RuntimeError, match=r"the contact is closed: make a new one, Contact\("):
        use(contact)
    contact.close()
    assert repr(contact) == "<Contact, closed>"
    with FmuFile(fmu_file.fmu_path()) as fmu, ContactFmu(fmu) as component:
        component.start()
    with pytest.raises(RuntimeError, match="closed"):
        component.get("wear_volume")


def test_states_do_not_pile_up():
    with Contact() as contact:
        first = contact.save()
        for _ in range(2000):
            contact.restore(first)
            contact.step(tangential_displacement=1e-6)
            contact.save()


def test_a_contact_started_again_is_as_new():
    with Contact(radius=0.02, normal_force=50.0) as contact, Contact(normal_force=80.0) as new:
        contact.step(tangential_displacement=1e-6)
        contact.restart(normal_force=80.0)
        names = (
            "radius",
            "normal_force",
            "contact_radius",
            "tangential_force",
            "dissipated_energy",
        )
        assert contact.get(*names) == new.get(*names) and contact.time == 0.0


def test_a_profile_is_given_as_arrays_or_as_a_fit():
    from fretting_contact import Scan, fit_scan

    r = np.linspace(0, 5e-4, 300)
    x = np.linspace(-5e-4, 5e-4, 400)
    fit = fit_scan(Scan(x, x**2 / 0.02 + 1e-9 * np.random.default_rng(0).standard_normal(400)))
    with Contact(normal_force=100.0) as ball:
        for profile in (r, r**2 / 0.02), np.column_stack([r, r**2 / 0.02]), fit:
            with Contact(profile_file=profile, normal_force=100.0) as contact:
                assert contact["profile"] == "table"
                assert contact["contact_radius"] == pytest.approx(ball["contact_radius"], rel=2e-3)


@pytest.mark.parametrize("profile", [3, [1.0], np.zeros((3, 4)), ([0.0, 1.0], [0.0]), {"r": 1}])
def test_what_is_no_profile_is_named(profile):
    with pytest.raises(ParameterError, match="profile_file is .*: give a path, the result of"):
        Contact(profile_file=profile)


def test_the_fmu_is_found_where_it_is_said(fmu_path, tmp_path, monkeypatch):
    from fretting_contact import fmu_path as find

    copy = shutil.copy(fmu_path, tmp_path / "other.fmu")
    assert find(copy) == copy and find() == fmu_path
    with pytest.raises(FmuNotFoundError, match="fmu = .*there is no such file"):
        find(tmp_path / "none.fmu")
    monkeypatch.setenv("FRETTING_FMU", "none.fmu")
    with pytest.raises(
        FmuNotFoundError, match="the environment variable FRETTING_FMU = 'none.fmu'"
    ):
        find()
    monkeypatch.delenv("FRETTING_FMU")
    monkeypatch.setattr(fmu_file, "NAME", "none.fmu")
    with pytest.raises(FmuNotFoundError, match="install the wheel.*cargo fmu build.*FRETTING_FMU"):
        find()


def test_an_fmu_without_a_library_for_this_machine_is_named(fmu_path, monkeypatch):
    monkeypatch.setattr(fmu_file.fmpy, "platform", "riscv")
    with pytest.raises(FmuNotFoundError, match="none for riscv, this machine"):
        FmuFile(fmu_path)


def test_the_fmu_is_unpacked_once(fmu_path):
    assert shared_file(fmu_path) is shared_file(str(fmu_path))
    content = fmu_path.read_bytes()
    assert file_of_bytes(content) is file_of_bytes(content)
    assert fmu_path.samefile(fmu_file.fmu_path())
