"""The `fmi` crate, https://github.com/jondo2010/rust-fmi, in a program of its own."""

import os
import subprocess
import sys

from task import missing

program = os.environ.get("FRETTING_RUST_MASTER")
if program is None:
    missing("the master in Rust: `cargo fmu test --rust-master` builds and runs it")
sys.exit(subprocess.run([program], check=False).returncode)
