"""Calibration: exact values without noise, standard deviations with it, and refusals."""

import numpy as np
import pytest
from calibration_study import (
    FORCE_OFFSETS,
    FRICTION,
    HARDNESS,
    PER_WORK,
    RIG,
    TRUTH,
    deviations,
    exact_loop,
    true_volumes,
)
from fretting_contact import Contact, LoopError, MeasuredLoop, ParameterError, WornVolume, calibrate
from fretting_contact.measured_loop import smooth_drive


@pytest.fixture(autouse=True, scope="module")
def this_fmu(fmu_path):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FRETTING_FMU", str(fmu_path))
        yield


def measured(load=100.0, amplitude=8e-6, noise=0.0, offset=0.0, seed=0):
    drive, force = exact_loop(load, amplitude)
    return MeasuredLoop(
        drive,
        force + offset + noise * np.random.default_rng(seed).standard_normal(force.size),
        load,
    )


def test_without_noise_the_values_are_exact():
    """The loop is by Mindlin's formulas: 1e-9 of the FMU, with straight lines between 200,001
    points of them.
    """
    fit = calibrate(measured(offset=1.2), hardness=HARDNESS)
    assert fit["friction_coefficient"] == pytest.approx(FRICTION, rel=1e-7)
    assert fit["rig_stiffness"] == pytest.approx(RIG, rel=1e-6)
    assert fit["force_offset[1]"] == pytest.approx(1.2, rel=1e-6)
    assert fit["displacement_offset[1]"] == pytest.approx(0.0, abs=1e-15)
    assert fit.force_noise < 1e-5
    assert fit.parameters() == {
        name: fit[name] for name in ("friction_coefficient", "rig_stiffness")
    }


def test_twelve_seeds_have_errors_of_their_standard_deviations():
    """A small version of calibration_study.py: of 84 normal errors 80 are expected within 2, and
    none beyond 4.
    """
    found = deviations(12)
    assert set(found) == set(TRUTH)
    errors = np.concatenate(list(found.values()))
    assert np.mean(np.abs(errors) <= 2) >= 0.9 and np.max(np.abs(errors)) < 4
    assert 0.8 < np.sqrt(np.mean(errors**2)) < 1.25


def test_a_value_that_is_given_is_held():
    fit = calibrate(measured(), rig_stiffness=RIG)
    assert "rig_stiffness" not in fit.names and fit["friction_coefficient"] == pytest.approx(
        FRICTION, rel=1e-7
    )
    fit = calibrate(measured(), friction_coefficient=FRICTION)
    assert "friction_coefficient" not in fit.names and fit["rig_stiffness"] == pytest.approx(
        RIG, rel=1e-6
    )


def test_loops_of_different_loads_have_offsets_of_their_own():
    loops = [measured(offset=FORCE_OFFSETS[0]), measured(60.0, 6e-6, offset=FORCE_OFFSETS[1])]
    fit = calibrate(loops)
    assert [fit[f"force_offset[{k}]"] for k in (1, 2)] == pytest.approx(FORCE_OFFSETS, rel=1e-5)
    assert fit.covariance.shape == (6, 6) and fit.covariance == pytest.approx(fit.covariance.T)


def test_one_volume_gives_the_wear_coefficient_and_two_its_scatter():
    exact = true_volumes()
    one = calibrate(measured(), WornVolume(exact[0], 100.0, 8e-6, 1e5), hardness=HARDNESS)
    assert one["wear_per_work"] == pytest.approx(PER_WORK, rel=1e-5)
    assert one.parameters()["wear_coefficient"] == one["wear_per_work"] * HARDNESS
    with Contact(**one.parameters(), loading="cyclic", displacement_amplitude=8e-6) as contact:
        assert contact.step(1e5)["wear_volume"] == pytest.approx(exact[0], rel=1e-4)
    apart = [
        WornVolume(volume, 100.0, 8e-6, cycles)
        for volume, cycles in ((exact[0] * 1.1, 1e5), (exact[1] / 1.1, 2e5))
    ]
    two = calibrate(measured(), apart, hardness=HARDNESS)
    assert two["wear_per_work"] == pytest.approx(PER_WORK, rel=0.02)
    # two logarithms at ±0.095: the standard deviation of their mean is 0.095
    assert two.std("wear_per_work") / two["wear_per_work"] == pytest.approx(0.095, rel=0.1)


def test_quantities_of_a_wear_test_may_be_texts():
    test = WornVolume("0.0115 mm3", "0.1 kN", "8 um", 2e5, uncertainty="0.001 mm3")
    found = (test.volume, test.normal_force, test.amplitude, test.uncertainty)
    assert found == pytest.approx((1.15e-11, 100.0, 8e-6, 1e-12), rel=1e-14, abs=0)
    drive, force = exact_loop(100.0, 8e-6)
    assert MeasuredLoop(drive, force, "100 N").normal_force == 100.0


def test_several_cycles_in_a_record_are_one_loop():
    drive, force = exact_loop(100.0, 8e-6)
    noise = 0.5 * np.random.default_rng(3).standard_normal(4 * force.size)
    fit = calibrate(MeasuredLoop(np.tile(drive, 4), np.tile(force, 4) + noise, 100.0, cycles=4))
    single = calibrate(measured(noise=0.5, seed=4))
    assert fit.std("friction_coefficient") == pytest.approx(
        single.std("friction_coefficient") / 2, rel=0.25
    )


def test_a_smooth_drive_has_the_harmonics_of_the_measured_one():
    phase = 2 * np.pi * np.arange(400) / 400
    clean = 1e-6 + 5e-6 * np.sin(phase) + 3e-7 * np.cos(3 * phase)
    noisy = clean + 2e-8 * np.random.default_rng(1).standard_normal(400)
    drive = smooth_drive(MeasuredLoop(noisy, np.sin(phase), 100.0))
    assert len(drive.coefficients) == 7
    assert drive.noise == pytest.approx(2e-8, rel=0.1)
    assert drive.mean == pytest.approx(1e-6, abs=4 * np.sqrt(drive.covariance[0, 0]))
    assert np.sqrt(drive.covariance[0, 0]) == pytest.approx(2e-8 / 20, rel=0.1)
    assert smooth_drive(MeasuredLoop(clean, np.sin(phase), 100.0)).noise == 0.0


def test_picture_and_table_have_the_values():
    fit = calibrate(measured(noise=0.5))
    text = str(fit)
    assert "friction_coefficient" in text and " N/m" in text and "noise of the force" in text
    points, line = fit.plot().lines
    assert len(points.get_xdata()) == 100 and len(line.get_xdata()) == 101  # closed
    assert np.max(np.abs(line.get_ydata()[:-1] - points.get_ydata())) < 5 * 0.5
    with pytest.raises(KeyError, match="wear_per_work was not fitted; there are"):
        fit["wear_per_work"]


REFUSED = [
    (
        lambda: MeasuredLoop([0, 1e-6], [0], 100.0),
        LoopError,
        "displacement has 2 points and force has 1",
    ),
    (
        lambda: MeasuredLoop(np.zeros(10), np.zeros(10), 100.0),
        LoopError,
        "10 points for 1 cycle.*at least 16",
    ),
    (
        lambda: MeasuredLoop(np.zeros(20), np.zeros(20), 0.0),
        LoopError,
        "normal_force = 0.0 N: give a number > 0",
    ),
    (lambda: MeasuredLoop([np.nan] * 20, np.zeros(20), 1.0), LoopError, "finite numbers"),
    (
        lambda: smooth_drive(MeasuredLoop(np.ones(20), np.zeros(20), 1.0)),
        LoopError,
        "displacement is constant",
    ),
    (
        lambda: smooth_drive(MeasuredLoop(*exact_loop(1e2, 8e-6), 1e2, 3)),
        LoopError,
        "does not make 3 cycle",
    ),
    (
        lambda: smooth_drive(MeasuredLoop(exact_loop(1e2, 8e-6)[0], np.zeros(100), 1e2)),
        LoopError,
        "force is 0 N at all points",
    ),
    (
        lambda: calibrate(MeasuredLoop(measured().displacement, -measured().force, 100.0)),
        LoopError,
        "force has the opposite sign of displacement.*give -force",
    ),
    (
        lambda: WornVolume(0.0, 100.0, 8e-6, 1e5),
        ParameterError,
        "volume = 0.0 m3: give a finite number above 0",
    ),
    (lambda: WornVolume(-1e-11, 100.0, 8e-6, 1e5), ParameterError, "volume = -1e-11 m3"),
    (
        lambda: WornVolume(1e-11, 100.0, 8e-6, 1e5, uncertainty=0.0),
        ParameterError,
        "uncertainty = 0.0 m3: give a finite number above 0, or leave it out",
    ),
    (lambda: calibrate([]), ParameterError, "one measured loop at least"),
    (
        lambda: calibrate(measured(), loading="cyclic"),
        ParameterError,
        "loading is not a parameter of calibrate",
    ),
    (
        lambda: calibrate(measured(), WornVolume(1e-13, 100.0, 8e-6, 0.0)),
        ParameterError,
        "wears nothing in the model",
    ),
]


@pytest.mark.parametrize(("call", "kind", "message"), REFUSED, ids=range(len(REFUSED)))
def test_what_cannot_be_calibrated_is_refused(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


def test_a_friction_coefficient_that_the_loop_does_not_determine_is_named():
    """Of a contact that sticks but for its rim: the drive makes 0.2 um."""
    with pytest.raises(
        LoopError,
        match="do not determine friction_coefficient: its .*add a loop of larger amplitude",
    ):
        calibrate(measured(amplitude=2e-7, noise=0.5))
