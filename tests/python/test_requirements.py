"""Requirement files: each package is pinned to one version, in one file."""

import re
from collections import defaultdict

from conftest import ROOT

FILES = [
    path
    for folder in ("tests", "examples", "fmu-build")
    for path in (ROOT / folder).rglob("*requirements.txt")
]


def test_each_package_has_one_source_of_its_version():
    files = defaultdict(set)
    for path in FILES:
        for line in path.read_text(encoding="utf-8").splitlines():
            if line and not line.startswith("#"):
                name = re.fullmatch(r"([a-z0-9-]+)==[\w.]+(; .+)?", line)
                assert name, f"{path}: {line} is no pin"
                files[name[1]].add(path.name)
    assert len(FILES) >= 6 and len(files) > 30
    assert {name: where for name, where in files.items() if len(where) > 1} == {}
