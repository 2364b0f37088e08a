"""Two bodies held by three friction joints, each an instance of the FMU, with an implicit master.

    python joint.py [FrettingContact.fmu]

wall -(joint)- body 1 -(joint)- body 2 -(joint)- wall. The trapezium rule asks for displacements at the end of a step that satisfy the
equations of motion with the joints' forces there: Newton's method saves the joints at the start of the step, moves them to a trial,
reads forces and stiffness (directional derivatives), puts them back and tries again. So the joints, hundreds of times as stiff as what
carries the bodies, do not limit the step.
"""

import sys

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

FMU = sys.argv[1] if len(sys.argv) > 1 else "target/fmu/FrettingContact.fmu"
MASS = np.array([0.5, 0.3])  # kg
DAMPING = np.array([50.0, 50.0])  # N s/m, to the wall
GAPS = np.array([[1.0, 0.0], [-1.0, 1.0], [0.0, 1.0]])  # joint displacements from those of the bodies
FORCES = [60.0, 40.0, 80.0]  # N, normal
FREQUENCY, AMPLITUDE, CYCLES = 400.0, 70.0, 6  # Hz, N on body 1, number


class Joint:
    """One instance."""

    def __init__(self, description, folder, name, normal_force):
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        model = description.coSimulation.modelIdentifier
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=model, instanceName=name)
        self.fmu.instantiate()
        self.set("normal_force", normal_force)
        self.fmu.setupExperiment()
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.before = self.fmu.getFMUstate()

    def set(self, name, value):
        self.fmu.setReal([self.references[name]], [value])

    def get(self, name):
        return self.fmu.getReal([self.references[name]])[0]

    def attempt(self, displacement, time, step):
        """Force and stiffness at the end of a step that begins where the last accepted one ended."""
        self.fmu.setFMUstate(self.before)
        self.set("tangential_displacement", displacement)
        self.fmu.doStep(time, step)
        force, motion = self.references["tangential_force"], self.references["tangential_displacement"]
        return self.fmu.getReal([force])[0], self.fmu.getDirectionalDerivative([force], [motion], [1.0])[0]

    def accept(self):
        self.fmu.freeFMUstate(self.before)
        self.before = self.fmu.getFMUstate()


def run(description, folder, steps):
    """The motion in `steps` a period; returns body displacements, the joints' work (J) and Newton iterations a step."""
    joints = [Joint(description, folder, f"joint {k}", force) for k, force in enumerate(FORCES)]
    step, x, v, iterations = 1 / FREQUENCY / steps, np.zeros(2), np.zeros(2), 0
    push = lambda t: np.array([AMPLITUDE * np.sin(2 * np.pi * FREQUENCY * t), 0.0])  # noqa: E731
    total, history = np.zeros(2), [x]
    for k in range(CYCLES * steps):
        time, guess = k * step, x + step * v
        for _ in range(30):
            answers = [joint.attempt(gap, time, step) for joint, gap in zip(joints, GAPS @ guess)]
            force, stiffness = np.array(answers).T
            rate = 2 * (guess - x) / step - v
            end = push(time + step) - DAMPING * rate - GAPS.T @ force
            miss = MASS * (rate - v) / step - 0.5 * (total + end)
            slope = np.diag(2 * MASS / step**2 + DAMPING / step) + 0.5 * GAPS.T @ np.diag(stiffness) @ GAPS
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
    return np.array(history), [joint.get("dissipated_energy") for joint in joints], iterations / (CYCLES * steps)


if __name__ == "__main__":
    description, folder = read_model_description(FMU), extract(FMU)
    for steps in (50, 100, 200):
        motion, work, iterations = run(description, folder, steps)
        last = motion[-steps:]
        print(f"{steps} steps a period, {iterations:.2f} iterations each")
        print(f"amplitude of body 1  {np.ptp(last[:, 0]) / 2:.5e} m")
        print(f"amplitude of body 2  {np.ptp(last[:, 1]) / 2:.5e} m")
        print(f"work of the joints   {' '.join(f'{w:.5e}' for w in work)} J")
