"""libcosim of the Open Simulation Platform:
https://github.com/open-simulation-platform/libcosimpy
"""

from task import Task, missing

try:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave
except (ImportError, OSError) as problem:
    missing(f"libcosimpy cannot be loaded here: {problem}")

task = Task()
execution = CosimExecution.from_step_size(step_size=int(task.step * 1e9))
slave = execution.add_local_slave(CosimLocalSlave(fmu_path=task.fmu, instance_name="contact"))
references = {
    variable.name.decode(): variable.reference for variable in execution.slave_variables(slave)
}
for name, value in task.parameters.items():
    execution.real_initial_value(slave, references[name], value)
observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
execution.add_observer(observer)
execution.add_manipulator(manipulator)
for inputs in task.inputs:
    manipulator.slave_real_values(slave, [references[name] for name in task.names], inputs)
    if not execution.step():
        raise SystemExit("a step failed")
    task.row(observer.last_real_values(slave, [references[name] for name in task.outputs]))
task.done()
