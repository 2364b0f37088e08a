"""Ecos on a system of the standard SSP: values of the component `contact` after one step."""

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

system, preset, answer, *names = sys.argv[1:]
with EcosSimulation(ssp_path=system, step_size=0.1) as simulation:
    simulation.init(parameter_set=preset)
    simulation.step()
    values = {name: simulation.get_real(f"contact::{name}") for name in names}
Path(answer).write_text(json.dumps(values))
