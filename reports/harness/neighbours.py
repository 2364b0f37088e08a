"""What an interface neglects: seven balls on one rigid body, by Tamaas (boundary elements).

    python neighbours.py

One ball in the middle of a hexagon of six, at three spacings, 700 N together. Without elastic
interaction each carries 100 N at the approach of Hertz. Prints a Markdown table:
docs/interface.md shows it. Needs `tamaas`.
"""

import numpy as np
import tamaas

E_STAR, RADIUS, FORCE = 210e9 / (2 * (1 - 0.3**2)), 0.01, 100.0
POINTS = 384
# contact radius and approach of one ball by itself
A = (3 * FORCE * RADIUS / (4 * E_STAR)) ** (1 / 3)
DEPTH = A**2 / RADIUS


def solve(spacing):
    """Approach, load of the middle ball and largest pressure, over those without interaction."""
    angles = np.arange(6) * np.pi / 3
    places = spacing * np.vstack([[0, 0], np.column_stack([np.cos(angles), np.sin(angles)])])
    reach = 2 * spacing + 4 * A
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [reach, reach], [POINTS, POINTS]
    )
    model.E, model.nu = E_STAR, 0.0
    x = (np.arange(POINTS) + 0.5) * reach / POINTS - reach / 2
    distances = [(x[:, None] - px) ** 2 + (x[None, :] - py) ** 2 for px, py in places]
    surface = -np.min(distances, axis=0) / (2 * RADIUS)
    solver = tamaas.PolonskyKeerRey(model, surface, 1e-9)
    tamaas.ModelFactory.registerNonPeriodic(model, "free")
    solver.setIntegralOperator("free")
    solver.solve(7 * FORCE / reach**2)
    # the solver's displacement has no datum: that of the point nearest to the middle
    cell = reach / POINTS
    k = POINTS // 2
    r = np.hypot(x[:, None] - x[k], x[None, :] - x[k])
    r[k, k] = cell / (4 * np.log(1 + np.sqrt(2)))
    approach = np.sum(model.traction / r) * cell**2 / (np.pi * E_STAR) - surface[k, k]
    middle = np.sum(model.traction[distances[0] < (spacing / 2) ** 2]) * cell**2
    return approach / DEPTH, middle / FORCE, model.traction.max() / (3 * FORCE / (2 * np.pi * A**2))


if __name__ == "__main__":
    tamaas.set_log_level(tamaas.LogLevel.error)
    titles = ("spacing / a", "approach", "load of the middle ball", "largest pressure", "estimate")
    print("| " + " | ".join(titles) + " |")
    print("| --- | --- | --- | --- | --- |")
    for ratio in (4, 8, 16):
        approach, middle, pressure = solve(ratio * A)
        # the mean over the seven balls of the displacements F/(pi E* s) of the six others
        outer = 3 + 2 / np.sqrt(3) + 1 / 2
        estimate = 1 + 4 / (3 * np.pi * ratio) * (6 + 6 * outer) / 7
        print(f"| {ratio} | {approach:.3f} | {middle:.3f} | {pressure:.3f} | {estimate:.3f} |")
