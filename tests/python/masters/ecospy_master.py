"""Ecos: https://github.com/Ecos-platform/ecos"""

from task import Task, missing

try:
    from ecospy import EcosSimulation, EcosSimulationStructure
except (ImportError, OSError) as problem:
    missing(
        f"ecospy cannot be loaded here: {problem} (it needs libtbb; Debian, "
        "Ubuntu: `apt install libtbb12`)"
    )

task = Task()
with EcosSimulationStructure() as structure:
    structure.add_model("contact", task.fmu)
    structure.add_parameter_set(
        "scene", {f"contact::{name}": value for name, value in task.parameters.items()}
    )
    with EcosSimulation(structure=structure, step_size=task.step) as simulation:
        simulation.init(parameter_set="scene")
        for inputs in task.inputs:
            for name, value in zip(task.names, inputs):
                simulation.set_real(f"contact::{name}", value)
            simulation.step()
            task.row([simulation.get_real(f"contact::{name}") for name in task.outputs])
task.done()
