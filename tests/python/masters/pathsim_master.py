"""The co-simulation block of PathSim: https://github.com/pathsim/pathsim"""

import warnings

from task import Task, missing

try:
    from pathsim import Connection, Simulation
    from pathsim.blocks import Source
    from pathsim.blocks import fmu
except ImportError as problem:
    missing(f"pathsim cannot be loaded here: {problem}")


class RealOutputs(fmu.FMUWrapper):
    """The block asks for every output as a Real, which FMI does not allow for an Enumeration."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        reals = {v.name for v in self.model_description.modelVariables if v.type == "Real"}
        self.output_refs = {
            name: reference for name, reference in self.output_refs.items() if name in reals
        }

    def do_step(self, *arguments, **named):
        """Steps fall on events, the first at t = 0. The block takes them here."""
        result = super().do_step(*arguments, **named)
        if len(task.rows) < len(task.inputs):
            outputs = dict(zip(self.output_refs, self.get_outputs_as_array()))
            task.row([outputs[name] for name in task.outputs])
        return result


warnings.simplefilter("ignore")  # the block is announced to move to a package of its own
fmu.FMUWrapper = RealOutputs
task = Task()
block = fmu.CoSimulationFMU(task.fmu, start_values=task.parameters, dt=task.step)
description = block.fmu_wrapper.model_description
order = [variable.name for variable in description.modelVariables if variable.causality == "input"]


def signal(position):
    """An input that has the value of a step at its end, from where the block takes it."""
    last = len(task.inputs) - 1
    return lambda t: task.inputs[min(max(round(t / task.step) - 1, 0), last)][position]


sources = [Source(signal(position)) for position in range(len(task.names))]
connections = [
    Connection(source[0], block[order.index(name)]) for source, name in zip(sources, task.names)
]
# the other inputs keep their start values
others = []
for name in order:
    if name not in task.names:
        start = next(float(v.start) for v in description.modelVariables if v.name == name)
        others.append(Source(lambda t, start=start: start))
        connections.append(Connection(others[-1][0], block[order.index(name)]))
simulation = Simulation([block, *sources, *others], connections, dt=task.step, log=False)
while len(task.rows) < len(task.inputs):
    simulation.timestep()
task.done()
