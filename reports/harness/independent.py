"""Asks Tamaas, a boundary-element solver, for the contact of the ball.

Where Tamaas is not installed, no file is written.
"""

import statistics
import sys
import time
from pathlib import Path

import numpy as np

# the ball of the ready problems
E_STAR, RADIUS, FORCE = 210e9 / (2 * (1 - 0.3**2)), 0.01, 100.0
PATIENCE = 5.0  # s, after which no finer grid is asked for
REPEATS = 3


def central_pressure(tamaas, points, reach):
    """Largest pressure, Pa, on a grid of points² over (reach)² m²."""
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [reach, reach], [points, points]
    )
    model.E, model.nu = E_STAR, 0.0
    x = (np.arange(points) + 0.5) * reach / points - reach / 2
    surface = -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * RADIUS)
    solver = tamaas.PolonskyKeerRey(model, surface, 1e-10)
    tamaas.ModelFactory.registerNonPeriodic(model, "free")
    solver.setIntegralOperator("free")
    solver.solve(FORCE / reach**2)
    return model.traction.max()


def main(folder):
    file = folder / "independent.csv"
    file.unlink(missing_ok=True)
    try:
        import tamaas
    except ImportError:
        print(
            "Tamaas is not installed: no independent solution (`pip install tamaas` "
            "in the environment of the reports)"
        )
        return
    tamaas.set_log_level(tamaas.LogLevel.error)
    a = (3 * FORCE * RADIUS / (4 * E_STAR)) ** (1 / 3)
    hertz = 3 * FORCE / (2 * np.pi * a**2)
    lines = ["points,error,seconds,seconds_least,seconds_most"]
    for points in (16, 32, 64, 128, 256):
        times = []
        for _ in range(REPEATS):
            start = time.perf_counter()
            pressure = central_pressure(tamaas, points, 4 * a)
            times.append(time.perf_counter() - start)
        lines.append(
            f"{points},{abs(pressure / hertz - 1)},"
            f"{statistics.median(times)},{min(times)},{max(times)}"
        )
        if min(times) > PATIENCE:
            break
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "reports"))
