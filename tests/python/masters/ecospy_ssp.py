"""Ecos on a system of the standard SSP: values of the component `contact` after two steps, the
second of which moves it.
"""

import json
import sys
from pathlib import Path

from task import missing

try:
    from ecospy import EcosSimulation
except (ImportError, OSError) as problem:
    missing(
        f"ecospy cannot be loaded here: {problem} (it needs libtbb; Debian, "
        "Ubuntu: `apt install libtbb12`)"
    )

system, preset, answer, displacement, *names = sys.argv[1:]
with EcosSimulation(ssp_path=system, step_size=0.1) as simulation:
    simulation.init(parameter_set=preset)
    for position in (0.0, float(displacement)):
        simulation.set_real("contact::tangential_displacement", position)
        simulation.step()
    values = {name: simulation.get_real(f"contact::{name}") for name in names}
Path(answer).write_text(json.dumps(values))
