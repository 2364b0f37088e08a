"""Two bodies held by three friction joints, each an instance of the FMU, with an implicit master.

    python joint.py [FrettingContact.fmu]

wall -(joint)- body 1 -(joint)- body 2 -(joint)- wall. The trapezium rule asks for displacements at
the end of a step that satisfy the equations of motion with the joints' forces there: Newton's
method saves the joints at the start of the step, moves them to a trial, reads forces and stiffness,
puts them back and tries again. So the joints, hundreds of times as stiff as what carries the
bodies, do not limit the step.
"""

import sys

import numpy as np
from fretting_contact import Contact

FMU = sys.argv[1] if len(sys.argv) > 1 else None  # that of the package
MASS = np.array([0.5, 0.3])  # kg
DAMPING = np.array([50.0, 50.0])  # N s/m, to the wall
GAPS = np.array(
    [[1.0, 0.0], [-1.0, 1.0], [0.0, 1.0]]
)  # joint displacements from those of the bodies
FORCES = [60.0, 40.0, 80.0]  # N, normal
FREQUENCY, AMPLITUDE, CYCLES = 400.0, 70.0, 6  # Hz, N on body 1, number


class Joint(Contact):
    """One instance, with its state at the end of the last accepted step."""

    def attempt(self, displacement, step):
        """Force and stiffness at the end of a step from the last accepted state."""
        self.restore(self.before)
        self.step(step, tangential_displacement=displacement)
        return self.get("tangential_force", "tangential_stiffness")

    def accept(self):
        self.before = self.save()


def run(steps):
    """The motion in `steps` a period; returns body displacements, the joints' work (J) and Newton
    iterations a step.
    """
    joints = [Joint(fmu=FMU, normal_force=force) for force in FORCES]
    for joint in joints:
        joint.accept()
    step, x, v, iterations = 1 / FREQUENCY / steps, np.zeros(2), np.zeros(2), 0
    push = lambda t: np.array([AMPLITUDE * np.sin(2 * np.pi * FREQUENCY * t), 0.0])  # noqa: E731
    total, history = np.zeros(2), [x]
    for k in range(CYCLES * steps):
        time, guess = k * step, x + step * v
        for _ in range(30):
            answers = [joint.attempt(gap, step) for joint, gap in zip(joints, GAPS @ guess)]
            force, stiffness = np.array(answers).T
            rate = 2 * (guess - x) / step - v
            end = push(time + step) - DAMPING * rate - GAPS.T @ force
            miss = MASS * (rate - v) / step - 0.5 * (total + end)
            slope = (
                np.diag(2 * MASS / step**2 + DAMPING / step)
                + 0.5 * GAPS.T @ np.diag(stiffness) @ GAPS
            )
            change = -np.linalg.solve(slope, miss)
            guess, iterations = guess + change, iterations + 1
            if np.max(np.abs(change)) < 1e-14:
                break
        else:
            raise RuntimeError(f"no equilibrium at t = {time} s")
        x, v, total = guess, rate, end
        for joint in joints:
            joint.accept()
        history.append(x)
    return (
        np.array(history),
        [joint["dissipated_energy"] for joint in joints],
        iterations / (CYCLES * steps),
    )


if __name__ == "__main__":
    for steps in (50, 100, 200):
        motion, work, iterations = run(steps)
        last = motion[-steps:]
        print(f"{steps} steps a period, {iterations:.2f} iterations each")
        print(f"amplitude of body 1  {np.ptp(last[:, 0]) / 2:.5e} m")
        print(f"amplitude of body 2  {np.ptp(last[:, 1]) / 2:.5e} m")
        print(f"work of the joints   {' '.join(f'{w:.5e}' for w in work)} J")
