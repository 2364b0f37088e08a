"""Histories of the inputs, for tests that ask for any history."""

import numpy as np


def history(seed, steps=30):
    """Normal force and displacement at each step; some loads are negative: the bodies separate."""
    random = np.random.default_rng(seed)
    return list(zip(random.uniform(-10, 200, steps), random.uniform(-4e-6, 4e-6, steps)))
