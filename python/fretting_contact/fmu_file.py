"""The file FrettingContact.fmu: where it is, and its content unpacked into a folder."""

import atexit
import functools
import os
import shutil
import tempfile
import zipfile
from pathlib import Path

import fmpy

NAME = "FrettingContact.fmu"
VARIABLE = "FRETTING_FMU"
"""Environment variable with the path of the FMU to use."""


class FmuNotFoundError(FileNotFoundError):
    """There is no FMU, or it has no library for this machine."""


def fmu_path(given: str | os.PathLike[str] | None = None) -> Path:
    """Path of the FMU.

    The first of: `given`; the environment variable FRETTING_FMU; the file in the installed package;
    `target/fmu` of the checkout that this package is in.
    """
    package = Path(__file__).resolve().parent
    named = given if given is not None else os.environ.get(VARIABLE)
    if named is not None:
        if not Path(named).is_file():
            origin = "fmu" if given is not None else f"the environment variable {VARIABLE}"
            raise FmuNotFoundError(
                f"{origin} = {str(named)!r}: there is no such file; give the path of {NAME}"
            )
        return Path(named)
    places = [package / NAME, package.parents[1] / "target" / "fmu" / NAME]
    for place in places:
        if place.is_file():
            return place
    raise FmuNotFoundError(
        f"there is no {NAME} in "
        f"{' or '.join(str(place.parent) for place in places)}: install the wheel "
        "of "
        f"fretting-contact, run `cargo fmu build` in the checkout, or set {VARIABLE} to its path"
    )


class FmuFile:
    """An FMU unpacked into a temporary folder, for any number of instances."""

    def __init__(self, path: str | os.PathLike[str]):
        self.path = str(path)
        if not zipfile.is_zipfile(self.path):
            raise FmuNotFoundError(f"{self.path} is no FMU (no zip file): give the path of {NAME}")
        self.description = fmpy.read_model_description(self.path)
        folders = fmpy.supported_platforms(self.path)
        if fmpy.platform not in folders:
            raise FmuNotFoundError(
                f"{self.path} has libraries for {', '.join(folders)}, and none for "
                f"{fmpy.platform}, this machine: "
                "build it here with `cargo fmu build`, or join FMUs with `cargo fmu merge`"
            )
        self.directory = fmpy.extract(self.path)
        self.variables = {v.name: v for v in self.description.modelVariables}

    def close(self) -> None:
        """Removes the folder."""
        shutil.rmtree(self.directory, ignore_errors=True)

    def __enter__(self) -> "FmuFile":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def shared_file(path: str | os.PathLike[str] | None = None) -> FmuFile:
    """The FMU at `path` (see `fmu_path`), unpacked once in a process and removed at its end."""
    found = fmu_path(path).resolve()
    status = found.stat()
    return _unpacked(str(found), status.st_mtime_ns, status.st_size)


@functools.lru_cache(maxsize=8)
def _unpacked(path: str, _changed: int, _size: int) -> FmuFile:
    file = FmuFile(path)
    atexit.register(file.close)
    return file


@functools.lru_cache(maxsize=2)
def file_of_bytes(content: bytes) -> FmuFile:
    """The FMU with this content, for a machine that does not share a disk with the sender."""
    folder = tempfile.mkdtemp(prefix="fretting-contact-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    path = Path(folder) / NAME
    path.write_bytes(content)
    return shared_file(path)
