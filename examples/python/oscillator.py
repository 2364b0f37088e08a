"""A shaken mass on a wearing friction joint, as a block diagram in PathSim.

    pip install pathsim pathsim-fmi
    python oscillator.py [FrettingContact.fmu]

A 20 kg unit on a soft mount is located by a pressed ball. PathSim integrates the mass; its
co-simulation block steps the joint. The block holds the force over a step, which feeds energy into
a stiff spring: a step of a three-hundredth of the period of the mass on the sticking joint and the
mount's damping keep that small. For steps that are not small see joint.py.
"""

import sys

import numpy as np
import pathsim_fmi.blocks
from pathsim import Connection, Simulation
from pathsim.blocks import Adder, Amplifier, Constant, Integrator, Scope, Source
from pathsim_fmi import CoSimulationFMU, FMUWrapper

FMU = sys.argv[1] if len(sys.argv) > 1 else "target/fmu/FrettingContact.fmu"
MASS, MOUNT, DAMPING = 20.0, 2e6, 1000.0  # kg, N/m, N s/m
SHAKE, FREQUENCY = 70.0, 150.0  # N, Hz
STEP, END = 1.6e-5, 0.05  # s


class RealOutputs(FMUWrapper):
    """The block reads all outputs as real numbers: the enumeration `slip_state` is left out."""

    def _build_variable_maps(self):
        super()._build_variable_maps()
        kinds = {variable.name: variable.type for variable in self.model_description.modelVariables}
        self.output_refs = {
            name: ref for name, ref in self.output_refs.items() if kinds[name] == "Real"
        }


pathsim_fmi.blocks.FMUWrapper = RealOutputs


def simulation():
    joint = CoSimulationFMU(FMU, start_values={"wear_coefficient": 1e-3}, dt=STEP)
    load, push = Constant(100.0), Source(lambda t: SHAKE * np.sin(2 * np.pi * FREQUENCY * t))
    forces, inverse_mass = Adder("+---"), Amplifier(1 / MASS)
    velocity, position = Integrator(0.0), Integrator(0.0)
    mount, damper = Amplifier(MOUNT), Amplifier(DAMPING)
    scope = Scope(labels=["position", "force", "wear"])
    blocks = [joint, load, push, forces, inverse_mass, velocity, position, mount, damper, scope]
    connections = [
        Connection(load, joint["normal_force"]),
        Connection(position, joint["tangential_displacement"], mount, scope[0]),
        Connection(push, forces[0]),
        Connection(mount, forces[1]),
        Connection(damper, forces[2]),
        Connection(joint["tangential_force"], forces[3], scope[1]),
        Connection(joint["wear_volume"], scope[2]),
        Connection(forces, inverse_mass),
        Connection(inverse_mass, velocity),
        Connection(velocity, position, damper),
    ]
    return Simulation(blocks, connections, dt=STEP, log=False), scope


if __name__ == "__main__":
    run, scope = simulation()
    run.run(END)
    time, (position, force, wear) = scope.read()
    late = time > END - 1 / FREQUENCY
    loop = np.trapezoid(force[late], position[late])
    print(f"amplitude            {np.ptp(position[late]) / 2:.4e} m")
    print(f"force amplitude      {np.ptp(force[late]) / 2:.4f} N")
    print(f"work of a loop       {loop:.4e} J")
    print(f"worn volume          {wear[-1]:.4e} m3")
