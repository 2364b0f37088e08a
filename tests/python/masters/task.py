"""The task of a master, read from stdin as JSON, and its answer, a file."""

import json
import sys
from pathlib import Path


class Task:
    #: Inputs that are set before each step.
    names = ("normal_force", "tangential_displacement")

    def __init__(self):
        task = json.load(sys.stdin)
        self.fmu, self.folder, self.step = task["fmu"], task["folder"], task["step"]
        self.inputs, self.outputs, self.parameters = (
            task["inputs"],
            task["outputs"],
            task["parameters"],
        )
        self.rows = []

    def row(self, values):
        self.rows.append([float(value) for value in values])

    def done(self):
        (Path(self.folder) / "answer.json").write_text(json.dumps(self.rows))


def missing(what):
    """Ends the master where it cannot run on this machine."""
    sys.exit(f"MISSING: {what}")
