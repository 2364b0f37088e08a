"""Loop, life and drive of the Python package: closed forms, sampled signals, refusals."""

import numpy as np
import pytest
from closed_forms import Sphere, Tangential
from fretting_contact import Contact, ParameterError, SignalError, drive, life, loop

BALL = Tangential(Sphere(), 100.0)
PER_WORK = 4e-14  # m³/J, of the start values


@pytest.fixture(autouse=True)
def this_fmu(fmu_path, monkeypatch):
    monkeypatch.setenv("FRETTING_FMU", str(fmu_path))


@pytest.mark.parametrize("amplitude", [1e-6, 2.4e-6, 5e-6])
def test_the_work_of_a_loop_is_that_of_mindlin(amplitude):
    with Contact(wear_coefficient=0.0) as contact:
        one = loop(contact, amplitude, points=100)
    # the sine meets its reversals at 100 points; the work between them is exact, the closed form a
    # quadrature
    assert one.work == pytest.approx(BALL.loop_work(amplitude), rel=1e-8)
    assert one.force_amplitude == pytest.approx(BALL.loading(amplitude)[0], rel=1e-9)
    assert one.displacement_amplitude == pytest.approx(amplitude, rel=1e-12)
    assert one.worn_volume == 0.0
    assert len(one.time) == 101 and one.tangential_force[0] == pytest.approx(
        one.tangential_force[-1], rel=1e-9
    )


def test_a_loop_about_another_place_at_another_load():
    with Contact(wear_coefficient=0.0) as contact:
        one = loop(contact, 5e-6, normal_force=50.0, center=1e-5, cycles=1, period=0.1)
        assert contact["normal_force"] == 50.0
    assert one.displacement[[0, 50]] == pytest.approx([1e-5, 1.5e-5], rel=1e-12)
    assert one.tangential_force.max() == pytest.approx(0.6 * 50.0, rel=1e-12)
    assert one.time[-1] == pytest.approx(0.1)
    assert np.all(one.normal_force == pytest.approx(50.0, rel=1e-12))


def test_a_life_wears_what_its_work_says():
    with Contact(loading="cyclic") as contact:
        worn = life(contact, 1e5, at=[0, 1, 1e4, 9e4], amplitude=1.5e-6, normal_force=80.0)
        end = contact["wear_volume"]
    assert worn.wear_volume == pytest.approx(PER_WORK * worn.dissipated_energy, rel=1e-9)
    assert (
        worn.wear_volume[0] == 0.0
        and np.all(np.diff(worn.wear_volume) > 0)
        and end > worn.wear_volume[-1]
    )
    first = Tangential(Sphere(), 80.0).loop_work(1.5e-6)
    assert worn.dissipated_energy[1] == pytest.approx(first, rel=1e-3)
    assert (
        worn.radius.shape
        == worn.worn_depth.shape
        == worn.pressure.shape
        == (4, worn.radius.shape[1])
    )
    # the deepest point may lie between two of the radii
    assert worn.worn_depth[-1].max() == pytest.approx(worn.wear_depth[-1], rel=0.02)


def test_a_life_goes_on_where_the_last_one_ended():
    with Contact(loading="cyclic", displacement_amplitude=1.5e-6, frequency=50.0) as contact:
        whole = life(contact, 2e4)
        contact.restart(loading="cyclic", displacement_amplitude=1.5e-6)
        life(contact, 1e4)
        second = life(contact, 1e4, at=[1e4])
    assert len(whole.cycles) == 21 and whole.cycles[-1] == 2e4
    assert second.wear_volume[-1] == pytest.approx(whole.wear_volume[-1], rel=1e-3)


def test_signals_are_followed_from_sample_to_sample():
    time = [0.0, 0.1, 0.4, 0.5]
    displacement = [1e-6, 2e-6, -1e-6, 0.0]
    force = [100.0, 120.0, 80.0, 100.0]
    with Contact() as contact, Contact() as stepped:
        contact.step(1.0)  # so that it goes to the first sample from 0
        done = drive(contact, time, displacement, force, outputs=["wear_depth"])
        for k in range(4):
            stepped.step(1.0, tangential_displacement=displacement[k], normal_force=force[k])
            assert done.tangential_force[k] == stepped["tangential_force"]
            assert done.wear_volume[k] == stepped["wear_volume"]
        assert done.more["wear_depth"][-1] == stepped["wear_depth"]
    assert done.normal_force == pytest.approx(force)
    assert list(done.columns())[-1] == "wear_depth" and "more" not in done.columns()


def test_a_new_contact_is_pressed_on_at_the_first_sample():
    time = np.linspace(0, 1, 11)
    with Contact(radius="20 mm") as contact:
        contact.set(friction_coefficient=0.5)
        here = drive(contact, time, 2e-6 * np.sin(6 * time), normal_force=90.0)
        assert contact.get("radius", "friction_coefficient") == [0.02, 0.5]
    with Contact(radius="20 mm", friction_coefficient=0.5) as shifted:
        there = drive(shifted, time, 5e-6 + 2e-6 * np.sin(6 * time), normal_force=90.0)
    assert here.tangential_force[0] == there.tangential_force[0] == 0.0
    assert there.tangential_force == pytest.approx(here.tangential_force, abs=1e-9 * 45.0)
    assert there.wear_volume == pytest.approx(here.wear_volume, rel=1e-6)


def test_columns_of_pandas_are_taken_and_made(tmp_path):
    time = np.linspace(0, 1, 21)
    with Contact() as contact:
        plain = drive(contact, time, 2e-6 * np.sin(time))
    plain.write_csv(tmp_path / "drive.csv")
    table = np.genfromtxt(tmp_path / "drive.csv", delimiter=",", names=True)
    assert table["tangential_force"] == pytest.approx(plain.tangential_force, rel=1e-8)
    pandas = pytest.importorskip(
        "pandas", reason="pandas is not installed: pip install fretting-contact[sweep]"
    )
    frame = pandas.DataFrame({"t": time, "u": 2e-6 * np.sin(time)})
    with Contact() as contact:
        again = drive(contact, frame["t"], frame["u"])
    assert pandas.DataFrame(again.columns()).equals(pandas.DataFrame(plain.columns()))


def test_motion_in_the_plane_has_both_directions():
    time = np.linspace(0, 1, 50)
    with Contact(wear_coefficient=0.0) as contact:
        done = drive(
            contact, time, 4e-6 * time, displacement_y=3e-6 * time, outputs=["tangential_force_y"]
        )
    assert done.more["tangential_force_y"] == pytest.approx(
        0.75 * done.tangential_force, abs=1e-4 * 60.0
    )
    assert np.hypot(
        done.tangential_force[-1], done.more["tangential_force_y"][-1]
    ) == pytest.approx(60.0, rel=1e-4)


def test_outputs_that_are_no_real_are_recorded_as_numbers():
    time = np.linspace(0, 1, 5)
    outputs = ["slip_state", "wear_depth", "worn_through", "contact_count_in_touch"]
    for moved in (False, True):
        with Contact(coating_thickness=1e-12) as contact:
            if moved:
                contact.step(tangential_displacement=1e-9)
            done = drive(contact, time, 4e-6 * time, outputs=outputs)
            items = contact.fmu.variables["slip_state"].declaredType.items
            number = {item.name: int(item.value) for item in items}
            assert done.more["slip_state"][-1] == number[contact["slip_state"]]
            assert done.more["worn_through"][-1] == 1.0
            assert done.more["contact_count_in_touch"].tolist() == [1.0] * 5
            assert done.more["wear_depth"][-1] == contact["wear_depth"]


def test_one_output_may_be_a_name_and_a_field_is_refused():
    with Contact() as contact:
        for outputs in "pressure[1]", ["pressure[1]"]:
            done = drive(contact, [0.0, 1.0], [0.0, 1e-6], outputs=outputs)
            assert done.more["pressure[1]"][-1] == contact["pressure"][0]
        for outputs in "pressure", ["wear_depth", "pressure"]:
            with pytest.raises(ParameterError, match=r"'pressure', a field, .* 'pressure\[1\]'"):
                drive(contact, [0.0, 1.0], [0.0, 1e-6], outputs=outputs)


REFUSED = [
    (([0.0, 1.0], [0.0]), {}, "tangential_displacement has 1 samples and time has 2"),
    (
        ([0.0, 1.0, 1.0], [0.0, 1e-6, 0.0]),
        {},
        r"time\[2\] = 1 s does not rise from time\[1\] = 1 s",
    ),
    (([0.0, 1.0], [0.0, np.nan]), {}, r"displacement\[1\] = nan is not finite: interpolate"),
    (([0.0, 1.0], [[0.0, 1.0]]), {}, r"displacement has the shape \(1, 2\)"),
    (([0.0, 1.0], [0.0, 1e-6], [1.0]), {}, "normal_force has 1 samples"),
    (([0.0, 1.0], [0.0, 1e-6], np.nan), {}, r"normal_force\[0\] = nan is not finite"),
    (
        ([0.0, 1.0], np.ma.masked_array([0.0, 1e-6], [False, True])),
        {},
        r"displacement\[1\] is masked: interpolate the gap",
    ),
    (
        (np.arange(2).astype("datetime64[s]"), [0.0, 1e-6]),
        {},
        r"time has the type datetime64\[s\]: give numbers, times in seconds",
    ),
    (([0.0, 1.0], ["a", "b"]), {}, "displacement has the type <U1: give numbers"),
]


@pytest.mark.parametrize(("signals", "keywords", "message"), REFUSED, ids=range(len(REFUSED)))
def test_a_signal_that_cannot_be_followed_is_refused(signals, keywords, message):
    with Contact() as contact:
        with pytest.raises(SignalError, match=message):
            drive(contact, *signals, **keywords)
        assert contact.time == 0.0


def test_a_contact_that_has_moved_is_not_started_again():
    with Contact() as contact:
        before = contact.step(0.0, tangential_displacement=4e-6)["dissipated_energy"]
        rest = drive(contact, [0.0, 1.0], [4e-6, 4e-6])
        assert before > 0.0 and rest.dissipated_energy.tolist() == [before, before]


def test_a_contact_that_has_returned_to_its_start_has_the_load_of_the_start():
    with Contact(normal_force=100.0) as contact:
        start = contact.save()
        contact.step(normal_force=50.0, tangential_displacement=1e-6)
        contact.restore(start)
        # not moved: pressed on at the first sample
        slide = drive(contact, [0.0, 1.0], [5e-6, 20e-6])
        assert slide.normal_force.tolist() == [100.0, 100.0]
        assert slide.tangential_force[0] == 0.0
    with Contact(normal_force=100.0) as contact:
        start = contact.save()
        contact.set(normal_force=50.0)
        contact.restore(start)
        assert drive(contact, [0.0, 1.0], [0.0, 1e-6]).normal_force.tolist() == [100.0, 100.0]


def test_a_contact_keeps_what_it_has_taken_over_as_bytes():
    with Contact(radius="20 mm") as contact:
        stored = bytes(contact.save())
    with Contact() as contact:
        contact.restore(stored)
        drive(contact, [0.0, 1.0], [0.0, 1e-6])
        assert contact["radius"] == 0.02


def test_quantities_of_motions_may_be_texts():
    with Contact() as contact:
        text = loop(contact, "1.5 um", normal_force="0.05 kN", center="1 um")
    with Contact() as contact:
        number = loop(contact, 1.5e-6, normal_force=50.0, center=1e-6)
    assert text.work == pytest.approx(number.work, rel=1e-12)
    with Contact() as contact:
        there = drive(contact, [0.0, 1.0], [0.0, 1e-6], normal_force="50 N")
    assert there.normal_force.tolist() == [50.0, 50.0]
    with Contact() as contact, pytest.raises(ValueError, match="amplitude = '2 mn': the unit"):
        loop(contact, "2 mn")


@pytest.mark.parametrize("cycles", [0, -5, float("nan"), float("inf"), "1e5", [10, 100]])
def test_a_number_of_cycles_that_is_none_is_named(cycles):
    with (
        Contact(loading="cyclic") as contact,
        pytest.raises(SignalError, match="cycles = .*: give a finite number above 0"),
    ):
        life(contact, cycles)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"cycles": 1.5}, "cycles = 1.5: give a whole number, 1 or more"),
        ({"cycles": float("inf")}, "cycles = inf: give a whole number"),
        ({"cycles": "2"}, "cycles = '2': give a whole number"),
        ({"cycles": 0}, "cycles = 0: give a whole number"),
        ({"points": 10.5}, "points = 10.5: give a whole number, 4 or more"),
        ({"points": 3}, "points = 3: give a whole number, 4 or more"),
    ],
)
def test_a_loop_has_whole_cycles_and_points(given, message):
    with Contact() as contact:
        with pytest.raises(SignalError, match=message):
            loop(contact, 1.5e-6, **given)
        assert len(loop(contact, 1.5e-6, cycles=2.0, points=10.0).time) == 11


def test_what_needs_the_other_loading_says_so():
    with (
        Contact() as contact,
        pytest.raises(
            ParameterError, match=r"loading = 'transient', but 'cyclic' is needed: Contact"
        ),
    ):
        life(contact, 10)
    with Contact(loading="cyclic") as contact:
        with pytest.raises(ParameterError, match="'transient' is needed"):
            loop(contact, 1e-6)
        for keywords, message in (
            ({"at": [3, 2]}, "rising"),
            ({"at": [-1]}, "the first one 0 or more"),
            ({"at": [1, 20]}, "at ends with 20, beyond cycles = 10"),
        ):
            with pytest.raises(SignalError, match=message):
                life(contact, 10, **keywords)
        contact.set(frequency=0.0)
        with pytest.raises(SignalError, match="frequency = 0 Hz makes no cycles"):
            life(contact, 10)


def test_pictures_have_what_the_results_have():
    with Contact() as contact:
        one = loop(contact, 2e-6)
    axes = one.plot()
    x, y = axes.lines[0].get_data()
    assert x == pytest.approx(one.contact_displacement * 1e6) and y == pytest.approx(
        one.tangential_force
    )
    assert axes.get_xlabel() == "contact displacement (µm)"
    assert len(one.plot_history()) == 3
    with Contact(loading="cyclic") as contact:
        worn = life(contact, 1e4, at=[1e3, 1e4])
    axes = worn.plot()
    assert axes[0].lines[0].get_ydata() == pytest.approx(worn.wear_volume * 1e9)
    assert [text.get_text() for text in axes[2].get_legend().get_texts()] == ["1e+03", "1e+04"]
