"""Wear by the noise of a measured displacement, and the effect of filter and dead band.

    python noisy_displacement.py [FrettingContact.fmu]

The displacement is synthetic: 20 cycles of ±1.5 µm at 200 points a cycle, with Gaussian noise of 20
or 50 nm rms. Each reversal of the noise is a small stroke, and at the contact edge even a small
stroke slips. The worn volume is compared with that of the displacement without noise; mean and
spread of five noise sequences.
"""

import sys

import numpy as np
from fretting_contact import Contact, drive
from scipy.signal import butter, filtfilt

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
AMPLITUDE, CYCLES, POINTS = 1.5e-6, 20, 200  # m; of 1 s each; a cycle
CUTOFF = 10.0  # cycles per cycle of the motion
NOISE, SEEDS = (20e-9, 50e-9), range(5)  # m rms


def worn_volume(displacement):
    with Contact(fmu=FMU, normal_force=100.0) as contact:
        return drive(contact, np.arange(displacement.size) / POINTS, displacement).wear_volume[-1]


def low_pass(displacement):
    """Butterworth filter of fourth order, forward and backward: without a shift in time."""
    return filtfilt(*butter(4, CUTOFF / (POINTS / 2)), displacement)


def dead_band(displacement, width):
    """Play: the result follows only where the value is further than the width from it. It cuts the
    amplitude by the width.
    """
    passed = np.empty_like(displacement)
    last = displacement[0]
    for n, value in enumerate(displacement):
        last = min(max(last, value - width), value + width)
        passed[n] = last
    return passed


def report(title, volumes, clean):
    change = 100 * (np.array(volumes) / clean - 1)
    print(
        f"{title:<34} {change.mean():+6.1f} %  from {change.min():+6.1f} to {change.max():+6.1f} %"
    )


if __name__ == "__main__":
    time = np.arange(CYCLES * POINTS + 1) / POINTS
    motion = AMPLITUDE * np.sin(2 * np.pi * time)
    clean = worn_volume(motion)
    print(f"worn volume without noise {clean:.4e} m3; change of it:")
    report("no noise, low-pass", [worn_volume(low_pass(motion))], clean)
    for noise in NOISE:
        noisy = [
            motion + noise * np.random.default_rng(seed).standard_normal(motion.size)
            for seed in SEEDS
        ]
        name = f"{noise * 1e9:.0f} nm rms, "
        report(name + "as measured", [worn_volume(u) for u in noisy], clean)
        report(name + "low-pass", [worn_volume(low_pass(u)) for u in noisy], clean)
        for width in (1, 2, 3):
            volumes = [worn_volume(dead_band(u, width * noise)) for u in noisy]
            report(name + f"dead band {width} x rms", volumes, clean)
