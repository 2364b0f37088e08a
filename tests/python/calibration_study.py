"""How often a calibration has the truth within two standard deviations.

    python tests/python/calibration_study.py [number of seeds]

Two loops by Mindlin's formulas (closed_forms.py), not by the FMU, with noise and an offset on force
and displacement, and three worn volumes of the FMU with noise of 3 %. Of values with normal errors
95.4 % are within two standard deviations.
"""

import functools
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from closed_forms import E_STAR, G_STAR, Sphere, contact_radius
from fretting_contact import Contact, MeasuredLoop, WornVolume, calibrate
from fretting_contact.calibration import Calibration

FRICTION, RIG, PER_WORK, HARDNESS = 0.62, 24e6, 5e-14, 8e9  # 1, N/m, m³/J, Pa
CASES = ((100.0, 8e-6), (60.0, 6e-6))  # load N, amplitude of the drive m
FORCE_OFFSETS, DISPLACEMENT_OFFSETS = (1.2, 0.7), (3e-6, -2e-6)  # N, m
FORCE_NOISE, DISPLACEMENT_NOISE, VOLUME_NOISE = 0.5, 20e-9, 0.03  # N, m, of the volume
POINTS, CYCLES = 100, 2  # a cycle
WEAR_TESTS = (
    (100.0, 8e-6, 1e5),
    (100.0, 8e-6, 2e5),
    (60.0, 6e-6, 2e5),
)  # N, m of the drive, cycles
TRUTH = {
    "friction_coefficient": FRICTION,
    "rig_stiffness": RIG,
    **{f"force_offset[{k}]": value for k, value in enumerate(FORCE_OFFSETS, start=1)},
    **{f"displacement_offset[{k}]": value for k, value in enumerate(DISPLACEMENT_OFFSETS, start=1)},
    "wear_per_work": PER_WORK,
}


@functools.lru_cache
def exact_loop(load: float, amplitude: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacement of the drive and force of a steady cycle behind the rig, by Mindlin and
    Masing.
    """
    sphere = Sphere()
    full_slip = FRICTION * E_STAR / G_STAR * sphere.depth(contact_radius(sphere, load))

    def loading(u: np.ndarray) -> np.ndarray:
        return FRICTION * load * (1 - np.clip(1 - u / full_slip, 0, None) ** 1.5)

    first = np.linspace(0, amplitude, 200_001)
    top = np.interp(amplitude, first + loading(first) / RIG, first)
    back = np.linspace(top, -top, 200_001)  # from the upper reversal on
    force = loading(top) - 2 * loading((top - back) / 2)
    drive = amplitude * np.cos(2 * np.pi * np.arange(POINTS) / POINTS)
    half = np.interp(-drive[: POINTS // 2], -(back + force / RIG), force)
    return drive, np.concatenate([half, -half])


def true_volumes() -> list[float]:
    """Worn volumes of the wear tests, m³."""
    found = []
    for load, amplitude, cycles in WEAR_TESTS:
        values = {"normal_force": load, "displacement_amplitude": amplitude, "frequency": cycles}
        values |= {"friction_coefficient": FRICTION, "rig_stiffness": RIG}
        with Contact(
            loading="cyclic", wear_coefficient=PER_WORK * HARDNESS, hardness=HARDNESS, **values
        ) as contact:
            found.append(contact.step(1.0)["wear_volume"])
    return found


def calibrated(seed: int, volumes: list[float]) -> Calibration:
    """The calibration on loops and volumes with the noise of a seed."""
    random = np.random.default_rng(seed)
    loops = []
    for (load, amplitude), force_offset, displacement_offset in zip(
        CASES, FORCE_OFFSETS, DISPLACEMENT_OFFSETS
    ):
        drive, force = (np.tile(values, CYCLES) for values in exact_loop(load, amplitude))
        drive = (
            drive + displacement_offset + DISPLACEMENT_NOISE * random.standard_normal(drive.size)
        )
        force = force + force_offset + FORCE_NOISE * random.standard_normal(force.size)
        loops.append(MeasuredLoop(drive, force, load, CYCLES))
    noisy = np.array(volumes) * (1 + VOLUME_NOISE * random.standard_normal(len(volumes)))
    tests = [
        WornVolume(volume, load, amplitude, cycles, VOLUME_NOISE * volume)
        for volume, (load, amplitude, cycles) in zip(noisy, WEAR_TESTS)
    ]
    return calibrate(loops, tests, hardness=HARDNESS)


def deviations(seeds: int) -> dict[str, np.ndarray]:
    """Error over standard deviation of each value, one for each seed."""
    volumes = true_volumes()
    found = [calibrated(seed, volumes) for seed in range(seeds)]
    return {
        name: np.array([(fit[name] - truth) / fit.std(name) for fit in found])
        for name, truth in TRUTH.items()
    }


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    print(f"{'value':<23} within 2 std of {count}   mean and spread of error/std")
    for name, errors in deviations(count).items():
        print(
            f"{name:<23} {np.sum(np.abs(errors) <= 2):8d}            "
            f"{errors.mean():+6.2f} {errors.std():6.2f}"
        )
