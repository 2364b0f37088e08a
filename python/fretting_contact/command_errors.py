"""What the commands report about arguments and files that cannot be used."""

import argparse
import math
import sys
from pathlib import Path


class OutputError(ValueError):
    """A path that no file can be written to; the text says why and what to do."""


def finite(text: str) -> float:
    """A finite number as given on the command line."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"{text!r}: give a finite number")
    return number


def whole(text: str) -> int:
    """A whole number as given on the command line."""
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: give a whole number") from None


def check_output(output: Path | None) -> None:
    """Raises, before anything is computed, where the folder of an output is not there."""
    if output is not None and output.is_dir():
        raise OutputError(f"--output = {str(output)!r} is a folder: give the path of a file")
    if output is not None and not output.parent.is_dir():
        raise OutputError(
            f"--output = {str(output)!r} cannot be written: there is no folder "
            f"{str(output.parent)!r}; make it, or give another path"
        )


def report(problem: Exception) -> int:
    """Prints a problem in one line; returns the exit status."""
    text = str(problem)
    if isinstance(problem, OSError) and problem.filename is not None:
        text = (
            f"{str(problem.filename)!r} cannot be read or written ({problem.strerror}): "
            "check the path, or give another one"
        )
    print(f"error: {text}", file=sys.stderr)
    return 1
