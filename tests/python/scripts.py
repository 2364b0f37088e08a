"""Running a script as a user does: it must end well and cause no warning, also none that an
instance of the FMU keeps.
"""

import subprocess
import sys
from pathlib import Path

DEMO = Path(__file__).resolve().parents[2] / "examples" / "demo"

# keeps what instances have said after they are gone
RUNNER = """
import runpy, sys
demo, script, *sys.argv[1:] = sys.argv[1:]
sys.path[:0] = [demo]
sys.argv[0] = script
from fretting_contact import component

class Kept(dict):
    def pop(self, *_):
        return None

component._messages = Kept()
try:
    runpy.run_path(script, run_name="__main__")
except SystemExit as end:
    assert not end.code, end.code
for messages in component._messages.values():
    for status, text in messages:
        print("[WARNING] of a kept message:", text) if status == 1 else None
"""


def run_with_warnings(script, *arguments):
    """What a script prints, and the warnings among it."""
    command = [sys.executable, "-c", RUNNER, DEMO, script, *arguments]
    done = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    lines = (done.stdout + done.stderr).splitlines()
    return done.stdout, [line for line in lines if line.startswith("[WARNING]")]


def run_script(script, *arguments):
    """What a script prints; it causes no warning."""
    said, warnings = run_with_warnings(script, *arguments)
    assert warnings == []
    return said
