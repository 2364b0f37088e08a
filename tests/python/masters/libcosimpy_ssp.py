"""libcosim on a system of the standard SSP: values of the component `contact` after two steps, the
second of which moves it.
"""

import json
import sys
from pathlib import Path

from task import missing

try:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
except (ImportError, OSError) as problem:
    missing(f"libcosimpy cannot be loaded here: {problem}")

system, _, answer, displacement, *names = sys.argv[1:]
execution = CosimExecution.from_ssp_file(system, step_size=10**8)
observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
execution.add_observer(observer)
execution.add_manipulator(manipulator)
contact = execution.slave_index_from_instance_name("contact")
references = {
    variable.name.decode(): variable.reference for variable in execution.slave_variables(contact)
}
moved = [references["tangential_displacement"]]
for position in (0.0, float(displacement)):
    manipulator.slave_real_values(contact, moved, [position])
    if not execution.step():
        raise SystemExit("a step failed")
values = observer.last_real_values(contact, [references[name] for name in names])
Path(answer).write_text(json.dumps(dict(zip(names, values))))
