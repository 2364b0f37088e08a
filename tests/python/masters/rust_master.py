"""The `fmi` crate: https://github.com/jondo2010/rust-fmi. A program of its own, which `cargo fmu test` builds."""

import os
import subprocess
import sys

from task import missing

program = os.environ.get("FRETTING_RUST_MASTER")
if program is None:
    missing("FRETTING_RUST_MASTER, the path of the master in Rust")
sys.exit(subprocess.run([program], check=False).returncode)
